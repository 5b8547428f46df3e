/*!
 * @license
 * 3d-tiles-renderer, Copyright 2020 California Institute of Technology. All rights reserved. United States Government
 * Sponsorship Acknowledged. SPDX-License-Identifier: Apache-2.0 (see LICENSE-APACHE)
 */
// The renderer of 3D Tiles: chooses the tiles that the camera needs, loads them, and unloads those that nobody sees.

import { TilesRenderer } from '3d-tiles-renderer/three';
import { Box3, Group, Matrix4, Vector3 } from 'three';
import { readTile } from './tile.js';
import { placeOf } from './world.js';

const PIXELS = 8; // of error above which children are shown: tiles that have some show nothing themselves
const PLAIN = 10; // the same without a graphics card
const FEW = 64; // tiles of which all are shown from afar

export class Tiles extends TilesRenderer {
  /** Boxes of the tiles with content that the first file names: `{uri, transform, box}`, in the tile's axes. */
  leaves = [];
  /** Tiles that are shown, by the renderer's own. */
  shown = new Map();
  failed = 0;
  #camera = null;

  /** `changed` is called when other tiles are shown, `again` when another frame is needed. */
  constructor(url, { world, materials, slow, changed, again }) {
    super(url);
    Object.assign(this, { world, materials, changed });
    this.errorTarget = slow ? PLAIN : PIXELS;
    this.group.matrixAutoUpdate = false;
    this.addEventListener('needs-update', again);
    this.addEventListener('load-error', () => ((this.failed += 1), again()));
    this.loaded = new Promise((resolve, reject) => {
      this.addEventListener('load-root-tileset', () => {
        this.leaves = leaves(this.rootTileset.root);
        if (this.leaves.length <= FEW) this.errorTarget = 1;
        resolve(this);
      });
      this.addEventListener('load-error', ({ tile, error }) => tile || reject(error));
    });
  }

  /** Chooses tiles for `camera`, in a picture of `size` pixels. */
  follow(camera, [width, height]) {
    if (this.#camera !== camera) {
      if (this.#camera) this.deleteCamera(this.#camera);
      this.setCamera((this.#camera = camera));
    }
    this.setResolution(camera, width, height);
    this.group.matrix.copy(this.world.toPage);
    this.group.updateMatrixWorld(true);
    this.update();
  }

  /** Whether all tiles for the present view are there. */
  get settled() {
    return this.rootTileset !== null && !this.isLoading && this.frameCount > 1;
  }

  /** Loads tiles again that could not be loaded. */
  retry() {
    this.failed = 0;
    this.resetFailedTiles();
  }

  /** Puts the shown tiles where the world is now. */
  replace() {
    for (const [tile, own] of this.shown) own.place(this.world, tile.engineData.transform);
  }

  async parseTile(buffer, tile, extension, url, signal) {
    const own = await readTile(buffer, this.materials);
    if (signal.aborted) return own.dispose();
    const { engineData } = tile;
    Object.assign(engineData, { own, scene: new Group(), materials: [], geometry: [], textures: [], metadata: null });
  }

  calculateBytesUsed(tile) {
    return tile.engineData.own?.bytes ?? 0;
  }

  setTileVisible(tile, visible) {
    super.setTileVisible(tile, visible);
    const { own, transform } = tile.engineData;
    if (!own) return;
    if (visible) {
      own.place(this.world, transform);
      this.shown.set(tile, own);
    } else this.shown.delete(tile);
    this.changed();
  }

  disposeTile(tile) {
    super.disposeTile(tile);
    tile.engineData.own?.dispose();
    tile.engineData.own = null;
  }
}

const TERRAIN = 'terrain.json';

/** The tiles with content under `root`, without the terrain, which reaches far beyond the features. */
function leaves(root) {
  const found = [];
  const visit = (tile, parent) => {
    const own = tile.transform ? parent.clone().multiply(new Matrix4().fromArray(tile.transform)) : parent;
    const { box } = tile.boundingVolume;
    if (tile.content && box && tile.content.uri !== TERRAIN) found.push({ uri: tile.content.uri, transform: own, box, ...measures(own, box) });
    for (const child of tile.children ?? []) visit(child, own);
  };
  visit(root, new Matrix4());
  // A set without content is a place that can be looked at.
  const { box } = root.boundingVolume;
  if (found.length === 0 && box) {
    const own = new Matrix4().fromArray(root.transform ?? new Matrix4().toArray());
    found.push({ uri: null, transform: own, box, ...measures(own, box) });
  }
  return found;
}

/** The middle of the lower side of a box, in geocentric coordinates and as a place, and half the diagonal (m) of the box. */
function measures(transform, box) {
  const at = (i) => new Vector3().fromArray(box, i);
  const foot = at(0).sub(at(9)).applyMatrix4(transform);
  return { foot, place: placeOf(foot), radius: Math.hypot(at(3).length(), at(6).length()) };
}

/** The box in the page around `leaves`. */
export function around(leaves, world) {
  const all = new Box3();
  const corner = new Vector3();
  for (const { transform, box } of leaves) {
    const to = new Matrix4().multiplyMatrices(world.toPage, transform);
    for (let i = 0; i < 8; i++) {
      corner.fromArray(box, 0);
      [1, 2, 3].forEach((axis, k) => {
        const sign = (i >> k) & 1 ? 1 : -1;
        corner.add(new Vector3().fromArray(box, axis * 3).multiplyScalar(sign));
      });
      all.expandByPoint(corner.applyMatrix4(to));
    }
  }
  return all;
}
