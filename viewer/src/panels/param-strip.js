// A strip of small pictures under a parameter: what its values do. A click takes one over.

import { make, say } from '../dom.js';
import { nearest, plain } from '../format.js';
import { icon } from '../icons.js';

const PICTURES = 4;
const PAUSE = 350; // ms after a change of another value until the pictures are made again

/** The strip that is open; the server makes the pictures of one at a time. */
let opened = null;

/** Whether a strip can show the values of a parameter. */
export const hasStrip = ({ control }) =>
  control.type === 'switch' ||
  (control.type === 'choice' && control.choices.length > 1) ||
  (control.type === 'number' && Number.isFinite(control.min) && Number.isFinite(control.max) && control.min < control.max);

export class ParamStrip {
  #id = 0;
  #timer = 0;
  #others = '';
  #param = null;

  constructor(id, changes) {
    this.changes = changes;
    this.state = make('span', { class: 'where', role: 'status' });
    this.list = make('div', { class: 'strip-list', role: 'group', 'aria-label': 'Values of this parameter' });
    this.element = make('div', { class: 'strip', 'data-testid': `${id}-strip-list`, hidden: true }, this.list, this.state);
    this.button = make(
      'button',
      {
        class: 'tool reset strip-toggle',
        'data-testid': `${id}-strip`,
        title: 'Show what its values do',
        'aria-expanded': 'false',
        onclick: () => this.toggle(),
      },
      icon('strip'),
    );
  }

  toggle(open = this.element.hidden) {
    if (open && opened && opened !== this) opened.toggle(false);
    opened = open ? this : opened === this ? null : opened;
    this.element.hidden = !open;
    this.button.setAttribute('aria-expanded', String(open));
    if (open) this.#ask();
    else this.#id = 0;
  }

  /** Takes the parameter; `others` tells the values of all others. */
  update(param, others) {
    this.#param = param;
    this.button.hidden = !hasStrip(param);
    this.button.setAttribute('aria-label', `Show what values of ${param.name} do`);
    if (this.button.hidden && !this.element.hidden) this.toggle(false);
    const changed = others !== this.#others;
    this.#others = others;
    for (const picture of this.list.children) choose(picture, param.value);
    if (this.element.hidden || !changed) return;
    clearTimeout(this.#timer);
    this.#timer = setTimeout(() => !this.element.hidden && this.#ask(), PAUSE);
  }

  #values() {
    const { control } = this.#param;
    if (control.type === 'switch') return ['false', 'true'];
    if (control.type === 'choice') return control.choices.slice(0, 8).map(String);
    const { min, max } = control;
    const all = Array.from({ length: PICTURES }, (_, i) => plain(nearest(min + ((max - min) * i) / (PICTURES - 1), control)));
    return [...new Set(all)];
  }

  #ask() {
    const { name } = this.#param;
    const values = this.#values();
    // The pictures before stay until the new ones come.
    if (this.list.childElementCount !== values.length)
      this.list.replaceChildren(...values.map(() => make('button', { class: 'picture', disabled: true })));
    let made = 0;
    say(this.state, '…');
    const id = (this.#id = this.changes.ask({ type: 'variations', param: name, values }, (answer) => {
      if (id !== this.#id) return;
      if (answer.type === 'refused') return say(this.state, answer.text);
      if (answer.type !== 'variation') return;
      made += 1;
      say(this.state, made < answer.of ? '…' : '');
      this.#fill(this.list.children[answer.index], values[answer.index], answer);
    }));
  }

  #fill(picture, value, { url, error }) {
    if (!picture) return;
    picture.disabled = false;
    picture.title = error ?? value;
    picture.dataset.value = value;
    picture.setAttribute('aria-label', `${this.#param.name} ${value}`);
    choose(picture, this.#param.value);
    picture.onclick = () => this.changes.set(this.#param.name, value);
    picture.replaceChildren(
      error ? make('span', { class: 'failed', text: 'error' }) : make('img', { src: url, alt: '', draggable: 'false' }),
      make('span', { class: 'label', text: value }),
    );
  }
}

function choose(picture, value) {
  const own = picture.dataset.value;
  const same = typeof value === 'number' ? Number(own) === Number(plain(value)) : own === String(value);
  picture.setAttribute('aria-pressed', String(same));
}
