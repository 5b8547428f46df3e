//! Operations that change the geometry of shapes.

mod array;
mod bevel;
mod extrude;
mod flat_faces;
mod inset;
mod merge;
mod molding;
mod regions;
mod roof;
mod strips;
mod transform;

pub(crate) use flat_faces::remove_flat_triangles;
pub use inset::Setback;
pub(crate) use merge::{merge_coplanar, weld};
pub use regions::EnvelopeLimit;
