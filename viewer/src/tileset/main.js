// The page of a tileset: puts the rooms together.

import { Axes } from '../axes.js';
import { find, make, say } from '../dom.js';
import * as exports_ from '../exports.js';
import { addIcons } from '../icons.js';
import { listen as listenToPointer } from '../pointer.js';
import * as readouts from '../readouts.js';
import { Socket } from '../socket.js';
import { Stage } from '../stage.js';
import * as theme from '../theme.js';
import { toast } from '../toast.js';
import { tools } from '../tools.js';
import { pageKeys } from '../view/page-keys.js';
import { connection } from '../trouble.js';
import { FeatureCard } from './card.js';
import * as list from './missing.js';
import * as panel from './panel.js';
import { Shown } from './shown.js';

addIcons(document);

const address = new URL('socket', location.href);
address.protocol = address.protocol.replace('http', 'ws');
address.hash = '';
const socket = new Socket(address);
const canvas = find('#view');
const state = { hello: null, revision: null, missing: [], progress: null };

let stage = null;
try {
  stage = new Stage(canvas);
} catch {
  find('#stage').classList.add('blind');
  find('#screenshot').hidden = find('#scale').hidden = true;
  find('#stage').append(
    make('p', {
      class: 'no-webgl',
      'data-testid': 'no-webgl',
      text: 'This browser has no WebGL, so the tileset cannot be shown here. The list of missing features works all the same.',
    }),
  );
}

const shown = stage && new Shown(stage, { changed: tell });
const card = stage && new FeatureCard(stage, shown);
const view = tools(stage, () => {}, {
  fit: () => shown?.fit(),
  look: (look) => shown?.fit(false, look),
});

/** Tells what is shown now. */
function tell() {
  find('#track').hidden = !shown.loading;
  find('#track').classList.add('unknown');
  panel.facts({ box: shown.box, counts: shown.counts, triangles: shown.triangles, place: shown.world.place });
  const { settled } = document.documentElement.dataset;
  if (!shown.loading && settled !== state.revision) {
    document.documentElement.dataset.settled = state.revision;
    dispatchEvent(new CustomEvent('burgeon:settled', { detail: { revision: state.revision } }));
  }
}

/** Loads the tileset and the list of what is missing. */
async function load(revision) {
  if (revision === state.revision) return;
  state.revision = revision;
  const url = (name) => new URL(`tileset/${name}`, location.href).href;
  list.missing(url('missing.geojson')).then(
    (found) => {
      state.missing = found.list;
      panel.missing(found, fly);
      shown?.marks.missing(found.list);
    },
    (error) => toast(`missing.geojson cannot be read: ${error.message}`),
  );
  if (!shown) return;
  find('#track').hidden = false;
  find('#track').classList.add('unknown');
  try {
    await shown.load(url('tileset.json'));
    find('#nothing').hidden = shown.counts.of !== 0;
    if (shown.counts.of === 0)
      say(find('#nothing'), 'The tileset has no tiles with content. The list of missing features names the causes.');
  } catch (error) {
    find('#track').hidden = true;
    toast(`the tileset cannot be read: ${error.message}`);
  }
  tell();
}

/** Flies to something missing, and tells why it is. */
function fly(it) {
  if (!shown || !it.place) return;
  shown.fly(it.place, it.ring ? 900 : 260);
  card.missing(it);
}

connection('connecting');
socket.on('open', () => {
  connection('live');
  shown?.retry();
});
socket.on('lost', () => connection('lost'));
socket.on('moved', () => connection('moved'));
socket.on('hello', (hello) => {
  const before = state.hello;
  // A script is shown here now, or another tileset.
  if (hello.tileset === undefined || (before && (before.path !== hello.path || before.version !== hello.version)))
    return location.reload();
  state.hello = hello;
  say(find('#script'), hello.tileset);
  find('#script').title = hello.path;
  document.title = `${hello.tileset} · burgeon`;
  find('.wordmark').title = `burgeon ${hello.version}`;
  panel.making(null);
});
socket.on('tileset', ({ revision }) => load(revision));
socket.on('making', (progress) => panel.making((state.progress = progress)));
socket.on('unknown', ({ text }) => panel.making({ text }));
for (const type of ['note', 'refused']) socket.on(type, ({ text }) => toast(text));

// The view

find('#screenshot').addEventListener('click', () => stage && exports_.screenshot(stage, state.hello?.tileset ?? 'tileset'));

/** Flies down to what is under a pixel. */
function approach(x, y) {
  const leaf = shown.leafAt(x, y);
  const found = shown.at(x, y);
  if (!found) return leaf ? shown.fly(leaf.place, leaf.radius * 3) : undefined;
  // The view turns around a point of the ground.
  const { longitude, latitude } = shown.world.placeOf(found.hit.point);
  shown.fly({ longitude, latitude }, Math.max(stage.camera.distance * 0.4, 60));
}

if (stage) {
  const axes = new Axes(find('#axes'), stage.camera);
  stage.onDraw(() => {
    axes.draw();
    readouts.scale(stage.camera, stage.size[1]);
    if (shown.loading !== !find('#track').hidden) tell();
  });
  listenToPointer(canvas, stage.camera, { clicked: (x, y) => card.pick(x, y), doubled: approach });
}

theme.listen(find('#theme'), () => {
  stage?.theme(theme.dark());
  shown?.marks.theme(theme.dark());
});

pageKeys({
  stage,
  view,
  card,
  mouse: [
    ['drag', 'Turn'],
    ['right drag', 'Move over the ground; also with Shift'],
    ['wheel', 'Fly to the pointer, and back'],
    ['click', 'Which feature is this?'],
    ['double click', 'Fly there'],
  ],
});

/** For tests: to look, not to touch. */
window.burgeon = Object.freeze({
  get revision() {
    return state.revision;
  },
  get counts() {
    return shown && { ...shown.counts, loading: shown.loading, triangles: shown.triangles };
  },
  get missing() {
    return state.missing;
  },
  get progress() {
    return state.progress;
  },
  get camera() {
    return stage && { ...stage.camera.state(), target: stage.camera.target.toArray(), flat: stage.camera.flat };
  },
  get anchor() {
    return shown?.world.place;
  },
  get memory() {
    return stage && { ...stage.renderer.info.memory };
  },
  /** The pixel of the window where a place is seen; null behind the camera. */
  project: (longitude, latitude, height) => stage?.pixel(shown.world.point({ longitude, latitude, height })) ?? null,
});
