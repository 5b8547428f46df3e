// Triangles shown in the marking colour: of a picked module, or of a line of the script.

import {
  BufferAttribute,
  BufferGeometry,
  DoubleSide,
  InstancedBufferAttribute,
  InstancedMesh,
  Mesh,
  MeshBasicMaterial,
} from 'three';

export class Mark {
  #meshes = [];
  // Seen where nothing is in front; and faintly where something is.
  #front = new MeshBasicMaterial({
    side: DoubleSide,
    transparent: true,
    opacity: 0.72,
    depthWrite: false,
    polygonOffset: true,
    polygonOffsetFactor: -2,
    polygonOffsetUnits: -2,
    toneMapped: false,
  });
  #behind = new MeshBasicMaterial({
    side: DoubleSide,
    transparent: true,
    opacity: 0.12,
    depthWrite: false,
    depthTest: false,
    toneMapped: false,
  });

  theme(dark) {
    for (const material of [this.#front, this.#behind]) material.color.set(dark ? 0xff5c9a : 0xe0246e);
  }

  /** Shows ranges of triangles `{mesh, primitive, from, count, node, instances}`; without `node` and `instances`
   *  wherever the mesh stands. */
  show(model, ranges) {
    this.clear();
    const wanted = new Map();
    for (const range of ranges) {
      const key = `${range.mesh} ${range.primitive}`;
      if (!wanted.has(key)) wanted.set(key, []);
      wanted.get(key).push(range);
    }
    for (const part of model.parts) {
      const { mesh, primitive, node } = part.userData;
      const own = (wanted.get(`${mesh} ${primitive}`) ?? []).filter((range) => (range.node ?? node) === node);
      for (const alike of byInstances(own)) {
        const geometry = pieces(part, alike);
        if (!geometry) continue;
        const instances = part.isInstancedMesh
          ? (alike[0].instances?.filter((i) => i >= 0 && i < part.count) ?? null)
          : null;
        for (const material of [this.#behind, this.#front]) this.#add(model, part, geometry, material, instances);
      }
    }
  }

  clear() {
    for (const mesh of this.#meshes) {
      mesh.removeFromParent();
      if (mesh.isInstancedMesh && mesh.userData.own) mesh.dispose();
      // The points that the model draws belong to it.
      if (!mesh.geometry.userData.own) mesh.geometry.deleteAttribute('position');
      mesh.geometry.dispose();
    }
    this.#meshes = [];
  }

  #add(model, part, geometry, material, instances) {
    let mesh;
    if (part.isInstancedMesh) {
      mesh = new InstancedMesh(geometry, material, 0);
      mesh.userData.own = instances !== null;
      mesh.instanceMatrix = instances ? chosen(part.instanceMatrix, instances) : part.instanceMatrix;
      mesh.count = instances ? instances.length : part.count;
    } else mesh = new Mesh(geometry, material);
    mesh.matrixAutoUpdate = false;
    mesh.frustumCulled = false;
    mesh.renderOrder = 10;
    mesh.matrix.copy(part.matrix);
    model.group.add(mesh);
    this.#meshes.push(mesh);
  }
}

/** The ranges in lists of those that name the same instances. */
function byInstances(ranges) {
  const lists = new Map();
  for (const range of ranges) {
    const key = range.instances ? range.instances.join() : '';
    if (!lists.has(key)) lists.set(key, []);
    lists.get(key).push(range);
  }
  return lists.values();
}

function chosen(all, instances) {
  const some = new Float32Array(instances.length * 16);
  instances.forEach((instance, i) => some.set(all.array.subarray(instance * 16, instance * 16 + 16), i * 16));
  return new InstancedBufferAttribute(some, 16);
}

function pieces({ geometry, parent }, ranges) {
  const index = geometry.index.array;
  const clipped = ranges
    .map(({ from, count }) => [Math.max(0, from) * 3, Math.min(index.length, (from + count) * 3)])
    .filter(([from, to]) => from < to);
  const total = clipped.reduce((sum, [from, to]) => sum + to - from, 0);
  if (total === 0) return null;
  const chosen = new index.constructor(total);
  let at = 0;
  for (const [from, to] of clipped) {
    chosen.set(index.subarray(from, to), at);
    at += to - from;
  }
  const made = new BufferGeometry();
  const { position } = geometry.attributes;
  // A part that is drawn with others has its points on the graphics card among theirs.
  made.userData.own = parent === null;
  made.setAttribute('position', parent ? position : new BufferAttribute(position.array, position.itemSize));
  made.setIndex(new BufferAttribute(chosen, 1));
  return made;
}
