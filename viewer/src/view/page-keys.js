// Common parts of the pages: the button of the panel; and Escape and the keys of pages without a script.

import { find } from '../dom.js';
import { listen, typing } from '../keys.js';
import { closeMenu } from '../menu.js';
import { viewKeys } from '../view-keys.js';

/** Makes the button of the panel work. Returns what it does. */
export function panelButton() {
  const toggle = () => {
    const closed = document.body.classList.toggle('no-panel');
    find('#toggle-panel').setAttribute('aria-expanded', String(!closed));
  };
  find('#toggle-panel').addEventListener('click', toggle);
  return toggle;
}

/** Listens to the keys of a page without a script. `view` is what `tools` returns, and `mouse` the rows of the sheet about the
 *  mouse; Escape closes `card`. */
export function pageKeys({ stage, view, card, mouse }) {
  const togglePanel = panelButton();
  const escape = () => {
    const canvas = find('#view');
    if (find('#sheet').open) find('#sheet').close();
    else if (closeMenu()) return;
    else if (card?.open) card.close();
    else if (document.activeElement !== canvas) canvas.focus();
  };
  const { rows, more } = viewKeys(stage, view);
  const page = [
    ['P', 'Panel', ['p'], togglePanel],
    ['S', 'Save a picture of the view', ['s'], () => find('#screenshot').click()],
    ['L', 'Light or dark', ['l'], () => find('#theme').click()],
    ['Esc', 'Close, clear', ['Escape'], escape],
    ['?', 'These keys', ['?'], () => showSheet()],
  ];
  const showSheet = listen(
    [
      ['View', rows],
      ['Mouse', mouse],
      ['Page', page],
    ],
    typing,
    more,
  );
}
