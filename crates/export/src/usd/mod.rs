//! USD as text, which film and game programs, Blender and viewers of Apple and NVIDIA open.
//!
//! z is up and a unit is a metre, as in the scene. Each mesh is stored once in the abstract prim `/Meshes` (`shape`).
//! Similar instances become a point instancer, others references (`document`). Materials are `UsdPreviewSurface`s
//! (`material`).
//!
//! Specification: Pixar, "Universal Scene Description", UsdGeom and UsdPreviewSurface 2.6.

mod document;
mod material;
mod shape;
#[cfg(test)]
mod tests;
mod text;

pub(super) use document::write;
