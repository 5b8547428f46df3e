//! A tile: a cell of the world that is expanded to one level, with the heights of its smallest cells.

use glam::DVec2;
use rayon::prelude::*;

use super::block::{Area, Block};
use super::local_edits::LocalEdits;
use super::world::World;
use burgeon_base::MemoryOwner;
use burgeon_rewriting::Symbol;

/// Which cell of the world a tile is.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct TilePlace {
    /// How often the world is divided.
    pub level: u32,
    /// Its row from the north.
    pub y: i64,
    /// Its column from the west.
    pub x: i64,
}

/// A cell of the world and the smallest cells that it is expanded to.
#[derive(Debug, Clone)]
pub struct Tile {
    /// Which cell it is.
    pub place: TilePlace,
    /// How often it is divided.
    pub detail: u32,
    /// A number for the edits that it has; 0 without any.
    pub(super) mark: u64,
    /// The cells whose heights are known: its own, and one more on each side within the world.
    area: Area,
    heights: Vec<f64>,
    symbols: Vec<Symbol>,
    /// The heights (m) of the ground at the corners of its cells, where it was measured; empty where it is the surface
    /// of the cells.
    corners: Vec<f64>,
    /// What has been changed of measured ground, in order.
    changes: LocalEdits,
}

impl Tile {
    /// Its own cells at `detail` levels below it.
    pub fn own(place: TilePlace, detail: u32) -> Area {
        let across = 1usize << detail;
        Area { x: place.x << detail, y: place.y << detail, columns: across, rows: across }
    }

    /// The cells that a tile has to know.
    pub fn wanted(place: TilePlace, detail: u32) -> Area {
        Self::own(place, detail).widened(1, World::across(place.level + detail))
    }

    /// The tile at `place` out of `cells`, which are those that it has to know; `heights` (m) are those of the surface
    /// of the cells.
    pub fn new(place: TilePlace, detail: u32, cells: &Block, wanted: Area, heights: Vec<f64>) -> Self {
        let own = Self::own(place, detail);
        let mut symbols = Vec::with_capacity(own.len());
        for y in (own.y..).take(own.rows) {
            let first = cells.area.index(own.x, y);
            symbols.extend_from_slice(&cells.symbols[first..first + own.columns]);
        }
        let (corners, changes) = (Vec::new(), LocalEdits::default());
        Self { place, detail, mark: 0, area: wanted, heights, symbols, corners, changes }
    }

    /// Lays its cells over what was measured, and changes what comes out.
    pub(super) fn lay(&mut self, world: &World, changes: LocalEdits) {
        self.changes = changes;
        let own = Self::own(self.place, self.detail);
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

    /// The height (m) of measured ground at `place` (m), where the surface of the cells is `laid` (m) high.
    pub(super) fn changed(&self, place: DVec2, world: &World, laid: f64) -> f64 {
        let ground = world.ground(place, laid);
        self.changes.at(place, ground)
    }

    /// The number of heights that it was expanded for.
    pub fn heights(&self) -> usize {
        1 << (2 * self.detail)
    }

    /// The level of its smallest cells.
    pub fn level(&self) -> u32 {
        self.place.level + self.detail
    }

    /// The bytes that it takes.
    pub fn bytes(&self) -> usize {
        let heights = self.heights.len() + self.corners.len();
        size_of::<Self>() + heights * size_of::<f64>() + self.symbols.len() * size_of::<Symbol>()
    }

    /// The height (m) of the surface of the cells at the middle of one of its level; of the nearest one it knows, for
    /// others.
    #[inline]
    pub fn cell(&self, x: i64, y: i64) -> f64 {
        self.heights[self.area.index(x, y)]
    }

    /// The symbol of a cell of its own.
    pub fn symbol(&self, x: i64, y: i64) -> Symbol {
        self.symbols[Self::own(self.place, self.detail).index(x, y)]
    }

    /// The height (m) of the surface of the cells at the north-west corner of one of its level: the mean of the four
    /// cells around it.
    #[inline]
    pub fn corner(&self, x: i64, y: i64) -> f64 {
        let [north, south] = [y - 1, y].map(|y| self.cell(x - 1, y) + self.cell(x, y));
        (north + south) * 0.25
    }

    /// The height (m) of the ground at a corner of its own cells.
    #[inline]
    pub(super) fn ground(&self, x: i64, y: i64) -> f64 {
        if self.corners.is_empty() {
            return self.corner(x, y);
        }
        let own = Self::own(self.place, self.detail);
        let part = |at: i64, first: i64| usize::try_from(at - first).unwrap_or(0);
        self.corners[part(y, own.y) * (own.columns + 1) + part(x, own.x)]
    }

    /// Whether the grid of its level has a corner of cells at a corner of the cells of `level`, and which.
    #[inline]
    pub fn on_grid(&self, level: u32, x: i64, y: i64) -> Option<(i64, i64)> {
        let own = self.level();
        if own >= level {
            return Some((x << (own - level), y << (own - level)));
        }
        let step = (1i64 << (level - own)) - 1;
        ((x | y) & step == 0).then(|| (x >> (level - own), y >> (level - own)))
    }

    /// Where it lies: its south-west corner (m) and the length (m) of its sides.
    #[allow(clippy::cast_precision_loss, reason = "columns and rows are below 2^53")]
    pub fn bounds(&self, world: &World) -> (DVec2, f64) {
        let size = world.cell(self.place.level);
        let north = world.corner.y + world.size;
        let x = world.corner.x + self.place.x as f64 * size;
        (DVec2::new(x, north - (self.place.y + 1) as f64 * size), size)
    }
}
