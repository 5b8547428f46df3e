// The ground: a grid in metres that suits the zoom, and the model's shadow.

import {
  Color,
  DoubleSide,
  LinearSRGBColorSpace,
  Mesh,
  PlaneGeometry,
  ShaderMaterial,
  ShadowMaterial,
  Vector2,
} from 'three';

const VERTEX = /* glsl */ `
varying vec2 at;
void main() {
  at = position.xy;
  gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0);
}`;

// Colours are those of the screen already, and nothing is found twice: without a graphics card each term costs time.
const FRAGMENT = /* glsl */ `
varying vec2 at;
uniform vec2 origin;
uniform float cell, blend, radius, opacity;
uniform vec2 axes;
uniform vec3 color, east, north;

float lines(vec2 q, vec2 w) {
  vec2 d = abs(fract(q - 0.5) - 0.5);
  vec2 line = clamp(1.5 - d / w, 0.0, 1.0);
  // Where cells are smaller than pixels only their mean is left.
  line *= clamp((0.45 - w) / 0.33, 0.0, 1.0);
  return max(line.x, line.y);
}

void main() {
  vec2 p = at * radius + origin;
  float fade = 1.0 - smoothstep(0.08, 0.85, length(at));
  vec2 q = p / cell;
  vec2 w = fwidth(p);
  vec2 v = w / cell;
  float fine = lines(q, v * 0.8) * 0.28 * (1.0 - blend);
  float coarse = lines(q * 0.1, v * 0.1) * mix(0.62, 0.28, blend);
  float coarsest = lines(q * 0.01, v * 0.01) * 0.62 * blend;
  float a = max(max(fine, coarse), coarsest);
  vec2 axis = clamp((1.92 * w - abs(p)) / (1.32 * w), 0.0, 1.0) * axes;
  vec3 c = mix(mix(color, east, axis.y), north, axis.x);
  a = max(a, max(axis.x, axis.y) * 1.3);
  gl_FragColor = vec4(c, a * fade * opacity);
}`;

/** How many pixels the finest cells measure at least. */
const FINEST = 9;

/** How much of a model's height, and of its width, lies below zero if it is a body around zero. */
const FREE = 0.25;

/** The height (m) of a model that is a body among others in space. */
const VAST = 50_000;

export class Ground {
  cell = 1;
  height = 0;
  /** Whether the model stands on no ground. */
  free = false;
  empty = true;
  #wanted = null;
  #opacity = 0.4;
  #uniforms = {
    origin: { value: new Vector2() },
    cell: { value: 1 },
    blend: { value: 0 },
    radius: { value: 1 },
    axes: { value: new Vector2(1, 1) },
    opacity: { value: 1 },
    color: { value: new Color() },
    east: { value: new Color() },
    north: { value: new Color() },
  };

  constructor(scene) {
    const plane = new PlaneGeometry(2, 2);
    plane.rotateX(-Math.PI / 2);
    const flat = new PlaneGeometry(2, 2);
    const material = new ShaderMaterial({
      vertexShader: VERTEX,
      fragmentShader: FRAGMENT,
      uniforms: this.#uniforms,
      transparent: true,
      depthWrite: false,
      side: DoubleSide,
      toneMapped: false,
    });
    this.grid = new Mesh(flat, material);
    this.grid.rotation.x = -Math.PI / 2;
    this.grid.frustumCulled = false;
    this.grid.renderOrder = -2;
    this.shade = new Mesh(plane, new ShadowMaterial({ opacity: 0.3, depthWrite: false }));
    this.shade.receiveShadow = true;
    this.shade.renderOrder = -1;
    scene.add(this.grid, this.shade);
  }

  theme(dark) {
    const put = (name, color) => this.#uniforms[name].value.setHex(color, LinearSRGBColorSpace);
    put('color', dark ? 0xaab6bf : 0x4c5a66);
    put('east', dark ? 0xe0655f : 0xc0392f);
    put('north', dark ? 0x6fbf73 : 0x2f8a3b);
    this.#opacity = dark ? 0.34 : 0.36;
    this.shade.material.opacity = dark ? 0.5 : 0.3;
  }

  /** The ground lies under `box`, at zero or below where that is near; `origin` is where the model's zero is.
   *
   *  A body around zero, as a planet is, and what is farther from zero than it is large do not stand on anything, so there
   *  is no ground unless someone wants one: then it is as high as they are. A slab has a ground though its base lies
   *  below zero. */
  under(box, origin) {
    const zero = -origin.y;
    const { min, max } = box;
    const [wide, tall] = box.isEmpty() ? [1, 1] : [Math.max(max.x - min.x, max.z - min.z), max.y - min.y];
    const size = Math.max(wide, tall);
    const around = zero - min.y > FREE * tall && zero - min.y > FREE * wide;
    const far = min.y - zero > size || zero - max.y > size;
    this.free = !box.isEmpty() && (around || far || tall > VAST);
    this.height = box.isEmpty() ? zero : far ? min.y : Math.min(zero, min.y);
    this.origin = origin;
    // A hair lower than what stands on it.
    this.shade.position.set(0, this.height - size * 2e-4, 0);
    if (!box.isEmpty()) {
      this.shade.position.x = (box.min.x + box.max.x) / 2;
      this.shade.position.z = (box.min.z + box.max.z) / 2;
    }
    this.shade.scale.setScalar(size * 4);
    this.empty = box.isEmpty();
    this.grid.position.y = this.height - size * 3e-4;
    this.#show();
  }

  get visible() {
    return this.grid.visible;
  }

  /** Shows or hides the grid, whatever stands on it. */
  set visible(wanted) {
    this.#wanted = wanted;
    this.#show();
  }

  /** Whether what stands on the ground throws a shadow on it. */
  shaded(wanted) {
    this.shade.visible = wanted && !this.empty && !this.free;
  }

  #show() {
    this.grid.visible = this.#wanted ?? !this.free;
  }

  /** Follows the camera; `ratio` is of the picture's pixels to the page's. Returns how far (m) the grid reaches. */
  follow(camera, pixels, ratio) {
    const pixel = (2 * camera.reach) / pixels;
    const exact = Math.log10(pixel * FINEST);
    const level = Math.ceil(exact);
    const cell = 10 ** level;
    const blend = 1 - (level - exact);
    const radius = Math.max(camera.distance * 4, camera.reach * 8);
    const uniforms = this.#uniforms;
    uniforms.cell.value = cell;
    uniforms.blend.value = blend ** 2;
    uniforms.radius.value = radius;
    // Lines are as wide as a pixel, and large ones must not be darker.
    uniforms.opacity.value = this.#opacity * Math.min(ratio, 1);
    const [x, z] = [camera.target.x, camera.target.z];
    this.grid.position.x = x;
    this.grid.position.z = z;
    this.grid.scale.set(radius, radius, 1);
    const origin = this.origin ?? { x: 0, z: 0 };
    // The remainder is exact in doubles and small enough for the shader; zero and its axes are then far away.
    const middle = [x + origin.x, -(z + origin.z)];
    const far = middle.map((value) => Math.abs(value) > cell * 2e4);
    uniforms.origin.value.set(...middle.map((value, i) => (far[i] ? value % (cell * 100) : value)));
    uniforms.axes.value.set(far[0] ? 0 : 1, far[1] ? 0 : 1);
    this.cell = blend > 0.6 ? cell * 10 : cell;
    return radius;
  }
}
