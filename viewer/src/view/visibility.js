// Parts of the model that are hidden, or that alone are seen: what is drawn and picked is cut from the model's own parts.

import { Box3, BufferAttribute, BufferGeometry, InstancedBufferAttribute, InstancedMesh, Matrix4, Mesh, Vector3 } from 'three';

/** What is left of `model`'s parts. `only` are ranges of triangles that alone are seen, or null; `hidden` are others. */
export function cutParts(model, only, hidden) {
  const wanted = only && byPart(only);
  const away = byPart(hidden);
  return model.parts.flatMap((part) => {
    const own = (ranges) => rangesOf(part, ranges);
    return cutPart(part, wanted && own(wanted), own(away));
  });
}

/** The box around ranges of triangles of `model`. */
export function boxOf(model, ranges) {
  const box = new Box3();
  const known = byPart(ranges);
  const [point, matrix] = [new Vector3(), new Matrix4()];
  for (const part of model.parts) {
    for (const range of rangesOf(part, known)) {
      const { array } = part.geometry.index;
      const [from, to] = [Math.max(range.from, 0) * 3, Math.min((range.from + range.count) * 3, array.length)];
      if (from >= to) continue;
      const own = new Box3();
      if (to - from === array.length) own.copy(part.geometry.boundingBox);
      else for (let i = from; i < to; i++) own.expandByPoint(point.fromBufferAttribute(part.geometry.attributes.position, array[i]));
      if (!part.isInstancedMesh) box.union(own.applyMatrix4(part.matrix));
      else
        for (const instance of instancesOf(part, range))
          box.union(own.clone().applyMatrix4(matrix.fromArray(part.instanceMatrix.array, instance * 16).premultiply(part.matrix)));
    }
  }
  return box;
}

function byPart(ranges) {
  const known = new Map();
  for (const range of ranges) {
    const key = `${range.mesh} ${range.primitive}`;
    if (!known.has(key)) known.set(key, []);
    known.get(key).push(range);
  }
  return known;
}

function rangesOf({ userData: { mesh, primitive, node } }, known) {
  return (known.get(`${mesh} ${primitive}`) ?? []).filter((range) => (range.node ?? node) === node);
}

const instancesOf = (part, { instances }) =>
  instances ? instances.filter((i) => i >= 0 && i < part.count) : Array.from({ length: part.count }, (_, i) => i);

function cutPart(part, only, hidden) {
  if (only === null && hidden.length === 0) return [part];
  if (only?.length === 0) return [];
  if (!part.isInstancedMesh) {
    const left = triangles(part.geometry, only, hidden);
    return left === null ? [part] : left.length ? [solid(part, left)] : [];
  }
  // Instances of which the same is left are drawn together.
  const of = new Map();
  const note = (ranges, name) => {
    for (const range of ranges ?? [])
      for (const i of instancesOf(part, range)) {
        if (!of.has(i)) of.set(i, { only: only && [], hidden: [] });
        of.get(i)[name].push(range);
      }
  };
  note(only, 'only');
  note(hidden, 'hidden');
  const groups = new Map();
  const none = { only: only && [], hidden: [] };
  for (let i = 0; i < part.count; i++) {
    const ranges = of.get(i) ?? none;
    const key = JSON.stringify([ranges.only, ranges.hidden].map((all) => all?.map(({ from, count }) => [from, count])));
    if (!groups.has(key)) groups.set(key, { ranges, instances: [] });
    groups.get(key).instances.push(i);
  }
  return [...groups.values()].flatMap(({ ranges, instances }) => {
    const left = triangles(part.geometry, ranges.only, ranges.hidden);
    if (left?.length === 0) return [];
    if (left === null && instances.length === part.count) return [part];
    return [instanced(part, left, instances)];
  });
}

/** The numbers of the triangles that are left; null if all are. */
function triangles(geometry, only, hidden) {
  const total = geometry.index.count / 3;
  const seen = new Uint8Array(total).fill(only ? 0 : 1);
  for (const { from, count } of only ?? []) seen.fill(1, Math.max(from, 0), Math.min(from + count, total));
  for (const { from, count } of hidden) seen.fill(0, Math.max(from, 0), Math.min(from + count, total));
  let number = 0;
  for (const it of seen) number += it;
  if (number === total) return null;
  const left = new Uint32Array(number);
  let at = 0;
  for (let i = 0; i < total; i++) if (seen[i]) left[at++] = i;
  return left;
}

function pieceOf(geometry, left) {
  const index = geometry.index.array;
  const chosen = new index.constructor(left.length * 3);
  for (let i = 0; i < left.length; i++) chosen.set(index.subarray(left[i] * 3, left[i] * 3 + 3), i * 3);
  const piece = new BufferGeometry();
  for (const [name, attribute] of Object.entries(geometry.attributes)) piece.setAttribute(name, attribute);
  piece.setIndex(new BufferAttribute(chosen, 1));
  piece.boundingBox = geometry.boundingBox;
  piece.boundingSphere = geometry.boundingSphere;
  return piece;
}

function solid(part, left) {
  return placed(part, new Mesh(pieceOf(part.geometry, left), part.material), { triangles: left });
}

function instanced(part, left, instances) {
  const geometry = left ? pieceOf(part.geometry, left) : part.geometry;
  const matrices = new Float32Array(instances.length * 16);
  instances.forEach((instance, i) =>
    matrices.set(part.instanceMatrix.array.subarray(instance * 16, instance * 16 + 16), i * 16),
  );
  const mesh = new InstancedMesh(geometry, part.material, 0);
  mesh.count = instances.length;
  mesh.instanceMatrix = new InstancedBufferAttribute(matrices, 16);
  mesh.frustumCulled = false;
  return placed(part, mesh, { triangles: left ?? undefined, instances });
}

function placed(part, mesh, own) {
  mesh.matrixAutoUpdate = false;
  mesh.matrix.copy(part.matrix);
  mesh.userData = { ...part.userData, material: part.userData.material, ...own };
  return mesh;
}
