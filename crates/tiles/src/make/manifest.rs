//! Manifest of a tile.

use std::fs;
use std::path::Path;

use burgeon_base::error::{Error, Result};
use serde::{Deserialize, Serialize};

use super::table::TableFile;
use crate::folder::TileFolder;
use crate::plan::{PLAN_VERSION, PlannedTile, TileId};

/// Description of a tile that was made, written after its content.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct TileManifest {
    /// Version of the format.
    pub version: u32,
    /// Tile.
    pub tile: TileId,
    /// Hash of the plan of the tile.
    pub hash: String,
    /// Content; `None` if the tile draws nothing or failed.
    pub content: Option<TileFile>,
    /// Tables of the features.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub tables: Vec<TableFile>,
    /// Number of features of the plan.
    pub features: u64,
    /// Features that the content lacks.
    pub missing: Vec<MissingFeature>,
    /// Error of the tile, if it failed.
    pub error: Option<ManifestError>,
    /// Geometric errors (m) of the coarser levels of detail of the plan, from fine to coarse.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub errors: Vec<f64>,
    /// Warnings of the run.
    pub warnings: Vec<String>,
}

/// Content of a tile.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct TileFile {
    /// Size (bytes).
    pub bytes: u64,
    /// Hash.
    pub hash: String,
    /// Longitude and latitude (degrees) of the origin of the local axes.
    pub degrees: [f64; 2],
    /// Bounding box in the local axes (m), z up, as 3D Tiles have it: the centre and three half axes.
    #[serde(rename = "box")]
    pub bounds: [f64; 12],
    /// Number of triangles, counted for each instance.
    pub triangles: usize,
    /// Number of instances of models that are stored once.
    pub instances: usize,
    /// Number of primitives, each of which a viewer draws with one call.
    pub primitives: usize,
}

/// Feature that is in no content.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct MissingFeature {
    /// Layer.
    pub layer: String,
    /// Id.
    pub feature: String,
    /// Longitude and latitude (degrees).
    pub place: Option<[f64; 2]>,
    /// Cause.
    pub cause: String,
}

/// Error of a tile.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ManifestError {
    /// Machine-readable code.
    pub code: String,
    /// Message.
    pub message: String,
    /// Set if the features that were read are not those of the plan, so that the tile is made again once they are.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub of_other_data: bool,
}

impl TileManifest {
    /// Reads the manifest of a tile; `None` if there is none or if it is of another version.
    ///
    /// Fails if the file cannot be read.
    pub fn read(folder: &TileFolder, tile: TileId) -> Result<Option<Self>> {
        let path = folder.manifest(tile);
        let text = match fs::read_to_string(&path) {
            Ok(text) => text,
            Err(error) if error.kind() == std::io::ErrorKind::NotFound => return Ok(None),
            Err(error) => {
                return Err(Error::file(&path, format!("cannot read {}: {error}", path.display()))
                    .help("check its permissions, or remove it"));
            }
        };
        let manifest = serde_json::from_str::<Self>(&text).ok();
        Ok(manifest.filter(|manifest| manifest.version == PLAN_VERSION && manifest.tile == tile))
    }

    /// Reads the manifest that fits the plan of a tile, with content and tables of the recorded sizes; `None` if the tile is still to be
    /// made.
    pub fn fitting(folder: &TileFolder, tile: &PlannedTile) -> Result<Option<Self>> {
        let Some(manifest) = Self::read(folder, tile.id)?.filter(|known| known.hash == tile.hash) else {
            return Ok(None);
        };
        let has_size = |path: &Path, bytes: u64| fs::metadata(path).is_ok_and(|file| file.len() == bytes);
        let content = manifest.content.as_ref();
        let fits = content.is_none_or(|content| has_size(&folder.content(tile.id), content.bytes))
            && manifest
                .tables
                .iter()
                .all(|table| has_size(&folder.table(tile.id, table.format), table.bytes));
        Ok(fits.then_some(manifest))
    }

    /// Writes the manifest completely or not at all.
    pub fn write(&self, folder: &TileFolder) -> Result<()> {
        let mut text = serde_json::to_string_pretty(self).map_err(Error::internal)?;
        text.push('\n');
        write_text(&folder.manifest(self.tile), &text)
    }
}

/// Writes a file completely or not at all.
pub(crate) fn write_text(path: &Path, text: &str) -> Result<()> {
    write_bytes(path, text.as_bytes())
}

/// Writes a file completely or not at all.
pub(crate) fn write_bytes(path: &Path, bytes: &[u8]) -> Result<()> {
    if let Some(parent) = path.parent() {
        make_folder(parent)?;
    }
    burgeon_export::write_file(path, |out| std::io::Write::write_all(out, bytes))
}

/// Creates a folder and those that contain it.
pub(super) fn make_folder(path: &Path) -> Result<()> {
    fs::create_dir_all(path).map_err(|error| {
        Error::file(path, format!("cannot create the folder {}: {error}", path.display()))
            .help("write to a folder with write permission and free space")
    })
}
