// Sun and sky, and the sun's shadow map, which is drawn anew only for a new model.

import {
  Color,
  DataTexture,
  DataUtils,
  DirectionalLight,
  EquirectangularReflectionMapping,
  HalfFloatType,
  HemisphereLight,
  LinearFilter,
  LinearSRGBColorSpace,
  Matrix4,
  PMREMGenerator,
  RGBAFormat,
  Vector3,
} from 'three';

/** Towards the sun: from the south-west, as in the pictures of `run`. */
const SUN = new Vector3(-0.62, 0.72, 0.42).normalize();
const [SUNLIGHT, SKYLIGHT] = [2.3, 1];
const [DAY, EVENING] = [new Color(0xfff3e0), new Color(0xffa45c)];
const REFLECTIONS = 0.55;
const DARK = 0.18; // part of the sky's light that is left without it

export class Light {
  /** Unit vector towards the sun. */
  toSun = SUN.clone();
  #slow;
  #scene;

  constructor(scene, { slow }) {
    // Without a graphics card there are no reflections (they take seconds to prepare), so the sky gives all light.
    this.#slow = slow;
    this.#scene = scene;
    this.sky = new HemisphereLight(0xdfe8f5, 0x9a948a, this.#skylight);
    this.sun = new DirectionalLight(DAY, SUNLIGHT);
    this.sun.castShadow = true;
    this.sun.shadow.mapSize.setScalar(slow ? 1024 : 2048);
    this.sun.shadow.autoUpdate = false;
    this.sun.shadow.radius = 2.5;
    scene.add(this.sky, this.sun, this.sun.target);
  }

  /** Lets metal and glass reflect a sky. */
  reflect(renderer, scene) {
    const generator = new PMREMGenerator(renderer);
    const sky = skyPicture();
    scene.environment = generator.fromEquirectangular(sky).texture;
    scene.environmentIntensity = REFLECTIONS;
    sky.dispose();
    generator.dispose();
  }

  get #skylight() {
    return this.#slow ? 2.2 * SKYLIGHT : SKYLIGHT;
  }

  /** Puts the sun at an azimuth from north and an elevation (rad), and takes the sky's light away or gives it back. A low sun
   *  is redder and weaker. */
  set(azimuth, elevation, sky) {
    const level = Math.cos(elevation);
    this.toSun.set(Math.sin(azimuth) * level, Math.sin(elevation), -Math.cos(azimuth) * level);
    const high = Math.min(Math.max(Math.sin(elevation) / 0.5, 0), 1);
    this.sun.color.copy(EVENING).lerp(DAY, high);
    this.sun.intensity = SUNLIGHT * (0.35 + 0.65 * high);
    const part = sky ? 0.45 + 0.55 * high : DARK;
    this.sky.intensity = this.#skylight * part;
    this.#scene.environmentIntensity = REFLECTIONS * part;
  }

  /** Puts the sun and the sky where they are without a choice. */
  reset() {
    this.toSun.copy(SUN);
    this.sun.color.copy(DAY);
    this.sun.intensity = SUNLIGHT;
    this.sky.intensity = this.#skylight;
    this.#scene.environmentIntensity = REFLECTIONS;
  }

  /** Fits the shadow to `box` and the ground at `height`. */
  fit(box, height) {
    if (box.isEmpty()) return;
    const center = box.getCenter(new Vector3());
    const radius = Math.max(box.getSize(new Vector3()).length() / 2, 1e-6);
    this.sun.position.copy(center).addScaledVector(this.toSun, radius * 2);
    this.sun.target.position.copy(center);
    // With the sun overhead, up is no direction to turn by.
    const up = this.toSun.y > 0.9999 ? new Vector3(0, 0, -1) : new Vector3(0, 1, 0);
    const turn = new Matrix4().lookAt(this.sun.position, center, up).transpose();
    const camera = this.sun.shadow.camera;
    let [width, tall] = [0, 0];
    for (let corner = 0; corner < 8; corner++) {
      const at = new Vector3(
        corner & 1 ? box.max.x : box.min.x,
        corner & 2 ? box.max.y : box.min.y,
        corner & 4 ? box.max.z : box.min.z,
      )
        .sub(center)
        .applyMatrix4(turn);
      [width, tall] = [Math.max(width, Math.abs(at.x)), Math.max(tall, Math.abs(at.y))];
    }
    [camera.left, camera.right, camera.bottom, camera.top] = [-width, width, -tall, tall].map((side) => side * 1.02);
    camera.near = radius * 0.5;
    camera.far = radius * 3.2 + Math.max(0, center.y - height) / Math.max(this.toSun.y, 0.05);
    camera.updateProjectionMatrix();
    const texel = (2 * Math.max(width, tall)) / this.sun.shadow.mapSize.x;
    this.sun.shadow.normalBias = texel * 1.6;
    this.sun.shadow.bias = -0.0004;
  }
}

function skyPicture() {
  const [width, height] = [64, 32];
  const data = new Uint16Array(width * height * 4);
  for (let y = 0; y < height; y++) {
    const up = Math.sin(((y + 0.5) / height - 0.5) * Math.PI);
    for (let x = 0; x < width; x++) {
      const t = Math.max(up, 0) ** 0.5;
      // Bright above the horizon, and a soft window high up, as photographers put one beside what shines.
      const window_ = Math.exp(-(((x / width - 0.2) * 7) ** 2)) * Math.exp(-(((up - 0.5) * 4) ** 2)) * 2.2;
      const color =
        up < 0 ? [0.42, 0.41, 0.39] : [0.95 - 0.45 * t + window_, 0.97 - 0.35 * t + window_, 1.0 - 0.16 * t + window_];
      [...color, 1].forEach((value, i) => (data[(y * width + x) * 4 + i] = DataUtils.toHalfFloat(value)));
    }
  }
  const texture = new DataTexture(data, width, height, RGBAFormat, HalfFloatType);
  texture.mapping = EquirectangularReflectionMapping;
  texture.colorSpace = LinearSRGBColorSpace;
  texture.minFilter = texture.magFilter = LinearFilter;
  texture.needsUpdate = true;
  return texture;
}
