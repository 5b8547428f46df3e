// Control points with one more or one less, and the points that move together.

import * as bezier from './bezier.js';

/** Indexes of the points at the place of the point `index`, such as those at the tip of a leaf. */
export function together(points, index) {
  const at = points[index];
  const indexes = points.map((_, other) => other);
  return indexes.filter((other) => points[other].every((value, axis) => value === at[axis]));
}

/** The points of a function with one more; nothing if there is one with this x. */
export function withFunctionPoint(points, x, y) {
  const found = points.findIndex((point) => point[0] >= x);
  if (found >= 0 && points[found][0] === x) return null;
  const index = found < 0 ? points.length : found;
  return { points: points.toSpliced(index, 0, [x, Number(y.toPrecision(6))]), index };
}

/**
 * The points of a curve with one more at a place of the curve, `{ index, t, point }`. Bezier pieces are divided without a change
 * of their form. `apart` gives the distance of two points in the plot.
 */
export function withCurvePoint({ kind, closed }, points, pieces, { index, t, point }, apart) {
  const round = (point) => point.map((value) => Number(value.toPrecision(6)));
  if (kind === 'bezier') {
    const [, ...inner] = bezier.divide(pieces[index], t).map(round);
    return { points: points.toSpliced(index * 3 + 1, 2, ...inner.slice(0, -1)), index: index * 3 + 3 };
  }
  let before = index;
  if (kind === 'b-spline' && t !== undefined) {
    const lines = points.map((from, i) => [from, points[i + 1] ?? (closed ? points[0] : null)]).filter(([, to]) => to);
    const straight = lines.map(([from, to]) => [from, from, to, to]);
    before = bezier.nearest(straight, (place) => apart(place, point)).index;
  }
  return { points: points.toSpliced(before + 1, 0, round(point)), index: before + 1 };
}

/** The place of a new point after the point `chosen`. */
export function placeAfter({ space, kind, closed }, points, pieces, chosen) {
  const count = points.length;
  const at = !closed && chosen === count - 1 ? count - 2 : chosen;
  const [from, to] = [points[at], points[(at + 1) % count]];
  const middle = from.map((value, axis) => (value + to[axis]) / 2);
  if (space === 'function') return { index: at, point: [middle[0], bezier.height(pieces, middle[0])] };
  if (kind === 'bezier') return { index: Math.min(Math.floor(at / 3), pieces.length - 1), t: 0.5 };
  if (kind === 'b-spline') return { index: at, point: middle };
  return { index: at, t: 0.5, point: bezier.at(pieces[at], 0.5) };
}

/** The points without one. In Bezier pieces, a point of the curve goes with the two control points beside it. */
export function withoutPoint({ kind, closed }, points, index) {
  if (kind !== 'bezier') return points.toSpliced(index, 1);
  const anchor = (Math.round(index / 3) * 3) % points.length;
  const last = points.length - 1;
  const first = anchor === 0 ? 0 : !closed && anchor >= last ? last - 2 : anchor - 1;
  return points.toSpliced(first, 3);
}
