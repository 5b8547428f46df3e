// Before and after a save: the model before it while a key is held, or both side by side from the same camera.

import { find } from '../dom.js';
import { toast } from '../toast.js';

export class Compare {
  #button = find('#compare');
  #labels = find('#compare-labels');

  constructor(stage) {
    this.stage = stage;
    this.#button.addEventListener('click', () => this.toggle());
    const release = ({ key }) => (key === undefined || key.toLowerCase() === 'b') && this.blink(false);
    addEventListener('keyup', release);
    addEventListener('blur', release);
  }

  get active() {
    return this.stage.seen === 'both';
  }

  toggle(on = !this.active) {
    if (on && !this.stage.before) return toast('There is no model before: save a change of the script first.');
    this.#see(on ? 'both' : 'now');
  }

  /** Shows the model before while `on`. */
  blink(on) {
    if (on && !this.stage.before) return toast('There is no model before: save a change of the script first.');
    if (on ? this.stage.seen === 'now' : this.stage.seen === 'before') this.#see(on ? 'before' : 'now');
  }

  /** A model has come. */
  shown() {
    this.#button.hidden = !this.stage.before;
    this.#tell();
  }

  #see(seen) {
    if (this.stage.seen !== seen) this.stage.seen = seen;
    this.#tell();
  }

  #tell() {
    const { seen } = this.stage;
    this.#button.setAttribute('aria-pressed', String(seen === 'both'));
    this.#labels.hidden = seen === 'now';
    this.#labels.dataset.seen = seen;
  }
}
