// Downloads: the model in the formats that the server offers, and a picture of the view.

import { find, make } from './dom.js';
import { background } from './theme.js';

export function name(script) {
  return (script || 'model').replace(/^.*[\\/]/, '').replace(/\.[^.]*$/, '') || 'model';
}

/** Fills the menu with the formats that the server names; `camera` may be missing, and `light` is that of pictures. */
export function fill(place, { script, formats }, camera, size, light) {
  const degrees = (angle) => ((angle * 180) / Math.PI).toFixed(1);
  place.replaceChildren(
    ...formats.map(({ extension, title, picture }) => {
      let address = `export/${encodeURIComponent(name(script))}.${extension}`;
      if (camera && picture) {
        const azimuth = ((camera.azimuth * 180) / Math.PI + 36000) % 360;
        address += `?azimuth=${azimuth.toFixed(1)}&elevation=${degrees(camera.elevation)}`;
        address += `&width=${Math.round(size[0] * 2)}&height=${Math.round(size[1] * 2)}`;
        for (const [name, value] of Object.entries(light)) address += `&${name}=${value}`;
      }
      return make(
        'a',
        { role: 'menuitem', href: address, download: '', 'data-testid': `export-${extension}` },
        make('b', { text: `.${extension}` }),
        make('span', { text: picture ? `${title}, from here` : title }),
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
