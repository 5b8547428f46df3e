// The derivation as a timeline: a slider over its steps, and playing them one after the other.

import { find, say } from './dom.js';
import { changeIcon } from './icons.js';

const PACE = 140; // ms that each step stays at least
const SPEEDS = [1, 2, 4, 0]; // times as fast; 0 as fast as models come

export class Steps {
  #slider = find('#steps');
  #text = find('#steps-text');
  #play = find('#play');
  #all = find('#all-steps');
  #held = false;
  #timer = 0;
  #speed = find('#speed');
  #times = 1;
  #wanted = 0;
  playing = false;
  last = 0;

  constructor(changes) {
    this.changes = changes;
    this.#slider.addEventListener('input', () => {
      this.pause();
      this.#want(this.#slider.valueAsNumber);
    });
    this.#slider.addEventListener('pointerdown', () => (this.#held = true));
    for (const end of ['pointerup', 'pointercancel']) this.#slider.addEventListener(end, () => (this.#held = false));
    this.#play.addEventListener('click', () => this.toggle());
    this.#all.addEventListener('click', () => this.all());
    this.#speed.addEventListener('click', () => this.faster());
  }

  show({ steps, last_step: last, step_limit: limit }) {
    this.last = Math.max(last, steps);
    find('#timeline').hidden = this.last === 0;
    this.#slider.max = this.last;
    const at = limit === null ? this.last : Math.min(limit, this.last);
    if (!this.#held) this.#slider.value = at;
    this.at = steps;
    this.limited = limit !== null;
    this.#fill();
    say(this.#text, `${steps} / ${this.last}`);
    this.#slider.setAttribute('aria-valuetext', `step ${steps} of ${this.last}`);
    this.#all.disabled = !this.limited;
    this.#ahead();
    this.#slider.disabled = this.#play.disabled = this.#speed.disabled = this.last === 0;
  }

  /** The model of a step has come; at full speed, the server makes the next while this one is drawn. */
  #ahead() {
    if (this.playing && !this.#times && this.at < this.last) this.#want(this.at + 1);
  }

  /** The model of a step has been drawn, so the next may come. */
  drawn() {
    if (!this.playing || (!this.#times && this.at < this.last)) return;
    if (this.at >= this.last) {
      this.pause();
      return this.all();
    }
    clearTimeout(this.#timer);
    // The time that the model took counts, so that slow ones are not slower still.
    const pace = this.#times ? PACE / this.#times : 0;
    const rest = Math.max(pace - (performance.now() - this.#wanted), 0);
    this.#timer = setTimeout(() => this.playing && this.#want(this.at + 1), rest);
  }

  /** Takes the next speed of playing. */
  faster() {
    this.#times = SPEEDS[(SPEEDS.indexOf(this.#times) + 1) % SPEEDS.length];
    say(this.#speed, this.#times ? `${this.#times}×` : 'max');
    this.#speed.setAttribute('aria-label', this.#times ? `Speed of playing: ${this.#times} times` : 'Speed of playing: fastest');
  }

  toggle() {
    if (this.playing) return this.pause();
    if (this.last === 0) return;
    this.playing = true;
    changeIcon(this.#play, 'pause');
    this.#play.setAttribute('aria-label', 'Stop playing');
    this.#want(this.at >= this.last ? 0 : this.at + 1);
  }

  pause() {
    this.playing = false;
    clearTimeout(this.#timer);
    changeIcon(this.#play, 'play');
    this.#play.setAttribute('aria-label', 'Play the derivation');
  }

  move(by) {
    this.pause();
    const now = this.limited ? this.#slider.valueAsNumber : this.last;
    this.#want(Math.min(Math.max(now + by, 0), this.last));
  }

  all() {
    this.pause();
    this.#want(null);
  }

  #want(steps) {
    this.#wanted = performance.now();
    this.#slider.value = steps ?? this.last;
    this.#fill();
    // The end of the slider is all steps, so that a script that grows longer shows all of them again.
    this.changes.send({ type: 'steps', steps: steps === this.last && !this.playing ? null : steps });
  }

  #fill() {
    this.#slider.style.setProperty('--at', `${this.last ? (this.#slider.valueAsNumber / this.last) * 100 : 100}%`);
  }
}
