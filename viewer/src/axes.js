// The three axes as seen from the camera; each end turns the camera to look from there. For the keyboard there is a
// menu of views.

import { svg } from './dom.js';
import { view } from './camera.js';

// The scene's axes (z up) in the page's coordinates (y up).
const ENDS = [
  { name: 'x', label: 'X', from: 'right', at: [1, 0, 0] },
  { name: 'y', label: 'Y', from: 'back', at: [0, 0, -1] },
  { name: 'z', label: 'Z', from: 'top', at: [0, 1, 0] },
  { name: 'x', from: 'left', at: [-1, 0, 0] },
  { name: 'y', from: 'front', at: [0, 0, 1] },
  { name: 'z', from: 'bottom', at: [0, -1, 0] },
];
const LENGTH = 27;

export class Axes {
  constructor(place, camera) {
    this.place = place;
    this.camera = camera;
    this.ends = ENDS.map((end) => {
      const line = end.label && svg('line', { x1: 0, y1: 0 });
      const group = svg('g', { class: `axis axis-${end.name}${end.label ? '' : ' far'}` });
      const title = svg('title');
      title.textContent = `From the ${end.from}`;
      group.append(title);
      if (line) group.append(line);
      const ball = svg('g', {}, svg('circle', { r: end.label ? 8 : 6 }));
      if (end.label) {
        const text = svg('text', { 'text-anchor': 'middle', dy: 3.4 });
        text.textContent = end.label;
        ball.append(text);
      }
      group.append(ball);
      group.addEventListener('click', () => camera.go(view(end.from)));
      place.append(group);
      return { ...end, group, ball, line };
    });
  }

  draw() {
    const { right, up, back } = this.camera;
    const dot = (a, [x, y, z]) => a.x * x + a.y * y + a.z * z;
    const key = [right.x, right.y, back.y, back.x].map((it) => it.toFixed(4)).join();
    if (key === this.key) return;
    this.key = key;
    const seen = this.ends.map((end) => ({
      ...end,
      x: dot(right, end.at) * LENGTH,
      y: -dot(up, end.at) * LENGTH,
      z: dot(back, end.at),
    }));
    seen.sort((a, b) => a.z - b.z);
    for (const { group, ball, line, x, y } of seen) {
      ball.setAttribute('transform', `translate(${x.toFixed(2)} ${y.toFixed(2)})`);
      line?.setAttribute('x2', x.toFixed(2));
      line?.setAttribute('y2', y.toFixed(2));
      this.place.append(group);
    }
  }
}
