// What the file carries beside the page: facts as JSON, and the model in base64.

import { find } from '../dom.js';

/** The facts: name, counts, bounds, place, features and recipe. */
export const facts = () => JSON.parse(find('#facts').textContent);

/** The bytes of the model as an ArrayBuffer; null if nothing is drawn. The text is given back to the browser. */
export function model() {
  const place = find('#model');
  if (!place) return null;
  const text = place.textContent.trim();
  place.remove();
  const bytes = Uint8Array.from(atob(text), (letter) => letter.charCodeAt(0));
  return bytes.buffer;
}
