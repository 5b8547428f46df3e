//! Exact predicates on places.

use glam::DVec2;
use robust::{Coord, orient2d};

/// Twice the area of the triangle of two places and a third one, which is to their left if it is more than 0. The sign is
/// exact.
///
/// Method: J. Shewchuk, "Adaptive precision floating-point arithmetic and fast robust geometric predicates", 1997.
pub(super) fn side(from: DVec2, to: DVec2, place: DVec2) -> f64 {
    let coord = |at: DVec2| Coord { x: at.x, y: at.y };
    orient2d(coord(from), coord(to), coord(place))
}

/// The place where two edges cross, rounded; none if they do not cross within both.
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
    // Along the shorter one, where as much of it is less.
    let is_shorter = first[0].distance_squared(first[1]) <= second[0].distance_squared(second[1]);
    let ([a, b], [from, to]) = if is_shorter { (first, of_first) } else { (second, of_second) };
    let place = a + (b - a) * (from / (from - to));
    Some(place.clamp(a.min(b), a.max(b)))
}

/// Orders places around the middle of a half plane that they lie in, counter-clockwise.
pub(super) fn by_angle(middle: DVec2, one: DVec2, two: DVec2) -> std::cmp::Ordering {
    0.0_f64.total_cmp(&(side(middle, one, two) + 0.0))
}

/// Whether a ring of places is counter-clockwise: exactly so, if it does not meet itself; by its area otherwise, if that is
/// clear.
///
/// ```
/// use burgeon_geometry::overlay::is_counter_clockwise;
/// use glam::DVec2;
///
/// let sliver = [(0.0, 0.0), (1e7, 1e-9), (5e6, 1e-9)].map(DVec2::from);
/// assert!(is_counter_clockwise(&sliver));
/// ```
pub fn is_counter_clockwise(ring: &[DVec2]) -> bool {
    let area = crate::planar::twice_area(ring.iter().copied());
    if crate::planar::has_area(ring.iter().copied()) {
        return area > 0.0;
    }
    let before = |one: &DVec2, two: &DVec2| one.x < two.x || one.x == two.x && one.y < two.y;
    let Some(least) =
        (0..ring.len()).reduce(|best, at| if before(&ring[at], &ring[best]) { at } else { best })
    else {
        return false;
    };
    let corner = ring[least];
    let turned = |step: usize| (1..ring.len()).map(move |count| ring[(least + count * step) % ring.len()]);
    let mut ahead = turned(1).filter(|at| *at != corner);
    let mut behind = turned(ring.len() - 1).filter(|at| *at != corner);
    let (Some(next), Some(last)) = (ahead.next(), behind.next()) else { return false };
    match side(last, corner, next) {
        0.0 => area > 0.0,
        turn => turn > 0.0,
    }
}

/// Whether all places of a ring lie on one line, exactly.
pub fn is_flat(ring: impl IntoIterator<Item = DVec2> + Clone) -> bool {
    if crate::planar::has_area(ring.clone()) {
        return false;
    }
    let mut places = ring.into_iter();
    let Some(first) = places.next() else { return true };
    let Some(second) = places.find(|place| *place != first) else { return true };
    places.all(|place| side(first, second, place) == 0.0)
}
