//! Reflections of the model in smooth surfaces: rays that mirrors send are traced through trees of boxes.
//!
//! Input: the stage and a ray. Output: the nearest point that it meets. The folder knows nothing of light.

mod ray_tree;
mod tracer;

pub(super) use tracer::{MirroredPoint, Tracer};
