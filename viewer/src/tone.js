// How light becomes colour on the screen: as it is up to 0.76, above that ever closer to white.
//
// Method: Khronos Group, "PBR Neutral Tone Mapper", 2024, without its offset for reflections at grazing angles: colours
// chosen in a script look as chosen, in the shade too.

import { CustomToneMapping, ShaderChunk } from 'three';

const MAPPING = /* glsl */ `vec3 CustomToneMapping( vec3 color ) {
  color *= toneMappingExposure;
  const float start = 0.76;
  float peak = max( color.r, max( color.g, color.b ) );
  if ( peak < start ) return color;
  float d = 1.0 - start;
  float mapped = 1.0 - d * d / ( peak + d - start );
  color *= mapped / peak;
  float gray = 1.0 - 1.0 / ( 0.15 * ( peak - mapped ) + 1.0 );
  return mix( color, vec3( mapped ), gray );
}`;

/** The mapping for a renderer. */
export function toneMapping() {
  ShaderChunk.tonemapping_pars_fragment = ShaderChunk.tonemapping_pars_fragment.replace('vec3 CustomToneMapping( vec3 color ) { return color; }', MAPPING);
  return CustomToneMapping;
}
