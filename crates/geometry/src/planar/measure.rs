//! What is measured on rings of points: each thing here and nowhere else.

use geo::{ConvexHull, Coord, Kernel, LineString, Orientation, kernels::RobustKernel};
use glam::DVec2;

use super::{Point, Ring};

/// The edges of a ring of points, each with its two ends; the last one leads back to the first point.
pub fn edges<T: Copy>(ring: &[T]) -> impl Iterator<Item = [T; 2]> + Clone + '_ {
    (0..ring.len()).map(|index| [ring[index], ring[(index + 1) % ring.len()]])
}

/// Twice the area (m²) inside a ring of points; negative if it is clockwise.
///
/// Method: the triangles between its first point and its edges, so that it is as exact far from the origin.
pub(crate) fn twice_area(ring: impl IntoIterator<Item = DVec2>) -> f64 {
    let mut ring = ring.into_iter();
    let (Some(from), Some(mut last)) = (ring.next(), ring.next()) else { return 0.0 };
    let mut sum = 0.0;
    for next in ring {
        sum += (last - from).perp_dot(next - from);
        last = next;
    }
    sum
}

/// Whether the area inside a ring of points is more than rounding may have made of none, so that it has the same sign
/// from whichever point on and whichever way around it is measured.
pub(super) fn has_area(ring: impl IntoIterator<Item = DVec2>) -> bool {
    let mut ring = ring.into_iter();
    let (Some(from), Some(mut last)) = (ring.next(), ring.next()) else { return false };
    let (mut sum, mut terms, mut products, mut count) = (0.0, 0.0, 0.0, 0.0);
    for next in ring {
        let (a, b) = (last - from, next - from);
        sum += a.perp_dot(b);
        terms += a.perp_dot(b).abs();
        products += (a.x * b.y).abs() + (a.y * b.x).abs();
        count += 1.0;
        last = next;
    }
    // Coordinates, products and differences are rounded once each, and every partial sum once more. The ring from
    // another point on has other, at most four times as great products.
    sum.abs() > 16.0 * f64::EPSILON * products + 4.0 * count * f64::EPSILON * terms
}

/// Whether `place` is inside a ring of points, whichever way that runs. On its border the answer may be either.
///
/// Method: whether a ray to the right meets it an odd number of times, by exact predicates (J. Shewchuk, "Adaptive
/// precision floating-point arithmetic and fast robust geometric predicates", 1997).
pub fn contains<P: Point>(ring: &[P], place: DVec2) -> bool {
    let crossed = edges(ring).filter(|edge| {
        let [a, b] = edge.map(Point::flat);
        let upwards = a.y <= place.y && place.y < b.y;
        let downwards = b.y <= place.y && place.y < a.y;
        let on = |side: Orientation| orientation(a, b, place) == side;
        (upwards && on(Orientation::CounterClockwise)) || (downwards && on(Orientation::Clockwise))
    });
    crossed.count() % 2 == 1
}

/// The convex hull of `points`, counter-clockwise from its westernmost corner on; `None` if they lie on one line.
///
/// Method: quickhull (C. Barber and others, "The quickhull algorithm for convex hulls", 1996), through `geo`.
///
/// ```
/// use burgeon_geometry::{Ring, hull};
/// use glam::DVec2;
///
/// let angle = [(0.0, 0.0), (2.0, 0.0), (2.0, 1.0), (1.0, 1.0), (1.0, 2.0), (0.0, 2.0)].map(DVec2::from);
/// let hull = hull(angle).expect("an area");
/// assert_eq!((hull.len(), hull.area()), (5, 3.5));
/// assert_eq!(hull[0], DVec2::ZERO);
/// ```
pub fn hull(points: impl IntoIterator<Item = impl Point>) -> Option<Ring> {
    let points: LineString = points.into_iter().map(|point| coord(point.flat())).collect();
    let found = points.convex_hull();
    let mut hull: Vec<DVec2> = found.exterior().0.iter().map(|at| DVec2::new(at.x, at.y)).collect();
    hull.pop();
    // So that nothing that is measured on it depends on where the points begin.
    let west = |a: &DVec2, b: &DVec2| a.x.total_cmp(&b.x).then(a.y.total_cmp(&b.y));
    let first = (0..hull.len()).min_by(|&a, &b| west(&hull[a], &hull[b])).unwrap_or(0);
    hull.rotate_left(first);
    Ring::new(hull).ok()
}

/// The least and the greatest coordinates (m) of points; `None` of none.
pub(super) fn bounds(mut points: impl Iterator<Item = DVec2>) -> Option<[DVec2; 2]> {
    let first = points.next()?;
    Some(points.fold([first; 2], |[low, high], point| [low.min(point), high.max(point)]))
}

/// On which side of the way from `a` to `b` a place is, exactly.
pub(crate) fn orientation(a: DVec2, b: DVec2, place: DVec2) -> Orientation {
    RobustKernel::orient2d(coord(a), coord(b), coord(place))
}

pub(crate) fn coord(point: DVec2) -> Coord {
    Coord { x: point.x, y: point.y }
}
