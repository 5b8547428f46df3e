//! Measurements of rings and lines of points, each defined once.

use geo::{Coord, Kernel, Orientation, kernels::RobustKernel};
use glam::DVec2;

use super::Point;

/// Returns the edges of a ring of points, each as its two ends; the last edge leads back to the first point.
pub fn edges<T: Copy>(ring: &[T]) -> impl Iterator<Item = [T; 2]> + Clone + '_ {
    (0..ring.len()).map(|index| [ring[index], ring[(index + 1) % ring.len()]])
}

/// Returns twice the horizontal area (m²) of a ring of points; negative if it is clockwise. The first point
/// may be repeated at the end.
///
/// Method: the sum of the triangles between the first point and the edges, so that accuracy does not depend
/// on the distance from the origin.
///
/// ```
/// use burgeon_geometry::planar::twice_area;
///
/// let ring = [[0.0, 0.0], [4.0, 0.0], [4.0, 3.0]];
/// assert_eq!(twice_area(ring), 12.0);
/// assert_eq!(twice_area(ring.into_iter().rev()), -12.0);
/// assert_eq!(twice_area(ring.map(|[x, y]| [x + 1e9, y - 1e9])), 12.0);
/// ```
pub fn twice_area<P: Point>(ring: impl IntoIterator<Item = P>) -> f64 {
    let mut ring = ring.into_iter().map(Point::flat);
    let (Some(from), Some(mut last)) = (ring.next(), ring.next()) else { return 0.0 };
    let mut sum = 0.0;
    for next in ring {
        sum += (last - from).perp_dot(next - from);
        last = next;
    }
    sum
}

/// Returns true if the area of a ring of points exceeds the rounding error, so that its sign does not depend
/// on the first point or the direction.
pub(crate) fn has_area(ring: impl IntoIterator<Item = DVec2>) -> bool {
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
    // Coordinates, products and differences are rounded once each, and every partial sum once more. If the
    // ring begins at another point, its products are at most four times as great.
    sum.abs() > 16.0 * f64::EPSILON * products + 4.0 * count * f64::EPSILON * terms
}

/// Returns true if `place` is inside a ring of points in either direction; on the border the result may be
/// either.
///
/// Method: the parity of the crossings of a ray to the right, by exact predicates (J. Shewchuk, "Adaptive
/// precision floating-point arithmetic and fast robust geometric predicates", 1997).
///
/// ```
/// use burgeon_geometry::planar::contains;
/// use glam::DVec2;
///
/// let notched = [(0.0, 0.0), (4.0, 0.0), (4.0, 4.0), (2.0, 1.0), (0.0, 4.0)].map(DVec2::from);
/// assert!(contains(&notched, DVec2::new(0.5, 2.0)));
/// assert!(!contains(&notched, DVec2::new(2.0, 2.0)));
/// ```
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

/// Returns the position of the point of an edge that is horizontally closest to `place`, from 0 at its first
/// end to 1 at its second; 0 for an edge without length.
///
/// ```
/// use burgeon_geometry::planar::foot;
/// use glam::DVec2;
///
/// let edge = [[2.0, 1.0], [6.0, 1.0]];
/// assert_eq!(foot(edge, DVec2::new(3.0, 9.0)), 0.25);
/// assert_eq!(foot(edge, DVec2::new(8.0, 9.0)), 1.0);
/// ```
pub fn foot<P: Point>(edge: [P; 2], place: DVec2) -> f64 {
    let [a, b] = edge.map(Point::flat);
    let way = b - a;
    let squared = way.length_squared();
    if squared > 0.0 { ((place - a).dot(way) / squared).clamp(0.0, 1.0) } else { 0.0 }
}

/// Returns the horizontal distance (m) of a point from an edge.
///
/// ```
/// use burgeon_geometry::planar::distance;
/// use glam::DVec2;
///
/// let edge = [[2.0, 1.0], [6.0, 1.0]];
/// assert_eq!(distance(edge, DVec2::new(3.0, 9.0)), 8.0);
/// assert_eq!(distance(edge, DVec2::new(9.0, 5.0)), 5.0);
/// ```
pub fn distance<P: Point>(edge: [P; 2], place: DVec2) -> f64 {
    let [a, b] = edge.map(Point::flat);
    place.distance(a + (b - a) * foot(edge, place))
}

/// Simplifies a line: keeps its ends, and the points that would be more than `tolerance` from the line
/// through the others.
///
/// `aside` returns the distance of a point from the segment between two others, in the unit of `tolerance`;
/// use [`distance`] for points in metres. Of points at the same distance, the first is kept.
///
/// Method: D. Douglas and T. Peucker, "Algorithms for the reduction of the number of points required to represent a
/// digitized line or its caricature", 1973.
///
/// ```
/// use burgeon_geometry::planar::{distance, simplified};
/// use glam::DVec2;
///
/// let line = [(0.0, 0.0), (5.0, 0.1), (10.0, 0.0), (10.0, 6.0)].map(DVec2::from);
/// let corner = simplified(&line, 0.2, |point, way| distance(way, point));
/// assert_eq!(corner, [line[0], line[2], line[3]]);
/// assert_eq!(simplified(&line, 0.05, |point, way| distance(way, point)), line);
/// ```
pub fn simplified<T: Copy>(line: &[T], tolerance: f64, aside: impl Fn(T, [T; 2]) -> f64) -> Vec<T> {
    let stays = kept(line, tolerance, aside);
    line.iter().zip(stays).filter(|(_, stays)| *stays).map(|(point, _)| *point).collect()
}

/// Maximum depth of divisions at the farthest point; deeper divisions are made at the middle index.
const DEEPEST: u32 = 100;

/// Returns true for each point of a line that [`simplified`] keeps.
///
/// Lines that divide unevenly again and again, such as spirals, keep a few more points, so that the time
/// stays nearly proportional to the number of points.
pub(crate) fn kept<T: Copy>(line: &[T], tolerance: f64, aside: impl Fn(T, [T; 2]) -> f64) -> Vec<bool> {
    let mut stays = vec![false; line.len()];
    let Some(last) = line.len().checked_sub(1) else { return stays };
    (stays[0], stays[last]) = (true, true);
    let mut ways = vec![(0, last, 0)];
    while let Some((from, to, depth)) = ways.pop() {
        let far = (from + 1..to).map(|index| (aside(line[index], [line[from], line[to]]), index));
        let farthest = far.reduce(|best, other| if other.0 > best.0 { other } else { best });
        if let Some((far, index)) = farthest
            && far > tolerance
        {
            let index = if depth < DEEPEST { index } else { from.midpoint(to) };
            stays[index] = true;
            ways.extend([(from, index, depth + 1), (index, to, depth + 1)]);
        }
    }
    stays
}

/// Returns the minimum and maximum coordinates (m) of points; `None` without points.
pub(super) fn bounds(mut points: impl Iterator<Item = DVec2>) -> Option<[DVec2; 2]> {
    let first = points.next()?;
    Some(points.fold([first; 2], |[low, high], point| [low.min(point), high.max(point)]))
}

/// Returns the exact orientation of `a`, `b` and `place`.
pub(crate) fn orientation(a: DVec2, b: DVec2, place: DVec2) -> Orientation {
    RobustKernel::orient2d(coord(a), coord(b), coord(place))
}

pub(crate) fn coord(point: DVec2) -> Coord {
    Coord { x: point.x, y: point.y }
}
