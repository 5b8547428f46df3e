// Named sets of values: choose, save, delete. What would be lost is asked about first.

import { find, make, say } from './dom.js';

/** Whether a preset is the script's own; those of packages are called @castle/grand, and changed there. */
const isOwn = (name) => Boolean(name) && !name.startsWith('@');

export class Presets {
  #select = find('#presets');
  #save = find('#save-preset');
  #delete = find('#delete-preset');
  #form = find('#preset-form');
  #name = find('#preset-name');
  #ask = find('#preset-ask');
  #names = [];
  /** The preset that was chosen last, whose name is offered when its values have been changed. */
  #last = '';
  #answered = null;

  constructor(changes, socket) {
    const send = (action, name, replace) => socket.send({ type: 'preset', action, name, ...replace });
    this.#select.addEventListener('change', () => {
      const name = this.#select.value;
      this.#quit();
      this.#delete.disabled = !isOwn(name);
      if (name) changes.send({ type: 'preset', action: 'load', name });
    });
    this.#save.addEventListener('click', () => {
      const open = this.#form.hidden;
      this.#quit();
      this.#form.hidden = !open;
      // One of a package is saved under a name of its own.
      this.#name.value = (this.#select.value || this.#last).replace(/^@[^/]*\//, '');
      if (open) this.#name.select();
    });
    this.#form.addEventListener('submit', (event) => {
      event.preventDefault();
      const name = this.#name.value.trim();
      if (!name) return;
      if (!this.#names.includes(name)) return this.#done(() => send('save', name));
      this.#question(`Replace \u201c${name}\u201d?`, 'Replace', () => send('save', name, { replace: true }));
    });
    this.#delete.addEventListener('click', () => {
      const name = this.#select.value;
      this.#question(`Delete \u201c${name}\u201d?`, 'Delete', () => send('delete', name));
    });
    find('#preset-yes').addEventListener('click', () => this.#done(this.#answered));
    find('#preset-no').addEventListener('click', () => this.#done());
    for (const place of [this.#form, this.#ask]) {
      place.addEventListener('keydown', (event) => {
        if (event.key !== 'Escape') return;
        event.stopPropagation();
        this.#done();
      });
    }
  }

  /** Shows the presets that there are, and which of them has the present values. */
  show(names, chosen = null) {
    this.#names = names;
    const first = make('option', { value: '', text: names.length ? 'Presets' : 'No presets yet' });
    const groups = new Map();
    for (const name of names.filter((name) => !isOwn(name))) {
      const [owner, ...inner] = name.split('/');
      if (!groups.has(owner)) groups.set(owner, make('optgroup', { label: `of the package ${owner.slice(1)}` }));
      groups.get(owner).append(make('option', { value: name, text: inner.join('/') }));
    }
    const own = names.filter(isOwn).map((name) => make('option', { value: name, text: name }));
    this.#select.replaceChildren(first, ...own, ...groups.values());
    this.#select.disabled = names.length === 0;
    this.choose(chosen);
  }

  choose(name) {
    if (name) this.#last = name;
    this.#select.value = this.#names.includes(name) ? name : '';
    this.#delete.disabled = !isOwn(this.#select.value);
  }

  #question(text, yes, answered) {
    this.#quit();
    this.#answered = answered;
    say(find('#preset-question'), text);
    say(find('#preset-yes'), yes);
    this.#ask.hidden = false;
    find('#preset-no').focus();
  }

  #quit() {
    this.#form.hidden = this.#ask.hidden = true;
  }

  #done(act) {
    this.#quit();
    act?.();
    this.#save.focus();
  }
}
