//! Plans: features divided among tiles.

mod coarse;
mod digest;
mod division;
mod file;
mod grid;
mod planned_file;
mod scan;
mod shares;
mod table;
mod tall;
mod terrain;
mod tile;
mod tile_id;

pub use coarse::coarse_tiles;
pub(crate) use digest::hash_text;
pub use digest::{FeatureDigest, feature_digest, hash_file, id_digest};
pub use division::TileDivision;
pub use file::{PLAN_VERSION, PlanFrame, PlannedSource, TilePlan};
pub use grid::TileGrid;
pub use planned_file::PlannedFile;
pub use scan::{OmittedFeature, ScanResult, cell_digest, scan_source};
pub use shares::{TileShare, share_of};
pub use table::TableFormat;
pub use tall::TallRule;
pub use terrain::PlannedTerrain;
pub use tile::PlannedTile;
pub use tile_id::TileId;
