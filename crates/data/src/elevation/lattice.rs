//! A mapping between planes, computed at the knots of a lattice and fast in between.

use glam::DVec2;

use crate::heights::count;

/// The side (m) of a cell of the first, coarsest lattice.
const COARSEST: f64 = 50_000.0;
/// The most knots of a lattice.
const MOST: usize = 2_000_000;
/// The farthest (m) that a place is moved by the lattice.
const TOLERANCE: f64 = 2e-4;

/// Maps places of a box to other coordinates, by polynomials of the third degree in each direction, cell by cell.
///
/// A projection is so smooth that cells of tens of kilometres do, where straight lines would need cells of 150 m.
pub(super) struct Lattice {
    low: DVec2,
    cell: DVec2,
    across: usize,
    up: usize,
    /// Four by four for each cell, of which neighbours share the outer ones.
    knots: Vec<DVec2>,
}

impl Lattice {
    /// The lattice over the box from `low` to `high` (m) that follows `exact` well enough. `unit` (m) is how long each
    /// of the coordinates that `exact` gives is. NaN where `exact` gives NaN.
    ///
    /// `None` if `exact` is too rough.
    pub(super) fn over(low: DVec2, high: DVec2, unit: DVec2, exact: impl Fn(DVec2) -> DVec2) -> Option<Self> {
        let mut side = COARSEST;
        loop {
            let [across, up] = ((high - low) / side).to_array().map(cells);
            if (3 * across + 1).saturating_mul(3 * up + 1) > MOST {
                return None;
            }
            let cell = (high - low) / DVec2::new(count(across), count(up));
            let mut lattice = Self { low, cell, across, up, knots: Vec::new() };
            for row in 0..=3 * up {
                for column in 0..=3 * across {
                    lattice.knots.push(exact(low + DVec2::new(count(column), count(row)) / 3.0 * cell));
                }
            }
            let middles = (0..across * up).flat_map(|index| {
                let corner = DVec2::new(count(index % across), count(index / across));
                // Between knots, where the error is greatest.
                [1.0, 3.0, 5.0].map(|part| low + (corner + DVec2::splat(part / 6.0)) * cell)
            });
            // Where one of them is no number, nothing is wrong.
            let worst = middles.map(|at| ((lattice.at(at) - exact(at)) * unit).length()).fold(0.0, f64::max);
            if worst <= TOLERANCE {
                return Some(lattice);
            }
            side /= 2.0;
        }
    }

    /// The coordinates of `place` (m).
    #[inline]
    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a cast saturates")]
    pub(super) fn at(&self, place: DVec2) -> DVec2 {
        let at = (place - self.low) / self.cell;
        let (column, row) = ((at.x as usize).min(self.across - 1), (at.y as usize).min(self.up - 1));
        let (u, v) = (weights(at.x - count(column)), weights(at.y - count(row)));
        let stride = 3 * self.across + 1;
        let corner = 3 * row * stride + 3 * column;
        (0..4).fold(DVec2::ZERO, |sum, line| {
            let knots = &self.knots[corner + line * stride..][..4];
            sum + v[line] * (u[0] * knots[0] + u[1] * knots[1] + u[2] * knots[2] + u[3] * knots[3])
        })
    }
}

/// How many cells it takes, at least one.
#[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a cast saturates")]
fn cells(length: f64) -> usize {
    (length.ceil() as usize).max(1)
}

/// How much each of four knots at 0, 1/3, 2/3 and 1 counts at `s` in between: Lagrange's polynomials.
#[inline]
fn weights(s: f64) -> [f64; 4] {
    let [a, b, c] = [s - 1.0 / 3.0, s - 2.0 / 3.0, s - 1.0];
    [-4.5 * a * b * c, 13.5 * s * b * c, -13.5 * s * a * c, 4.5 * s * a * b]
}
