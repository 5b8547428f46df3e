//! Triangulation of expanded ground, coarse where it is even, within an error limit and without gaps.
//!
//! Each square of cells consists of two right triangles, and each triangle is halved at the midpoint of its
//! longest side as long as the ground is farther from it than the error limit. A side is halved for both
//! adjacent triangles, so halving one triangle may require others to be halved first, also in tiles with
//! larger cells.
//!
//! Method: Evans, Kirkpatrick and Townsend, "Right-triangulated irregular networks", 2001.

use glam::{DVec2, DVec3, Vec2};
use rayon::prelude::*;
use rustc_hash::{FxHashMap, FxHashSet};

use super::cuts::{GroundCuts, PartCorner};
use super::height_grid::HeightGrid;
use super::samples::{TileSamples, Vertex};
use super::triangle::{GridCorner, RightTriangle, corners, diamond, orient, roots};
use crate::tiles::ground::Ground;
use burgeon_base::MemoryOwner;
use burgeon_scene::Part;

/// A triangulation of expanded ground.
pub struct GroundMesh<'a> {
    ground: &'a Ground,
    /// Height grid of each tile.
    grids: Vec<HeightGrid>,
    /// Samples of each tile.
    samples: Vec<TileSamples>,
    /// Corners where triangles are halved.
    halved: FxHashSet<u64>,
    error: f64,
}

fn key([x, y]: GridCorner) -> u64 {
    (x.cast_unsigned() << 32) | (y.cast_unsigned() & 0xFFFF_FFFF)
}

/// Number of a vertex that has none yet.
const NONE: u32 = u32::MAX;
/// Maximum number of corners of cells in a side of a tile whose numbers are in a table.
const WIDEST: usize = 1025;

/// Numbers of the vertices over a tile.
struct TileVertices {
    /// Corner of the tile with the least coordinates.
    first: GridCorner,
    /// Logarithm of the width of the tile's cells.
    shift: u32,
    /// Number of corners of cells in a side of the tile; 0 for tiles that are too wide.
    width: usize,
    /// Numbers of the corners of cells, by rows.
    of_cells: Vec<u32>,
    /// Numbers of the others: corners of smaller cells of a neighbour, and samples.
    others: FxHashMap<Vertex, u32>,
}

impl TileVertices {
    fn new(corners: [GridCorner; 4], shift: u32) -> Self {
        let first = [0, 1].map(|axis| corners.iter().map(|corner| corner[axis]).min().unwrap_or(0));
        let last = corners.iter().map(|corner| corner[0]).max().unwrap_or(0);
        let width = usize::try_from((last - first[0]) >> shift).map_or(0, |cells| cells + 1);
        let width = if width <= WIDEST { width } else { 0 };
        Self { first, shift, width, of_cells: vec![NONE; width * width], others: FxHashMap::default() }
    }

    /// Returns the place of the number of a vertex.
    fn number(&mut self, vertex: Vertex) -> &mut u32 {
        if let Vertex::Corner([x, y]) = vertex {
            let [right, down] = [x - self.first[0], y - self.first[1]];
            let index = |at: i64| usize::try_from(at >> self.shift).ok().filter(|index| *index < self.width);
            if (right | down) & ((1 << self.shift) - 1) == 0
                && let (Some(right), Some(down)) = (index(right), index(down))
            {
                return &mut self.of_cells[down * self.width + right];
            }
        }
        self.others.entry(vertex).or_insert(NONE)
    }
}

impl<'a> GroundMesh<'a> {
    /// Computes the coarsest triangulation within `error` (m) of the ground at all corners of its cells, and
    /// at all samples of measured ground if cells are not larger than the sample distance.
    ///
    /// ```
    /// use burgeon_terrain::{DivisionRules, Ground, GroundCuts, GroundMesh, LevelRules, Tables, View, World};
    /// use glam::{DVec2, DVec3};
    /// use std::sync::Arc;
    ///
    /// # let (rules, names) = (DivisionRules::None, Arc::default());
    /// let plain = LevelRules { from: 0, rules, start: 0, height: 12.0, rest: vec![], names };
    /// # let (corner, remap) = (DVec2::ZERO, vec![]);
    /// let layers = vec![plain];
    /// let world = World { corner, size: 64.0, layers, smooth: false, key: None, remap, measured: None };
    /// let view = View::whole(&world, 4);
    /// let mut ground = Ground::new(Arc::new(world));
    /// ground.focus(DVec2::splat(32.0), &view, &Tables)?;
    /// let mut part = Default::default();
    /// GroundMesh::new(&ground, 0.1).write(0, DVec3::ZERO, 0.0, &GroundCuts::default(), &mut part);
    /// // A plain needs no more triangles than a square.
    /// assert_eq!((part.triangles.len(), part.positions[0].z), (2, 12.0));
    /// # Ok::<(), burgeon_base::Error>(())
    /// ```
    pub fn new(ground: &'a Ground, error: f64) -> Self {
        let owner = MemoryOwner::current();
        let grid = |tile| owner.charge(|| HeightGrid::new(ground, tile));
        let grids = ground.tiles().par_iter().map(|tile| grid(tile)).collect();
        let samples = |tile| owner.charge(|| TileSamples::new(ground, tile));
        let samples = ground.tiles().par_iter().map(|tile| samples(tile)).collect();
        let mut mesh = Self { ground, grids, samples, halved: FxHashSet::default(), error };
        let mut wanted = Vec::new();
        for tile in ground.tiles() {
            wanted.extend(corners(tile.place, ground.finest()));
            for triangle in roots(tile.place, ground.finest()) {
                wanted.extend(mesh.want(&triangle));
            }
        }
        while let Some(corner) = wanted.pop() {
            mesh.halve(corner, &mut wanted);
        }
        mesh
    }

    /// Returns the point where a triangle must be halved, if necessary.
    fn want(&self, triangle: &RightTriangle) -> Option<GridCorner> {
        let middle = triangle.middle()?;
        let inside = |at: GridCorner, to: GridCorner| [at[0] * 2 + to[0], at[1] * 2 + to[1]];
        // The tile of the triangle is determined by an inner point, in thirds of a cell.
        let [x, y] = inside(middle, triangle.apex);
        let holder = self.ground.holder(x.div_euclid(3), y.div_euclid(3))?;
        let (tile, grid) = (&self.ground.tiles()[holder], &self.grids[holder]);
        let legs = (triangle.a[0] - triangle.apex[0]).abs().max((triangle.a[1] - triangle.apex[1]).abs());
        let whole = 1i64 << (self.ground.finest() - tile.place.level);
        // Triangles larger than a tile are divided anyway; triangles as small as its cells lie on its
        // surface.
        if legs > whole
            || legs >> grid.shift == 0
            || middle.iter().any(|at| at & ((1 << grid.shift) - 1) != 0)
        {
            return None;
        }
        let samples = &self.samples[holder];
        let passes = || {
            let triangle = orient(*triangle);
            samples.is_far(&triangle, self.heights(&triangle), self.error)
        };
        (grid.is_far(triangle, self.error) || !samples.is_empty() && passes()).then_some(middle)
    }

    /// Returns the heights (m) at the corners of a triangle.
    fn heights(&self, triangle: &RightTriangle) -> [f64; 3] {
        [triangle.a, triangle.b, triangle.apex].map(|[x, y]| self.ground.corner(x, y).unwrap_or(0.0))
    }

    /// Halves the triangles at `corner`, and adds the points to `wanted` where others must be halved before
    /// or because of it.
    fn halve(&mut self, corner: GridCorner, wanted: &mut Vec<GridCorner>) {
        if !self.halved.insert(key(corner)) {
            return;
        }
        let Some((parents, ends)) = diamond(corner, 1 << self.ground.finest()) else { return };
        wanted.extend(parents);
        for apex in parents {
            let triangle = RightTriangle { a: ends[0], b: ends[1], apex };
            for half in triangle.halves(corner) {
                wanted.extend(self.want(&half));
            }
        }
    }

    /// Returns the triangles over the tile `number` as indices of its vertices.
    fn triangles(&self, number: usize) -> (Vec<Vertex>, Vec<[u32; 3]>) {
        let tile = &self.ground.tiles()[number];
        let mut vertices = Vec::new();
        let mut known =
            TileVertices::new(corners(tile.place, self.ground.finest()), self.grids[number].shift);
        let mut triangles = Vec::new();
        let mut add = |piece: [Vertex; 3]| {
            triangles.push(piece.map(|vertex| {
                let number = known.number(vertex);
                if *number == NONE {
                    vertices.push(vertex);
                    *number = u32::try_from(vertices.len() - 1).unwrap_or(NONE);
                }
                *number
            }));
        };
        let samples = &self.samples[number];
        let mut open: Vec<RightTriangle> =
            roots(tile.place, self.ground.finest()).into_iter().rev().collect();
        while let Some(triangle) = open.pop() {
            match triangle.middle().filter(|middle| self.halved.contains(&key(*middle))) {
                Some(middle) => open.extend(triangle.halves(middle).into_iter().rev()),
                None => {
                    let pieces = match samples.is_empty() {
                        true => Vec::new(),
                        false => samples.divide(&triangle, self.heights(&triangle), self.error),
                    };
                    if pieces.is_empty() {
                        add([triangle.a, triangle.b, triangle.apex].map(Vertex::Corner));
                    }
                    pieces.into_iter().for_each(&mut add);
                }
            }
        }
        (vertices, triangles)
    }

    /// Returns the position (m) of a vertex over the tile `number`.
    fn point(&self, number: usize, vertex: Vertex) -> DVec3 {
        match vertex {
            Vertex::Corner([x, y]) => self.ground.place(x, y).extend(self.ground.corner(x, y).unwrap_or(0.0)),
            Vertex::Sample(index) => {
                let sample = self.samples[number].get(index);
                sample.place.extend(sample.height)
            }
        }
    }

    /// Adds the triangles over the tile `number` to `part`, relative to `origin` (m), outside the areas of
    /// `cuts`.
    ///
    /// Texture coordinates (m) begin at `begin` in the tile's south-west corner.
    pub fn write(&self, number: usize, origin: DVec3, begin: f64, cuts: &GroundCuts, part: &mut Part) {
        let (vertices, triangles) = self.triangles(number);
        let base = u32::try_from(part.positions.len()).unwrap_or(u32::MAX);
        part.make_room(vertices.len(), triangles.len());
        let (south_west, _) = self.ground.tiles()[number].bounds(self.ground.world());
        let add = |point: DVec3, normal: DVec3, part: &mut Part| {
            part.positions.push((point - origin).as_vec3());
            part.normals.push(normal.into());
            let [u, v] = (point.truncate() - south_west + begin).to_array();
            #[allow(clippy::cast_possible_truncation, reason = "texture coordinates are f32")]
            part.uvs.push(Vec2::new(u as f32, v as f32));
        };
        let points: Vec<DVec3> = vertices.iter().map(|vertex| self.point(number, *vertex)).collect();
        let up = |at: DVec2| self.ground.way_up(at).unwrap_or(DVec3::Z);
        for (vertex, point) in vertices.iter().zip(&points) {
            let normal = match vertex {
                Vertex::Corner([x, y]) => self.ground.normal(*x, *y),
                Vertex::Sample(_) => up(point.truncate()),
            };
            add(*point, normal, part);
        }
        if cuts.is_empty() {
            part.triangles.extend(triangles.into_iter().map(|corners| corners.map(|corner| corner + base)));
            return;
        }
        let mut left: Vec<[u32; 3]> = Vec::with_capacity(triangles.len());
        let mut known: FxHashMap<[u64; 2], u32> = FxHashMap::default();
        for corners in triangles {
            let Some(pieces) = cuts.parts_outside(corners.map(|corner| points[corner as usize].truncate()))
            else {
                left.push(corners.map(|corner| corner + base));
                continue;
            };
            for piece in pieces {
                let triangle = piece.map(|corner| match corner {
                    PartCorner::Own(index) => corners[index] + base,
                    PartCorner::Border(at) => {
                        let key = at.truncate().to_array().map(f64::to_bits);
                        *known.entry(key).or_insert_with(|| {
                            add(at, up(at.truncate()), part);
                            u32::try_from(part.positions.len() - 1).unwrap_or(u32::MAX)
                        })
                    }
                });
                let [a, b, c] = triangle.map(|corner| part.positions[corner as usize]);
                if (b - a).cross(c - a).length_squared() > 0.0 {
                    left.push(triangle);
                }
            }
        }
        drop_unused(part, base as usize, &mut left);
        part.triangles.extend(left);
    }

    /// Returns the edges of triangles on the boundary of the expanded area, unordered: their ends (m), with
    /// the ground on the left.
    pub fn rim(&self) -> Vec<[DVec3; 2]> {
        let [low, high] = self.ground.rim();
        let mut edges = Vec::new();
        for number in 0..self.ground.tiles().len() {
            let samples = &self.samples[number];
            let on = |axis: usize, rim: i64, vertex: Vertex| match vertex {
                Vertex::Corner(corner) => corner[axis] == rim,
                Vertex::Sample(index) => samples.is_on(index, axis, rim),
            };
            let (vertices, triangles) = self.triangles(number);
            for triangle in triangles {
                let [a, b, c] = triangle.map(|corner| vertices[corner as usize]);
                for edge in [[a, b], [b, c], [c, a]] {
                    let along = |axis: usize, rim: i64| edge.iter().all(|end| on(axis, rim, *end));
                    if (0..2).any(|axis| along(axis, low[axis]) || along(axis, high[axis])) {
                        edges.push(edge.map(|end| self.point(number, end)));
                    }
                }
            }
        }
        edges
    }
}

/// Removes the vertices from index `base` on that no triangle uses.
fn drop_unused(part: &mut Part, base: usize, triangles: &mut [[u32; 3]]) {
    let mut numbers = vec![u32::MAX; part.positions.len() - base];
    let mut next = base;
    for corner in triangles.iter().flatten() {
        numbers[*corner as usize - base] = 0;
    }
    for (index, number) in numbers.iter_mut().enumerate().filter(|(_, number)| **number == 0) {
        let from = base + index;
        part.positions[next] = part.positions[from];
        part.normals[next] = part.normals[from];
        part.uvs[next] = part.uvs[from];
        *number = u32::try_from(next).unwrap_or(u32::MAX);
        next += 1;
    }
    part.positions.truncate(next);
    part.normals.truncate(next);
    part.uvs.truncate(next);
    for corner in triangles.iter_mut().flatten() {
        *corner = numbers[*corner as usize - base];
    }
}
