// From the message `model` to the new model on the screen: fetch, read, swap. Only the newest message counts.

import { Glb } from './glb.js';
import { Materials } from './materials.js';
import { Model, build } from './model.js';

const STREAMED = 32e6; // bytes from which the download tells how far it is

export class Loading {
  #materials;
  #newest = 0;
  #abort = null;

  /** `progress(part)` is called during long downloads with 0 to 1, and with null at their end. */
  constructor(stage, progress) {
    this.stage = stage;
    this.#materials = new Materials(stage.slow);
    this.progress = progress;
  }

  /** Shows the model of `message`. Returns the times (ms), or null if a newer one has come meanwhile. */
  async show(message) {
    const mine = ++this.#newest;
    this.#abort?.abort();
    this.#abort = new AbortController();
    const start = performance.now();
    let [model, keep] = [new Model(), null];
    if (message.url) {
      const file = await this.#fetch(message, this.#abort.signal);
      if (mine !== this.#newest) return null;
      const glb = new Glb(file);
      const materials = await this.#materials.of(glb);
      if (mine !== this.#newest) return null;
      keep = materials.keep;
      model = build(glb, materials.made, this.#materials.plain);
    }
    const load = performance.now() - start;
    const draw = this.stage.swap(model);
    keep?.();
    return { load, draw, total: load + draw };
  }

  async #fetch({ url, bytes }, signal) {
    // The browser's own store would cost more than fetching the model again.
    const answer = await fetch(url, { signal, cache: 'no-store' });
    if (!answer.ok)
      throw Object.assign(new Error(`the model cannot be fetched (${answer.status})`), { status: answer.status });
    if (!(bytes > STREAMED)) return answer.arrayBuffer();
    const reader = answer.body.getReader();
    let [file, length] = [new Uint8Array(bytes), 0];
    for (;;) {
      const { done, value } = await reader.read();
      if (done) break;
      if (length + value.length > file.length) {
        const longer = new Uint8Array((length + value.length) * 2);
        longer.set(file);
        file = longer;
      }
      file.set(value, length);
      length += value.length;
      this.progress(Math.min(length / bytes, 1));
    }
    this.progress(null);
    return length === file.length ? file.buffer : file.buffer.slice(0, length);
  }
}
