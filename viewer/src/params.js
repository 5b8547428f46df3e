// The parameters' controls. They are changed in place, so that a new model takes neither focus nor a drag away.

import { CurveEditor } from './curve.js';
import { find, make, say } from './dom.js';
import { icon } from './icons.js';
import { nearest, plain } from './format.js';
import { ParamGroups } from './panels/param-groups.js';
import { ParamStrip } from './panels/param-strip.js';
import { toast } from './toast.js';

const SEGMENTS = 4;
const MANY = 8; // parameters without a search

export class Params {
  #rows = new Map();
  #place = find('#params');
  #groups = new ParamGroups(find('#params'));
  #all = find('#reset-all');
  #search = find('#params-search');
  #none = make('p', { class: 'none', 'data-testid': 'params-none', text: 'No parameter has that in its name or description.', hidden: true });

  constructor(changes) {
    this.changes = changes;
    this.#search.addEventListener('input', () => this.#filter());
    this.#search.addEventListener('keydown', (event) => {
      if (event.key !== 'Escape' || !this.#search.value) return;
      event.stopPropagation();
      this.#search.value = '';
      this.#filter();
    });
    changes.refused = (names, text) => {
      for (const name of names) this.#rows.get(name)?.putBack();
      toast(text);
    };
    this.#all.addEventListener('click', () => {
      changes.send({ type: 'reset' });
      for (const row of this.#rows.values()) row.reset();
    });
  }

  show(params, seed) {
    const known = new Set(params.map((param) => param.name));
    for (const [name, row] of this.#rows) {
      if (known.has(name)) continue;
      row.element.remove();
      this.#rows.delete(name);
    }
    const values = params.map((it) => [it.name, it.value]);
    this.#groups.begin(params);
    for (const param of params) {
      let row = this.#rows.get(param.name);
      if (!row || row.kind !== kind(param)) {
        const made = new Row(param, this.changes);
        if (row) row.element.replaceWith(made.element);
        row = made;
        this.#rows.set(param.name, row);
      }
      this.#groups.place(row.element, param.group);
      row.update(param);
      row.strip.update(param, JSON.stringify([seed, values.filter(([name]) => name !== param.name)]));
    }
    this.#groups.end();
    if (params.length === 0)
      this.#place.replaceChildren(
        make(
          'p',
          { class: 'none' },
          'The script has none. ',
          make('code', { text: 'param("size", { default = 1 })' }),
          ' makes one.',
        ),
      );
    else this.#place.querySelector(':scope > .none')?.remove();
    this.#all.hidden = !params.some((param) => param.changed);
    this.#search.hidden = params.length <= MANY;
    if (this.#search.hidden) this.#search.value = '';
    this.#filter();
  }

  /** Shows the parameters that have what is searched for, and the package above those that it owns. */
  #filter() {
    const words = this.#search.value.toLowerCase().split(/\s+/).filter(Boolean);
    let shown = 0;
    for (const row of this.#rows.values()) {
      row.element.hidden = !matches(row.param, words);
      if (!row.element.hidden) shown += 1;
    }
    this.#groups.filter(words.length > 0);
    this.#none.hidden = shown > 0 || this.#rows.size === 0;
    this.#place.after(this.#none);
  }
}

/** Whether a parameter has all words of a search in its name, its description or its choices. */
function matches({ name, text, control }, words) {
  const all = [name, text, ...(control.choices ?? [])].join(' ').toLowerCase();
  return words.every((word) => all.includes(word));
}

/** The name of a parameter; that of a package stands smaller before it. */
function labelled({ name, package: owner }, id) {
  if (!owner) return make('label', { for: id, text: name });
  const own = name.slice(owner.length + 1);
  return make('label', { for: id, title: name }, make('span', { class: 'owner', text: `${owner} ` }), own);
}

/** Rows of one kind can be changed into each other without new elements. */
function kind({ control }) {
  return control.type === 'choice'
    ? `choice ${JSON.stringify(control.choices)}`
    : control.type === 'number'
      ? `number ${slides(control)}`
      : control.type === 'points'
        ? `points ${control.space} ${control.kind} ${control.closed}`
        : control.type;
}

const slides = ({ min, max }) => Number.isFinite(min) && Number.isFinite(max) && min < max;

class Row {
  constructor(param, changes) {
    const { name } = param;
    this.name = name;
    this.kind = kind(param);
    this.changes = changes;
    this.id = `param-${name}`;
    this.input = this[param.control.type] ? this[param.control.type](param) : this.text(param);
    this.unit = make('span', { class: 'unit' });
    this.help = make('p', { class: 'help', id: `${this.id}-help` });
    this.note = make('p', { class: 'note' });
    this.resetter = make(
      'button',
      {
        class: 'tool reset',
        'data-testid': `${this.id}-reset`,
        'aria-label': `Reset ${name}`,
        onclick: () => {
          this.changes.set(name, null);
          this.reset();
        },
      },
      icon('reset'),
    );
    this.strip = new ParamStrip(this.id, changes);
    this.element = make(
      'div',
      { class: `param param-${param.control.type}` },
      make(
        'div',
        { class: 'param-head' },
        labelled(param, this.id),
        this.strip.button,
        this.resetter,
        make('span', { class: 'value' }, this.input.field, this.unit),
      ),
      this.input.below ?? null,
      this.strip.element,
      this.help,
      this.note,
    );
  }

  update(param) {
    const { value, control, unit, text, changed, old_default: old } = param;
    this.param = param;
    this.input.limits?.(control);
    if (!this.changes.holds(this.name) && !this.busy && !this.input.busy?.()) this.input.put(value);
    this.input.update?.(param);
    say(this.unit, unit === 'deg' ? '°' : (unit ?? ''));
    this.unit.title = unit ?? '';
    say(this.help, text ?? '');
    this.help.hidden = !text;
    this.element.classList.toggle('changed', changed);
    this.resetter.hidden = !changed;
    this.resetter.title =
      control.type === 'points'
        ? `Back to the ${param.script_default ? 'saved drawing' : 'values of the script'}`
        : `Back to ${shown(param.default)}`;
    this.note.hidden = old === null || old === undefined || control.type === 'points';
    say(this.note, this.note.hidden ? '' : `script’s default is now ${shown(param.default)} (was ${shown(old)})`);
  }

  reset() {
    this.typing = false;
    if (this.param) this.input.put(this.param.default);
  }

  /** Shows what the server has, unless something newer is on its way there. */
  putBack() {
    if (!this.busy && !this.input.busy?.() && !this.changes.holds(this.name)) this.input.put(this.param.value);
  }

  send(value) {
    this.changes.set(this.name, String(value));
  }

  number({ control }) {
    const field = make('input', {
      type: 'number',
      id: this.id,
      'data-testid': this.id,
      'aria-describedby': `${this.id}-help`,
      autocomplete: 'off',
      oninput: () => (this.typing = true),
      onblur: () => (this.typing = false),
      onchange: () => {
        this.typing = false;
        if (field.value === '' || !Number.isFinite(field.valueAsNumber)) return put(this.param.value);
        const value = nearest(field.valueAsNumber, this.param.control);
        put(value);
        this.send(plain(value));
      },
    });
    const slider =
      slides(control) &&
      make('input', {
        type: 'range',
        'data-testid': `${this.id}-slider`,
        'aria-label': this.name,
        'aria-describedby': `${this.id}-help`,
        oninput: () => {
          field.value = plain(slider.valueAsNumber);
          fill();
          this.send(field.value);
        },
        onpointerdown: () => (this.busy = true),
        onpointerup: () => (this.busy = false),
        onpointercancel: () => (this.busy = false),
        ondblclick: () => this.param.changed && this.resetter.click(),
      });
    const fill = () => {
      if (!slider) return;
      const { min, max, default: rest } = { ...this.limitsNow, default: this.param?.default };
      const part = (value) => `${((Math.min(Math.max(value, min), max) - min) / (max - min)) * 100}%`;
      slider.style.setProperty('--at', part(slider.valueAsNumber));
      if (Number.isFinite(rest)) slider.style.setProperty('--rest', part(rest));
    };
    const put = (value) => {
      if (!this.typing) field.value = plain(value);
      widen();
      if (slider) slider.value = value;
      fill();
    };
    // As wide as the longest number that it is likely to hold.
    const widen = () => {
      const { min, max } = this.limitsNow ?? {};
      const texts = [field.value, ...[min, max].filter(Number.isFinite).map(plain)];
      field.style.setProperty('--digits', Math.min(Math.max(...texts.map((text) => text.length)), 20));
    };
    const limits = ({ min, max, step }) => {
      this.limitsNow = { min, max };
      for (const input of slider ? [field, slider] : [field]) {
        set(input, 'min', min);
        set(input, 'max', max);
      }
      set(field, 'step', step ?? 'any');
      if (slider) set(slider, 'step', step ?? fineness(max - min));
    };
    return { field, below: slider || null, put, limits };
  }

  switch() {
    const field = make('input', {
      type: 'checkbox',
      role: 'switch',
      id: this.id,
      'data-testid': this.id,
      'aria-describedby': `${this.id}-help`,
      onchange: () => this.send(field.checked),
    });
    return { field, put: (value) => (field.checked = value === true) };
  }

  color() {
    const code = make('code', { class: 'color-code' });
    const input = make('input', {
      type: 'color',
      id: this.id,
      'data-testid': this.id,
      'aria-describedby': `${this.id}-help`,
      oninput: () => {
        code.textContent = input.value;
        this.send(input.value);
      },
      onfocus: () => (this.busy = true),
      onblur: () => (this.busy = false),
      onchange: () => (this.busy = false),
    });
    const put = (value) => {
      const text = hex(value);
      if (input.value !== text) input.value = text;
      code.textContent = text;
    };
    return { field: make('span', { class: 'color' }, code, input), put };
  }

  choice({ control: { choices } }) {
    if (choices.length > SEGMENTS || choices.join('').length > 30) {
      const field = make(
        'select',
        {
          id: this.id,
          'data-testid': this.id,
          'aria-describedby': `${this.id}-help`,
          onchange: () => this.send(field.value),
        },
        ...choices.map((choice) => make('option', { value: String(choice), text: String(choice) })),
      );
      return { field, put: (value) => (field.value = String(value)) };
    }
    const radios = choices.map((choice, i) =>
      make('input', {
        type: 'radio',
        name: this.id,
        id: i === 0 ? this.id : `${this.id}-${i}`,
        value: String(choice),
        'data-testid': `${this.id}-${choice}`,
        onchange: () => this.send(choice),
      }),
    );
    const below = make(
      'div',
      { class: 'segments', role: 'radiogroup', 'aria-label': this.name, 'data-testid': this.id },
      ...radios.map((radio) => make('label', {}, radio, make('span', { text: radio.value }))),
    );
    return {
      field: make('span'),
      below,
      put: (value) => radios.forEach((radio) => (radio.checked = radio.value === String(value))),
    };
  }

  points(param) {
    const editor = new CurveEditor(this, param);
    return {
      field: make('span', { class: 'curve-kind', text: param.control.kind }),
      below: editor.element,
      put: (points) => editor.put(points),
      limits: (control) => editor.limits(control),
      update: (param) => editor.update(param),
      busy: () => editor.busy,
    };
  }

  text() {
    const below = make('input', {
      type: 'text',
      id: this.id,
      'data-testid': this.id,
      'aria-describedby': `${this.id}-help`,
      autocomplete: 'off',
      spellcheck: 'false',
      onchange: () => this.send(below.value),
    });
    const put = (value) => {
      if (document.activeElement !== below || below.value === below.defaultValue) below.value = value;
      below.defaultValue = value;
    };
    return { field: make('span'), below, put };
  }
}

function set(input, name, value) {
  const text = value === null || value === undefined ? null : String(value);
  if (input.getAttribute(name) === text) return;
  if (text === null) input.removeAttribute(name);
  else input.setAttribute(name, text);
}

/** A step of a slider that has none: a power of ten, some hundreds to its length. */
const fineness = (length) => plain(10 ** Math.floor(Math.log10(length / 300)));

const shown = (value) =>
  typeof value === 'number' ? plain(value) : typeof value === 'boolean' ? (value ? 'on' : 'off') : String(value);

function hex(value) {
  if (/^#[0-9a-f]{6}$/i.test(value)) return value.toLowerCase();
  if (/^#[0-9a-f]{3}$/i.test(value))
    return `#${[...value.slice(1)].map((digit) => digit + digit).join('')}`.toLowerCase();
  return '#000000';
}
