// The panel of the derivation: what the chains consist of, and what each rule did.

import { find, make, say } from './dom.js';
import { count, many, milliseconds } from './format.js';
import { icon } from './icons.js';
import { clearToast, toast } from './toast.js';

const COLUMNS = { applied: 'applied', made: 'made', ms: 'time' };
const MOST = 8; // symbols shown of each system before the rest is folded

export class Profile {
  #panel = find('#derivation');
  #systems = find('#systems');
  #rules = find('#rules');
  #by = 'ms';
  #model = null;
  #all = new Set();

  constructor({ places, highlight }) {
    Object.assign(this, { places, highlight });
    this.#panel.addEventListener('toggle', () => this.#draw());
    find('#line-form').addEventListener('submit', (event) => {
      event.preventDefault();
      const [, file, line] =
        find('#line')
          .value.trim()
          .match(/^(?:(.*?):)?(\d+)$/) ?? [];
      if (Number.isSafeInteger(Number(line))) return highlight(file || this.script, Number(line));
      this.refused(line ? `there is no line ${line}` : 'write a line as 12, or as file.lua:12');
      find('#line').select();
    });
  }

  show(model) {
    this.#model = model;
    const steps = model.systems.reduce((most, system) => Math.max(most, system.steps), model.steps);
    say(find('#derivation-summary'), `${many(steps, 'step')}, ${many(model.modules, 'module')}`);
    this.#draw();
  }

  highlighted(answer) {
    const place = find('#line-result');
    place.hidden = !answer;
    if (!answer) return;
    const found = answer.ranges?.length > 0;
    place.replaceChildren(
      make('span', { class: 'swatch' }),
      make('span', {
        text: `${answer.file}:${answer.line}${answer.what ? `, ${answer.what}` : ''}: ${found || answer.modules ? many(answer.modules, 'module') : 'nothing in the model'}`,
      }),
    );
  }

  /** Why a line cannot be shown. Whoever asks from elsewhere does not see this panel. */
  refused(text) {
    if (this.#panel.open) clearToast();
    else toast(text);
    const place = find('#line-result');
    place.hidden = false;
    place.replaceChildren(make('span', { class: 'refused', text }));
  }

  #draw() {
    if (!this.#panel.open || !this.#model) return;
    const { systems, rules } = this.#model;
    this.#systems.replaceChildren(
      ...[...systems].sort((a, b) => b.modules - a.modules).map((system) => this.#system(system)),
    );
    this.#rules.replaceChildren(...(rules.length ? [this.#table(rules)] : []));
  }

  #system({ system, place, chains, modules, symbols }) {
    const most = Math.max(1, ...symbols.map((it) => it.count));
    const sorted = [...symbols].sort((a, b) => b.count - a.count);
    const all = this.#all.has(system) || sorted.length <= MOST + 2;
    const rows = (all ? sorted : sorted.slice(0, MOST)).map(({ name, count: number }) => {
      const bar = make('i', { class: 'bar' });
      bar.style.width = `${(number / most) * 100}%`;
      return make(
        'li',
        {},
        make('code', { text: name }),
        make('span', { class: 'cell' }, bar, make('b', { text: count(number) })),
      );
    });
    const more = all
      ? null
      : make('button', {
          class: 'link',
          text: `${sorted.length - MOST} more`,
          onclick: () => {
            this.#all.add(system);
            this.#draw();
          },
        });
    const [file, line] = split(place);
    return make(
      'section',
      { class: 'system' },
      make('h3', {}, `System ${system + 1} `, line ? this.places.show(file, line) : null),
      make('p', { class: 'where', text: `${many(chains, 'chain')}, ${many(modules, 'module')}` }),
      make('ul', { class: 'symbols' }, ...rows),
      more,
    );
  }

  #table(rules) {
    const most = Object.fromEntries(
      Object.keys(COLUMNS).map((key) => [key, Math.max(1e-9, ...rules.map((rule) => rule[key] ?? 0))]),
    );
    const heads = Object.entries(COLUMNS).map(([key, title]) =>
      make(
        'th',
        { scope: 'col', 'aria-sort': key === this.#by ? 'descending' : 'none' },
        make('button', {
          class: 'sort',
          text: title,
          'data-testid': `sort-${key}`,
          onclick: () => {
            this.#by = key;
            this.#draw();
            find(`[data-testid=sort-${key}]`).focus();
          },
        }),
      ),
    );
    const sorted = [...rules].sort((a, b) => (b[this.#by] ?? 0) - (a[this.#by] ?? 0));
    const body = sorted.map((rule) =>
      make(
        'tr',
        {},
        make(
          'th',
          { scope: 'row' },
          make('code', { text: rule.text, title: rule.text }),
          make(
            'span',
            { class: 'by' },
            rule.file ? this.places.show(rule.file, rule.line) : null,
            rule.kind === 'interpretation'
              ? make('span', { title: 'Interpretation: it draws', 'aria-label': 'interpretation' }, icon('draw'))
              : null,
          ),
        ),
        ...Object.keys(COLUMNS).map((key) => {
          const bar = make('i', { class: 'bar' });
          bar.style.width = `${((rule[key] ?? 0) / most[key]) * 100}%`;
          const text =
            rule[key] === null || rule[key] === undefined
              ? '–'
              : key === 'ms'
                ? milliseconds(rule.ms).replace(' ms', '')
                : short(rule[key]);
          return make('td', { title: key === 'ms' ? '' : count(rule[key] ?? 0) }, bar, make('b', { text }));
        }),
      ),
    );
    return make(
      'table',
      { class: 'rules' },
      make('caption', { text: 'Rules (time in ms)' }),
      make('thead', {}, make('tr', {}, make('th', { scope: 'col', text: 'rule' }), ...heads)),
      make('tbody', {}, ...body),
    );
  }
}

function split(place) {
  const [, file, line] = /^(.*):(\d+)$/.exec(place ?? '') ?? [];
  return [file, Number(line)];
}

function short(number) {
  if (number < 1e4) return count(number);
  if (number < 1e6) return `${(number / 1e3).toFixed(number < 1e5 ? 1 : 0)}k`;
  return `${(number / 1e6).toFixed(1)}M`;
}
