//! Samples of measured ground as vertices of triangles.
//!
//! A triangle that cannot be halved further is divided at its samples that exceed the error limit. The
//! division of a side depends only on its ends and on the sample, so both adjacent triangles agree.

use glam::DVec2;
use rayon::prelude::*;

use super::triangle::{GridCorner, RightTriangle};
use crate::tiles::ground::Ground;
use crate::tiles::tile::Tile;

/// Minimum distance (m) between a sample and a triangle that requires a vertex.
const LEAST: f64 = 2e-4;

/// Maximum distance (m) of a sample on a side of a triangle, absolute and relative to the tile size:
/// positions are stored in f32.
const NEAR: f64 = 1e-4;
const NEAR_PART: f64 = 3e-7;

/// A sample, positioned in the grid of the smallest cells, from the north-west.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Sample {
    pub at: DVec2,
    /// Position (m).
    pub place: DVec2,
    /// Height (m) of the ground.
    pub height: f64,
}

/// Samples of a tile, by the rows of its cells.
#[derive(Default)]
pub(crate) struct TileSamples {
    all: Vec<Sample>,
    /// Start index of each row in `all`; rows are sorted from west to east.
    rows: Vec<usize>,
    /// First row, in the smallest cells, and the height of a row in these cells.
    top: f64,
    row: f64,
    /// Tolerance (smallest cells) of incidence.
    near: f64,
}

/// A vertex of a triangle: a corner of cells, or a sample of its tile.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub(crate) enum Vertex {
    Corner(GridCorner),
    Sample(usize),
}

impl TileSamples {
    /// Collects the samples that the cells of `tile` can show; none if the cells are too large or if the
    /// ground is not measured.
    pub(crate) fn new(ground: &Ground, tile: &Tile) -> Self {
        let world = ground.world();
        let (Some(measured), true) = (&world.measured, world.shows_samples(tile.level())) else {
            return Self::default();
        };
        let (low, size) = tile.bounds(world);
        let cell = world.cell(ground.finest());
        let near = NEAR.max(size * NEAR_PART).min(0.01 * cell);
        let inside = measured.samples(low - near, low + size + near);
        let north = world.corner.y + world.size;
        let found: Vec<Sample> = inside
            .into_par_iter()
            .filter_map(|place| {
                let at = DVec2::new(place.x - world.corner.x, north - place.y) / cell;
                let within = place.clamp(world.corner, world.corner + world.size);
                Some(Sample { at, place: within, height: ground.height(within)? })
            })
            .collect();
        let own = Tile::own_cells(tile.place, tile.detail);
        let shift = ground.finest() - tile.level();
        let (top, row) = (number(own.y << shift), number(1 << shift));
        let near = near / cell;
        let mut rows: Vec<Vec<Sample>> = vec![Vec::new(); own.rows];
        for sample in found {
            // A sample next to a tile that cannot show it would cause a gap.
            if !is_shown(ground, sample.at, near) {
                continue;
            }
            if let Some(last) = own.rows.checked_sub(1) {
                rows[whole((sample.at.y - top) / row).min(last)].push(sample);
            }
        }
        let mut samples = Self { top, row, near, ..Self::default() };
        for mut row in rows {
            samples.rows.push(samples.all.len());
            row.sort_by(|a, b| a.at.x.total_cmp(&b.at.x));
            samples.all.extend(row);
        }
        samples
    }

    /// Returns true if there are no samples.
    pub(crate) fn is_empty(&self) -> bool {
        self.all.is_empty()
    }

    /// Returns true if a sample lies on a column (axis 0) or a row (axis 1) of the grid of the smallest
    /// cells.
    pub(crate) fn is_on(&self, index: usize, axis: usize, line: i64) -> bool {
        (self.get(index).at[axis] - number(line)).abs() <= self.near
    }

    /// Returns a sample by its index.
    pub(crate) fn get(&self, index: usize) -> &Sample {
        &self.all[index]
    }

    /// Returns true if a sample in `triangle`, with the heights (m) `heights` at its corners, is farther than
    /// `error` (m) from it.
    pub(crate) fn is_far(&self, triangle: &RightTriangle, heights: [f64; 3], error: f64) -> bool {
        let error = error.max(LEAST);
        let mut far = false;
        self.each(triangle, |_, sample, distances| {
            far = off(triangle, heights, sample, distances, self.near) > error;
            !far
        });
        far
    }

    /// Divides `triangle` at the samples that are farther than `error` (m) from it; empty if there are none.
    pub(crate) fn divide(&self, triangle: &RightTriangle, heights: [f64; 3], error: f64) -> Vec<[Vertex; 3]> {
        let error = error.max(LEAST);
        let mut within = Vec::new();
        self.each(triangle, |index, sample, distances| {
            if off(triangle, heights, sample, distances, self.near) > error {
                within.push(index);
            }
            true
        });
        if within.is_empty() {
            return Vec::new();
        }
        let mut pieces = vec![[triangle.a, triangle.b, triangle.apex].map(Vertex::Corner)];
        for index in within {
            let at = self.get(index).at;
            let mut next = Vec::with_capacity(pieces.len() + 2);
            for piece in pieces {
                let [a, b, c] = piece;
                let distances = self.distances(piece, at);
                let new = Vertex::Sample(index);
                if distances.iter().any(|distance| *distance < -self.near) {
                    next.push(piece);
                } else {
                    // Each side that does not contain the sample makes one piece.
                    let sides = [[a, b], [b, c], [c, a]].into_iter().zip(distances);
                    let sides = sides.filter(|(_, distance)| *distance > self.near);
                    next.extend(sides.map(|([from, to], _)| [from, to, new]));
                }
            }
            pieces = next;
        }
        pieces
    }

    /// Returns the distances (smallest cells) of `at` from the sides of a piece, positive inside: from the
    /// first corner to the second, and so on.
    fn distances(&self, piece: [Vertex; 3], at: DVec2) -> [f64; 3] {
        let [a, b, c] = piece.map(|vertex| match vertex {
            Vertex::Corner(corner) => spot(corner),
            Vertex::Sample(index) => self.get(index).at,
        });
        [[a, b], [b, c], [c, a]].map(|[from, to]| distance(from, to, at))
    }

    /// Calls `tell` with the samples in a triangle and their distances from its sides, until `tell` returns
    /// false.
    ///
    /// Samples on its sides are included, but not those at its corners, where the ground has the measured
    /// height.
    fn each(&self, triangle: &RightTriangle, mut tell: impl FnMut(usize, &Sample, [f64; 3]) -> bool) {
        if self.all.is_empty() {
            return;
        }
        let corners = [triangle.a, triangle.b, triangle.apex].map(spot);
        let [a, b, c] = corners;
        let (low, high) = (a.min(b).min(c) - self.near, a.max(b).max(c) + self.near);
        let row = |y: f64| whole((y - self.top) / self.row).min(self.rows.len() - 1);
        for line in row(low.y)..=row(high.y) {
            let first = self.rows[line];
            let last = self.rows.get(line + 1).copied().unwrap_or(self.all.len());
            let begin = first + self.all[first..last].partition_point(|sample| sample.at.x < low.x);
            for (index, sample) in self.all[..last].iter().enumerate().skip(begin) {
                if sample.at.x > high.x {
                    break;
                }
                let sides = [[a, b], [b, c], [c, a]];
                let distances = sides.map(|[from, to]| distance(from, to, sample.at));
                let inside = distances.iter().all(|distance| *distance >= -self.near);
                let is_corner = || corners.iter().any(|corner| corner.distance(sample.at) <= 2.0 * self.near);
                if inside && !is_corner() && !tell(index, sample, distances) {
                    return;
                }
            }
        }
    }
}

/// Returns the vertical distance (m) of a sample from a triangle; on a side, only the ends of the side
/// matter.
fn off(triangle: &RightTriangle, heights: [f64; 3], sample: &Sample, distances: [f64; 3], near: f64) -> f64 {
    let corners = [triangle.a, triangle.b, triangle.apex];
    let height = match distances.iter().position(|distance| *distance <= near) {
        Some(side) => {
            let ends = [side, (side + 1) % 3];
            // The order of the ends is the same for the triangle on the other side.
            let [one, other] = if corners[ends[0]] <= corners[ends[1]] { ends } else { [ends[1], ends[0]] };
            let [from, to] = [one, other].map(|end| spot(corners[end]));
            let along = (sample.at - from).dot(to - from) / (to - from).length_squared();
            heights[one] + (heights[other] - heights[one]) * along
        }
        None => {
            // Barycentric coordinates: each corner is weighted by the area of the opposite triangle.
            let [a, b, c] = corners.map(spot);
            let share = |side: usize, from: DVec2, to: DVec2| distances[side] * (to - from).length();
            let parts = [share(1, b, c), share(2, c, a), share(0, a, b)];
            let whole: f64 = parts.iter().sum();
            parts.iter().zip(heights).map(|(part, height)| part * height).sum::<f64>() / whole
        }
    };
    (height - sample.height).abs()
}

/// Returns true if all cells around a point of the grid can show samples, including those of other tiles.
fn is_shown(ground: &Ground, at: DVec2, near: f64) -> bool {
    let reach = 2.0 * near;
    [(-reach, -reach), (reach, -reach), (-reach, reach), (reach, reach)].into_iter().all(|(x, y)| {
        let cell = (at + DVec2::new(x, y)).floor();
        #[allow(clippy::cast_possible_truncation, reason = "columns are below 2^31")]
        let holder = ground.holder(cell.x as i64, cell.y as i64);
        holder.is_none_or(|tile| ground.world().shows_samples(ground.tiles()[tile].level()))
    })
}

/// Returns the distance of `at` to the inner side of the line through two consecutive corners of a
/// counter-clockwise triangle, as seen from above, where rows run to the south.
fn distance(from: DVec2, to: DVec2, at: DVec2) -> f64 {
    let way = to - from;
    -way.perp_dot(at - from) / way.length()
}

#[allow(clippy::cast_precision_loss, reason = "columns are below 2^31")]
fn spot(corner: GridCorner) -> DVec2 {
    DVec2::new(corner[0] as f64, corner[1] as f64)
}

#[allow(clippy::cast_precision_loss, reason = "columns are below 2^31")]
fn number(at: i64) -> f64 {
    at as f64
}

#[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a cast saturates")]
fn whole(at: f64) -> usize {
    at as usize
}
