//! Mapping between planes, computed exactly at lattice nodes and interpolated in between.

use glam::DVec2;

use crate::heights::count;

/// Side (m) of a cell of the first, coarsest lattice.
const COARSEST: f64 = 50_000.0;
/// Maximum number of nodes of a lattice.
const MOST: usize = 2_000_000;
/// Maximum error (m) of interpolated positions.
const TOLERANCE: f64 = 2e-4;

/// Maps positions in a box to other coordinates by cubic polynomials in both directions, cell by cell.
///
/// A projection is so smooth that cells of tens of kilometres suffice; linear interpolation would need cells of 150 m.
pub(super) struct Lattice {
    low: DVec2,
    cell: DVec2,
    across: usize,
    up: usize,
    /// Four by four nodes per cell; adjacent cells share their outer nodes.
    knots: Vec<DVec2>,
}

impl Lattice {
    /// Computes a lattice over the box from `low` to `high` (m) that approximates `exact` to within the tolerance.
    /// `unit` (m) is the length of one unit of each coordinate that `exact` returns. The result is NaN where `exact` is
    /// NaN.
    ///
    /// Returns `None` if `exact` is not smooth enough.
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
                // Points between nodes, where the error is largest.
                [1.0, 3.0, 5.0].map(|part| low + (corner + DVec2::splat(part / 6.0)) * cell)
            });
            // NaN values are not errors, and `f64::max` ignores them.
            let worst = middles.map(|at| ((lattice.at(at) - exact(at)) * unit).length()).fold(0.0, f64::max);
            if worst <= TOLERANCE {
                return Some(lattice);
            }
            side /= 2.0;
        }
    }

    /// Returns the coordinates of `place` (m).
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

/// Returns the number of cells, at least one.
#[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a cast saturates")]
fn cells(length: f64) -> usize {
    (length.ceil() as usize).max(1)
}

/// Returns the weights of four nodes at 0, 1/3, 2/3 and 1 for the position `s` (Lagrange polynomials).
#[inline]
fn weights(s: f64) -> [f64; 4] {
    let [a, b, c] = [s - 1.0 / 3.0, s - 2.0 / 3.0, s - 1.0];
    [-4.5 * a * b * c, 13.5 * s * b * c, -13.5 * s * a * c, 4.5 * s * a * b]
}
