// What need not be drawn one by one, in few meshes: each has its price in every frame, and a city has thousands.

import { Box3, BufferAttribute, BufferGeometry, Mesh, Sphere, Vector3 } from 'three';

const SMALL = 5000; // vertices above which a mesh is drawn by itself
const MOST = 65535; // vertices of a merged mesh: indices have two bytes, and the last of them ends a strip in WebGL

/** The meshes to draw in place of `parts`: parts that are drawn by themselves, and merged ones. */
export function merge(parts) {
  const [drawn, groups] = [[], new Map()];
  const close = (group) => drawn.push(group.parts.length > 1 ? together(group) : group.parts[0].part);
  for (const part of parts) {
    const range = part.isInstancedMesh || part.material.transparent ? null : vertices(part);
    if (!range) {
      drawn.push(part);
      continue;
    }
    const alike = likeness(part);
    const count = range.to - range.from;
    let group = groups.get(alike);
    if (group && group.vertices + count > MOST) {
      close(group);
      group = undefined;
    }
    if (!group) groups.set(alike, (group = { parts: [], vertices: 0, indices: 0 }));
    group.parts.push({ part, ...range });
    group.vertices += count;
    group.indices += part.geometry.index.count;
  }
  groups.forEach(close);
  return drawn;
}

/** The vertices `from` and before `to` that a part uses, which may be a few of many; null if it stays by itself. */
function vertices({ geometry, matrix }) {
  const { position } = geometry.attributes;
  const index = geometry.index.array;
  if (!(position.array instanceof Float32Array) || position.itemSize !== 3 || index.length > 6 * SMALL) return null;
  // A turned or stretched part would need other normals.
  const { elements } = matrix;
  for (let i = 0; i < 12; i++) if (elements[i] !== (i % 5 === 0 ? 1 : 0)) return null;
  let [from, last] = [Infinity, -1];
  for (const at of index) {
    if (at < from) from = at;
    if (at > last) last = at;
  }
  return last - from < SMALL && last >= 0 ? { from, to: last + 1 } : null;
}

/** Equal for parts that one mesh can show. */
function likeness({ material, geometry }) {
  const attributes = Object.entries(geometry.attributes).map(
    ([name, { array, itemSize, normalized }]) => `${name} ${array.constructor.name} ${itemSize} ${normalized}`,
  );
  return [material.id, ...attributes.sort()].join();
}

function together({ parts, vertices, indices }) {
  const [{ part: first }] = parts;
  const made = new BufferGeometry();
  for (const [name, { array, itemSize, normalized }] of Object.entries(first.geometry.attributes)) {
    const all = new array.constructor(vertices * itemSize);
    let at = 0;
    for (const { part, from, to } of parts) {
      const own = part.geometry.attributes[name].array.subarray(from * itemSize, to * itemSize);
      all.set(own, at);
      if (name === 'position') move(all.subarray(at, at + own.length), part.matrix.elements);
      at += own.length;
    }
    made.setAttribute(name, new BufferAttribute(all, itemSize, normalized));
  }
  const index = new Uint16Array(indices);
  const box = new Box3();
  let [at, base] = [0, 0];
  for (const { part, from, to } of parts) {
    for (const vertex of part.geometry.index.array) index[at++] = base + vertex - from;
    base += to - from;
    const place = new Vector3().setFromMatrixPosition(part.matrix);
    box.union(part.geometry.boundingBox.clone().translate(place));
  }
  made.setIndex(new BufferAttribute(index, 1));
  made.boundingBox = box;
  made.boundingSphere = box.getBoundingSphere(new Sphere());
  const mesh = new Mesh(made, first.material);
  const { material, flat } = first.userData;
  mesh.userData = { material, flat };
  return mesh;
}

function move(points, elements) {
  const [x, y, z] = [elements[12], elements[13], elements[14]];
  if (x === 0 && y === 0 && z === 0) return;
  for (let i = 0; i < points.length; i += 3) {
    points[i] += x;
    points[i + 1] += y;
    points[i + 2] += z;
  }
}
