//! Views of a world from a point: the cells that become tiles, and the detail of each tile.

use glam::DVec2;

use super::tile::TilePlace;
use crate::division::block::Area;
use crate::division::world::{DEEPEST, World};
use burgeon_base::error::{Error, Limit, Result};
use burgeon_base::text::number;

/// Maximum number of heights that are expanded at once.
pub const MOST_HEIGHTS: u64 = 1 << 26;

/// A square of tiles around the eye.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct TileRing {
    /// Number of tiles per side, including those of smaller rings.
    pub across: u32,
    /// Number of divisions of each tile.
    pub levels: u32,
}

/// Tiles of one size around an eye; the nearest tiles are divided most often.
#[derive(Debug, Clone, PartialEq)]
pub struct View {
    /// Side length (m) of the tiles.
    pub cell: f64,
    /// Rings, from the smallest to the largest.
    pub rings: Vec<TileRing>,
}

/// The cells of a world that are the tiles of a view.
pub(crate) struct ViewCells {
    pub level: u32,
    pub window: Area,
    /// Number of divisions of each cell of the window.
    pub details: Vec<u32>,
}

impl View {
    /// Returns a view of the whole world as one tile that is divided `levels` times.
    pub fn whole(world: &World, levels: u32) -> Self {
        Self { cell: world.size, rings: vec![TileRing { across: 1, levels }] }
    }

    /// Fails if the view of `world` from `eye` (m) is invalid: outside the world, or with too many heights.
    ///
    /// ```
    /// use burgeon_terrain::{TileRing, View, World};
    /// use glam::DVec2;
    ///
    /// let (corner, layers, remap) = (DVec2::ZERO, vec![], vec![]);
    /// let world = World { corner, size: 1024.0, layers, smooth: true, key: None, remap, measured: None };
    /// let view = View { cell: 128.0, rings: vec![TileRing { across: 3, levels: 4 }] };
    /// assert!(view.check(&world, DVec2::splat(500.0)).is_ok());
    /// assert!(view.check(&world, DVec2::splat(-1.0)).is_err(), "outside the world");
    /// ```
    pub fn check(&self, world: &World, eye: DVec2) -> Result<()> {
        self.fit(world, eye).map(|_| ())
    }

    /// Returns the cells that are tiles for an eye at `eye` (m). At the boundary of the world there are
    /// fewer.
    #[allow(clippy::cast_precision_loss, clippy::cast_possible_truncation, reason = "columns are below 2^40")]
    pub(crate) fn fit(&self, world: &World, eye: DVec2) -> Result<ViewCells> {
        let to = eye - world.corner;
        if !(0.0..=world.size).contains(&to.x) || !(0.0..=world.size).contains(&to.y) {
            let (low, high) = (world.corner, world.corner + world.size);
            return Err(Error::argument(format!(
                "the focus ({}, {}) is outside the terrain",
                number(eye.x),
                number(eye.y)
            ))
            .help(format!("it extends from ({}, {}) to ({}, {}) m", low.x, low.y, high.x, high.y)));
        }
        let level = self.level(world)?;
        let across = World::across(level);
        let cell = world.cell(level);
        let along = DVec2::new(to.x, world.size - to.y) / cell;
        let ring = |ring: &TileRing| {
            let begin = |at: f64| (at - f64::from(ring.across) / 2.0 + 0.5).floor() as i64;
            let span = |at: f64| {
                let begin = begin(at);
                let end = (begin + i64::from(ring.across)).min(across);
                (begin.max(0), end)
            };
            let ((x, east), (y, south)) = (span(along.x), span(along.y));
            let count = |count: i64| usize::try_from(count).unwrap_or(0);
            Area { x, y, columns: count(east - x), rows: count(south - y) }
        };
        let areas: Vec<(Area, u32)> = self.rings.iter().map(|it| (ring(it), it.levels)).collect();
        let window = areas.last().map_or(Area { x: 0, y: 0, columns: 0, rows: 0 }, |(area, _)| *area);
        let details: Vec<u32> = window
            .cells()
            .map(|(x, y)| areas.iter().find(|(area, _)| area.contains(x, y)).map_or(0, |(_, levels)| *levels))
            .collect();
        let heights: u64 = details.iter().map(|detail| 1u64 << (2 * detail.min(&31))).sum();
        if heights > MOST_HEIGHTS {
            return Err(too_many(heights));
        }
        Ok(ViewCells { level, window, details })
    }

    /// Returns the side length (m) of the smallest cells of the view in `world`.
    pub fn smallest(&self, world: &World) -> Result<f64> {
        let deepest = self.rings.iter().map(|ring| ring.levels).max().unwrap_or(0);
        Ok(world.cell(self.level(world)? + deepest))
    }

    /// Returns the level of the tiles.
    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "the range is checked")]
    fn level(&self, world: &World) -> Result<u32> {
        let level = (world.size / self.cell).log2();
        let whole = level.round();
        if !(0.0..=30.0).contains(&whole) || (level - whole).abs() > 1e-6 {
            let near = world.size / whole.clamp(0.0, 30.0).exp2();
            return Err(Error::argument(format!(
                "view: cells of {} m do not divide a world of {} m",
                self.cell, world.size
            ))
            .help(format!("use the world's size divided by a power of two; the nearest is {near} m")));
        }
        let deepest = self.rings.iter().map(|ring| ring.levels).max().unwrap_or(0);
        if whole as u32 + deepest > DEEPEST {
            return Err(Error::limit(
                Limit::Size,
                format!("view: cells are divided {} times in all", whole as u32 + deepest),
            )
            .help(format!("the maximum is {DEEPEST}")));
        }
        Ok(whole as u32)
    }
}

/// Creates the error for too many heights.
pub(crate) fn too_many(heights: u64) -> Error {
    #[allow(clippy::cast_precision_loss, reason = "a size for people")]
    let bytes = heights as f64 * 8.0;
    let units = [("PB", 1e15), ("TB", 1e12), ("GB", 1e9), ("MB", 1e6)];
    let (unit, size) = units.into_iter().find(|(_, size)| bytes >= *size).unwrap_or(("bytes", 1.0));
    Error::limit(Limit::Size, format!("terrain: {heights} heights need {:.1} {unit}", bytes / size))
        .help(format!("the maximum is {MOST_HEIGHTS} heights: use fewer levels, or focus on a part"))
}

impl ViewCells {
    /// Returns the position of the tile with this index in the window.
    pub(crate) fn place(&self, index: usize) -> TilePlace {
        let (x, y) = self.window.at(index);
        TilePlace { level: self.level, y, x }
    }
}
