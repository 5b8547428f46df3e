// What each key does.

import { find } from './dom.js';
import * as keys from './keys.js';
import { viewKeys } from './view-keys.js';

/** `view` is what `tools` returns. */
export function shortcuts({ stage, view, steps, seed, variations, measure, cut, pane, sky, compare, parts, card, log, togglePanel, escape }) {
  const { rows, more } = viewKeys(stage, view);
  const showSheet = keys.listen(
    [
      [
        'View',
        [
          ...rows,
          ['M', 'Measure a distance', ['m'], () => measure?.toggle()], ['X', 'Cut with a plane', ['x'], () => cut?.toggle()],
          ['J', 'Sun, sky and background', ['j'], () => sky?.toggle()],
          ['B', 'The model before the last save, while held', ['b'], (event) => event.repeat || compare?.blink(true)],
          ['D', 'Before and after, side by side', ['d'], () => compare?.toggle()],
          ['I', 'Isolate what is picked', ['i'], () => card.hide(true)],
          ['H', 'Hide what is picked', ['h'], () => card.hide()],
          ['U', 'Show all again', ['u'], () => parts.all()],
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
          ['Y', 'Speed of playing', ['y'], () => steps.faster()],
          ['T', 'Outline: search the parts', ['t'], () => parts.focus()],
          ['Ctrl Z', 'Undo a change of values or seed'],
          ['Ctrl ⇧ Z', 'Redo'],
          ['R', 'Another seed', ['r'], () => seed.roll()],
          ['V', 'Variations', ['v'], () => variations.toggle()],
          ['Esc', 'Cancel, close, clear', ['Escape'], escape],
        ],
      ],
      [
        'Page',
        [
          ['P', 'Panel', ['p'], togglePanel],
          ['K', 'Console', ['k'], () => log.toggle()],
          ['C', 'Edit the script', ['c'], () => pane.toggle()],
          ['Ctrl S', 'Save the script'],
          ['S', 'Save a picture of the view', ['s'], () => find('#screenshot').click()],
          ['E', 'Export', ['e'], () => find('#export').click()],
          ['L', 'Light or dark', ['l'], () => find('#theme').click()],
          ['?', 'These keys', ['?'], () => showSheet()],
        ],
      ],
    ],
    keys.typing,
    { ...more, '.': () => steps.move(1) },
  );
}
