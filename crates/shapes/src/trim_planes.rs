//! Planes between a face and its neighbours, which cut solids on the face at corners and hips.

use std::sync::{Arc, OnceLock};

use glam::{DAffine3, DVec3};
use rustc_hash::FxHashMap;

use crate::compact_scope::CompactScope;
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
    Box(CompactScope),
    /// A recess, by the scope of its box.
    Recess(CompactScope),
    /// A mesh, and the planes of each face, made by the first question.
    Mesh(Arc<PolygonMesh>, OnceLock<Vec<Vec<TrimPlane>>>),
    /// Another one, moved since the face was taken from it.
    Moved(Arc<TrimSource>, DAffine3),
}

/// Face of a solid whose neighbours trim solids on it.
#[derive(Debug, Clone)]
pub(crate) struct TrimFace {
    pub source: Arc<TrimSource>,
    pub face: u32,
}

impl TrimFace {
    /// Returns the face after another movement.
    pub(crate) fn transform(&self, frame: &DAffine3) -> Self {
        let source = match &*self.source {
            TrimSource::Moved(source, moved) => TrimSource::Moved(Arc::clone(source), *frame * *moved),
            _ => TrimSource::Moved(Arc::clone(&self.source), *frame),
        };
        Self { source: Arc::new(source), ..*self }
    }

    /// Returns true if both have the same planes.
    pub(crate) fn is_same(&self, other: &Self) -> bool {
        self.face == other.face && self.source.is_same(&other.source)
    }

    /// Returns the planes of the face, in the order of its edges; none at open edges and to coplanar neighbours.
    pub(crate) fn planes(&self) -> Vec<TrimPlane> {
        self.source.planes(self.face as usize)
    }
}

impl TrimSource {
    fn is_same(&self, other: &Self) -> bool {
        std::ptr::eq(self, other)
            || match (self, other) {
                (Self::Box(one), Self::Box(two)) | (Self::Recess(one), Self::Recess(two)) => one == two,
                (Self::Mesh(one, _), Self::Mesh(two, _)) => Arc::ptr_eq(one, two),
                (Self::Moved(one, by), Self::Moved(two, by_two)) => by == by_two && one.is_same(two),
                _ => false,
            }
    }

    /// Returns the planes of the face with this number.
    fn planes(&self, face: usize) -> Vec<TrimPlane> {
        match self {
            Self::Box(scope) => of_face(&ShapeBody::Box(None), &scope.get(), face),
            Self::Recess(scope) => of_face(&ShapeBody::Recess(Arc::default()), &scope.get(), face),
            Self::Mesh(mesh, planes) => {
                planes.get_or_init(|| of_mesh(mesh, None)).get(face).cloned().unwrap_or_default()
            }
            Self::Moved(source, frame) => {
                let planes = source.planes(face).into_iter();
                planes.filter_map(|plane| plane.transform(frame)).collect()
            }
        }
    }
}

impl TrimPlane {
    /// Returns the plane after a movement; `None` if it has no direction then.
    fn transform(self, frame: &DAffine3) -> Option<Self> {
        let ends = self.ends.map(|end| frame.transform_point3(end));
        // A movement can also mirror and stretch: normals go by the inverse of the transposed matrix.
        let normal = (frame.matrix3.inverse().transpose() * self.plane.normal).normalize_or_zero();
        (normal != DVec3::ZERO).then(|| Self { plane: CutPlane::through(ends[0], normal), ends, ..self })
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
