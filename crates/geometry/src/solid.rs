//! Checks of finished triangle meshes: closedness, orientation, volume and area.

use glam::{DVec3, Vec3};
use rustc_hash::FxHashMap;

use super::planar::edges;
use burgeon_scene::Part;

/// Result of [`check`]: the defects of a surface; empty if [`SolidCheck::is_solid`] returns true.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct SolidCheck {
    /// Edges (m) with an odd number of triangles, in the order of their first use.
    pub open: Vec<[Vec3; 2]>,
    /// Edges (m) whose triangles run along them in the same direction, so that one of two faces is inverted.
    pub inconsistent: Vec<[Vec3; 2]>,
    /// Number of triangles that are at most 1e-9 times as thick as their longest edge.
    pub zero_area: usize,
    /// Number of positions with an infinite or NaN coordinate.
    pub not_finite: usize,
}

impl SolidCheck {
    /// Returns true if every edge has the same number of triangles in both directions.
    pub fn is_closed(&self) -> bool {
        self.open.is_empty() && self.inconsistent.is_empty()
    }

    /// Returns true if the surface is closed, consistently oriented, finite and free of zero-area triangles.
    pub fn is_solid(&self) -> bool {
        self.is_closed() && self.zero_area == 0 && self.not_finite == 0
    }
}

/// Checks the surface that `parts` form together.
///
/// Corners are welded if their positions are equal to the last bit; -0 equals 0. An edge that several sheets
/// share is valid if the same number of triangles runs along it in both directions.
///
/// ```
/// use burgeon_geometry::{SweepOptions, Section, Segment, solid, sweep};
/// use burgeon_scene::Part;
///
/// let mut path = Vec::new();
/// Segment::default().stations(Default::default(), &mut path)?;
/// let mut cup = Part::default();
/// let options = SweepOptions { end_cap: false, ..SweepOptions::default() };
/// sweep(&mut cup, &Section::rectangle(1.0, 1.0)?, &path, &options)?;
/// let report = solid::check([&cup]);
/// assert!(!report.is_closed());
/// assert_eq!(report.open.len(), 4);
/// # Ok::<(), burgeon_base::error::Error>(())
/// ```
pub fn check<'a>(parts: impl IntoIterator<Item = &'a Part>) -> SolidCheck {
    let mut found = SolidCheck::default();
    let mut points: Vec<Vec3> = Vec::new();
    let mut known: FxHashMap<[u32; 3], usize> = FxHashMap::default();
    let mut edges: Vec<SolidEdge> = Vec::new();
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
                    edges.push(SolidEdge { from, to, along: 0, against: 0 });
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

/// An edge with the number of triangles in each direction.
struct SolidEdge {
    from: usize,
    to: usize,
    along: usize,
    against: usize,
}

/// Returns true if a triangle is at most 1e-9 times as thick as its longest edge.
#[inline]
pub(super) fn is_flat([a, b, c]: [DVec3; 3]) -> bool {
    let longest = a.distance_squared(b).max(b.distance_squared(c)).max(c.distance_squared(a));
    (b - a).cross(c - a).length() <= longest * 1e-9
}

/// Result of [`clashes`]: the intersections of a surface with itself.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Clashes {
    /// Edges (m) shared by more than two triangles, in the order of their first use.
    pub crowded: Vec<[Vec3; 2]>,
    /// Pairs of coplanar triangles that overlap, numbered over all parts.
    pub on: Vec<[usize; 2]>,
    /// Pairs of triangles of which one passes through the other.
    pub through: Vec<[usize; 2]>,
}

impl Clashes {
    /// Returns true if the surface has no clashes.
    pub fn is_empty(&self) -> bool {
        self.crowded.is_empty() && self.on.is_empty() && self.through.is_empty()
    }
}

/// Finds self-intersections of more than `slack` (m) of the surface that `parts` form together.
///
/// Compares all triangles with intersecting bounding boxes in a sweep along x; not for large meshes.
///
/// ```
/// use burgeon_geometry::{solid, tube};
/// use burgeon_scene::Part;
/// use glam::DVec3;
///
/// let mut cross = Part::default();
/// tube(&mut cross, 4, (DVec3::NEG_X, 0.1), (DVec3::X, 0.1))?;
/// assert!(solid::clashes([&cross], 1e-4).is_empty());
/// tube(&mut cross, 4, (DVec3::NEG_Y, 0.1), (DVec3::Y, 0.1))?;
/// assert!(!solid::clashes([&cross], 1e-4).through.is_empty());
/// # Ok::<(), burgeon_base::error::Error>(())
/// ```
pub fn clashes<'a>(parts: impl IntoIterator<Item = &'a Part>, slack: f64) -> Clashes {
    let all: Vec<[DVec3; 3]> = parts.into_iter().flat_map(triangles).collect();
    let mut found = Clashes::default();
    let mut uses: FxHashMap<[[u32; 3]; 2], usize> = FxHashMap::default();
    for [a, b] in all.iter().flat_map(|&[a, b, c]| [[a, b], [b, c], [c, a]]) {
        let ends = [a, b].map(|at| (at.as_vec3() + Vec3::ZERO).to_array().map(f32::to_bits));
        let count = uses.entry([ends[0].min(ends[1]), ends[0].max(ends[1])]).or_default();
        *count += 1;
        if *count == 3 {
            found.crowded.push([a.as_vec3(), b.as_vec3()]);
        }
    }
    let low = |triangle: &[DVec3; 3]| triangle[0].min(triangle[1]).min(triangle[2]);
    let high = |triangle: &[DVec3; 3]| triangle[0].max(triangle[1]).max(triangle[2]);
    let mut order: Vec<usize> = (0..all.len()).collect();
    order.sort_by(|&a, &b| low(&all[a]).x.total_cmp(&low(&all[b]).x));
    for (rank, &a) in order.iter().enumerate() {
        let (least, most) = (low(&all[a]), high(&all[a]));
        for &b in order[rank + 1..].iter().take_while(|&&b| low(&all[b]).x <= most.x) {
            if low(&all[b]).cmpgt(most).any() || high(&all[b]).cmplt(least).any() {
                continue;
            }
            let pair = [a.min(b), a.max(b)];
            if lie_on(all[a], all[b], slack) {
                found.on.push(pair);
            } else if passes(all[a], all[b], slack) || passes(all[b], all[a], slack) {
                found.through.push(pair);
            }
        }
    }
    found
}

/// Returns true if two coplanar triangles have a common area that is wider than `slack` (m).
fn lie_on(one: [DVec3; 3], other: [DVec3; 3], slack: f64) -> bool {
    let normal = (one[1] - one[0]).cross(one[2] - one[0]).normalize_or_zero();
    if normal == DVec3::ZERO || other.iter().any(|at| normal.dot(*at - one[0]).abs() > slack / 2.0) {
        return false;
    }
    let mut ring = other.to_vec();
    for (index, &from) in one.iter().enumerate() {
        let inward = normal.cross(one[(index + 1) % 3] - from).normalize_or_zero();
        let inside = |at: DVec3| inward.dot(at - from) - slack;
        let mut kept = Vec::with_capacity(ring.len() + 1);
        for [a, b] in edges(&ring) {
            let [begin, end] = [a, b].map(inside);
            if begin > 0.0 {
                kept.push(a);
            }
            if (begin > 0.0) != (end > 0.0) {
                kept.push(a.lerp(b, begin / (begin - end)));
            }
        }
        ring = kept;
    }
    let area =
        ring.windows(2).map(|pair| (pair[0] - ring[0]).cross(pair[1] - ring[0])).sum::<DVec3>().length();
    area > slack * slack
}

/// Returns true if an edge of `one` passes through `other` by more than `slack` (m).
fn passes(one: [DVec3; 3], other: [DVec3; 3], slack: f64) -> bool {
    let normal = (other[1] - other[0]).cross(other[2] - other[0]).normalize_or_zero();
    (0..3).any(|side| {
        let (a, b) = (one[side], one[(side + 1) % 3]);
        let [from, to] = [a, b].map(|at| normal.dot(at - other[0]));
        if from.min(to) > -slack || from.max(to) < slack {
            return false;
        }
        let at = a.lerp(b, from / (from - to));
        (0..3).all(|side| {
            let (begin, end) = (other[side], other[(side + 1) % 3]);
            normal.cross(end - begin).normalize_or_zero().dot(at - begin) > slack
        })
    })
}

/// Returns the volume (m³) enclosed by `parts`; negative if they face inwards, undefined if they are open.
///
/// Method: the divergence theorem, as a sum of the signed tetrahedra between each triangle and one point.
pub fn volume<'a>(parts: impl IntoIterator<Item = &'a Part>) -> f64 {
    let mut apex = None;
    let mut sum = 0.0;
    for [a, b, c] in parts.into_iter().flat_map(triangles) {
        // A point of the surface loses fewer digits than the origin if the solid is far from the origin.
        let apex = *apex.get_or_insert(a);
        sum += (a - apex).dot((b - apex).cross(c - apex));
    }
    sum / 6.0
}

/// Returns the total area (m²) of all triangles.
pub fn area<'a>(parts: impl IntoIterator<Item = &'a Part>) -> f64 {
    parts.into_iter().flat_map(triangles).map(|[a, b, c]| (b - a).cross(c - a).length() / 2.0).sum()
}

fn triangles(part: &Part) -> impl Iterator<Item = [DVec3; 3]> {
    part.triangles.iter().map(|triangle| triangle.map(|corner| part.positions[corner as usize].as_dvec3()))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Returns the tetrahedron with corners at the origin and the three unit points, facing outwards.
    fn tetrahedron() -> Part {
        let positions = vec![Vec3::ZERO, Vec3::X, Vec3::Y, Vec3::Z];
        let triangles = vec![[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]].into();
        Part { positions, triangles, ..Part::default() }
    }

    #[test]
    fn a_tetrahedron_is_solid_and_has_its_volume_and_area() {
        let solid = tetrahedron();
        assert_eq!(check([&solid]), SolidCheck::default());
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
    fn triangles_that_lie_on_or_pass_through_others_are_found() {
        assert!(clashes([&tetrahedron()], 1e-3).is_empty());
        let moved = |by: Vec3| {
            let mut solid = tetrahedron();
            solid.positions.iter_mut().for_each(|at| *at += by);
            solid
        };
        let through = clashes([&tetrahedron(), &moved(Vec3::splat(0.1))], 1e-3);
        assert!(through.on.is_empty() && !through.through.is_empty() && through.crowded.is_empty());
        // Three faces of each solid overlap faces of the other.
        let twice = clashes([&tetrahedron(), &moved(Vec3::ZERO)], 1e-3);
        assert_eq!((twice.on.len(), twice.crowded.len()), (4, 6));
        let beside = clashes([&tetrahedron(), &moved(Vec3::X * 0.5)], 1e-3);
        assert_eq!(beside.on.len(), 2);
        assert!(clashes([&tetrahedron(), &moved(Vec3::X * 2.0)], 1e-3).is_empty());
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
        // A triangle that has collapsed to an edge has no area, but leaves no edge open.
        let mut solid = tetrahedron();
        solid.triangles.push([0, 0, 1]);
        let found = check([&solid]);
        assert!(found.zero_area == 1 && found.is_closed());
    }
}
