//! Polygons of adjacent coplanar triangles.

use burgeon_scene::SurfaceMeaning;
use glam::DVec3;
use rustc_hash::FxHashMap;

/// Polygon: its outer ring and its holes, as numbers of points.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Face {
    pub(super) rings: Vec<Vec<u32>>,
    pub(super) meaning: Option<SurfaceMeaning>,
}

/// Triangle with three different corners.
pub(super) type Triangle = ([u32; 3], Option<SurfaceMeaning>);

/// Minimum cosine of the angle between the normals of triangles in one polygon.
const SAME_WAY: f64 = 0.999;
/// Marker of an edge that several triangles have in the same direction.
const MANY: u32 = u32::MAX;

/// Triangles on each side of an edge, by the edge's ends in the order of the triangle.
pub(super) struct TriangleEdges(FxHashMap<(u32, u32), u32>);

impl TriangleEdges {
    pub(super) fn of(triangles: &[Triangle]) -> Self {
        let mut edges = FxHashMap::default();
        for (number, (corners, _)) in (0..).zip(triangles) {
            for (a, b) in sides(*corners) {
                edges.entry((a, b)).and_modify(|known| *known = MANY).or_insert(number);
            }
        }
        Self(edges)
    }

    /// Returns true if each edge has exactly one triangle on each side.
    pub(super) fn are_closed(&self) -> bool {
        !self.0.is_empty() && self.0.iter().all(|((a, b), of)| *of != MANY && self.0.contains_key(&(*b, *a)))
    }

    /// Returns the triangle on the other side of the edge from `a` to `b`.
    fn neighbor(&self, (a, b): (u32, u32)) -> Option<u32> {
        let there = self.0.get(&(a, b)).is_some_and(|of| *of != MANY);
        self.0.get(&(b, a)).copied().filter(|of| there && *of != MANY)
    }
}

fn sides([a, b, c]: [u32; 3]) -> [(u32, u32); 3] {
    [(a, b), (b, c), (c, a)]
}

/// Computes the volume (m³) that triangles enclose.
pub(super) fn volume(points: &[DVec3], triangles: &[Triangle]) -> f64 {
    let Some(origin) = points.first() else { return 0.0 };
    let corner = |index: u32| points[index as usize] - *origin;
    triangles.iter().map(|([a, b, c], _)| corner(*a).dot(corner(*b).cross(corner(*c))) / 6.0).sum()
}

/// Merges `triangles` into polygons. Points within `near` (m) of a plane belong to it. Triangles without area are
/// omitted unless they are part of a polygon.
pub(super) fn faces(points: &[DVec3], triangles: &[Triangle], edges: &TriangleEdges, near: f64) -> Vec<Face> {
    let mut finder = FaceFinder { points, triangles, edges, near, group_of: vec![None; triangles.len()] };
    let mut faces = Vec::new();
    for number in 0..triangles.len() {
        if finder.group_of[number].is_none()
            && let Some((plane, group)) = finder.gather(number)
        {
            match finder.polygon(&group, plane.normal) {
                Some(face) => faces.push(face),
                None => faces.extend(group.iter().filter_map(|of| finder.separate_face(*of))),
            }
        }
    }
    faces
}

struct FaceFinder<'a> {
    points: &'a [DVec3],
    triangles: &'a [Triangle],
    edges: &'a TriangleEdges,
    near: f64,
    /// For each triangle, the first triangle of its polygon.
    group_of: Vec<Option<usize>>,
}

#[derive(Clone, Copy)]
struct FacePlane {
    normal: DVec3,
    distance: f64,
}

impl FaceFinder<'_> {
    fn corners(&self, number: usize) -> [DVec3; 3] {
        self.triangles[number].0.map(|corner| self.points[corner as usize])
    }

    /// Returns the normal of a triangle, or `None` if the triangle is thinner than `near` (m).
    fn normal(&self, number: usize) -> Option<DVec3> {
        let [a, b, c] = self.corners(number);
        let across = (b - a).cross(c - a);
        let longest = a.distance(b).max(b.distance(c)).max(c.distance(a));
        (across.length() > longest * self.near).then(|| across.normalize_or_zero())
    }

    /// Collects triangle `number` and the triangles in its plane that are connected to it. Returns `None` if that
    /// triangle has no plane.
    fn gather(&mut self, number: usize) -> Option<(FacePlane, Vec<usize>)> {
        let normal = self.normal(number)?;
        let plane = FacePlane { normal, distance: normal.dot(self.corners(number)[0]) };
        self.group_of[number] = Some(number);
        let mut group = vec![number];
        let mut next = 0;
        while let Some(&of) = group.get(next) {
            next += 1;
            for side in sides(self.triangles[of].0) {
                let Some(other) = self.edges.neighbor(side).map(|other| other as usize) else { continue };
                if self.group_of[other].is_none()
                    && self.triangles[other].1 == self.triangles[number].1
                    && self.lies_in(other, plane)
                {
                    self.group_of[other] = Some(number);
                    group.push(other);
                }
            }
        }
        Some((plane, group))
    }

    fn lies_in(&self, number: usize, plane: FacePlane) -> bool {
        let near = |point: DVec3| (plane.normal.dot(point) - plane.distance).abs() <= self.near;
        self.corners(number).into_iter().all(near)
            && self.normal(number).is_none_or(|normal| normal.dot(plane.normal) > SAME_WAY)
    }

    /// Returns the polygon of a group, or `None` if its border touches itself or has several outer rings.
    fn polygon(&self, group: &[usize], normal: DVec3) -> Option<Face> {
        let first = self.group_of[*group.first()?];
        let mut next: FxHashMap<u32, u32> = FxHashMap::default();
        let mut starts = Vec::new();
        for number in group {
            for side in sides(self.triangles[*number].0) {
                let inside = self.edges.neighbor(side).is_some_and(|it| self.group_of[it as usize] == first);
                if !inside {
                    if next.insert(side.0, side.1).is_some() {
                        return None;
                    }
                    starts.push(side.0);
                }
            }
        }
        let (mut outer, mut holes) = (None, Vec::new());
        for start in starts {
            let mut ring = Vec::new();
            let mut at = start;
            while let Some(after) = next.remove(&at) {
                ring.push(at);
                at = after;
            }
            if ring.is_empty() {
                continue;
            }
            if at != start || ring.len() < 3 {
                return None;
            }
            if self.area(&ring, normal) < 0.0 {
                holes.push(ring);
            } else if outer.replace(ring).is_some() {
                return None;
            }
        }
        let rings = std::iter::once(outer?).chain(holes).collect();
        Some(Face { rings, meaning: self.triangles[group[0]].1 })
    }

    fn area(&self, ring: &[u32], normal: DVec3) -> f64 {
        let point = |index: u32| self.points[index as usize] - self.points[ring[0] as usize];
        let pairs = ring.iter().zip(ring.iter().cycle().skip(1));
        pairs.map(|(a, b)| point(*a).cross(point(*b)).dot(normal) / 2.0).sum()
    }

    /// Returns a triangle as a separate polygon.
    fn separate_face(&self, number: usize) -> Option<Face> {
        let (corners, meaning) = self.triangles[number];
        self.normal(number).map(|_| Face { rings: vec![corners.to_vec()], meaning })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn points(flat: &[[f64; 2]]) -> Vec<DVec3> {
        flat.iter().map(|[x, y]| DVec3::new(*x, *y, 0.0)).collect()
    }

    fn find_faces(points: &[DVec3], triangles: &[[u32; 3]]) -> Vec<Face> {
        let triangles: Vec<Triangle> = triangles.iter().map(|corners| (*corners, None)).collect();
        faces(points, &triangles, &TriangleEdges::of(&triangles), 1e-3)
    }

    #[test]
    fn a_square_with_a_hole_is_one_polygon_of_two_rings() {
        let points = points(&[
            [0.0, 0.0],
            [4.0, 0.0],
            [4.0, 4.0],
            [0.0, 4.0],
            [1.0, 1.0],
            [3.0, 1.0],
            [3.0, 3.0],
            [1.0, 3.0],
        ]);
        let around: Vec<[u32; 3]> = (0..4)
            .flat_map(|at| {
                let to = (at + 1) % 4;
                [[at, to, at + 4], [to, to + 4, at + 4]]
            })
            .collect();
        let found = find_faces(&points, &around);
        assert_eq!(found.len(), 1);
        assert_eq!(found[0].rings.iter().map(Vec::len).collect::<Vec<_>>(), [4, 4]);
        assert_eq!(found[0].rings[0], [0, 1, 2, 3]);
    }

    #[test]
    fn what_meets_at_a_corner_alone_or_bends_is_several_polygons() {
        let mut points = points(&[[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0], [2.0, 2.0], [1.0, 2.0]]);
        assert_eq!(find_faces(&points, &[[0, 1, 2], [0, 2, 3], [2, 4, 5]]).len(), 2);
        points[3].z = 0.5;
        assert_eq!(find_faces(&points, &[[0, 1, 2], [0, 2, 3]]).len(), 2);
    }
}
