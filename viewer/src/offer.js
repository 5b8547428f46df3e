// Offers to fit a model that has grown out of the view, or has become too small to be seen.

import { find, say } from './dom.js';

const SMALL = 0.05; // of the picture

export class Offer {
  #place = find('#offer');
  #view = null;

  constructor(stage, fit) {
    this.stage = stage;
    find('#offer-fit').addEventListener('click', fit);
    // Whoever moves the camera has seen to it.
    stage.onDraw(() => this.#view && this.#view !== this.#camera() && this.hide());
  }

  /** Whether all of the model is seen, and large enough; asked before another one comes. */
  framed() {
    // What was asked for a moment ago counts, not the way there.
    this.stage.camera.arrive();
    if (this.stage.model.box.isEmpty()) return null;
    const { whole, size } = this.stage.framing();
    return whole && size > SMALL;
  }

  /** Another model has come; `framed` tells of the one before. */
  look(framed) {
    const { box } = this.stage.model;
    if (box.isEmpty()) return this.hide();
    const { whole, inside, size } = this.stage.framing();
    // Whoever had come near to see a part does not want to see the whole.
    const wanted = !inside || ((framed || this.#view) && !(whole && size > SMALL));
    if (!wanted) return this.hide();
    const text = !inside ? 'The model is out of view' : whole ? 'The model is very small' : 'The model reaches out of view';
    say(find('#offer-text'), text);
    this.#place.hidden = false;
    this.#view = this.#camera();
  }

  hide() {
    this.#place.hidden = true;
    this.#view = null;
  }

  /** The view without the place of the page's own zero, which comes with each model. */
  #camera() {
    const { camera, model } = this.stage;
    const target = camera.target.clone().add(model.origin).toArray();
    return [...target, camera.azimuth, camera.elevation, camera.distance, camera.flat].join();
  }
}
