//! Planes between a face and its neighbours, which cut solids on the face at corners and hips.

use std::sync::{Arc, OnceLock};

use glam::{DAffine3, DVec3};
use rustc_hash::FxHashMap;

use crate::mesh::PolygonMesh;
use crate::{CutPlane, Scope, ShapeBody};

/// Least sine of the angle between faces with a plane between them.
const COPLANAR: f64 = 1e-6;

/// The plane that bisects the angle between a face and its neighbour at an edge.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TrimPlane {
    /// Plane through the edge; its normal points away from the face.
    pub plane: CutPlane,
    /// Ends of the edge (m).
    pub ends: [DVec3; 2],
    /// Angle (radians) between the edge and the horizontal direction of the face, from 0 to a right angle.
    pub inclination: f64,
}

/// The shape that a face comes from.
#[derive(Debug)]
pub(crate) enum TrimSource {
    /// A box.
    Box(Scope),
    /// A recess, by the scope of its box.
    Recess(Scope),
    /// A mesh, and the planes of each face, made by the first question.
    Mesh(Arc<PolygonMesh>, OnceLock<Vec<Vec<TrimPlane>>>),
}

/// Face of a solid whose neighbours trim solids on it.
#[derive(Debug, Clone)]
pub(crate) struct TrimFace {
    pub source: Arc<TrimSource>,
    pub face: u32,
    /// Movement since the face was taken from the solid.
    pub moved: Option<Box<DAffine3>>,
}

impl TrimFace {
    /// Returns the face after another movement.
    pub(crate) fn transform(&self, frame: &DAffine3) -> Self {
        let moved = self.moved.as_ref().map_or(*frame, |moved| *frame * **moved);
        Self { moved: Some(Box::new(moved)), ..self.clone() }
    }

    /// Returns true if both have the same planes.
    pub(crate) fn is_same(&self, other: &Self) -> bool {
        let same_source = match (&*self.source, &*other.source) {
            (TrimSource::Box(one), TrimSource::Box(two))
            | (TrimSource::Recess(one), TrimSource::Recess(two)) => one == two,
            (TrimSource::Mesh(one, _), TrimSource::Mesh(two, _)) => Arc::ptr_eq(one, two),
            _ => false,
        };
        same_source && self.face == other.face && self.moved == other.moved
    }

    /// Returns the planes of the face, in the order of its edges; none at open edges and to coplanar neighbours.
    pub(crate) fn planes(&self) -> Vec<TrimPlane> {
        let number = self.face as usize;
        let own = match &*self.source {
            TrimSource::Box(scope) => of_face(&ShapeBody::Box(None), scope, number),
            TrimSource::Recess(scope) => of_face(&ShapeBody::Recess(Arc::default()), scope, number),
            TrimSource::Mesh(mesh, planes) => {
                planes.get_or_init(|| of_mesh(mesh, None)).get(number).cloned().unwrap_or_default()
            }
        };
        let Some(frame) = &self.moved else { return own };
        let moved = |trim: TrimPlane| {
            let ends = trim.ends.map(|end| frame.transform_point3(end));
            // A movement can also mirror and stretch: normals go by the inverse of the transposed matrix.
            let normal = (frame.matrix3.inverse().transpose() * trim.plane.normal).normalize_or_zero();
            (normal != DVec3::ZERO).then(|| TrimPlane {
                plane: CutPlane::through(ends[0], normal),
                ends,
                ..trim
            })
        };
        own.into_iter().filter_map(moved).collect()
    }
}

/// Returns the planes of a face of a body with this scope.
fn of_face(body: &ShapeBody, scope: &Scope, number: usize) -> Vec<TrimPlane> {
    of_mesh(&body.mesh(scope), Some(number)).into_iter().next().unwrap_or_default()
}

/// Returns the planes of each face of a mesh, or of one face.
fn of_mesh(mesh: &PolygonMesh, only: Option<usize>) -> Vec<Vec<TrimPlane>> {
    let normals: Vec<DVec3> = mesh.faces.iter().map(|face| mesh.normal(face)).collect();
    let mut sides: FxHashMap<[u32; 2], usize> = FxHashMap::default();
    for (number, face) in mesh.faces.iter().enumerate() {
        face.edges().for_each(|edge| {
            sides.insert(edge, number);
        });
    }
    let faces = mesh.faces.iter().enumerate().filter(|(number, _)| only.is_none_or(|only| only == *number));
    let planes = faces.map(|(number, face)| {
        let normal = normals[number];
        let level = Scope::face_axes(normal, glam::DMat3::IDENTITY).x_axis;
        let plane = |[from, to]: [u32; 2]| {
            let other = normals[*sides.get(&[to, from])?];
            let ends = [mesh.at(from), mesh.at(to)];
            let along = (ends[1] - ends[0]).try_normalize()?;
            if normal.cross(other).length() < COPLANAR {
                return None;
            }
            // The face is on the left of its edge, seen from outside.
            let outward = along.cross(normal + other).try_normalize()?;
            let inclination = along.dot(level).abs().clamp(0.0, 1.0).acos();
            Some(TrimPlane { plane: CutPlane::through(ends[0], outward), ends, inclination })
        };
        face.edges().filter_map(plane).collect()
    });
    planes.collect()
}
