// What each key does.

import { VIEWS } from './camera.js';
import { find } from './dom.js';
import * as keys from './keys.js';

const TURN = Math.PI / 36;

/** `view` is what `tools` returns. */
export function shortcuts({ stage, view, steps, seed, variations, togglePanel, escape }) {
  const arrow = (azimuth, elevation, x, y) => (event) => {
    if (!stage) return;
    if (event.shiftKey) stage.camera.pan(x * 0.05, y * 0.05);
    else stage.camera.rotate(azimuth * TURN, elevation * TURN);
  };

  const showSheet = keys.listen(
    [
      [
        'View',
        [
          ['F', 'Fit the model', ['f'], view.fit],
          ...Object.keys(VIEWS).map((name, i) => [
            `${i + 1}`,
            name === 'iso' ? 'Isometric' : `From the ${name}`,
            [`${i + 1}`],
            () => view.look(name),
          ]),
          ['O', 'Perspective or parallel', ['o'], view.project],
          ['W', 'Next shading', ['w'], view.nextMode],
          ['G', 'Grid', ['g'], view.toggleGrid],
          ['← → ↑ ↓', 'Turn', ['ArrowLeft'], arrow(1, 0, -1, 0)],
          ['⇧ ← →', 'Move', ['ArrowRight'], arrow(-1, 0, 1, 0)],
          ['+ −', 'Nearer, farther', ['+', '='], () => stage?.camera.zoom(1 / 1.15)],
        ],
      ],
      [
        'Mouse',
        [
          ['drag', 'Turn'],
          ['right drag', 'Move; also with Shift'],
          ['wheel', 'Zoom to the pointer'],
          ['click', 'What made this?'],
          ['double click', 'Turn around this point'],
        ],
      ],
      [
        'Model',
        [
          ['Space', 'Play the derivation', [' '], () => steps.toggle()],
          [', .', 'One step back, one on', [','], () => steps.move(-1)],
          ['A', 'All steps', ['a'], () => steps.all()],
          ['R', 'Another seed', ['r'], () => seed.roll()],
          ['V', 'Variations', ['v'], () => variations.toggle()],
          ['Esc', 'Cancel, close, clear', ['Escape'], escape],
        ],
      ],
      [
        'Page',
        [
          ['P', 'Panel', ['p'], togglePanel],
          ['S', 'Save a picture of the view', ['s'], () => find('#screenshot').click()],
          ['E', 'Export', ['e'], () => find('#export').click()],
          ['L', 'Light or dark', ['l'], () => find('#theme').click()],
          ['?', 'These keys', ['?'], () => showSheet()],
        ],
      ],
    ],
    keys.typing,
    {
      ArrowUp: arrow(0, 1, 0, 1),
      ArrowDown: arrow(0, -1, 0, -1),
      '-': () => stage?.camera.zoom(1.15),
      '.': () => steps.move(1),
    },
  );
}
