// Cuts the model with a plane, and shows what is behind it.

import { DoubleSide, Plane, Vector3 } from 'three';
import { find, say } from './dom.js';
import { label } from './readouts.js';

// The scene's axes in the page, whose y is up: what is kept is on the lower side.
const AXES = { x: new Vector3(-1, 0, 0), y: new Vector3(0, 0, 1), z: new Vector3(0, -1, 0) };

export class Cut {
  #button = find('#cut');
  #sheet = find('#cut-tools');
  #slider = find('#cut-at');
  #plane = new Plane();
  #side = 1;
  /** Sides of the materials before the cut. */
  #sides = new Map();

  constructor(stage) {
    this.stage = stage;
    this.#button.addEventListener('click', () => this.toggle());
    this.#slider.addEventListener('input', () => this.#move());
    this.#sheet.addEventListener('change', () => this.#move());
    find('#cut-flip').addEventListener('click', () => {
      this.#side = -this.#side;
      this.#move();
    });
  }

  get active() {
    return !this.#sheet.hidden;
  }

  toggle(on = !this.active) {
    this.#sheet.hidden = !on;
    this.#button.setAttribute('aria-pressed', String(on));
    this.stage.cut = on ? this.#plane : null;
    this.stage.renderer.clippingPlanes = on ? [this.#plane] : [];
    this.shown();
    if (!on) this.stage.invalidate();
  }

  /** Cuts a model that has come in the place of another. */
  shown() {
    this.#open();
    if (this.active) this.#move();
  }

  /** Makes both sides of surfaces visible, because a cut solid shows its inside. */
  #open() {
    const { model, plain, slow } = this.stage;
    const fine = model.meshes.map((it) => it.userData.material);
    const all = new Set(this.active ? (slow ? [...fine, ...fine.map((it) => plain.of(it))] : fine) : []);
    for (const [material, side] of this.#sides) {
      if (all.has(material)) continue;
      turn(material, side);
      this.#sides.delete(material);
    }
    for (const material of all) {
      if (!this.#sides.has(material)) this.#sides.set(material, material.side);
      turn(material, DoubleSide);
    }
  }

  #move() {
    const { box, origin } = this.stage.model;
    const axis = find('[name=cut-axis]:checked').value;
    const up = AXES[axis];
    const ends = [box.min, box.max].map((corner) => corner.dot(up)).sort((a, b) => a - b);
    const part = this.#slider.valueAsNumber / 1000;
    // The highest place is at the right end.
    // A little beside, so that it does not lie in a face at a round place.
    const at = box.isEmpty() ? 0 : ends[1] + (ends[0] - ends[1]) * part * 0.99997;
    this.#plane.normal.copy(up).multiplyScalar(this.#side);
    this.#plane.constant = -at * this.#side;
    say(find('#cut-text'), `${axis} ${label(-(at + origin.dot(up)))}`);
    this.stage.invalidate();
  }
}

function turn(material, side) {
  if (material.side === side) return;
  material.side = side;
  material.needsUpdate = true;
}
