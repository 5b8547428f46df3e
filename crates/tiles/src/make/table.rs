//! Tables of the features of a tile, beside its content.

use std::collections::BTreeSet;
use std::fs;
use std::io::Write as _;
use std::path::Path;
use std::sync::Arc;

use burgeon_base::error::{Error, Result};
use burgeon_base::stop::Stop;
use burgeon_data::Layer;
use burgeon_export::layers::{TableColumn, write_geoparquet};
use burgeon_export::{Files, SceneFacts, SystemFacts, write_city_sequence};
use burgeon_scene::Scene;
use burgeon_spatial::{Record, RecordTable, ReferenceFrame};
use serde::{Deserialize, Serialize};

use super::manifest::make_folder;
use super::tile::TileContent;
use crate::folder::TileFolder;
use crate::plan::{PlannedTile, TableFormat, TileId, TilePlan, hash_text};

/// Tables to be written for a tile.
pub struct TileTables {
    /// Formats.
    pub formats: Vec<TableFormat>,
    /// Attributes, which are the same in all tiles of a plan.
    pub columns: Vec<TableColumn>,
    /// Features of each layer, with their geometries in the coordinates of the run.
    pub records: Vec<RecordTable>,
    /// Frame of the run.
    pub frame: ReferenceFrame,
    /// Level of detail of the shapes, from 0 to 3.
    pub detail: u8,
}

/// Table of a tile that was written.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct TableFile {
    /// Format.
    pub format: TableFormat,
    /// Size (bytes).
    pub bytes: u64,
    /// Hash.
    pub hash: String,
    /// Number of features.
    pub rows: usize,
}

impl TileTables {
    /// Returns the tables of a tile with the features of `layers` that are in it and that `content` has not skipped; `None` for coarser
    /// tiles, or if the plan has no tables. `frame` is that of the run, with its level of detail.
    pub fn new(
        plan: &TilePlan,
        tile: &PlannedTile,
        content: &TileContent,
        layers: &[Arc<Layer>],
        (frame, detail): (&ReferenceFrame, u8),
    ) -> Option<Self> {
        if tile.lod.is_some() || plan.tables.is_empty() {
            return None;
        }
        let columns = plan.columns().into_iter().filter(|column| content.metadata.contains(&column.name));
        let skipped: BTreeSet<(&str, &str)> =
            content.skipped.iter().map(|(layer, id, _)| (layer.as_str(), id.as_str())).collect();
        let table = |layer: &Arc<Layer>| {
            let own = tile
                .own_features(layer, plan.tall.as_ref())
                .filter(|feature| !skipped.contains(&(layer.name.as_str(), feature.id.as_str())));
            let records = own.map(|feature| Record {
                id: feature.id.to_string(),
                geometry: Some(feature.geometry.clone()),
                values: feature.attributes.to_vec(),
            });
            let records = records.collect();
            RecordTable { name: layer.name.clone(), columns: layer.names.clone(), records }
        };
        Some(Self {
            formats: plan.tables.clone(),
            columns: columns.collect(),
            records: layers.iter().map(table).collect(),
            frame: frame.clone(),
            detail,
        })
    }

    /// Writes the tables of a tile, each complete or not at all. `scene` is in the coordinates of the run.
    pub(super) fn write(
        &self,
        (folder, tile): (&TileFolder, TileId),
        scene: &Scene,
        systems: &[SystemFacts],
        stop: &Arc<Stop>,
    ) -> Result<Vec<TableFile>> {
        let mut written = Vec::new();
        for format in &self.formats {
            let path = folder.table(tile, *format);
            path.parent().map_or(Ok(()), make_folder)?;
            let mut files = Files::new(stop);
            let rows = match format {
                TableFormat::Cityjson => {
                    let names: Vec<String> = self.columns.iter().map(|column| column.name.clone()).collect();
                    let chosen = systems.iter().map(|system| SystemFacts {
                        records: system.records.with_columns(&names),
                        ..system.clone()
                    });
                    let systems: Vec<SystemFacts> = chosen.collect();
                    let (frame, detail) = (Some(&self.frame), self.detail);
                    let facts = SceneFacts { frame, detail, systems: &systems, ..SceneFacts::default() };
                    write_city_sequence(scene, &facts, &path, &mut files)?
                }
                TableFormat::Geoparquet => {
                    let bytes = write_geoparquet(&self.records, &self.columns, &self.frame)?;
                    files.write(&path, |out| out.write_all(&bytes))?;
                    self.records.iter().map(|table| table.records.len()).sum()
                }
            };
            files.publish()?;
            let (bytes, hash) = sync_file(&path)?;
            written.push(TableFile { format: *format, bytes, hash, rows });
        }
        Ok(written)
    }
}

/// Writes a published file to the disk, and returns its size (bytes) and its hash.
pub(super) fn sync_file(path: &Path) -> Result<(u64, String)> {
    let read = || -> std::io::Result<(u64, String)> {
        fs::File::open(path)?.sync_all()?;
        let bytes = fs::read(path)?;
        Ok((bytes.len() as u64, hash_text(blake3::hash(&bytes))))
    };
    read().map_err(|error| {
        Error::file(path, format!("cannot read {} after writing it: {error}", path.display()))
            .help("check the disk, and make the tile again")
    })
}

/// Removes a file, if there is one.
pub(super) fn remove_file(path: &Path) -> Result<()> {
    match fs::remove_file(path) {
        Err(error) if error.kind() != std::io::ErrorKind::NotFound => {
            Err(Error::file(path, format!("cannot remove {}: {error}", path.display()))
                .help("remove it, and make the tile again"))
        }
        _ => Ok(()),
    }
}
