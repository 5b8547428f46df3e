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

  /** Materials of the model that is shown, and of the one before it that is kept. */
  #used = null;
  #usedBefore = null;

  /** Whether the model that is shown has all its texture coordinates, which take a third of a file. */
  measured = false;

  /** Shows the model of `message`; `meanwhile` is called while it is drawn. Returns the times (ms), or null if a newer
   *  one has come. */
  async show(message, meanwhile) {
    const mine = ++this.#newest;
    this.#abort?.abort();
    this.#abort = new AbortController();
    const start = performance.now();
    let [model, materials] = [new Model(), null];
    const measured = this.stage.mode === 'uv';
    if (message.url) {
      const url = measured ? message.url.replace(/\.\w+$/, '.uv$&') : message.url;
      const file = await this.#fetch(url, this.#abort.signal);
      if (mine !== this.#newest) return null;
      const glb = new Glb(file);
      materials = await this.#materials.of(glb);
      if (mine !== this.#newest) return null;
      model = build(glb, materials.made, this.#materials.plain);
    }
    const load = performance.now() - start;
    const [before, saved] = [this.stage.model, message.cause === 'save'];
    const draw = this.stage.swap(model, meanwhile, saved);
    this.measured = measured;
    if (this.stage.before === before) this.#usedBefore = this.#used;
    materials?.keep(this.stage.before ? this.#usedBefore : null);
    this.#used = materials;
    return { load, draw, total: load + draw };
  }

  async #fetch(url, signal) {
    // The browser's own store would cost more than fetching the model again.
    const answer = await fetch(url, { signal, cache: 'no-store' });
    if (!answer.ok)
      throw Object.assign(new Error(`the model cannot be fetched (${answer.status})`), { status: answer.status });
    return read(answer, this.progress);
  }
}

/** The body of `answer`. */
async function read(answer, progress) {
  const length = Number(answer.headers.get('content-length'));
  // What lies between may have packed it, and then its length is not known.
  if (!length || answer.headers.has('content-encoding')) return answer.arrayBuffer();
  let [file, at] = [new Uint8Array(length), 0];
  const long = length > STREAMED;
  const [reader, into] = readerOf(answer.body);
  while (at < length) {
    const { done, value } = await reader.read(into ? file.subarray(at) : undefined);
    if (done) throw new Error('the model has come in part only');
    if (into) file = new Uint8Array(value.buffer);
    else file.set(value, at);
    at += value.length;
    if (long) progress(at / length);
  }
  if (long) progress(null);
  return file.buffer;
}

/** A reader, and whether it reads into memory of one's own: that takes a third of the time. */
function readerOf(body) {
  try {
    return [body.getReader({ mode: 'byob' }), true];
  } catch {
    return [body.getReader(), false];
  }
}
