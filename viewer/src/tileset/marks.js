// Marks over the tileset: where tiles are that are too small to be seen, and where something is missing.

import {
  BufferAttribute,
  BufferGeometry,
  Color,
  DoubleSide,
  Group,
  LinearSRGBColorSpace,
  LineBasicMaterial,
  LineSegments,
  Matrix4,
  Mesh,
  MeshBasicMaterial,
  Points,
  ShaderMaterial,
  Vector3,
} from 'three';
import { position } from './world.js';

const VERTEX = /* glsl */ `
attribute float radius;
uniform float tall, ratio, least, most, fades;
varying float shown;
// A radius below zero is of a tile that is shown itself.
void main() {
  gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0);
  float pixels = radius * projectionMatrix[1][1] * tall * 0.5 / gl_Position.w;
  shown = pixels < 0.0 ? 0.0 : fades > 0.0 ? 1.0 - smoothstep(fades * 0.5, fades, pixels) : 1.0;
  gl_PointSize = shown > 0.0 ? clamp(pixels * 2.0, least, most) * ratio : 0.0;
}`;

const FRAGMENT = /* glsl */ `
uniform vec3 color, rim;
varying float shown;
void main() {
  float far = length(gl_PointCoord - 0.5) * 2.0;
  float edge = fwidth(far);
  float alpha = (1.0 - smoothstep(1.0 - edge * 1.5, 1.0, far)) * shown;
  if (alpha <= 0.0) discard;
  gl_FragColor = vec4(mix(color, rim, smoothstep(0.58, 0.62 + edge, far)), alpha);
}`;

const NEAR = 10; // pixels from a mark that a click may be

export class Marks {
  #group = new Group();
  #tiles = dots({ least: 7, most: 9, fades: 300 });
  #missing = dots({ least: 6, most: 13, fades: 0 });
  #line = new LineBasicMaterial({ transparent: true, opacity: 0.9, depthTest: false, toneMapped: false });
  #fill = new MeshBasicMaterial({ transparent: true, opacity: 0.16, depthWrite: false, side: DoubleSide, toneMapped: false });
  #outlines = new LineSegments(new BufferGeometry(), this.#line);
  #areas = new Mesh(new BufferGeometry(), this.#fill);
  #leaves = null;
  #list = [];
  #list_leaves = [];
  /** Marks are placed around this, so that 32-bit floats are exact. */
  #center = new Vector3();
  #to = new Matrix4();

  constructor(stage) {
    this.stage = stage;
    for (const it of [this.#areas, this.#outlines, this.#tiles, this.#missing]) {
      it.frustumCulled = false;
      it.renderOrder = 5;
      this.#group.add(it);
    }
    this.#group.matrixAutoUpdate = false;
    stage.scene.add(this.#group);
  }

  theme(dark) {
    const put = (dot, color) => {
      dot.material.uniforms.color.value.setHex(color, LinearSRGBColorSpace);
      dot.material.uniforms.rim.value.setHex(dark ? 0x191c1f : 0xffffff, LinearSRGBColorSpace);
    };
    put(this.#tiles, dark ? 0x62c795 : 0x1e7a52);
    put(this.#missing, dark ? 0xf0b95c : 0xb86e00);
    for (const material of [this.#line, this.#fill]) material.color.set(dark ? 0xf0b95c : 0xb86e00);
    this.stage.invalidate();
  }

  /** Puts the marks where the world is now, and those of `leaves` if they are others. */
  place(world, leaves) {
    if (leaves !== this.#leaves) {
      this.#leaves = leaves;
      this.#list_leaves = leaves.filter(({ uri }) => uri);
      this.#center.copy(leaves[0].foot);
      fill(this.#tiles, this.#list_leaves.map(({ foot, radius }) => [foot, radius]), this.#center);
      this.#fillMissing();
    }
    this.#to.copy(world.toPage).multiply(new Matrix4().setPosition(this.#center));
    this.#group.matrix.copy(this.#to);
    this.#group.matrixWorldNeedsUpdate = true;
  }

  /** Marks missing features and tiles: `{place, ring}` each, with geographical coordinates. */
  missing(list) {
    this.#list = list.filter(({ place }) => place);
    if (this.#leaves) this.#fillMissing();
    this.stage.invalidate();
  }

  #fillMissing() {
    const ground = heights(this.#leaves);
    for (const it of this.#list) it.foot = position({ ...it.place, height: ground(it.place) });
    fill(this.#missing, this.#list.map(({ foot, radius = 8 }) => [foot, radius]), this.#center);
    const [lines, faces] = [[], []];
    for (const { ring } of this.#list.filter((it) => it.ring)) {
      const corners = ring.map(([longitude, latitude]) =>
        position({ longitude, latitude, height: ground({ longitude, latitude }) + 0.3 }).sub(this.#center),
      );
      for (let i = 0; i + 1 < corners.length; i++) {
        lines.push(corners[i], corners[i + 1]);
        if (i > 0 && i + 2 < corners.length) faces.push(corners[0], corners[i], corners[i + 1]);
      }
    }
    for (const [it, points] of [[this.#outlines, lines], [this.#areas, faces]]) {
      it.geometry.dispose();
      it.geometry = new BufferGeometry().setFromPoints(points);
      it.visible = points.length > 0;
    }
  }

  /** Hides the marks of tiles that are shown, by their addresses. */
  cover(shown) {
    const { radius } = this.#tiles.geometry.attributes;
    this.#list_leaves.forEach((leaf, i) => {
      leaf.covered = shown.has(leaf.uri);
      radius.array[i] = leaf.covered ? -1 : leaf.radius;
    });
    radius.needsUpdate = true;
  }

  /** Before each frame. */
  frame() {
    const ratio = this.stage.renderer.getPixelRatio();
    for (const it of [this.#tiles, this.#missing]) {
      it.material.uniforms.tall.value = this.stage.size[1];
      it.material.uniforms.ratio.value = ratio;
    }
  }

  /** The missing feature or tile whose mark is under a pixel of the window, or null. */
  missingAt(x, y) {
    return this.#at(x, y, this.#list);
  }

  /** The tile whose mark is under a pixel of the window, or null. */
  tileAt(x, y) {
    return this.#at(x, y, this.#list_leaves.filter(({ covered }) => !covered));
  }

  #at(x, y, list) {
    let [best, least] = [null, NEAR];
    const [point, to] = [new Vector3(), this.#to];
    for (const it of list) {
      const pixel = this.stage.pixel(point.copy(it.foot).sub(this.#center).applyMatrix4(to));
      const far = pixel ? Math.hypot(pixel[0] - x, pixel[1] - y) : Infinity;
      if (far < least) [best, least] = [it, far];
    }
    return best;
  }
}

/** The height of the ground near a place, from a part of the tiles. */
function heights(leaves) {
  const every = Math.ceil(leaves.length / 300);
  const some = leaves.filter((_, i) => i % every === 0).map(({ place }) => place);
  return ({ longitude, latitude }) => {
    let [best, least] = [some[0].height, Infinity];
    for (const it of some) {
      const far = (it.longitude - longitude) ** 2 + (it.latitude - latitude) ** 2;
      if (far < least) [best, least] = [it.height, far];
    }
    return best;
  };
}

function dots({ least, most, fades }) {
  const uniforms = {
    tall: { value: 1 },
    ratio: { value: 1 },
    least: { value: least },
    most: { value: most },
    fades: { value: fades },
    color: { value: new Color() },
    rim: { value: new Color() },
  };
  const look = { transparent: true, depthTest: false, depthWrite: false, toneMapped: false };
  return new Points(
    new BufferGeometry(),
    new ShaderMaterial({ vertexShader: VERTEX, fragmentShader: FRAGMENT, uniforms, ...look }),
  );
}

function fill(points, list, center) {
  const [at, radii] = [new Float32Array(list.length * 3), new Float32Array(list.length)];
  list.forEach(([foot, radius], i) => {
    foot.clone().sub(center).toArray(at, i * 3);
    radii[i] = radius;
  });
  points.geometry.dispose();
  points.geometry = new BufferGeometry();
  points.geometry.setAttribute('position', new BufferAttribute(at, 3));
  points.geometry.setAttribute('radius', new BufferAttribute(radii, 1));
  points.visible = list.length > 0;
}
