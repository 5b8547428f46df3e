// The camera: it circles a target, and is kept from model to model.
//
// Azimuth is from north clockwise and elevation above the horizon, both of the camera as seen from the target (rad).
// Coordinates are glTF's, y up; east is +x and north is -z.

import { Matrix4, OrthographicCamera, PerspectiveCamera, Vector3 } from 'three';

const DEGREE = Math.PI / 180;
/** Vertical field of view (rad) without a camera of the script. */
export const FIELD = 32 * DEGREE;
const MARGIN = 0.88;
const BARS = 120; // pixels above and below that the tools cover
const TURN_TIME = 260;
const NEAREST = 1e-3; // metres from the target
const FARTHEST = 1e10; // and planets are seen whole

/** Azimuth and elevation (degrees) by name, in the order of the keys 1 to 7. */
export const VIEWS = {
  front: [180, 0],
  back: [0, 0],
  left: [270, 0],
  right: [90, 0],
  top: [180, 90],
  bottom: [180, -90],
  iso: [135, 35.264],
};

export class Camera {
  #perspective = new PerspectiveCamera(FIELD / DEGREE);
  #orthographic = new OrthographicCamera();
  #animation = 0;
  /** Goes to a part, 0 to 1, of the way of a turn. */
  #put = null;
  target = new Vector3(0, 2, 0);
  azimuth = 150 * DEGREE;
  elevation = 22 * DEGREE;
  distance = 24;
  /** Vertical field of view (rad). */
  field = FIELD;
  flat = false;
  /** Moves keep the height of the target, as over a map. */
  level = false;
  aspect = 1;
  /** The picture's height in pixels. */
  height = 800;
  right = new Vector3();
  up = new Vector3();
  back = new Vector3();

  /** `changed` is called after each change. */
  constructor(changed) {
    this.changed = changed;
    this.orient();
  }

  get active() {
    return this.flat ? this.#orthographic : this.#perspective;
  }

  /** Half the height (m) of what is seen at the target. */
  get reach() {
    return this.distance * Math.tan(this.field / 2);
  }

  orient() {
    const [sin, cos] = [Math.sin(this.azimuth), Math.cos(this.azimuth)];
    const level = Math.cos(this.elevation);
    this.back.set(sin * level, Math.sin(this.elevation), -cos * level);
    this.right.set(-cos, 0, -sin);
    this.up.crossVectors(this.back, this.right);
  }

  /** Puts the camera where its state says. */
  pose() {
    this.orient();
    const camera = this.active;
    camera.position.copy(this.target).addScaledVector(this.back, this.distance);
    camera.quaternion.setFromRotationMatrix(new Matrix4().makeBasis(this.right, this.up, this.back));
    if (this.flat) {
      [camera.left, camera.right] = [-this.reach * this.aspect, this.reach * this.aspect];
      [camera.bottom, camera.top] = [-this.reach, this.reach];
    } else {
      camera.aspect = this.aspect;
      camera.fov = this.field / DEGREE;
    }
    camera.updateProjectionMatrix();
    camera.updateMatrixWorld();
    return camera;
  }

  /** Places the camera; `center` and `radius` (m) are of what must not be cut off. */
  place(center, radius) {
    const camera = this.pose();
    const depth = -center.clone().sub(camera.position).dot(this.back);
    camera.far = Math.max(depth + radius, this.distance * 2);
    if (this.flat) {
      camera.near = depth - radius;
    } else {
      camera.near = Math.max(depth - radius, this.distance * 0.004, camera.far * 2e-5);
    }
    camera.updateProjectionMatrix();
    return camera;
  }

  /** Where `box` is seen whole from here. */
  fitted(box, azimuth = this.azimuth, elevation = this.elevation) {
    const center = box.getCenter(new Vector3());
    const [kept, keptUp] = [this.azimuth, this.elevation];
    [this.azimuth, this.elevation] = [azimuth, elevation];
    this.orient();
    const slope = Math.tan(FIELD / 2);
    const tall = Math.max(Math.min(MARGIN, 1 - BARS / this.height), 0.5);
    let distance = 1e-3;
    for (let corner = 0; corner < 8; corner++) {
      const at = new Vector3(
        corner & 1 ? box.max.x : box.min.x,
        corner & 2 ? box.max.y : box.min.y,
        corner & 4 ? box.max.z : box.min.z,
      ).sub(center);
      const near = this.flat ? 0 : at.dot(this.back);
      const across = Math.max(Math.abs(at.dot(this.right)) / this.aspect / MARGIN, Math.abs(at.dot(this.up)) / tall);
      distance = Math.max(distance, across / slope + near);
    }
    [this.azimuth, this.elevation] = [kept, keptUp];
    this.orient();
    return { target: center, distance, azimuth, elevation, field: FIELD };
  }

  rotate(azimuth, elevation) {
    this.stop();
    this.azimuth += azimuth;
    this.elevation = Math.min(Math.max(this.elevation + elevation, -Math.PI / 2), Math.PI / 2);
    this.changed();
  }

  /** Moves by a part of the picture's height. */
  pan(x, y) {
    this.stop();
    this.target.addScaledVector(this.right, x * 2 * this.reach);
    if (this.level) {
      const ahead = new Vector3().crossVectors(new Vector3(0, 1, 0), this.right);
      this.target.addScaledVector(ahead, (y * 2 * this.reach) / Math.max(Math.abs(Math.sin(this.elevation)), 0.2));
    } else this.target.addScaledVector(this.up, y * 2 * this.reach);
    this.changed();
  }

  /** Comes nearer by `factor` < 1 so that what is under (x, y), -1 to 1, stays there. */
  zoom(factor, x = 0, y = 0) {
    this.stop();
    const distance = Math.min(Math.max(this.distance * factor, NEAREST), FARTHEST);
    const moved = 1 - distance / this.distance;
    const under = this.level ? this.#under(x, y) : null;
    if (under) {
      this.target.lerp(under, moved);
      this.distance = distance;
      return this.changed();
    }
    this.target.addScaledVector(this.right, x * this.reach * this.aspect * moved);
    this.target.addScaledVector(this.up, y * this.reach * moved);
    this.distance = distance;
    this.changed();
  }

  /** The point under (x, y) as high as the target; null above the horizon or far behind the target. */
  #under(x, y) {
    const slope = Math.tan(this.field / 2);
    const across = this.right.clone().multiplyScalar(x * slope * this.aspect).addScaledVector(this.up, y * slope);
    const from = this.back.clone().multiplyScalar(this.distance);
    const way = this.back.clone().negate();
    if (this.flat) from.addScaledVector(across, this.distance);
    else way.add(across);
    const far = -from.y / way.y;
    if (!(far > 0 && far < 12 * this.distance)) return null;
    return from.addScaledVector(way, far).add(this.target);
  }

  /** Turns to a state of `fitted` or a part of one, the short way round, in `time` (ms). */
  go(state, at_once = false, time = TURN_TIME) {
    this.stop();
    const from = this.state();
    const to = { ...from, ...state };
    const turn = to.azimuth - from.azimuth;
    to.azimuth = from.azimuth + Math.atan2(Math.sin(turn), Math.cos(turn));
    const put = (t) => {
      this.target.lerpVectors(from.target, to.target, t);
      this.azimuth = from.azimuth + (to.azimuth - from.azimuth) * t;
      this.elevation = from.elevation + (to.elevation - from.elevation) * t;
      this.distance = from.distance * (to.distance / from.distance) ** t;
      this.field = from.field + (to.field - from.field) * t;
      this.changed();
    };
    if (at_once || document.hidden || matchMedia('(prefers-reduced-motion: reduce)').matches) return put(1);
    this.#put = put;
    const start = performance.now();
    const step = () => {
      const t = Math.min((performance.now() - start) / time, 1);
      this.#animation = t < 1 ? requestAnimationFrame(step) : 0;
      put(1 - (1 - t) ** 3);
    };
    step();
  }

  stop() {
    cancelAnimationFrame(this.#animation);
    this.#animation = 0;
    this.#put = null;
  }

  /** Ends a turn where it leads. */
  arrive() {
    const put = this.moving ? this.#put : null;
    this.stop();
    put?.(1);
    this.pose();
  }

  get moving() {
    return this.#animation !== 0;
  }

  state() {
    const { azimuth, elevation, distance, field } = this;
    return { target: this.target.clone(), azimuth, elevation, distance, field };
  }
}

/** The view of `name` in radians. */
export function view(name) {
  const [azimuth, elevation] = VIEWS[name];
  return { azimuth: azimuth * DEGREE, elevation: elevation * DEGREE };
}

/**
 * The first view of a model: steeper on what is flat, as the pictures of `run` are. With `up`, the side of a planet that
 * is in focus.
 */
export function firstView(box, up) {
  if (up) {
    const elevation = Math.asin(up.y / up.length());
    return { azimuth: Math.atan2(up.x, -up.z), elevation: Math.min(Math.max(elevation, -85 * DEGREE), 85 * DEGREE) };
  }
  const size = box.getSize(new Vector3());
  const slender = Math.min(Math.max(size.y / Math.max(size.x, size.z, 1e-9), 0.1), 3);
  const bend = slender < 1 ? 16 : 16.8;
  return { azimuth: 150 * DEGREE, elevation: (22 - bend * Math.log10(slender)) * DEGREE };
}
