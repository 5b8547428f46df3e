//! Tile of a plan.

use burgeon_data::{Feature, Layer};
use burgeon_spatial::representative_point;
use serde::{Deserialize, Serialize};

use super::grid::TileGrid;
use super::tall::TallRule;
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
    /// Set if the tile has only tall features of its square, which are shown together with the tiles inside; `false` if it has
    /// only the others, and `None` if it has all.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub tall: Option<bool>,
}

impl PlannedTile {
    /// Returns true if the tile has only tall features, and the tiles inside have the others.
    pub fn is_tall(&self) -> bool {
        self.tall == Some(true)
    }

    /// Returns the features of a layer in the tile. `rule` is that of the plan.
    pub fn own_features<'a>(
        &self,
        layer: &'a Layer,
        rule: Option<&'a TallRule>,
    ) -> impl Iterator<Item = &'a Feature> + use<'a> {
        let [west, south, east, north] = TileGrid::bounds(self.id);
        let chosen = self.tall.zip(rule);
        layer.features.iter().filter(move |feature| {
            let place = feature.geometry.bounds().map(representative_point);
            place.is_some_and(|[x, y]| (west..east).contains(&x) && (south..north).contains(&y))
                && chosen.is_none_or(|(tall, rule)| rule.holds(&layer.names, feature) == tall)
        })
    }

    /// Returns the origin (m) of the axes of the content, relative to the origin of the frame.
    pub fn origin(&self) -> [f64; 2] {
        let [west, south, east, north] = match self.id.level >= TileId::ANCHOR {
            true => TileGrid::bounds(self.id.anchor()),
            false => self.region,
        };
        [west.midpoint(east), south.midpoint(north)]
    }
}
