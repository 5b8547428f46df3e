//! Positions of nodes as integers, for exact tests.

use glam::DVec3;

/// Longitude and latitude in billionths of a degree.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub(super) struct Place(pub(super) [i64; 2]);

/// Maximum absolute coordinate of a valid position; products of larger coordinates would overflow.
const FARTHEST: u64 = 1_000_000_000_000;

impl Place {
    /// Returns true if the position is within the range that all computations support.
    pub(super) fn is_sane(self) -> bool {
        self.0.iter().all(|value| value.unsigned_abs() <= FARTHEST)
    }

    /// Returns the longitude and latitude (degrees).
    #[allow(clippy::cast_precision_loss, reason = "below 2^53")]
    pub(super) fn degrees(self) -> DVec3 {
        let [east, north] = self.0.map(|value| value as f64 / 1e9);
        DVec3::new(east, north, 0.0)
    }

    /// Returns twice the signed area of the triangle with two other positions; positive for a left turn.
    pub(super) fn turn(self, b: Self, c: Self) -> i128 {
        let [ux, uy] = self.to(b);
        let [vx, vy] = self.to(c);
        ux * vy - uy * vx
    }

    /// Returns the vector to another position.
    pub(super) fn to(self, other: Self) -> [i128; 2] {
        [0, 1].map(|axis| i128::from(other.0[axis]) - i128::from(self.0[axis]))
    }

    /// Returns true if a ray to the east meets the segment from `a` to `b`, whose upper end is excluded.
    pub(super) fn sees(self, a: Self, b: Self) -> bool {
        let (low, high) = if a.0[1] <= b.0[1] { (a, b) } else { (b, a) };
        low.0[1] <= self.0[1] && self.0[1] < high.0[1] && low.turn(high, self) > 0
    }
}

/// Returns twice the signed area of a ring; positive if it is counter-clockwise.
pub(super) fn area(ring: &[Place]) -> i128 {
    let Some(first) = ring.first() else { return 0 };
    ring.windows(2).map(|pair| first.turn(pair[0], pair[1])).sum()
}
