// Flat triangles without normals, as tiles have them: each gets the normal of its last corner (see `faceted`), and corners
// stay shared where that is possible.

import { BufferAttribute, BufferGeometry } from 'three';

const SCALE = 32767;

/** The geometry of flat triangles: `points` (x, y, z in a row), texture coordinates `uv` or null, and `index`. */
export function facets(points, uv, index) {
  const vertices = points.length / 3;
  const corners = new Uint32Array(index.length);
  // Which triangle's normal a vertex has, by its number plus 1; copies are behind the first vertices.
  const owners = new Uint32Array(vertices);
  const copies = [];
  const normals = new Int16Array((index.length / 3) * 3);
  for (let i = 0; i < index.length; i += 3) {
    const triangle = [index[i], index[i + 1], index[i + 2]];
    normal(points, triangle, normals, i);
    let last = [2, 0, 1].find((it) => owners[triangle[it]] === 0 || alike(normals, owners[triangle[it]] * 3 - 3, i));
    if (last === undefined) {
      copies.push({ from: triangle[2], triangle: i });
      corners.set([triangle[0], triangle[1], vertices + copies.length - 1], i);
      continue;
    }
    owners[triangle[last]] ||= i / 3 + 1;
    corners.set([triangle[(last + 1) % 3], triangle[(last + 2) % 3], triangle[last]], i);
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

function normal(points, [a, b, c], normals, at) {
  const side = (from, to) => [0, 1, 2].map((axis) => points[to * 3 + axis] - points[from * 3 + axis]);
  const [u, v] = [side(a, b), side(a, c)];
  const cross = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]];
  const length = Math.hypot(...cross);
  // A triangle without area has no side; it shows nothing.
  const unit = length > 0 ? cross.map((it) => it / length) : [0, 1, 0];
  unit.forEach((it, axis) => (normals[at + axis] = Math.round(it * SCALE)));
}

const alike = (normals, a, b) => [0, 1, 2].every((axis) => Math.abs(normals[a + axis] - normals[b + axis]) <= 2);
