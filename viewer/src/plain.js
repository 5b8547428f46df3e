// Surfaces of frames that must come soon on machines without a graphics card: light is found for each vertex, not for
// each pixel, and there are no shadows and highlights. Otherwise they look like the materials they stand for.

import { Color, ShaderMaterial } from 'three';
import { SUN } from './light.js';

const VARYINGS = /* glsl */ `
#ifdef FACETED
#define EACH flat varying
#else
#define EACH varying
#endif
EACH vec3 front;
#ifdef DOUBLE_SIDED
EACH vec3 back;
#endif`;

const VERTEX = /* glsl */ `
#include <common>
#include <tonemapping_pars_fragment>
uniform vec3 diffuse, emissive, sun, sunColor, skyColor, groundColor;
${VARYINGS}
#ifdef PICTURE
varying vec2 at;
#endif

// sRGB by square roots, which cost less than powers; off by 2.5 of 255 near black and by less elsewhere.
vec3 encoded(vec3 color) {
  vec3 a = sqrt(color), b = sqrt(a), c = sqrt(b);
  return max(0.662002687 * a + 0.68412206 * b - 0.323583601 * c - 0.022541147 * color, 0.0);
}

vec3 seen(vec3 normal) {
  vec3 up = viewMatrix[1].xyz;
  vec3 light = mix(groundColor, skyColor, 0.5 + 0.5 * dot(normal, up));
  light += sunColor * max(dot(normal, (viewMatrix * vec4(sun, 0.0)).xyz), 0.0);
  light *= RECIPROCAL_PI * diffuse;
#ifdef PICTURE
  return light;
#else
  return encoded(CustomToneMapping(light + emissive));
#endif
}

void main() {
  #include <beginnormal_vertex>
  #include <defaultnormal_vertex>
  #include <begin_vertex>
  #include <project_vertex>
  vec3 facing = normalize(transformedNormal);
  front = seen(facing);
#ifdef DOUBLE_SIDED
  back = seen(-facing);
#endif
#ifdef PICTURE
  at = uv;
#endif
}`;

const FRAGMENT = /* glsl */ `
#include <common>
uniform float opacity;
${VARYINGS}
#ifdef PICTURE
uniform sampler2D map;
uniform vec3 emissive;
uniform float least;
varying vec2 at;
#endif

void main() {
  vec4 color = vec4(front, opacity);
#ifdef DOUBLE_SIDED
  if (!gl_FrontFacing) color.rgb = back;
#endif
#ifdef PICTURE
  color *= texture2D(map, at);
  if (color.a < least) discard;
  gl_FragColor = vec4(color.rgb + emissive, color.a);
  #include <tonemapping_fragment>
  #include <colorspace_fragment>
#else
  gl_FragColor = color;
#endif
}`;

export class Plain {
  #light;
  #made = new WeakMap();

  /** `light` is that of the fine materials. */
  constructor({ sky, sun }) {
    const color = ({ intensity }, own) => ({ value: own.clone().multiplyScalar(intensity) });
    this.#light = {
      sun: { value: SUN },
      sunColor: color(sun, sun.color),
      skyColor: color(sky, sky.color),
      groundColor: color(sky, sky.groundColor),
    };
  }

  /** What stands for `material`; it goes when that goes. */
  of(material) {
    if (!this.#made.has(material)) {
      const made = plain(material, this.#light);
      material.addEventListener('dispose', () => made.dispose());
      this.#made.set(material, made);
    }
    return this.#made.get(material);
  }
}

function plain(material, light) {
  const { map, color, metalness, emissive, emissiveIntensity, opacity, alphaTest } = material;
  const { side, transparent, depthWrite, defines } = material;
  return new ShaderMaterial({
    vertexShader: VERTEX,
    fragmentShader: FRAGMENT,
    defines: { ...defines, ...(map && { PICTURE: '' }) },
    uniforms: {
      ...light,
      map: { value: map },
      diffuse: { value: new Color().copy(color).multiplyScalar(1 - metalness) },
      emissive: { value: new Color().copy(emissive).multiplyScalar(emissiveIntensity) },
      opacity: { value: opacity },
      least: { value: alphaTest },
    },
    side,
    transparent,
    depthWrite,
    toneMapped: Boolean(map),
  });
}
