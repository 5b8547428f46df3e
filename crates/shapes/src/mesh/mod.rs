//! Meshes of polygons with holes.

mod build;
mod closed;
mod face_sets;
mod loops;
mod polygon_mesh;
mod triangles;

pub(crate) use build::PolygonMeshBuilder;
pub(crate) use closed::EdgeSums;
pub(crate) use face_sets::FaceSets;
pub(crate) use loops::trace_loops;
pub use polygon_mesh::{PolygonFace, PolygonMesh};
