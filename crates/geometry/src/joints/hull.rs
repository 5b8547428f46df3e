//! Convex hulls of points on a sphere.

use glam::DVec3;
use robust::{Coord3D, orient3d};

/// Mark of an edge without a new face.
const NONE: u32 = u32::MAX;

/// Returns the triangles of the convex hull of `points`, counter-clockwise seen from outside; `None` if the points lie
/// in a plane.
///
/// The points lie on the unit sphere up to rounding, so all of them are corners of the hull. Points are added one by one: the
/// faces that a point sees are replaced by faces to the edges around them. The predicate is exact (J. Shewchuk,
/// "Adaptive Precision Floating-Point Arithmetic", 1997), so the result is closed for any input.
pub(super) fn sphere_hull(points: &[DVec3]) -> Option<Vec<[u32; 3]>> {
    let first = first_tetrahedron(points)?;
    let [a, b, c, d] = first.map(|index| index as u32);
    let first_faces = [[a, b, c], [a, c, d], [a, d, b], [b, d, c]];
    let mut faces: Vec<HullFace> = first_faces.map(|face| HullFace::new(points, face)).into();
    let mut kept: Vec<HullFace> = Vec::with_capacity(2 * points.len());
    let mut seen: Vec<[u32; 3]> = Vec::new();
    let mut next = vec![NONE; points.len()];
    for index in 0..points.len() {
        if first.contains(&index) {
            continue;
        }
        kept.clear();
        seen.clear();
        for face in &faces {
            if face.is_seen(points, index) {
                seen.push(face.corners);
            } else {
                kept.push(*face);
            }
        }
        // The horizon: edges of faces that the point sees, whose opposite edge belongs to a face that it does not see.
        for face in &seen {
            for (from, to) in edges(*face) {
                let is_inner = seen.iter().any(|other| edges(*other).any(|edge| edge == (to, from)));
                if !is_inner {
                    if next[from as usize] != NONE {
                        return None;
                    }
                    next[from as usize] = to;
                    kept.push(HullFace::new(points, [from, to, index as u32]));
                }
            }
        }
        for face in &seen {
            face.iter().for_each(|&corner| next[corner as usize] = NONE);
        }
        std::mem::swap(&mut faces, &mut kept);
    }
    Some(faces.into_iter().map(|face| face.corners).collect())
}

/// Minimum distance of a point from the plane of a face, times twice the area of the face, that rounding cannot
/// invert, for coordinates up to 1.
const CERTAIN: f64 = 1e-13;

/// A face of the hull with its plane.
#[derive(Clone, Copy)]
struct HullFace {
    corners: [u32; 3],
    /// Outward normal, as long as twice the area.
    normal: DVec3,
    /// Product of the normal and a corner.
    offset: f64,
}

impl HullFace {
    #[inline]
    fn new(points: &[DVec3], corners: [u32; 3]) -> Self {
        let [a, b, c] = corners.map(|corner| points[corner as usize]);
        let normal = (b - a).cross(c - a);
        Self { corners, normal, offset: normal.dot(a) }
    }

    /// Returns true if point number `index` lies outside of the face.
    #[inline]
    fn is_seen(&self, points: &[DVec3], index: usize) -> bool {
        let distance = self.normal.dot(points[index]) - self.offset;
        if distance.abs() > CERTAIN { distance > 0.0 } else { side(points, self.corners, index) > 0.0 }
    }
}

/// Returns the edges of a face, in its direction.
#[inline]
fn edges([a, b, c]: [u32; 3]) -> impl Iterator<Item = (u32, u32)> {
    [(a, b), (b, c), (c, a)].into_iter()
}

/// Returns a positive number if point `index` lies outside of `face`, 0 if it lies in its plane.
#[inline]
fn side(points: &[DVec3], face: [u32; 3], index: usize) -> f64 {
    let [a, b, c] = face.map(|corner| coordinate(points[corner as usize]));
    -orient(a, b, c, coordinate(points[index]))
}

/// Returns a positive number if `a`, `b` and `c` are counter-clockwise seen from the side opposite to `d`.
#[inline]
fn orient(a: Coord3D<f64>, b: Coord3D<f64>, c: Coord3D<f64>, d: Coord3D<f64>) -> f64 {
    orient3d(a, b, c, d)
}

#[inline]
fn coordinate(DVec3 { x, y, z }: DVec3) -> Coord3D<f64> {
    Coord3D { x, y, z }
}

/// Returns four points that are not in a plane, such that the last lies inside of the face of the others.
fn first_tetrahedron(points: &[DVec3]) -> Option<[usize; 4]> {
    let a = points.first().copied()?;
    let farthest = |distance: &dyn Fn(DVec3) -> f64| {
        let far = (0..points.len()).max_by(|i, j| distance(points[*i]).total_cmp(&distance(points[*j])))?;
        (distance(points[far]) > 1e-12).then_some(far)
    };
    let second = farthest(&|point| point.distance_squared(a))?;
    let axis = points[second] - a;
    let third = farthest(&|point| axis.cross(point - a).length_squared())?;
    let normal = axis.cross(points[third] - a);
    let fourth = farthest(&|point| normal.dot(point - a).abs())?;
    let found = [0, second, third, fourth];
    let [p, q, r, s] = found.map(|index| coordinate(points[index]));
    let turn = orient(p, q, r, s);
    if turn == 0.0 {
        return None;
    }
    Some(if turn > 0.0 { found } else { [0, third, second, fourth] })
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;

    use proptest::prelude::*;

    use super::*;

    fn volume(points: &[DVec3], faces: &[[u32; 3]]) -> f64 {
        let part = |face: &[u32; 3]| {
            let [a, b, c] = face.map(|corner| points[corner as usize]);
            a.dot(b.cross(c)) / 6.0
        };
        faces.iter().map(part).sum()
    }

    fn is_closed(faces: &[[u32; 3]]) -> bool {
        let all: BTreeSet<(u32, u32)> = faces.iter().flat_map(|face| edges(*face)).collect();
        all.len() == 3 * faces.len() && all.iter().all(|(from, to)| all.contains(&(*to, *from)))
    }

    #[test]
    fn the_hull_of_a_cube_has_its_volume_although_four_points_lie_in_each_plane() {
        let corner = |i: u32| DVec3::new(f64::from(i & 1), f64::from(i >> 1 & 1), f64::from(i >> 2)) - 0.5;
        let points: Vec<DVec3> = (0..8).map(corner).collect();
        let faces = sphere_hull(&points).expect("a hull");
        assert!(faces.len() == 12 && is_closed(&faces));
        assert!((volume(&points, &faces) - 1.0).abs() < 1e-12);
        assert!(sphere_hull(&points[..4]).is_none(), "they lie in a plane");
        assert!(sphere_hull(&[]).is_none() && sphere_hull(&[DVec3::X; 9]).is_none());
    }

    proptest! {
        #![proptest_config(ProptestConfig { cases: 100, failure_persistence: None, ..ProptestConfig::default() })]

        #[test]
        fn every_point_of_a_sphere_is_a_corner_of_a_closed_hull(
            all in prop::collection::vec((-1.0f64..1.0, -1.0f64..1.0, -1.0f64..1.0), 4..60),
        ) {
            let points: Vec<DVec3> = all.iter().map(|it| DVec3::from(*it).normalize_or(DVec3::X)).collect();
            let faces = sphere_hull(&points).expect("a hull");
            prop_assert!(is_closed(&faces));
            prop_assert_eq!(faces.len(), 2 * points.len() - 4);
            for face in &faces {
                prop_assert!((0..points.len()).all(|index| side(&points, *face, index) <= 0.0));
            }
        }
    }
}
