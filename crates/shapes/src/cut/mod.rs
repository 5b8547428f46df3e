//! Division of meshes by planes.

mod crossing;
pub(crate) mod plane;
