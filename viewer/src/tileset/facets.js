// Flat triangles without normals, as tiles have them: each gets the normal of its last corner (see `faceted`), and corners
// stay shared where that is possible.

import { BufferAttribute, BufferGeometry } from 'three';

const SCALE = 32767;

/** The geometry of flat triangles: `points` (x, y, z in a row), texture coordinates `uv` or null, and `index`. */
export function facets(points, uv, index) {
  const used = compact(index, points.length / 3);
  return faces(take(points, used.from, 3), uv && take(uv, used.from, 2), used.index);
}

/** The vertices that triangles use, which may be few of many, and the index of these. */
function compact(index, vertices) {
  const [to, from, own] = [new Int32Array(vertices).fill(-1), [], new Uint32Array(index.length)];
  index.forEach((vertex, i) => {
    if (to[vertex] < 0) to[vertex] = from.push(vertex) - 1;
    own[i] = to[vertex];
  });
  return { from, index: own };
}

function take(values, from, size) {
  const own = new Float32Array(from.length * size);
  from.forEach((vertex, i) => own.set(values.subarray(vertex * size, vertex * size + size), i * size));
  return own;
}

function faces(points, uv, index) {
  const vertices = points.length / 3;
  const corners = new Uint32Array(index.length);
  // Which triangle's normal a vertex has, by its number plus 1; copies are behind the first vertices.
  const owners = new Uint32Array(vertices);
  const copies = [];
  const normals = new Int16Array(index.length);
  const takes = (vertex, at) => owners[vertex] === 0 || alike(normals, owners[vertex] * 3 - 3, at);
  for (let i = 0; i < index.length; i += 3) {
    const [a, b, c] = [index[i], index[i + 1], index[i + 2]];
    normal(points, a * 3, b * 3, c * 3, normals, i);
    let [first, second, last] = [a, b, c];
    if (!takes(c, i)) {
      if (takes(a, i)) [first, second, last] = [b, c, a];
      else if (takes(b, i)) [first, second, last] = [c, a, b];
      else {
        copies.push({ from: c, triangle: i });
        last = vertices + copies.length - 1;
      }
    }
    if (last < vertices) owners[last] ||= i / 3 + 1;
    corners[i] = first;
    corners[i + 1] = second;
    corners[i + 2] = last;
  }
  const made = new BufferGeometry();
  const total = vertices + copies.length;
  const from = (vertex) => (vertex < vertices ? vertex : copies[vertex - vertices].from);
  const repeat = (values, size) => {
    const all = new Float32Array(total * size);
    all.set(values.subarray(0, vertices * size));
    for (let at = vertices; at < total; at++)
      for (let k = 0; k < size; k++) all[at * size + k] = values[from(at) * size + k];
    return new BufferAttribute(all, size);
  };
  // Graphics cards have no attributes of six bytes.
  const own = new Int16Array(total * 4);
  for (let at = 0; at < total; at++) {
    const triangle = at < vertices ? owners[at] * 3 - 3 : copies[at - vertices].triangle;
    if (triangle >= 0) own.set(normals.subarray(triangle, triangle + 3), at * 4);
  }
  made.setAttribute('position', repeat(points, 3));
  made.setAttribute('normal', new BufferAttribute(own, 4, true));
  if (uv) made.setAttribute('uv', repeat(uv, 2));
  made.setIndex(new BufferAttribute(total > 65535 ? corners : Uint16Array.from(corners), 1));
  return made;
}

function normal(points, a, b, c, normals, at) {
  const [ux, uy, uz] = [points[b] - points[a], points[b + 1] - points[a + 1], points[b + 2] - points[a + 2]];
  const [vx, vy, vz] = [points[c] - points[a], points[c + 1] - points[a + 1], points[c + 2] - points[a + 2]];
  const [x, y, z] = [uy * vz - uz * vy, uz * vx - ux * vz, ux * vy - uy * vx];
  // A triangle without area has no side; it shows nothing.
  const scale = SCALE / (Math.hypot(x, y, z) || 1);
  normals[at] = Math.round(x * scale);
  normals[at + 1] = Math.round(y * scale);
  normals[at + 2] = Math.round(z * scale);
}

const alike = (normals, a, b) =>
  Math.abs(normals[a] - normals[b]) <= 2 &&
  Math.abs(normals[a + 1] - normals[b + 1]) <= 2 &&
  Math.abs(normals[a + 2] - normals[b + 2]) <= 2;
