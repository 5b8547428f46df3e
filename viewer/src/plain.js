// Surfaces of frames that must come soon on machines without a graphics card: light is found for each vertex, not for
// each pixel, and there are no shadows and highlights. Otherwise they look like the materials they stand for.

import { Color, ShaderMaterial, UniformsLib, UniformsUtils, Vector3 } from 'three';

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
#include <clipping_planes_pars_vertex>
#include <fog_pars_vertex>
#include <tonemapping_pars_fragment>
uniform vec3 sun, up, bright, middle, above;
${VARYINGS}
#ifdef PICTURE
varying vec2 at;
#endif
#ifdef DIRTY
attribute vec2 uv1;
varying vec2 second;
#endif

// sRGB by square roots, which cost less than powers; off by 2.5 of 255 near black and by less elsewhere.
vec3 encoded(vec3 color) {
  vec3 a = sqrt(color), b = sqrt(a), c = sqrt(b);
  return max(0.662002687 * a + 0.68412206 * b - 0.323583601 * c - 0.022541147 * color, 0.0);
}

vec3 seen(vec3 normal) {
  vec3 light = middle + above * dot(normal, up) + bright * max(dot(normal, sun), 0.0);
#ifdef PICTURE
  return light;
#elif defined(DIRTY)
  return light;
#else
  return encoded(CustomToneMapping(light));
#endif
}

void main() {
  #include <beginnormal_vertex>
  #include <defaultnormal_vertex>
  #include <begin_vertex>
  #include <project_vertex>
  #include <clipping_planes_vertex>
  #include <fog_vertex>
  vec3 facing = normalize(transformedNormal);
  front = seen(facing);
#ifdef DOUBLE_SIDED
  back = seen(-facing);
#endif
#ifdef PICTURE
  at = uv;
#endif
#ifdef DIRTY
  second = uv1;
#endif
}`;

const FRAGMENT = /* glsl */ `
#include <common>
#include <clipping_planes_pars_fragment>
#include <fog_pars_fragment>
uniform float opacity;
${VARYINGS}
#if defined(PICTURE) || defined(DIRTY)
uniform vec3 emissive;
uniform float least;
#endif
#ifdef PICTURE
uniform sampler2D map;
varying vec2 at;
#endif
#ifdef DIRTY
uniform sampler2D dirt;
varying vec2 second;
#endif

void main() {
  #include <clipping_planes_fragment>
  vec4 color = vec4(front, opacity);
#ifdef DOUBLE_SIDED
  if (!gl_FrontFacing) color.rgb = back;
#endif
#ifdef PICTURE
  color *= texture2D(map, at);
#endif
#ifdef DIRTY
  color.rgb *= texture2D(dirt, second).rgb;
#endif
#if defined(PICTURE) || defined(DIRTY)
  if (color.a < least) discard;
  gl_FragColor = vec4(color.rgb + emissive, color.a);
  #include <tonemapping_fragment>
  #include <colorspace_fragment>
#else
  gl_FragColor = color;
#endif
  #include <fog_fragment>
}`;

export class Plain {
  #light;
  #made = new WeakMap();
  #alive = new Set();
  /** Towards the sun and up, as the camera sees them. */
  #seen = { sun: { value: new Vector3() }, up: { value: new Vector3() } };

  /** `light` is that of the fine materials. */
  constructor(light) {
    this.#light = light;
  }

  /** Looks from where `camera` is. */
  follow(camera) {
    this.#seen.sun.value.copy(this.#light.toSun).transformDirection(camera.matrixWorldInverse);
    this.#seen.up.value.set(0, 1, 0).transformDirection(camera.matrixWorldInverse);
  }

  /** What stands for `material`; it goes when that goes. */
  of(material) {
    if (!this.#made.has(material)) {
      const made = plain(material, this.#light, this.#seen);
      this.#alive.add(made);
      material.addEventListener('dispose', () => {
        made.dispose();
        this.#alive.delete(made);
      });
      this.#made.set(material, made);
    }
    return this.#made.get(material);
  }

  /** Lets go of all, since the light has changed that is in them. */
  renew() {
    for (const made of this.#alive) made.dispose();
    this.#alive.clear();
    this.#made = new WeakMap();
  }
}

function plain(material, { sky, sun }, seen) {
  const { map, aoMap: dirt, color, metalness, emissiveIntensity, opacity, alphaTest } = material;
  const { side, transparent, depthWrite, defines } = material;
  // Whatever is the same for all vertices is multiplied here: each of them has a price.
  const surface = new Color().copy(color).multiplyScalar((1 - metalness) / Math.PI);
  const lit = (light, own) => new Color().copy(own).multiplyScalar(light.intensity).multiply(surface);
  const [high, low] = [lit(sky, sky.color), lit(sky, sky.groundColor)];
  const middle = high.clone().add(low).multiplyScalar(0.5);
  const pictured = map || dirt;
  const emissive = new Color().copy(material.emissive).multiplyScalar(emissiveIntensity);
  return new ShaderMaterial({
    vertexShader: VERTEX,
    fragmentShader: FRAGMENT,
    defines: { ...defines, ...(map && { PICTURE: '' }) },
    uniforms: {
      ...UniformsUtils.clone(UniformsLib.fog),
      ...seen,
      bright: { value: lit(sun, sun.color) },
      middle: { value: pictured ? middle : middle.add(emissive) },
      above: { value: high.sub(low).multiplyScalar(0.5) },
      map: { value: map },
      dirt: { value: dirt },
      emissive: { value: emissive },
      opacity: { value: opacity },
      least: { value: alphaTest },
    },
    side,
    transparent,
    depthWrite,
    clipping: true,
    fog: true,
    toneMapped: Boolean(pictured),
  });
}
