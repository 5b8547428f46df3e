// The list of what is missing, from the GeoJSON of the join: one feature a line, and only the first of very many.

const MOST = 5000; // features that are read
const LARGEST = 16e6; // bytes that are read

/** The missing features and tiles: `{list, whole}`; `whole` is false if there are more than are read. */
export async function missing(url) {
  const answer = await fetch(url, { cache: 'no-store' });
  if (!answer.ok) return { list: [], whole: true };
  const reader = answer.body.pipeThrough(new TextDecoderStream()).getReader();
  let [text, size, list] = ['', 0, []];
  for (;;) {
    const { done, value } = await reader.read();
    if (done) break;
    size += value.length;
    const lines = (text + value).split('\n');
    text = lines.pop();
    list = list.concat(lines.map(read).filter(Boolean));
    if (list.length > MOST || size > LARGEST) {
      await reader.cancel();
      return { list: list.slice(0, MOST), whole: false };
    }
  }
  return { list: list.concat(read(text) ?? []), whole: true };
}

/** The missing feature in a line; null if it is none. */
function read(line) {
  const text = line.trim().replace(/,$/, '');
  if (!text.startsWith('{"type":"Feature"')) return null;
  try {
    const { properties, geometry } = JSON.parse(text);
    return { ...properties, ...places(geometry) };
  } catch {
    return null;
  }
}

/** Where it is: a place, and the ring around a tile. */
function places(geometry) {
  if (geometry?.type === 'Point') {
    const [longitude, latitude] = geometry.coordinates;
    return { place: { longitude, latitude }, radius: 8 };
  }
  if (geometry?.type !== 'Polygon') return { place: null };
  const [ring] = geometry.coordinates;
  const middle = (axis) => {
    const all = ring.map((it) => it[axis]);
    return (Math.min(...all) + Math.max(...all)) / 2;
  };
  return { place: { longitude: middle(0), latitude: middle(1) }, ring, radius: 60 };
}

/** The list by cause: `[{cause, features, list}]`, the causes of most features first. */
export function causes(list) {
  const found = new Map();
  for (const it of list) {
    // The errors of tiles end with the feature that has it.
    const cause = it.cause.replace(/ \(feature [^()]*\)$/, '');
    if (!found.has(cause)) found.set(cause, { cause, features: 0, list: [] });
    const group = found.get(cause);
    group.features += it.features ?? 1;
    group.list.push(it);
  }
  return [...found.values()].sort((a, b) => b.features - a.features);
}
