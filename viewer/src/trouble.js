// How things stand: errors over the last good model, waiting, working, the connection.

import { find, make, say } from './dom.js';
import { age, count } from './format.js';
import { icon } from './icons.js';

export class Trouble {
  #error = find('#error');
  #warnings = find('#warnings');
  #waiting = find('#waiting');
  #stale = find('#stale');
  #stage = find('#stage');
  #clock = 0;
  #since = 0;

  constructor(places) {
    this.places = places;
  }

  /** `drawn` tells whether there is a model to be stale. */
  error({ errors }, drawn) {
    this.#waiting.hidden = this.#warnings.hidden = true;
    this.#error.classList.remove('folded');
    this.#list(this.#error, errors.length > 1 ? `${errors.length} errors` : 'Error', errors);
    this.#age(drawn);
  }

  /** What should be known of a good model, folded until someone wants to read it. */
  warnings(warnings) {
    if (warnings.length === 0) {
      this.#warnings.hidden = true;
      this.#warnings.replaceChildren();
      return;
    }
    if (this.#warnings.childElementCount === 0) this.#warnings.classList.add('folded');
    this.#list(this.#warnings, warnings.length > 1 ? `${warnings.length} warnings` : '1 warning', warnings);
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
    this.#error.hidden = true;
    say(this.#waiting, text);
    this.#waiting.hidden = false;
    this.#age(drawn);
  }

  /** A good model has come. */
  clear() {
    this.#error.hidden = this.#waiting.hidden = this.#stale.hidden = true;
    this.#error.replaceChildren();
    this.#stage.classList.remove('is-stale');
    clearInterval(this.#clock);
    this.#since = 0;
  }

  #age(drawn) {
    if (!drawn) return;
    this.#stage.classList.add('is-stale');
    this.#since ||= Date.now();
    this.#stale.hidden = false;
    const tell = () => say(this.#stale, `stale, ${age((Date.now() - this.#since) / 1000)}`);
    clearInterval(this.#clock);
    this.#clock = setInterval(tell, 1000);
    tell();
  }

  #describe({ message, file, line, rule, module, step, help, more, count: times }) {
    const facts = [];
    if (times > 1) facts.push(['times', count(times)]);
    if (rule) facts.push(['rule', rule]);
    if (module) facts.push(['module', module]);
    if (step !== null && step !== undefined) facts.push(['step', String(step)]);
    return make(
      'article',
      {},
      file ? make('div', { class: 'error-place' }, this.places.open(file, line)) : null,
      make('p', { class: 'error-message', text: message }),
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
      help ? make('p', { class: 'error-help', text: help }) : null,
      more ? make('pre', { text: Array.isArray(more) ? more.join('\n') : String(more) }) : null,
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

/** The thin bar while the server works or a model is on its way. */
export class Working {
  #bar = find('#working');
  #done = find('#working-done');
  #text = find('#working-text');
  #timer = 0;
  busy = false;

  constructor(socket) {
    this.socket = socket;
    find('#cancel').addEventListener('click', () => this.cancel());
  }

  start({ cause, files }) {
    this.busy = true;
    this.#cause = `${CAUSES[cause] ?? 'Working'}${cause === 'save' && files?.length ? `: ${files.join(', ')}` : ''}`;
    clearTimeout(this.#timer);
    this.#timer = setTimeout(() => this.#show(this.#cause, null), PATIENCE);
  }

  #cause = '';

  progress({ message, step, steps, modules }) {
    if (!this.busy) return;
    clearTimeout(this.#timer);
    const parts = [message];
    if (steps) parts.push(`step ${step} of ${steps}`);
    else if (step) parts.push(`step ${step}`);
    if (modules) parts.push(`${count(modules)} modules`);
    this.#show(parts.join(' · '), steps ? step / steps : null);
  }

  download(part) {
    if (part === null) return this.stop();
    this.#show(`Fetching the model, ${Math.round(part * 100)} %`, part);
  }

  stop() {
    this.busy = false;
    clearTimeout(this.#timer);
    this.#bar.hidden = true;
  }

  cancel() {
    if (!this.busy) return false;
    this.socket.send({ type: 'cancel' });
    return true;
  }

  #show(text, part) {
    say(this.#text, text);
    this.#bar.classList.toggle('unknown', part === null);
    this.#done.style.width = part === null ? '' : `${part * 100}%`;
    this.#bar.hidden = false;
  }
}

/** A line that goes away by itself. */
export function toast(text) {
  const place = find('#toast');
  say(place, text);
  place.hidden = false;
  clearTimeout(toast.timer);
  toast.timer = setTimeout(() => (place.hidden = true), 5000);
}

export function connection(state) {
  const place = find('#connection');
  place.dataset.state = state;
  say(place, { live: 'live', lost: 'connection lost, trying again', connecting: 'connecting' }[state]);
}
