// Labels in metres on the ground's axes, at the grid's lines.

import { Ray, Vector3 } from 'three';
import { make, say } from './dom.js';
import { label } from './readouts.js';

const SIDE = 6; // labels on each side of zero
const APART = 46; // pixels between labels at least
const LABEL = 50; // pixels that a label is wide at most
const LINE = 16; // and high
const BESIDE = [4, 2]; // pixels from its point to its left top corner

/** The corners of a label, in pixels from its point. */
const CORNERS = [0, LABEL].flatMap((x) => [0, LINE].map((y) => [BESIDE[0] + x, BESIDE[1] + y]));

/** Whether a label at a pixel would be partly behind a bar. */
const meets = ({ left, right, top, bottom }, [x, y]) =>
  x > left - LABEL && x < right + LABEL && y > top - 12 && y < bottom + 12;

export class Ticks {
  #pool = [];
  /** What lies over the picture. */
  #bars = [...document.querySelectorAll('.tools, .axes, .timeline')];

  constructor(place, stage) {
    Object.assign(this, { place, stage });
  }

  draw() {
    const { stage } = this;
    const { camera, ground, model } = stage;
    const shown = [];
    const low = Math.sin(camera.elevation) < 0.05;
    const cell = low || !ground.visible ? 0 : this.#cell();
    if (cell) {
      const box = stage.canvas.getBoundingClientRect();
      // Beside the model before a save there are none.
      const left = stage.area().left - box.left;
      const cover = this.#cover();
      const bars = this.#bars.map((bar) => bar.getBoundingClientRect());
      for (const axis of ['x', 'z']) {
        for (let i = -SIDE; i <= SIDE; i++) {
          if (i === 0) continue;
          const at = new Vector3(axis === 'x' ? i * cell : 0, 0, axis === 'z' ? -i * cell : 0)
            .sub(model.origin)
            .setY(ground.height);
          const { min, max } = model.box;
          const margin = cell * 0.3;
          if (at.x > min.x - margin && at.x < max.x + margin && at.z > min.z - margin && at.z < max.z + margin)
            continue;
          if (at.distanceTo(camera.target) > camera.distance * 1.6) continue;
          const pixel = stage.pixel(at);
          if (!pixel) continue;
          const [x, y] = [pixel[0] - box.left, pixel[1] - box.top];
          if (cover?.(at)) continue;
          if (bars.some((bar) => meets(bar, pixel))) continue;
          if (x < left + 8 || y < 8 || x + BESIDE[0] + LABEL > box.width || y + BESIDE[1] + LINE > box.height) continue;
          if (shown.some((other) => Math.abs(other.x - x) < APART && Math.abs(other.y - y) < 18)) continue;
          shown.push({ x, y, text: label(Math.abs(i * cell)), axis });
        }
      }
    }
    shown.forEach(({ x, y, text, axis }, i) => {
      this.#pool[i] ??= this.place.appendChild(make('span'));
      const tick = this.#pool[i];
      tick.hidden = false;
      tick.dataset.axis = axis;
      say(tick, text);
      tick.style.transform = `translate(${x.toFixed(1)}px, ${y.toFixed(1)}px)`;
    });
    for (const tick of this.#pool.slice(shown.length)) tick.hidden = true;
  }

  /** Tells whether the model's box stands between the camera and the label of a point. */
  #cover() {
    const { camera, model, size } = this.stage;
    const { box } = model;
    if (box.isEmpty()) return null;
    const { back, right, up, distance, flat } = camera;
    const eye = camera.target.clone().addScaledVector(back, distance);
    const [ray, hit, way] = [new Ray(), new Vector3(), new Vector3()];
    return (at) => {
      const depth = flat ? distance : way.subVectors(eye, at).dot(back);
      const pixel = ((2 * camera.reach) / size[1]) * (depth / distance);
      return CORNERS.some(([x, y]) => {
        ray.origin.copy(at).addScaledVector(right, x * pixel).addScaledVector(up, -y * pixel);
        ray.direction.copy(back);
        if (flat) return ray.intersectsBox(box);
        const length = way.subVectors(eye, ray.origin).length();
        ray.direction.copy(way).divideScalar(length);
        return ray.intersectBox(box, hit) !== null && hit.distanceTo(ray.origin) < length;
      });
    };
  }

  /** A multiple of the grid's cell far enough apart to be read. */
  #cell() {
    const pixel = (2 * this.stage.camera.reach) / this.stage.size[1];
    let cell = this.stage.ground.cell;
    while (cell / pixel < APART * 1.4) cell *= 10;
    if (cell / 2 / pixel > APART * 2.2) cell /= 2;
    return cell;
  }
}
