// The picture: draws when something has changed, and never otherwise.
//
// A machine that is slow at a model (or draws without a graphics card) gets plainer frames while things move; the
// finer frame follows as soon as they rest.

import {
  Box3,
  BufferAttribute,
  BufferGeometry,
  DoubleSide,
  FogExp2,
  FrontSide,
  Group,
  InstancedMesh,
  Mesh,
  MeshStandardMaterial,
  PCFShadowMap,
  Raycaster,
  Scene,
  Vector2,
  Vector3,
  WebGLRenderer,
} from 'three';
import { Camera } from './camera.js';
import { faceted } from './faceted.js';
import { Ground } from './grid.js';
import { Light } from './light.js';
import { Mark } from './mark.js';
import { Model } from './model.js';
import { Plain } from './plain.js';
import { Shading } from './shading.js';
import { nearest } from './ray.js';
import { toneMapping } from './tone.js';

const REST = 160; // ms without a change after which the finer frame is drawn
const LONGER = 1000; // ms longer at most where a frame takes long
const FEW = 10_000; // triangles below which a new model's first frame is a finer one without a graphics card, too
const SLOW = 40; // ms for a frame above which moving frames are plainer
const SMOOTH = 22; // ms for a plain frame below which the finer one may have more pixels than the page
const STILL = 400; // ms after the finer frame until one with smooth edges follows, if its own are not
const LARGE = 3_000_000; // triangles from which a model is not kept for a comparison
const MANY = 150_000; // triangles from which none follows without a graphics card

export class Stage {
  model = new Model();
  scene = new Scene();
  mark = new Mark();
  shading = new Shading();
  /** The model before the last save; null before the first. */
  before = null;
  /** What is seen of the two: `now`, `before`, or `both` side by side. */
  #seen = 'now';
  /** The plane of the cut, whose normal points to what is kept; null without a cut. */
  cut = null;
  #frame = 0;
  #rest = 0;
  #cost = 0;
  /** The same of frames with shadows alone: on slow machines the others tell nothing of them. */
  #fineCost = 0;
  #coarse = false;
  #waiting = false;
  #grew = false;
  #shadowDue = false;
  #drawn = [];
  #before = [];

  /** Fails where there is no WebGL. */
  constructor(canvas) {
    this.canvas = canvas;
    this.camera = new Camera(() => this.invalidate());
    const context = canvas.getContext('webgl2', {
      alpha: true,
      antialias: !software(),
      depth: true,
      powerPreference: 'high-performance',
    });
    if (!context) throw new Error('no WebGL 2');
    this.slow = software(context);
    this.renderer = new WebGLRenderer({ canvas, context });
    this.renderer.toneMapping = toneMapping();
    this.renderer.toneMappingExposure = 1.15;
    this.renderer.shadowMap.enabled = true;
    this.renderer.shadowMap.type = PCFShadowMap;
    this.renderer.setClearColor(0, 0);
    this.light = new Light(this.scene, this);
    this.plain = new Plain(this.light);
    if (!this.slow) this.light.reflect(this.renderer, this.scene);
    this.ground = new Ground(this.scene);
    this.ground.under(this.model.box, this.model.origin);
    this.scene.add(this.model.group);
    this.#warm();
    new ResizeObserver(() => this.#resize()).observe(canvas);
    this.#resize();
    canvas.addEventListener('webglcontextrestored', () => ((this.#shadowDue = true), this.invalidate()));
  }

  /** Calls `listener` after each frame. */
  onDraw(listener) {
    this.#drawn.push(listener);
  }

  /** Calls `listener` with the camera before each frame. */
  onFrame(listener) {
    this.#before.push(listener);
  }

  /** Parts of the model have come or gone: without a graphics card a finer frame may take longer than before. */
  grown() {
    this.#shade();
    this.#grew = this.slow && this.model.triangles >= FEW;
    if (this.#grew) this.#fineCost = Infinity;
  }

  /** Fits the ground and the shadow to `box`, which may be a part of the model, and draws what has changed in it. */
  refit(box = this.model.box) {
    this.ground.under(box, this.model.origin);
    this.#fitLight(box);
    this.#shadowDue = true;
    this.invalidate();
  }

  theme(dark) {
    for (const it of [this.ground, this.mark, this.shading]) it.theme(dark);
    this.invalidate();
  }

  /** Shows only these parts of the model, which are cut from its own. */
  show(parts) {
    this.mark.clear();
    this.shading.clear();
    this.model.draw(parts);
    this.#shade();
    this.#shadowDue = true;
    this.invalidate();
  }

  /** Puts the sun, or takes `null` for the usual one; `sky` tells whether the sky gives light. */
  lighten(sun, sky) {
    if (sun) this.light.set(sun.azimuth, sun.elevation, sky);
    else this.light.reset();
    this.plain.renew();
    this.refit();
  }

  /** Puts haze of a colour before what is far away; at a `density` of 1, half of the model is in it. */
  haze(density, color) {
    this.scene.fog = density > 0 ? new FogExp2(color, 1 / this.clear(density)) : null;
    this.invalidate();
  }

  /** The distance (m) at which haze of a density hides two thirds of what is there. */
  clear(density) {
    const size = this.model.box.isEmpty() ? 1 : this.model.box.getSize(new Vector3()).length();
    return size / (0.4 * density);
  }

  get seen() {
    return this.#seen;
  }

  /** Shows the model of `now`, the one `before` the last save, or `both`. */
  set seen(seen) {
    this.#seen = this.before ? seen : 'now';
    this.#fitLight(this.model.box);
    this.#shadowDue = true;
    this.#aspect();
    this.invalidate();
  }

  /** The part of the window with the picture of the present model under the pixel column `x`, or of the other. */
  area(x = Infinity) {
    const { left, top, width, height } = this.canvas.getBoundingClientRect();
    if (this.#seen !== 'both') return { left, top, width, height };
    const half = width / 2;
    return { left: x < left + half ? left : left + half, top, width: half, height };
  }

  #aspect() {
    this.camera.aspect = this.size[0] / this.size[1] / (this.#seen === 'both' ? 2 : 1);
  }

  #shade() {
    this.shading.apply(...[this.model, this.before].filter(Boolean));
  }

  #fitLight(box) {
    const whole = box.clone();
    if (this.before && this.#seen !== 'now')
      whole.union(this.before.box.clone().translate(this.before.group.position));
    this.light.fit(whole, this.ground.height);
  }

  /** Puts `model` in the place of the one before and draws it at once; `meanwhile` is called while the graphics card
   *  works; with `keep` the one before stays for a comparison. Returns the milliseconds. */
  swap(model, meanwhile, keep = false) {
    const start = performance.now();
    const old = this.model;
    this.mark.clear();
    this.shading.clear();
    this.model = model;
    if (keep && !old.box.isEmpty()) {
      if (this.before) this.scene.remove(this.before.group);
      this.before?.dispose();
      this.before = old.triangles < LARGE ? old : null;
    }
    if (this.before !== old) this.scene.remove(old.group);
    if (!this.before) this.#seen = 'now';
    // The camera stays where it is in the scene, also if the page's own zero moves.
    if (model.box.isEmpty()) model.origin.copy(old.origin);
    this.camera.target.add(old.origin).sub(model.origin);
    this.before?.group.position.copy(this.before.origin).sub(model.origin);
    this.scene.add(model.group);
    this.#shade();
    this.ground.under(model.box, model.origin);
    this.#fitLight(model.box);
    this.#shadowDue = true;
    if (this.before !== old) old.dispose();
    const fine = !this.slow || model.triangles < FEW;
    this.#draw(fine);
    meanwhile();
    this.#finish();
    this.#cost = performance.now() - start;
    this.#fineCost = fine ? this.#cost : Infinity;
    this.#later();
    return this.#cost;
  }

  /** Whether another model is being made: without a graphics card the finer frame would take the time that it needs. */
  wait(waiting) {
    if (!this.slow) return;
    this.#waiting = waiting;
    this.#later();
  }

  get mode() {
    return this.shading.mode;
  }

  set mode(mode) {
    this.shading.mode = mode;
    this.#shade();
    this.invalidate();
  }

  invalidate() {
    this.#frame ||= requestAnimationFrame(() => {
      this.#frame = 0;
      const start = performance.now();
      const fine = this.#mayBeFine;
      this.#draw(fine);
      if (!fine || this.slow) {
        this.#finish();
        const cost = performance.now() - start;
        this.#cost = this.#cost * 0.5 + cost * 0.5;
        if (fine) this.#fineCost = this.#fineCost * 0.5 + cost * 0.5;
      }
      this.#later();
    });
  }

  /** Whether moving frames have shadows. */
  get #mayBeFine() {
    return (this.slow ? this.#fineCost : this.#cost) < SLOW && !this.#shadowDue;
  }

  /** Draws the finer frame when nothing has changed for a while. */
  #later() {
    clearTimeout(this.#rest);
    if (this.#waiting) return;
    const rest = REST + (this.slow ? Math.min(this.#cost, LONGER) : 0);
    this.#rest = setTimeout(() => {
      if (this.camera.moving) return;
      this.#draw(true, true);
      if (this.slow && this.renderer.getPixelRatio() === 1 && this.model.triangles < MANY)
        this.#rest = setTimeout(() => this.#draw(true, true, 2), STILL);
    }, rest);
  }

  #draw(fine, still = false, ratio = null) {
    const { renderer, camera, model, light } = this;
    const [width, height] = this.size;
    if (width === 0 || height === 0) return;
    this.#scale(ratio ?? this.#ratio(still));
    const grid = this.ground.follow(camera, height, renderer.getPixelRatio());
    const [center, radius] = this.#extent(grid);
    const from = camera.place(center, radius);
    for (const listener of this.#before) listener(from);
    const shadows = fine && (still || !this.#grew) && this.shading.mode !== 'normals';
    this.#grew = false;
    if (shadows && this.#shadowDue) {
      light.sun.shadow.needsUpdate = true;
      this.#shadowDue = false;
    }
    // Only a uniform of the same shaders, or those of plain materials, so that nothing has to be compiled.
    for (const it of [model, this.before].filter(Boolean)) {
      for (const part of it.meshes) part.receiveShadow = shadows;
      if (this.slow) this.shading.plainly(it, shadows ? null : this.plain);
    }
    this.ground.shaded(shadows);
    this.plain.follow(from);
    this.#render(from);
    // What follows takes its time while the graphics card works.
    renderer.getContext().flush();
    for (const listener of this.#drawn) listener();
  }

  /** Draws the model, the one before, or both beside each other. */
  #render(from) {
    const { renderer, model, before } = this;
    const [width, height] = this.size;
    const draw = (seen) => {
      model.group.visible = seen === model;
      if (before) before.group.visible = seen === before;
      renderer.render(this.scene, from);
    };
    if (this.#seen !== 'both') return draw(this.#seen === 'before' ? before : model);
    renderer.setScissorTest(true);
    const { needsUpdate } = this.light.sun.shadow;
    for (const [i, seen] of [before, model].entries()) {
      renderer.setViewport((i * width) / 2, 0, width / 2, height);
      renderer.setScissor((i * width) / 2, 0, width / 2, height);
      // Each throws its own shadow.
      this.light.sun.shadow.needsUpdate = needsUpdate || this.ground.shade.visible || seen.meshes[0]?.receiveShadow === true;
      draw(seen);
    }
    renderer.setScissorTest(false);
    renderer.setViewport(0, 0, width, height);
  }

  /** What the clip planes must leave in. */
  #extent(grid) {
    const { box } = this.model;
    const all = new Box3().copy(box);
    const ground = this.camera.target.clone().setY(this.ground.height);
    all.expandByPoint(ground);
    const radius = box.isEmpty() ? 0 : box.getSize(new Vector3()).length() / 2;
    const center = all.getCenter(new Vector3());
    return [
      center,
      Math.max(
        radius + center.distanceTo(box.isEmpty() ? center : box.getCenter(new Vector3())),
        center.distanceTo(ground) + grid * 0.9,
      ),
    ];
  }

  /** Pixels of the drawing for each of the page's; without a graphics card edges are smoothed only at rest. */
  #ratio(still) {
    if (!this.slow) return Math.min(devicePixelRatio, 2);
    if (still) return this.#cost < SMOOTH ? 2 : 1;
    this.#coarse = this.#cost > (this.#coarse ? SLOW / 2 : SLOW);
    return this.#coarse ? 0.5 : 1;
  }

  #scale(ratio) {
    if (this.renderer.getPixelRatio() !== ratio) this.renderer.setPixelRatio(ratio);
  }

  #resize() {
    const { clientWidth, clientHeight } = this.canvas;
    this.size = [clientWidth, clientHeight];
    if (clientWidth === 0 || clientHeight === 0) return;
    this.renderer.setSize(clientWidth, clientHeight, false);
    this.#aspect();
    this.camera.height = clientHeight;
    cancelAnimationFrame(this.#frame);
    this.#frame = 0;
    this.#draw(this.#mayBeFine);
    this.#later();
  }

  /** Waits until the frame is on the screen's side, so that its time can be told. */
  #finish() {
    const context = this.renderer.getContext();
    context.readPixels(0, 0, 1, 1, context.RGBA, context.UNSIGNED_BYTE, new Uint8Array(4));
  }

  /** Compiles the usual shaders while the first script still runs. */
  #warm() {
    const geometry = new BufferGeometry();
    for (const name of ['position', 'normal']) geometry.setAttribute(name, new BufferAttribute(new Float32Array(9), 3));
    const warm = new Group();
    for (const side of [FrontSide, DoubleSide]) {
      const material = new MeshStandardMaterial({ side });
      const pair = (it) => (this.slow ? [it, this.plain.of(it)] : [it]);
      const meshes = pair(material).flatMap((it) => [new Mesh(geometry, it), new InstancedMesh(geometry, it, 1)]);
      // Without a graphics card each shader takes its time, and of flat surfaces these are the usual ones.
      if (side === FrontSide) meshes.push(...pair(faceted(material)).map((it) => new Mesh(geometry, it)));
      for (const mesh of meshes)
        warm.add(Object.assign(mesh, { castShadow: true, receiveShadow: true, frustumCulled: false }));
    }
    this.scene.add(warm);
    this.light.sun.shadow.needsUpdate = true;
    this.size = [1, 1];
    this.#draw(true);
    this.scene.remove(warm);
    // The materials stay referenced, or their shaders would go with them.
    this.warm = warm;
  }

  /** How `box` is seen: whether `whole`, whether any of it may be `inside` the picture, and how much of the picture's
   *  width or height it fills (0 to 1, and more). */
  framing(box = this.model.box) {
    const camera = this.camera.active;
    const corners = Array.from({ length: 8 }, (_, i) =>
      new Vector3(i & 1 ? box.min.x : box.max.x, i & 2 ? box.min.y : box.max.y, i & 4 ? box.min.z : box.max.z),
    );
    const behind = corners.some((it) => it.clone().applyMatrix4(camera.matrixWorldInverse).z > -1e-9);
    const seen = corners.map((it) => it.clone().project(camera));
    const ends = ['x', 'y'].map((axis) => seen.map((it) => it[axis])).map((all) => [Math.min(...all), Math.max(...all)]);
    const whole = !behind && ends.every(([low, high]) => low >= -1 && high <= 1);
    const inside = behind || ends.every(([low, high]) => low < 1 && high > -1);
    return { whole, inside, size: behind ? Infinity : Math.max(...ends.map(([low, high]) => high - low)) / 2 };
  }

  /** The triangle under a pixel of the window, or null. */
  at(x, y) {
    // Of the model before, the server knows nothing any more.
    if (this.#seen === 'before' || x < this.area().left) return null;
    const ray = this.#ray(x, y);
    const { cut } = this;
    if (cut && cut.distanceToPoint(ray.origin) < 0) {
      // What is cut away before the plane is not met.
      const enters = ray.distanceToPlane(cut);
      if (enters === null) return null;
      ray.origin.addScaledVector(ray.direction, enters);
    }
    const hit = nearest(this.model, ray, cut !== null);
    return hit && cut && cut.distanceToPoint(hit.point) < -1e-6 * this.model.box.getSize(new Vector3()).length() ? null : hit;
  }

  #ray(x, y) {
    const box = this.area(x);
    const caster = new Raycaster();
    caster.setFromCamera(
      new Vector2(((x - box.left) / box.width) * 2 - 1, 1 - ((y - box.top) / box.height) * 2),
      this.camera.active,
    );
    return caster.ray;
  }

  /** The pixel of the window where a point in the page's own coordinates is; null behind the camera. */
  pixel(point) {
    const box = this.area();
    const seen = point.clone().project(this.camera.active);
    if (seen.z > 1 || seen.z < -1) return null;
    return [box.left + ((seen.x + 1) / 2) * box.width, box.top + ((1 - seen.y) / 2) * box.height];
  }

  /** The ray from the camera through a pixel of the window. */
  ray(x, y) {
    return this.#ray(x, y);
  }

  /** A point of the scene (m, z up) in the page's own coordinates. */
  inside([x, y, z]) {
    return new Vector3(x, z, -y).sub(this.model.origin);
  }

  /** A picture of what is seen, on `background` (two colours, top and bottom). */
  picture(background) {
    this.#draw(true, true, Math.max(devicePixelRatio, 2));
    this.#later();
    const { width, height } = this.canvas;
    const paper = document.createElement('canvas');
    [paper.width, paper.height] = [width, height];
    const draw = paper.getContext('2d');
    const fill = draw.createLinearGradient(0, 0, 0, height);
    background.forEach((color, i) => fill.addColorStop(i, color));
    draw.fillStyle = fill;
    draw.fillRect(0, 0, width, height);
    draw.drawImage(this.canvas, 0, 0);
    return new Promise((resolve) => paper.toBlob(resolve, 'image/png'));
  }
}

let known;

/** Whether WebGL runs on the processor. */
function software(context) {
  if (known !== undefined) return known;
  const probe = context ?? document.createElement('canvas').getContext('webgl2');
  if (!probe) return false;
  const info = probe.getExtension('WEBGL_debug_renderer_info');
  const name = probe.getParameter(info ? info.UNMASKED_RENDERER_WEBGL : probe.RENDERER);
  if (!context) probe.getExtension('WEBGL_lose_context')?.loseContext();
  return (known = /swiftshader|llvmpipe|softpipe|software|basic render/i.test(name));
}
