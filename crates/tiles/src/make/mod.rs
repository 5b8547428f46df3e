//! Tiles: contents and manifests.

mod ground_image;
mod manifest;
mod sweep;
mod table;
mod terrain;
mod tile;

pub use ground_image::{GroundColors, GroundSample, PlainGround};
pub use manifest::{ManifestError, MissingFeature, TileFile, TileManifest};
pub(crate) use manifest::{write_bytes, write_text};
pub use sweep::sweep_temporary;
pub use table::{TableFile, TileTables};
pub use terrain::TerrainHeights;
pub(crate) use tile::bounding_box;
pub use tile::{
    BuiltTile, TileContent, TileFeature, TileOutcome, is_retriable, make_tile, portable_message,
    tile_features, verify_features,
};
