// The page of `burgeon live`: puts the rooms together.

import { Axes } from './axes.js';
import { firstView } from './camera.js';
import { Card } from './card.js';
import { Changes } from './changes.js';
import { Cut } from './cut.js';
import { Compare } from './view/compare.js';
import { panelButton } from './view/page-keys.js';
import { NamedViews } from './view/named-views.js';
import { Sky } from './view/sky.js';
import { find, make, say } from './dom.js';
import * as exports_ from './exports.js';
import { addIcons } from './icons.js';
import { keep, restore } from './keep.js';
import { History } from './history.js';
import { Loading } from './loading.js';
import { Measure } from './measure.js';
import { closeMenu, menu } from './menu.js';
import { Offer } from './offer.js';
import { Console } from './panels/console.js';
import { PartList } from './panels/part-list.js';
import { Params } from './params.js';
import { Places } from './places.js';
import { listen as listenToPointer } from './pointer.js';
import { Presets } from './presets.js';
import { Profile } from './profile.js';
import * as readouts from './readouts.js';
import { ScriptPane } from './script-pane.js';
import { Seed } from './seed.js';
import { shortcuts } from './shortcuts.js';
import { Socket } from './socket.js';
import { Stage } from './stage.js';
import { Steps } from './steps.js';
import * as theme from './theme.js';
import { Ticks } from './ticks.js';
import { toast } from './toast.js';
import { tools } from './tools.js';
import { Trouble, Working, connection } from './trouble.js';
import { Variations } from './variations.js';

addIcons(document);

const address = new URL('socket', location.href);
address.protocol = address.protocol.replace('http', 'ws');
address.hash = '';
const socket = new Socket(address);
const changes = new Changes(socket);
const canvas = find('#view');
const state = { hello: { script: '', formats: [] }, model: null, failed: null, run: null, fitted: false };

let stage = null;
try {
  stage = new Stage(canvas);
} catch {
  find('#stage').classList.add('blind');
  for (const id of ['#screenshot', '#scale', '#measure', '#cut', '#sky']) find(id).hidden = true;
  find('#stage').append(
    make('p', {
      class: 'no-webgl',
      'data-testid': 'no-webgl',
      text: 'This browser has no WebGL, so the model cannot be shown here. Parameters, errors and exports work all the same.',
    }),
  );
}

const places = new Places(
  socket,
  (file, line) => highlight(file, line),
  () => [...(state.model?.files ?? []), state.hello.script],
);
const params = new Params(changes);
const history = new History(changes);
const presets = new Presets(changes, socket);
const seed = new Seed(changes);
const steps = new Steps(changes);
const trouble = new Trouble(places);
const working = new Working(socket, stage?.slow ?? false);
const profile = new Profile({ places, highlight });
const files = () => [state.hello.script, ...(state.model?.files ?? [])].filter(Boolean);
const pane = new ScriptPane({
  socket,
  files,
  // On a phone there is room for one of them.
  opened: () => log.open && matchMedia('(max-width: 760px)').matches && log.toggle(false),
  still: stage?.slow ?? false,
});
const variations = new Variations({ socket, changes, seed });
const parts = new PartList({ stage, socket, marked: () => (card.open ? card.close() : clearMark()) });
const card = new Card({ stage, socket, places, parts, picking: clearMark, closed: clearMark });
const log = new Console({ go: (file, line) => pane.go(file, line) });
const view = tools(stage, (mode) => {
  // Texture coordinates come only when they are shown.
  if (mode === 'uv' && state.model?.url && !loading.measured) show(state.model);
});
const named = new NamedViews({ stage, socket, project: view.project });
const sky = new Sky(stage);
const compare = stage && new Compare(stage);
const measure = stage && new Measure(stage);
const cut = stage && new Cut(stage);
const offer = stage && new Offer(stage, () => view.fit());
const loading = stage && new Loading(stage, (part) => working.download(part));

function highlight(file, line, again = false) {
  state.marked = { file, line };
  socket.ask({ type: 'highlight', file, line }, (answer) => {
    if (answer.type === 'refused') {
      clearMark();
      return profile.refused(answer.text);
    }
    profile.highlighted(answer);
    stage?.mark.show(stage.model, answer.ranges ?? []);
    stage?.invalidate();
    if (!answer.ranges?.length && !again) toast(`${answer.file}:${answer.line} makes nothing in this model`);
  });
}

function clearMark() {
  state.marked = null;
  stage?.mark.clear();
  stage?.invalidate();
  profile.highlighted(null);
}

// The model

async function show(message) {
  state.model = message;
  state.failed = null;
  working.stop();
  trouble.clear();
  let own = { load: 0, draw: 0, total: 0 };
  const framed = offer?.framed();
  if (!loading) tell(message);
  else {
    try {
      own = await loading.show(message, () => tell(message));
    } catch (error) {
      stage?.wait(working.busy);
      if (state.model === message) tell(message);
      if (error.name === 'AbortError' || state.model !== message) return;
      // The server keeps only its last few models; on a new connection it tells the present one.
      if (error.status === 404 && state.gone !== message.url) {
        state.gone = message.url;
        return socket.renew();
      }
      // Without a connection, too, the present one comes when it is back.
      return socket.open ? toast(error.message) : undefined;
    }
    if (!own) return;
    // Another run may have begun while this model was on its way.
    stage.wait(working.busy);
    const { marked } = state;
    if (card.open) card.close();
    if (marked) highlight(marked.file, marked.line, true);
    view.showGrid();
    compare.shown();
    parts.show(message, true);
    sky.renew();
    cut.shown();
    measure.clear();
    if (state.fitted) offer.look(framed);
    if (!state.fitted && message.url) {
      state.fitted = true;
      const kept = restore(stage, state.hello.path);
      if (kept?.flat) view.project();
      if (!kept)
        stage.camera.go(stage.camera.fitted(stage.model.box, ...Object.values(firstView(stage.model.box, stage.model.up))), true);
    }
  }
  const ms = readouts.times(message, own);
  state.run = message.run;
  document.documentElement.dataset.run = message.run;
  dispatchEvent(new CustomEvent('burgeon:drawn', { detail: { run: message.run, ms, load: own.load, draw: own.draw } }));
  steps.drawn();
  if (message.cause === 'save') pane.refresh();
}

/** Shows a model, unless it is the one that is shown, of which something more is known now. */
function hear(message) {
  if (message.run !== state.run || message.url !== state.model.url) return show(message);
  state.model = message;
  state.failed = null;
  stop();
  trouble.clear();
  tell(message);
}

/** Shows the values of a model, or those that led to an error after it. */
function tellRequested(message) {
  if (message === state.failed && message.params.length === 0) return;
  params.show(message.params, message.seed);
  seed.show(message.seed);
  history.note(message);
}

/** Tells what is known of a model besides its picture. */
function tell(message) {
  tellRequested(state.failed ?? message);
  variations.params(message.params);
  steps.show(message);
  readouts.model(message);
  profile.show(message);
  parts.show(message, false);
  named.show(message.cameras ?? []);
  presets.choose(message.preset);
  trouble.warnings(message.warnings ?? [], message.notes ?? []);
  trouble.nothing(message.nothing);
  tellProblems(message);
  pane.drawn();
}

/** Marks the problems of a run in the script, and lists them in the console. */
function tellProblems(message) {
  const errors = (message.errors ?? []).map((it) => ({ ...it, severity: 'error' }));
  const warnings = (message.warnings ?? []).map((it) => ({ ...it, severity: 'warning' }));
  const told = (it) => ({ ...it, message: [it.message ?? it.text, it.help].filter(Boolean).join('\n') });
  pane.mark([...errors, ...warnings].map(told));
  const notes = (message.notes ?? []).map((it) => ({ ...it, severity: 'warning' }));
  log.problems([...errors, ...warnings, ...notes]);
}

// Messages

/** Nothing is on its way any more. */
function stop() {
  working.stop();
  stage?.wait(false);
}

connection('connecting');
socket.on('open', () => connection('live'));
socket.on('lost', () => {
  connection('lost');
  stop();
  steps.pause();
});
socket.on('moved', () => connection('moved'));
socket.on('hello', (hello) => {
  // Another script is shown here now, or another page shows it.
  const { path, version } = state.hello;
  if (path && (path !== hello.path || version !== hello.version)) return location.reload();
  state.hello = hello;
  places.editor = hello.editor;
  say(find('#script'), hello.script);
  find('#script').title = hello.path;
  document.title = `${hello.script} · burgeon`;
  find('.wordmark').title = `burgeon ${hello.version}`;
  profile.script = hello.script;
  presets.show(hello.presets ?? []);
  sky.restore(hello.path);
  trouble.aged(hello.stale);
});
socket.on('model', hear);
socket.on('printed', (message) => log.printed(message));
socket.on('working', (message) => {
  stage?.wait(true);
  trouble.again();
  working.start(message);
});
socket.on('progress', (message) => working.progress(message));
socket.on('error', (message) => {
  stop();
  steps.pause();
  trouble.error(message, state.model !== null);
  state.failed = message;
  tellRequested(message);
  tellProblems(message);
  pane.drawn();
  if (message.cause === 'save') pane.refresh();
  document.documentElement.dataset.failed = message.run;
});
socket.on('waiting', (message) => {
  stop();
  trouble.waiting(message, state.model !== null);
});
socket.on('cancelled', ({ stale }) => {
  stop();
  if (!stale) return;
  steps.pause();
  trouble.cancelled(state.model !== null);
});
find('#run-again').addEventListener('click', () => socket.send({ type: 'set', params: {} }));
socket.on('presets', ({ names, chosen }) => presets.show(names, chosen));
for (const type of ['note', 'refused']) socket.on(type, ({ text }) => toast(text));

// The view

menu(find('#time'), find('#times'));
menu(find('#export'), find('#exports'), {
  fill: () => exports_.fill(find('#exports'), state.hello, stage?.camera, stage?.size, sky.picture),
});
find('#screenshot').addEventListener('click', () => stage && exports_.screenshot(stage, state.hello.script));

const togglePanel = panelButton();

if (stage) {
  const axes = new Axes(find('#axes'), stage.camera);
  const ticks = new Ticks(find('#ticks'), stage);
  stage.onDraw(() => {
    axes.draw();
    ticks.draw();
    readouts.scale(stage.camera, stage.size[1]);
    if (state.fitted) keep(stage, state.hello.path);
  });
  listenToPointer(canvas, stage.camera, {
    area: (x) => stage.area(x),
    clicked: (x, y) => (measure.active ? measure.add(x, y) : card.pick(x, y)),
    doubled: (x, y) => {
      const hit = stage.at(x, y);
      if (hit) stage.camera.go({ target: hit.point });
    },
  });
}

theme.listen(find('#theme'), () => {
  stage?.theme(theme.dark());
  sky.renew();
});

// Keys

function escape() {
  if (find('#sheet').open) find('#sheet').close();
  else if (!closeMenu() && !working.cancel()) {
    if (card.open) card.close();
    else if (measure?.active) measure.toggle(false);
    else if (cut?.active) cut.toggle(false);
    else if (compare?.active) compare.toggle(false);
    else if (log.open && find('#console').contains(document.activeElement)) log.toggle(false);
    else if (variations.open && find('#tray').contains(document.activeElement)) variations.toggle(false);
    else if (!find('#line-result').hidden) clearMark();
    else if (variations.open) variations.toggle(false);
    else if (log.open) log.toggle(false);
    else if (document.activeElement !== canvas) canvas.focus();
  }
}

shortcuts({ stage, view, steps, seed, variations, measure, cut, pane, sky, compare, parts, card, log, togglePanel, escape });

/** For tests: to look, not to touch. */
window.burgeon = Object.freeze({
  get run() {
    return state.run;
  },
  get model() {
    return state.model;
  },
  get camera() {
    return stage && { ...stage.camera.state(), target: stage.camera.target.toArray(), flat: stage.camera.flat };
  },
  get memory() {
    return stage && { ...stage.renderer.info.memory, programs: stage.renderer.info.programs.length };
  },
  /** What is seen: the model of `now`, the one `before` the last save, or `both`; and the triangles that are not hidden. */
  get shown() {
    if (!stage) return null;
    const triangles = stage.model.shown.reduce((sum, it) => sum + (it.geometry.index.count / 3) * (it.isInstancedMesh ? it.count : 1), 0);
    return { seen: stage.seen, triangles };
  },
  /** How many meshes the last frame drew, those of shadows among them. */
  get draws() {
    return stage?.renderer.info.render.calls;
  },
  /** The pixel of the window where a point of the scene (m, z up) is seen; null behind the camera. */
  project: (point) => stage?.pixel(stage.inside(point)) ?? null,
});
