// The line at the bottom: size, counts, a bar of known length, and where the time went.

import { find, make, say } from './dom.js';
import { bytes, lengths, many, metres, milliseconds } from './format.js';

const STAGES = [
  ['script', 'script'],
  ['rewriting', 'rewriting'],
  ['interpretation', 'interpretation'],
  ['scene', 'scene'],
  ['encode', 'encode'],
  ['load', 'transfer and load'],
  ['draw', 'draw'],
];
const BAR = 110; // pixels that the bar of known length has at most

export function model({ bounds, triangles, instances, modules }) {
  say(find('#size'), bounds ? lengths(bounds.high.map((high, i) => high - bounds.low[i])) : 'nothing drawn');
  say(find('#triangles'), many(triangles, 'triangle'));
  say(find('#instances'), many(instances, 'instance'));
  // A shared page does not know them.
  if (modules !== undefined) say(find('#modules'), many(modules, 'module'));
}

/** `own` are the page's times `{load, draw}`. */
export function times(message, own) {
  const all = { ...message.times, load: own.load, draw: own.draw };
  const total = (message.times.total ?? 0) + own.load + own.draw;
  say(find('#time'), milliseconds(total));
  const stages = STAGES.filter(([key]) => Number.isFinite(all[key]));
  const known = stages.reduce((sum, [key]) => sum + all[key], 0);
  const whole = Math.max(known, total, 1e-9);
  const rest = total - known;
  const rows = stages.map(([key, name]) => [key, name, all[key]]);
  if (rest > 0.5) rows.push(['other', 'other', rest]);
  const band = make(
    'div',
    { class: 'band', 'aria-hidden': 'true' },
    ...rows.map(([key, , ms]) => {
      const part = make('i', { 'data-stage': key });
      part.style.width = `${(ms / whole) * 100}%`;
      return part;
    }),
  );
  const list = rows.flatMap(([key, name, ms]) => [
    make('dt', {}, make('i', { 'data-stage': key }), name),
    make('dd', { text: milliseconds(ms) }),
  ]);
  find('#times').replaceChildren(
    band,
    make(
      'dl',
      {},
      ...list,
      make('dt', { class: 'sum', text: 'in all' }),
      make('dd', { class: 'sum', text: milliseconds(total) }),
    ),
    message.bytes ? make('p', { class: 'where', text: `${bytes(message.bytes)} sent` }) : '',
  );
  return total;
}

/** The bar: the longest of 1, 2 or 5 times a power of ten that fits. */
export function scale(camera, pixels) {
  const pixel = (2 * camera.reach) / pixels;
  const most = pixel * BAR;
  const power = 10 ** Math.floor(Math.log10(most));
  const length = [5, 2, 1].map((it) => it * power).find((it) => it <= most) ?? power;
  const place = find('#scale');
  place.firstElementChild.style.width = `${length / pixel}px`;
  say(place.lastElementChild, label(length));
}

export function label(length) {
  if (length >= 1000) return `${metres(length / 1000)} km`;
  if (length >= 0.995) return `${metres(length)} m`;
  if (length >= 0.00995) return `${metres(length * 100)} cm`;
  return `${metres(length * 1000)} mm`;
}
