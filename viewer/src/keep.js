// The camera stays where it is when the page is loaded again, for each script.

import { FIELD } from './camera.js';

const key = (path) => `burgeon-camera ${path}`;

let timer = 0;

/** Remembers the camera once it rests. */
export function keep(stage, path) {
  clearTimeout(timer);
  timer = setTimeout(() => {
    const { azimuth, elevation, distance, field, target, flat } = stage.camera;
    const place = target.clone().add(stage.model.origin).toArray();
    try {
      sessionStorage.setItem(key(path), JSON.stringify({ azimuth, elevation, distance, field, flat, target: place }));
    } catch {
      // Without storage the view is fitted again.
    }
  }, 300);
}

/** Puts the camera where it was. Returns `{flat}`, or null if nothing is remembered. */
export function restore(stage, path) {
  try {
    const kept = JSON.parse(sessionStorage.getItem(key(path)));
    if (!kept) return null;
    const { azimuth, elevation, distance, field = FIELD, flat } = kept;
    const target = stage.camera.target.clone().fromArray(kept.target).sub(stage.model.origin);
    if (![azimuth, elevation, distance, field, ...target.toArray()].every(Number.isFinite)) return null;
    stage.camera.go({ azimuth, elevation, distance, field, target }, true);
    return { flat };
  } catch {
    return null;
  }
}
