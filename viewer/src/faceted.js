// Flat triangles that take their normal from their last corner, as the server sends them: the corners of a solid are
// then there once, and not once for each face.

import { ShaderChunk } from 'three';

const FLAT = '#ifdef FACETED\nflat\n#endif\n';
const COORDINATE = 'vDirectionalShadowCoord[ i ]';
const COORDINATES = 'varying vec4 vDirectionalShadowCoord[ NUM_DIR_LIGHT_SHADOWS ];';
const SHIFTS = 'flat varying vec4 vDirectionalShadowShift[ NUM_DIR_LIGHT_SHADOWS ];';

// A corner has the normals of the triangles that end with it alone, so nothing else that is found from a normal may be
// mixed between corners either: where a shadow is looked up is shifted along it.
const CHANGES = {
  normal_pars_vertex: ['varying vec3 vNormal;', `${FLAT}varying vec3 vNormal;`],
  normal_pars_fragment: ['varying vec3 vNormal;', `${FLAT}varying vec3 vNormal;`],
  shadowmap_pars_vertex: [COORDINATES, `${COORDINATES}\n#ifdef FACETED\n${SHIFTS}\n#endif\n`],
  shadowmap_vertex: [
    `${COORDINATE} = directionalShadowMatrix[ i ] * shadowWorldPosition;`,
    `#ifdef FACETED
    ${COORDINATE} = directionalShadowMatrix[ i ] * worldPosition;
    vDirectionalShadowShift[ i ] =
      directionalShadowMatrix[ i ] * vec4( shadowWorldNormal * directionalLightShadows[ i ].shadowNormalBias, 0.0 );
    #else
    ${COORDINATE} = directionalShadowMatrix[ i ] * shadowWorldPosition;
    #endif`,
  ],
  shadowmap_pars_fragment: [
    COORDINATES,
    `${COORDINATES}
    #ifdef FACETED
    ${SHIFTS}
    #define SHADOW_COORD( light ) ( vDirectionalShadowCoord[ light ] + vDirectionalShadowShift[ light ] )
    #else
    #define SHADOW_COORD( light ) vDirectionalShadowCoord[ light ]
    #endif`,
  ],
  lights_fragment_begin: [COORDINATE, 'SHADOW_COORD( UNROLLED_LOOP_INDEX )'],
};

for (const [chunk, [from, to]] of Object.entries(CHANGES)) {
  if (!ShaderChunk[chunk].includes(from)) throw new Error(`three.js has changed: ${chunk}`);
  ShaderChunk[chunk] = ShaderChunk[chunk].replace(from, to);
}

const made = new WeakMap();

/** `material` for such triangles; it goes when that goes. */
export function faceted(material) {
  if (!made.has(material)) {
    const flat = material.clone();
    // These are not copied, and a theme's colour holds for both.
    const { color, defines, onBeforeCompile, customProgramCacheKey } = material;
    Object.assign(flat, { defines: { ...defines, FACETED: '' }, onBeforeCompile, customProgramCacheKey }, color && { color });
    material.addEventListener('dispose', () => flat.dispose());
    made.set(material, flat);
  }
  return made.get(material);
}
