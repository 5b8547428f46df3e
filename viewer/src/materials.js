// Materials that live from model to model, so that a reload compiles no shaders and uploads no picture twice.

import {
  DoubleSide,
  FrontSide,
  LinearFilter,
  LinearMipmapLinearFilter,
  MeshDepthMaterial,
  MeshStandardMaterial,
  RepeatWrapping,
  SRGBColorSpace,
  Texture,
} from 'three';
import { soil } from './dirt.js';

export class Materials {
  #materials = new Map();
  #textures = [];

  /** `dull`: there are no reflections, without which metal would be black. */
  constructor(dull) {
    this.dull = dull;
  }

  /** The materials of a file; `keep` lets go of what neither this call nor `also`, an earlier one, has used, and `add` of
   *  nothing. */
  async of(glb) {
    const { materials = [], textures = [] } = glb.json;
    // Normal maps are directions, which are read as they are, and textures are colours.
    const indices = (of) => [...new Set(materials.map(of).filter((index) => index !== undefined))];
    const load = async (of, isColor, set = 0) => {
      const read = (index) => this.#texture(glb.image(textures[index].source), isColor, set);
      return new Map(await Promise.all(indices(of).map(async (index) => [index, await read(index)])));
    };
    const [colorOf, normalOf] = [(it) => it.pbrMetallicRoughness?.baseColorTexture?.index, (it) => it.normalTexture?.index];
    const dirtOf = (it) => it.occlusionTexture?.index;
    const [colors, normals, dirt] = await Promise.all([load(colorOf, true), load(normalOf, false), load(dirtOf, true, 1)]);
    const pictures = [...colors.values(), ...normals.values(), ...dirt.values()];
    const used = new Map();
    const made = materials.map((given) => {
      const own = { picture: colors.get(colorOf(given)), normal: normals.get(normalOf(given)), dirt: dirt.get(dirtOf(given)) };
      const key = JSON.stringify([{ ...given, name: undefined }, own.picture?.id, own.normal?.id, own.dirt?.id]);
      if (!used.has(key)) used.set(key, this.#materials.get(key) ?? material(given, own, this.dull));
      return used.get(key);
    });
    const add = () => used.forEach((it, key) => this.#materials.set(key, it));
    const own = { used, pictures: new Set(pictures) };
    const keep = (also) =>
      this.#keep(new Map([...(also?.used ?? []), ...used]), new Set([...(also?.pictures ?? []), ...pictures]));
    return { ...own, made, add, keep };
  }

  /** A grey of the exporter's own for primitives without a material. */
  plain = new MeshStandardMaterial({ color: 0x999999, roughness: 0.8 });

  async #texture({ bytes, type }, isColor, set) {
    const known = this.#textures.find((it) => it.isColor === isColor && it.set === set && same(it.bytes, bytes));
    if (known) return known.texture;
    const settings = { premultiplyAlpha: 'none', colorSpaceConversion: 'none' };
    const picture = await createImageBitmap(new Blob([bytes], { type }), settings);
    const texture = new Texture(picture);
    texture.flipY = false;
    if (isColor) texture.colorSpace = SRGBColorSpace;
    texture.wrapS = texture.wrapT = RepeatWrapping;
    texture.magFilter = LinearFilter;
    texture.minFilter = LinearMipmapLinearFilter;
    texture.anisotropy = 8;
    texture.channel = set;
    texture.needsUpdate = true;
    this.#textures.push({ bytes: bytes.slice(), isColor, set, texture });
    return texture;
  }

  #keep(used, pictures) {
    for (const [key, material] of this.#materials) if (!used.has(key)) material.dispose();
    this.#materials = used;
    this.#textures = this.#textures.filter(({ texture }) => {
      if (pictures.has(texture)) return true;
      texture.image.close();
      texture.dispose();
      return false;
    });
  }
}

const depths = new WeakMap();

/** What a material with a picture throws its shadow by; it goes when that goes. Nothing for the others: they share the
 *  renderer's own, which would keep the last picture that it had, also when that has gone. */
export function depth(material) {
  if (!material.map) return undefined;
  if (!depths.has(material)) {
    const made = new MeshDepthMaterial();
    material.addEventListener('dispose', () => made.dispose());
    depths.set(material, made);
  }
  return depths.get(material);
}

function material(given, { picture, normal, dirt }, dull) {
  const { baseColorFactor = [1, 1, 1, 1], metallicFactor = 1, roughnessFactor = 1 } = given.pbrMetallicRoughness ?? {};
  const [r, g, b, opacity] = baseColorFactor;
  const made = new MeshStandardMaterial({ roughness: roughnessFactor, metalness: metallicFactor * (dull ? 0.3 : 1) });
  made.color.setRGB(r, g, b);
  made.emissive.setRGB(...(given.emissiveFactor ?? [0, 0, 0]));
  made.emissiveIntensity = given.extensions?.KHR_materials_emissive_strength?.emissiveStrength ?? 1;
  made.side = given.doubleSided ? DoubleSide : FrontSide;
  if (picture) made.map = picture;
  if (normal) {
    made.normalMap = normal;
    // Texture coordinates grow downwards, and the green of a normal map is upwards.
    const scale = given.normalTexture.scale ?? 1;
    made.normalScale.set(scale, -scale);
  }
  if (dirt) soil(made, dirt);
  if (given.alphaMode === 'BLEND') Object.assign(made, { transparent: true, opacity, depthWrite: false });
  if (given.alphaMode === 'MASK') made.alphaTest = given.alphaCutoff ?? 0.5;
  return made;
}

function same(a, b) {
  if (a.length !== b.length) return false;
  for (let i = 0; i < a.length; i++) if (a[i] !== b[i]) return false;
  return true;
}
