//! Lists of missing features, with their causes.

use std::borrow::Cow;

use burgeon_base::error::Result;
use serde_json::{Value, json};

use crate::earth::EarthMap;
use crate::folder::TileFolder;
use crate::make::{MissingFeature, write_text};
use crate::plan::{PlannedTile, TileId, TilePlan};

/// Missing features, in the order of the tiles.
pub(super) struct MissingList<'p> {
    rows: Vec<MissingRow<'p>>,
    /// Number of features.
    pub(super) count: u64,
}

/// Missing feature, or all features of a tile.
struct MissingRow<'p> {
    tile: Option<TileId>,
    layer: Cow<'p, str>,
    /// Id; empty for all features of the tile.
    feature: Cow<'p, str>,
    features: u64,
    cause: Cow<'p, str>,
    geometry: Value,
}

impl<'p> MissingList<'p> {
    /// Begins with the features that the plan leaves out.
    pub(super) fn new(plan: &'p TilePlan) -> Self {
        let rows = plan.left_out.iter().map(|left_out| MissingRow {
            tile: None,
            layer: Cow::Borrowed(&left_out.layer),
            feature: Cow::Borrowed(&left_out.feature),
            features: 1,
            cause: Cow::Borrowed(&left_out.cause),
            geometry: Value::Null,
        });
        let rows: Vec<MissingRow<'p>> = rows.collect();
        Self { count: rows.len() as u64, rows }
    }

    /// Adds the missing features of a tile.
    pub(super) fn add(&mut self, tile: TileId, missing: Vec<MissingFeature>) {
        self.count += missing.len() as u64;
        self.rows.extend(missing.into_iter().map(|feature| MissingRow {
            tile: Some(tile),
            layer: feature.layer.into(),
            feature: feature.feature.into(),
            features: 1,
            cause: feature.cause.into(),
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
            layer: Cow::Borrowed(""),
            feature: Cow::Borrowed(""),
            features: tile.features,
            cause: Cow::Owned(cause.to_owned()),
            geometry,
        });
    }
}

/// Writes `missing.geojson` and `missing.csv`.
pub(super) fn write_missing(folder: &TileFolder, list: &MissingList<'_>) -> Result<()> {
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
        let (features, tile) = (Cow::Owned(features.to_string()), Cow::Owned(name(*tile)));
        let cells = [quoted(layer), quoted(feature), features, tile, quoted(cause)];
        csv += &cells.join(",");
        csv.push('\n');
    }
    write_text(&folder.path().join("missing.csv"), &csv)
}

/// Returns a cell of a CSV file (RFC 4180).
fn quoted(text: &str) -> Cow<'_, str> {
    if text.contains([',', '"', '\n', '\r']) {
        Cow::Owned(format!("\"{}\"", text.replace('"', "\"\"")))
    } else {
        Cow::Borrowed(text)
    }
}
