// Axes of a plot: ranges, numbers and the grid.

import { plain } from './format.js';

/** Room beyond the points, as a part of their range. */
const ROOM = 0.12;

/** Where the numbers of an axis from `low` to `high` stand, about `most` of them. */
export function ticks(low, high, most) {
  const rough = (high - low) / Math.max(most, 1);
  const power = 10 ** Math.floor(Math.log10(rough));
  const step = [1, 2, 5, 10].map((times) => times * power).find((step) => step >= rough * 0.999);
  const list = [];
  for (let index = Math.ceil(low / step - 1e-9); index * step <= high + step * 1e-9; index += 1) list.push(index * step);
  return { step, list: list.map((value) => (Math.abs(value) < step * 1e-9 ? 0 : value)) };
}

export const label = (number) => plain(Number(number.toPrecision(6))).replace('-', '\u2212');

/** The smallest difference that a drag makes on an axis of this length: a power of ten. */
export const fineness = (length) => 10 ** Math.floor(Math.log10(length / 400));

export const rounded = (number, step) => Number((Math.round(number / step) * step).toPrecision(12));

function range(values) {
  const [low, high] = [Math.min(...values), Math.max(...values)];
  const span = high - low || Math.abs(high) || 1;
  return [low - span * ROOM, high + span * ROOM];
}

/** The ranges in which a function is seen. The y axis has 0 unless the values are far from it. */
export function functionRanges(points, pieces) {
  const ys = [...points, ...pieces.flat()].map((point) => point[1]);
  const [low, high] = [Math.min(...ys), Math.max(...ys)];
  if (low > 0 && low < high * 0.7) ys.push(0);
  if (high < 0 && high > low * 0.7) ys.push(0);
  const [bottom, top] = range(ys);
  // A function that touches 0 mostly stays above it.
  return [range(points.map((point) => point[0])), [Math.min(...ys) === 0 ? -(top - bottom) * 0.06 : bottom, top]];
}

/** The ranges of two coordinates with one scale, for a plot of this width and height. */
export function evenRanges(points, [across, up], [width, height]) {
  const [xs, ys] = [across, up].map((axis) => range(points.map((point) => point[axis])));
  const scale = Math.max((xs[1] - xs[0]) / width, (ys[1] - ys[0]) / height);
  const about = ([low, high], size) => [(low + high - scale * size) / 2, (low + high + scale * size) / 2];
  return [about(xs, width), about(ys, height)];
}
