//! Orientation of rings, by exact predicates.

use geo::kernels::Orientation;
use glam::DVec2;

use super::measure::{has_area, orientation, twice_area};

/// Returns true if a ring of points is counter-clockwise.
///
/// The result is exact if the ring does not intersect itself; otherwise it is the sign of the area, if the
/// area is large enough to be certain.
///
/// ```
/// use burgeon_geometry::planar::is_counter_clockwise;
/// use glam::DVec2;
///
/// let sliver = [(0.0, 0.0), (1e7, 1e-9), (5e6, 1e-9)].map(DVec2::from);
/// assert!(is_counter_clockwise(&sliver));
/// ```
pub fn is_counter_clockwise(ring: &[DVec2]) -> bool {
    let area = twice_area(ring.iter().copied());
    if has_area(ring.iter().copied()) {
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
    match orientation(last, corner, next) {
        Orientation::Collinear => area > 0.0,
        turn => turn == Orientation::CounterClockwise,
    }
}

/// Returns true if all points of a ring are exactly collinear.
///
/// ```
/// use burgeon_geometry::planar::is_flat;
/// use glam::DVec2;
///
/// let tenths = [(0.0, 0.0), (0.25, 0.75), (1.0, 3.0)].map(DVec2::from);
/// assert!(is_flat(tenths));
/// assert!(!is_flat([tenths[0], tenths[1], DVec2::new(1.0, 3.0 + 1e-15)]));
/// ```
pub fn is_flat(ring: impl IntoIterator<Item = DVec2> + Clone) -> bool {
    if has_area(ring.clone()) {
        return false;
    }
    let mut places = ring.into_iter();
    let Some(first) = places.next() else { return true };
    let Some(second) = places.find(|place| *place != first) else { return true };
    places.all(|place| orientation(first, second, place) == Orientation::Collinear)
}
