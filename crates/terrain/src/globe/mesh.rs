//! Triangulation of a globe, coarse where it is even, within an error limit and without gaps.
//!
//! As on flat ground, triangles are halved at the midpoint of their longest side. Sides on an edge of the
//! cube are halved on both faces. A triangle is also halved while the sphere bulges out of it by more than
//! the error limit.
//!
//! All points lie on a grid with the precision of the coarsest adjacent tile, and so do origins, so that
//! neighbours have exactly the same points.

use glam::{DVec3, Vec2};
use rayon::prelude::*;
use rustc_hash::{FxHashMap, FxHashSet};

use super::faces::{CubeCell, aliases};
use super::globe::Globe;
use super::leaves::ball;
use crate::division::world::World;
use crate::mesh::height_grid::HeightGrid;
use crate::mesh::triangle::{GridCorner, RightTriangle, corners, diamond, roots};
use crate::tiles::tile::Tile;
use burgeon_base::MemoryOwner;
use burgeon_scene::Part;

/// A triangulation of a globe.
pub struct GlobeMesh<'a> {
    globe: &'a Globe,
    /// Height grid of each tile.
    grids: Vec<HeightGrid>,
    /// Corners where triangles are halved, by their names on the first face that has them.
    halved: FxHashSet<u64>,
    /// Error limit relative to the size of the cells.
    error: f64,
}

/// Triangles over one tile.
#[derive(Debug, Default)]
pub struct Pieces {
    /// Origin of the points of the parts (m, from the centre of the globe).
    pub origin: DVec3,
    /// Triangles of the ground.
    pub land: Part,
    /// Triangles of the water.
    pub water: Part,
}

impl Pieces {
    /// Returns true if there are no triangles.
    pub fn is_empty(&self) -> bool {
        self.land.triangles.is_empty() && self.water.triangles.is_empty()
    }
}

impl<'a> GlobeMesh<'a> {
    /// Computes the coarsest triangulation within `error` of the ground, relative to the size of the cells.
    pub fn new(globe: &'a Globe, error: f64) -> Self {
        let tiles: Vec<(usize, &Tile)> = globe.tiles().collect();
        let owner = MemoryOwner::current();
        let make = |face: usize, tile| owner.charge(|| grid(globe, face, tile));
        let grids = tiles.par_iter().map(|(face, tile)| make(*face, tile)).collect();
        let mut mesh = Self { globe, grids, halved: FxHashSet::default(), error };
        let mut wanted = Vec::new();
        for (face, tile) in tiles {
            wanted.extend(corners(tile.place, globe.finest()).map(|[x, y]| (face, x, y)));
            for triangle in roots(tile.place, globe.finest()) {
                wanted.extend(mesh.want(face, &triangle));
            }
        }
        while let Some(spot) = wanted.pop() {
            mesh.halve(spot, &mut wanted);
        }
        mesh
    }

    /// Returns the name of a corner on the first face that has it, as one number.
    fn key(&self, spot: CubeCell) -> u64 {
        let (face, x, y) = aliases(spot, World::across(self.globe.finest())).min().unwrap_or(spot);
        (face as u64) << 60 | x.cast_unsigned() << 30 | y.cast_unsigned()
    }

    /// Returns the point where a triangle of a face must be halved, if necessary.
    fn want(&self, face: usize, triangle: &RightTriangle) -> Option<CubeCell> {
        let middle = triangle.middle()?;
        // The tile of the triangle is determined by an inner point, in thirds of a cell.
        let [x, y] = [0, 1].map(|axis| (middle[axis] * 2 + triangle.apex[axis]).div_euclid(3));
        let holder = self.globe.holder((face, x, y))?;
        let (tile, grid) = (self.globe.tile(holder).1, &self.grids[holder]);
        let [low, .., high] = corners(tile.place, self.globe.finest());
        let inside = |corner: GridCorner| (0..2).all(|axis| (low[axis]..=high[axis]).contains(&corner[axis]));
        // Triangles larger than a tile are divided anyway; triangles as small as its cells lie on its
        // surface.
        if ![triangle.a, triangle.b, triangle.apex].into_iter().all(inside)
            || middle.iter().any(|at| at & ((1 << grid.shift) - 1) != 0)
        {
            return None;
        }
        let error = self.error * self.globe.world().cell(tile.level());
        let cell = self.globe.world().cell(self.globe.finest());
        #[allow(clippy::cast_precision_loss, reason = "columns and rows are below 2^53")]
        let square: f64 =
            (0..2).map(|axis| ((triangle.a[axis] - triangle.b[axis]) as f64 * cell).powi(2)).sum();
        let bulge = square * STRETCH / (8.0 * self.globe.radius());
        (bulge > error || grid.is_far(triangle, error)).then_some((face, middle[0], middle[1]))
    }

    /// Halves the triangles at a corner, and adds the points to `wanted` where others must be halved before
    /// or because of it.
    fn halve(&mut self, spot: CubeCell, wanted: &mut Vec<CubeCell>) {
        if !self.halved.insert(self.key(spot)) {
            return;
        }
        let across = World::across(self.globe.finest());
        for (face, x, y) in aliases(spot, across) {
            let Some((parents, ends)) = diamond([x, y], across) else { continue };
            for apex in parents {
                if apex.iter().any(|at| !(0..=across).contains(at)) {
                    continue;
                }
                wanted.push((face, apex[0], apex[1]));
                let triangle = RightTriangle { a: ends[0], b: ends[1], apex };
                for half in triangle.halves([x, y]) {
                    wanted.extend(self.want(face, &half));
                }
            }
        }
    }

    /// Returns the triangles over a tile; with `eye` (m), only those with a corner above its horizon.
    ///
    /// Texture coordinates (m) begin at `begin` in the tile's south-west corner.
    pub fn write(&self, face: usize, tile: &Tile, begin: f64, eye: Option<DVec3>) -> Pieces {
        let globe = self.globe;
        let own = step(globe, tile);
        // The origin is on the ground at the centre of the tile, so that all points are near.
        let middle = tile
            .cell((2 * tile.place.x + 1) << (tile.detail - 1), (2 * tile.place.y + 1) << (tile.detail - 1));
        let out = globe.radius() + globe.shown_height(middle);
        let origin = snap(ball((face, tile.place)).0 * out, own.max(origin_step(globe.radius())));
        // If the whole tile is above the horizon, its triangles need no test.
        let rim =
            corners(tile.place, globe.finest()).map(|[x, y]| globe.direction((face, x, y)) * globe.radius());
        let eye = eye.filter(|eye| !rim.iter().all(|corner| globe.is_above_horizon(*eye, *corner)));
        let mut pieces = Pieces { origin, ..Pieces::default() };
        let mut known: [FxHashMap<GridCorner, u32>; 2] = Default::default();
        let mut open: Vec<RightTriangle> = roots(tile.place, globe.finest()).into_iter().rev().collect();
        while let Some(triangle) = open.pop() {
            let halved = |middle: &GridCorner| self.halved.contains(&self.key((face, middle[0], middle[1])));
            if let Some(middle) = triangle.middle().filter(halved) {
                open.extend(triangle.halves(middle).into_iter().rev());
                continue;
            }
            let corners = [triangle.a, triangle.b, triangle.apex];
            let seen =
                |eye| corners.iter().any(|[x, y]| globe.is_above_horizon(eye, globe.point((face, *x, *y))));
            if eye.is_some_and(|eye| !seen(eye)) {
                continue;
            }
            let wet = |[x, y]: GridCorner| globe.sea().is_some_and(|sea| globe.corner((face, x, y)) <= sea);
            let (part, known) = match corners.into_iter().all(wet) {
                true => (&mut pieces.water, &mut known[1]),
                false => (&mut pieces.land, &mut known[0]),
            };
            let numbers = corners.map(|corner| {
                *known.entry(corner).or_insert_with(|| self.add(tile, (face, corner), (origin, begin), part))
            });
            part.triangles.push(numbers);
        }
        pieces
    }

    /// Adds a corner to a part, and returns its index.
    #[allow(
        clippy::cast_precision_loss,
        clippy::cast_possible_truncation,
        reason = "texture coordinates are f32"
    )]
    fn add(
        &self,
        tile: &Tile,
        (face, [x, y]): (usize, GridCorner),
        (origin, begin): (DVec3, f64),
        part: &mut Part,
    ) -> u32 {
        let globe = self.globe;
        let spot = (face, x, y);
        let coarsest = globe.coarsest(spot).map_or(tile, |(tile, _)| tile);
        let point = snap(globe.point(spot), step(globe, coarsest));
        part.positions.push((point - origin).as_vec3());
        part.normals.push(globe.normal(spot).into());
        // From the tile's south-west corner.
        let [_, _, [west, south], _] = corners(tile.place, globe.finest());
        let cell = globe.world().cell(globe.finest());
        let along = |cells: i64| (cells as f64 * cell + begin) as f32;
        part.uvs.push(Vec2::new(along(x - west), along(south - y)));
        u32::try_from(part.positions.len() - 1).unwrap_or(u32::MAX)
    }
}

/// Maximum ratio of a squared length on the sphere to that on a face.
const STRETCH: f64 = 2.0;

/// Returns the visible heights at all corners of the cells of a tile.
fn grid(globe: &Globe, face: usize, tile: &Tile) -> HeightGrid {
    let shift = globe.finest() - tile.level();
    let own = Tile::own_cells(tile.place, tile.detail);
    let across = own.columns + 1;
    let mut heights = Vec::with_capacity(across * across);
    for y in (own.y..).take(across) {
        for x in (own.x..).take(across) {
            let rim = x == own.x || y == own.y || !own.contains(x, y);
            let height = if rim { globe.corner((face, x << shift, y << shift)) } else { tile.corner(x, y) };
            heights.push(globe.shown_height(height));
        }
    }
    HeightGrid { heights, across, first: [own.x << shift, own.y << shift], shift }
}

/// Returns the spacing (m) of a tile's point grid: distances below four times the tile's size are integer
/// multiples of it, which f32 represents exactly.
fn step(globe: &Globe, tile: &Tile) -> f64 {
    (globe.world().cell(tile.place.level).log2().ceil() - 21.0).exp2()
}

/// Returns the spacing (m) of the grid of origins: f32 represents every multiple of it up to four radii, so
/// that files with f32 numbers keep tiles together. It is less than the side of the smallest tile of a face.
fn origin_step(radius: f64) -> f64 {
    ((4.0 * radius).log2().ceil() - 24.0).exp2()
}

fn snap(point: DVec3, step: f64) -> DVec3 {
    (point / step).round() * step
}
