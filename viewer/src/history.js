// Undo and redo of values, seed and presets: each model that is drawn is a state that one can go back to.

import { find } from './dom.js';

const MOST = 200; // states that are kept
const TOGETHER = 800; // ms within which changes of the same parameters are one
const PATIENCE = 5000; // ms after which a state that was asked for is not waited for any more

export class History {
  #past = [];
  #future = [];
  #present = null;
  #wanted = null;
  #undo = find('#undo');
  #redo = find('#redo');
  #dirty = new WeakSet();

  constructor(changes) {
    this.changes = changes;
    this.#undo.addEventListener('click', () => this.undo());
    this.#redo.addEventListener('click', () => this.redo());
    // A field whose text is not sent yet has an undo of its own.
    addEventListener('input', ({ target }) => target.matches('input:not([type=range])') && this.#dirty.add(target), true);
    for (const type of ['change', 'focusout']) addEventListener(type, ({ target }) => this.#dirty.delete(target), true);
    addEventListener('keydown', (event) => {
      const key = event.key.toLowerCase();
      if (!(event.ctrlKey || event.metaKey) || event.altKey || (key !== 'z' && key !== 'y')) return;
      if (this.#dirty.has(event.target) || event.target.matches('textarea, .pane-code')) return;
      if (find('#sheet').open) return;
      event.preventDefault();
      if (key === 'y' || event.shiftKey) this.redo();
      else this.undo();
    });
  }

  /** Notes the values and the seed of a model that is shown now. */
  note({ params, seed }) {
    const values = new Map(params.map((it) => [it.name, it.changed ? text(it.value) : null]));
    const state = { seed, values, at: performance.now(), changed: [] };
    const { wanted, present } = { wanted: this.#wanted, present: this.#present };
    if (wanted) {
      if (!same(state, wanted) && performance.now() < wanted.until) return;
      this.#wanted = null;
    }
    if (!present) this.#present = state;
    else if (same(state, present)) this.#present = state;
    else {
      state.changed = difference(present, state);
      const goesOn = state.at - present.at < TOGETHER && String(state.changed) === String(present.changed);
      if (wanted) state.changed = [];
      else if (!goesOn) {
        this.#past.push(present);
        if (this.#past.length > MOST) this.#past.shift();
      }
      if (!wanted) this.#future = [];
      this.#present = state;
    }
    this.#show();
  }

  undo() {
    this.#go(this.#past, this.#future);
  }

  redo() {
    this.#go(this.#future, this.#past);
  }

  #go(from, to) {
    // A state that differs only in parameters that the script does not have any more is none to go to.
    let target = from.pop();
    while (target && same(target, this.#present)) target = from.pop();
    if (!target) return this.#show();
    to.push(this.#present);
    const params = {};
    for (const [name, value] of target.values)
      if (this.#present.values.has(name) && this.#present.values.get(name) !== value) params[name] = value;
    // A parameter that the script does not have any more stays away.
    const values = new Map([...this.#present.values].map(([name, value]) => [name, target.values.get(name) ?? null]));
    this.changes.restore(params, target.seed === this.#present.seed ? null : target.seed);
    this.#present = { ...target, values, at: 0 };
    this.#wanted = { ...this.#present, until: performance.now() + PATIENCE };
    this.#show();
  }

  #show() {
    this.#undo.disabled = this.#past.length === 0;
    this.#redo.disabled = this.#future.length === 0;
  }
}

/** A value as the server takes it. */
const text = (value) => (typeof value === 'object' ? JSON.stringify(value) : String(value));

/** The names of the parameters that both have and whose values differ; an empty one for the seed. */
function difference(a, b) {
  const names = [...b.values.keys()].filter((name) => a.values.has(name) && a.values.get(name) !== b.values.get(name));
  return a.seed === b.seed ? names : [...names, ''];
}

const same = (a, b) => difference(a, b).length === 0;
