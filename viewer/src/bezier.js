// Cubic Bezier pieces: points, nearest points and division. A point is a list of coordinates.

const STEPS = 16;

/** The point of a piece at `t` from 0 to 1. */
export function at([a, b, c, d], t) {
  const s = 1 - t;
  const weights = [s * s * s, 3 * s * s * t, 3 * s * t * t, t * t * t];
  return a.map((_, axis) => weights[0] * a[axis] + weights[1] * b[axis] + weights[2] * c[axis] + weights[3] * d[axis]);
}

/** The y of a function at `x`, constant beyond its ends. */
export function height(pieces, x) {
  const [first, last] = [pieces[0][0], pieces.at(-1)[3]];
  if (x <= first[0]) return first[1];
  if (x >= last[0]) return last[1];
  const piece = pieces.find((piece) => x <= piece[3][0]);
  let [low, high] = [0, 1];
  for (let i = 0; i < 40; i += 1) {
    const middle = (low + high) / 2;
    if (at(piece, middle)[0] < x) low = middle;
    else high = middle;
  }
  return at(piece, high)[1];
}

/** The point of the pieces that is nearest by `distance`, with its piece and its `t`. */
export function nearest(pieces, distance) {
  let best = { far: Infinity };
  pieces.forEach((piece, index) => {
    for (let step = 0; step <= STEPS; step += 1) {
      const point = at(piece, step / STEPS);
      const far = distance(point);
      if (far < best.far) best = { far, point, index, t: step / STEPS };
    }
  });
  if (best.index === undefined) return best;
  // Between the neighbouring samples.
  let [low, high] = [Math.max(0, best.t - 1 / STEPS), Math.min(1, best.t + 1 / STEPS)];
  for (let i = 0; i < 20; i += 1) {
    const [one, other] = [low + (high - low) / 3, high - (high - low) / 3];
    if (distance(at(pieces[best.index], one)) < distance(at(pieces[best.index], other))) high = other;
    else low = one;
  }
  const t = (low + high) / 2;
  const point = at(pieces[best.index], t);
  return { far: distance(point), point, index: best.index, t };
}

/** Both parts of a piece that is divided at `t`: seven points. */
export function divide([a, b, c, d], t) {
  const mix = (from, to) => from.map((value, axis) => value + (to[axis] - value) * t);
  const [ab, bc, cd] = [mix(a, b), mix(b, c), mix(c, d)];
  const [left, right] = [mix(ab, bc), mix(bc, cd)];
  return [a, ab, left, mix(left, right), right, cd, d];
}
