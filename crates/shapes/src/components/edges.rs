//! Edges as shapes, by their kind.

use glam::{DMat3, DVec3};
use rustc_hash::FxHashMap;

use crate::mesh::PolygonMesh;
use crate::{EdgeKind, Scope, Shape, ShapeBody};

/// Least upward part of the unit normal of a slope.
const SLOPE: f64 = 0.05;
/// Largest upward part of the unit normal of a slope; above, a face is level.
const LEVEL: f64 = 0.999;

/// An edge between two points, with the faces on its sides.
struct MeshEdge {
    ends: [u32; 2],
    faces: [Option<usize>; 2],
}

impl Shape {
    /// Returns the edges of these kinds, or all edges: along the scope's x axis, with z outwards. Edges between coplanar
    /// faces are left out.
    pub fn edges(&self, kinds: Option<&[EdgeKind]>) -> Vec<Self> {
        let mesh = self.mesh();
        let normals: Vec<DVec3> = mesh.faces.iter().map(|face| mesh.normal(face)).collect();
        let mut edges = Vec::new();
        for edge in mesh_edges(&mesh) {
            let [a, b] = edge.ends.map(|point| mesh.at(point));
            let Some(along) = (b - a).try_normalize() else { continue };
            let outward: Vec<DVec3> = edge.faces.iter().flatten().map(|face| normals[*face]).collect();
            if let [one, other] = outward.as_slice()
                && one.dot(*other) > 1.0 - 1e-9
            {
                continue;
            }
            let kind = kind(&mesh, &edge, &outward, along);
            if kinds.is_some_and(|kinds| !kinds.contains(&kind)) {
                continue;
            }
            let up = outward.iter().sum::<DVec3>();
            let up = (up - along * up.dot(along))
                .try_normalize()
                .unwrap_or_else(|| along.any_orthonormal_vector());
            let scope = Scope {
                origin: a,
                axes: DMat3::from_cols(along, up.cross(along), up),
                size: DVec3::new(a.distance(b), 0.0, 0.0),
            };
            let style = edge.faces[0].and_then(|face| mesh.faces[face].style.clone());
            edges.push(Self::new(scope, ShapeBody::Edge(kind, style)));
        }
        edges
    }
}

/// Returns the edges in the order of their first face.
fn mesh_edges(mesh: &PolygonMesh) -> Vec<MeshEdge> {
    let mut numbers: FxHashMap<[u32; 2], usize> = FxHashMap::default();
    let mut edges: Vec<MeshEdge> = Vec::new();
    for (face, [from, to]) in
        mesh.faces.iter().enumerate().flat_map(|(number, face)| face.edges().map(move |edge| (number, edge)))
    {
        let number = *numbers.entry([from.min(to), from.max(to)]).or_insert_with(|| {
            edges.push(MeshEdge { ends: [from, to], faces: [None, None] });
            edges.len() - 1
        });
        let faces = &mut edges[number].faces;
        if faces[0].is_none() { faces[0] = Some(face) } else { faces[1] = Some(face) }
    }
    edges
}

/// Returns the kind of an edge with these normals of its faces.
fn kind(mesh: &PolygonMesh, edge: &MeshEdge, normals: &[DVec3], along: DVec3) -> EdgeKind {
    let [Some(first), Some(second)] = edge.faces else { return EdgeKind::Border };
    let (one, other) = (normals[0], normals[1]);
    if along.z.abs() > 0.99 {
        return EdgeKind::Corner;
    }
    let is_level = along.z.abs() < 0.01;
    // In the direction of the first face, the other side of a convex edge lies below it.
    let begins_first = mesh.faces[first].edges().any(|ends| ends == edge.ends);
    let turn = one.cross(other).dot(along) * if begins_first { 1.0 } else { -1.0 };
    let is_convex = turn > 0.0;
    let slopes = |normal: DVec3| normal.z > SLOPE && normal.z < LEVEL;
    let rises = |normal: DVec3| normal.z > SLOPE;
    // Horizontal direction from the edge into a face.
    let into = |face: usize, normal: DVec3| {
        let forward = mesh.faces[face].edges().any(|ends| ends == edge.ends);
        normal.cross(if forward { along } else { -along })
    };
    let goes_up = |face: usize, normal: DVec3| into(face, normal).z > 1e-6;
    match (slopes(one), slopes(other)) {
        (true, true) if is_convex && is_level && !goes_up(first, one) && !goes_up(second, other) => {
            EdgeKind::Ridge
        }
        (true, true) if is_convex && !is_level => EdgeKind::Hip,
        (true, _) | (_, true) if !is_convex && rises(one) && rises(other) => EdgeKind::Valley,
        (true, false) if is_level && goes_up(first, one) => EdgeKind::Eave,
        (false, true) if is_level && goes_up(second, other) => EdgeKind::Eave,
        (true, false) | (false, true) if !(is_level || rises(one) && rises(other)) => EdgeKind::Rake,
        _ => EdgeKind::Plain,
    }
}
