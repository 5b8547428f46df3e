//! Operations that change the geometry of shapes.

mod array;
mod extrude;
mod inset;
mod merge;
mod roof;
mod strips;
mod transform;

pub use inset::Setback;
pub(crate) use merge::{merge_coplanar, weld};
