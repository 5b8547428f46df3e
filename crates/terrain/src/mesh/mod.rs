//! Meshes of the ground.
//!
//! Input: expanded ground, an error limit, and areas to cut out. Output: triangles without gaps.

pub(crate) mod cuts;
pub(crate) mod ground_mesh;
pub(crate) mod height_grid;
pub(crate) mod samples;
pub(crate) mod triangle;
