//! The edges of the polygon on a lattice, where directions are compared exactly.

use std::cmp::Ordering;

use glam::{DVec2, I64Vec2};

use super::Pace;

/// Cells of the lattice to a metre: the direction of an edge of 1 cm is off by less than 2e-8 radians.
const CELLS: f64 = (1u64 << 32) as f64;

/// The rings on the lattice, with their coordinates (m) from the middle of their box.
///
/// Differences of coordinates are whole numbers of cells then, without rounding, up to 2^20 m.
pub(super) fn snapped(rings: &[Vec<DVec2>]) -> (Vec<Vec<DVec2>>, DVec2) {
    let points = || rings.iter().flatten();
    let low = points().fold(DVec2::INFINITY, |low, point| low.min(*point));
    let high = points().fold(DVec2::NEG_INFINITY, |high, point| high.max(*point));
    let middle = low.midpoint(high).round();
    let snap = |point: &DVec2| ((*point - middle) * CELLS).round() / CELLS;
    (rings.iter().map(|ring| ring.iter().map(snap).collect()).collect(), middle)
}

/// An edge of the polygon and the line that it lies on at any time.
#[derive(Debug, Clone, Copy)]
pub(super) struct Edge {
    /// Its direction.
    pub along: DVec2,
    /// The distance of its line from the origin at the beginning.
    pub level: f64,
    /// How fast it moves at present.
    pub speed: f64,
    /// How it moves in all.
    pub pace: Pace,
}

impl Edge {
    /// To the left, where it moves.
    pub(super) fn inward(&self) -> DVec2 {
        self.along.perp()
    }

    /// The distance of `at` from its line at `time`, positive where it has not been yet.
    pub(super) fn ahead(&self, at: DVec2, time: f64) -> f64 {
        self.inward().dot(at) - self.level - self.pace.way(time)
    }
}

/// The direction of an edge in cells of the lattice.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Direction(I64Vec2);

impl Direction {
    /// From one point of the lattice to another.
    pub(super) fn new(from: DVec2, to: DVec2) -> Self {
        Self(((to - from) * CELLS).as_i64vec2())
    }

    pub(super) fn reversed(self) -> Self {
        Self(-self.0)
    }

    /// The way that `other` turns from it: greater to the left, less to the right. Exact.
    pub(super) fn turn(self, other: Self) -> Ordering {
        let [a, b] = [self.0, other.0].map(|way| (i128::from(way.x), i128::from(way.y)));
        (a.0 * b.1).cmp(&(a.1 * b.0))
    }

    /// The order of the angles from the negative x axis, counter-clockwise. Exact.
    pub(super) fn compare(self, other: Self) -> Ordering {
        let upper = |way: I64Vec2| way.y > 0 || (way.y == 0 && way.x > 0);
        upper(self.0).cmp(&upper(other.0)).then_with(|| other.turn(self))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn directions_are_in_the_order_of_their_angles_and_turn_exactly() {
        let ways = [(-1., -1.), (0., -1.), (1., -1.), (1., 0.), (1., 1e-6), (1., 1.), (0., 1.), (-1., 1.)];
        let ways = ways.map(|(x, y)| Direction::new(DVec2::ZERO, DVec2::new(x, y)));
        for pair in ways.windows(2) {
            assert_eq!(pair[0].compare(pair[1]), Ordering::Less, "{pair:?}");
            assert_eq!(pair[0].turn(pair[1]), Ordering::Greater, "{pair:?}");
            assert_eq!(pair[0].reversed().turn(pair[1]), Ordering::Less, "{pair:?}");
        }
    }

    #[test]
    fn corners_are_moved_by_less_than_a_thousandth_of_a_micrometre() {
        let ring = vec![DVec2::new(1000.1, 2000.2), DVec2::new(1010.3, 2000.7), DVec2::new(1003.3, 2011.1)];
        let (snapped, middle) = snapped(std::slice::from_ref(&ring));
        assert_eq!(middle, DVec2::new(1005.0, 2006.0));
        for (&from, &to) in ring.iter().zip(&snapped[0]) {
            assert!((from - middle).distance(to) < 1e-9);
        }
    }
}
