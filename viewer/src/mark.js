// Triangles shown in the marking colour: of a picked module, or of a line of the script.

import { BufferAttribute, BufferGeometry, InstancedBufferAttribute, InstancedMesh, Mesh, MeshBasicMaterial } from 'three';

export class Mark {
  #meshes = [];
  // Seen where nothing is in front; and faintly where something is.
  #front = new MeshBasicMaterial({ transparent: true, opacity: 0.72, depthWrite: false, polygonOffset: true, polygonOffsetFactor: -2, polygonOffsetUnits: -2, toneMapped: false });
  #behind = new MeshBasicMaterial({ transparent: true, opacity: 0.16, depthWrite: false, depthTest: false, toneMapped: false });

  theme(dark) {
    for (const material of [this.#front, this.#behind]) material.color.set(dark ? 0xff5c9a : 0xe0246e);
  }

  /** Shows `ranges` of the model; of a mesh that stands in many places only `instance` of `node`, if given. */
  show(model, ranges, { node = null, instance = null } = {}) {
    this.clear();
    const wanted = new Map();
    for (const range of ranges) {
      const key = `${range.mesh} ${range.primitive}`;
      if (!wanted.has(key)) wanted.set(key, []);
      wanted.get(key).push(range);
    }
    for (const part of model.parts) {
      const { mesh, primitive } = part.userData;
      const own = wanted.get(`${mesh} ${primitive}`);
      if (!own || (instance !== null && part.userData.node !== node)) continue;
      const geometry = pieces(part.geometry, own);
      if (!geometry) continue;
      for (const material of [this.#behind, this.#front]) this.#add(model, part, geometry, material, instance);
    }
  }

  clear() {
    for (const mesh of this.#meshes) {
      mesh.removeFromParent();
      if (mesh.isInstancedMesh && mesh.userData.own) mesh.dispose();
      // The points belong to the model.
      mesh.geometry.deleteAttribute('position');
      mesh.geometry.dispose();
    }
    this.#meshes = [];
  }

  #add(model, part, geometry, material, instance) {
    let mesh;
    if (part.isInstancedMesh) {
      mesh = new InstancedMesh(geometry, material, 0);
      const own = instance !== null;
      const all = part.instanceMatrix;
      mesh.userData.own = own;
      mesh.instanceMatrix = own ? new InstancedBufferAttribute(all.array.slice(instance * 16, instance * 16 + 16), 16) : all;
      mesh.count = own ? 1 : part.count;
    } else mesh = new Mesh(geometry, material);
    mesh.matrixAutoUpdate = false;
    mesh.frustumCulled = false;
    mesh.renderOrder = 10;
    mesh.matrix.copy(part.matrix);
    model.group.add(mesh);
    this.#meshes.push(mesh);
  }
}

function pieces(geometry, ranges) {
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
  made.setAttribute('position', geometry.attributes.position);
  made.setIndex(new BufferAttribute(chosen, 1));
  return made;
}
