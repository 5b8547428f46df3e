// Measures between two points of the model: a line with its length, and the distances along the axes.

import { find, say } from './dom.js';
import { label } from './readouts.js';

export class Measure {
  #button = find('#measure');
  #rule = find('#rule');
  #text = find('#rule-text');
  #points = [];

  constructor(stage) {
    this.stage = stage;
    this.#button.addEventListener('click', () => this.toggle());
    stage.onDraw(() => this.#draw());
  }

  get active() {
    return this.#button.getAttribute('aria-pressed') === 'true';
  }

  toggle(on = !this.active) {
    this.#button.setAttribute('aria-pressed', String(on));
    this.stage.canvas.classList.toggle('measuring', on);
    this.clear();
  }

  /** Lets go of the points. */
  clear() {
    this.#points = [];
    this.#draw();
  }

  /** Takes the point of the model at a pixel of the window; after two points a new measurement begins. */
  add(x, y) {
    const hit = this.stage.at(x, y);
    if (!hit) return this.clear();
    if (this.#points.length === 2) this.#points = [];
    this.#points.push(hit.point.clone().add(this.stage.model.origin));
    this.#draw();
  }

  #draw() {
    const box = this.stage.canvas.getBoundingClientRect();
    const pixels = this.#points
      .map((point) => this.stage.pixel(point.clone().sub(this.stage.model.origin)))
      .map((pixel) => pixel && [pixel[0] - box.left, pixel[1] - box.top]);
    const [line, ...dots] = this.#rule.children;
    this.#rule.toggleAttribute('hidden', !pixels.some(Boolean));
    dots.forEach((dot, i) => {
      dot.toggleAttribute('hidden', !pixels[i]);
      if (pixels[i]) dot.setAttribute('transform', `translate(${pixels[i].join(' ')})`);
    });
    const whole = pixels.length === 2 && pixels.every(Boolean);
    line.toggleAttribute('hidden', !whole);
    this.#text.hidden = this.#points.length === 0 || (this.#points.length === 2 && !whole) || !pixels[0];
    if (this.#text.hidden) return;
    const [a, b] = this.#points;
    if (!b) {
      say(this.#text, 'Click a second point');
      this.#text.style.transform = `translate(${pixels[0][0] + 10}px, ${pixels[0][1] - 28}px)`;
      return;
    }
    const [[x1, y1], [x2, y2]] = pixels;
    for (const [name, value] of Object.entries({ x1, y1, x2, y2 })) line.setAttribute(name, value);
    // The page's y is the scene's z.
    const way = b.clone().sub(a);
    const parts = [`x ${label(Math.abs(way.x))}`, `y ${label(Math.abs(way.z))}`, `z ${label(Math.abs(way.y))}`];
    say(this.#text, `${label(way.length())}  (${parts.join(', ')})`);
    this.#text.style.transform = `translate(${(x1 + x2) / 2 + 8}px, ${(y1 + y2) / 2 - 30}px)`;
  }
}
