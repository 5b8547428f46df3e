//! Expanded tiles of a globe, and the surface over them.
//!
//! As on flat ground, the surface passes through the corners of cells, and a finer tile follows a coarser one
//! where they meet. A corner on an edge of the cube belongs to two or three faces: all of them use the
//! coarsest adjacent tile, or the tile on the first face, so that they agree to the last bit. Corners are
//! numbered in the grid of the smallest cells of any tile.

use std::sync::Arc;

use glam::{DVec2, DVec3};
use rayon::prelude::*;
use rustc_hash::FxHashMap;

use super::GlobeView;
use super::expand::{Areas, NONE, expand, pad};
use super::faces::{CubeCell, aliases, corner};
use super::leaves::{DEEPEST, DETAIL, Leaf, Sight, Tree};
use super::sphere::{direction, place, side};
use crate::division::block::{Area, Block};
use crate::division::world::{Divide, World};
use crate::tiles::tile::Tile;
use burgeon_base::MemoryOwner;
use burgeon_base::error::Result;

/// A sphere with six divided faces, and its expanded tiles.
#[derive(Clone)]
pub struct Globe {
    world: Arc<World>,
    radius: f64,
    /// Height (m) of the water, if any.
    sea: Option<f64>,
    tree: Tree,
    /// Tile of each leaf of the tree.
    tiles: Vec<Arc<Tile>>,
    /// Level of the smallest cells.
    finest: u32,
    /// Height (m) of the highest mountains, once it is computed.
    highest: Option<f64>,
}

impl Globe {
    /// Creates a globe of this radius (m) and height of the water (m), without expanded tiles. `world`
    /// defines the rules of each face.
    pub fn new(world: World, radius: f64, sea: Option<f64>) -> Self {
        let world = World { corner: DVec2::ZERO, size: side(radius), ..world };
        Self {
            world: Arc::new(world),
            radius,
            sea,
            tree: Tree::default(),
            tiles: Vec::new(),
            finest: 0,
            highest: None,
        }
    }

    /// Returns the rules of the faces as a world.
    pub fn world(&self) -> &World {
        &self.world
    }

    /// Returns the radius (m).
    pub fn radius(&self) -> f64 {
        self.radius
    }

    /// Returns the height (m) of the water, if any.
    pub fn sea(&self) -> Option<f64> {
        self.sea
    }

    /// Expands the visible part and contracts everything else. An eye below its clearance is raised to it.
    ///
    /// Heights depend only on the globe and their positions, and tiles only on the globe and the view. Fails
    /// if there would be too many heights.
    pub fn focus(&mut self, view: &GlobeView, divide: &dyn Divide) -> Result<()> {
        let levels = view.levels.min(DEEPEST);
        let eye = match view.eye {
            Some(eye) => {
                let above = eye.length() - self.radius - self.shown_height(self.probe(eye, levels, divide)?);
                let above = above.max(view.clearance).max(0.0);
                Some(eye.normalize_or(DVec3::X) * (self.radius + above))
            }
            None => None,
        };
        if view.horizon && self.highest.is_none() {
            self.highest = Some(self.survey(divide)?);
        }
        let highest = self.highest.filter(|_| view.horizon);
        let sight = Sight { eye, closeness: view.closeness, levels, highest };
        let tree = Tree::new(self.radius, &sight)?;
        let known: FxHashMap<Leaf, &Arc<Tile>> = self.tree.leaves.iter().copied().zip(&self.tiles).collect();
        let mut tiles: Vec<Option<Arc<Tile>>> =
            tree.leaves.iter().map(|leaf| known.get(leaf).map(|tile| Arc::clone(tile))).collect();
        // Missing tiles by the level of their cells.
        let mut missing: Vec<Vec<usize>> = Vec::new();
        let mut wanted: Vec<Areas> = Vec::new();
        for (index, (face, place)) in tree.leaves.iter().enumerate() {
            if tiles[index].is_some() {
                continue;
            }
            let level = (place.level + DETAIL) as usize;
            if wanted.len() <= level {
                wanted.resize(level + 1, [NONE; 6]);
                missing.resize(level + 1, Vec::new());
            }
            let area = Tile::own_cells(*place, DETAIL).grow(1);
            wanted[level][*face] = wanted[level][*face].join(area);
            missing[level].push(index);
        }
        expand(&self.world, &wanted, divide, &mut |level, blocks| {
            let make = |index: &usize| {
                let (face, place) = tree.leaves[*index];
                let area = Tile::own_cells(place, DETAIL).grow(1);
                let mut heights = pad(blocks, face, area, Block::surface);
                if blocks.iter().any(|block| !block.forms.is_empty()) {
                    let forms = pad(blocks, face, area, |block| &block.forms);
                    heights.iter_mut().zip(forms).for_each(|(height, form)| *height += form);
                }
                (*index, Arc::new(Tile::new(place, DETAIL, &blocks[face], area, heights)))
            };
            let owner = MemoryOwner::current();
            let made: Vec<_> =
                missing[level as usize].par_iter().map(|item| owner.charge(|| make(item))).collect();
            for (index, tile) in made {
                tiles[index] = Some(tile);
            }
        })?;
        self.tiles = tiles.into_iter().flatten().collect();
        self.tree = tree;
        self.finest = self.tiles.iter().map(|tile| tile.level()).max().unwrap_or(0);
        Ok(())
    }

    /// Returns an upper bound of the height (m) of mountains: twice the maximum of a coarse expansion of the
    /// whole globe.
    fn survey(&self, divide: &dyn Divide) -> Result<f64> {
        let across = 1 << DETAIL;
        let mut wanted = vec![[NONE; 6]; DETAIL as usize + 1];
        wanted[DETAIL as usize] = [Area { x: 0, y: 0, columns: across, rows: across }; 6];
        let mut highest = 0.0;
        expand(&self.world, &wanted, divide, &mut |_, blocks| {
            let heights = blocks.iter().flat_map(|block| block.surface());
            highest = heights.fold(highest, |highest: f64, height| highest.max(*height));
        })?;
        Ok(2.0 * self.shown_height(highest).max(0.0))
    }

    /// Returns the height (m) of the ground below `eye`, at a depth of `levels` divisions.
    fn probe(&self, eye: DVec3, levels: u32, divide: &dyn Divide) -> Result<f64> {
        let (face, x, y) = spot(eye, levels).0;
        let mut wanted = vec![[NONE; 6]; levels as usize + 1];
        wanted[levels as usize][face] = Area { x, y, columns: 1, rows: 1 };
        let mut height = 0.0;
        expand(&self.world, &wanted, divide, &mut |_, blocks| {
            height = blocks[face].surface()[blocks[face].area.index(x, y)];
        })?;
        Ok(height)
    }

    /// Returns the visible height (m) for a height of the ground: the height of the water, if it is higher.
    #[inline]
    pub fn shown_height(&self, height: f64) -> f64 {
        self.sea.map_or(height, |sea| height.max(sea))
    }

    /// Returns the tiles with their faces.
    pub fn tiles(&self) -> impl Iterator<Item = (usize, &Tile)> {
        self.tree.leaves.iter().map(|(face, _)| *face).zip(self.tiles.iter().map(|tile| &**tile))
    }

    /// Returns true if a point (m) is above the horizon of an eye (m): the angle between both is at most the
    /// sum of their angles to the tangent points on the sphere.
    pub(super) fn is_above_horizon(&self, eye: DVec3, point: DVec3) -> bool {
        let to_touch = |at: DVec3| (self.radius / at.length().max(self.radius)).acos();
        eye.angle_between(point) <= to_touch(eye) + to_touch(point)
    }

    /// Returns the number of expanded heights.
    pub fn heights(&self) -> usize {
        self.tiles.iter().map(|tile| tile.heights()).sum()
    }

    /// Returns the level of the smallest cells.
    pub fn finest(&self) -> u32 {
        self.finest
    }

    /// Returns the index of the tile that contains one of the smallest cells.
    #[inline]
    pub(super) fn holder(&self, cell: CubeCell) -> Option<usize> {
        self.tree.holder(cell, self.finest)
    }

    /// Returns a tile with its face.
    #[inline]
    pub(super) fn tile(&self, index: usize) -> (usize, &Tile) {
        (self.tree.leaves[index].0, &self.tiles[index])
    }

    /// Returns the tile with the largest cells among the tiles at a corner, and the corner's name on the face
    /// of that tile.
    pub(super) fn coarsest(&self, (face, x, y): CubeCell) -> Option<(&Tile, CubeCell)> {
        let across = World::across(self.finest);
        if (0..across).contains(&x) && (0..across).contains(&y) {
            let tile = self.tile(self.holder((face, x, y))?).1;
            let inside = (1i64 << (self.finest - tile.place.level)) - 1;
            if x & inside != 0 && y & inside != 0 {
                return Some((tile, (face, x, y)));
            }
        }
        let mut best: Option<(usize, CubeCell)> = None;
        for (face, x, y) in aliases((face, x, y), across) {
            for (x_cell, y_cell) in [(x - 1, y - 1), (x, y - 1), (x - 1, y), (x, y)] {
                if !(0..across).contains(&x_cell) || !(0..across).contains(&y_cell) {
                    continue;
                }
                let Some(index) = self.holder((face, x_cell, y_cell)) else { continue };
                let order = |index: usize, face: usize| (self.tiles[index].level(), face, index);
                if best.is_none_or(|(known, (on, ..))| order(index, face) < order(known, on)) {
                    best = Some((index, (face, x, y)));
                }
            }
        }
        best.map(|(index, spot)| (&*self.tiles[index], spot))
    }

    /// Returns the height (m) of the ground at a corner of the smallest cells.
    pub(super) fn corner(&self, spot: CubeCell) -> f64 {
        let Some((tile, (face, x, y))) = self.coarsest(spot) else { return 0.0 };
        let shift = self.finest - tile.level();
        let mask = (1i64 << shift) - 1;
        if (x | y) & mask == 0 {
            return tile.corner(x >> shift, y >> shift);
        }
        // The corner lies between the corners of larger cells.
        let part = |at: i64| fraction(at & mask, shift);
        self.interpolate(tile, (face, x >> shift, y >> shift), DVec2::new(part(x), part(y)))
    }

    /// Returns the height (m) of the ground within a cell of `tile`, at the fraction `part` to the east and
    /// to the south.
    fn interpolate(&self, tile: &Tile, (face, x, y): CubeCell, part: DVec2) -> f64 {
        let shift = self.finest - tile.level();
        let at = |right: i64, down: i64| self.corner((face, (x + right) << shift, (y + down) << shift));
        let (east, south) = (part.x, part.y);
        // Along an edge of the cell, only the ends of the edge matter.
        if east == 0.0 {
            return if south == 0.0 { at(0, 0) } else { mix(at(0, 0), at(0, 1), south) };
        }
        if south == 0.0 {
            return mix(at(0, 0), at(1, 0), east);
        }
        if (x + y) & 1 == 0 {
            let (a, d) = (at(0, 0), at(1, 1));
            if east >= south {
                let b = at(1, 0);
                a + (b - a) * east + (d - b) * south
            } else {
                let c = at(0, 1);
                a + (c - a) * south + (d - c) * east
            }
        } else {
            let (b, c) = (at(1, 0), at(0, 1));
            if east + south <= 1.0 {
                let a = at(0, 0);
                a + (b - a) * east + (c - a) * south
            } else {
                let d = at(1, 1);
                d + (c - d) * (1.0 - east) + (b - d) * (1.0 - south)
            }
        }
    }

    /// Returns the tile in a direction, its cell, and the position (0 to 1) to the east and to the south
    /// within the cell.
    fn find(&self, direction: DVec3) -> Option<(&Tile, CubeCell, DVec2)> {
        let (face, x, y) = spot(direction, self.finest).0;
        let (_, tile) = self.tile(self.holder((face, x, y))?);
        let (cell, part) = spot(direction, tile.level());
        Some((tile, cell, part))
    }

    /// Returns the height (m) of the ground in a direction; `None` outside the expanded area.
    pub fn height(&self, direction: DVec3) -> Option<f64> {
        let (tile, cell, part) = self.find(direction)?;
        Some(self.interpolate(tile, cell, part))
    }

    /// Returns the symbol of the cell in a direction; `None` outside the expanded area.
    pub fn symbol(&self, direction: DVec3) -> Option<&str> {
        let (tile, (_, x, y), _) = self.find(direction)?;
        Some(self.world.name(tile.level(), tile.symbol(x, y)))
    }

    /// Returns the direction (a unit vector) of a corner of the smallest cells, computed on the first face
    /// that has the corner.
    #[allow(clippy::cast_precision_loss, reason = "columns and rows are below 2^53")]
    pub(super) fn direction(&self, spot: CubeCell) -> DVec3 {
        let across = World::across(self.finest);
        let (face, x, y) = aliases(spot, across).min().unwrap_or(spot);
        let at = |at: i64| at as f64 * 2.0 / across as f64 - 1.0;
        direction(face, DVec2::new(at(x), -at(y)))
    }

    /// Returns the position (m) of the ground or the water at a corner of the smallest cells.
    pub(super) fn point(&self, spot: CubeCell) -> DVec3 {
        self.direction(spot) * (self.radius + self.shown_height(self.corner(spot)))
    }

    /// Returns the normal (a unit vector) of the ground or the water at a corner of the smallest cells.
    pub(super) fn normal(&self, spot: CubeCell) -> DVec3 {
        let Some((tile, (face, x, y))) = self.coarsest(spot) else { return self.direction(spot) };
        let across = World::across(self.finest);
        let step = 1i64 << (self.finest - tile.level());
        let beside = |right: i64, down: i64| {
            let there = corner((face, x + right * step, y + down * step), across);
            self.point(there.unwrap_or(spot))
        };
        let (east, north) = (beside(1, 0) - beside(-1, 0), beside(0, -1) - beside(0, 1));
        east.cross(north).normalize_or(self.direction(spot))
    }
}

/// Returns the direction (a unit vector) of a position on a tile, from 0 to 1 to the east and to the south.
#[allow(clippy::cast_precision_loss, reason = "columns and rows are below 2^53")]
pub fn place_within(face: usize, tile: &Tile, part: DVec2) -> DVec3 {
    let across = World::across(tile.place.level) as f64;
    let along = (DVec2::new(tile.place.x as f64, tile.place.y as f64) + part) * 2.0 / across - 1.0;
    direction(face, DVec2::new(along.x, -along.y))
}

/// Returns the cell of `level` in a direction, and the position (0 to 1) to the east and to the south within
/// it.
#[allow(clippy::cast_precision_loss, clippy::cast_possible_truncation, reason = "columns are below 2^31")]
fn spot(way: DVec3, level: u32) -> (CubeCell, DVec2) {
    let (face, at) = place(way);
    let across = World::across(level);
    let along = DVec2::new(at.x + 1.0, 1.0 - at.y) / 2.0 * across as f64;
    let cell = |along: f64| (along.floor() as i64).clamp(0, across - 1);
    let (x, y) = (cell(along.x), cell(along.y));
    let part = along - DVec2::new(x as f64, y as f64);
    ((face, x, y), part.clamp(DVec2::ZERO, DVec2::ONE))
}

#[inline]
fn mix(a: f64, b: f64, part: f64) -> f64 {
    a + (b - a) * part
}

#[allow(clippy::cast_precision_loss, reason = "below 2^53")]
fn fraction(at: i64, shift: u32) -> f64 {
    at as f64 / (1i64 << shift) as f64
}
