// Named sets of values: choose, save, delete.

import { find, make } from './dom.js';

export class Presets {
  #select = find('#presets');
  #delete = find('#delete-preset');
  #form = find('#preset-form');
  #name = find('#preset-name');

  constructor(changes, socket) {
    this.#select.addEventListener('change', () => {
      const name = this.#select.value;
      this.#delete.disabled = !name;
      if (name) changes.send({ type: 'preset', action: 'load', name });
    });
    find('#save-preset').addEventListener('click', () => {
      this.#form.hidden = !this.#form.hidden;
      this.#name.value = this.#select.value;
      if (!this.#form.hidden) this.#name.select();
    });
    this.#form.addEventListener('submit', (event) => {
      event.preventDefault();
      const name = this.#name.value.trim();
      if (!name) return;
      this.#wanted = name;
      socket.send({ type: 'preset', action: 'save', name });
      this.#form.hidden = true;
      find('#save-preset').focus();
    });
    this.#form.addEventListener('keydown', (event) => {
      if (event.key !== 'Escape') return;
      event.stopPropagation();
      this.#form.hidden = true;
      find('#save-preset').focus();
    });
    this.#delete.addEventListener('click', () =>
      socket.send({ type: 'preset', action: 'delete', name: this.#select.value }),
    );
  }

  #wanted = null;

  show(names) {
    const kept = this.#wanted ?? this.#select.value;
    const first = make('option', { value: '', text: names.length ? 'Presets' : 'No presets yet' });
    this.#select.replaceChildren(first, ...names.map((name) => make('option', { value: name, text: name })));
    this.#select.value = names.includes(kept) ? kept : '';
    if (names.includes(this.#wanted)) this.#wanted = null;
    this.#select.disabled = names.length === 0;
    this.#delete.disabled = !this.#select.value;
  }
}
