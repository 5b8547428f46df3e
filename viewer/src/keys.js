// Keys, and the sheet that tells them.

import { find, make } from './dom.js';

/** `keys`: `[section, [[keys as shown, what they do, codes, action]]]`; `more` are keys that another row speaks of. */
export function listen(keys, ignore, more) {
  const actions = new Map(Object.entries(more));
  for (const [, rows] of keys)
    for (const [, , codes, action] of rows) for (const code of codes ?? []) actions.set(code, action);
  addEventListener('keydown', (event) => {
    if (event.defaultPrevented || event.ctrlKey || event.metaKey || event.altKey) return;
    const action = actions.get(event.key.length === 1 ? event.key.toLowerCase() : event.key);
    if (!action) return;
    if (event.key !== 'Escape' && ignore(event)) return;
    if (action(event) !== false) event.preventDefault();
  });

  const sheet = find('#sheet');
  find('#sheet-body').append(
    ...keys.map(([title, rows]) =>
      make(
        'section',
        {},
        make('h3', { text: title }),
        make(
          'dl',
          {},
          ...rows.flatMap(([shown, text]) => [
            make(
              'dt',
              {},
              ...shown.split(' ').map((key) => make(/^[a-z]{2,}$/.test(key) ? 'span' : 'kbd', { text: key })),
            ),
            make('dd', { text }),
          ]),
        ),
      ),
    ),
  );
  find('#sheet-close').addEventListener('click', () => sheet.close());
  sheet.addEventListener('click', (event) => event.target === sheet && sheet.close());
  const toggle = () => (sheet.open ? sheet.close() : sheet.showModal());
  find('#help').addEventListener('click', toggle);
  return toggle;
}

/** Whether the key belongs to the control that has the focus. */
export function typing({ target, key }) {
  if (find('#sheet').open) return key !== '?';
  if (target.matches('input:not([type=range], [type=checkbox], [type=radio], [type=color]), textarea')) return true;
  if (target.matches('select, .pane-code')) return true;
  const own = target.matches('input[type=range], input[type=radio]')
    ? /^Arrow|^Home|^End|^Page| /
    : target.matches('button, a, summary, input')
      ? /^ $|^Enter/
      : null;
  return own ? own.test(key) : false;
}
