//! Tileset and missing features, from the manifests.

mod document;
mod implicit;
mod missing;
mod subtree;
mod tileset;
mod tree;

#[cfg(test)]
pub(crate) use subtree::{example_subtree, numbered_subtrees};
pub use tileset::{JoinReport, Tiling, join_tiles};
pub(crate) use tree::corners;
pub use tree::{JoinedTile, TilesetTile, join_tree};
