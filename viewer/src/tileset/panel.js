// The panel: the tileset in numbers, the progress of its making, and what is missing.

import { find, make, say } from '../dom.js';
import { count, lengths, many } from '../format.js';
import { causes } from './missing.js';

const ROWS = 100; // of a cause that are listed

/** Tells what the page shows. */
export function facts({ box, counts, triangles, place }) {
  const size = { x: box.max.x - box.min.x, y: box.max.z - box.min.z };
  say(find('#size'), box.isEmpty() ? 'nothing drawn' : lengths([size.x, size.y]));
  say(find('#triangles'), many(triangles, 'triangle'));
  say(find('#tiles'), counts.of === null ? many(counts.shown, 'tile') : `${count(counts.shown)} of ${many(counts.of, 'tile')}`);
  say(find('#fact-size'), box.isEmpty() ? '–' : lengths([size.x, size.y]));
  const tiles = find('#fact-tiles');
  tiles.hidden = tiles.previousElementSibling.hidden = counts.of === null;
  say(tiles, count(counts.of ?? 0));
  say(find('#fact-shown'), count(counts.shown));
  say(find('#fact-place'), place ? degrees(place) : '–');
  find('#fact-failed').hidden = counts.failed === 0;
  say(find('#fact-failed'), `${many(counts.failed, 'tile')} cannot be read: burgeon tiles check names the cause`);
}

/** Tells the progress of the processes that make the tiles; `null` if it is not known. */
export function making(progress) {
  find('#making').hidden = progress === null;
  if (progress === null) return;
  const { done, failed, open, part, rate, text } = progress;
  find('#making-bar').hidden = text !== undefined;
  if (text !== undefined) return say(find('#making-text'), text);
  const all = done + failed + open;
  const bar = find('#making-bar');
  bar.firstElementChild.style.width = `${(all ? ((done + failed) / all) * 100 : 100).toFixed(1)}%`;
  bar.classList.toggle('bad', failed > 0);
  const parts = [open ? `${count(done)} of ${many(all, 'tile')} made` : `${many(done, 'tile')} made`];
  if (failed) parts.push(`${count(failed)} failed`);
  if (open) parts.push(`${(part * 100).toFixed(part > 0.99 ? 1 : 0)} % of the work done`);
  if (open && rate) parts.push(`${count(rate)} a minute`);
  say(find('#making-text'), parts.join(' · '));
  say(find('#making-help'), open ? 'burgeon tiles join shows the tiles made since the last join.' : '');
}

/** Lists what is missing; `fly` is called with what is clicked. */
export function missing({ list, whole }, fly) {
  const groups = causes(list);
  const total = list.reduce((sum, it) => sum + (it.features ?? 1), 0);
  find('#missing').hidden = total === 0;
  say(find('#missing-count'), `${count(total)}${whole ? '' : ' and more'}`);
  find('#missing-list').replaceChildren(
    ...groups.map((group, i) =>
      make(
        'details',
        { class: 'cause', 'data-testid': 'cause', open: i === 0 },
        make('summary', {}, make('span', { text: group.cause }), make('b', { text: count(group.features) })),
        make('ul', {}, ...group.list.slice(0, ROWS).map((it) => row(it, fly))),
        group.list.length > ROWS
          ? make('p', { class: 'where', text: `${count(group.list.length - ROWS)} more: missing.csv lists all` })
          : null,
      ),
    ),
    whole ? '' : make('p', { class: 'where', text: 'These are the first ones: missing.csv lists all.' }),
  );
}

function row(it, fly) {
  const text = it.feature || `tile ${it.tile}`;
  const more = it.feature ? it.layer : many(it.features, 'feature');
  if (!it.place) return make('li', {}, make('span', { text }), make('span', { class: 'where', text: `${more}, without a place` }));
  return make(
    'li',
    {},
    make('button', { class: 'place', 'data-testid': 'missing-item', title: 'Fly there', text, onclick: () => fly(it) }),
    make('span', { class: 'where', text: more }),
  );
}

/** A place as people write it. */
export function degrees({ longitude, latitude }) {
  const side = (value, positive, negative) => `${Math.abs(value).toFixed(5)}° ${value < 0 ? negative : positive}`;
  return `${side(latitude, 'N', 'S')}, ${side(longitude, 'E', 'W')}`;
}
