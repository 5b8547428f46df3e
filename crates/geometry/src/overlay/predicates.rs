//! Exact geometric predicates.

use glam::DVec2;
use robust::{Coord, orient2d};

/// Returns twice the signed area (m²) of the triangle `from`, `to`, `place`: positive if `place` is on the
/// left. The sign is exact.
///
/// Method: J. Shewchuk, "Adaptive precision floating-point arithmetic and fast robust geometric predicates", 1997.
pub(super) fn side(from: DVec2, to: DVec2, place: DVec2) -> f64 {
    let coord = |at: DVec2| Coord { x: at.x, y: at.y };
    orient2d(coord(from), coord(to), coord(place))
}

/// Returns the rounded crossing of two edges; `None` if they do not cross in the interior of both.
pub(super) fn crossing(first: [DVec2; 2], second: [DVec2; 2]) -> Option<DVec2> {
    let sides = |[a, b]: [DVec2; 2], other: [DVec2; 2]| other.map(|place| side(a, b, place));
    let cross = |[one, two]: [f64; 2]| (one > 0.0 && two < 0.0) || (one < 0.0 && two > 0.0);
    let of_second = sides(first, second);
    if !cross(of_second) {
        return None;
    }
    let of_first = sides(second, first);
    if !cross(of_first) {
        return None;
    }
    // Interpolate along the shorter edge, where the rounding error is smaller.
    let is_shorter = first[0].distance_squared(first[1]) <= second[0].distance_squared(second[1]);
    let ([a, b], [from, to]) = if is_shorter { (first, of_first) } else { (second, of_second) };
    let place = a + (b - a) * (from / (from - to));
    Some(place.clamp(a.min(b), a.max(b)))
}

/// Compares the directions of two points seen from the centre of a common half-plane, counter-clockwise.
pub(super) fn by_angle(middle: DVec2, one: DVec2, two: DVec2) -> std::cmp::Ordering {
    0.0_f64.total_cmp(&(side(middle, one, two) + 0.0))
}
