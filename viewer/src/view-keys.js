// The keys of the view, which all pages have.

import { VIEWS } from './camera.js';

const TURN = Math.PI / 36;

/** `view` is what `tools` returns; `rows` are for the sheet, `more` keys that another row speaks of. */
export function viewKeys(stage, view) {
  const arrow = (azimuth, elevation, x, y) => (event) => {
    if (!stage) return;
    if (event.shiftKey) stage.camera.pan(x * 0.05, y * 0.05);
    else stage.camera.rotate(azimuth * TURN, elevation * TURN);
  };
  return {
    rows: [
      ['F', 'Fit the model', ['f'], () => view.fit()],
      ...Object.keys(VIEWS).map((name, i) => [
        `${i + 1}`,
        name === 'iso' ? 'Isometric' : `From the ${name}`,
        [`${i + 1}`],
        () => view.look(name),
      ]),
      ['O', 'Perspective or parallel', ['o'], () => view.project()],
      ['W', 'Next shading', ['w'], view.nextMode],
      ['G', 'Grid', ['g'], view.toggleGrid],
      ['← → ↑ ↓', 'Turn', ['ArrowLeft'], arrow(1, 0, -1, 0)],
      ['⇧ ← →', 'Move', ['ArrowRight'], arrow(-1, 0, 1, 0)],
      ['+ −', 'Nearer, farther', ['+', '='], () => stage?.camera.zoom(1 / 1.15)],
    ],
    more: {
      ArrowUp: arrow(0, 1, 0, 1),
      ArrowDown: arrow(0, -1, 0, -1),
      '-': () => stage?.camera.zoom(1.15),
    },
  };
}
