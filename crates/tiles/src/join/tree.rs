//! Tree of the tiles of a tileset.

use burgeon_base::error::Result;
use glam::{DAffine3, DVec3};

use crate::earth::{EarthMap, east_north_up};
use crate::make::{TileFile, bounding_box};
use crate::plan::{PlannedTile, TileGrid, TileId};

/// Tile of a tileset.
#[derive(Debug, Clone, PartialEq)]
pub struct TilesetTile {
    /// Place in the quadtree.
    pub id: TileId,
    /// Transform from the local axes to geocentric coordinates (m).
    pub transform: DAffine3,
    /// Bounding box (m) in the local axes.
    pub bounds: [f64; 12],
    /// Geometric error (m): 0 with content, otherwise the size of what is missing while the children are not shown.
    pub error: f64,
    /// True if the tile has content.
    pub has_content: bool,
    /// Tiles inside, in the order of the curve.
    pub children: Vec<TilesetTile>,
}

/// Part of the diagonal of a tile without content that counts as its geometric error.
///
/// There is no coarser model to be compared with the children, so the error is the larger of their height and this part:
/// a viewer with 16 pixels of allowed error then loads the children at about twice the diagonal.
const PART: f64 = 1.0 / 32.0;

impl TilesetTile {
    /// Returns the number of tiles with content.
    pub fn contents(&self) -> usize {
        usize::from(self.has_content) + self.children.iter().map(Self::contents).sum::<usize>()
    }

    fn leaf(tile: &PlannedTile, file: &TileFile, geoid: f64) -> Self {
        Self {
            id: tile.id,
            transform: east_north_up(file.degrees, geoid),
            bounds: file.bounds,
            error: 0.0,
            has_content: true,
            children: Vec::new(),
        }
    }
}

/// Returns the corners of a bounding box.
pub(crate) fn corners(bounds: &[f64; 12]) -> [DVec3; 8] {
    let at = |index: usize| DVec3::new(bounds[index], bounds[index + 1], bounds[index + 2]);
    std::array::from_fn(|corner| {
        let sign = |axis: usize| if corner >> axis & 1 == 0 { -1.0 } else { 1.0 };
        at(0) + at(3) * sign(0) + at(6) * sign(1) + at(9) * sign(2)
    })
}

/// Returns the tree of the tiles with content, which are in the order of the curve; `None` without tiles.
///
/// The root is the smallest tile of the quadtree that contains all. Tiles with one child are left out.
pub fn join_tree(
    tiles: &[(&PlannedTile, &TileFile)],
    map: &EarthMap<'_>,
    geoid: f64,
) -> Result<Option<TilesetTile>> {
    let [(first, _), .., (last, _)] = tiles else {
        return Ok(tiles.first().map(|(tile, file)| TilesetTile::leaf(tile, file, geoid)));
    };
    let mut level = first.id.level.min(last.id.level);
    while first.id.ancestor(level) != last.id.ancestor(level) {
        level -= 1;
    }
    let id = first.id.ancestor(level);
    let (mut rest, mut children) = (tiles, Vec::new());
    for quarter in 0..4 {
        let child = TileId { level: level + 1, x: id.x * 2 + (quarter & 1), y: id.y * 2 + (quarter >> 1) };
        let end = rest.partition_point(|(tile, _)| tile.id.ancestor(child.level).curve() <= child.curve());
        let (own, later) = rest.split_at(end);
        children.extend(join_tree(own, map, geoid)?);
        rest = later;
    }
    let [west, south, east, north] = TileGrid::bounds(id);
    // The middle of a large tile may be far from its content, and outside the projection.
    let regions = tiles.iter().map(|(tile, _)| tile.region);
    let [low_x, low_y, high_x, high_y] = regions
        .reduce(|a, b| [a[0].min(b[0]), a[1].min(b[1]), a[2].max(b[2]), a[3].max(b[3])])
        .unwrap_or([west, south, east, north]);
    let axes = map.axes([low_x.midpoint(high_x), low_y.midpoint(high_y)])?;
    let (mut low, mut high) = (DVec3::INFINITY, DVec3::NEG_INFINITY);
    let (mut error, mut height): (f64, f64) = (0.0, 0.0);
    for child in &children {
        for corner in corners(&child.bounds) {
            let point = axes.enter(child.transform.transform_point3(corner));
            (low, high) = (low.min(point), high.max(point));
        }
        error = error.max(child.error);
        height = height.max(2.0 * child.bounds[11]);
    }
    // Corners are rounded when they are transformed.
    let margin = (high - low).max_element() * 1e-9 + 1e-3;
    (low, high) = (low - margin, high + margin);
    error = error.max(height).max((high - low).length() * PART);
    Ok(Some(TilesetTile {
        id,
        transform: axes.transform,
        bounds: bounding_box(low, high),
        error,
        has_content: false,
        children,
    }))
}
