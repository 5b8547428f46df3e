//! Edges of the polygon on a lattice, where directions are compared exactly.

use std::cmp::Ordering;

use glam::{DVec2, I64Vec2};

use super::skeleton::Pace;
use crate::planar::Polygon;
use burgeon_base::error::{Error, Limit, Result};

/// Number of lattice cells per metre of the scaled polygon: corners move by less than 2e-10 m.
pub(super) const CELLS: f64 = (1u64 << 32) as f64;
/// Exponent (base 2) of the minimum extent (m) of a scaled polygon.
const EXTENT: i32 = 9;
/// Maximum exponent (base 2) of an extent (m), and of its inverse.
const MOST_POWER: i32 = 300;
/// Maximum coordinate (cells): products of differences fit in 128 bits.
const MOST: f64 = (1u64 << 61) as f64;

/// Returns the power of two that scales a polygon to an extent of 512 to 1024 m.
///
/// Fails if its extent (m) is 0, or so small or large that its products overflow or underflow.
pub(super) fn scale_of(polygon: &Polygon) -> Result<f64> {
    let [low, high] = polygon.bounds().unwrap_or_default();
    let extent = (high - low).max_element();
    #[allow(clippy::cast_possible_truncation, reason = "11 bits")]
    let power = (extent.to_bits() >> 52 & 0x7ff) as i32 - 1023;
    if power.abs() > MOST_POWER {
        return Err(Error::limit(Limit::Size, format!("the outline extends over {extent:e} m"))
            .help("a skeleton takes outlines of 1e-90 to 1e90 m"));
    }
    Ok(2f64.powi(EXTENT - power))
}

/// Snaps the rings, scaled by a power of two, to the lattice (cells), and returns the centre (m) of their
/// bounding box, which is the lattice's origin.
pub(super) fn snap(polygon: &Polygon, scale: f64, rings: &mut Vec<Vec<I64Vec2>>) -> Result<DVec2> {
    let [low, high] = polygon.bounds().unwrap_or_default();
    let middle = (low.midpoint(high) * scale).round() / scale;
    let cells = CELLS * scale;
    let reach = (high - low).max_element() * cells;
    if reach > MOST {
        return Err(Error::limit(Limit::Size, "the outline is too large for a roof")
            .help("give an outline of less than 500,000 km"));
    }
    let snapped = |point: &DVec2| nearest_cell((*point - middle) * cells);
    rings.resize_with(polygon.len(), Vec::new);
    for (points, ring) in rings.iter_mut().zip(polygon.iter()) {
        points.clear();
        points.extend(ring.iter().map(snapped));
    }
    Ok(middle)
}

/// Rounds to the nearest point of the lattice, halves away from zero like `round`, but without a library
/// call.
fn nearest_cell(point: DVec2) -> I64Vec2 {
    let whole = point.as_i64vec2();
    whole + ((point - whole.as_dvec2()) * 2.0).as_i64vec2()
}

/// Converts a point of the lattice to metres.
pub(super) fn metres(point: I64Vec2) -> DVec2 {
    point.as_dvec2() / CELLS
}

/// Converts the index of a corner or edge, of which there are fewer than 2^32.
#[allow(clippy::cast_possible_truncation, reason = "there is no memory for more")]
pub(super) fn short(number: usize) -> u32 {
    number as u32
}

/// An edge of the polygon.
#[derive(Debug, Clone, Copy)]
pub(super) struct SkeletonEdge {
    /// Direction.
    pub along: DVec2,
    /// Distance (m) of its line from the origin at the start.
    pub level: f64,
    /// Motion of the edge over the whole time.
    pub pace: Pace,
    /// Index of its current line.
    pub line: usize,
}

impl SkeletonEdge {
    /// Returns the distance of `at` from the edge at `time`, positive if the edge has not reached it yet.
    pub(super) fn distance_ahead(&self, at: DVec2, time: f64) -> f64 {
        self.along.perp().dot(at) - self.level - self.pace.way(time)
    }
}

/// A direction in cells of the lattice.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Direction(pub I64Vec2);

impl Direction {
    pub(super) fn reversed(self) -> Self {
        Self(-self.0)
    }

    /// Returns the direction a quarter turn to the left.
    pub(super) fn left(self) -> Self {
        Self(self.0.perp())
    }

    /// Compares the turn to `other` exactly: greater to the left, less to the right.
    pub(super) fn turn(self, other: Self) -> Ordering {
        let [a, b] = [self.0, other.0].map(|way| (i128::from(way.x), i128::from(way.y)));
        (a.0 * b.1).cmp(&(a.1 * b.0))
    }

    /// Returns true if two parallel directions have the same sense.
    pub(super) fn agrees(self, other: Self) -> bool {
        self.0.signum() == other.0.signum()
    }

    /// Returns true if another direction is parallel and has the same sense.
    pub(super) fn runs_as(self, other: Self) -> bool {
        self.agrees(other) && self.turn(other) == Ordering::Equal
    }

    /// Compares the angles from the negative x axis, counter-clockwise and exactly.
    pub(super) fn compare(self, other: Self) -> Ordering {
        let upper = |way: I64Vec2| way.y > 0 || (way.y == 0 && way.x > 0);
        upper(self.0).cmp(&upper(other.0)).then_with(|| other.turn(self))
    }

    /// Returns the shortest parallel direction on the lattice.
    pub(super) fn shortest(self) -> Self {
        let [mut a, mut b] = [self.0.x.unsigned_abs(), self.0.y.unsigned_abs()];
        while b > 0 {
            (a, b) = (b, a % b);
        }
        #[allow(clippy::cast_possible_wrap, reason = "no greater than a coordinate")]
        Self(self.0 / a.max(1) as i64)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn directions_are_in_the_order_of_their_angles_and_turn_exactly() {
        let ways = [(-9, -9), (0, -9), (9, -9), (9, 0), (i64::MAX / 4, 1), (9, 9), (0, 9), (-9, 9)];
        let ways = ways.map(|(x, y)| Direction(I64Vec2::new(x, y)));
        for pair in ways.windows(2) {
            assert_eq!(pair[0].compare(pair[1]), Ordering::Less, "{pair:?}");
            assert_eq!(pair[0].turn(pair[1]), Ordering::Greater, "{pair:?}");
            assert_eq!(pair[0].reversed().turn(pair[1]), Ordering::Less, "{pair:?}");
        }
        assert_eq!(ways[2].shortest().0, I64Vec2::new(1, -1));
        assert_eq!(ways[1].shortest().left().0, I64Vec2::new(1, 0));
    }

    #[test]
    fn the_nearest_point_of_the_lattice_is_what_rounding_gives() {
        let odd = (1u64 << 52) as f64 - 0.5;
        let numbers = [0.0, 0.5, 1.5, 2.5, 0.5 - f64::EPSILON / 4.0, 0.75, 1e-300, odd, odd - 1.0, MOST];
        for number in numbers.into_iter().flat_map(|number| [number, -number]) {
            assert_eq!(
                nearest_cell(DVec2::splat(number)),
                DVec2::splat(number).round().as_i64vec2(),
                "{number}"
            );
        }
    }

    #[test]
    fn corners_are_moved_by_less_than_a_thousandth_of_a_micrometre() {
        let ring = vec![DVec2::new(1000.1, 2000.2), DVec2::new(1010.3, 2000.7), DVec2::new(1003.3, 2011.1)];
        let polygon = Polygon::new(vec![ring.clone()]).expect("a small ring");
        let mut snapped = Vec::new();
        let middle = snap(&polygon, 1.0, &mut snapped).expect("a small ring");
        assert_eq!(middle, DVec2::new(1005.0, 2006.0));
        for (&from, &to) in ring.iter().zip(&snapped[0]) {
            assert!((from - middle).distance(metres(to)) < 1e-9);
        }
    }
}
