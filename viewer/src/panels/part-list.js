// The outline of the model: systems, their symbols and their features, to go to, to isolate and to hide.

import { find, make, say } from '../dom.js';
import { count, many } from '../format.js';
import { icon } from '../icons.js';
import { toast } from '../toast.js';
import { boxOf, cutParts } from '../view/visibility.js';

const PAUSE = 200; // ms without a letter after which the server is asked

export class PartList {
  #panel = find('#outline');
  #list = find('#outline-list');
  #search = find('#outline-search');
  #pill = find('#hidden-parts');
  #systems = [];
  #chains = { parts: [], matching: 0 };
  #asked = 0;
  #timer = 0;
  /** What is hidden, and what alone is seen: `{name, ask, ranges}` by key. */
  #hidden = new Map();
  #only = new Map();

  /** `marked()` is called before something is marked. */
  constructor({ stage, socket, marked }) {
    Object.assign(this, { stage, socket, marked });
    this.#panel.addEventListener('toggle', () => this.#panel.open && this.#ask());
    this.#search.addEventListener('input', () => {
      clearTimeout(this.#timer);
      this.#timer = setTimeout(() => this.#ask(), PAUSE);
      this.#draw();
    });
    this.#search.addEventListener('keydown', (event) => {
      if (event.key !== 'Escape' || !this.#search.value) return;
      event.stopPropagation();
      this.#search.value = '';
      this.#ask();
    });
    find('#show-all').addEventListener('click', () => this.all());
  }

  /** Opens the panel and puts the caret into its search. */
  focus() {
    this.#panel.open = true;
    this.#search.focus();
  }

  /** Takes a new model, in which the parts that are hidden are found again. */
  show({ systems }, isNew) {
    this.#systems = systems;
    const chains = systems.reduce((sum, it) => sum + it.chains, 0);
    say(find('#outline-summary'), `${many(systems.length, 'system')}, ${many(chains, 'chain')}`);
    if (!isNew) return;
    for (const kept of [this.#hidden, this.#only])
      for (const [key, part] of kept) {
        // What was picked may be another module now.
        if (!part.ask) kept.delete(key);
        else this.#find(part, (ranges) => ((part.ranges = ranges), this.#cut()), () => (kept.delete(key), this.#cut()));
      }
    this.#tell();
    if (this.#panel.open) this.#ask();
  }

  /** Shows these ranges of triangles alone; `name` is what they are. */
  isolate(key, name, ask, ranges) {
    this.#only = new Map([[key, { name, ask, ranges }]]);
    this.#hidden.delete(key);
    this.#cut();
  }

  hide(key, name, ask, ranges) {
    this.#only.delete(key);
    this.#hidden.set(key, { name, ask, ranges });
    this.#cut();
  }

  /** Frames ranges of triangles. */
  frame(ranges) {
    const box = boxOf(this.stage.model, ranges);
    if (!box.isEmpty()) this.stage.camera.go(this.stage.camera.fitted(box));
    return !box.isEmpty();
  }

  all() {
    this.#only.clear();
    this.#hidden.clear();
    this.#cut();
  }

  get isCut() {
    return this.#only.size + this.#hidden.size > 0;
  }

  #cut() {
    if (!this.stage) return;
    const ranges = (kept) => [...kept.values()].flatMap((it) => it.ranges);
    const { model } = this.stage;
    this.stage.show(this.isCut ? cutParts(model, this.#only.size ? ranges(this.#only) : null, ranges(this.#hidden)) : model.parts);
    this.#tell();
    this.#draw();
  }

  #tell() {
    const names = (kept) => [...kept.values()].map((it) => it.name);
    const [only, hidden] = [names(this.#only), names(this.#hidden)];
    const list = (all) => (all.length > 2 ? `${all.slice(0, 2).join(', ')} and ${all.length - 2} more` : all.join(' and '));
    this.#pill.hidden = !this.isCut;
    const texts = [only.length && `Only ${list(only)}`, hidden.length && `${list(hidden)} hidden`];
    say(find('#hidden-text'), texts.filter(Boolean).join('; '));
  }

  /** Asks the server for the chains that match the search. */
  #ask() {
    const id = (this.#asked = this.socket.ask({ type: 'parts', search: this.#search.value }, (answer) => {
      if (id !== this.#asked || answer.type === 'refused') return;
      this.#chains = answer;
      this.#draw();
    }));
    this.#draw();
  }

  /** Finds the triangles of a part. */
  #find(part, found, failed = () => {}) {
    this.socket.ask({ type: 'part', ...part.ask }, (answer) => {
      if (answer.type === 'refused') {
        failed();
        return toast(answer.text);
      }
      found(answer.ranges);
    });
  }

  #draw() {
    if (!this.#panel.open) return;
    const words = this.#search.value.toLowerCase().split(/\s+/).filter(Boolean);
    const matches = (text) => words.every((word) => text.toLowerCase().includes(word));
    const rows = [];
    for (const { system, place, modules, symbols } of this.#systems) {
      const own = symbols.filter((it) => matches(it.name));
      const inner = this.#chains.parts.filter((it) => it.system === system);
      const name = `System ${system + 1}`;
      if (words.length && !own.length && !inner.length && !matches(`${name} ${place}`)) continue;
      rows.push(this.#row('system', name, place, many(modules, 'module'), `${system}`, { system }));
      for (const symbol of own)
        rows.push(this.#row('symbol', symbol.name, '', count(symbol.count), `${system} ${symbol.name}`, { system, symbol: symbol.name }));
      for (const { chain, feature } of inner) {
        const title = feature ?? `chain ${chain + 1}`;
        rows.push(this.#row('feature', title, '', feature ? `chain ${count(chain + 1)}` : '', `${system} chain ${feature ?? chain}`, { system, chain }));
      }
    }
    const more = this.#chains.matching - this.#chains.parts.length;
    if (more > 0) rows.push(make('li', { class: 'none', text: `${many(more, 'chain')} more: search for them` }));
    if (rows.length === 0) rows.push(make('li', { class: 'none', text: words.length ? 'Nothing has this name.' : 'The script derives no system.' }));
    const focused = document.activeElement?.closest?.('#outline-list') && document.activeElement.dataset.testid;
    this.#list.replaceChildren(...rows);
    if (focused) this.#list.querySelector(`[data-testid="${CSS.escape(focused)}"]`)?.focus();
  }

  #row(kind, name, place, note, key, ask) {
    const id = kind === 'system' ? `${ask.system + 1}` : name;
    const [isOnly, isHidden] = [this.#only.has(key), this.#hidden.has(key)];
    const part = { name, ask };
    const none = (ranges) => {
      if (ranges.length === 0) toast(`${name} draws nothing in this model.`);
      return ranges.length === 0;
    };
    const tool = (action, title, pressed, act) =>
      make(
        'button',
        {
          class: 'tool tiny',
          'data-testid': `${action}-${id}`,
          'aria-pressed': String(pressed),
          'aria-label': `${title} ${name}`,
          title,
          onclick: () => {
            if (pressed) {
              (action === 'hide' ? this.#hidden : this.#only).delete(key);
              return this.#cut();
            }
            this.#find(part, (ranges) => none(ranges) || act(ranges));
          },
        },
        icon(action),
      );
    return make(
      'li',
      { class: `part ${kind}${isHidden ? ' is-hidden' : ''}` },
      make(
        'button',
        {
          class: 'part-name',
          'data-testid': `part-${id}`,
          title: 'Go there and highlight it',
          onclick: () =>
            this.#find(part, (ranges) => {
              if (none(ranges)) return;
              this.marked();
              this.stage?.mark.show(this.stage.model, ranges);
              this.stage?.invalidate();
              this.frame(ranges);
            }),
        },
        make('code', { text: name, title: name }),
        place ? make('small', { text: place }) : null,
      ),
      make('small', { class: 'part-note', text: note }),
      tool('isolate', 'Show only', isOnly, (ranges) => this.isolate(key, name, ask, ranges)),
      tool('hide', 'Hide', isHidden, (ranges) => this.hide(key, name, ask, ranges)),
    );
  }
}
