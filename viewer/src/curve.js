// The editor of a drawn function, curve or surface: a plot with points that can be dragged, added and removed.

import * as bezier from './bezier.js';
import { make, say, svg } from './dom.js';
import { icon } from './icons.js';
import { plain } from './format.js';
import { outline } from './outline.js';
import { evenRanges, fineness, functionRanges, label, rounded, ticks } from './plot.js';
import { together, placeAfter, withCurvePoint, withFunctionPoint, withoutPoint } from './points.js';
import { clearToast, toast } from './toast.js';

const HEIGHT = 172;
const EDGE = { left: 34, right: 8, top: 8, bottom: 20 };
/** How near (px) the pointer has to be to the curve to mean it. */
const NEAR = 14;
/** Distance (px) of the grid's lines, across and up. */
const SPACING = [42, 27];
/** Radius (px) around a point in which the pointer means it. */
const REACH = 13;
const VIEWS = { Top: [0, 1], Front: [0, 2], Side: [1, 2] };
const NAMES = ['x', 'y', 'z'];
const HELP = 'Drag a point. Double-click the curve to add one, and a point to remove it. Arrow keys move the chosen point.';
const SURFACE_HELP = 'Drag a point. Points at the same place move together, except with Alt. Arrow keys move the chosen point.';

export class CurveEditor {
  #points = [];
  #pieces = [];
  #good = [];
  #chosen = 0;
  #ranges = null;
  #size = [280, HEIGHT];
  #axes = VIEWS.Top;
  #past = [];
  #future = [];
  #asking = false;
  #later = null;
  #drag = null;

  /** `row` is the row of the parameter: it sends values, and knows the parameter. */
  constructor(row, param) {
    this.row = row;
    this.control = param.control;
    this.#axes = this.control.columns ? widest(param.value, this.control.columns) : VIEWS.Top;
    const name = param.name;
    this.grid = svg('g', { class: 'plot-grid' });
    this.drawing = svg('g', { class: 'plot-drawing' });
    this.handles = svg('g', { class: 'plot-points' });
    this.probe = svg('g', { class: 'plot-probe' });
    this.plot = svg(
      'svg',
      { class: 'plot', role: 'group', 'aria-label': `Points of ${name}`, 'data-testid': `${row.id}-plot` },
      this.grid,
      this.drawing,
      this.probe,
      this.handles,
    );
    this.where = make('span', { class: 'plot-where', 'aria-hidden': 'true' });
    this.fields = NAMES.slice(0, this.width).map((axis) => this.#field(axis));
    const button = (action, title, shown, act) =>
      make(
        'button',
        { class: 'tool', title, 'aria-label': `${title} of ${name}`, 'data-testid': `${row.id}-${action}`, onclick: act },
        icon(shown),
      );
    this.adder = button('add', 'Add a point after the chosen one', 'save', () => this.#addAfter());
    this.remover = button('remove', 'Remove the chosen point', 'trash', () => this.#remove(this.#chosen));
    this.saver = make('button', {
      class: 'small plot-save',
      text: 'Save',
      title: 'Save the drawing in a file beside the script, where every run finds it',
      'aria-label': `Save ${name}`,
      'data-testid': `${row.id}-save`,
      onclick: () => this.#store(),
    });
    this.original = make('button', {
      class: 'link plot-script',
      text: 'Script’s own',
      title: 'Show the values of the script. Save removes the drawing from the file.',
      'data-testid': `${row.id}-script`,
      onclick: () => this.#change(copy(this.row.param.script_default), true),
    });
    this.problem = make('p', { class: 'note', role: 'status', hidden: true });
    this.element = make(
      'div',
      { class: 'curve', 'data-testid': this.row.id },
      this.control.space === 'space' ? this.#views(name) : null,
      make('div', { class: 'plot-frame' }, this.plot, this.where),
      make(
        'div',
        { class: 'plot-foot' },
        ...this.fields.map((field) => field.label),
        ...(this.control.columns ? [] : [this.adder, this.remover]),
        make('span', { class: 'push' }),
        this.original,
        this.saver,
      ),
      this.problem,
    );
    this.plot.append(svg('title'));
    this.plot.lastChild.textContent = this.control.columns ? SURFACE_HELP : HELP;
    this.#listen();
    new ResizeObserver(([{ contentRect }]) => this.#resize(contentRect.width)).observe(this.element);
  }

  get width() {
    return this.control.space === 'space' ? 3 : 2;
  }

  /** Whether the page shows something that the server has not been told. */
  get busy() {
    return this.#drag !== null || this.#asking || this.#later !== null;
  }

  limits(control) {
    this.control = control;
  }

  /** Shows points that the server has, or the default. */
  put(points) {
    const same = JSON.stringify(points) === JSON.stringify(this.row.param.value);
    if (JSON.stringify(points) !== JSON.stringify(this.#points)) this.#past.length = this.#future.length = 0;
    this.#points = copy(points);
    this.#good = copy(points);
    this.#chosen = Math.min(this.#chosen, points.length - 1);
    this.problem.hidden = true;
    if (same) this.#pieces = this.control.pieces;
    else this.#ask(points, false);
    this.#fit();
    this.#draw();
  }

  /** Shows what can be done with the value. */
  update({ changed, script_default: own }) {
    this.saver.disabled = !changed;
    this.original.hidden = !own || JSON.stringify(own) === JSON.stringify(this.#points);
  }

  #views(name) {
    const radios = Object.entries(VIEWS).map(([view, axes]) =>
      make(
        'label',
        { title: `${NAMES[axes[0]]} to the right, ${NAMES[axes[1]]} up` },
        make('input', {
          type: 'radio',
          name: `${this.row.id}-view`,
          checked: axes === this.#axes,
          'data-testid': `${this.row.id}-view-${view.toLowerCase()}`,
          onchange: () => {
            this.#axes = axes;
            this.#fit();
            this.#draw();
          },
        }),
        make('span', { text: `${view} ${NAMES[axes[0]]}${NAMES[axes[1]]}` }),
      ),
    );
    return make('div', { class: 'segments', role: 'radiogroup', 'aria-label': `View of ${name}` }, ...radios);
  }

  #field(axis) {
    const index = NAMES.indexOf(axis);
    const input = make('input', {
      type: 'number',
      id: index === 0 ? this.row.id : null,
      step: 'any',
      autocomplete: 'off',
      'aria-label': `${axis} of the chosen point of ${this.row.name}`,
      'data-testid': `${this.row.id}-${axis}`,
      onblur: () => this.#draw(),
      onchange: () => {
        const value = input.valueAsNumber;
        if (!Number.isFinite(value)) return this.#draw();
        const points = copy(this.#points);
        const moved = this.control.columns ? together(points, this.#chosen) : [this.#chosen];
        for (const other of moved) points[other][index] = value;
        this.#change(points, true);
      },
    });
    return { label: make('label', { class: 'plot-field' }, make('span', { text: axis }), input), input };
  }

  // Geometry of the plot

  #resize(width) {
    const height = this.control.space === 'function' ? HEIGHT : Math.min(width, 300);
    if (width < 40 || (this.#size[0] === width && this.#size[1] === height)) return;
    this.#size = [width, height];
    this.#fit();
    this.#draw();
  }

  get #inner() {
    const [width, height] = this.#size;
    return [width - EDGE.left - EDGE.right, height - EDGE.top - EDGE.bottom];
  }

  #fit() {
    if (this.#drag || this.#points.length === 0) return;
    const all = [...this.#points, ...this.#pieces.flat()];
    this.#ranges =
      this.control.space === 'function'
        ? functionRanges(this.#points, this.#pieces)
        : evenRanges(all, this.#axes, this.#inner);
  }

  #pixel(point) {
    const [[left, right], [bottom, top]] = this.#ranges;
    const [width, height] = this.#inner;
    const [across, up] = this.#axes;
    return [
      EDGE.left + ((point[across] - left) / (right - left)) * width,
      EDGE.top + ((top - point[up]) / (top - bottom)) * height,
    ];
  }

  /** The two coordinates at a pixel, within the plot. */
  #place([x, y]) {
    const [[left, right], [bottom, top]] = this.#ranges;
    const [width, height] = this.#inner;
    const part = (value) => Math.min(Math.max(value, 0), 1);
    return [
      left + part((x - EDGE.left) / width) * (right - left),
      top - part((y - EDGE.top) / height) * (top - bottom),
    ];
  }

  get #steps() {
    return this.#ranges.map(([low, high]) => fineness(high - low));
  }

  #nearest(pixel) {
    if (this.#pieces.length === 0) return { far: Infinity };
    return bezier.nearest(this.#pieces, (point) => distance(this.#pixel(point), pixel));
  }

  // Drawing

  #draw() {
    if (!this.#ranges || this.#points.length === 0) return;
    const [width, height] = this.#size;
    this.plot.setAttribute('viewBox', `0 0 ${width} ${height}`);
    this.plot.setAttribute('height', height);
    this.#drawGrid();
    this.#drawCurve();
    this.#drawPoints();
    const point = this.#points[this.#chosen];
    this.fields.forEach(({ input }, axis) => {
      if (document.activeElement !== input || this.#drag) input.value = plain(point[axis]);
    });
    const least = this.control.closed ? 3 : 2;
    this.remover.disabled = this.#points.length <= (this.control.kind === 'bezier' ? 4 : least);
    const own = this.row.param?.script_default;
    this.original.hidden = !own || JSON.stringify(own) === JSON.stringify(this.#points);
  }

  #drawGrid() {
    const [width, height] = this.#inner;
    const [xs, ys] = this.#ranges;
    const parts = [svg('rect', { x: EDGE.left, y: EDGE.top, width, height, class: 'plot-area' })];
    const line = (at, along, value) => {
      const ends = along === 'x' ? { x1: at, x2: at, y1: EDGE.top, y2: EDGE.top + height } : { y1: at, y2: at, x1: EDGE.left, x2: EDGE.left + width };
      parts.push(svg('line', { ...ends, class: value === 0 ? 'zero' : '' }));
    };
    const text = (value, x, y, anchor) => {
      const element = svg('text', { x, y, 'text-anchor': anchor });
      element.textContent = label(value);
      parts.push(element);
    };
    const [across, up] = this.#axes;
    const at = (value, axis) => this.#pixel(Object.assign([0, 0, 0], { [axis]: value }));
    const even = this.control.space !== 'function';
    const xTicks = ticks(...xs, width / SPACING[0]);
    for (const value of xTicks.list) {
      const [x] = at(value, across);
      line(x, 'x', value);
      text(value, x, EDGE.top + height + 13, x > EDGE.left + width - 10 ? 'end' : 'middle');
    }
    for (const value of ticks(...ys, height / SPACING[even ? 0 : 1]).list) {
      const [, y] = at(value, up);
      line(y, 'y', value);
      text(value, EDGE.left - 5, y + 3.5, 'end');
    }
    this.grid.replaceChildren(...parts);
  }

  #drawCurve() {
    const [width, height] = this.#inner;
    const area = { left: EDGE.left, top: EDGE.top, width, height };
    const base = this.#pixel([0, Math.min(Math.max(0, this.#ranges[1][0]), this.#ranges[1][1])])[1];
    const parts = outline(this.control, this.#points, this.#pieces, (point) => this.#pixel(point), area, base);
    const clip = svg('svg', { x: area.left, y: area.top, width, height, viewBox: `${area.left} ${area.top} ${width} ${height}` }, ...parts);
    this.drawing.replaceChildren(clip);
  }

  #drawPoints() {
    const count = this.#points.length;
    while (this.handles.childElementCount > count) this.handles.lastChild.remove();
    while (this.handles.childElementCount < count) {
      const handle = svg('g', { class: 'plot-point', role: 'button' }, svg('circle', { r: REACH, class: 'plot-reach' }), svg('circle', { r: 4.5 }), svg('title'));
      this.handles.append(handle);
    }
    [...this.handles.children].forEach((handle, index) => {
      const point = this.#points[index];
      const [x, y] = this.#pixel(point);
      handle.setAttribute('transform', `translate(${x.toFixed(2)} ${y.toFixed(2)})`);
      handle.setAttribute('tabindex', index === this.#chosen ? 0 : -1);
      handle.classList.toggle('chosen', index === this.#chosen);
      handle.classList.toggle('arm', this.control.kind === 'bezier' && !this.control.columns && index % 3 !== 0);
      const text = point.map((value, axis) => `${NAMES[axis]} ${plain(value)}`).join(', ');
      handle.setAttribute('aria-label', `Point ${index + 1} of ${count}: ${text}`);
      say(handle.lastChild, `Point ${index + 1}: ${text}`);
    });
  }

  #showWhere(pixel) {
    const hit = this.#ranges && pixel ? this.#nearest(pixel) : { far: Infinity };
    let point = null;
    if (this.control.space === 'function' && pixel && this.#pieces.length) {
      const [x] = this.#place(pixel);
      point = [x, bezier.height(this.#pieces, x)];
    } else if (hit.far < NEAR * 2) point = hit.point;
    if (this.#drag) point = this.#points[this.#chosen];
    const steps = this.#steps;
    const shown = point?.slice(0, this.width).map((value, axis) => `${NAMES[axis]} ${label(rounded(value, steps[Math.min(axis, 1)]))}`);
    say(this.where, shown ? shown.join('   ') : '');
    if (!point || this.#drag) return this.probe.replaceChildren();
    const [x, y] = this.#pixel(point);
    const parts = [svg('circle', { cx: x, cy: y, r: 3 })];
    if (this.control.space === 'function') parts.unshift(svg('line', { x1: x, x2: x, y1: EDGE.top, y2: this.#size[1] - EDGE.bottom }));
    this.probe.replaceChildren(...parts);
  }

  // Pointer and keys

  #listen() {
    const { plot } = this;
    const pixel = ({ clientX, clientY }) => {
      const box = plot.getBoundingClientRect();
      return [clientX - box.left, clientY - box.top];
    };
    const handleOf = (event) => {
      const handle = event.target.closest('.plot-point');
      return handle ? [...this.handles.children].indexOf(handle) : -1;
    };
    plot.addEventListener('pointerdown', (event) => {
      const index = handleOf(event);
      if (index < 0 || event.button !== 0) return;
      event.preventDefault();
      this.#choose(index);
      plot.setPointerCapture(event.pointerId);
      const [x, y] = this.#pixel(this.#points[index]);
      const [px, py] = pixel(event);
      this.#drag = { before: copy(this.#points), points: this.#moved(event), offset: [x - px, y - py], id: event.pointerId };
      plot.classList.add('dragging');
    });
    plot.addEventListener('pointermove', (event) => {
      if (!this.#drag || event.pointerId !== this.#drag.id) return this.#showWhere(pixel(event));
      const [x, y] = pixel(event);
      let place = this.#place([x + this.#drag.offset[0], y + this.#drag.offset[1]]);
      if (event.ctrlKey || event.metaKey) {
        const [width, height] = this.#inner;
        const grid = [width, height].map((size, i) => ticks(...this.#ranges[i], size / SPACING[i]).step);
        place = place.map((value, i) => rounded(value, grid[i] / 2));
      }
      this.#drag.moved = true;
      this.#move(this.#drag.points, place);
      this.#showWhere(pixel(event));
    });
    const stop = (event) => {
      if (!this.#drag || event.pointerId !== this.#drag.id) return;
      const { before, moved } = this.#drag;
      this.#drag = null;
      plot.classList.remove('dragging');
      if (moved) this.#commit(before);
    };
    plot.addEventListener('pointerup', stop);
    plot.addEventListener('pointercancel', stop);
    plot.addEventListener('pointerleave', () => this.#drag || this.#showWhere(null));
    plot.addEventListener('dblclick', (event) => {
      event.preventDefault();
      // The plot has captured the pointer, so the event does not tell the point.
      const place = pixel(event);
      const distances = this.#points.map((point) => distance(this.#pixel(point), place));
      const index = distances.indexOf(Math.min(...distances));
      if (distances[index] < REACH) this.#remove(index);
      else this.#addAt(place);
    });
    this.handles.addEventListener('focusin', (event) => {
      const index = handleOf(event);
      if (index >= 0 && index !== this.#chosen) this.#choose(index, false);
    });
    this.element.addEventListener('keydown', (event) => this.#key(event));
  }

  #key(event) {
    const undo = (event.ctrlKey || event.metaKey) && event.key.toLowerCase() === 'z';
    if (event.target.matches('input')) return;
    if (undo) {
      event.preventDefault();
      return event.shiftKey ? this.#travel(this.#future, this.#past) : this.#travel(this.#past, this.#future);
    }
    if (!event.target.closest('.plot-point') || event.ctrlKey || event.metaKey) return;
    const arrows = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] };
    const count = this.#points.length;
    const jumps = { PageUp: this.#chosen - 1, PageDown: this.#chosen + 1, Home: 0, End: count - 1 };
    if (event.key in arrows) {
      const far = event.shiftKey ? 0.1 : event.altKey ? 0.001 : 0.01;
      const point = this.#points[this.#chosen];
      const place = arrows[event.key].map((sign, i) => {
        const [low, high] = this.#ranges[i];
        const step = 10 ** Math.round(Math.log10((high - low) * far));
        return Number((point[this.#axes[i]] + sign * step).toPrecision(12));
      });
      const before = copy(this.#points);
      this.#move(this.#moved(event), place, true);
      this.#commit(before);
    } else if (event.key in jumps) this.#choose((jumps[event.key] + count) % count);
    else if (event.key === 'Delete' || event.key === 'Backspace') this.#remove(this.#chosen);
    else if (event.key === 'Insert' || event.key === 'Enter') this.#addAfter();
    else return;
    event.preventDefault();
    event.stopPropagation();
  }

  #choose(index, focus = true) {
    this.#chosen = index;
    this.#draw();
    if (focus) this.handles.children[index]?.focus({ preventScroll: true });
  }

  /** The points that move with the chosen one: those at its place, as at the tip of a leaf. */
  #moved({ altKey }) {
    return this.control.columns && !altKey ? together(this.#points, this.#chosen) : [this.#chosen];
  }

  // Changes

  /** Moves the chosen point, and the others in `moved`, to a place of the plot; a function keeps the order of its points. */
  #move(moved, place, exact = false) {
    const index = this.#chosen;
    const points = copy(this.#points);
    const steps = this.#steps;
    const values = exact ? place : place.map((value, i) => rounded(value, steps[i]));
    if (this.control.space === 'function') {
      const [before, after] = [points[index - 1]?.[0], points[index + 1]?.[0]];
      if (before !== undefined) values[0] = Math.max(values[0], rounded(before + steps[0], steps[0]));
      if (after !== undefined) values[0] = Math.min(values[0], rounded(after - steps[0], steps[0]));
      // Neighbours nearer than a step stay as they are.
      if (values[0] <= before || values[0] >= after) values[0] = points[index][0];
    }
    for (const other of moved) this.#axes.forEach((axis, i) => (points[other][axis] = values[i]));
    this.#points = points;
    this.#draw();
    this.#ask(points, true);
  }

  #commit(before) {
    if (JSON.stringify(before) !== JSON.stringify(this.#points)) {
      this.#past.push(before);
      this.#future.length = 0;
    }
    this.#fit();
    this.#draw();
  }

  /** Takes new points, as one change that can be undone. */
  #change(points, send) {
    const before = this.#points;
    this.#points = copy(points);
    this.#chosen = Math.min(this.#chosen, points.length - 1);
    this.#commit(before);
    this.#ask(this.#points, send);
  }

  #travel(from, to) {
    const points = from.pop();
    if (!points) return;
    to.push(this.#points);
    this.#points = points;
    this.#chosen = Math.min(this.#chosen, points.length - 1);
    this.#fit();
    this.#draw();
    this.handles.children[this.#chosen].focus({ preventScroll: true });
    this.#ask(points, true);
  }

  #addAt(pixel) {
    if (this.control.columns) return;
    const hit = this.#nearest(pixel);
    if (this.control.space === 'function') {
      const [x, y] = this.#place(pixel).map((value, i) => rounded(value, this.#steps[i]));
      const onCurve = rounded(bezier.height(this.#pieces, x), this.#steps[1] / 10);
      return this.#take(withFunctionPoint(this.#points, x, hit.far < NEAR ? onCurve : y));
    }
    if (hit.far < NEAR) this.#take(this.#withCurvePoint(hit));
  }

  #addAfter() {
    if (this.control.columns) return;
    const hit = placeAfter(this.control, this.#points, this.#pieces, this.#chosen);
    if (this.control.space === 'function') return this.#take(withFunctionPoint(this.#points, ...hit.point));
    this.#take(this.#withCurvePoint(hit));
  }

  #withCurvePoint(hit) {
    const apart = (a, b) => distance(this.#pixel(a), this.#pixel(b));
    const { points, index } = withCurvePoint(this.control, this.#points, this.#pieces, hit, apart);
    return { points: points.map((point) => point.slice(0, this.width)), index };
  }

  #remove(index) {
    if (this.control.columns) return;
    if (this.remover.disabled) return toast(`${this.row.name} needs its last points`);
    const points = withoutPoint(this.control, this.#points, index);
    this.#take({ points, index: Math.min(index, points.length - 1) });
  }

  /** Takes points after one has been added or removed, and chooses a point. */
  #take(next) {
    if (!next) return;
    this.#chosen = next.index;
    this.#change(next.points, true);
    this.#choose(next.index);
  }

  // Server

  /** Asks for the outline of points, one question at a time, and then sends them as the value. */
  #ask(points, send) {
    if (this.#asking) {
      this.#later = { points, send };
      return;
    }
    this.#asking = true;
    const done = (answer) => {
      clearTimeout(patience);
      if (!this.#asking) return;
      this.#asking = false;
      const later = this.#later;
      this.#later = null;
      if (answer?.type === 'outline') {
        this.#pieces = answer.pieces;
        this.#good = points;
        this.problem.hidden = true;
        this.plot.classList.remove('wrong');
        if (send) this.row.send(JSON.stringify(points));
      } else if (answer) {
        this.plot.classList.add('wrong');
        say(this.problem, answer.text);
        this.problem.hidden = false;
      }
      if (later) this.#ask(later.points, later.send);
      else if (answer?.type === 'refused' && !this.#drag) this.#restore();
      if (!later) this.#fit();
      this.#draw();
      // A value of the server may have come meanwhile.
      if (!later && !send) this.row.putBack();
    };
    // Without a connection there is no answer.
    const patience = setTimeout(() => done(null), 3000);
    this.row.changes.ask({ type: 'outline', param: this.row.name, points }, done);
  }

  /** Goes back to the last points that are a curve. */
  #restore() {
    toast(this.problem.textContent);
    this.problem.hidden = true;
    this.plot.classList.remove('wrong');
    this.#points = copy(this.#good);
    this.#chosen = Math.min(this.#chosen, this.#points.length - 1);
    this.#past.pop();
  }

  #store() {
    clearToast();
    this.row.changes.ask({ type: 'store', param: this.row.name, points: this.#points }, (answer) => {
      toast(answer.type === 'stored' ? `Saved in ${answer.file}` : answer.text);
      this.saver.disabled ||= answer.type === 'stored';
    });
  }
}

const copy = (points) => points.map((point) => [...point]);

const distance = (a, b) => Math.hypot(...a.map((value, axis) => value - b[axis]));

/** The view in which the cells of a net cover the largest area. */
function widest(points, columns) {
  const area = ([across, up]) => {
    let sum = 0;
    for (let i = 0; i + columns + 1 < points.length; i += 1) {
      if ((i + 1) % columns === 0) continue;
      const [from, to] = [points[i], points[i + columns + 1]];
      const [right, above] = [points[i + 1], points[i + columns]];
      // Half of the cross product of the diagonals.
      const cross = (to[across] - from[across]) * (above[up] - right[up]) - (to[up] - from[up]) * (above[across] - right[across]);
      sum += Math.abs(cross) / 2;
    }
    return sum;
  };
  return Object.values(VIEWS).reduce((best, axes) => (area(axes) > area(best) ? axes : best));
}
