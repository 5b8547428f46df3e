// How things stand: errors over the last good model, waiting, working, the connection.

import { find, make, say } from './dom.js';
import { age, count, many } from './format.js';
import { icon } from './icons.js';

export class Trouble {
  #error = find('#error');
  #warnings = find('#warnings');
  #waiting = find('#waiting');
  #cancelled = find('#cancelled');
  #nothing = find('#nothing');
  #stale = find('#stale');
  #stage = find('#stage');
  #clock = 0;
  #since = 0;
  /** Since when the model has been stale that the server tells next. */
  #known = null;

  constructor(places) {
    this.places = places;
  }

  /** `drawn` tells whether there is a model to be stale. */
  error({ errors, number = errors.length }, drawn) {
    this.#hide();
    this.#error.classList.remove('folded');
    const left_out = number - errors.length;
    this.#list(this.#error, number > 1 ? `${count(number)} errors` : 'Error', errors);
    if (left_out > 0)
      find('.error-list', this.#error).append(
        make('article', { class: 'where', text: `${many(left_out, 'more error')}: the terminal has all of them` }),
      );
    this.#age(drawn);
  }

  /** What should be known of a good model, folded until someone wants to read it. */
  warnings(warnings, notes) {
    const all = [...warnings, ...notes];
    if (all.length === 0) {
      this.#warnings.hidden = true;
      this.#warnings.replaceChildren();
      return;
    }
    if (this.#warnings.childElementCount === 0) this.#warnings.classList.add('folded');
    const titles = [warnings.length && many(warnings.length, 'warning'), notes.length && many(notes.length, 'note')];
    this.#list(this.#warnings, titles.filter(Boolean).join(', '), all);
  }

  /** Lists errors or warnings in a card that can be folded. */
  #list(card, title, problems) {
    const close = make(
      'button',
      {
        class: 'tool',
        'aria-label': 'Fold',
        title: 'Fold',
        'aria-expanded': String(!card.classList.contains('folded')),
        onclick: () => close.setAttribute('aria-expanded', String(!card.classList.toggle('folded'))),
      },
      icon('fold'),
    );
    card.replaceChildren(
      make('div', { class: 'error-head' }, make('strong', { text: title }), close),
      make('div', { class: 'error-list' }, ...problems.map((problem) => this.#describe(problem))),
    );
    card.hidden = false;
  }

  waiting({ text }, drawn) {
    this.#hide();
    say(this.#waiting, text);
    this.#waiting.hidden = false;
    this.#age(drawn);
  }

  /** A page has cancelled the run, and nothing newer is on its way. */
  cancelled(drawn) {
    this.#cancelled.hidden = !drawn;
    this.#age(drawn);
  }

  /** Why nothing is seen in a good model; `text` is null if something is. */
  nothing(text) {
    this.#nothing.hidden = !text;
    say(this.#nothing, text ? `Nothing to see: ${text}` : '');
  }

  /** What the server tells is as old as this (s), or null if it is not stale. */
  aged(seconds) {
    this.#known = seconds === null ? null : Date.now() - seconds * 1000;
  }

  /** Another run has begun. */
  again() {
    this.#cancelled.hidden = true;
  }

  #hide() {
    this.#error.hidden = this.#waiting.hidden = this.#warnings.hidden = true;
    this.#cancelled.hidden = this.#nothing.hidden = true;
  }

  /** A good model has come. */
  clear() {
    this.#error.hidden = this.#waiting.hidden = this.#cancelled.hidden = this.#stale.hidden = true;
    this.#error.replaceChildren();
    this.#stage.classList.remove('is-stale');
    clearInterval(this.#clock);
    this.#since = 0;
  }

  #age(drawn) {
    if (!drawn) return;
    this.#stage.classList.add('is-stale');
    this.#since ||= this.#known ?? Date.now();
    this.#known = null;
    this.#stale.hidden = false;
    const tell = () => say(this.#stale, `stale, ${age((Date.now() - this.#since) / 1000)}`);
    clearInterval(this.#clock);
    this.#clock = setInterval(tell, 1000);
    tell();
  }

  #describe({ message, file, line, excerpt, called_at: caller, rule, module, step, help, count: times }) {
    const facts = [];
    if (times > 1) facts.push(['times', count(times)]);
    if (caller) facts.push(['called at', `${caller.file}:${caller.line}`]);
    if (rule) facts.push(['rule', rule]);
    if (module) facts.push(['module', module]);
    if (step !== null && step !== undefined) facts.push(['step', String(step)]);
    return make(
      'article',
      {},
      file ? make('div', { class: 'error-place' }, this.places.open(file, line)) : null,
      make('p', { class: 'error-message', text: message }),
      help ? make('p', { class: 'error-help', text: help }) : null,
      excerpt?.length
        ? make(
            'pre',
            { class: 'excerpt' },
            ...excerpt.map((it) =>
              make(
                'span',
                { class: it.line === line ? 'here' : null },
                make('i', { text: it.line }),
                make('code', { text: it.text }),
              ),
            ),
          )
        : null,
      facts.length
        ? make(
            'dl',
            {},
            ...facts.flatMap(([name, value]) => [
              make('dt', { text: name }),
              make('dd', {}, make('code', { text: value })),
            ]),
          )
        : null,
    );
  }
}

const CAUSES = {
  start: 'Running',
  save: 'Saved',
  parameters: 'New values',
  seed: 'New seed',
  steps: 'Steps',
  preset: 'Preset',
};
const PATIENCE = 120; // ms of work that show nothing, so that quick models do not flicker
const SELDOM = 800; // ms between two lines of progress where each frame of the page takes time from the server

/** The thin bar while the server works or a model is on its way. */
export class Working {
  #pill = find('#working');
  #track = find('#track');
  #done = find('#working-done');
  #text = find('#working-text');
  #timer = 0;
  busy = false;

  #told = -Infinity;

  /** `slow`: there is no graphics card, so the page keeps still. */
  constructor(socket, slow) {
    this.socket = socket;
    this.slow = slow;
    this.#track.classList.toggle('still', slow);
    find('#cancel').addEventListener('click', () => this.cancel());
  }

  start({ cause, files }) {
    this.busy = true;
    this.#told = -Infinity;
    this.#cause = `${CAUSES[cause] ?? 'Working'}${cause === 'save' && files?.length ? `: ${files.join(', ')}` : ''}`;
    clearTimeout(this.#timer);
    this.#timer = setTimeout(() => this.#show(this.#cause, null), PATIENCE);
  }

  #cause = '';

  progress({ message, step, steps }) {
    if (!this.busy || (this.slow && performance.now() - this.#told < SELDOM)) return;
    this.#told = performance.now();
    clearTimeout(this.#timer);
    this.#show(message, steps ? step / steps : null);
  }

  download(part) {
    if (part === null) return this.stop();
    this.#show(`Fetching the model, ${Math.round(part * 100)} %`, part);
  }

  stop() {
    this.busy = false;
    clearTimeout(this.#timer);
    this.#pill.hidden = this.#track.hidden = true;
  }

  cancel() {
    if (!this.busy) return false;
    this.socket.send({ type: 'cancel' });
    return true;
  }

  #show(text, part) {
    say(this.#text, text);
    this.#text.title = text;
    this.#track.classList.toggle('unknown', part === null);
    this.#done.style.width = part === null ? '' : `${part * 100}%`;
    this.#pill.hidden = this.#track.hidden = false;
  }
}

export function connection(state) {
  const place = find('#connection');
  place.dataset.state = state;
  const texts = {
    live: 'live',
    lost: 'offline',
    connecting: 'connecting',
    moved: 'the server has a new address',
  };
  say(place, texts[state]);
  place.title = state === 'lost' ? 'The connection is lost; it is tried again' : '';
  find('#moved').hidden = state !== 'moved';
}
