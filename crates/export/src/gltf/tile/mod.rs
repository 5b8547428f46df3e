//! Model of a tile in 3D Tiles: one mesh with a primitive for each material.
//!
//! Input: the scene of a tile. Output: a `.glb` file that viewers draw with few calls. All features are in one mesh, whose
//! vertices store normals and feature numbers (`EXT_mesh_features`); models that repeat often are instances of a mesh of
//! their own (`EXT_mesh_gpu_instancing`). Coordinates and normals can be integers (`KHR_mesh_quantization`).

mod arrays;
mod merge;
mod options;
mod repeated;
#[cfg(test)]
mod tests;
mod vertex;
mod write;

pub use options::{TileCompression, TileModelOptions};
pub use write::{TileModelCounts, write_tile_model};
