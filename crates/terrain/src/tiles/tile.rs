//! Tiles: cells of the world that are expanded to one level, with the heights of their smallest cells.

use glam::DVec2;
use rayon::prelude::*;

use crate::division::block::CellSymbol;
use crate::division::block::{Area, Block};
use crate::division::world::World;
use crate::edits::local_edits::LocalEdits;
use burgeon_base::MemoryOwner;

/// Position of a tile in the world.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct TilePlace {
    /// Level: number of divisions of the world.
    pub level: u32,
    /// Row from the north.
    pub y: i64,
    /// Column from the west.
    pub x: i64,
}

/// A cell of the world, expanded to its smallest cells.
#[derive(Debug, Clone)]
pub struct Tile {
    /// Position of the tile.
    pub place: TilePlace,
    /// Number of divisions of the tile.
    pub detail: u32,
    /// Hash of its edits; 0 without edits.
    pub(crate) mark: u64,
    /// Cells with known heights: the tile's own cells, and one more on each side within the world.
    area: Area,
    heights: Vec<f64>,
    symbols: Vec<CellSymbol>,
    /// Heights (m) of measured ground at the corners of its cells; empty if the ground is the surface of the
    /// cells.
    corners: Vec<f64>,
    /// Edits of measured ground, in order.
    changes: LocalEdits,
}

impl Tile {
    /// Returns the cells of a tile at `detail` levels below it.
    pub fn own_cells(place: TilePlace, detail: u32) -> Area {
        let across = 1usize << detail;
        Area { x: place.x << detail, y: place.y << detail, columns: across, rows: across }
    }

    /// Returns the cells whose heights a tile needs.
    pub fn wanted_cells(place: TilePlace, detail: u32) -> Area {
        Self::own_cells(place, detail).widen(1, World::across(place.level + detail))
    }

    /// Creates the tile at `place` from `cells`, which contain the `wanted` cells; `heights` (m) are the
    /// heights of the wanted cells' surface.
    pub fn new(place: TilePlace, detail: u32, cells: &Block, wanted: Area, heights: Vec<f64>) -> Self {
        let own = Self::own_cells(place, detail);
        let mut symbols = Vec::with_capacity(own.len());
        for y in (own.y..).take(own.rows) {
            let first = cells.area.index(own.x, y);
            symbols.extend_from_slice(&cells.symbols[first..first + own.columns]);
        }
        let (corners, changes) = (Vec::new(), LocalEdits::default());
        Self { place, detail, mark: 0, area: wanted, heights, symbols, corners, changes }
    }

    /// Adds the surface of the cells to the measured ground, and applies the edits.
    pub(crate) fn lay(&mut self, world: &World, changes: LocalEdits) {
        self.changes = changes;
        let own = Self::own_cells(self.place, self.detail);
        let (level, across) = (self.level(), own.columns + 1);
        let row = |row: i64| -> Vec<f64> {
            let y = own.y + row;
            let height = |x: i64| self.changed(world.corner_of(level, x, y), world, self.corner(x, y));
            (own.x..).take(across).map(height).collect()
        };
        let rows = i64::try_from(across).unwrap_or(0);
        let owner = MemoryOwner::current();
        self.corners =
            (0..rows).into_par_iter().map(|number| owner.charge(|| row(number))).collect::<Vec<_>>().concat();
    }

    /// Returns the height (m) of edited measured ground at `place` (m), where the surface of the cells has
    /// the height `laid` (m).
    pub(crate) fn changed(&self, place: DVec2, world: &World, laid: f64) -> f64 {
        let ground = world.ground(place, laid);
        self.changes.at(place, ground)
    }

    /// Returns the number of expanded heights.
    pub fn heights(&self) -> usize {
        1 << (2 * self.detail)
    }

    /// Returns the level of the smallest cells.
    pub fn level(&self) -> u32 {
        self.place.level + self.detail
    }

    /// Returns the memory of the tile (bytes).
    pub fn bytes(&self) -> usize {
        let heights = self.heights.len() + self.corners.len();
        size_of::<Self>() + heights * size_of::<f64>() + self.symbols.len() * size_of::<CellSymbol>()
    }

    /// Returns the height (m) of the surface at the centre of a cell of the tile's level; for unknown cells,
    /// the height of the nearest known cell.
    #[inline]
    pub fn cell(&self, x: i64, y: i64) -> f64 {
        self.heights[self.area.index(x, y)]
    }

    /// Returns the symbol of one of the tile's own cells.
    pub fn symbol(&self, x: i64, y: i64) -> CellSymbol {
        self.symbols[Self::own_cells(self.place, self.detail).index(x, y)]
    }

    /// Returns the height (m) of the surface at the north-west corner of a cell of the tile's level: the mean
    /// of the four adjacent cells.
    #[inline]
    pub fn corner(&self, x: i64, y: i64) -> f64 {
        let [north, south] = [y - 1, y].map(|y| self.cell(x - 1, y) + self.cell(x, y));
        (north + south) * 0.25
    }

    /// Returns the height (m) of the ground at a corner of the tile's own cells.
    #[inline]
    pub(crate) fn ground(&self, x: i64, y: i64) -> f64 {
        if self.corners.is_empty() {
            return self.corner(x, y);
        }
        let own = Self::own_cells(self.place, self.detail);
        let part = |at: i64, first: i64| usize::try_from(at - first).unwrap_or(0);
        self.corners[part(y, own.y) * (own.columns + 1) + part(x, own.x)]
    }

    /// Converts a corner of the cells of `level` to the grid of the tile's level; `None` if that grid has no
    /// corner there.
    #[inline]
    pub fn on_grid(&self, level: u32, x: i64, y: i64) -> Option<(i64, i64)> {
        let own = self.level();
        if own >= level {
            return Some((x << (own - level), y << (own - level)));
        }
        let step = (1i64 << (level - own)) - 1;
        ((x | y) & step == 0).then(|| (x >> (level - own), y >> (level - own)))
    }

    /// Returns the south-west corner (m) and the side length (m).
    #[allow(clippy::cast_precision_loss, reason = "columns and rows are below 2^53")]
    pub fn bounds(&self, world: &World) -> (DVec2, f64) {
        let size = world.cell(self.place.level);
        let north = world.corner.y + world.size;
        let x = world.corner.x + self.place.x as f64 * size;
        (DVec2::new(x, north - (self.place.y + 1) as f64 * size), size)
    }
}
