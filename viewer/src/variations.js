// Variations: small pictures of other seeds, or of one parameter from here to there. A click takes one over.

import { find, make, say } from './dom.js';
import { nearest, plain } from './format.js';
import { icon } from './icons.js';

const NUMBERS = [4, 9, 16];

export class Variations {
  #tray = find('#tray');
  #button = find('#vary');
  #id = 0;
  #number = 9;
  #params = [];
  #all = [];
  #parts = {};

  constructor({ socket, changes, seed }) {
    Object.assign(this, { socket, changes, seed });
    this.#button.addEventListener('click', () => this.toggle());
    this.#build();
  }

  get open() {
    return !this.#tray.hidden;
  }

  toggle(open = !this.open) {
    this.#tray.hidden = !open;
    this.#button.setAttribute('aria-expanded', String(open));
    if (open && this.#parts.list.childElementCount === 0) this.#ask();
    if (open) this.#parts.of.focus();
    else this.#button.focus();
  }

  params(params) {
    this.#all = params;
    this.#params = params.filter(({ control }) => control.type === 'number' || control.type === 'choice');
    const { of } = this.#parts;
    const kept = of.value;
    const names = ['', ...this.#params.map((param) => param.name)];
    if ([...of.options].map((option) => option.value).join('\n') === names.join('\n')) return;
    of.replaceChildren(...names.map((name) => make('option', { value: name, text: name || 'seeds' })));
    of.value = names.includes(kept) ? kept : '';
    this.#range();
  }

  #build() {
    const of = make(
      'select',
      { 'aria-label': 'Vary', 'data-testid': 'variations-of', onchange: () => (this.#range(), this.#ask()) },
      make('option', { value: '', text: 'seeds' }),
    );
    const number = make(
      'div',
      { class: 'segments', role: 'radiogroup', 'aria-label': 'How many' },
      ...NUMBERS.map((n) =>
        make(
          'label',
          {},
          make('input', {
            type: 'radio',
            name: 'variations-number',
            value: n,
            checked: n === this.#number,
            'data-testid': `variations-${n}`,
            onchange: () => ((this.#number = n), this.#ask()),
          }),
          make('span', { text: n }),
        ),
      ),
    );
    const from = make('input', {
      type: 'number',
      step: 'any',
      'aria-label': 'From',
      'data-testid': 'variations-from',
      onchange: () => this.#ask(),
    });
    const to = make('input', {
      type: 'number',
      step: 'any',
      'aria-label': 'To',
      'data-testid': 'variations-to',
      onchange: () => this.#ask(),
    });
    const range = make('span', { class: 'range' }, from, make('span', { text: 'to' }), to);
    const list = make('div', {
      class: 'pictures',
      role: 'listbox',
      'aria-label': 'Variations',
      'data-testid': 'variations-list',
      onkeydown: (event) => this.#move(event),
    });
    const again = make('button', {
      class: 'small',
      text: 'More',
      'data-testid': 'variations-again',
      title: 'Make others',
      onclick: () => this.#ask(),
    });
    const state = make('span', { class: 'where', role: 'status' });
    const close = make(
      'button',
      { class: 'tool', 'aria-label': 'Close', title: 'Close (Esc)', onclick: () => this.toggle(false) },
      icon('close'),
    );
    this.#parts = { of, from, to, range, list, again, state };
    this.#tray.append(
      make(
        'div',
        { class: 'tray-head' },
        make('strong', { text: 'Variations' }),
        of,
        range,
        number,
        again,
        state,
        make('span', { class: 'push' }),
        close,
      ),
      list,
    );
    this.#range();
  }

  #range() {
    const param = this.#params.find(({ name }) => name === this.#parts.of.value);
    this.#parts.range.hidden = param?.control.type !== 'number';
    if (param?.control.type !== 'number') return;
    const { min, max } = param.control;
    this.#parts.from.value = plain(min ?? param.value / 2);
    this.#parts.to.value = plain(max ?? (param.value * 2 || 1));
  }

  #ask() {
    const { of, list, state } = this.#parts;
    const param = this.#params.find(({ name }) => name === of.value);
    const message = { type: 'variations' };
    if (param) Object.assign(message, { param: param.name, values: this.#values(param) });
    else message.seeds = Array.from({ length: this.#number }, () => String(Math.floor(Math.random() * 1e6)));
    const number = (message.seeds ?? message.values).length;
    list.replaceChildren(
      ...Array.from({ length: number }, (_, i) =>
        make(
          'button',
          { class: 'picture', role: 'option', 'aria-selected': 'false', tabindex: i ? -1 : 0, disabled: true },
          make('span', { class: 'label', text: '…' }),
        ),
      ),
    );
    let made = 0;
    say(state, `0 of ${number}`);
    const id = (this.#id = this.socket.ask(message, (answer) => {
      if (id !== this.#id) return;
      if (answer.type === 'refused') return say(state, answer.text);
      if (answer.type === 'variations') return made ? null : say(state, `${answer.ran} of ${answer.of} have run`);
      this.#fill(list.children[answer.index], answer);
      say(state, ++made < answer.of ? `${made} of ${answer.of}` : '');
    }));
  }

  #values({ control, value }) {
    if (control.type === 'choice') return control.choices.map(String);
    const ends = [this.#parts.from, this.#parts.to];
    if (!ends.every((end) => Number.isFinite(end.valueAsNumber))) return [plain(value)];
    // Beyond its bounds all of them would be the same.
    for (const end of ends) end.value = plain(nearest(end.valueAsNumber, control));
    const [from, to] = ends.map((end) => end.valueAsNumber);
    const values = Array.from({ length: this.#number }, (_, i) =>
      plain(nearest(from + ((to - from) * i) / (this.#number - 1), control)),
    );
    return [...new Set(values)];
  }

  #fill(place, { label, seed, params, url, error }) {
    if (!place) return;
    place.disabled = false;
    place.title = error ?? label;
    const shown = error
      ? make('span', { class: 'failed', text: error })
      : make('img', { src: url, alt: '', draggable: 'false' });
    place.replaceChildren(shown, make('span', { class: 'label', text: label }));
    if (error) return;
    place.onclick = () => {
      for (const other of this.#parts.list.children) other.setAttribute('aria-selected', String(other === place));
      const swept = this.#parts.of.value;
      for (const [name, value] of Object.entries(params)) {
        const now = this.#all.find((param) => param.name === name)?.value;
        if (name === swept || (now !== undefined && written(now) !== written(value)))
          this.changes.set(name, written(value));
      }
      if (seed !== this.seed.value) this.seed.use(seed);
    };
  }

  #move(event) {
    const { list } = this.#parts;
    const places = [...list.children];
    const at = places.indexOf(document.activeElement);
    const width = Math.max(1, places.filter((it) => it.offsetTop === places[0].offsetTop).length);
    const by = { ArrowRight: 1, ArrowLeft: -1, ArrowDown: width, ArrowUp: -width }[event.key];
    if (!by || at < 0) return;
    event.preventDefault();
    event.stopPropagation();
    const next = places[Math.min(Math.max(at + by, 0), places.length - 1)];
    for (const place of places) place.tabIndex = place === next ? 0 : -1;
    next.focus();
    next.scrollIntoView({ block: 'nearest', inline: 'nearest' });
  }
}

/** A value as the server reads it. */
const written = (value) => (Array.isArray(value) ? JSON.stringify(value) : String(value));
