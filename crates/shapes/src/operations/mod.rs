//! Operations that change the geometry of shapes.

mod array;
mod bevel;
mod extrude;
mod inset;
mod merge;
mod molding;
mod regions;
mod roof;
mod strips;
mod transform;

pub use inset::Setback;
pub use regions::EnvelopeLimit;
pub(crate) use merge::{merge_coplanar, weld};
