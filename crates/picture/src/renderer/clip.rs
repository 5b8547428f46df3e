//! Clipping of triangles that extend behind the camera.
//!
//! Method: Sutherland and Hodgman, "Reentrant polygon clipping", 1974.

use glam::Vec3A;

/// Maximum number of corners: the triangle has three, and each of the five planes adds at most one.
const MOST: usize = 8;

/// Corner in the camera's axes, and its weights relative to the triangle's three corners.
type ClippedCorner = (Vec3A, Vec3A);

/// Clips a triangle by the plane at the distance `near` and by side planes with the slope `aside`, which are outside of the
/// image, so that the coordinates of clipped corners stay in the range that the raster computes exactly. Calls `emit` with the resulting
/// triangles: their corners in the camera's axes, and for each corner its weights relative to the given corners.
///
/// Triangles that share an edge are cut at the same points, regardless of their orientation.
pub(super) fn clip(
    corners: [Vec3A; 3],
    [near, aside]: [f32; 2],
    mut emit: impl FnMut([Vec3A; 3], [Vec3A; 3]),
) {
    let planes: [&dyn Fn(Vec3A) -> f32; 5] =
        [&|p| p.z - near, &|p| aside * p.z - p.x, &|p| aside * p.z + p.x, &|p| aside * p.z - p.y, &|p| {
            aside * p.z + p.y
        }];
    let [a, b, c] = corners;
    let mut polygon = [(Vec3A::ZERO, Vec3A::ZERO); MOST];
    polygon[..3].copy_from_slice(&[(a, Vec3A::X), (b, Vec3A::Y), (c, Vec3A::Z)]);
    let mut count = 3;
    for inside in planes {
        (polygon, count) = cut(&polygon[..count], inside);
    }
    for i in 2..count {
        let triangle = [polygon[0], polygon[i - 1], polygon[i]];
        emit(triangle.map(|(at, _)| at), triangle.map(|(_, weights)| weights));
    }
}

/// Returns the part of a convex polygon in which `inside` is not negative.
fn cut(polygon: &[ClippedCorner], inside: impl Fn(Vec3A) -> f32) -> ([ClippedCorner; MOST], usize) {
    let mut kept = [(Vec3A::ZERO, Vec3A::ZERO); MOST];
    let mut count = 0;
    let mut add = |corner: ClippedCorner| {
        if let Some(slot) = kept.get_mut(count) {
            *slot = corner;
            count += 1;
        }
    };
    for (i, &here) in polygon.iter().enumerate() {
        let next = polygon[(i + 1) % polygon.len()];
        let (from, to) = (inside(here.0), inside(next.0));
        if from >= 0.0 {
            add(here);
        }
        if (from >= 0.0) != (to >= 0.0) {
            // Compute from the inner end, so that both triangles at an edge get the same point.
            let ((inner, outer), part) = if from >= 0.0 {
                ((here, next), from / (from - to))
            } else {
                ((next, here), to / (to - from))
            };
            add((inner.0.lerp(outer.0, part), inner.1.lerp(outer.1, part)));
        }
    }
    (kept, count)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    const ASIDE: f32 = 1.0;

    fn clip_triangle(corners: [Vec3A; 3], near: f32) -> Vec<([Vec3A; 3], [Vec3A; 3])> {
        let mut all = Vec::new();
        clip(corners, [near, ASIDE], |corners, weights| all.push((corners, weights)));
        all
    }

    fn cross(corners: [Vec3A; 3]) -> Vec3A {
        (corners[1] - corners[0]).cross(corners[2] - corners[0])
    }

    #[test]
    fn a_triangle_in_front_of_the_camera_stays_as_it_is() {
        let corners = [Vec3A::new(-0.1, 0.0, 1.0), Vec3A::new(0.1, 0.0, 1.0), Vec3A::new(0.0, 0.2, 2.0)];
        assert_eq!(clip_triangle(corners, 0.01), [(corners, [Vec3A::X, Vec3A::Y, Vec3A::Z])]);
    }

    #[test]
    fn a_triangle_behind_the_camera_disappears() {
        let corners = [Vec3A::NEG_Z, Vec3A::new(1.0, 0.0, -2.0), Vec3A::new(0.0, 1.0, -3.0)];
        assert_eq!(clip_triangle(corners, 0.01), []);
    }

    proptest! {
        #[test]
        fn the_visible_part_is_kept_and_its_corners_lie_on_the_triangle(
            numbers in proptest::array::uniform9(-3.0_f32..3.0),
            at in proptest::array::uniform2(0.0_f32..1.0),
        ) {
            let corners = [0, 3, 6].map(|i| Vec3A::new(numbers[i], numbers[i + 1], numbers[i + 2]));
            let near = 0.05;
            let pieces = clip_triangle(corners, near);
            let whole = cross(corners);
            for (piece, weights) in &pieces {
                prop_assert!(cross(*piece).dot(whole) >= -1e-4 * whole.length());
                for (corner, weights) in piece.iter().zip(weights) {
                    let expected = corners[0] * weights.x + corners[1] * weights.y + corners[2] * weights.z;
                    prop_assert!(corner.distance(expected) < 1e-4, "{corner} {expected}");
                    prop_assert!(corner.z >= near - 1e-5);
                    prop_assert!(corner.x.abs().max(corner.y.abs()) <= ASIDE * corner.z + 1e-4);
                }
            }
            // A point of the triangle that may be visible is in one of the pieces.
            let (u, v) = if at[0] + at[1] <= 1.0 { (at[0], at[1]) } else { (1.0 - at[0], 1.0 - at[1]) };
            let point = corners[0] + (corners[1] - corners[0]) * u + (corners[2] - corners[0]) * v;
            let seen = point.z > near + 1e-3 && point.x.abs().max(point.y.abs()) < 0.9 * ASIDE * point.z;
            if seen && whole.length() > 1e-2 {
                let inside = |(piece, _): &([Vec3A; 3], [Vec3A; 3])| {
                    let sub = |a: Vec3A, b: Vec3A| (b - a).cross(point - a).dot(whole);
                    (0..3).all(|i| sub(piece[i], piece[(i + 1) % 3]) >= -1e-3 * whole.length_squared().max(1.0))
                };
                prop_assert!(pieces.iter().any(inside), "{point} of {corners:?} is lost");
            }
        }
    }
}
