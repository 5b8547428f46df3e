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
#[derive(Debug, Clone, Copy)]
pub(crate) struct MeshEdge {
    /// Points, in the direction of the first face.
    pub ends: [u32; 2],
    /// The first face, and the last other one.
    pub faces: [Option<usize>; 2],
    /// Set if the last face runs in the direction of the first one.
    pub is_parallel: bool,
    /// Number of faces.
    pub count: usize,
}

impl Shape {
    /// Returns the edges of these kinds, or all edges: along the scope's x axis, with z outwards. Edges between coplanar
    /// faces are left out.
    pub fn edges(&self, kinds: Option<&[EdgeKind]>) -> Vec<Self> {
        let mesh = self.mesh();
        let normals: Vec<DVec3> = mesh.faces.iter().map(|face| mesh.normal(face)).collect();
        Self::edges_of(&mesh, &normals, kinds).into_iter().map(|(edge, _)| edge).collect()
    }

    /// Returns the edges like [`Self::edges`], for a mesh with these normals of its faces, with their faces.
    pub(crate) fn edges_of(
        mesh: &PolygonMesh,
        normals: &[DVec3],
        kinds: Option<&[EdgeKind]>,
    ) -> Vec<(Self, MeshEdge)> {
        let mut edges = Vec::new();
        for edge in mesh_edges(mesh) {
            let [a, b] = edge.ends.map(|point| mesh.at(point));
            let Some(along) = (b - a).try_normalize() else { continue };
            let outward: Vec<DVec3> = edge.faces.iter().flatten().map(|face| normals[*face]).collect();
            if let [one, other] = outward.as_slice()
                && one.dot(*other) > 1.0 - 1e-9
            {
                continue;
            }
            let kind = kind(&edge, &outward, along);
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
            edges.push((Self::new(scope, ShapeBody::Edge(kind, style)), edge));
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
            edges.push(MeshEdge { ends: [from, to], faces: [None, None], is_parallel: false, count: 0 });
            edges.len() - 1
        });
        let edge = &mut edges[number];
        edge.faces[usize::from(edge.count > 0)] = Some(face);
        edge.is_parallel = edge.count > 0 && edge.ends == [from, to];
        edge.count += 1;
    }
    edges
}

/// Returns the kind of an edge with these normals of its faces.
fn kind(edge: &MeshEdge, normals: &[DVec3], along: DVec3) -> EdgeKind {
    let [Some(_), Some(_)] = edge.faces else { return EdgeKind::Border };
    let (one, other) = (normals[0], normals[1]);
    if along.z.abs() > 0.99 {
        return EdgeKind::Corner;
    }
    let is_level = along.z.abs() < 0.01;
    // In the direction of the first face, the other side of a convex edge lies below it.
    let is_convex = one.cross(other).dot(along) > 0.0;
    let slopes = |normal: DVec3| normal.z > SLOPE && normal.z < LEVEL;
    let rises = |normal: DVec3| normal.z > SLOPE;
    // Horizontal direction from the edge into a face.
    let goes_up = |along: DVec3, normal: DVec3| normal.cross(along).z > 1e-6;
    let (first, second) = (along, if edge.is_parallel { along } else { -along });
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
