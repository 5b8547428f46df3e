//! glTF 2.0, which viewers, game engines and Blender open.
//!
//! glTF is y up: a point (x, y, z) of the scene is (x, z, -y) in the file, and transforms are converted accordingly.
//! Each mesh is stored once, regardless of the number of its instances (`place`). Arrays are written directly from the
//! scene to the file (`body`); only their description is kept in memory.
//!
//! Specification: Khronos Group, "glTF 2.0 Specification", 2021.

mod attribute;
mod attribute_column;
mod body;
mod camera;
mod coordinates;
mod corners;
mod description;
mod document;
mod expand;
mod film;
mod material;
mod mesh;
mod metadata;
#[cfg(test)]
mod metadata_tests;
mod packing;
mod place;
mod quantize;
#[cfg(test)]
mod quantize_tests;
#[cfg(test)]
mod second_set_tests;
#[cfg(test)]
mod tests;
mod tile;
mod weld;

pub use document::{Layout, glb, glb_for_viewer, glb_with_texture_coordinates};
pub(super) use document::{
    buffer_path, packed_glb_for_viewer, write_film, write_glb, write_gltf, write_levels,
};
pub use place::InstancePlace;
pub use tile::{TileCompression, TileModelCounts, TileModelOptions, write_tile_model};
