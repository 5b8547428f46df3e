//! Heights at the corners of the cells of a tile, and their distance from a triangle.

use glam::DVec2;

use super::triangle::{GridCorner, RightTriangle};
use crate::tiles::ground::Ground;
use crate::tiles::tile::Tile;

/// Heights (m) at all corners of the cells of a tile.
pub(crate) struct HeightGrid {
    pub heights: Vec<f64>,
    /// Number of corners per side.
    pub across: usize,
    /// First corner.
    pub first: GridCorner,
    /// Size of its cells relative to the smallest cells, as an exponent of two.
    pub shift: u32,
}

impl HeightGrid {
    pub(crate) fn new(ground: &Ground, tile: &Tile) -> Self {
        let shift = ground.finest() - tile.level();
        let own = Tile::own_cells(tile.place, tile.detail);
        let across = own.columns + 1;
        let mut heights = Vec::with_capacity(across * across);
        for y in (own.y..).take(across) {
            for x in (own.x..).take(across) {
                let rim = x == own.x || y == own.y || !own.contains(x, y);
                let height =
                    if rim { ground.corner(x << shift, y << shift) } else { Some(tile.ground(x, y)) };
                heights.push(height.unwrap_or(0.0));
            }
        }
        Self { heights, across, first: [own.x << shift, own.y << shift], shift }
    }

    #[inline]
    fn at(&self, column: usize, row: usize) -> f64 {
        self.heights[row * self.across + column]
    }

    /// Returns true if the ground is farther than `error` (m) from a triangle whose corners all belong to the
    /// grid.
    #[allow(clippy::cast_precision_loss, reason = "columns are below 2^31")]
    pub(crate) fn is_far(&self, triangle: &RightTriangle, error: f64) -> bool {
        let own = |corner: GridCorner| {
            let [x, y] = [0, 1].map(|axis| usize::try_from((corner[axis] - self.first[axis]) >> self.shift));
            (x.unwrap_or(0), y.unwrap_or(0))
        };
        let [a, b, c] = [triangle.a, triangle.b, triangle.apex].map(own);
        let [p, q, r] = [a, b, c].map(|(x, y)| (DVec2::new(x as f64, y as f64), self.at(x, y)));
        // The plane through its corners: both legs have the same length.
        let (u, v) = (p.0 - r.0, q.0 - r.0);
        let length = u.length_squared();
        let gradient = (u * (p.1 - r.1) + v * (q.1 - r.1)) / length;
        let (top, bottom) = (a.1.min(b.1).min(c.1), a.1.max(b.1).max(c.1));
        for row in top..=bottom {
            // Intersections of the row with the sides.
            let (mut left, mut right) = (usize::MAX, 0);
            for (from, to) in [(a, b), (b, c), (c, a)] {
                let (from, to) = if from.1 <= to.1 { (from, to) } else { (to, from) };
                if from.1 == to.1 {
                    if from.1 == row {
                        (left, right) = (left.min(from.0.min(to.0)), right.max(from.0.max(to.0)));
                    }
                    continue;
                }
                if row < from.1 || row > to.1 {
                    continue;
                }
                // Sides run along a row, along a column, or diagonally.
                let down = row - from.1;
                let x = match to.0.cmp(&from.0) {
                    std::cmp::Ordering::Equal => from.0,
                    std::cmp::Ordering::Greater => from.0 + down,
                    std::cmp::Ordering::Less => from.0 - down,
                };
                (left, right) = (left.min(x), right.max(x));
            }
            let begin = r.1 + gradient.dot(DVec2::new(left as f64, row as f64) - r.0);
            let heights = &self.heights[row * self.across..];
            for (step, height) in heights[left..=right].iter().enumerate() {
                if (height - (begin + gradient.x * step as f64)).abs() > error {
                    return true;
                }
            }
        }
        false
    }
}
