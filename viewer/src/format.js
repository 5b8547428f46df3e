// Numbers as people read them.

const whole = new Intl.NumberFormat('en-US', { maximumFractionDigits: 0 });

export const count = (number) => whole.format(number);

export const many = (number, one, more = `${one}s`) => `${count(number)} ${number === 1 ? one : more}`;

/** A length in metres with three digits that matter. */
export function metres(length) {
  if (!Number.isFinite(length)) return '–';
  if (length === 0) return '0';
  const digits = Math.min(3, Math.max(0, 2 - Math.floor(Math.log10(Math.abs(length)))));
  return length.toLocaleString('en-US', { minimumFractionDigits: 0, maximumFractionDigits: digits });
}

/** Lengths with their unit, which is the same for all of them. */
export function lengths(all) {
  const far = Math.max(...all) >= 10_000;
  return `${all.map((length) => metres(far ? length / 1000 : length)).join(' × ')} ${far ? 'km' : 'm'}`;
}

export function milliseconds(ms) {
  if (ms >= 10000) return `${(ms / 1000).toFixed(1)} s`;
  if (ms >= 1000) return `${(ms / 1000).toFixed(2)} s`;
  return `${ms >= 10 || ms === 0 ? Math.round(ms) : ms.toFixed(1)} ms`;
}

/** A parameter's number without the noise of binary fractions. */
export const plain = (number) => String(Number(Number(number).toPrecision(9)));

/** The value next to `number` that a parameter may have. */
export function nearest(number, { min, max, step }) {
  const [low, high] = [min ?? -Infinity, max ?? Infinity];
  const within = Math.min(Math.max(number, low), high);
  if (!step) return within;
  const from = min ?? 0;
  const stepped = from + Math.round((within - from) / step) * step;
  // The last step may end before the greatest value.
  return stepped > high ? stepped - step : stepped;
}

export function age(seconds) {
  if (seconds < 60) return `${Math.floor(seconds)} s`;
  if (seconds < 3600) return `${Math.floor(seconds / 60)} min`;
  return `${Math.floor(seconds / 3600)} h`;
}

export function bytes(number) {
  return number < 1e6 ? `${Math.round(number / 1e3)} kB` : `${(number / 1e6).toFixed(1)} MB`;
}

/** A text with its long decimals cut to five digits. */
export const short = (text) =>
  text.replace(/-?\d+\.\d{4,}(?:e[-+]?\d+)?/gi, (number) => String(Number(Number(number).toPrecision(5))));
