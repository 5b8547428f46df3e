//! Implicit tiling of the tiles inside a largest tile of a plan.

use std::collections::BTreeMap;

use burgeon_base::error::Result;
use glam::DVec3;

use super::subtree::ImplicitTile;
use super::tree::{TilesetTile, corners};
use crate::earth::{EarthMap, TileAxes};
use crate::plan::{TileGrid, TileId};

/// Largest number of levels of a subtree: with more, its bits would be larger than the metadata of its tiles.
pub(super) const SUBTREE_LEVELS: u32 = 8;

/// Tile with implicit tiling.
pub(super) struct ImplicitRoot {
    /// Place in the quadtree.
    pub(super) id: TileId,
    /// Axes, which all contents have.
    pub(super) axes: TileAxes,
    /// Bounding box (m) whose quarters are those of the quadtree, as far as the projection allows it.
    pub(super) bounds: [f64; 12],
    /// Geometric error (m).
    pub(super) error: f64,
    /// Number of levels.
    pub(super) levels: u32,
    /// Tiles, counted from the root.
    pub(super) tiles: BTreeMap<TileId, ImplicitTile>,
}

impl ImplicitRoot {
    /// Returns the root whose tiles are `tile` and those inside, and tiles without content that lead to them. `above` is the
    /// geometric error (m) of the tile above.
    pub(super) fn new(tile: &TilesetTile, above: f64, map: &EarthMap<'_>) -> Result<Self> {
        let id = tile.id.anchor();
        let mut tiles = BTreeMap::new();
        add(id, tile, above, &mut tiles);
        let levels = tiles.keys().map(|tile| tile.level).max().unwrap_or(0) + 1;
        let error = tiles.get(&TileId::ROOT).map_or(above, |tile| tile.error);
        let (axes, bounds) = root_box(tile, map)?;
        Ok(Self { id, axes, bounds, error, levels, tiles })
    }
}

/// Returns the axes of the largest tile of a plan that contains `tile`, and a box in them whose quarters are those of the
/// quadtree, as far as the projection allows it. The box contains `tile`.
pub(super) fn root_box(tile: &TilesetTile, map: &EarthMap<'_>) -> Result<(TileAxes, [f64; 12])> {
    let id = tile.id.anchor();
    let [west, south, east, north] = TileGrid::bounds(id);
    let middle = [west.midpoint(east), south.midpoint(north)];
    let axes = map.axes(middle)?;
    let slope = map.around(&axes, DVec3::new(middle[0], middle[1], 0.0))?.slope;
    let x_axis = slope.x_axis.with_z(0.0).normalize();
    let along = [x_axis, DVec3::Z.cross(x_axis), DVec3::Z];
    let half = TileGrid::side(id.level) / 2.0;
    let mut most = [half * slope.x_axis.length(), half * slope.y_axis.length()];
    let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
    for corner in corners(&tile.bounds) {
        for (most, axis) in most.iter_mut().zip(along) {
            *most = most.max(corner.dot(axis).abs() + 1e-3);
        }
        (low, high) = (low.min(corner.z - 1e-3), high.max(corner.z + 1e-3));
    }
    let [x, y, z] = [along[0] * most[0], along[1] * most[1], along[2] * (high - low) / 2.0];
    let mut bounds = [0.0; 12];
    for (values, part) in bounds.chunks_mut(3).zip([DVec3::Z * low.midpoint(high), x, y, z]) {
        values.copy_from_slice(&part.to_array());
    }
    Ok((axes, bounds))
}

/// Adds `tile` and the tiles inside, and those between it and the tile above, whose geometric error (m) is `above`.
fn add(root: TileId, tile: &TilesetTile, above: f64, tiles: &mut BTreeMap<TileId, ImplicitTile>) {
    let own = ImplicitTile { bounds: tile.bounds, error: tile.error, has_content: tile.has_content };
    let id = tile.id.within(root);
    tiles.insert(id, own);
    // A tile with one child and no content is refined when the tile above is.
    let mut between = id.parent();
    while let Some(id) = between.filter(|id| !tiles.contains_key(id)) {
        tiles.insert(id, ImplicitTile { error: above, has_content: false, ..own });
        between = id.parent();
    }
    tile.children.iter().for_each(|child| add(root, child, tile.error, tiles));
}
