//! Checks of finished triangles: whether they close, which way they face, what they enclose.

use glam::{DVec3, Vec3};
use rustc_hash::FxHashMap;

use crate::scene::Part;

/// What [`check`] found; nothing is wrong with a solid for which [`Check::is_solid`] holds.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Check {
    /// Edges (m) with a triangle on one side only, in the order of their first use.
    pub open: Vec<[Vec3; 2]>,
    /// Edges (m) whose triangles run along them the same way, so that one of the two faces inwards.
    pub inconsistent: Vec<[Vec3; 2]>,
    /// Triangles that are no thicker than a thousand-millionth of their longest edge.
    pub zero_area: usize,
    /// Positions with a coordinate that is infinite or not a number.
    pub not_finite: usize,
}

impl Check {
    /// Whether every edge has as many triangles running one way as the other.
    pub fn is_closed(&self) -> bool {
        self.open.is_empty() && self.inconsistent.is_empty()
    }

    /// Whether the surface is closed, consistently oriented, finite and free of zero-area triangles.
    pub fn is_solid(&self) -> bool {
        self.is_closed() && self.zero_area == 0 && self.not_finite == 0
    }
}

/// Checks the surface that `parts` form together.
///
/// Two corners are one point if their positions are equal to the last bit; -0 equals 0. An edge that several
/// sheets share is sound if as many triangles run along it one way as the other.
pub fn check<'a>(parts: impl IntoIterator<Item = &'a Part>) -> Check {
    let mut found = Check::default();
    let mut points: Vec<Vec3> = Vec::new();
    let mut known: FxHashMap<[u32; 3], usize> = FxHashMap::default();
    let mut edges: Vec<Edge> = Vec::new();
    let mut edge_of: FxHashMap<(usize, usize), usize> = FxHashMap::default();
    for part in parts {
        let welded: Vec<usize> = part
            .positions
            .iter()
            .map(|&position| {
                found.not_finite += usize::from(!position.is_finite());
                let position = position + Vec3::ZERO; // turns -0 into 0
                *known.entry(position.to_array().map(f32::to_bits)).or_insert_with(|| {
                    points.push(position);
                    points.len() - 1
                })
            })
            .collect();
        for triangle in &part.triangles {
            let corners = triangle.map(|corner| welded[corner as usize]);
            found.zero_area += usize::from(is_flat(corners.map(|corner| points[corner].as_dvec3())));
            for side in 0..3 {
                let (from, to) = (corners[side], corners[(side + 1) % 3]);
                let index = *edge_of.entry((from.min(to), from.max(to))).or_insert_with(|| {
                    edges.push(Edge { from, to, along: 0, against: 0 });
                    edges.len() - 1
                });
                let edge = &mut edges[index];
                *if edge.from == from { &mut edge.along } else { &mut edge.against } += 1;
            }
        }
    }
    for edge in edges.iter().filter(|edge| edge.along != edge.against && edge.from != edge.to) {
        let place = [points[edge.from], points[edge.to]];
        let odd = (edge.along + edge.against) % 2 == 1;
        if odd { &mut found.open } else { &mut found.inconsistent }.push(place);
    }
    found
}

/// An edge with the number of triangles that run along it each way.
struct Edge {
    from: usize,
    to: usize,
    along: usize,
    against: usize,
}

/// Whether a triangle is no thicker than a thousand-millionth of its longest edge.
#[inline]
pub(super) fn is_flat([a, b, c]: [DVec3; 3]) -> bool {
    let longest = a.distance_squared(b).max(b.distance_squared(c)).max(c.distance_squared(a));
    (b - a).cross(c - a).length() <= longest * 1e-9
}

/// The volume (m³) that `parts` enclose together; negative if they face inwards, meaningless if they are open.
///
/// Method: the divergence theorem, as a sum of the signed tetrahedra between each triangle and one point.
pub fn volume<'a>(parts: impl IntoIterator<Item = &'a Part>) -> f64 {
    let mut apex = None;
    let mut sum = 0.0;
    for [a, b, c] in parts.into_iter().flat_map(triangles) {
        // A point of the surface itself loses fewer digits than the origin when the solid is far from it.
        let apex = *apex.get_or_insert(a);
        sum += (a - apex).dot((b - apex).cross(c - apex));
    }
    sum / 6.0
}

/// The area (m²) of all triangles.
pub fn area<'a>(parts: impl IntoIterator<Item = &'a Part>) -> f64 {
    parts.into_iter().flat_map(triangles).map(|[a, b, c]| (b - a).cross(c - a).length() / 2.0).sum()
}

fn triangles(part: &Part) -> impl Iterator<Item = [DVec3; 3]> {
    part.triangles.iter().map(|triangle| triangle.map(|corner| part.positions[corner as usize].as_dvec3()))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The tetrahedron between the origin and the three unit points, facing outwards.
    fn tetrahedron() -> Part {
        let positions = vec![Vec3::ZERO, Vec3::X, Vec3::Y, Vec3::Z];
        let triangles = vec![[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]].into();
        Part { positions, triangles, ..Part::default() }
    }

    #[test]
    fn a_tetrahedron_is_solid_and_has_its_volume_and_area() {
        let solid = tetrahedron();
        assert_eq!(check([&solid]), Check::default());
        assert!((volume([&solid]) - 1.0 / 6.0).abs() < 1e-12);
        assert!((area([&solid]) - (1.5 + 3f64.sqrt() / 2.0)).abs() < 1e-6);
    }

    #[test]
    fn a_missing_triangle_leaves_its_three_edges_open() {
        let mut solid = tetrahedron();
        solid.triangles.truncate(3);
        let found = check([&solid]);
        assert_eq!(found.open.len(), 3);
        assert!(found.inconsistent.is_empty() && !found.is_closed());
    }

    #[test]
    fn a_turned_triangle_is_inconsistent_with_its_three_neighbours() {
        let mut solid = tetrahedron();
        solid.triangles.truncate(3);
        solid.triangles.push([3, 2, 1]);
        let found = check([&solid]);
        assert_eq!((found.open.len(), found.inconsistent.len()), (0, 3));
    }

    #[test]
    fn corners_of_different_parts_are_welded_and_minus_zero_is_zero() {
        let mut a = tetrahedron();
        let mut b = tetrahedron();
        b.positions[0] = Vec3::new(-0.0, 0.0, -0.0);
        b.triangles = a.triangles.iter().skip(2).collect();
        a.triangles.truncate(2);
        assert!(!check([&a]).is_closed());
        assert!(check([&a, &b]).is_solid());
    }

    #[test]
    fn a_triangle_on_a_line_and_a_point_that_is_not_a_number_are_counted() {
        let mut solid = tetrahedron();
        solid.positions.extend([Vec3::X * 2.0, Vec3::new(f32::NAN, 0.0, 0.0)]);
        solid.triangles.push([0, 1, 4]);
        let found = check([&solid]);
        assert_eq!((found.zero_area, found.not_finite), (1, 1));
        // A triangle that has shrunk to an edge has no area, but opens nothing.
        let mut solid = tetrahedron();
        solid.triangles.push([0, 0, 1]);
        let found = check([&solid]);
        assert!(found.zero_area == 1 && found.is_closed());
    }
}
