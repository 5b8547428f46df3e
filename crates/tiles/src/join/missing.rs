//! Lists of missing features, with their causes.

use burgeon_base::error::Result;
use serde_json::{Value, json};

use crate::earth::EarthMap;
use crate::folder::TileFolder;
use crate::make::{MissingFeature, write_text};
use crate::plan::{PlannedTile, TileId, TilePlan};

/// Missing features, in the order of the tiles.
pub(super) struct MissingList {
    rows: Vec<MissingRow>,
    /// Number of features.
    pub(super) count: u64,
}

/// Missing feature, or all features of a tile.
struct MissingRow {
    tile: Option<TileId>,
    layer: String,
    /// Id; empty for all features of the tile.
    feature: String,
    features: u64,
    cause: String,
    geometry: Value,
}

impl MissingList {
    /// Begins with the features that the plan leaves out.
    pub(super) fn new(plan: &TilePlan) -> Self {
        let rows = plan.left_out.iter().map(|left_out| MissingRow {
            tile: None,
            layer: left_out.layer.clone(),
            feature: left_out.feature.clone(),
            features: 1,
            cause: left_out.cause.clone(),
            geometry: Value::Null,
        });
        let rows: Vec<MissingRow> = rows.collect();
        Self { count: rows.len() as u64, rows }
    }

    /// Adds the missing features of a tile.
    pub(super) fn add(&mut self, tile: TileId, missing: Vec<MissingFeature>) {
        self.count += missing.len() as u64;
        self.rows.extend(missing.into_iter().map(|feature| MissingRow {
            tile: Some(tile),
            layer: feature.layer,
            feature: feature.feature,
            features: 1,
            cause: feature.cause,
            geometry:
                feature.place.map_or(Value::Null, |place| json!({ "type": "Point", "coordinates": place })),
        }));
    }

    /// Adds all features of a tile, whose ids are unknown, with the region that contains them.
    pub(super) fn add_tile(&mut self, tile: &PlannedTile, map: &EarthMap<'_>, cause: &str) {
        let [west, south, east, north] = tile.region;
        let ring = [[west, south], [east, south], [east, north], [west, north], [west, south]];
        let ring: Option<Vec<[f64; 2]>> = ring
            .into_iter()
            .map(|place| Some(map.degrees(place).ok()?.map(|angle| (angle * 1e7).round() / 1e7)))
            .collect();
        let geometry = ring.map_or(Value::Null, |ring| json!({ "type": "Polygon", "coordinates": [ring] }));
        self.count += tile.features;
        self.rows.push(MissingRow {
            tile: Some(tile.id),
            layer: String::new(),
            feature: String::new(),
            features: tile.features,
            cause: cause.to_owned(),
            geometry,
        });
    }
}

/// Writes `missing.geojson` and `missing.csv`.
pub(super) fn write_missing(folder: &TileFolder, list: &MissingList) -> Result<()> {
    let name = |tile: Option<TileId>| tile.map(|tile| tile.to_string()).unwrap_or_default();
    let features = list.rows.iter().map(|row| {
        let feature = json!({
            "type": "Feature",
            "properties": {
                "layer": row.layer, "feature": row.feature, "features": row.features,
                "tile": row.tile.map(|tile| tile.to_string()), "cause": row.cause,
            },
            "geometry": row.geometry,
        });
        feature.to_string()
    });
    let features: Vec<String> = features.collect();
    let geojson = format!("{{\"type\":\"FeatureCollection\",\"features\":[\n{}\n]}}\n", features.join(",\n"));
    write_text(&folder.path().join("missing.geojson"), &geojson)?;
    let mut csv = "layer,feature,features,tile,cause\n".to_owned();
    for row in &list.rows {
        let MissingRow { tile, layer, feature, features, cause, .. } = row;
        let cells = [quoted(layer), quoted(feature), features.to_string(), name(*tile), quoted(cause)];
        csv += &cells.join(",");
        csv.push('\n');
    }
    write_text(&folder.path().join("missing.csv"), &csv)
}

/// Returns a cell of a CSV file (RFC 4180).
fn quoted(text: &str) -> String {
    if text.contains([',', '"', '\n', '\r']) {
        format!("\"{}\"", text.replace('"', "\"\""))
    } else {
        text.to_owned()
    }
}
