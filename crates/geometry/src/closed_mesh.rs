//! Closed triangle meshes as solids: inside and outside, nearest points, and hits of segments.

use std::borrow::Cow;
use std::cell::Cell;

use burgeon_base::error::{Error, Result};
use burgeon_base::{MemoryOwner, Stop};
use burgeon_scene::nearest_on_triangle;
use glam::{DVec2, DVec3};
use robust::{Coord, Coord3D, orient2d, orient3d};
use rstar::{AABB, PointDistance, RTree, RTreeObject, SelectionFunction};
use rustc_hash::FxHashMap;

/// Number of triangles between two checks for cancellation.
const STRETCH: usize = 4096;
/// Approximate memory of an indexed triangle (bytes), with that of the check.
const TRIANGLE_BYTES: usize = 400;

/// A closed triangle mesh with a spatial index of its triangles.
///
/// A place is inside if the surface winds around it, so solids that overlap in one mesh count as one solid, and so do
/// meshes whose triangles are all inverted. Results for places on the surface may be either.
#[derive(Debug, Clone)]
pub struct ClosedMesh {
    tree: RTree<ClosedMeshTriangle>,
    /// Bounding box (m).
    bounds: [DVec3; 2],
}

/// Corners of a triangle (m).
#[derive(Debug, Clone)]
struct ClosedMeshTriangle([DVec3; 3]);

impl RTreeObject for ClosedMeshTriangle {
    type Envelope = AABB<[f64; 3]>;

    fn envelope(&self) -> Self::Envelope {
        let [a, b, c] = self.0;
        AABB::from_corners(a.min(b).min(c).to_array(), a.max(b).max(c).to_array())
    }
}

impl PointDistance for ClosedMeshTriangle {
    fn distance_2(&self, place: &[f64; 3]) -> f64 {
        let place = DVec3::from_array(*place);
        nearest_on_triangle(place, self.0).distance_squared(place)
    }
}

impl ClosedMesh {
    /// Indexes triangles (m), counter-clockwise seen from outside.
    ///
    /// Corners are welded if their positions are equal to the last bit. Fails if there are no triangles, if a coordinate
    /// is not finite, or if an edge does not have the same number of triangles in both directions.
    ///
    /// ```
    /// use burgeon_geometry::ClosedMesh;
    /// use glam::DVec3;
    ///
    /// let [a, b, c, d] = [DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::Z];
    /// let solid = ClosedMesh::new(vec![[a, c, b], [a, b, d], [b, c, d], [c, a, d]])?;
    /// assert!(solid.contains(DVec3::splat(0.1)) && !solid.contains(DVec3::ONE));
    /// assert_eq!(solid.hit(DVec3::new(0.2, 0.2, -1.0), DVec3::new(0.2, 0.2, 1.0)), Some(0.5));
    /// assert!(ClosedMesh::new(vec![[a, c, b], [a, b, d], [b, c, d]]).is_err());
    /// # Ok::<(), burgeon_base::Error>(())
    /// ```
    pub fn new(triangles: Vec<[DVec3; 3]>) -> Result<Self> {
        MemoryOwner::ensure_room(triangles.len().saturating_mul(TRIANGLE_BYTES))?;
        let Some([first, ..]) = triangles.first() else {
            return Err(Error::argument("the mesh has no triangles").help("give a solid that has a surface"));
        };
        if let Some(place) = triangles.iter().flatten().find(|place| !place.is_finite()) {
            return Err(Error::argument(format!("a point of the mesh is {place}")).help("give finite points"));
        }
        check_edges(&triangles)?;
        let bounds = triangles
            .iter()
            .flatten()
            .fold([*first; 2], |[low, high], place| [low.min(*place), high.max(*place)]);
        Ok(Self { tree: RTree::bulk_load(triangles.into_iter().map(ClosedMeshTriangle).collect()), bounds })
    }

    /// Returns the minimum and maximum corner (m) of the bounding box.
    pub fn bounds(&self) -> [DVec3; 2] {
        self.bounds
    }

    /// Returns the number of triangles.
    pub fn triangles(&self) -> usize {
        self.tree.size()
    }

    /// Returns true if a place (m) is inside.
    ///
    /// Method: the winding number as the signed number of triangles above the place, by exact predicates; a place below
    /// an edge is moved by an infinitesimal distance.
    pub fn contains(&self, place: DVec3) -> bool {
        let [low, high] = self.bounds;
        if !(place.cmpge(low).all() && place.cmple(high).all()) {
            return false;
        }
        let column = AABB::from_corners(place.to_array(), place.with_z(high.z).to_array());
        let above = self.tree.locate_in_envelope_intersecting(&column);
        above.map(|triangle| crossing_above(triangle.0, place)).sum::<i32>() != 0
    }

    /// Returns the point (m) of the surface that is nearest to a place (m), with the normal of a triangle at this point.
    pub fn nearest(&self, place: DVec3) -> Option<(DVec3, DVec3)> {
        let ClosedMeshTriangle(corners) = self.tree.nearest_neighbor(&place.to_array())?;
        let [a, b, c] = *corners;
        Some((nearest_on_triangle(place, *corners), (b - a).cross(c - a).normalize_or_zero()))
    }

    /// Returns the share of the segment between two places (m) at which it meets the surface first; `None` if it does
    /// not.
    ///
    /// Method: S. Woop, C. Benthin and I. Wald, "Watertight ray/triangle intersection", 2013.
    pub fn hit(&self, from: DVec3, to: DVec3) -> Option<f64> {
        let axis = LongestAxis::of(to - from)?;
        let selection = AlongSegment::new(from, to, 1.0);
        let mut best = None;
        for triangle in self.tree.locate_with_selection_function(&selection) {
            if let Some(share) = axis.share(triangle.0.map(|corner| corner - from))
                && share <= selection.nearest.get()
            {
                selection.nearest.set(share);
                best = Some(share);
            }
        }
        best
    }
}

/// Fails if an edge does not have the same number of triangles in both directions.
fn check_edges(triangles: &[[DVec3; 3]]) -> Result<()> {
    let mut known: FxHashMap<[u64; 3], u32> = FxHashMap::default();
    let mut places: Vec<DVec3> = Vec::new();
    // Index of each edge in `edges`.
    let mut numbers: FxHashMap<[u32; 2], usize> = FxHashMap::default();
    let mut edges: Vec<([u32; 2], i32)> = Vec::new();
    for (number, triangle) in triangles.iter().enumerate() {
        if number.is_multiple_of(STRETCH) {
            Stop::check_current()?;
        }
        let corners = triangle.map(|place| {
            // Adding 0 turns -0 into 0.
            let bits = (place + DVec3::ZERO).to_array().map(f64::to_bits);
            *known.entry(bits).or_insert_with(|| {
                places.push(place);
                u32::try_from(places.len() - 1).unwrap_or(u32::MAX)
            })
        });
        for side in 0..3 {
            let (from, to) = (corners[side], corners[(side + 1) % 3]);
            let edge = [from.min(to), from.max(to)];
            let index = *numbers.entry(edge).or_insert_with(|| {
                edges.push((edge, 0));
                edges.len() - 1
            });
            edges[index].1 += (to > from) as i32 - (to < from) as i32;
        }
    }
    let mut open = edges.iter().filter(|(_, balance)| *balance != 0).map(|(edge, _)| *edge);
    let Some([from, to]) = open.next() else { return Ok(()) };
    let [from, to] = [from, to].map(|corner| {
        let [x, y, z] = places[corner as usize].to_array();
        format!("{{{x:.3}, {y:.3}, {z:.3}}}")
    });
    let more = open.count();
    let count =
        if more == 0 { Cow::Borrowed("an open edge") } else { format!("{} open edges", more + 1).into() };
    Err(Error::argument(format!("the mesh has {count}, such as from {from} to {to} (m)"))
        .help("close the surface, with caps and without gaps, and orient all faces outwards"))
}

/// Returns 1 if the triangle is above `place` and faces up, -1 if it is above and faces down, and otherwise 0.
fn crossing_above([a, b, c]: [DVec3; 3], place: DVec3) -> i32 {
    let at = place.truncate();
    let [ground_a, ground_b, ground_c] = [a, b, c].map(DVec3::truncate);
    let sides =
        [(ground_a, ground_b), (ground_b, ground_c), (ground_c, ground_a)].map(|(p, q)| side(p, q, at));
    let facing = match sides {
        [1, 1, 1] => 1,
        [-1, -1, -1] => -1,
        _ => return 0,
    };
    let [a, b, c, at] = [a, b, c, place].map(|it| Coord3D { x: it.x, y: it.y, z: it.z });
    // Positive if `place` is below the plane of a triangle that faces up.
    let below = orient3d(a, b, c, at) * f64::from(facing);
    if below > 0.0 { facing } else { 0 }
}

/// Returns 1 if `place` is on the left of the line, -1 on the right. For a place on the line, the result is that of a place
/// at an infinitesimal distance, first along x, and along y by less; 0 if the line is a point.
fn side(from: DVec2, to: DVec2, place: DVec2) -> i32 {
    let [a, b, at] = [from, to, place].map(|it| Coord { x: it.x, y: it.y });
    let sign = |number: f64| (number > 0.0) as i32 - (number < 0.0) as i32;
    let signs = [orient2d(a, b, at), from.y - to.y, to.x - from.x].map(sign);
    signs.into_iter().find(|sign| *sign != 0).unwrap_or(0)
}

/// Direction of a segment, sheared so that its longest axis is z.
struct LongestAxis {
    axes: [usize; 3],
    shear: DVec2,
    /// Length of the segment along its longest axis.
    length: f64,
}

impl LongestAxis {
    /// Returns the axis of a segment (m); `None` if it has no length.
    fn of(way: DVec3) -> Option<Self> {
        let size = way.abs();
        let z = if size.x > size.y.max(size.z) {
            0
        } else if size.y > size.z {
            1
        } else {
            2
        };
        let axes = [(z + 1) % 3, (z + 2) % 3, z];
        let length = way[z];
        let shear = DVec2::new(way[axes[0]], way[axes[1]]) / length;
        (length != 0.0 && shear.is_finite()).then_some(Self { axes, shear, length })
    }

    /// Returns the share of the segment at which it meets a triangle, whose corners are relative to the start.
    fn share(&self, corners: [DVec3; 3]) -> Option<f64> {
        let [x, y, z] = self.axes;
        // Equal for triangles that share an edge, so that no segment passes between them.
        let [a, b, c] = corners.map(|corner| DVec2::new(corner[x], corner[y]) - self.shear * corner[z]);
        let weights = [c.perp_dot(b), a.perp_dot(c), b.perp_dot(a)];
        if weights.iter().any(|weight| *weight < 0.0) && weights.iter().any(|weight| *weight > 0.0) {
            return None;
        }
        let sum: f64 = weights.iter().sum();
        let along: f64 = weights.iter().zip(corners).map(|(weight, corner)| weight * corner[z]).sum();
        let share = along / (sum * self.length);
        (0.0..=1.0).contains(&share).then_some(share)
    }
}

/// Selection of the boxes that a segment meets before its nearest hit.
pub struct AlongSegment {
    from: DVec3,
    way: DVec3,
    /// Share of the segment at which the nearest hit is.
    pub nearest: Cell<f64>,
}

impl AlongSegment {
    /// Creates the selection of the boxes that the segment between two places (m) meets up to a share of it.
    pub fn new(from: DVec3, to: DVec3, nearest: f64) -> Self {
        Self { from, way: to - from, nearest: Cell::new(nearest) }
    }

    /// Returns the share of the segment at which it enters a box, 0 if it begins inside; `None` if it meets the box only
    /// after the nearest hit.
    pub fn entry(&self, [low, high]: [DVec3; 2]) -> Option<f64> {
        let (mut enters, mut leaves) = (0.0_f64, self.nearest.get());
        for axis in 0..3 {
            let (from, way) = (self.from[axis], self.way[axis]);
            if way == 0.0 {
                if !(low[axis]..=high[axis]).contains(&from) {
                    return None;
                }
                continue;
            }
            let [one, two] = [low[axis], high[axis]].map(|bound| (bound - from) / way);
            enters = enters.max(one.min(two));
            leaves = leaves.min(one.max(two));
        }
        // Rounding must not lose a segment that touches the box.
        (enters <= leaves + 1e-12 * (1.0 + enters.abs())).then_some(enters)
    }
}

impl<T: RTreeObject<Envelope = AABB<[f64; 3]>>> SelectionFunction<T> for &AlongSegment {
    fn should_unpack_parent(&self, envelope: &AABB<[f64; 3]>) -> bool {
        self.entry([envelope.lower(), envelope.upper()].map(DVec3::from_array)).is_some()
    }
}

#[cfg(test)]
mod tests {
    use burgeon_base::random::Stream;

    use super::*;

    /// Returns the triangles of a torus around the z axis, with radii 3 m and 1 m.
    fn torus(around: usize, along: usize, center: DVec3) -> Vec<[DVec3; 3]> {
        let turn = |part: usize, of: usize| (part % of) as f64 / of as f64 * std::f64::consts::TAU;
        let at = |i: usize, j: usize| {
            let (ring, tube) = (turn(i, around), turn(j, along));
            let reach = 3.0 + tube.cos();
            center + DVec3::new(reach * ring.cos(), reach * ring.sin(), tube.sin())
        };
        let quads = (0..around).flat_map(|i| (0..along).map(move |j| (i, j)));
        let corners = quads.map(|(i, j)| [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)]);
        corners.flat_map(|[a, b, c, d]| [[a, b, c], [a, c, d]]).collect()
    }

    /// Returns the triangles of a box.
    fn cuboid(low: DVec3, high: DVec3) -> Vec<[DVec3; 3]> {
        let corner =
            |number: usize| DVec3::from_array([0, 1, 2].map(|axis| [low, high][number >> axis & 1][axis]));
        let faces = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
        faces
            .map(|face| face.map(corner))
            .into_iter()
            .flat_map(|[a, b, c, d]| [[a, b, c], [a, c, d]])
            .collect()
    }

    /// Returns random places in a cube with sides of this length (m).
    fn places(seed: u64, count: usize, side: f64) -> Vec<DVec3> {
        let mut stream = Stream::new(seed);
        (0..count).map(|_| DVec3::from_array([0; 3].map(|_| (stream.uniform() - 0.5) * side))).collect()
    }

    /// Returns the winding number of a mesh around a place as the sum of solid angles (van Oosterom and Strackee, 1983).
    fn solid_angles(triangles: &[[DVec3; 3]], place: DVec3) -> f64 {
        let angle = |triangle: &[DVec3; 3]| {
            let [a, b, c] = triangle.map(|corner| corner - place);
            let [la, lb, lc] = [a, b, c].map(DVec3::length);
            let below = la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb;
            2.0 * a.dot(b.cross(c)).atan2(below)
        };
        triangles.iter().map(angle).sum::<f64>() / (4.0 * std::f64::consts::PI)
    }

    #[test]
    fn a_place_is_inside_if_the_solid_angles_add_up_to_the_full_sphere() {
        let mut inverted = torus(9, 5, DVec3::ZERO);
        inverted.iter_mut().for_each(|triangle| triangle.swap(1, 2));
        let twice = [torus(17, 11, DVec3::ZERO), torus(13, 8, DVec3::new(1.0, 0.5, 0.3))].concat();
        let mut counts = [0; 2];
        for (seed, triangles) in (0..).zip([torus(24, 16, DVec3::ZERO), inverted, twice]) {
            let mesh = ClosedMesh::new(triangles.clone()).unwrap();
            for place in places(seed, 2000, 9.0) {
                let expected = solid_angles(&triangles, place).abs() > 0.5;
                assert_eq!(mesh.contains(place), expected, "{place}");
                counts[usize::from(expected)] += 1;
            }
        }
        assert!(counts[0] > 1000 && counts[1] > 400, "{counts:?}");
    }

    #[test]
    fn a_place_below_corners_edges_and_upright_faces_is_inside_or_outside_as_its_neighbours() {
        let hole = cuboid(DVec3::splat(1.0), DVec3::splat(2.0)).into_iter().map(|[a, b, c]| [a, c, b]);
        let triangles: Vec<_> = cuboid(DVec3::ZERO, DVec3::splat(3.0)).into_iter().chain(hole).collect();
        let mesh = ClosedMesh::new(triangles).unwrap();
        // Each place is in the same column as corners and edges, and half way between the faces.
        for number in 0..5 * 5 * 5 {
            let at = [number % 5, number / 5 % 5, number / 25].map(|step| f64::from(step) * 0.5 + 0.5);
            let on_surface =
                at.iter().any(|it| *it == 1.0 || *it == 2.0) && at.iter().all(|it| (1.0..=2.0).contains(it));
            let is_hollow = at.iter().all(|it| *it == 1.5);
            if !on_surface {
                assert_eq!(mesh.contains(DVec3::from_array(at)), !is_hollow, "{at:?}");
            }
        }
        assert!(!mesh.contains(DVec3::new(0.0, 0.0, -1.0)) && !mesh.contains(DVec3::new(3.5, 1.0, 1.0)));
    }

    #[test]
    fn the_nearest_point_and_the_first_hit_are_those_of_a_scan() {
        let triangles = torus(20, 12, DVec3::new(0.2, 0.1, 0.0));
        let mesh = ClosedMesh::new(triangles.clone()).unwrap();
        let mut hits = 0;
        for pair in places(7, 4000, 12.0).chunks_exact(2) {
            let [from, to] = [pair[0], pair[1]];
            let scanned =
                triangles.iter().map(|triangle| nearest_on_triangle(from, *triangle).distance(from));
            let (nearest, normal) = mesh.nearest(from).unwrap();
            assert!((nearest.distance(from) - scanned.fold(f64::INFINITY, f64::min)).abs() < 1e-12);
            assert!((normal.length() - 1.0).abs() < 1e-12);
            // The share of the plane's distance, if its barycentric coordinates are positive.
            let crossing = |[a, b, c]: &[DVec3; 3]| {
                let normal = (*b - *a).cross(*c - *a);
                let share = (*a - from).dot(normal) / (to - from).dot(normal);
                let at = from.lerp(to, share);
                let inside = [[a, b], [b, c], [c, a]]
                    .iter()
                    .all(|[p, q]| (**q - **p).cross(at - **p).dot(normal) >= 0.0);
                (inside && (0.0..=1.0).contains(&share)).then_some(share)
            };
            let expected = triangles.iter().filter_map(crossing).reduce(f64::min);
            match (mesh.hit(from, to), expected) {
                (Some(share), Some(expected)) => {
                    assert!((share - expected).abs() < 1e-9, "{share} {expected}")
                }
                (share, expected) => assert_eq!(share, expected),
            }
            hits += u32::from(expected.is_some());
        }
        assert!((400..1900).contains(&hits), "{hits}");
    }

    #[test]
    fn no_segment_passes_between_triangles() {
        let mesh = ClosedMesh::new(torus(16, 8, DVec3::ZERO)).unwrap();
        // From the centre line of the tube through each corner and through the middle of each edge.
        for triangle in torus(16, 8, DVec3::ZERO) {
            for side in 0..3 {
                for to in [triangle[side], triangle[side].midpoint(triangle[(side + 1) % 3])] {
                    let from = to.with_z(0.0).normalize() * 3.0;
                    assert!(mesh.hit(from, from + (to - from) * 1.5).is_some(), "{to}");
                }
            }
        }
        let middle = DVec3::new(3.0, 0.0, 0.0);
        assert_eq!(mesh.hit(middle, middle), None);
    }

    #[test]
    fn an_open_or_unsound_mesh_is_refused() {
        let all = torus(6, 5, DVec3::ZERO);
        let of = |triangles: Vec<_>| ClosedMesh::new(triangles).unwrap_err().message().to_owned();
        assert!(of(all[1..].to_vec()).starts_with("the mesh has 3 open edges, such as from {"));
        let mut turned = all.clone();
        turned[4].swap(0, 1);
        assert!(of(turned).starts_with("the mesh has 3 open edges"));
        let mut wrong = all;
        wrong[3][1].y = f64::NAN;
        assert!(of(wrong).starts_with("a point of the mesh is"));
        assert_eq!(of(Vec::new()), "the mesh has no triangles");
    }
}
