//! Check of the tables of a tile.

use std::collections::BTreeSet;
use std::fs;

use burgeon_base::error::{Error, Result};
use serde_json::Value;

use super::tileset::TilesetCheck;
use crate::make::{TableFile, TileManifest};
use crate::plan::{FeatureDigest, PlannedTile, TableFormat, hash_text, id_digest};

impl TilesetCheck<'_> {
    /// Checks that a tile has the tables of the plan, and that they have its features.
    pub(super) fn tables(&mut self, planned: &PlannedTile, manifest: &TileManifest) -> Result<()> {
        let formats: Vec<TableFormat> = manifest.tables.iter().map(|table| table.format).collect();
        if manifest.error.is_some() {
            return Ok(());
        }
        let wanted = if planned.lod.is_none() { self.formats } else { &[] };
        if formats != wanted {
            self.problem(format!("tile {} has not the tables of the plan", planned.id));
        }
        for table in &manifest.tables {
            let path = self.folder.table(planned.id, table.format);
            let bytes = fs::read(&path).map_err(|error| {
                Error::file(&path, format!("cannot read {}: {error}", path.display()))
                    .help("make the tile again")
            })?;
            let name = format!("the {} table of tile {}", table.format, planned.id);
            if hash_text(blake3::hash(&bytes)) != table.hash {
                self.problem(format!("{name} is not that of the manifest"));
            }
            let checked = match table.format {
                TableFormat::Cityjson => check_sequence(&bytes, table),
                TableFormat::Geoparquet => check_rows(&bytes, table, planned, manifest),
            };
            if let Err(why) = checked {
                self.problem(format!("{name}: {why}"));
            }
            self.report.tables += 1;
        }
        Ok(())
    }
}

/// Checks that a CityJSON sequence has a feature in each line after the first. Fails with the reason.
fn check_sequence(bytes: &[u8], table: &TableFile) -> std::result::Result<(), String> {
    let text = std::str::from_utf8(bytes).map_err(|_| "it is no text")?;
    let (mut ids, mut count) = (BTreeSet::new(), 0);
    for (number, line) in text.lines().enumerate() {
        let value: Value =
            serde_json::from_str(line).map_err(|error| format!("line {}: {error}", number + 1))?;
        let wanted = if number == 0 { "CityJSON" } else { "CityJSONFeature" };
        if value["type"] != wanted {
            return Err(format!("line {} is no {wanted}", number + 1));
        }
        if number > 0 {
            let id = value["id"].as_str().unwrap_or_default().to_owned();
            if value["CityObjects"][id.as_str()].is_null() || !ids.insert(id) {
                return Err(format!("line {} has no id of its own", number + 1));
            }
            count += 1;
        }
    }
    if count == table.rows {
        Ok(())
    } else {
        Err(format!("it has {count} features, but the manifest says {}", table.rows))
    }
}

/// Checks that a GeoParquet file has a row for each feature of the tile that is not missing. Fails with the reason.
fn check_rows(
    bytes: &[u8],
    table: &TableFile,
    planned: &PlannedTile,
    manifest: &TileManifest,
) -> std::result::Result<(), String> {
    let rows = super::rows::geoparquet_rows(bytes)?;
    if rows.len() != table.rows {
        return Err(format!("it has {} rows, but the manifest says {}", rows.len(), table.rows));
    }
    let missing = manifest.missing.iter().map(|it| (it.layer.clone(), it.feature.clone()));
    let all: BTreeSet<(String, String)> = rows.into_iter().chain(missing).collect();
    let mut digest = FeatureDigest::default();
    all.iter().for_each(|(layer, id)| digest.add(id_digest(layer, id)));
    if digest.text() == planned.ids {
        return Ok(());
    }
    Err(format!("its {} features are not the {} of the plan", all.len(), planned.features))
}
