//! The samples of measured ground as corners of triangles, where these would pass them by.
//!
//! A triangle that cannot be halved any more is divided at the samples in it that are farther from it than the error
//! allows. Whether a side is divided depends on its ends and on the sample alone, so both triangles at it agree.

use glam::DVec2;
use rayon::prelude::*;

use super::ground::Ground;
use super::mesh::{GridCorner, RightTriangle};
use super::tile::Tile;

/// The least distance (m) between a sample and the triangles that is worth a corner.
const LEAST: f64 = 2e-4;

/// How near (m) to a side of a triangle a sample counts as on it, in small and in large tiles: places are told in f32.
const NEAR: f64 = 1e-4;
const NEAR_PART: f64 = 3e-7;

/// A sample, where it is in the grid of the smallest cells, from the north-west.
#[derive(Debug, Clone, Copy)]
pub(super) struct Sample {
    pub at: DVec2,
    /// Where it is (m).
    pub place: DVec2,
    /// How high (m) the ground is there.
    pub height: f64,
}

/// The samples on a tile, by the rows of its cells.
#[derive(Default)]
pub(super) struct TileSamples {
    all: Vec<Sample>,
    /// Where each row begins among all; from west to east in a row.
    rows: Vec<usize>,
    /// The first row, in the smallest cells, and how many of these a row has.
    top: f64,
    row: f64,
    /// How near (smallest cells) a sample is to what it counts as on.
    near: f64,
}

/// A corner of a triangle: of cells, or a sample of its tile.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub(super) enum Vertex {
    Corner(GridCorner),
    Sample(usize),
}

impl TileSamples {
    /// Those that the cells of `tile` can show; none where these are too large, or where no ground was measured.
    pub(super) fn new(ground: &Ground, tile: &Tile) -> Self {
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
        let own = Tile::own(tile.place, tile.detail);
        let shift = ground.finest() - tile.level();
        let (top, row) = (number(own.y << shift), number(1 << shift));
        let near = near / cell;
        let mut rows: Vec<Vec<Sample>> = vec![Vec::new(); own.rows];
        for sample in found {
            // A tile beside this one that cannot show the sample would leave a gap.
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

    /// Whether there are none.
    pub(super) fn is_empty(&self) -> bool {
        self.all.is_empty()
    }

    /// Whether a sample is on the column (axis 0) or the row (axis 1) of the grid of the smallest cells.
    pub(super) fn is_on(&self, index: usize, axis: usize, line: i64) -> bool {
        (self.get(index).at[axis] - number(line)).abs() <= self.near
    }

    /// A sample by its number.
    pub(super) fn get(&self, index: usize) -> &Sample {
        &self.all[index]
    }

    /// Whether one in `triangle`, whose corners have the heights (m) `heights`, is farther than `error` (m) from it.
    pub(super) fn is_far(&self, triangle: &RightTriangle, heights: [f64; 3], error: f64) -> bool {
        let error = error.max(LEAST);
        let mut far = false;
        self.each(triangle, |_, sample, distances| {
            far = off(triangle, heights, sample, distances, self.near) > error;
            !far
        });
        far
    }

    /// The triangles that `triangle` becomes where samples in it are farther than `error` (m) from it; none if there
    /// is none.
    pub(super) fn divide(&self, triangle: &RightTriangle, heights: [f64; 3], error: f64) -> Vec<[Vertex; 3]> {
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
                    // One piece for each side that it is not on.
                    let sides = [[a, b], [b, c], [c, a]].into_iter().zip(distances);
                    let sides = sides.filter(|(_, distance)| *distance > self.near);
                    next.extend(sides.map(|([from, to], _)| [from, to, new]));
                }
            }
            pieces = next;
        }
        pieces
    }

    /// How far (smallest cells) `at` is within each side of a piece: from the first corner to the second, and so on.
    fn distances(&self, piece: [Vertex; 3], at: DVec2) -> [f64; 3] {
        let [a, b, c] = piece.map(|vertex| match vertex {
            Vertex::Corner(corner) => spot(corner),
            Vertex::Sample(index) => self.get(index).at,
        });
        [[a, b], [b, c], [c, a]].map(|[from, to]| distance(from, to, at))
    }

    /// Tells those in a triangle, its rim included but not its corners, where the ground is as it was measured, with
    /// their distances from its sides, until `tell` has enough.
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

/// How far (m) above or below a triangle a sample is; on one of its sides only the ends of that count.
fn off(triangle: &RightTriangle, heights: [f64; 3], sample: &Sample, distances: [f64; 3], near: f64) -> f64 {
    let corners = [triangle.a, triangle.b, triangle.apex];
    let height = match distances.iter().position(|distance| *distance <= near) {
        Some(side) => {
            let ends = [side, (side + 1) % 3];
            // In the same order for the triangle at the other side.
            let [one, other] = if corners[ends[0]] <= corners[ends[1]] { ends } else { [ends[1], ends[0]] };
            let [from, to] = [one, other].map(|end| spot(corners[end]));
            let along = (sample.at - from).dot(to - from) / (to - from).length_squared();
            heights[one] + (heights[other] - heights[one]) * along
        }
        None => {
            // Each corner counts by the area of the triangle opposite to it.
            let [a, b, c] = corners.map(spot);
            let share = |side: usize, from: DVec2, to: DVec2| distances[side] * (to - from).length();
            let parts = [share(1, b, c), share(2, c, a), share(0, a, b)];
            let whole: f64 = parts.iter().sum();
            parts.iter().zip(heights).map(|(part, height)| part * height).sum::<f64>() / whole
        }
    };
    (height - sample.height).abs()
}

/// Whether the cells around a place of the grid are all small enough to show samples, those of other tiles as well.
fn is_shown(ground: &Ground, at: DVec2, near: f64) -> bool {
    let reach = 2.0 * near;
    [(-reach, -reach), (reach, -reach), (-reach, reach), (reach, reach)].into_iter().all(|(x, y)| {
        let cell = (at + DVec2::new(x, y)).floor();
        #[allow(clippy::cast_possible_truncation, reason = "columns are below 2^31")]
        let holder = ground.holder(cell.x as i64, cell.y as i64);
        holder.is_none_or(|tile| ground.world().shows_samples(ground.tiles()[tile].level()))
    })
}

/// How far `at` is to the inner side of the line through two corners of a triangle, which are counter-clockwise as
/// seen from above, where rows run to the south.
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
