// Groups of parameters that fold. Parameters without a group come first; a group that was folded stays so.

import { make } from '../dom.js';

export class ParamGroups {
  #place;
  #groups = new Map();
  #loose = make('div', { class: 'param-loose' });
  #before = new Map();
  #used = new Set();

  constructor(place) {
    this.#place = place;
  }

  /** Begins to place the rows of these parameters, in their order. */
  begin(params) {
    this.#before.clear();
    this.#used.clear();
    const names = [...new Set(params.map((it) => it.group).filter(Boolean))];
    let last = this.#put(this.#place, this.#loose, null);
    for (const name of names) {
      if (!this.#groups.has(name)) this.#groups.set(name, group(name));
      const { element, number } = this.#groups.get(name);
      const own = params.filter((it) => it.group === name);
      const changed = own.filter((it) => it.changed).length;
      number.textContent = changed ? `${changed} of ${own.length} changed` : String(own.length);
      last = this.#put(this.#place, element, last);
    }
  }

  /** Places a row after the one before it of its group. */
  place(row, name) {
    this.#used.add(name);
    const body = name ? this.#groups.get(name).body : this.#loose;
    this.#before.set(body, this.#put(body, row, this.#before.get(body) ?? null));
  }

  /** Ends it: groups without rows go. */
  end() {
    for (const [name, { element }] of this.#groups) {
      if (this.#used.has(name)) continue;
      element.remove();
      this.#groups.delete(name);
    }
  }

  /** While one searches, groups are open where something is found, and hidden elsewhere. */
  filter(searching) {
    for (const { element, body } of this.#groups.values()) {
      const found = [...body.children].some((row) => !row.hidden);
      element.hidden = searching && !found;
      if (searching && found) element.dataset.was ??= String(element.open);
      if (searching && found) element.open = true;
      else if (element.dataset.was) {
        element.open = element.dataset.was === 'true';
        delete element.dataset.was;
      }
    }
  }

  /** Puts `element` after `before` unless it stands there, so that it keeps the focus. */
  #put(place, element, before) {
    const next = before ? before.nextSibling : place.firstChild;
    if (next !== element) place.insertBefore(element, next);
    return element;
  }
}

function group(name) {
  const body = make('div', { class: 'param-body' });
  const number = make('span', { class: 'summary' });
  const element = make(
    'details',
    { class: 'param-group', open: true, 'data-testid': `group-${name}` },
    make('summary', {}, make('h3', { text: name }), number),
    body,
  );
  return { element, body, number };
}
