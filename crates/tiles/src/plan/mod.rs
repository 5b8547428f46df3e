//! Plans: features divided among tiles.

mod coarse;
mod digest;
mod division;
mod file;
mod scan;
mod shares;
mod tile;

pub use coarse::coarse_tiles;
pub use digest::{FeatureDigest, feature_digest, id_digest};
pub use division::{TileDivision, TileGrid};
pub use file::{PLAN_VERSION, PlanFrame, PlannedFile, PlannedSource, TilePlan};
pub use scan::{OmittedFeature, ScanResult, cell_digest, scan_source};
pub use shares::{TileShare, share_of};
pub use tile::{PlannedTile, TileId};
