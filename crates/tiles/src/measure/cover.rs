//! Parts of a triangle that other triangles cover.

use glam::DVec3;
use smallvec::SmallVec;

use super::tree::{TriangleCorners, distance_squared};

/// Maximum number of triangles that cover one.
pub(super) const MOST_COVERS: usize = 48;

/// Maximum number of parts that are left of a triangle while it is covered.
const MOST_PARTS: usize = 32;

/// Distance (m) across the edges of a triangle up to which it covers others, so that no slivers are left between neighbours.
const OVERLAP: f64 = 0.01;

/// Corners of a convex polygon.
type ConvexPolygon = SmallVec<[DVec3; 8]>;

/// Returns parts of a triangle that contain all of its points farther than `limit` (m) from the triangles `covers`.
///
/// A triangle covers what its sides, moved outwards a little, cut out of another one, if no corner of this part is too far away:
/// the distance from a triangle is convex, so it is largest in a corner.
pub(super) fn uncovered_parts(
    triangle: &TriangleCorners,
    covers: &[TriangleCorners],
    limit: f64,
) -> Vec<TriangleCorners> {
    let mut parts: Vec<ConvexPolygon> = vec![triangle.iter().copied().collect()];
    let mut next = Vec::new();
    for cover in covers {
        let Some(sides) = sides(cover) else { continue };
        for part in parts.drain(..) {
            let begin = next.len();
            if !cut(&part, &sides, &mut next).is_some_and(|inside| is_near(cover, &inside, limit)) {
                next.truncate(begin);
                next.push(part);
            }
        }
        std::mem::swap(&mut parts, &mut next);
        if parts.is_empty() || parts.len() > MOST_PARTS {
            break;
        }
    }
    let fan = |part: &ConvexPolygon| {
        (1..part.len() - 1).map(|at| [part[0], part[at], part[at + 1]]).collect::<Vec<_>>()
    };
    parts.iter().flat_map(fan).collect()
}

/// Half space: the points whose product with the direction is at most the number.
type HalfSpace = (DVec3, f64);

/// Returns the half spaces inside the three sides of a triangle, moved outwards by [`OVERLAP`]; `None` without an area.
fn sides(corners: &TriangleCorners) -> Option<[HalfSpace; 3]> {
    let [a, b, c] = *corners;
    let normal = (b - a).cross(c - a).try_normalize()?;
    let side = |from: DVec3, to: DVec3| {
        let outwards = (to - from).cross(normal).normalize_or_zero();
        (outwards, outwards.dot(from) + OVERLAP)
    };
    Some([side(a, b), side(b, c), side(c, a)])
}

/// Returns the part of a polygon inside all half spaces, and adds the others to `outside`; `None` if there is no such part.
fn cut(
    polygon: &ConvexPolygon,
    sides: &[HalfSpace; 3],
    outside: &mut Vec<ConvexPolygon>,
) -> Option<ConvexPolygon> {
    let mut rest = polygon.clone();
    for side in sides {
        let [inside, beyond] = divide(&rest, side);
        if inside.len() < 3 {
            return None;
        }
        if beyond.len() >= 3 {
            outside.push(beyond);
        }
        rest = inside;
    }
    Some(rest)
}

/// Returns the parts of a polygon inside and outside a half space.
fn divide(polygon: &ConvexPolygon, (direction, number): &HalfSpace) -> [ConvexPolygon; 2] {
    let mut parts = [ConvexPolygon::new(), ConvexPolygon::new()];
    let heights: SmallVec<[f64; 8]> = polygon.iter().map(|corner| direction.dot(*corner) - number).collect();
    for (at, corner) in polygon.iter().enumerate() {
        let following = (at + 1) % polygon.len();
        let (height, other) = (heights[at], heights[following]);
        if height <= 0.0 {
            parts[0].push(*corner);
        }
        if height >= 0.0 {
            parts[1].push(*corner);
        }
        if height * other < 0.0 {
            let between = corner.lerp(polygon[following], height / (height - other));
            parts.iter_mut().for_each(|part| part.push(between));
        }
    }
    parts
}

/// Returns true if no corner is farther than `limit` (m) from a triangle.
fn is_near(triangle: &TriangleCorners, corners: &ConvexPolygon, limit: f64) -> bool {
    corners.iter().all(|corner| distance_squared(triangle, *corner) <= limit * limit)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn triangle() -> impl Strategy<Value = TriangleCorners> {
        let point = (-4.0..4.0_f64, -4.0..4.0_f64, -0.5..0.5_f64).prop_map(|(x, y, z)| DVec3::new(x, y, z));
        prop::array::uniform3(point)
    }

    fn area([a, b, c]: &TriangleCorners) -> f64 {
        (b - a).cross(c - a).length() / 2.0
    }

    proptest! {
        #[test]
        fn all_points_that_are_far_from_the_covers_are_left(
            triangle in triangle(), covers in prop::collection::vec(triangle(), 0..12), limit in 0.0..0.6_f64,
        ) {
            let left = uncovered_parts(&triangle, &covers, limit);
            let [a, b, c] = triangle;
            prop_assert!(left.iter().map(area).sum::<f64>() <= area(&triangle) + 1e-9);
            for i in 0..=30 {
                for j in 0..=30 - i {
                    let point = a + (b - a) * (f64::from(i) / 30.0) + (c - a) * (f64::from(j) / 30.0);
                    let near = |others: &[TriangleCorners], limit: f64| {
                        others.iter().any(|other| distance_squared(other, point) <= limit * limit)
                    };
                    prop_assert!(near(&covers, limit) || near(&left, 1e-6));
                }
            }
        }
    }

    #[test]
    fn a_wall_of_panels_covers_a_wall_of_two_triangles() {
        let at = |x: f64, z: f64, y: f64| DVec3::new(x, y, z);
        let panel = |x: f64, z: f64, y: f64| {
            let [a, b, c, d] = [at(x, z, y), at(x + 1.0, z, y), at(x + 1.0, z + 1.0, y), at(x, z + 1.0, y)];
            [[a, b, c], [a, c, d]]
        };
        let panels = |depth: f64| -> Vec<_> {
            (0..20)
                .flat_map(|n| panel(f64::from(n % 5), f64::from(n / 5), depth * f64::from(n % 2)))
                .collect()
        };
        let wall = [at(0.0, 0.0, 0.0), at(5.0, 0.0, 0.0), at(5.0, 4.0, 0.0)];
        assert!(uncovered_parts(&wall, &panels(0.0), 0.05).is_empty());
        assert!(uncovered_parts(&wall, &panels(0.15), 0.2).is_empty());
        let left: f64 = uncovered_parts(&wall, &panels(0.3), 0.2).iter().map(area).sum();
        assert!((left - 5.0).abs() < 0.3, "{left}");
    }
}
