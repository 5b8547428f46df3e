//! Tileset and missing features, from the manifests.

mod missing;
mod tileset;
mod tree;

pub use tileset::{JoinReport, join_tiles};
pub(crate) use tree::corners;
pub use tree::{TilesetTile, join_tree};
