// What a file shows, as meshes of three.js that remember where in the file they come from.

import {
  Box3,
  BufferAttribute,
  BufferGeometry,
  Group,
  InstancedBufferAttribute,
  InstancedMesh,
  Matrix4,
  Mesh,
  Quaternion,
  Sphere,
  Vector3,
} from 'three';
import { faceted } from './faceted.js';
import { depth } from './materials.js';
import { merge } from './merge.js';

const ONE = new Vector3(1, 1, 1);

/** Builds the model; `made` are the file's materials, and `read` reads the geometry of a primitive. */
export function build(glb, made, plain, read = geometry) {
  const model = new Model();
  const { scenes, scene = 0, nodes = [] } = glb.json;
  // Primitives of a mesh may share arrays, which the graphics card then holds once.
  const shared = new Map();
  const attribute = (index) => {
    if (!shared.has(index)) {
      const { normalized = false } = glb.json.accessors[index];
      // What fills the space between items is read too: graphics cards have no attributes of three bytes.
      shared.set(index, new BufferAttribute(glb.array(index), glb.stride(index), normalized));
    }
    return shared.get(index);
  };
  const geometries = (glb.json.meshes ?? []).map((mesh) =>
    mesh.primitives.map((it) => read(glb, it, attribute)),
  );
  model.geometries = new Set(geometries.flat());

  const visit = (index, parent) => {
    const node = nodes[index];
    const matrix = parent.clone().multiply(local(node));
    if (node.mesh !== undefined) {
      const placed = node.extensions?.EXT_mesh_gpu_instancing?.attributes;
      const instances = placed && transforms(glb, placed);
      glb.json.meshes[node.mesh].primitives.forEach((given, primitive) => {
        const material = made[given.material] ?? plain;
        const flat = given.extras?.flat ?? given.attributes.NORMAL === undefined;
        model.add(geometries[node.mesh][primitive], flat ? faceted(material) : material, matrix, instances, {
          node: index,
          mesh: node.mesh,
          primitive,
          flat,
        });
      });
    }
    for (const child of node.children ?? []) visit(child, matrix);
  };

  const { nodes: shown, extras } = scenes?.[scene] ?? {};
  if (extras?.up) model.up = new Vector3(...extras.up);
  let roots = shown ?? [];
  const first = nodes[roots[0]];
  if (roots.length === 1 && first.name === 'origin' && first.translation && first.mesh === undefined) {
    // Far from zero 32-bit floats get coarse, so the page works around the model's own origin.
    model.origin.set(...first.translation);
    roots = first.children ?? [];
  }
  for (const root of roots) visit(root, new Matrix4());
  model.draw();
  return model;
}

export class Model {
  group = new Group();
  /** What the file places, as meshes that are asked and marked, each with `userData` of `{node, mesh, primitive, flat,
   *  material}`. */
  parts = [];
  /** What is seen of the parts: these, or what is cut from them. `userData` then has the numbers of the `triangles` and of
   *  the `instances` that are left. */
  shown = [];
  /** What is drawn of them: the meshes of the group, each with `userData` of `{flat, material}`. */
  meshes = [];
  geometries = new Set();
  box = new Box3();
  /** Where (0, 0, 0) of the group is in the file. */
  origin = new Vector3();
  /** The direction that is up where the model is looked at, if it is not +y. */
  up = null;
  triangles = 0;

  add(geometry, material, matrix, instances, from) {
    const count = instances ? instances.length / 16 : 1;
    let part;
    if (instances) {
      part = new InstancedMesh(geometry, material, 0);
      part.count = count;
      part.instanceMatrix = new InstancedBufferAttribute(instances, 16);
      part.frustumCulled = false;
      const each = new Matrix4();
      for (let i = 0; i < count; i++) {
        this.#include(geometry.boundingBox, each.fromArray(instances, i * 16).premultiply(matrix));
      }
    } else {
      part = new Mesh(geometry, material);
      this.#include(geometry.boundingBox, matrix);
    }
    part.matrixAutoUpdate = false;
    part.matrix.copy(matrix);
    part.userData = { ...from, material };
    this.triangles += (geometry.index.count / 3) * count;
    this.parts.push(part);
  }

  /** Puts what is to be drawn of the parts into the group; `shown` are parts that are cut from them. */
  draw(shown = this.parts) {
    for (const mesh of this.meshes) this.group.remove(mesh);
    const own = new Set(this.parts.map((it) => it.geometry));
    for (const geometry of this.geometries) {
      if (own.has(geometry)) continue;
      geometry.dispose();
      this.geometries.delete(geometry);
    }
    // Another shading may have put its own material there.
    for (const part of shown) part.material = part.userData.material;
    this.shown = shown;
    this.meshes = merge(shown);
    for (const mesh of this.meshes) {
      Object.assign(mesh, { castShadow: true, receiveShadow: true, matrixAutoUpdate: false });
      mesh.customDepthMaterial = depth(mesh.material);
      this.geometries.add(mesh.geometry);
      this.group.add(mesh);
    }
  }

  dispose() {
    for (const part of new Set([...this.parts, ...this.shown])) if (part.isInstancedMesh) part.dispose();
    for (const geometry of this.geometries) geometry.dispose();
    this.group.clear();
  }

  #include(box, matrix) {
    if (box.isEmpty()) return;
    this.box.union(box.clone().applyMatrix4(matrix));
  }
}

/** The geometry of a primitive as it is in the file. */
export function geometry(glb, { attributes, indices }, attribute) {
  const made = new BufferGeometry();
  const { min, max } = glb.json.accessors[attributes.POSITION];
  made.setAttribute('position', attribute(attributes.POSITION));
  if (attributes.NORMAL !== undefined) made.setAttribute('normal', attribute(attributes.NORMAL));
  if (attributes.TEXCOORD_0 !== undefined) made.setAttribute('uv', attribute(attributes.TEXCOORD_0));
  if (attributes.TEXCOORD_1 !== undefined) made.setAttribute('uv1', attribute(attributes.TEXCOORD_1));
  made.setIndex(new BufferAttribute(indices === undefined ? counting(made) : glb.array(indices), 1));
  made.boundingBox = new Box3(new Vector3(...min), new Vector3(...max));
  made.boundingSphere = made.boundingBox.getBoundingSphere(new Sphere());
  return made;
}

function counting(geometry) {
  return Uint32Array.from({ length: geometry.attributes.position.count }, (_, i) => i);
}

function local(node) {
  if (node.matrix) return new Matrix4().fromArray(node.matrix);
  const { translation = [0, 0, 0], rotation = [0, 0, 0, 1], scale = [1, 1, 1] } = node;
  return new Matrix4().compose(new Vector3(...translation), new Quaternion(...rotation), new Vector3(...scale));
}

/** The matrices of all instances, one after another. */
function transforms(glb, { TRANSLATION, ROTATION, SCALE }) {
  const read = (accessor) => (accessor === undefined ? null : glb.array(accessor));
  const [moves, turns, scales] = [read(TRANSLATION), read(ROTATION), read(SCALE)];
  const count = moves ? moves.length / 3 : turns ? turns.length / 4 : scales.length / 3;
  const all = new Float32Array(count * 16);
  const [matrix, move, turn, scale] = [new Matrix4(), new Vector3(), new Quaternion(), ONE.clone()];
  for (let i = 0; i < count; i++) {
    if (moves) move.fromArray(moves, i * 3);
    // Numbers of two bytes are fractions of their largest.
    if (turns) turn.fromArray(turns, i * 4).normalize();
    if (scales) scale.fromArray(scales, i * 3);
    matrix.compose(move, turn, scale).toArray(all, i * 16);
  }
  return all;
}
