// A tile as a model of the page, in the tile's own axes until it is placed, with the features of its triangles.

import { Box3, BufferAttribute, Matrix4 } from 'three';
import { Glb } from '../glb.js';
import { build, geometry } from '../model.js';
import { Attributes } from './attributes.js';
import { facets } from './facets.js';
import { unpack } from '../unpack.js';

const MESH = 'EXT_mesh_features';
const INSTANCES = 'EXT_instance_features';

/** glTF is y up, and tiles are z up. */
const UPRIGHT = new Matrix4().makeRotationX(Math.PI / 2);

/** Reads the tile in `file`, an ArrayBuffer, with `materials` of the page. */
export async function readTile(file, materials) {
  const glb = new Glb(file);
  await unpack(glb);
  const { made, add } = await materials.of(glb);
  add();
  return new Tile(glb, build(glb, made, materials.plain, shape));
}

export class Tile {
  /** What the tile fills in the page. */
  box = new Box3();
  #own;
  #features;

  constructor(glb, model) {
    this.model = model;
    this.bytes = glb.file.byteLength * 2;
    this.attributes = new Attributes(glb);
    this.#own = new Map([...model.parts, ...model.meshes].map((it) => [it, it.matrix.clone()]));
    // Features by mesh and primitive; those of instances by the place of the mesh.
    this.#features = new Map();
    for (const part of model.parts) {
      const { node, mesh, primitive } = part.userData;
      const of = glb.json.meshes[mesh].primitives[primitive];
      const placed = glb.json.nodes[node].extensions?.[INSTANCES]?.featureIds?.[0];
      const own = of.extensions?.[MESH]?.featureIds?.[0];
      const ids = (attributes, info) => info && numbers(glb, attributes?.[`_FEATURE_ID_${info.attribute}`]);
      if (placed) {
        const { attributes } = glb.json.nodes[node].extensions.EXT_mesh_gpu_instancing;
        this.#features.set(part, { table: placed.propertyTable, instances: ids(attributes, placed) });
      } else if (own) {
        const all = ids(of.attributes, own);
        const index = of.indices === undefined ? null : glb.array(of.indices);
        // Most primitives show one feature.
        const one = all && all.every((it) => it === all[0]) ? all[0] : null;
        this.#features.set(part, { table: own.propertyTable, one, triangle: (i) => all?.[index ? index[i * 3] : i * 3] });
      }
    }
  }

  /** Puts the tile to its place in the page; `transform` goes from the tile's axes to geocentric coordinates. */
  place(world, transform) {
    const to = new Matrix4().multiplyMatrices(world.toPage, transform).multiply(UPRIGHT);
    to.multiply(new Matrix4().setPosition(this.model.origin));
    this.box.copy(this.model.box).applyMatrix4(to);
    for (const [mesh, own] of this.#own) {
      mesh.matrix.multiplyMatrices(to, own);
      mesh.matrixWorldNeedsUpdate = true;
    }
  }

  /** The feature that a hit of `nearest` shows: `{table, row, id, layer, values}`, or null. */
  feature({ part, triangle, instance }) {
    const found = this.#features.get(part);
    if (!found) return null;
    const row = found.instances ? found.instances[instance ?? 0] : (found.one ?? found.triangle(triangle));
    const feature = this.attributes.feature(found.table, row);
    return feature && { ...feature, table: found.table, row };
  }

  /** Ranges of triangles for `Mark` that show a feature. */
  ranges({ table, row }) {
    const ranges = [];
    for (const [part, found] of this.#features) {
      if (found.table !== table) continue;
      const { node, mesh, primitive } = part.userData;
      const count = part.geometry.index.count / 3;
      if (found.instances) {
        const instances = [...found.instances.keys()].filter((i) => found.instances[i] === row);
        if (instances.length) ranges.push({ node, mesh, primitive, from: 0, count, instances });
      } else if (found.one !== null) {
        if (found.one === row) ranges.push({ node, mesh, primitive, from: 0, count });
      } else
        for (let from = 0; from < count; from++)
          if (found.triangle(from) === row) ranges.push({ node, mesh, primitive, from, count: 1 });
    }
    return ranges;
  }

  dispose() {
    this.model.dispose();
  }
}

/** The geometry of a primitive; flat triangles come without normals. */
function shape(glb, primitive, attribute) {
  const { attributes, indices } = primitive;
  if (attributes.NORMAL !== undefined) return geometry(glb, primitive, attribute);
  const values = (index, size) => {
    const given = attribute(index);
    if (given.array instanceof Float32Array && given.itemSize === size) return given.array;
    const all = new Float32Array(given.count * size);
    for (let i = 0; i < given.count; i++)
      for (let k = 0; k < size; k++) all[i * size + k] = given.getComponent(i, k);
    return all;
  };
  const points = values(attributes.POSITION, 3);
  const uv = attributes.TEXCOORD_0 === undefined ? null : values(attributes.TEXCOORD_0, 2);
  const index = indices === undefined ? Uint32Array.from({ length: points.length / 3 }, (_, i) => i) : glb.array(indices);
  const made = facets(points, uv, index);
  made.computeBoundingBox();
  made.computeBoundingSphere();
  return made;
}

function numbers(glb, accessor) {
  if (accessor === undefined) return null;
  const all = new BufferAttribute(glb.array(accessor), glb.stride(accessor));
  return Float32Array.from({ length: all.count }, (_, i) => all.getX(i));
}
