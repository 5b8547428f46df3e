// The card of a picked module: what it is, who drew it, and by which rules it came to be.

import { find, make } from './dom.js';
import { count, short } from './format.js';
import { icon } from './icons.js';
import { toast } from './toast.js';

// What made a module: a rule, what a query or a fragmentation stood for, or the axiom.
const madeBy = (it) =>
  [it.rule && `by ${it.rule}`, it.answer && `from ${short(it.answer)}`].filter(Boolean).join(', ') || 'axiom';

export class Card {
  #card = find('#card');
  #dot = find('#dot');
  #point = null;
  /** Ranges of the picked module's triangles, and its name. */
  #picked = null;

  /** `parts` isolates, hides and frames what is picked. */
  constructor({ stage, socket, places, parts, picking, closed }) {
    Object.assign(this, { stage, socket, places, parts, picking, closed });
    stage?.onDraw(() => this.#follow());
  }

  get open() {
    return !this.#card.hidden;
  }

  /** Asks what is at a pixel of the window. */
  pick(x, y) {
    const hit = this.stage.at(x, y);
    if (!hit) return this.close();
    const { mesh, primitive, node } = hit.part.userData;
    this.#point = hit.point;
    this.#follow();
    this.picking();
    this.socket.ask(
      { type: 'pick', mesh, primitive, triangle: hit.triangle, instance: hit.instance, node },
      (answer) => {
        if (answer.type === 'refused') return toast(answer.text);
        if (!answer.found)
          return this.#fill(make('p', { class: 'none', text: 'No module is known for this triangle.' }));
        this.#mark(answer, hit);
        this.#show(answer);
      },
    );
  }

  close() {
    this.#card.hidden = true;
    this.#picked = null;
    this.#point = null;
    this.#follow();
    this.closed();
  }

  /** Marks the picked module's triangles there; of a model that another system has placed, all of it. */
  #mark({ ranges, placed }, { part, instance }) {
    const { mesh, node } = part.userData;
    const { model, mark } = this.stage;
    const whole = () =>
      model.parts
        .filter((it) => it.userData.node === node)
        .map((it) => ({ mesh, primitive: it.userData.primitive, from: 0, count: Infinity }));
    const wanted = placed ? whole() : (ranges ?? []);
    if (wanted.length === 0) return;
    this.#picked = wanted.map((range) => ({ ...range, node, instances: instance === null ? null : [instance] }));
    mark.show(model, this.#picked);
    this.stage.invalidate();
  }

  /** The module that placed what is seen comes first, since it is what one thinks to have clicked. */
  #show({ placed, ...drawn }) {
    const name = (placed ?? drawn).module.symbol ?? (placed ?? drawn).module.text;
    if (!placed) return this.#fill(...this.#describe(drawn), this.#tools(name));
    this.#fill(
      ...this.#describe(placed),
      make(
        'section',
        { class: 'inside' },
        make('span', { class: 'caption', text: 'it places a model; this triangle of it is of' }),
        ...this.#describe(drawn),
      ),
      this.#tools(name),
    );
  }

  /** Hides what is picked. Returns whether something is. */
  hide(only = false) {
    const ranges = this.#picked;
    if (!ranges) return false;
    const name = find('.module', this.#card)?.textContent ?? 'module';
    this.close();
    this.parts[only ? 'isolate' : 'hide'](`picked ${JSON.stringify(ranges)}`, name, null, ranges);
    return true;
  }

  #tools(name) {
    if (!this.#picked || !this.parts) return null;
    const tool = (id, title, act) =>
      make('button', { class: 'small', 'data-testid': `picked-${id}`, 'aria-label': `${title} ${name}`, text: title, onclick: act });
    return make(
      'p',
      { class: 'picked-tools' },
      tool('frame', 'Go there', () => this.parts.frame(this.#picked)),
      tool('isolate', 'Isolate', () => this.hide(true)),
      tool('hide', 'Hide', () => this.hide()),
    );
  }

  #describe({ system, chain, feature, module, interpretation, path, chain_text: text }) {
    const where = [`system ${system + 1}`, `chain ${chain + 1}`];
    if (feature) where.push(`feature ${feature}`);
    if (Number.isFinite(module.index)) where.push(`module ${count(module.index + 1)}`);
    const values = (module.params ?? []).flatMap(({ name, value }) => {
      const full = typeof value === 'object' ? JSON.stringify(value) : String(value);
      return [make('dt', { text: name }), make('dd', { text: short(full), title: full })];
    });
    return [
      make('h3', { class: 'module', text: module.symbol ?? module.text }),
      values.length ? make('dl', { class: 'values' }, ...values) : null,
      make('p', { class: 'where', text: where.join(' · ') }),
      interpretation
        ? make(
            'div',
            { class: 'drawn' },
            make('span', { class: 'caption', text: 'drawn by' }),
            make('code', { text: interpretation.text }),
            this.#place(interpretation),
          )
        : null,
      path?.length ? make('span', { class: 'caption', text: 'came from' }) : null,
      path?.length ? make('ol', { class: 'path' }, ...path.map((it) => this.#step(it))) : null,
      text
        ? make(
            'p',
            { class: 'chain', title: 'The chain around it' },
            `${short(text.before)} `,
            make('mark', { text: short(text.at) }),
            ` ${short(text.after)}`,
          )
        : null,
    ].filter(Boolean);
  }

  #step(it) {
    return make(
      'li',
      {},
      make('span', { class: 'step', text: String(it.step), title: `Step ${it.step}` }),
      make(
        'div',
        {},
        make('code', { class: 'is', text: short(it.module), title: it.module }),
        make('div', { class: 'by' }, make('span', { text: madeBy(it), title: it.answer ?? '' }), this.#place(it)),
        ...(it.asked ?? []).map((asked) =>
          make('div', { class: 'by' }, make('span', { class: 'asked', text: `asked ${short(asked)}`, title: asked })),
        ),
      ),
    );
  }

  #place({ file, line }) {
    if (!file || !line) return null;
    return make(
      'span',
      { class: 'both' },
      this.places.show(file, line),
      this.places.editor
        ? make(
            'button',
            {
              class: 'tool tiny',
              title: `Open ${file}:${line} in the editor`,
              'aria-label': `Open ${file}:${line} in the editor`,
              onclick: () => this.socket.send({ type: 'open', file, line }),
            },
            icon('open'),
          )
        : null,
    );
  }

  #fill(...children) {
    const close = make(
      'button',
      { class: 'tool close', 'aria-label': 'Close', title: 'Close (Esc)', onclick: () => this.close() },
      icon('close'),
    );
    this.#card.replaceChildren(close, ...children.filter(Boolean));
    this.#card.hidden = false;
    this.#card.scrollTop = 0;
  }

  #follow() {
    const at = this.#point && this.stage.pixel(this.#point);
    this.#dot.hidden = !at;
    if (!at) return;
    const box = this.stage.canvas.getBoundingClientRect();
    this.#dot.style.transform = `translate(${at[0] - box.left}px, ${at[1] - box.top}px)`;
  }
}
