// Dirt maps: pictures by a second set of texture coordinates that multiply the colour of a surface. A file has them as
// occlusion, which darkens the light around, so that other programs show them too.

import { ShaderChunk } from 'three';

const CHANGES = {
  map_fragment: (chunk) => `${chunk}
#if defined( USE_AOMAP ) && defined( DIRTY )
  diffuseColor.rgb *= texture2D( aoMap, vAoMapUv ).rgb;
#endif
`,
  aomap_fragment: (chunk) => `#ifndef DIRTY
${chunk}
#endif
`,
};

for (const [chunk, change] of Object.entries(CHANGES)) {
  if (!ShaderChunk[chunk].includes('texture2D(')) throw new Error(`three.js has changed: ${chunk}`);
  ShaderChunk[chunk] = change(ShaderChunk[chunk]);
}

/** Gives a material the dirt map `picture`. */
export function soil(material, picture) {
  material.aoMap = picture;
  material.defines = { ...material.defines, DIRTY: '' };
}
