// The tileset in the page's scene: its tiles as one model that grows, and the place on the earth that the page is around.

import { Box3, Group, Vector3 } from 'three';
import { firstView } from '../camera.js';
import { Materials } from '../materials.js';
import { nearest } from '../ray.js';
import { Marks } from './marks.js';
import { Tiles, around } from './tiles.js';
import { World } from './world.js';

const NEAR = 1000; // metres from the anchor within which the earth is flat enough
const RESTS = 200; // ms without a change after which shadows and the anchor follow
const WAITS = 6000; // ms that the tiles of a new tileset may take to come before it is shown all the same
const FLIGHT = 900; // ms

/** What `Stage` draws: the shown tiles. */
class Whole {
  group = new Group();
  parts = [];
  meshes = [];
  box = new Box3();
  origin = new Vector3();
  up = null;
  triangles = 0;

  /** Shows `tiles`. */
  set(tiles) {
    const models = tiles.map((it) => it.model);
    this.parts = models.flatMap((it) => it.parts);
    this.triangles = models.reduce((sum, it) => sum + it.triangles, 0);
    const meshes = new Set(models.flatMap((it) => it.meshes));
    for (const mesh of this.meshes) if (!meshes.has(mesh)) this.group.remove(mesh);
    for (const mesh of meshes) if (mesh.parent !== this.group) this.group.add(mesh);
    this.meshes = [...meshes];
  }

  dispose() {
    this.group.clear();
  }
}

export class Shown {
  world = new World();
  marks;
  #whole = new Whole();
  #tiles = null;
  #next = null;
  #stale = false;
  /** Whether finer frames wait until the tiles have come. */
  #waits = false;
  #rest = 0;
  #region = new Box3();
  #materials;

  /** `changed` is called when other tiles are shown. */
  constructor(stage, { changed }) {
    Object.assign(this, { stage, changed });
    this.#materials = new Materials(stage.slow);
    this.marks = new Marks(stage);
    stage.camera.level = true;
    stage.onFrame((camera) => this.#frame(camera));
    stage.onDraw(() => this.#later());
  }

  /** Loads the tileset again, or for the first time, and shows it when it is there. */
  async load(url) {
    this.#next?.dispose();
    const tiles = new Tiles(url, {
      world: this.world,
      materials: this.#materials,
      slow: this.stage.slow,
      changed: () => (this.#stale = true),
      again: () => this.stage.invalidate(),
    });
    this.#next = tiles;
    // Only the root comes before there is a view.
    tiles.update();
    try {
      await tiles.loaded;
    } catch (error) {
      if (this.#next === tiles) this.#next = null;
      throw error;
    }
    if (this.#next !== tiles) return false;
    const first = this.#tiles === null;
    if (first) this.#anchor(this.#middle(tiles));
    tiles.since = performance.now();
    if (first) this.#turn();
    this.stage.invalidate();
    if (first) this.fit(true);
    return first;
  }

  /** Whether there are tiles on their way. */
  get loading() {
    return this.#next !== null || (this.#tiles !== null && !this.#tiles.settled);
  }

  /** `{shown, of, failed}` tiles; `of` is null if other files name more of them. */
  get counts() {
    const { shown = new Map(), leaves = [], failed = 0 } = this.#tiles ?? {};
    const named = new Set(leaves.map(({ uri }) => uri).filter((uri) => uri));
    const external = [...named].some((uri) => uri.endsWith('.json'));
    const seen = [...shown.keys()].filter((tile) => external || named.has(tile.content.uri));
    return { shown: seen.length, of: external ? null : named.size, failed };
  }

  get triangles() {
    return this.#whole.triangles;
  }

  get box() {
    return this.#whole.box;
  }

  /** The height (m) of the ground above the ellipsoid where a tile is near. */
  get height() {
    return this.world.place.height;
  }

  /** Shows the whole tileset. */
  fit(at_once = false, look = null) {
    if (!this.#tiles) return;
    this.#anchor(this.#middle(this.#tiles));
    const { camera } = this.stage;
    const box = this.#whole.box;
    const wanted = at_once ? { ...firstView(box, null), azimuth: Math.PI } : (look ?? {});
    // Maps have north at the top.
    const { azimuth = camera.azimuth, elevation = camera.elevation } = wanted;
    camera.go(camera.fitted(box, azimuth, elevation), at_once);
  }

  /** Loads again what could not be loaded. */
  retry() {
    this.#tiles?.retry();
    this.stage.invalidate();
  }

  /** Flies to a place, down to `distance` (m) from it. */
  fly(place, distance) {
    if (!this.#tiles) return;
    const target = this.world.point({ height: this.height, ...place });
    const { camera } = this.stage;
    const elevation = Math.max(camera.elevation, 0.35);
    camera.go({ target, distance: Math.min(distance, camera.distance), elevation }, false, FLIGHT);
  }

  /** What is under a pixel of the window: `{tile, uri, hit, feature}` of a tile; null if there is none. */
  at(x, y) {
    const ray = this.stage.ray(x, y);
    let best = null;
    for (const [tile, own] of this.#tiles?.shown ?? []) {
      const hit = ray.intersectsBox(own.box) ? nearest(own.model, ray) : null;
      if (hit && !(best?.hit.distance <= hit.distance)) best = { tile: own, uri: tile.content.uri, hit };
    }
    return best && { ...best, feature: best.tile.feature(best.hit) };
  }

  /** Marks a feature of a tile. */
  mark(tile, feature) {
    this.stage.mark.show({ parts: tile.model.parts, group: this.#whole.group }, tile.ranges(feature));
    this.stage.invalidate();
  }

  /** The nearest tile whose mark is under a pixel: `{place, radius}`. */
  leafAt(x, y) {
    return this.marks.tileAt(x, y);
  }

  #middle({ leaves }) {
    const middle = leaves.reduce((sum, { foot }) => sum.add(foot), new Vector3()).divideScalar(leaves.length);
    return this.#nearest(middle, leaves, true);
  }

  /** The place at geocentric `point`, as high as the tile near it. */
  #nearest(point, leaves) {
    let [best, least] = [leaves[0], Infinity];
    for (const leaf of leaves) {
      const far = leaf.foot.distanceToSquared(point);
      if (far < least) [best, least] = [leaf, far];
    }
    const { longitude, latitude } = this.world.place === undefined ? best.place : this.world.placeOf(point.clone().applyMatrix4(this.world.toPage));
    return { longitude, latitude, height: best.place.height };
  }

  /** Puts the page around another place; the camera stays where it is on the earth. */
  #anchor(place) {
    const { camera } = this.stage;
    const before = this.world.place === undefined ? null : this.world.toEarth.clone();
    this.world.anchor(place);
    const tiles = this.#tiles ?? this.#next;
    this.#whole.box = around(tiles.leaves, this.world);
    this.#tiles?.replace();
    this.marks.place(this.world, tiles.leaves);
    this.stage.mark.clear();
    if (before) {
      const to = this.world.toPage.clone().multiply(before);
      camera.arrive();
      camera.target.applyMatrix4(to);
      const back = camera.back.clone().transformDirection(to);
      camera.azimuth = Math.atan2(back.x, -back.z);
      camera.elevation = Math.asin(Math.min(Math.max(back.y, -1), 1));
    }
    this.#region.makeEmpty();
    this.changed();
    this.stage.invalidate();
  }

  /** Shows the next tileset in the place of the present one. */
  #turn() {
    this.#tiles?.dispose();
    [this.#tiles, this.#next] = [this.#next, null];
    this.#whole.box = around(this.#tiles.leaves, this.world);
    this.marks.place(this.world, this.#tiles.leaves);
    this.stage.mark.clear();
    this.#stale = true;
    this.#region.makeEmpty();
    if (this.stage.model !== this.#whole) this.stage.swap(this.#whole, () => {});
  }

  #frame(camera) {
    const { size } = this.stage;
    const next = this.#next;
    if (next?.since) {
      next.follow(camera, size);
      if (next.settled || performance.now() - next.since > WAITS) this.#turn();
    }
    this.#tiles?.follow(camera, size);
    this.marks.frame();
    if (this.loading !== this.#waits) this.stage.wait((this.#waits = this.loading));
    if (!this.#stale || !this.#tiles) return;
    this.#stale = false;
    this.#whole.set([...this.#tiles.shown.values()]);
    this.marks.cover(new Set([...this.#tiles.shown.keys()].map((tile) => tile.content.uri)));
    this.stage.grown();
    this.#region.makeEmpty();
    this.changed();
  }

  /** Moves the anchor and the shadow when the camera rests. */
  #later() {
    clearTimeout(this.#rest);
    this.#rest = setTimeout(() => {
      const { camera } = this.stage;
      // The renderer tells in its next frame that all tiles have come.
      if (this.loading) this.stage.invalidate();
      if (!this.#tiles || camera.moving) return;
      const { x, z } = camera.target;
      if (Math.hypot(x, z) > Math.max(NEAR, camera.distance / 10)) {
        const point = camera.target.clone().applyMatrix4(this.world.toEarth);
        this.#anchor(this.#nearest(point, this.#tiles.leaves));
      }
      const wanted = this.#wanted();
      if (alike(this.#region, wanted)) return;
      this.#region.copy(wanted);
      this.stage.refit(wanted);
    }, RESTS);
  }

  /** The part of the tileset that the camera is about. */
  #wanted() {
    const { camera } = this.stage;
    const reach = Math.max(camera.distance * 1.6, 100);
    const near = new Box3().setFromCenterAndSize(camera.target, new Vector3(reach, reach, reach).multiplyScalar(2));
    const box = this.#whole.box.clone().intersect(near);
    if (box.isEmpty()) return near;
    // Far from the anchor the earth is lower, which moves no ground here.
    box.min.y = Math.min(0, box.max.y);
    return box;
  }
}

/** Whether two boxes are about the same. */
function alike(a, b) {
  if (a.isEmpty() || b.isEmpty()) return false;
  const size = b.getSize(new Vector3()).length();
  return a.min.distanceTo(b.min) + a.max.distanceTo(b.max) < size * 0.25;
}
