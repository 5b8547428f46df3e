//! Surfaces of control points: Bezier patches, B-splines and NURBS, and their triangles.
//!
//! Input: a grid of points. Output: positions, normals and meshes, which are not closed.

mod basis;
mod isolines;
mod mesh;
pub(crate) mod surface;
mod surface_mix;
#[cfg(test)]
mod tests;
