// The tools over the picture: shading, fit, standard views, projection, grid. `stage` is null without WebGL.

import { VIEWS, view } from './camera.js';
import { find, make } from './dom.js';
import { changeIcon, icon } from './icons.js';
import { menu } from './menu.js';
import { MODES } from './shading.js';

const MODE_NAMES = {
  lit: 'Lit',
  wire: 'Wireframe',
  normals: 'Normals; red where a face is seen from behind',
  uv: 'Texture coordinates',
};

/** Fills the toolbar and returns what its buttons do, for the keys; `changed` is called with each new shading mode. `own` may
 *  have a page's way to `fit` the model, and to `look` at it from an azimuth and an elevation. */
export function tools(stage, changed, own = {}) {
  for (const [i, mode] of MODES.entries()) {
    const input = make('input', {
      type: 'radio',
      name: 'mode',
      value: mode,
      checked: i === 0,
      'data-testid': `mode-${mode}`,
      'aria-label': MODE_NAMES[mode],
      onchange: () => setMode(mode),
    });
    find('#modes').append(make('label', { title: `${MODE_NAMES[mode]} (W)` }, input, make('span', {}, icon(mode))));
  }

  function setMode(mode) {
    find(`[data-testid=mode-${mode}]`).checked = true;
    if (!stage) return;
    stage.mode = mode;
    changed(mode);
  }

  function fit() {
    if (own.fit) return own.fit();
    if (stage && !stage.model.box.isEmpty()) stage.camera.go(stage.camera.fitted(stage.model.box));
  }

  function look(name) {
    if (!stage) return;
    const { azimuth, elevation } = view(name);
    if (own.look) return own.look({ azimuth, elevation });
    stage.camera.go(
      stage.model.box.isEmpty() ? { azimuth, elevation } : stage.camera.fitted(stage.model.box, azimuth, elevation),
    );
  }

  function project(flat = !stage?.camera.flat) {
    if (!stage || stage.camera.flat === flat) return;
    stage.camera.flat = flat;
    find('#projection').setAttribute('aria-pressed', String(stage.camera.flat));
    changeIcon(find('#projection'), stage.camera.flat ? 'orthographic' : 'perspective');
    stage.invalidate();
  }

  function toggleGrid() {
    if (!stage) return;
    stage.ground.visible = !stage.ground.visible;
    showGrid();
    stage.invalidate();
  }

  /** A new model may stand on no ground. */
  const showGrid = () => find('#grid').setAttribute('aria-pressed', String(stage.ground.visible));

  const nextMode = () => setMode(MODES[(MODES.indexOf(find('[name=mode]:checked').value) + 1) % MODES.length]);

  find('#fit').addEventListener('click', fit);
  find('#projection').addEventListener('click', () => project());
  find('#grid').addEventListener('click', toggleGrid);
  find('#views-menu').prepend(
    ...Object.keys(VIEWS).map((name, i) =>
      make(
        'button',
        { role: 'menuitem', 'data-testid': `view-${name}`, onclick: () => look(name) },
        make('span', { text: name }),
        make('kbd', { text: i + 1 }),
      ),
    ),
  );
  menu(find('#views'), find('#views-menu'));
  return { fit, look, project, nextMode, toggleGrid, showGrid };
}
