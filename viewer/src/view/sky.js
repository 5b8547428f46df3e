// Sun, sky, haze and background, which are kept for each script.

import { Color } from 'three';
import { find, say } from '../dom.js';
import { menu } from '../menu.js';

const DEGREE = Math.PI / 180;
const TILT = 23.44 * DEGREE; // of the earth's axis
const USUAL = { sun: null, hour: 12, latitude: 50, sky: true, haze: 0, background: 'theme', color: '#ffffff' };

/** Azimuth from north and elevation (degrees) of the sun at a solar hour of 21 June; as `--sun` of pictures. */
export function sunAt(hour, latitude) {
  const [turn, place] = [(hour - 12) * 15 * DEGREE, latitude * DEGREE];
  const up = Math.sin(place) * Math.sin(TILT) + Math.cos(place) * Math.cos(TILT) * Math.cos(turn);
  const east = -Math.cos(TILT) * Math.sin(turn);
  const north = Math.sin(TILT) * Math.cos(place) - Math.cos(TILT) * Math.sin(place) * Math.cos(turn);
  return [(Math.atan2(east, north) / DEGREE + 360) % 360, Math.asin(Math.min(Math.max(up, -1), 1)) / DEGREE];
}

export class Sky {
  #state = { ...USUAL };
  #path = null;
  #parts = Object.fromEntries(
    ['hour', 'latitude', 'azimuth', 'elevation', 'light', 'haze', 'background', 'color', 'flag', 'reset'].map((name) => [
      name,
      find(`#sky-${name}`),
    ]),
  );

  constructor(stage) {
    this.stage = stage;
    const { hour, latitude, azimuth, elevation, light, haze, background, color, reset } = this.#parts;
    const button = find('#sky');
    menu(button, find('#sky-sheet'));
    this.toggle = () => button.click();
    const sun = () => (this.#state.sun = [azimuth.valueAsNumber, elevation.valueAsNumber]);
    const day = () => {
      if (!Number.isFinite(latitude.valueAsNumber)) latitude.value = this.#state.latitude;
      latitude.value = Math.min(Math.max(latitude.valueAsNumber, -66), 66);
      Object.assign(this.#state, { hour: hour.valueAsNumber, latitude: latitude.valueAsNumber });
      const [at, up] = sunAt(this.#state.hour, this.#state.latitude);
      // At night there is nothing to see: the sun stays at the horizon.
      this.#state.sun = [Math.round(at), Math.max(Math.round(up), 1)];
    };
    for (const [field, event, change] of [
      [hour, 'input', day],
      [latitude, 'change', day],
      [azimuth, 'input', sun],
      [elevation, 'input', sun],
      [light, 'change', () => (this.#state.sky = light.checked)],
      [haze, 'input', () => (this.#state.haze = haze.valueAsNumber)],
      [background, 'change', () => (this.#state.background = background.value)],
      [color, 'input', () => Object.assign(this.#state, { background: 'color', color: color.value })],
      [reset, 'click', () => (this.#state = { ...USUAL })],
    ])
      field.addEventListener(event, () => {
        change();
        this.#apply();
        this.#keep();
      });
  }

  /** Takes what is kept for the script at `path`. */
  restore(path) {
    if (path === this.#path) return;
    this.#path = path;
    try {
      this.#state = checked(JSON.parse(localStorage.getItem(key(path))));
    } catch {
      this.#state = { ...USUAL };
    }
    this.#apply();
  }

  /** What the server's pictures need for the same light: names and numbers. */
  get picture() {
    const { sun, haze, background } = this.#state;
    const picture = {};
    if (sun) [picture.sun_azimuth, picture.sun_elevation] = sun;
    if (haze > 0 && this.stage) picture.haze = this.stage.clear(haze).toPrecision(4);
    if (background === 'sky') picture.sky = 1;
    return picture;
  }

  /** The model or the theme has changed. */
  renew() {
    this.#hazy();
  }

  #keep() {
    try {
      if (JSON.stringify(this.#state) === JSON.stringify(USUAL)) localStorage.removeItem(key(this.#path));
      else localStorage.setItem(key(this.#path), JSON.stringify(this.#state));
    } catch {
      // Without storage it is the usual sky again.
    }
  }

  #apply() {
    const { sun, hour, latitude, sky, haze, background, color } = this.#state;
    const parts = this.#parts;
    const [azimuth, elevation] = sun ?? [304, 44];
    const put = (field, value) => {
      field.value = value;
      const { min, max } = field;
      field.style.setProperty('--at', `${((field.value - min) / (max - min)) * 100}%`);
    };
    put(parts.hour, hour);
    put(parts.azimuth, azimuth);
    put(parts.elevation, elevation);
    put(parts.haze, haze);
    if (document.activeElement !== parts.latitude) parts.latitude.value = latitude;
    parts.light.checked = sky;
    parts.background.value = background;
    parts.color.value = color;
    parts.color.hidden = background !== 'color';
    say(find('#sky-hour-text'), `${Math.floor(hour)}:${String(Math.round((hour % 1) * 60)).padStart(2, '0')}`);
    say(find('#sky-azimuth-text'), `${azimuth}°`);
    say(find('#sky-elevation-text'), `${elevation}°`);
    say(find('#sky-haze-text'), `${Math.round(haze * 100)} %`);
    say(parts.flag, sun ? `--sun ${azimuth},${elevation}` : '');
    const usual = JSON.stringify(this.#state) === JSON.stringify(USUAL);
    parts.reset.disabled = usual;
    find('#sky').setAttribute('aria-pressed', String(!usual));
    this.#backdrop(elevation);
    if (!this.stage) return;
    const chosen = sun ?? (sky ? null : [304, 44]);
    this.stage.lighten(chosen && { azimuth: chosen[0] * DEGREE, elevation: chosen[1] * DEGREE }, sky);
    this.#hazy();
  }

  /** Sets the two colours behind the picture. */
  #backdrop(elevation) {
    const { background, color } = this.#state;
    const { style } = document.documentElement;
    const [top, bottom] = background === 'color' ? [color, color] : background === 'sky' ? daylight(elevation) : [];
    for (const [name, value] of [
      ['--sky', top],
      ['--floor', bottom],
    ]) {
      if (value) style.setProperty(name, value);
      else style.removeProperty(name);
    }
  }

  #hazy() {
    const floor = getComputedStyle(document.documentElement).getPropertyValue('--floor').trim();
    this.stage?.haze(this.#state.haze, new Color(floor));
  }
}

const key = (path) => `burgeon-sky ${path}`;

/** The colours of a clear sky, at the top and at the horizon: blue by day, and red when the sun is low (degrees). */
function daylight(elevation) {
  const high = Math.min(Math.max(elevation / 35, 0), 1);
  const between = (low, day) => `#${new Color(low).lerp(new Color(day), high).getHexString()}`;
  return [between('#5b6d93', '#6ea3dc'), between('#f0c9a4', '#dfeaf2')];
}

/** What was kept, where it makes sense. */
function checked(kept) {
  const state = { ...USUAL };
  const within = (value, low, high) => Number.isFinite(value) && value >= low && value <= high;
  if (Array.isArray(kept?.sun) && within(kept.sun[0], 0, 360) && within(kept.sun[1], 1, 90)) state.sun = kept.sun.slice(0, 2);
  if (within(kept?.hour, 0, 24)) state.hour = kept.hour;
  if (within(kept?.latitude, -66, 66)) state.latitude = kept.latitude;
  if (typeof kept?.sky === 'boolean') state.sky = kept.sky;
  if (within(kept?.haze, 0, 1)) state.haze = kept.haze;
  if (['theme', 'sky', 'color'].includes(kept?.background)) state.background = kept.background;
  if (/^#[0-9a-f]{6}$/.test(kept?.color)) state.color = kept.color;
  return state;
}
