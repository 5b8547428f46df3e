// A shared page: the model and its recipe are in the file, and nothing else is asked for.

import { Axes } from '../axes.js';
import { firstView } from '../camera.js';
import { find, make, say } from '../dom.js';
import * as exports_ from '../exports.js';
import { Glb } from '../glb.js';
import { addIcons } from '../icons.js';
import { Materials } from '../materials.js';
import { Model, build } from '../model.js';
import { listen as listenToPointer } from '../pointer.js';
import * as readouts from '../readouts.js';
import { Stage } from '../stage.js';
import * as theme from '../theme.js';
import { Ticks } from '../ticks.js';
import { toast } from '../toast.js';
import { tools } from '../tools.js';
import { pageKeys } from '../view/page-keys.js';
import { unpack } from '../unpack.js';
import { PickedCard } from './card.js';
import * as content from './content.js';
import * as recipe from './recipe.js';

addIcons(document);

const facts = content.facts();
const canvas = find('#view');
say(find('#script'), facts.name);
document.title = `${facts.name} · burgeon`;
find('.wordmark').title = `burgeon ${facts.program}`;
readouts.model(facts);
recipe.show(facts);

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
      text: 'This browser has no WebGL, so the model cannot be shown here. The script and its values can be read all the same.',
    }),
  );
}

const view = tools(stage, () => {});
const card = stage && new PickedCard(stage, facts.features ?? {});
let glb = null;

/** Reads the model in the file and shows it. */
async function load() {
  const file = content.model();
  find('#nothing').hidden = Boolean(file);
  if (!file) return say(find('#nothing'), 'The script draws nothing.');
  if (!stage) return;
  glb = new Glb(file);
  await unpack(glb);
  const materials = new Materials(stage.slow);
  const { made, keep } = await materials.of(glb);
  const model = build(glb, made, materials.plain);
  stage.swap(model ?? new Model(), () => {});
  keep();
  view.showGrid();
  stage.camera.go(stage.camera.fitted(model.box, ...Object.values(firstView(model.box, model.up))), true);
  document.documentElement.dataset.drawn = 'yes';
  dispatchEvent(new CustomEvent('burgeon:drawn'));
}

load().catch((error) => {
  find('#nothing').hidden = false;
  say(find('#nothing'), `The model in this file cannot be read: ${error.message}. Get an unchanged copy of the file.`);
});

find('#screenshot').addEventListener('click', () => stage && exports_.screenshot(stage, facts.name));

if (stage) {
  const axes = new Axes(find('#axes'), stage.camera);
  const ticks = new Ticks(find('#ticks'), stage);
  stage.onDraw(() => {
    axes.draw();
    ticks.draw();
    readouts.scale(stage.camera, stage.size[1]);
  });
  listenToPointer(canvas, stage.camera, {
    clicked: (x, y) => glb && card.pick(x, y, glb),
    doubled: (x, y) => {
      const hit = stage.at(x, y);
      if (hit) stage.camera.go({ target: hit.point });
    },
  });
}

theme.listen(find('#theme'), () => stage?.theme(theme.dark()));

pageKeys({
  stage,
  view,
  card,
  mouse: [
    ['drag', 'Turn'],
    ['right drag', 'Move; also with Shift'],
    ['wheel', 'Zoom to the pointer'],
    ['click', 'What is this?'],
    ['double click', 'Turn around this point'],
  ],
});

addEventListener('unhandledrejection', ({ reason }) => toast(String(reason?.message ?? reason)));

/** For tests: to look, not to touch. */
window.burgeon = Object.freeze({
  facts,
  get camera() {
    return stage && { ...stage.camera.state(), target: stage.camera.target.toArray(), flat: stage.camera.flat };
  },
  /** The pixel of the window where a point of the scene (m, z up) is seen; null behind the camera. */
  project: (point) => stage?.pixel(stage.inside(point)) ?? null,
});
