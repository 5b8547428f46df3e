// The drawing of a function, a curve or a surface with its control polygon, as parts of an SVG.

import { svg } from './dom.js';

/**
 * `pixel` gives the place of a point in the plot, `area` is the plot without its scales, and `base` the height of y = 0 in it.
 */
export function outline({ space, kind, closed, columns }, points, pieces, pixel, area, base) {
  const pixels = (point) =>
    pixel(point)
      .map((value) => value.toFixed(2))
      .join(' ');
  const line = joined(pieces, pixels);
  const parts = [];
  if (space === 'function' && line) {
    const [first, last] = [pieces[0][0], pieces.at(-1)[3]].map(pixel);
    parts.push(svg('path', { class: 'plot-fill', d: `${line}L${last[0]} ${base}L${first[0]} ${base}Z` }));
    const ends = `M${area.left} ${first[1]}H${first[0]}M${last[0]} ${last[1]}H${area.left + area.width}`;
    parts.push(svg('path', { class: 'plot-beyond', d: ends }));
  } else if (closed && line && space === 'plane') parts.push(svg('path', { class: 'plot-fill', d: line }));
  const polygon = columns ? net(points, columns) : polygons(kind, closed, points);
  const sides = polygon.map((side) => `M${side.map(pixels).join('L')}`).join('');
  if (sides) parts.push(svg('path', { class: 'plot-polygon', d: sides }));
  parts.push(svg('path', { class: columns ? 'plot-line plot-surface' : 'plot-line', d: line }));
  return parts;
}

/** The pieces as a path; pieces that meet are one line. */
function joined(pieces, pixels) {
  const parts = pieces.map((piece, index) => {
    const before = pieces[index - 1]?.[3];
    const start = before?.every((value, axis) => value === piece[0][axis]) ? '' : `M${pixels(piece[0])}`;
    return `${start}C${piece.slice(1).map(pixels).join(' ')}`;
  });
  return parts.join('');
}

/** Rows and columns of the points of a surface. */
export function net(points, columns) {
  const rows = Array.from({ length: points.length / columns }, (_, row) => points.slice(row * columns, (row + 1) * columns));
  return [...rows, ...Array.from({ length: columns }, (_, column) => rows.map((row) => row[column]))];
}

function polygons(kind, closed, points) {
  if (kind === 'spline' || kind === 'b-spline') return [closed ? [...points, points[0]] : points];
  if (kind !== 'bezier') return [];
  return points.flatMap((point, index) => {
    const anchor = index % 3 === 1 ? index - 1 : index % 3 === 2 ? (index + 1) % points.length : null;
    return anchor === null ? [] : [[point, points[anchor]]];
  });
}
