// Downloads: the model in the formats of `run`, and a picture of the view.

import { find, make } from './dom.js';
import { background } from './theme.js';

const ABOUT = {
  glb: 'glTF 2.0, one file',
  gltf: 'glTF 2.0, as text',
  obj: 'Wavefront OBJ',
  png: 'picture from here, with soft shadows',
  svg: 'architectural drawing',
  x3d: 'X3D 3.3, for x3dom',
};

export function name(script) {
  return (script || 'model').replace(/^.*[\\/]/, '').replace(/\.[^.]*$/, '') || 'model';
}

/** Fills the menu; `camera` may be missing. */
export function fill(place, { script, formats }, camera, size) {
  const degrees = (angle) => ((angle * 180) / Math.PI).toFixed(1);
  place.replaceChildren(
    ...formats.map((format) => {
      let address = `export/${encodeURIComponent(name(script))}.${format}`;
      if (camera && (format === 'png' || format === 'svg')) {
        const azimuth = ((camera.azimuth * 180) / Math.PI + 36000) % 360;
        address += `?azimuth=${azimuth.toFixed(1)}&elevation=${degrees(camera.elevation)}`;
        if (format === 'png') address += `&width=${Math.round(size[0] * 2)}&height=${Math.round(size[1] * 2)}`;
      }
      return make(
        'a',
        { role: 'menuitem', href: address, download: '', 'data-testid': `export-${format}` },
        make('b', { text: `.${format}` }),
        make('span', { text: ABOUT[format] ?? '' }),
      );
    }),
  );
}

export async function screenshot(stage, script) {
  const picture = await stage.picture(background());
  const address = URL.createObjectURL(picture);
  const link = make('a', { href: address, download: `${name(script)}-view.png` });
  link.click();
  setTimeout(() => URL.revokeObjectURL(address), 10_000);
  find('#screenshot').blur();
}
