//! Shapes with fewer triangles.

use std::cmp::{Ordering, Reverse};
use std::collections::BinaryHeap;

use burgeon_base::error::{Error, Result};
use burgeon_base::{MemoryOwner, Stop};
use glam::DVec3;
use rustc_hash::FxHashMap;

use super::merge::merge_coplanar;
use crate::Shape;
use crate::mesh::{PolygonFace, PolygonMesh};
use crate::style::SharedStyle;

/// Weight of borders of the shape and between styles, relative to faces.
const BORDER: f64 = 100.0;
/// Least cosine of the angle by which a collapse turns a triangle.
const LEAST_TURN: f64 = 0.3;
/// Number of collapses between two checks for cancellation.
const STRETCH: usize = 1024;

impl Shape {
    /// Returns the shape with about `share` of its triangles, of the same points, and the share that remains.
    ///
    /// A closed shape stays closed. Borders and edges between faces of different styles keep their form as long as
    /// possible. Fails unless `share` is above 0 and at most 1.
    ///
    /// Method: M. Garland and P. Heckbert, "Surface simplification using quadric error metrics", 1997, with collapses to
    /// points of the mesh.
    pub fn reduce(&self, share: f64) -> Result<(Self, f64)> {
        if !(share > 0.0 && share <= 1.0) {
            return Err(Error::argument(format!("the share of triangles that remain is {share}"))
                .help("use a share above 0 and at most 1, such as 0.25"));
        }
        let mesh = self.mesh();
        let (mut triangles, mut styles): (Vec<[u32; 3]>, Vec<&SharedStyle>) = (Vec::new(), Vec::new());
        for face in &mesh.faces {
            Stop::check_current()?;
            for corners in mesh.triangles(face)? {
                triangles.push(corners);
                styles.push(&face.style);
            }
        }
        MemoryOwner::ensure_room(triangles.len().saturating_mul(400))?;
        let count = triangles.len();
        #[allow(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            clippy::cast_precision_loss,
            reason = "a share of a count"
        )]
        let target = (count as f64 * share).ceil() as usize;
        let mut reduction = Reduction::new(&mesh, triangles, &styles);
        reduction.run(target)?;
        let kept =
            reduction.triangles.iter().zip(&styles).filter_map(|(triangle, style)| {
                triangle.as_ref().map(|corners| PolygonFace::of(corners, style))
            });
        let faces: Vec<PolygonFace> = kept.collect();
        #[allow(clippy::cast_precision_loss, reason = "counts below 2^53")]
        let rest = faces.len() as f64 / count.max(1) as f64;
        if faces.len() == count {
            return Ok((self.clone(), 1.0));
        }
        let reduced = merge_coplanar(&PolygonMesh::new(mesh.points.clone(), faces))?;
        Ok((Self::of_mesh(reduced, self.scope().axes), rest))
    }
}

/// The sum of squared distances to planes, as a symmetric matrix: xx, xy, xz, xw, yy, yz, yw, zz, zw, ww.
#[derive(Debug, Clone, Copy, Default)]
struct Quadric([f64; 10]);

impl Quadric {
    /// Creates the quadric of the plane through a point with a unit normal.
    fn of(normal: DVec3, at: DVec3, weight: f64) -> Self {
        let [x, y, z, w] = [normal.x, normal.y, normal.z, -normal.dot(at)];
        let values = [x * x, x * y, x * z, x * w, y * y, y * z, y * w, z * z, z * w, w * w];
        Self(values.map(|value| value * weight))
    }

    fn add(&mut self, other: &Self) {
        self.0.iter_mut().zip(other.0).for_each(|(own, value)| *own += value);
    }

    /// Returns the weighted sum of squared distances of a position.
    fn at(&self, p: DVec3) -> f64 {
        let [xx, xy, xz, xw, yy, yz, yw, zz, zw, ww] = self.0;
        let square = xx * p.x * p.x + yy * p.y * p.y + zz * p.z * p.z;
        let mixed = xy * p.x * p.y + xz * p.x * p.z + yz * p.y * p.z;
        (square + 2.0 * (mixed + xw * p.x + yw * p.y + zw * p.z) + ww).max(0.0)
    }
}

/// A collapse of a point to another one, in the order of its cost.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Collapse {
    cost: f64,
    from: u32,
    to: u32,
    /// Numbers of changes of both points when the cost was computed.
    versions: [u32; 2],
}

impl Eq for Collapse {}

impl PartialOrd for Collapse {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl Ord for Collapse {
    fn cmp(&self, other: &Self) -> Ordering {
        let order =
            self.cost.total_cmp(&other.cost).then(self.from.cmp(&other.from)).then(self.to.cmp(&other.to));
        order.then(self.versions.cmp(&other.versions))
    }
}

/// Triangles of a mesh while their number decreases.
struct Reduction {
    /// Positions (m), relative to the first point.
    points: Vec<DVec3>,
    /// Triangles; `None` after they collapsed.
    triangles: Vec<Option<[u32; 3]>>,
    /// Triangles around each point.
    around: Vec<Vec<u32>>,
    quadrics: Vec<Quadric>,
    versions: Vec<u32>,
    queue: BinaryHeap<Reverse<Collapse>>,
    alive: usize,
}

impl Reduction {
    #[allow(clippy::cast_possible_truncation, reason = "a mesh has fewer than 2^32 triangles")]
    fn new(mesh: &PolygonMesh, triangles: Vec<[u32; 3]>, styles: &[&SharedStyle]) -> Self {
        let base = mesh.points.first().copied().unwrap_or_default();
        let points: Vec<DVec3> = mesh.points.iter().map(|at| *at - base).collect();
        let mut quadrics = vec![Quadric::default(); points.len()];
        let mut around: Vec<Vec<u32>> = vec![Vec::new(); points.len()];
        let mut sides: FxHashMap<[u32; 2], usize> = FxHashMap::default();
        for (number, [a, b, c]) in triangles.iter().copied().enumerate() {
            let [p, q, r] = [a, b, c].map(|point| points[point as usize]);
            let area = (q - p).cross(r - p);
            let quadric = Quadric::of(area.normalize_or_zero(), p, area.length());
            for point in [a, b, c] {
                quadrics[point as usize].add(&quadric);
                around[point as usize].push(number as u32);
            }
            [[a, b], [b, c], [c, a]].into_iter().for_each(|edge| {
                sides.insert(edge, number);
            });
        }
        for (number, [a, b, c]) in triangles.iter().copied().enumerate() {
            let [p, q, r] = [a, b, c].map(|point| points[point as usize]);
            let normal = (q - p).cross(r - p).normalize_or_zero();
            for [from, to] in [[a, b], [b, c], [c, a]] {
                let other = sides.get(&[to, from]);
                if other.is_none_or(|other| styles[*other] != styles[number]) {
                    let along = points[to as usize] - points[from as usize];
                    let wall = along.cross(normal).normalize_or_zero();
                    let quadric = Quadric::of(wall, points[from as usize], BORDER * along.length_squared());
                    [from, to].into_iter().for_each(|point| quadrics[point as usize].add(&quadric));
                }
            }
        }
        let (alive, versions) = (triangles.len(), vec![0; points.len()]);
        let triangles = triangles.into_iter().map(Some).collect();
        let queue = BinaryHeap::new();
        Self { points, triangles, around, quadrics, versions, queue, alive }
    }

    /// Collapses points, the cheapest first, until `target` triangles remain or no collapse is possible.
    #[allow(clippy::cast_possible_truncation, reason = "a mesh has fewer than 2^32 points")]
    fn run(&mut self, target: usize) -> Result<()> {
        for point in 0..self.points.len() as u32 {
            if (point as usize).is_multiple_of(STRETCH) {
                Stop::check_current()?;
            }
            for other in self.neighbors(point) {
                self.push(point, other);
            }
        }
        let mut steps = 0usize;
        while self.alive > target {
            let Some(Reverse(next)) = self.queue.pop() else { break };
            steps += 1;
            if steps.is_multiple_of(STRETCH) {
                Stop::check_current()?;
            }
            let current = [next.from, next.to].map(|point| self.versions[point as usize]);
            if current == next.versions && self.is_possible(next.from, next.to) {
                self.collapse(next.from, next.to);
            }
        }
        Ok(())
    }

    /// Adds a collapse to the queue.
    fn push(&mut self, from: u32, to: u32) {
        let at = self.points[to as usize];
        let cost = self.quadrics[from as usize].at(at) + self.quadrics[to as usize].at(at);
        let versions = [from, to].map(|point| self.versions[point as usize]);
        self.queue.push(Reverse(Collapse { cost, from, to, versions }));
    }

    /// Returns the corners of the triangles around a point.
    fn corners(&self, point: u32) -> impl Iterator<Item = [u32; 3]> + '_ {
        self.around[point as usize].iter().filter_map(|triangle| self.triangles[*triangle as usize])
    }

    /// Returns the points that share an edge with a point, in ascending order.
    fn neighbors(&self, point: u32) -> Vec<u32> {
        let mut all: Vec<u32> = self.corners(point).flatten().filter(|other| *other != point).collect();
        all.sort_unstable();
        all.dedup();
        all
    }

    /// Returns true if triangles surround a point.
    fn is_inner(&self, point: u32) -> bool {
        self.corners(point).count() == self.neighbors(point).len()
    }

    /// Returns true if the surface stays one after a collapse, and no triangle turns over.
    fn is_possible(&self, from: u32, to: u32) -> bool {
        let shared = self.corners(from).filter(|corners| corners.contains(&to)).count();
        let (own, others) = (self.neighbors(from), self.neighbors(to));
        let common: Vec<u32> =
            own.iter().copied().filter(|point| others.binary_search(point).is_ok()).collect();
        if shared == 0 || shared != common.len() {
            return false;
        }
        // A point inside of a surface has at least three triangles: a tetrahedron does not become flat.
        if common.iter().any(|point| self.corners(*point).count() <= 3 && self.is_inner(*point)) {
            return false;
        }
        // The last triangles of a piece stay.
        if self.corners(to).count() <= shared {
            return false;
        }
        // A border point moves along the border only.
        if !self.is_inner(from) && shared != 1 {
            return false;
        }
        let target = self.points[to as usize];
        self.corners(from).filter(|corners| !corners.contains(&to)).all(|corners| {
            let normal = |place: &dyn Fn(u32) -> DVec3| {
                let [a, b, c] = corners.map(place);
                (b - a).cross(c - a)
            };
            let before = normal(&|point| self.points[point as usize]);
            let after = normal(&|point| if point == from { target } else { self.points[point as usize] });
            after.dot(before) > LEAST_TURN * after.length() * before.length() && after.length() > 1e-12
        })
    }

    /// Moves a point to another one, and removes the triangles between them.
    fn collapse(&mut self, from: u32, to: u32) {
        for triangle in std::mem::take(&mut self.around[from as usize]) {
            let Some(corners) = self.triangles[triangle as usize].as_mut() else { continue };
            if corners.contains(&to) {
                self.triangles[triangle as usize] = None;
                self.alive -= 1;
            } else {
                corners.iter_mut().filter(|point| **point == from).for_each(|point| *point = to);
                self.around[to as usize].push(triangle);
            }
        }
        let triangles = &self.triangles;
        self.around[to as usize].retain(|triangle| triangles[*triangle as usize].is_some());
        let moved = self.quadrics[from as usize];
        self.quadrics[to as usize].add(&moved);
        for point in [from, to] {
            self.versions[point as usize] += 1;
        }
        for other in self.neighbors(to) {
            self.push(to, other);
            self.push(other, to);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{FaceStyle, PartSize, PartSizes, SizedParts, SplitAxis};

    #[test]
    fn a_reduced_ball_is_closed_and_keeps_its_volume() {
        let ball = Shape::sphere(2.0, 64).expect("a ball");
        let mut last = 0.0;
        for (share, tolerance) in [(0.5, 0.01), (0.2, 0.03), (0.05, 0.12)] {
            let (reduced, rest) = ball.reduce(share).expect("fewer triangles");
            assert!(reduced.is_closed() && rest <= share + 0.001, "{rest}");
            let change = 1.0 - reduced.volume() / ball.volume();
            assert!(change.abs() < tolerance && change >= last, "{share}: {change}");
            last = change;
        }
    }

    #[test]
    fn flat_faces_lose_points_without_any_change() {
        let sizes = PartSizes(vec![SizedParts::Repeated(vec![PartSize::Flexible(0.5)])]);
        let block = Shape::rectangle(glam::DVec2::new(4.0, 3.0));
        let rows = block.split(SplitAxis::X, &sizes).expect("parts").parts;
        let cells: Vec<Shape> = rows
            .iter()
            .flat_map(|(_, row)| row.split(SplitAxis::Y, &sizes).expect("parts").parts)
            .map(|(_, cell)| cell)
            .collect();
        let grid = Shape::join(&cells.iter().collect::<Vec<_>>()).expect("joined").expect("a shape");
        let (reduced, rest) = grid.reduce(0.02).expect("fewer triangles");
        assert!(
            (reduced.area() - 12.0).abs() < 1e-9 && rest <= 2.0 / 96.0 + 1e-9,
            "{} {rest}",
            reduced.area()
        );
        assert_eq!(reduced.scope().size.truncate(), glam::DVec2::new(4.0, 3.0));
    }

    #[test]
    fn a_solid_never_becomes_flat() {
        for solid in [Shape::cuboid(DVec3::ONE), Shape::sphere(1.0, 8).expect("a ball")] {
            let (reduced, rest) = solid.reduce(0.01).expect("fewer triangles");
            assert!(reduced.is_closed() && reduced.volume() > 0.1, "{rest} {}", reduced.volume());
        }
    }

    #[test]
    fn borders_between_colours_stay_in_place() {
        let ball = Shape::sphere(1.0, 32).expect("a ball");
        let mut mesh = ball.mesh().into_owned();
        let red = FaceStyle::with_color(&None, [1.0, 0.0, 0.0, 1.0]);
        for number in 0..mesh.faces.len() {
            if mesh.centroid(&mesh.faces[number]).0.z > 0.0 {
                mesh.faces[number].style.clone_from(&red);
            }
        }
        let (reduced, _) = Shape::of_mesh(mesh, ball.scope().axes).reduce(0.2).expect("fewer triangles");
        assert!(reduced.is_closed());
        let mesh = reduced.mesh();
        for face in &mesh.faces {
            let high = face.rings.iter().flatten().map(|point| mesh.at(*point).z);
            let (low, high) = high.fold((f64::MAX, f64::MIN), |(low, high), z| (low.min(z), high.max(z)));
            assert!(if face.style == red { low > -0.01 } else { high < 0.01 }, "{low} {high}");
        }
        assert!(ball.reduce(0.0).is_err() && ball.reduce(1.5).is_err());
    }
}
