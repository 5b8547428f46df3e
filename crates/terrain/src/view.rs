//! What is seen of a world from a place: which cells are tiles, and how far each is expanded.

use glam::DVec2;

use super::block::Area;
use super::tile::TilePlace;
use super::world::World;
use burgeon_base::error::{Error, Limit, Result};
use burgeon_base::text::number;

/// The most heights that may be expanded at once.
pub const MOST_HEIGHTS: u64 = 1 << 26;

/// A square of tiles around the eye.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct TileRing {
    /// How many tiles it has along a side, those of smaller rings among them.
    pub across: u32,
    /// How often each of its tiles is divided.
    pub levels: u32,
}

/// Tiles of one size around an eye: the nearest of them are divided most.
#[derive(Debug, Clone, PartialEq)]
pub struct View {
    /// The length (m) of the sides of tiles.
    pub cell: f64,
    /// From the smallest ring to the largest.
    pub rings: Vec<TileRing>,
}

/// The cells of a world that a view makes tiles.
pub(super) struct ViewCells {
    pub level: u32,
    pub window: Area,
    /// By cell of the window: how often it is divided.
    pub details: Vec<u32>,
}

impl View {
    /// All of a world as one tile that is divided `levels` times.
    pub fn whole(world: &World, levels: u32) -> Self {
        Self { cell: world.size, rings: vec![TileRing { across: 1, levels }] }
    }

    /// Fails if it cannot be seen of `world` from `eye` (m): outside, or where it would be too much.
    pub fn check(&self, world: &World, eye: DVec2) -> Result<()> {
        self.fit(world, eye).map(|_| ())
    }

    /// The cells that are tiles when seen from `eye` (m). At the rim of the world there are fewer.
    #[allow(clippy::cast_precision_loss, clippy::cast_possible_truncation, reason = "columns are below 2^40")]
    pub(super) fn fit(&self, world: &World, eye: DVec2) -> Result<ViewCells> {
        let to = eye - world.corner;
        if !(0.0..=world.size).contains(&to.x) || !(0.0..=world.size).contains(&to.y) {
            let (low, high) = (world.corner, world.corner + world.size);
            return Err(Error::argument(format!(
                "the focus ({}, {}) is outside the terrain",
                number(eye.x),
                number(eye.y)
            ))
            .help(format!("it reaches from ({}, {}) to ({}, {}) m", low.x, low.y, high.x, high.y)));
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

    /// The length (m) of the sides of the smallest cells that it shows of `world`.
    pub fn smallest(&self, world: &World) -> Result<f64> {
        let deepest = self.rings.iter().map(|ring| ring.levels).max().unwrap_or(0);
        Ok(world.cell(self.level(world)? + deepest))
    }

    /// The level of its tiles.
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
            .help(format!("halve its size again and again; the nearest such size is {near} m")));
        }
        let deepest = self.rings.iter().map(|ring| ring.levels).max().unwrap_or(0);
        if whole as u32 + deepest > DEEPEST {
            return Err(Error::limit(
                Limit::Size,
                format!("view: cells are divided {} times in all", whole as u32 + deepest),
            )
            .help(format!("divide them at most {DEEPEST} times")));
        }
        Ok(whole as u32)
    }
}

/// How often a world may be divided: its finest columns and rows are numbered in 31 bits.
pub const DEEPEST: u32 = 30;

/// The error for more heights than there may be.
pub(super) fn too_many(heights: u64) -> Error {
    #[allow(clippy::cast_precision_loss, reason = "a size for people")]
    let bytes = heights as f64 * 8.0;
    let units = [("PB", 1e15), ("TB", 1e12), ("GB", 1e9), ("MB", 1e6)];
    let (unit, size) = units.into_iter().find(|(_, size)| bytes >= *size).unwrap_or(("bytes", 1.0));
    Error::limit(
        Limit::Size,
        format!("terrain: that would be {heights} heights, which take {:.1} {unit}", bytes / size),
    )
    .help(format!("at most {MOST_HEIGHTS} are expanded at once: use fewer levels, or focus on a part"))
}

impl ViewCells {
    /// Which tile the cell with this number in the window is.
    pub(super) fn place(&self, index: usize) -> TilePlace {
        let (x, y) = self.window.at(index);
        TilePlace { level: self.level, y, x }
    }
}
