//! Tile of a plan.

use serde::{Deserialize, Serialize};

use super::grid::TileGrid;
use super::tile_id::TileId;

/// Tile that contains features.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct PlannedTile {
    /// Place in the quadtree.
    #[serde(flatten)]
    pub id: TileId,
    /// Number of features.
    pub features: u64,
    /// Expected cost: one for a feature, and a tenth for each of its points.
    pub cost: f64,
    /// West, south, east and north (m) of the features, relative to the origin of the frame. Features may cross the sides of
    /// the tile.
    pub region: [f64; 4],
    /// Digest of the ids of the features.
    pub ids: String,
    /// Digest of the ids, geometries and attributes of the features.
    pub data: String,
    /// Hash of everything that determines the bytes of the tile.
    pub hash: String,
    /// Level of detail of a coarser tile; `None` for that of the plan.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub lod: Option<u8>,
}

impl PlannedTile {
    /// Returns the origin (m) of the axes of the content, relative to the origin of the frame.
    pub fn origin(&self) -> [f64; 2] {
        let [west, south, east, north] = match self.id.level >= TileId::ANCHOR {
            true => TileGrid::bounds(self.id.anchor()),
            false => self.region,
        };
        [west.midpoint(east), south.midpoint(north)]
    }
}
