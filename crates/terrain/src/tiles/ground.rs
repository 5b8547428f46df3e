//! The expanded part of a world: tiles around a point, and the surface over them.
//!
//! The surface passes through the corners of cells, whose heights are the means of the adjacent cells, and is
//! flat over the two halves of each cell. Measured ground is exact at its samples for cells of any size, and
//! the rules add detail between them. Where tiles of different detail meet, the finer tile follows the
//! coarser one, so there is no gap. Corners are numbered in the grid of the smallest cells of any tile, from
//! the north-west.

use std::sync::Arc;

use glam::{DVec2, DVec3};
use rayon::prelude::*;

use super::tile::{Tile, TilePlace};
use super::view::{MOST_HEIGHTS, View, ViewCells, too_many};
use crate::division::block::{Area, Block};
use crate::division::world::{Divide, Tables, World};
use crate::edits::store::Edits;
use burgeon_base::MemoryOwner;
use burgeon_base::error::Result;

/// A world and its expanded tiles.
///
/// ```
/// use std::sync::Arc;
///
/// use burgeon_terrain::{Edit, Edits, Ground, LevelRules, DivisionRules, Tables, View, World};
/// use glam::DVec2;
///
/// // A plain 12 m high, which nothing divides, and a place on it that is level at 15 m.
/// let plain =
///     LevelRules { from: 0, rules: DivisionRules::None, start: 0, height: 12.0, rest: vec![], names: Arc::default() };
/// let world = World {
///     corner: DVec2::ZERO,
///     size: 1024.0,
///     layers: vec![plain],
///     smooth: false,
///     key: None,
///     remap: vec![],
///     measured: None,
/// };
/// let mut edits = Edits::default();
/// let outline = vec![[500.0, 500.0], [600.0, 500.0], [600.0, 600.0], [500.0, 600.0]];
/// edits.add(&world, Edit::Flatten { outline, height: 15.0, margin: 40.0 })?;
///
/// let view = View::whole(&world, 7);
/// let mut ground = Ground::new(Arc::new(world));
/// ground.edit(&Arc::new(edits));
/// assert_eq!(ground.height(DVec2::splat(550.0)), None);
/// ground.focus(DVec2::splat(512.0), &view, &Tables)?;
/// let [inside, beside, far] = [550.0, 620.0, 700.0].map(|at| ground.height(DVec2::new(at, 550.0)));
/// assert_eq!((inside, far), (Some(15.0), Some(12.0)));
/// assert!(beside.is_some_and(|height| height > 12.0 && height < 15.0));
/// # Ok::<(), burgeon_base::error::Error>(())
/// ```
#[derive(Clone)]
pub struct Ground {
    world: Arc<World>,
    edits: Arc<Edits>,
    /// Level of the tiles.
    level: u32,
    /// Cells of that level that are tiles.
    window: Area,
    /// Tile of each cell of the window.
    tiles: Vec<Arc<Tile>>,
    /// Level of the smallest cells of any tile.
    finest: u32,
}

/// Heights at the centres of cells of one size.
#[derive(Debug, Clone, PartialEq)]
pub struct GroundMap {
    /// Number of cells from west to east.
    pub columns: usize,
    /// Number of cells from north to south.
    pub rows: usize,
    /// South-west corner (m) of all cells.
    pub corner: DVec2,
    /// Side length (m) of a cell.
    pub step: f64,
    /// Heights (m), row by row from the north.
    pub heights: Vec<f64>,
}

impl Ground {
    /// Creates the ground of a world, without expanded tiles.
    pub fn new(world: Arc<World>) -> Self {
        let window = Area { x: 0, y: 0, columns: 0, rows: 0 };
        Self { world, edits: Arc::default(), level: 0, window, tiles: Vec::new(), finest: 0 }
    }

    /// Returns the world.
    pub fn world(&self) -> &World {
        &self.world
    }

    /// Returns the terrain edits.
    pub fn edits(&self) -> &Arc<Edits> {
        &self.edits
    }

    /// Expands the part of the world that `view` shows from `eye` (m), and contracts everything else.
    ///
    /// The result depends only on the world, its edits, the eye and the view, not on earlier expansions.
    /// Fails if the eye is outside the world or if the view has too many heights.
    pub fn focus(&mut self, eye: DVec2, view: &View, divide: &dyn Divide) -> Result<()> {
        let fit = view.fit(&self.world, eye)?;
        self.expand(&fit, divide)
    }

    /// Replaces the edits, with effect from the next focus.
    pub fn edit(&mut self, edits: &Arc<Edits>) {
        self.edits = Arc::clone(edits);
    }

    fn expand(&mut self, fit: &ViewCells, divide: &dyn Divide) -> Result<()> {
        let mut tiles = vec![None; fit.details.len()];
        let mut missing = Vec::new();
        for (index, &detail) in fit.details.iter().enumerate() {
            let place = fit.place(index);
            let mark =
                || self.edits.mark(&self.world, place.level + detail, Tile::wanted_cells(place, detail));
            match self.tile(place).filter(|tile| tile.detail == detail && tile.mark == mark()) {
                Some(tile) => tiles[index] = Some(Arc::clone(tile)),
                None => missing.push((index, place, detail)),
            }
        }
        // All missing tiles are derived from one block of cells and its surroundings.
        let window = Area::bounding(missing.iter().map(|(_, place, _)| (place.x, place.y)));
        let wanted = window.widen(2, World::across(fit.level));
        let made = if missing.is_empty() {
            Vec::new()
        } else if self.world.has_systems() {
            let coarse = self.world.cells(fit.level, wanted, divide)?;
            missing.iter().map(|item| self.make(&coarse, *item, divide)).collect::<Result<Vec<_>>>()?
        } else {
            let coarse = self.world.cells(fit.level, wanted, &Tables)?;
            let owner = MemoryOwner::current();
            let make = |item| owner.charge(|| self.make(&coarse, item, &Tables));
            missing.par_iter().map(|item| make(*item)).collect::<Result<Vec<_>>>()?
        };
        for (index, tile) in made {
            tiles[index] = Some(Arc::new(tile));
        }
        self.tiles = tiles.into_iter().flatten().collect();
        (self.level, self.window) = (fit.level, fit.window);
        self.finest = self.tiles.iter().map(|tile| tile.level()).max().unwrap_or(0);
        Ok(())
    }

    /// Creates the tile `place`, divided `detail` times, from `coarse`, and returns it with its index.
    fn make(
        &self,
        coarse: &Block,
        (index, place, detail): (usize, TilePlace, u32),
        divide: &dyn Divide,
    ) -> Result<(usize, Tile)> {
        let wanted = Tile::wanted_cells(place, detail);
        let cells = self.world.descend(coarse, place.level + detail, wanted, true, divide)?;
        let mut heights = Vec::with_capacity(wanted.len());
        let (surface, is_remapped) = (cells.surface(), self.world.is_remapped());
        for y in (wanted.y..).take(wanted.rows) {
            let first = cells.area.index(wanted.x, y);
            let row = first..first + wanted.columns;
            let begin = heights.len();
            heights.extend_from_slice(&surface[first..][..wanted.columns]);
            let heights = &mut heights[begin..];
            if is_remapped {
                heights.iter_mut().for_each(|height| *height = self.world.remap_height(*height));
            }
            if let Some(forms) = cells.forms.get(row) {
                heights.iter_mut().zip(forms).for_each(|(height, form)| *height += form);
            }
        }
        let level = place.level + detail;
        let mut tile;
        if self.world.measured.is_some() {
            tile = Tile::new(place, detail, &cells, wanted, heights);
            tile.lay(&self.world, self.edits.local_edits(&self.world, level, wanted));
        } else {
            self.edits.apply(&self.world, level, wanted, &mut heights);
            tile = Tile::new(place, detail, &cells, wanted, heights);
        }
        tile.mark = self.edits.mark(&self.world, level, wanted);
        Ok((index, tile))
    }

    /// Returns the heights of the surface at the centres of the smallest cells of the expanded area. Heights
    /// within larger cells are interpolated. Fails if there are too many.
    pub fn map(&self) -> Result<GroundMap> {
        let [[west, north], [east, south]] = self.rim();
        let count = |low: i64, high: i64| usize::try_from(high - low).unwrap_or(0);
        let area = Area { x: west, y: north, columns: count(west, east), rows: count(north, south) };
        if area.len() as u64 > MOST_HEIGHTS {
            return Err(too_many(area.len() as u64));
        }
        let is_measured = self.world.measured.is_some();
        let height = |(x, y): (i64, i64)| -> f64 {
            let tile = self.holder(x, y).map(|tile| &self.tiles[tile]);
            match tile.filter(|tile| tile.level() == self.finest && !is_measured) {
                Some(tile) => tile.cell(x, y),
                None => self.height(self.world.middle(self.finest, x, y)).unwrap_or(f64::NAN),
            }
        };
        let heights: Vec<f64> = (0..area.len()).into_par_iter().map(|index| height(area.at(index))).collect();
        Ok(GroundMap {
            columns: area.columns,
            rows: area.rows,
            corner: self.place(west, south),
            step: self.world.cell(self.finest),
            heights,
        })
    }

    /// Returns the tiles, row by row from the north-west.
    pub fn tiles(&self) -> &[Arc<Tile>] {
        &self.tiles
    }

    /// Returns the number of expanded heights.
    pub fn heights(&self) -> usize {
        self.tiles.iter().map(|tile| tile.heights()).sum()
    }

    /// Returns the memory of the tiles (bytes).
    pub fn bytes(&self) -> usize {
        self.tiles.iter().map(|tile| tile.bytes()).sum()
    }

    /// Returns the level of the smallest cells.
    pub fn finest(&self) -> u32 {
        self.finest
    }

    fn tile(&self, place: TilePlace) -> Option<&Arc<Tile>> {
        let known = place.level == self.level && self.window.contains(place.x, place.y);
        known.then(|| self.tiles.get(self.window.index(place.x, place.y))).flatten()
    }

    /// Returns the index of the tile that contains one of the smallest cells.
    #[inline]
    pub(crate) fn holder(&self, x: i64, y: i64) -> Option<usize> {
        let down = self.finest - self.level;
        let (x, y) = (x >> down, y >> down);
        (!self.tiles.is_empty() && self.window.contains(x, y)).then(|| self.window.index(x, y))
    }

    /// Returns the tile with the largest cells among the tiles at a corner.
    #[inline]
    fn coarsest(&self, x: i64, y: i64) -> Option<&Arc<Tile>> {
        let down = self.finest - self.level;
        let inside = (1i64 << down) - 1;
        if x & inside != 0 && y & inside != 0 {
            return self.holder(x, y).map(|tile| &self.tiles[tile]);
        }
        let around = [(x - 1, y - 1), (x, y - 1), (x - 1, y), (x, y)];
        let tiles = around.into_iter().filter_map(|(x, y)| self.holder(x, y)).map(|tile| &self.tiles[tile]);
        tiles.min_by_key(|tile| tile.detail)
    }

    /// Returns the height (m) of the ground at a corner of the smallest cells; `None` outside the expanded
    /// area.
    pub(crate) fn corner(&self, x: i64, y: i64) -> Option<f64> {
        if self.world.measured.is_none() {
            return self.surface_height(x, y);
        }
        let tile = self.coarsest(x, y)?;
        match tile.on_grid(self.finest, x, y) {
            Some((x, y)) => Some(tile.ground(x, y)),
            None => self.height(self.place(x, y)),
        }
    }

    /// Returns the height (m) of the cells' surface at a corner of the smallest cells; `None` outside the
    /// expanded area.
    pub(super) fn surface_height(&self, x: i64, y: i64) -> Option<f64> {
        let tile = self.coarsest(x, y)?;
        if let Some((x, y)) = tile.on_grid(self.finest, x, y) {
            return Some(tile.corner(x, y));
        }
        // The corner lies between the corners of larger cells.
        let shift = self.finest - tile.level();
        let mask = (1i64 << shift) - 1;
        let part = |at: i64| fraction(at & mask, shift);
        let laid = |x: i64, y: i64| self.surface_height(x, y);
        self.interpolate(tile, (x >> shift, y >> shift), DVec2::new(part(x), part(y)), laid)
    }

    /// Interpolates a surface with the heights (m) `corner` at corners of the smallest cells; returns its
    /// height (m) within a cell of `tile`, at the fraction `part` to the east and to the south.
    pub(super) fn interpolate(
        &self,
        tile: &Tile,
        (x, y): (i64, i64),
        part: DVec2,
        corner: impl Fn(i64, i64) -> Option<f64>,
    ) -> Option<f64> {
        let shift = self.finest - tile.level();
        let at = |right: i64, down: i64| corner((x + right) << shift, (y + down) << shift);
        let (east, south) = (part.x, part.y);
        // Along an edge of the cell, only the ends of the edge matter.
        if east == 0.0 {
            return Some(if south == 0.0 { at(0, 0)? } else { mix(at(0, 0)?, at(0, 1)?, south) });
        }
        if south == 0.0 {
            return Some(mix(at(0, 0)?, at(1, 0)?, east));
        }
        Some(if (x + y) & 1 == 0 {
            let (a, d) = (at(0, 0)?, at(1, 1)?);
            if east >= south {
                let b = at(1, 0)?;
                a + (b - a) * east + (d - b) * south
            } else {
                let c = at(0, 1)?;
                a + (c - a) * south + (d - c) * east
            }
        } else {
            let (b, c) = (at(1, 0)?, at(0, 1)?);
            if east + south <= 1.0 {
                let a = at(0, 0)?;
                a + (b - a) * east + (c - a) * south
            } else {
                let d = at(1, 1)?;
                d + (c - d) * (1.0 - east) + (b - d) * (1.0 - south)
            }
        })
    }

    /// Returns the height (m) of the ground at `place` (m), which is exactly the measured height at each
    /// sample; `None` outside the expanded area.
    pub fn height(&self, place: DVec2) -> Option<f64> {
        let (tile, cell, part) = self.find(place)?;
        let laid = self.interpolate(tile, cell, part, |x, y| self.surface_height(x, y))?;
        Some(self.complete(tile, place, laid))
    }

    /// Returns the height (m) of the ground at `place` (m), where the surface of the cells of `tile` has the height `laid` (m).
    pub(super) fn complete(&self, tile: &Tile, place: DVec2, laid: f64) -> f64 {
        if self.world.measured.is_some() { tile.changed(place, &self.world, laid) } else { laid }
    }

    /// Returns the height (m) at `place` (m) of the surface that the cells show; `None` outside the expanded
    /// area. On measured ground, only the corners of cells are exact.
    pub fn shown_height(&self, place: DVec2) -> Option<f64> {
        let (tile, cell, part) = self.find(place)?;
        self.interpolate(tile, cell, part, |x, y| self.corner(x, y))
    }

    /// Returns the tile at `place` (m), its cell, and the position (0 to 1) to the east and to the south
    /// within the cell.
    #[allow(clippy::cast_possible_truncation, clippy::cast_precision_loss, reason = "columns are below 2^31")]
    pub(super) fn find(&self, place: DVec2) -> Option<(&Arc<Tile>, (i64, i64), DVec2)> {
        let world = &self.world;
        let along = DVec2::new(place.x - world.corner.x, world.corner.y + world.size - place.y);
        // A point on the boundary may be outside by its rounding error.
        let slack = (world.corner.abs().max_element() + world.size) * 4.0 * f64::EPSILON;
        if !along.cmpge(DVec2::splat(-slack)).all() || !along.cmple(DVec2::splat(world.size + slack)).all() {
            return None;
        }
        let along = along.clamp(DVec2::ZERO, DVec2::splat(world.size));
        let size = world.cell(self.level);
        let window = self.window;
        let of = |at: f64, first: i64, count: usize| {
            let cell = (at / size).floor() as i64;
            let behind = first + i64::try_from(count).unwrap_or(0);
            // The far boundary of the last tile belongs to the tile.
            if cell == behind && at <= behind as f64 * size { cell - 1 } else { cell }
        };
        let x = of(along.x, window.x, window.columns);
        let y = of(along.y, window.y, window.rows);
        let tile = self.tile(TilePlace { level: self.level, y, x })?;
        let step = world.cell(tile.level());
        let last = (1i64 << tile.detail) - 1;
        let first = (x << tile.detail, y << tile.detail);
        let cell = |at: f64, first: i64| ((at / step).floor() as i64).clamp(first, first + last);
        let (column, row) = (cell(along.x, first.0), cell(along.y, first.1));
        let part = along / step - DVec2::new(column as f64, row as f64);
        Some((tile, (column, row), part.clamp(DVec2::ZERO, DVec2::ONE)))
    }

    /// Returns the surface normal (a unit vector) at a corner of the smallest cells.
    pub(crate) fn normal(&self, x: i64, y: i64) -> DVec3 {
        let Some(tile) = self.coarsest(x, y) else { return DVec3::Z };
        let step = 1i64 << (self.finest - tile.level());
        let size = self.world.cell(tile.level());
        if let Some(normal) = self.normal_within(tile, x, y) {
            return normal;
        }
        let here = self.corner(x, y).unwrap_or(0.0);
        let slope = |low: Option<f64>, high: Option<f64>| match (low, high) {
            (Some(low), Some(high)) => (high - low) / (2.0 * size),
            (Some(low), None) => (here - low) / size,
            (None, Some(high)) => (high - here) / size,
            (None, None) => 0.0,
        };
        let east = slope(self.corner(x - step, y), self.corner(x + step, y));
        let north = slope(self.corner(x, y + step), self.corner(x, y - step));
        DVec3::new(-east, -north, 1.0).normalize()
    }

    /// Returns the surface normal (a unit vector) at a corner of the smallest cells; `None` unless the corner and its
    /// neighbours are corners of cells inside `tile`.
    fn normal_within(&self, tile: &Tile, x: i64, y: i64) -> Option<DVec3> {
        let (x, y) = tile.on_grid(self.finest, x, y)?;
        let first = (tile.place.x << tile.detail, tile.place.y << tile.detail);
        let last = (1i64 << tile.detail) - 1;
        let is_within = |at: i64, first: i64| at - first > 1 && at - first < last;
        if !is_within(x, first.0) || !is_within(y, first.1) {
            return None;
        }
        let measured = self.world.measured.is_some();
        let at = |x: i64, y: i64| if measured { tile.ground(x, y) } else { tile.corner(x, y) };
        let step = 2.0 * self.world.cell(tile.level());
        let east = (at(x + 1, y) - at(x - 1, y)) / step;
        let north = (at(x, y - 1) - at(x, y + 1)) / step;
        Some(DVec3::new(-east, -north, 1.0).normalize())
    }

    /// Returns the surface normal (a unit vector) at `place` (m), interpolated between the corners of cells;
    /// `None` outside the expanded area.
    pub fn way_up(&self, place: DVec2) -> Option<DVec3> {
        let (tile, (x, y), part) = self.find(place)?;
        let shift = self.finest - tile.level();
        let at = |right: i64, down: i64| self.normal((x + right) << shift, (y + down) << shift);
        let north = at(0, 0).lerp(at(1, 0), part.x);
        let south = at(0, 1).lerp(at(1, 1), part.x);
        Some(north.lerp(south, part.y).normalize())
    }

    /// Returns the name of the symbol of the cell at `place` (m); `None` outside the expanded area.
    pub fn symbol(&self, place: DVec2) -> Option<&str> {
        let (tile, (x, y), _) = self.find(place)?;
        Some(self.world.name(tile.level(), tile.symbol(x, y)))
    }

    /// Returns the first and the last corner of the expanded square, in the grid of the smallest cells.
    pub(crate) fn rim(&self) -> [[i64; 2]; 2] {
        let down = self.finest - self.level;
        let end = |first: i64, count: usize| (first + i64::try_from(count).unwrap_or(0)) << down;
        let Area { x, y, columns, rows } = self.window;
        [[x << down, y << down], [end(x, columns), end(y, rows)]]
    }

    /// Returns the position (m) of a corner of the smallest cells.
    pub(crate) fn place(&self, x: i64, y: i64) -> DVec2 {
        self.world.corner_of(self.finest, x, y)
    }
}

#[inline]
fn mix(a: f64, b: f64, part: f64) -> f64 {
    a + (b - a) * part
}

#[allow(clippy::cast_precision_loss, reason = "below 2^53")]
fn fraction(at: i64, shift: u32) -> f64 {
    at as f64 / (1i64 << shift) as f64
}
