// A line that goes away by itself.

import { find, say } from './dom.js';

const LONGEST = 400; // letters
const STAYS = 5000; // ms

let timer = 0;

export function toast(text) {
  const place = find('#toast');
  say(place, text.length > LONGEST ? `${text.slice(0, LONGEST)}…` : text);
  place.hidden = false;
  clearTimeout(timer);
  timer = setTimeout(clearToast, STAYS);
}

/** Takes away what is told already. */
export function clearToast() {
  find('#toast').hidden = true;
}
