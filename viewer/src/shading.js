// The ways to show surfaces: lit, as wires, by their normals, by their texture coordinates.

import {
  CanvasTexture,
  DoubleSide,
  InstancedMesh,
  LinearMipmapLinearFilter,
  Mesh,
  MeshBasicMaterial,
  MeshLambertMaterial,
  MeshNormalMaterial,
  RepeatWrapping,
  SRGBColorSpace,
} from 'three';
import { faceted } from './faceted.js';

export const MODES = ['lit', 'wire', 'normals', 'uv'];

export class Shading {
  mode = 'lit';
  #wires = [];
  #under = new MeshLambertMaterial({
    color: 0x9aa2aa,
    side: DoubleSide,
    polygonOffset: true,
    polygonOffsetFactor: 1,
    polygonOffsetUnits: 1,
  });
  #line = new MeshBasicMaterial({ wireframe: true, toneMapped: false, transparent: true, opacity: 0.5 });
  #normals = byNormal(true);
  #normalsBoth = byNormal(false);
  #checker = new MeshLambertMaterial({ side: DoubleSide });
  #bare = new MeshLambertMaterial({ color: 0x8d949b, side: DoubleSide });

  theme(dark) {
    this.#under.color.set(dark ? 0x4b535b : 0xb9bfc4);
    this.#line.color.set(dark ? 0xbfd8cc : 0x24463a);
  }

  /** Shows models in the mode of now. */
  apply(...models) {
    this.clear();
    if (this.mode === 'uv') this.#checker.map ??= checker();
    for (const model of models)
      for (const part of model.meshes) {
        part.material = this.#of(part);
        if (this.mode === 'wire') this.#addWire(model, part);
      }
  }

  /** Shows lit surfaces by `plain`'s materials, or by their own if that is null. */
  plainly(model, plain) {
    if (this.mode !== 'lit') return;
    for (const part of model.meshes) {
      const { material } = part.userData;
      part.material = plain ? plain.of(material) : material;
    }
  }

  clear() {
    for (const wire of this.#wires) wire.removeFromParent();
    this.#wires = [];
  }

  #of(part) {
    const { material, flat } = part.userData;
    if (this.mode === 'lit') return material;
    const shown = this.#instead(part, material);
    return flat ? faceted(shown) : shown;
  }

  #instead(part, material) {
    if (this.mode === 'wire') return this.#under;
    if (this.mode === 'normals') return material.side === DoubleSide ? this.#normalsBoth : this.#normals;
    return part.geometry.attributes.uv ? this.#checker : this.#bare;
  }

  #addWire(model, part) {
    const wire = part.isInstancedMesh
      ? new InstancedMesh(part.geometry, this.#line, 0)
      : new Mesh(part.geometry, this.#line);
    if (part.isInstancedMesh)
      Object.assign(wire, { count: part.count, instanceMatrix: part.instanceMatrix, frustumCulled: false });
    wire.matrixAutoUpdate = false;
    wire.matrix.copy(part.matrix);
    model.group.add(wire);
    this.#wires.push(wire);
  }
}

/** Colours by the normal in the scene (x red, y green, z blue); with `inside` red where a face is seen from its back. */
function byNormal(inside) {
  const material = new MeshNormalMaterial({ side: DoubleSide });
  material.onBeforeCompile = (shader) => {
    const color =
      'vec3 n = normalize( ( vec4( normal, 0.0 ) * viewMatrix ).xyz );\n  vec3 shown = vec3( n.x, -n.z, n.y ) * 0.5 + 0.5;\n';
    const back = inside ? '  if ( ! gl_FrontFacing ) shown = vec3( 0.9, 0.08, 0.2 );\n' : '';
    shader.fragmentShader = shader.fragmentShader
      .replace('gl_FragColor = ', `${color}${back}  gl_FragColor = `)
      .replace('normalize( normal ) * 0.5 + 0.5', 'shown');
  };
  material.customProgramCacheKey = () => `by normal ${inside}`;
  return material;
}

/** One repetition of a texture: 4 by 4 fields with a letter and a number, so that turns and mirroring show. */
function checker() {
  const canvas = document.createElement('canvas');
  canvas.width = canvas.height = 512;
  const draw = canvas.getContext('2d');
  draw.textAlign = 'center';
  draw.textBaseline = 'middle';
  draw.font = '600 44px system-ui, sans-serif';
  for (let y = 0; y < 4; y++) {
    for (let x = 0; x < 4; x++) {
      draw.fillStyle = `hsl(${x * 36 + 150}, ${(x + y) % 2 ? 32 : 18}%, ${(x + y) % 2 ? 46 : 84}%)`;
      draw.fillRect(x * 128, y * 128, 128, 128);
      draw.fillStyle = (x + y) % 2 ? '#ffffffd0' : '#2a3a35c0';
      draw.fillText(`${'ABCD'[x]}${4 - y}`, x * 128 + 64, y * 128 + 66);
    }
  }
  const texture = new CanvasTexture(canvas);
  texture.flipY = false;
  texture.wrapS = texture.wrapT = RepeatWrapping;
  texture.minFilter = LinearMipmapLinearFilter;
  texture.colorSpace = SRGBColorSpace;
  texture.anisotropy = 8;
  return texture;
}
