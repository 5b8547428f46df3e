//! Hausdorff distance between triangle meshes.

use std::cmp::Ordering;
use std::collections::BinaryHeap;

use glam::DVec3;

use super::cover::{MOST_COVERS, uncovered_parts};
use super::tree::{TriangleCorners, TriangleTree, distance_squared};

/// Tolerance of distances, as a part of them.
pub(super) const PART: f64 = 0.05;

/// Tolerance (m) of distances. With a smaller one, most of the time goes to the borders of windows, all as deep as each other.
pub(super) const NEAR: f64 = 0.2;

/// Largest number of boxes and parts of triangles that are divided for a distance.
const MOST: usize = 50_000;

/// Largest number of triangles whose parts that others cover are found for a distance, which takes up to a millisecond for each.
const MOST_COVERED: usize = 2000;

/// Part of a mesh, and an upper bound of the distance (m) of its points.
struct MeshPart {
    bound: f64,
    shape: PartShape,
}

enum PartShape {
    /// Triangles in a box of the tree.
    Box(usize),
    /// Part of a triangle.
    Triangle(TriangleCorners),
    /// Part of a triangle that no triangle of the other mesh covers.
    Uncovered(TriangleCorners),
}

impl PartialEq for MeshPart {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other) == Ordering::Equal
    }
}

impl Eq for MeshPart {}

impl PartialOrd for MeshPart {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl Ord for MeshPart {
    fn cmp(&self, other: &Self) -> Ordering {
        self.bound.total_cmp(&other.bound)
    }
}

/// Returns the larger of the two one-sided distances (m) between meshes, at least `known`; see [`one_sided`].
pub fn hausdorff(a: &TriangleTree, b: &TriangleTree, known: f64) -> f64 {
    one_sided(b, a, one_sided(a, b, known))
}

/// Returns the largest distance (m) of a point of `a` from `b`, or `known` if the distance is smaller. The result may be too small by
/// a twentieth of it and 20 cm.
///
/// If a mesh has no triangles, the distance is the diagonal of the other one. Method: triangles are divided while the upper bound
/// of their distances is larger than a distance that was found (Cignoni, Rocchini and Scopigno, "Metro: measuring error on
/// simplified surfaces", 1998, measure with samples instead). The distance from one triangle of `b` is convex, so it is largest in
/// a corner of a triangle of `a`.
///
/// ```
/// use burgeon_tiles::measure::{TriangleTree, one_sided};
/// use glam::DVec3;
///
/// let square = |height: f64| {
///     let at = |x: f64, y: f64| DVec3::new(x, y, height);
///     TriangleTree::new(vec![[at(0.0, 0.0), at(9.0, 0.0), at(9.0, 9.0)], [at(0.0, 0.0), at(9.0, 9.0), at(0.0, 9.0)]])
/// };
/// assert_eq!(one_sided(&square(0.0), &square(2.5), 0.0), 2.5);
/// ```
pub fn one_sided(a: &TriangleTree, b: &TriangleTree, known: f64) -> f64 {
    if a.triangles().is_empty() || b.triangles().is_empty() {
        return known.max(a.diagonal()).max(b.diagonal());
    }
    let mut search = DistanceSearch { a, b, largest: known, heap: BinaryHeap::new(), cover_searches: 0 };
    search.add_box(0);
    for _ in 0..MOST {
        let Some(MeshPart { bound, shape }) = search.heap.pop() else { break };
        if bound <= search.limit() {
            // This is the largest bound that is left.
            return search.largest;
        }
        search.divide(&shape);
    }
    search.heap.peek().map_or(search.largest, |part| search.largest.max(part.bound))
}

/// Search for the largest distance of a point of `a` from `b`.
struct DistanceSearch<'a> {
    a: &'a TriangleTree,
    b: &'a TriangleTree,
    /// Largest distance (m) that was found.
    largest: f64,
    /// Parts of `a`, with the largest bound first.
    heap: BinaryHeap<MeshPart>,
    /// Number of triangles of `a` whose parts that `b` covers were found.
    cover_searches: usize,
}

impl DistanceSearch<'_> {
    /// Returns the bound (m) up to which parts need not be divided.
    fn limit(&self) -> f64 {
        self.largest * (1.0 + PART) + NEAR
    }

    fn divide(&mut self, shape: &PartShape) {
        match *shape {
            PartShape::Box(index) => match self.a.halves(index) {
                Some(halves) => halves.into_iter().for_each(|half| self.add_box(half)),
                None => {
                    let own = self.a.in_box(index).iter();
                    own.for_each(|corners| self.add_triangle(*corners, PartShape::Triangle));
                }
            },
            PartShape::Triangle(corners) if self.cover_searches < MOST_COVERED => {
                match self.b.near(&corners, self.limit(), MOST_COVERS) {
                    Some(covers) => {
                        self.cover_searches += 1;
                        let left = uncovered_parts(&corners, &covers, self.limit());
                        left.into_iter().for_each(|corners| self.add_triangle(corners, PartShape::Uncovered));
                    }
                    None => self.add_quarters(corners, PartShape::Triangle),
                }
            }
            PartShape::Triangle(corners) | PartShape::Uncovered(corners) => {
                self.add_quarters(corners, PartShape::Uncovered)
            }
        }
    }

    fn add_box(&mut self, index: usize) {
        let corners = self.a.box_corners(index);
        let centre = corners[0].midpoint(corners[7]);
        let (bound, _) = self.bound(centre, &corners);
        if bound > self.limit() {
            self.heap.push(MeshPart { bound, shape: PartShape::Box(index) });
        }
    }

    fn add_quarters(&mut self, [p, q, r]: TriangleCorners, shape: fn(TriangleCorners) -> PartShape) {
        let [pq, qr, rp] = [p.midpoint(q), q.midpoint(r), r.midpoint(p)];
        for corners in [[p, pq, rp], [pq, q, qr], [rp, qr, r], [pq, qr, rp]] {
            self.add_triangle(corners, shape);
        }
    }

    fn add_triangle(&mut self, corners: TriangleCorners, shape: fn(TriangleCorners) -> PartShape) {
        let (bound, distance) = self.bound(corners.iter().sum::<DVec3>() / 3.0, &corners);
        self.largest = self.largest.max(distance);
        if bound > self.limit() {
            self.heap.push(MeshPart { bound, shape: shape(corners) });
        }
    }

    /// Returns an upper bound of the distances (m) of the points of a convex shape, and the distance of its centre, or 0 if the
    /// bound is small enough.
    fn bound(&self, centre: DVec3, corners: &[DVec3]) -> (f64, f64) {
        let squares = corners.iter().map(|corner| corner.distance_squared(centre));
        let radius = squares.fold(0.0, f64::max).sqrt();
        let enough = self.limit() - radius;
        let Some((distance, number)) = self.b.nearest(centre, enough) else { return (f64::INFINITY, 0.0) };
        if distance <= enough {
            return (distance + radius, 0.0);
        }
        let nearest = &self.b.triangles()[number];
        let squares = corners.iter().map(|corner| distance_squared(nearest, *corner));
        (squares.fold(0.0, f64::max).sqrt().min(distance + radius), distance)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn triangles() -> impl Strategy<Value = Vec<TriangleCorners>> {
        let point =
            (-10.0..10.0_f64, -10.0..10.0_f64, -10.0..10.0_f64).prop_map(|(x, y, z)| DVec3::new(x, y, z));
        prop::collection::vec(prop::array::uniform3(point), 1..12)
    }

    /// Returns the largest distance of samples of `a` from `b`.
    fn sampled(a: &TriangleTree, b: &TriangleTree) -> f64 {
        let mut most: f64 = 0.0;
        for [p, q, r] in a.triangles() {
            for i in 0..=20 {
                for j in 0..=20 - i {
                    let place = *p + (*q - *p) * (f64::from(i) / 20.0) + (*r - *p) * (f64::from(j) / 20.0);
                    let all = b.triangles().iter().map(|corners| distance_squared(corners, place).sqrt());
                    most = most.max(all.fold(f64::INFINITY, f64::min));
                }
            }
        }
        most
    }

    proptest! {
        #[test]
        fn no_sample_is_farther_than_the_distance_and_one_is_nearly_as_far(a in triangles(), b in triangles()) {
            let (a, b) = (TriangleTree::new(a), TriangleTree::new(b));
            let (distance, least) = (one_sided(&a, &b, 0.0), sampled(&a, &b));
            prop_assert!(distance * 1.05 + 0.2 + 1e-9 >= least, "{distance} {least}");
            prop_assert!(distance <= least * 1.02 + 2.0, "{distance} {least}");
            prop_assert_eq!(one_sided(&a, &b, 1000.0), 1000.0);
            prop_assert!(hausdorff(&a, &b, 0.0) >= distance);
        }

        #[test]
        fn a_mesh_that_is_moved_across_its_planes_has_the_distance_of_the_move(height in 0.0..50.0_f64, b in triangles()) {
            let flat = |z: f64| TriangleTree::new(vec![[DVec3::Z * z, DVec3::new(90.0, 0.0, z), DVec3::new(0.0, 90.0, z)]]);
            prop_assert!((hausdorff(&flat(0.0), &flat(height), 0.0) - height).abs() < 0.2001);
            let b = TriangleTree::new(b);
            prop_assert!(hausdorff(&b, &b, 0.0) < 1e-6);
        }
    }

    #[test]
    fn known_shapes_have_their_distance() {
        // The tip of a roof above the flat roof of a block.
        let at = |x: f64, y: f64, z: f64| DVec3::new(x, y, z);
        let (a, b, c, d) = (at(0.0, 0.0, 6.0), at(8.0, 0.0, 6.0), at(8.0, 8.0, 6.0), at(0.0, 8.0, 6.0));
        let tip = at(4.0, 4.0, 9.0);
        let flat = TriangleTree::new(vec![[a, b, c], [a, c, d]]);
        let roof = TriangleTree::new(vec![[a, b, tip], [b, c, tip], [c, d, tip], [d, a, tip]]);
        assert!((one_sided(&roof, &flat, 0.0) - 3.0).abs() < 0.46);
        // The middle of the flat roof is 3 m below the tip, and nearer to the slopes: 3 · cos(atan(3/4)).
        assert!((one_sided(&flat, &roof, 0.0) - 2.4).abs() < 0.4);
        let empty = TriangleTree::default();
        assert_eq!(hausdorff(&empty, &flat, 0.0), flat.diagonal());
        assert_eq!(hausdorff(&empty, &empty, 0.0), 0.0);
    }
}
