//! Plans of shapes: projections, convex faces and right angles.

use burgeon_base::Stop;
use burgeon_base::error::{Error, Result};
use burgeon_geometry::overlay::{Fill, fill, unite};
use burgeon_geometry::planar::twice_area;
use burgeon_geometry::{Polygon, Rings};
use glam::{DMat3, DVec2, DVec3};
use rustc_hash::FxHashMap;

use crate::mesh::{PolygonFace, PolygonMesh, PolygonMeshBuilder};
use crate::{Scope, Shape, ShapeBody};

/// Largest share by which right angles may change the area of a face.
const CHANGE: f64 = 0.25;

impl Shape {
    /// Returns the faces that the shape covers seen from above, at a height (m), with the axes of the world; `None` if all
    /// faces are upright.
    pub fn ground_plan(&self, height: f64) -> Result<Option<Self>> {
        let mesh = self.mesh();
        let mut parts = Vec::with_capacity(mesh.faces.len());
        for face in &mesh.faces {
            Stop::check_current()?;
            // One side of a closed shape covers as much as both.
            let up = mesh.area_vector(face).z;
            if up.abs() > 1e-12 && (up > 0.0 || !self.is_closed()) {
                let mut rings = mesh.flat_rings(face, DMat3::IDENTITY, DVec3::ZERO);
                rings.turn();
                parts.push(rings);
            }
        }
        let style = self.styles().into_iter().next().flatten();
        let mut builder = PolygonMeshBuilder::default();
        for rings in unite(parts)? {
            let lifted: Vec<Vec<DVec3>> =
                rings.iter().map(|ring| ring.iter().map(|at| at.extend(height)).collect()).collect();
            builder.face(lifted.iter().map(Vec::as_slice), &style);
        }
        let plan = builder.build();
        Ok((!plan.faces.is_empty()).then(|| Self::of_mesh(plan, DMat3::IDENTITY)))
    }

    /// Returns the shape with its faces divided into convex ones without holes, along lines between their corners.
    ///
    /// Method: S. Hertel and K. Mehlhorn, "Fast triangulation of simple polygons", 1983: at most four times as many faces
    /// as necessary.
    pub fn convexify(&self) -> Result<Self> {
        let ShapeBody::Mesh(mesh) = &self.body else { return Ok(self.clone()) };
        let mut faces = Vec::with_capacity(mesh.faces.len());
        for face in &mesh.faces {
            Stop::check_current()?;
            for ring in convex_rings(mesh, face)? {
                faces.push(PolygonFace::of(&ring, &face.style));
            }
        }
        let divided = Self::of_mesh(PolygonMesh::new(mesh.points.clone(), faces), self.scope().axes);
        Ok(divided.with_trim_of(self))
    }

    /// Returns a face whose edges are parallel to the axes of its scope, if they are within `angle` (radians) of them.
    ///
    /// Such an edge turns around its middle; neighbouring edges of the same direction become one. Fails unless the shape is one
    /// face, and if the face would cross itself or its area would change by more than a quarter.
    pub fn rectify(&self, angle: f64) -> Result<Self> {
        let (polygon, frame) = self.single_face("rectify")?;
        let rings: Vec<Vec<DVec2>> = polygon.iter().map(|ring| right_ring(ring, angle)).collect();
        let fails = || {
            Error::geometry("with right angles, the face would cross itself or change by more than a quarter")
                .help("use a smaller angle, or align the scope with the longest edge")
        };
        if rings.iter().any(|ring| ring.len() < 3) {
            return Err(fails());
        }
        let valid = fill(&[Rings(rings)], Fill::NonZero)?;
        let [only] = valid.as_slice() else { return Err(fails()) };
        let right = Polygon::turned(only.clone()).map_err(|_| fails())?;
        if right.holes().len() != polygon.holes().len()
            || (right.area() - polygon.area()).abs() > CHANGE * polygon.area()
        {
            return Err(fails());
        }
        let style = self.styles().into_iter().next().flatten();
        Ok(Self::of_polygon(&right, &frame, &style).with_trim_of(self))
    }
}

/// Returns convex rings that a face consists of.
fn convex_rings(mesh: &PolygonMesh, face: &PolygonFace) -> Result<Vec<Vec<u32>>> {
    let normal = mesh.normal(face);
    let turn = Scope::face_axes(normal, DMat3::IDENTITY).transpose();
    let flat = |point: u32| (turn * mesh.at(point)).truncate();
    let bend = |[a, b, c]: [u32; 3]| {
        let (before, after) = (flat(b) - flat(a), flat(c) - flat(b));
        before.perp_dot(after) / (before.length() * after.length()).max(f64::MIN_POSITIVE)
    };
    let is_convex = |ring: &[u32]| {
        let count = ring.len();
        (0..count).all(|at| bend([ring[at], ring[(at + 1) % count], ring[(at + 2) % count]]) > -1e-9)
    };
    if let [ring] = face.rings.as_slice()
        && is_convex(ring)
    {
        return Ok(vec![ring.clone()]);
    }
    let mut rings: Vec<Vec<u32>> = mesh.triangles(face)?.into_iter().map(Vec::from).collect();
    // Number of the ring of each directed edge, and rings that became part of others.
    let mut sides: FxHashMap<[u32; 2], usize> = FxHashMap::default();
    let edges = |ring: &[u32]| -> Vec<[u32; 2]> {
        (0..ring.len()).map(|at| [ring[at], ring[(at + 1) % ring.len()]]).collect()
    };
    for (number, ring) in rings.iter().enumerate() {
        edges(ring).into_iter().for_each(|edge| {
            sides.insert(edge, number);
        });
    }
    let diagonals: Vec<[u32; 2]> = rings.iter().flat_map(|ring| edges(ring)).filter(|[a, b]| a < b).collect();
    for [from, to] in diagonals {
        let (Some(&one), Some(&other)) = (sides.get(&[from, to]), sides.get(&[to, from])) else { continue };
        if one == other {
            continue;
        }
        let joined = join(&rings[one], &rings[other], [from, to]);
        if !is_convex(&joined) {
            continue;
        }
        for edge in edges(&rings[other]) {
            sides.insert(edge, one);
        }
        sides.remove(&[from, to]);
        sides.remove(&[to, from]);
        rings[other].clear();
        rings[one] = joined;
    }
    rings.retain(|ring| !ring.is_empty());
    Ok(rings)
}

/// Joins two rings at an edge of the first, which the second has in the other direction.
fn join(one: &[u32], other: &[u32], [from, to]: [u32; 2]) -> Vec<u32> {
    let begin = |ring: &[u32], point: u32| ring.iter().position(|own| *own == point).unwrap_or(0);
    let part = |ring: &[u32], first: u32| -> Vec<u32> {
        let start = begin(ring, first);
        (0..ring.len() - 1).map(|step| ring[(start + step) % ring.len()]).collect()
    };
    // From the end of the edge around to its start, and back on the other side.
    let mut joined = part(one, to);
    joined.extend(part(other, from));
    joined
}

/// A straight line of a ring: a point, a unit direction and the length of its edges (m).
struct RingLine {
    at: DVec2,
    along: DVec2,
    length: f64,
}

/// Returns a ring whose edges within `angle` (radians) of the axes are parallel to them.
fn right_ring(ring: &[DVec2], angle: f64) -> Vec<DVec2> {
    let mut lines: Vec<RingLine> = Vec::with_capacity(ring.len());
    for (at, from) in ring.iter().enumerate() {
        let to = ring[(at + 1) % ring.len()];
        let Some(along) = (to - *from).try_normalize() else { continue };
        let axis = [DVec2::X, DVec2::Y, -DVec2::X, -DVec2::Y]
            .into_iter()
            .find(|axis| axis.angle_to(along).abs() <= angle.min(std::f64::consts::FRAC_PI_4));
        let line =
            RingLine { at: from.midpoint(to), along: axis.unwrap_or(along), length: from.distance(to) };
        match lines.last_mut().filter(|last| is_same_way(last, &line)) {
            Some(last) => extend(last, &line),
            None => lines.push(line),
        }
    }
    if lines.len() > 3
        && is_same_way(&lines[lines.len() - 1], &lines[0])
        && let Some(last) = lines.pop()
    {
        extend(&mut lines[0], &last);
    }
    let count = lines.len();
    let mut corners: Vec<DVec2> = Vec::with_capacity(count);
    for at in 0..count {
        let (one, two) = (&lines[(at + count - 1) % count], &lines[at]);
        let cross = one.along.perp_dot(two.along);
        if cross.abs() > 1e-6 {
            corners.push(one.at + one.along * ((two.at - one.at).perp_dot(two.along) / cross));
        } else {
            // A step between parallel edges stays in its place.
            let middle =
                (one.at + one.along * (one.length / 2.0)).midpoint(two.at - two.along * (two.length / 2.0));
            let onto = |line: &RingLine| line.at + line.along * (middle - line.at).dot(line.along);
            corners.extend([onto(one), onto(two)]);
        }
    }
    if twice_area(corners.iter().copied()) == 0.0 { Vec::new() } else { corners }
}

/// Returns true if two lines have the same direction.
fn is_same_way(one: &RingLine, two: &RingLine) -> bool {
    one.along.dot(two.along) > 1.0 - 1e-12
}

/// Joins a line to another with the same direction, at the mean of both by their lengths.
fn extend(line: &mut RingLine, other: &RingLine) {
    let sum = line.length + other.length;
    line.at = (line.at * line.length + other.at * other.length) / sum;
    line.length = sum;
}

#[cfg(test)]
mod tests {
    use super::*;

    fn plan(points: &[(f64, f64)]) -> Shape {
        let points = points.iter().map(|at| DVec2::from(*at)).collect();
        let plan = Shape::plan(&[points], 0.0).expect("a plan");
        plan.align(DMat3::IDENTITY)
    }

    #[test]
    fn the_plan_of_a_solid_is_what_it_covers_from_above() {
        let table = Shape::cuboid(DVec3::new(4.0, 2.0, 0.1)).translate(DVec3::new(0.0, 0.0, 1.0));
        let leg = Shape::cuboid(DVec3::new(0.2, 0.2, 1.0)).translate(DVec3::new(5.0, 0.0, 0.0));
        let whole = Shape::join(&[&table, &leg]).expect("joined").expect("a shape");
        let plan = whole.ground_plan(0.5).expect("a plan").expect("faces");
        assert!((plan.area() - 8.04).abs() < 1e-9 && plan.body.faces() == 2);
        assert!((plan.scope().origin.z - 0.5).abs() < 1e-12 && plan.normal().z > 0.0);
        let wall = Shape::rectangle(DVec2::ONE).rotate(DVec3::ZERO, DVec3::X, std::f64::consts::FRAC_PI_2);
        assert!(wall.ground_plan(0.0).expect("a plan").is_none());
        let ball = Shape::sphere(1.0, 16).expect("a ball");
        let disk = ball.ground_plan(0.0).expect("a plan").expect("faces");
        assert!((disk.area() - Shape::disk(1.0, 16).expect("a disk").area()).abs() < 1e-9);
    }

    #[test]
    fn convex_faces_have_the_area_of_the_whole_and_close_a_solid() {
        let angle = plan(&[(0.0, 0.0), (6.0, 0.0), (6.0, 2.0), (2.0, 2.0), (2.0, 5.0), (0.0, 5.0)]);
        let parts = angle.convexify().expect("parts");
        assert_eq!(parts.body.faces(), 2);
        assert!((parts.area() - angle.area()).abs() < 1e-9);
        let ring = |half: f64| {
            [(-half, -half), (half, -half), (half, half), (-half, half)].map(DVec2::from).to_vec()
        };
        let yard =
            Shape::plan(&[ring(3.0), ring(1.0)], 0.0).expect("a plan").extrude(2.0, None).expect("a solid");
        let convex = yard.convexify().expect("parts");
        assert!(convex.is_closed() && (convex.volume() - yard.volume()).abs() < 1e-9);
        let mesh = convex.mesh();
        assert!(mesh.faces.iter().all(|face| face.rings.len() == 1));
        assert!((8..=16).contains(&(convex.body.faces() - 8)), "{}", convex.body.faces());
    }

    #[test]
    fn nearly_right_angles_become_right() {
        let crooked = plan(&[(0.0, 0.1), (8.0, -0.1), (8.1, 3.0), (4.0, 3.05), (3.95, 6.0), (0.1, 6.05)]);
        let right = crooked.rectify(10f64.to_radians()).expect("a face");
        let mesh = right.mesh();
        let face = &mesh.faces[0];
        assert_eq!(face.rings[0].len(), 6);
        for [from, to] in face.edges() {
            let along = mesh.at(to) - mesh.at(from);
            assert!(along.x.abs() < 1e-9 || along.y.abs() < 1e-9, "{along}");
        }
        assert!((right.area() / crooked.area() - 1.0).abs() < 0.03);
        // An edge beyond the angle keeps its direction.
        let cut = plan(&[(0.0, 0.0), (8.0, 0.2), (8.0, 3.0), (5.0, 6.0), (0.0, 6.0)]);
        let right = cut.rectify(5f64.to_radians()).expect("a face");
        assert_eq!(right.mesh().points.len(), 5);
        let mesh = right.mesh();
        let slanted = mesh.faces[0].edges().map(|[from, to]| (mesh.at(to) - mesh.at(from)).normalize());
        assert!(slanted.into_iter().any(|along| (along.x + along.y).abs() < 1e-9));
    }
}
