// The card of a picked feature: its id, its attributes and its tile; or of what is missing, with the cause.

import { find, make } from '../dom.js';
import { many, short } from '../format.js';
import { icon } from '../icons.js';
import { degrees } from './panel.js';

export class FeatureCard {
  #card = find('#card');
  #dot = find('#dot');
  /** Geocentric point that the card is about. */
  #point = null;

  constructor(stage, shown) {
    Object.assign(this, { stage, shown });
    stage.onDraw(() => this.#follow());
  }

  get open() {
    return !this.#card.hidden;
  }

  /** Shows what is at a pixel of the window. */
  pick(x, y) {
    const missing = this.shown.marks.missingAt(x, y);
    if (missing) return this.missing(missing);
    const found = this.shown.at(x, y);
    if (!found) return this.close();
    const { tile, uri, hit, feature } = found;
    this.stage.mark.clear();
    if (feature) this.shown.mark(tile, feature);
    const place = this.shown.world.placeOf(hit.point);
    this.#put(hit.point);
    this.#fill(
      make('h3', { class: 'module', 'data-testid': 'feature-id', text: feature ? String(feature.id) : 'No feature' }),
      feature?.values.length ? make('dl', { class: 'values' }, ...feature.values.flatMap(pair)) : null,
      feature && !feature.values.length
        ? make('p', { class: 'none', text: 'No attributes: burgeon tiles plan --metadata includes them.' })
        : null,
      where([feature?.layer && `layer ${feature.layer}`, tileName(uri)]),
      where([degrees(place), `ellipsoidal height ${place.height.toFixed(1)} m`]),
    );
  }

  /** Shows why something is missing. */
  missing(it) {
    this.stage.mark.clear();
    if (it.foot) this.#put(it.foot.clone().applyMatrix4(this.shown.world.toPage));
    this.#fill(
      make('h3', { class: 'module', 'data-testid': 'feature-id', text: it.feature || many(it.features, 'feature') }),
      make('p', { class: 'cause-text', 'data-testid': 'cause-text', text: it.cause }),
      where(['missing', it.layer && `layer ${it.layer}`, it.tile && `tile ${it.tile}`]),
      it.place ? where([degrees(it.place)]) : null,
    );
    this.#card.classList.add('missing');
  }

  close() {
    this.#card.hidden = true;
    this.#point = null;
    this.stage.mark.clear();
    this.stage.invalidate();
    this.#follow();
  }

  #put(point) {
    this.#point = point.clone().applyMatrix4(this.shown.world.toEarth);
    this.#follow();
    this.stage.invalidate();
  }

  #fill(...children) {
    const close = make(
      'button',
      { class: 'tool close', 'aria-label': 'Close', title: 'Close (Esc)', onclick: () => this.close() },
      icon('close'),
    );
    this.#card.classList.remove('missing');
    this.#card.replaceChildren(close, ...children.filter(Boolean));
    this.#card.hidden = false;
    this.#card.scrollTop = 0;
  }

  #follow() {
    const at = this.#point && this.stage.pixel(this.#point.clone().applyMatrix4(this.shown.world.toPage));
    this.#dot.hidden = !at;
    if (!at) return;
    const box = this.stage.canvas.getBoundingClientRect();
    this.#dot.style.transform = `translate(${at[0] - box.left}px, ${at[1] - box.top}px)`;
  }
}

function pair({ name, value }) {
  const full = text(value);
  return [make('dt', { text: name }), make('dd', { text: short(full), title: full })];
}

function text(value) {
  if (Array.isArray(value)) return value.map(text).join(', ');
  if (typeof value === 'boolean') return value ? 'yes' : 'no';
  return String(value);
}

const where = (parts) => make('p', { class: 'where', text: parts.filter(Boolean).join(' · ') });

const tileName = (uri) => `tile ${uri.replace(/^tiles\//, '').replace(/\.\w+$/, '')}`;
