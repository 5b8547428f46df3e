// The console: what the scripts of the last run print, and its warnings and errors, each with its line.

import { find, make, say } from '../dom.js';
import { count, many } from '../format.js';

const KINDS = [
  ['error', 'error'],
  ['warning', 'warning'],
  ['print', 'print'],
];

export class Console {
  #sheet = find('#console');
  #button = find('#console-toggle');
  #list = find('#console-list');
  #filter = find('#console-filter');
  #prints = { lines: [], gap: 0, left_out: 0 };
  #problems = [];
  #cleared = false;
  #shown = new Set(KINDS.map(([kind]) => kind));

  /** `go(file, line)` shows a line of the script. */
  constructor({ go }) {
    this.go = go;
    this.#button.addEventListener('click', () => this.toggle());
    find('#console-close').addEventListener('click', () => this.toggle(false));
    find('#console-clear').addEventListener('click', () => this.clear());
    this.#filter.addEventListener('input', () => this.#draw());
    find('#console-kinds').append(
      ...KINDS.map(([kind, one]) =>
        make(
          'label',
          { class: 'check' },
          make('input', {
            type: 'checkbox',
            checked: true,
            'data-testid': `console-${kind}s`,
            onchange: ({ target }) => {
              if (target.checked) this.#shown.add(kind);
              else this.#shown.delete(kind);
              this.#draw();
            },
          }),
          `${one}s`,
        ),
      ),
    );
    this.#tell();
  }

  get open() {
    return !this.#sheet.hidden;
  }

  toggle(open = !this.open) {
    this.#sheet.hidden = !open;
    this.#button.setAttribute('aria-expanded', String(open));
    document.body.classList.toggle('has-console', open);
    if (open) {
      this.#draw();
      this.#list.scrollTop = this.#list.scrollHeight;
      this.#filter.focus();
    } else this.#button.focus();
  }

  /** Takes what a run has printed so far. */
  printed(message) {
    this.#prints = message;
    this.#cleared = false;
    this.#change();
  }

  /** Takes the errors, warnings and notes of a run: `{severity, message, help, file, line, count}`. */
  problems(problems) {
    this.#problems = problems;
    this.#cleared = false;
    this.#change();
  }

  /** Empties the list until something new comes. */
  clear() {
    this.#cleared = true;
    this.#change();
  }

  #change() {
    this.#tell();
    if (!this.open) return;
    const { scrollTop, scrollHeight, clientHeight } = this.#list;
    const atEnd = scrollTop + clientHeight > scrollHeight - 8;
    this.#draw();
    if (atEnd) this.#list.scrollTop = this.#list.scrollHeight;
  }

  /** Tells on the button what there is. */
  #tell() {
    const of = (severity) =>
      this.#cleared ? 0 : this.#problems.filter((it) => it.severity === severity).reduce((sum, it) => sum + (it.count ?? 1), 0);
    const prints = this.#cleared ? 0 : this.#prints.left_out + this.#prints.lines.reduce((sum, it) => sum + it.count, 0);
    const [errors, warnings] = [of('error'), of('warning')];
    const parts = [errors && many(errors, 'error'), warnings && many(warnings, 'warning'), prints && many(prints, 'print')];
    say(this.#button, parts.filter(Boolean).join(', ') || 'Console');
    this.#button.dataset.worst = errors ? 'error' : warnings ? 'warning' : '';
  }

  #draw() {
    const words = this.#filter.value.toLowerCase().split(/\s+/).filter(Boolean);
    const has = ({ text, file, line }) => {
      const all = `${text} ${file}:${line}`.toLowerCase();
      return words.every((word) => all.includes(word));
    };
    const rows = [];
    let hidden = 0;
    const add = (kind, it) => {
      if (!this.#shown.has(kind) || !has(it)) hidden += 1;
      else rows.push(this.#row(kind, it));
    };
    if (!this.#cleared) {
      this.#prints.lines.forEach((it, i) => {
        if (i === this.#prints.gap && this.#prints.left_out > 0 && this.#shown.has('print'))
          rows.push(
            make('li', {
              class: 'gap',
              'data-testid': 'console-left-out',
              text: `${many(this.#prints.left_out, 'print')} left out; the terminal has all of them`,
            }),
          );
        add('print', it);
      });
      for (const it of this.#problems)
        add(it.severity, { ...it, text: [it.message, it.help].filter(Boolean).join('\n'), file: it.file ?? '', line: it.line ?? 0 });
    }
    const text = hidden ? `${count(hidden)} hidden by the filter` : rows.length ? '' : 'Nothing is printed.';
    this.#list.replaceChildren(...rows, text ? make('li', { class: 'gap', text }) : '');
  }

  #row(kind, { text, file, line, count: times }) {
    return make(
      'li',
      { class: `said ${kind}`, 'data-testid': `console-${kind}` },
      make('span', { class: 'sort-of', text: kind === 'print' ? '' : kind }),
      make('code', { text }),
      times > 1 ? make('b', { class: 'times-said', text: `× ${count(times)}`, title: `${count(times)} times` }) : null,
      line
        ? make('button', {
            class: 'place',
            text: `${file}:${line}`,
            title: 'Show this line in the script',
            onclick: () => this.go(file, line),
          })
        : null,
    );
  }
}
