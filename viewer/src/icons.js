// The icons, strokes on a grid of 16.

import { svg } from './dom.js';

const PATHS = {
  fit: 'M2.5 5.5v-3h3M10.5 2.5h3v3M13.5 10.5v3h-3M5.5 13.5h-3v-3M5.5 6.2 8 5l2.5 1.2v3.2L8 10.8 5.5 9.4z',
  lit: 'M8 2.5a5.5 5.5 0 1 0 0 11 5.5 5.5 0 0 0 0-11zM10.8 5.2a4.2 4.2 0 0 1-4.6 6.2',
  wire: 'M8 2.2 13 5v6l-5 2.8L3 11V5zM3 5l5 2.8L13 5M8 7.8v6M3 11l5-3.2 5 3.2',
  normals: 'M2.5 12.5c3-3 8-3 11 0M8 10.2V3M8 3 6.3 4.9M8 3l1.7 1.9M4.2 10.9 2.4 6.6M11.8 10.9l1.8-4.3',
  uv: 'M2.5 2.5h11v11h-11zM8 2.5v11M2.5 8h11M2.9 2.9 7.6 7.6M8.4 8.4l4.7 4.7',
  perspective: 'M5.5 3.5 2 12.5h12l-3.5-9zM4 7.8h8M8 3.5v9',
  orthographic: 'M2.5 3.5h11v9h-11zM2.5 8h11M8 3.5v9',
  grid: 'M2.5 5.5h11M2.5 10.5h11M5.5 2.5v11M10.5 2.5v11',
  views: 'M8 2.2 13 5v6l-5 2.8L3 11V5zM3 5l5 2.8L13 5M8 7.8v6',
  camera: 'M2 5h3l1.2-1.8h3.6L11 5h3v8H2zM8 11.2a2.4 2.4 0 1 0 0-4.8 2.4 2.4 0 0 0 0 4.8z',
  export: 'M8 2.2v7.6M4.9 6.9 8 10l3.1-3.1M2.5 11v2.5h11V11',
  theme: 'M8 2.5a5.5 5.5 0 1 0 0 11zM8 2.5a5.5 5.5 0 0 1 0 11',
  help: 'M5.8 6.1a2.3 2.3 0 1 1 3.4 2c-.8.5-1.2.9-1.2 1.8M8 12.3v.4',
  panel: 'M2.5 3h11v10h-11zM10 3v10',
  play: 'M5 3.2v9.6L12.6 8z',
  pause: 'M5.5 3.5v9M10.5 3.5v9',
  dice: 'M3 3h10v10H3zM5.8 5.8v.1M10.2 5.8v.1M8 8v.1M5.8 10.2v.1M10.2 10.2v.1',
  locked: 'M4 7.2h8v6H4zM5.7 7.2V5a2.3 2.3 0 0 1 4.6 0v2.2',
  unlocked: 'M4 7.2h8v6H4zM5.7 7.2V4.6a2.3 2.3 0 0 1 4.5-.6',
  reset: 'M3.2 5.2A5.4 5.4 0 1 1 2.6 9M3 2.4v3h3',
  undo: 'M5.6 3 2.6 6l3 3M2.8 6h6.4a3.6 3.6 0 0 1 0 7.2H6',
  redo: 'M10.4 3l3 3-3 3M13.2 6H6.8a3.6 3.6 0 0 0 0 7.2H10',
  measure: 'M2.2 10.8 10.8 2.200l3 3L5.200 13.800zM5 8l1.200 1.200M7.2 5.800 9 7.600M9.400 3.600l1.200 1.200',
  sun: 'M8 5.2a2.8 2.8 0 1 0 0 5.6 2.8 2.8 0 0 0 0-5.6zM8 1.6v1.500M8 12.900v1.500M1.600 8h1.500M12.900 8h1.500M3.500 3.500l1 1M11.500 11.500l1 1M12.500 3.500l-1 1M4.500 11.500l-1 1',
  compare: 'M2.500 3h11v10h-11zM8 3v10M4.400 10.500v-3M11.600 10.500v-5',
  isolate: 'M2.500 5.500v-3h3M10.500 2.500h3v3M13.500 10.500v3h-3M5.500 13.500h-3v-3M8 6.200a1.800 1.800 0 1 0 0 3.600 1.800 1.800 0 0 0 0-3.600z',
  hide: 'M2 8c2-3 4-4.200 6-4.200S12 5 14 8c-2 3-4 4.200-6 4.200S4 11 2 8zM3 13 13 3',
  strip: 'M2 4.500h12v7H2zM6 4.500v7M10 4.500v7',
  cut: 'M8 2.2 13 5v6l-5 2.8L3 11V5zM1.500 9.500l13-3',
  fold: 'M4 10l4-4 4 4',
  close: 'M4 4l8 8M12 4l-8 8',
  save: 'M8 3.2v9.6M3.2 8h9.6',
  trash: 'M3 4.5h10M6.2 4.5V3h3.6v1.5M4.4 4.5 5 13h6l.6-8.5',
  variations: 'M2.5 2.5h4.6v4.6H2.5zM8.9 2.5h4.6v4.6H8.9zM2.5 8.9h4.6v4.6H2.5zM8.9 8.9h4.6v4.6H8.9z',
  draw: 'M3 13l.8-3.2 7-7 2.4 2.4-7 7zM9.4 4.2l2.4 2.4',
  open: 'M9 3h4v4M13 3 7.6 8.4M11.5 9.5v3.6h-8.6V4.5h3.6',
};

export function icon(name) {
  const path = svg('path', { d: PATHS[name] });
  return svg('svg', { viewBox: '0 0 16 16', class: `icon icon-${name}`, 'aria-hidden': 'true' }, path);
}

/** Puts an icon in front of what each `[data-icon]` under `root` holds. */
export function addIcons(root) {
  for (const element of root.querySelectorAll('[data-icon]')) element.prepend(icon(element.dataset.icon));
}

export function changeIcon(element, name) {
  const old = element.querySelector('svg');
  if (old?.classList.contains(`icon-${name}`)) return;
  if (old) old.replaceWith(icon(name));
  else element.prepend(icon(name));
}
