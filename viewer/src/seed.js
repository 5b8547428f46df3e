// The seed: a number, a die for another one, and a lock.

import { find } from './dom.js';
import { changeIcon } from './icons.js';

const LARGEST = 2n ** 64n - 1n;

/** A random seed below 2^53, as text. */
export function randomSeed() {
  const [high, low] = crypto.getRandomValues(new Uint32Array(2));
  return String((high & 0x1fffff) * 2 ** 32 + low);
}

export class Seed {
  #field = find('#seed');
  #dice = find('#dice');
  #lock = find('#lock');
  value = '0';

  constructor(changes) {
    this.changes = changes;
    this.#field.addEventListener('change', () => this.#typed());
    this.#dice.addEventListener('click', () => this.roll());
    this.#lock.addEventListener('click', () => this.lock(!this.locked));
  }

  get locked() {
    return this.#lock.getAttribute('aria-pressed') === 'true';
  }

  lock(locked) {
    this.#lock.setAttribute('aria-pressed', String(locked));
    changeIcon(this.#lock, locked ? 'locked' : 'unlocked');
    this.#dice.disabled = locked;
    this.#field.readOnly = locked;
  }

  roll() {
    if (!this.locked) this.use(randomSeed());
  }

  use(seed) {
    this.#field.value = seed;
    this.#field.setAttribute('aria-invalid', 'false');
    this.changes.send({ type: 'seed', seed });
  }

  show(seed) {
    this.value = seed;
    if (document.activeElement !== this.#field) this.#field.value = seed;
  }

  #typed() {
    const text = this.#field.value.trim();
    const valid = /^\d{1,20}$/.test(text) && BigInt(text) <= LARGEST;
    this.#field.setAttribute('aria-invalid', String(!valid));
    if (valid) this.use(String(BigInt(text)));
  }
}
