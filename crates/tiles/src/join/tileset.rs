//! Files of a tileset.

use std::collections::BTreeSet;
use std::fs;

use burgeon_base::error::{Error, Result};
use glam::DAffine3;
use serde_json::{Value, json};

use super::missing::{MissingList, write_missing};
use super::tree::{TilesetTile, join_tree};
use crate::earth::EarthMap;
use crate::folder::{TileFolder, content_name};
use crate::make::{TileFile, TileManifest, write_text};
use crate::plan::{PlannedTile, TilePlan};

/// Result of a join.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct JoinReport {
    /// Number of tiles with content.
    pub tiles: usize,
    /// Number of tiles that draw nothing.
    pub empty: usize,
    /// Number of tiles that failed.
    pub failed: usize,
    /// Number of tiles that have not been made for this plan.
    pub open: usize,
    /// Number of features in tiles with content, or that draw nothing.
    pub features: u64,
    /// Number of missing features.
    pub missing: u64,
    /// Number of files of the tileset.
    pub tilesets: usize,
}

/// Largest number of contents of a tileset file before it is divided into external tilesets.
const LARGE: usize = 2000;

/// Largest number of contents of an external tileset.
const REGION: usize = 1000;

/// Writes `tileset.json`, its external tilesets, `missing.geojson` and `missing.csv` from the manifests of the tiles of a plan.
///
/// Reads no content. The tileset is valid even if tiles failed or have not been made: their features are listed as missing.
pub fn join_tiles(folder: &TileFolder, plan: &TilePlan) -> Result<JoinReport> {
    let frame = plan.frame.reference()?;
    let geoid = plan.frame.geoid_height;
    let map = EarthMap::new(&frame, geoid)?;
    let mut report = JoinReport::default();
    let mut missing = MissingList::new(plan);
    let mut made: Vec<(&PlannedTile, TileFile)> = Vec::new();
    for tile in &plan.tiles {
        let Some(manifest) = TileManifest::fitting(folder, tile)? else {
            report.open += 1;
            missing.add_tile(tile, &map, "the tile has not been made: burgeon tiles make FOLDER");
            continue;
        };
        let absent = manifest.missing.len() as u64;
        report.features += tile.features.saturating_sub(absent);
        match (&manifest.error, manifest.content) {
            (Some(error), _) => {
                report.failed += 1;
                if absent < tile.features {
                    report.features -= tile.features - absent;
                    missing.add_tile(tile, &map, &error.message);
                    continue;
                }
            }
            (None, Some(file)) => {
                report.tiles += 1;
                made.push((tile, file));
            }
            (None, None) => report.empty += 1,
        }
        missing.add(tile.id, manifest.missing);
    }
    report.missing = missing.count;
    let tiles: Vec<(&PlannedTile, &TileFile)> = made.iter().map(|(tile, file)| (*tile, file)).collect();
    let root = join_tree(&tiles, &map, geoid)?;
    let mut external = Vec::new();
    let divides = root.as_ref().is_some_and(|root| root.contents() > LARGE);
    let body = match &root {
        Some(root) => tile_json(root, &DAffine3::IDENTITY, divides.then_some(&mut external)),
        // A tileset must have a root; this one is a point without content at the centre of the data.
        None => {
            let axes = map.axes([0.0; 2])?;
            json!({
                "transform": axes.transform.to_cols_array_2d_4(),
                "boundingVolume": { "box": crate::make::bounding_box(glam::DVec3::splat(-1.0), glam::DVec3::splat(1.0)) },
                "geometricError": 0.0,
            })
        }
    };
    let mut written = BTreeSet::new();
    for (name, tile) in &external {
        // The tile that refers to the file has the transform.
        let mut body = tile_json(tile, &tile.transform, None);
        if let Some(body) = body.as_object_mut() {
            body.remove("transform");
        }
        write_tileset(folder, name, body, tile.error)?;
        written.insert(name.clone());
    }
    write_missing(folder, &missing)?;
    write_tileset(folder, "tileset.json", body, root.as_ref().map_or(0.0, |root| root.error))?;
    remove_others(folder, &written)?;
    report.tilesets = written.len() + 1;
    Ok(report)
}

/// Columns of a transform, four numbers each.
trait FourColumns {
    fn to_cols_array_2d_4(&self) -> Vec<f64>;
}

impl FourColumns for DAffine3 {
    fn to_cols_array_2d_4(&self) -> Vec<f64> {
        let columns = self.to_cols_array_2d();
        let last = [0.0, 0.0, 0.0, 1.0];
        columns.iter().zip(last).flat_map(|([x, y, z], w)| [*x, *y, *z, w]).collect()
    }
}

/// Returns a tile inside a tile with the transform `parent` as JSON. With `external`, regions of the tree go to that list, with
/// the names of their files.
fn tile_json<'a>(
    tile: &'a TilesetTile,
    parent: &DAffine3,
    mut external: Option<&mut Vec<(String, &'a TilesetTile)>>,
) -> Value {
    let relative = relative(parent, &tile.transform);
    let mut body = json!({
        "transform": relative.to_cols_array_2d_4(),
        "boundingVolume": { "box": tile.bounds },
        "geometricError": tile.error,
    });
    if tile.has_content {
        body["content"] = json!({ "uri": content_name(tile.id) });
    }
    if let Some(external) = external.as_deref_mut().filter(|_| !tile.has_content && tile.contents() <= REGION)
    {
        let id = tile.id;
        let name = format!("tileset-{}-{}-{}.json", id.level, id.x, id.y);
        body["content"] = json!({ "uri": name });
        external.push((name, tile));
        return body;
    }
    if !tile.children.is_empty() {
        let mut children = Vec::new();
        for child in &tile.children {
            children.push(tile_json(child, &tile.transform, external.as_deref_mut()));
        }
        body["children"] = Value::Array(children);
    }
    body
}

/// Returns the transform of a child relative to its parent. Both are rotations and translations.
fn relative(parent: &DAffine3, child: &DAffine3) -> DAffine3 {
    let turned = parent.matrix3.transpose();
    DAffine3 {
        matrix3: turned * child.matrix3,
        translation: turned * (child.translation - parent.translation),
    }
}

/// Writes a file of the tileset.
fn write_tileset(folder: &TileFolder, name: &str, mut root: Value, error: f64) -> Result<()> {
    // Each feature is in one tile, and tiles without content show nothing, so children are added to their parents.
    root["refine"] = "ADD".into();
    let document = json!({
        "asset": { "version": "1.1", "generator": format!("Burgeon {}", env!("CARGO_PKG_VERSION")) },
        "geometricError": error,
        "root": root,
    });
    write_text(&folder.path().join(name), &format!("{document}\n"))
}

/// Removes external tilesets of earlier joins.
fn remove_others(folder: &TileFolder, written: &BTreeSet<String>) -> Result<()> {
    let is_external = |name: &str| name.starts_with("tileset-") && name.ends_with(".json");
    for entry in fs::read_dir(folder.path()).into_iter().flatten().flatten() {
        let name = entry.file_name().to_string_lossy().into_owned();
        if is_external(&name) && !written.contains(&name) {
            fs::remove_file(entry.path()).map_err(|error| {
                Error::file(entry.path(), format!("cannot remove {}: {error}", entry.path().display()))
                    .help("remove it: it belongs to an earlier tileset")
            })?;
        }
    }
    Ok(())
}
