//! A tile: a cell of the world that is expanded to one level, with the heights of its smallest cells.

use glam::DVec2;

use super::block::{Area, Block};
use super::world::World;
use crate::rules::Symbol;

/// Which cell of the world a tile is.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Place {
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
    pub place: Place,
    /// How often it is divided.
    pub detail: u32,
    /// A number for the edits that it has; 0 without any.
    pub(super) mark: u64,
    /// The cells whose heights are known: its own, and one more on each side within the world.
    area: Area,
    heights: Vec<f64>,
    symbols: Vec<Symbol>,
}

impl Tile {
    /// Its own cells at `detail` levels below it.
    pub fn own(place: Place, detail: u32) -> Area {
        let across = 1usize << detail;
        Area { x: place.x << detail, y: place.y << detail, columns: across, rows: across }
    }

    /// The cells that a tile has to know.
    pub fn wanted(place: Place, detail: u32) -> Area {
        Self::own(place, detail).widened(1, World::across(place.level + detail))
    }

    /// The tile at `place` out of `cells`, which are those that it has to know; `heights` (m) are those of the surface.
    pub fn new(place: Place, detail: u32, cells: &Block, wanted: Area, heights: Vec<f64>) -> Self {
        let own = Self::own(place, detail);
        let mut symbols = Vec::with_capacity(own.len());
        for y in (own.y..).take(own.rows) {
            let first = cells.area.index(own.x, y);
            symbols.extend_from_slice(&cells.symbols[first..first + own.columns]);
        }
        Self { place, detail, mark: 0, area: wanted, heights, symbols }
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
        size_of::<Self>() + self.heights.len() * size_of::<f64>() + self.symbols.len() * size_of::<Symbol>()
    }

    /// The height (m) of the surface at the middle of a cell of its level; of the nearest one it knows, for others.
    #[inline]
    pub fn cell(&self, x: i64, y: i64) -> f64 {
        self.heights[self.area.index(x, y)]
    }

    /// The symbol of a cell of its own.
    pub fn symbol(&self, x: i64, y: i64) -> Symbol {
        self.symbols[Self::own(self.place, self.detail).index(x, y)]
    }

    /// The height (m) at the north-west corner of a cell of its level: the mean of the four cells around it.
    #[inline]
    pub fn corner(&self, x: i64, y: i64) -> f64 {
        let [north, south] = [y - 1, y].map(|y| self.cell(x - 1, y) + self.cell(x, y));
        (north + south) * 0.25
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
