//! One tile.

use std::collections::BTreeMap;
use std::sync::Arc;

use burgeon_base::error::{Error, ErrorKind, Result};
use burgeon_base::stop::Stop;
use burgeon_data::Layer;
use burgeon_export::gltf::{TileModelOptions, write_tile_model};
use burgeon_export::{Files, SceneFacts, SystemFacts};
use burgeon_scene::Scene;
use burgeon_spatial::representative_point;
use glam::DVec3;

use super::manifest::{ManifestError, MissingFeature, TileFile, TileManifest, make_folder};
use super::table::{TableFile, TileTables, remove_file, sync_file};
use crate::earth::{EarthMap, place_scene};
use crate::folder::TileFolder;
use crate::plan::{FeatureDigest, PLAN_VERSION, PlannedTile, TableFormat, TilePlan, cell_digest};

/// Feature of a tile.
#[derive(Debug, Clone, PartialEq)]
pub struct TileFeature {
    /// Layer.
    pub layer: String,
    /// Id.
    pub id: String,
    /// Representative point (m) in the coordinates of the run.
    pub place: [f64; 2],
}

/// Model of the features of a tile.
#[derive(Default)]
pub struct TileContent {
    /// Scene in the coordinates of the run.
    pub scene: Scene,
    /// Attributes of the features.
    pub systems: Vec<SystemFacts>,
    /// Names of the attributes to include.
    pub metadata: Vec<String>,
    /// Choices for the model.
    pub model: TileModelOptions,
    /// Layers, ids and causes of the features that the scene lacks.
    pub skipped: Vec<(String, String, String)>,
    /// Warnings of the run.
    pub warnings: Vec<String>,
    /// Geometric errors (m) of the coarser levels of detail of the plan, from fine to coarse.
    pub errors: Vec<f64>,
    /// Tables to be written beside the content.
    pub tables: Option<TileTables>,
}

/// Result of building a tile.
pub struct BuiltTile {
    /// Features of the tile, as far as they were read.
    pub features: Vec<TileFeature>,
    /// Model, or the reason why there is none.
    pub content: Result<TileContent>,
    /// Set if the features that were read are those of the plan.
    pub is_of_plan: bool,
}

impl BuiltTile {
    /// Returns a tile that could not be built, without features.
    pub fn failed(error: Error) -> Self {
        Self { features: Vec::new(), content: Err(error), is_of_plan: true }
    }
}

/// Result of a request for a tile.
#[derive(Debug, Clone, PartialEq)]
pub enum TileOutcome {
    /// The tile fitted the plan already.
    Kept(TileManifest),
    /// The tile was made, or failed for a reason that its manifest contains.
    Made(TileManifest),
}

impl TileOutcome {
    /// Returns the manifest.
    pub fn manifest(&self) -> &TileManifest {
        match self {
            Self::Kept(manifest) | Self::Made(manifest) => manifest,
        }
    }
}

/// Returns true if the work may succeed when it is repeated without a change of the script or its data.
pub fn is_retriable(error: &Error) -> bool {
    matches!(
        error.kind(),
        ErrorKind::File { .. } | ErrorKind::System | ErrorKind::Unavailable | ErrorKind::Stopped
    )
}

/// Returns the features of layers in a tile of a plan.
pub fn tile_features(plan: &TilePlan, tile: &PlannedTile, layers: &[Arc<Layer>]) -> Vec<TileFeature> {
    let of_layer = |layer: &Arc<Layer>| {
        let own = tile.own_features(layer, plan.tall.as_ref()).filter_map(|feature| {
            let place = representative_point(feature.geometry.bounds()?);
            Some(TileFeature { layer: layer.name.clone(), id: feature.id.to_string(), place })
        });
        own.collect::<Vec<_>>()
    };
    layers.iter().flat_map(of_layer).collect()
}

/// Fails unless the features of `layers` in a tile are those of the plan.
pub fn verify_features(plan: &TilePlan, tile: &PlannedTile, layers: &[Arc<Layer>]) -> Result<()> {
    let (mut ids, mut data, mut count) = (FeatureDigest::default(), FeatureDigest::default(), 0);
    for layer in layers {
        let (own_ids, own_data, own_count) = cell_digest(layer, tile, plan.tall.as_ref());
        ids.add(own_ids);
        data.add(own_data);
        count += own_count;
    }
    if count == tile.features && ids.text() == tile.ids && data.text() == tile.data {
        return Ok(());
    }
    let planned = tile.features;
    let message = match count == planned {
        true => format!("features of tile {} have changed since the plan was made", tile.id),
        false => format!("tile {} has {count} features, but the plan says {planned}", tile.id),
    };
    Err(Error::data(message)
        .help("plan again: burgeon tiles plan SCRIPT -o FOLDER; unchanged tiles are kept"))
}

/// Makes a tile, unless its manifest fits the plan. A tile that failed with other features than those of the plan is made again.
///
/// `build` builds the model in the coordinates of the run, which `map` puts on the earth. The content is written next to its
/// path and renamed, and the manifest is written last, so an interrupted call leaves no incomplete tile. An error of the script
/// or of the data becomes a part of the manifest. Fails with errors for which [`is_retriable`] holds.
pub fn make_tile(
    folder: &TileFolder,
    tile: &PlannedTile,
    map: &EarthMap<'_>,
    stop: &Arc<Stop>,
    build: impl FnOnce(&PlannedTile) -> BuiltTile,
) -> Result<TileOutcome> {
    let known = TileManifest::fitting(folder, tile)?;
    let may_be_kept = |known: &TileManifest| known.error.as_ref().is_none_or(|error| !error.of_other_data);
    if let Some(manifest) = known.filter(may_be_kept) {
        return Ok(TileOutcome::Kept(manifest));
    }
    let BuiltTile { features, mut content, is_of_plan } = build(tile);
    let mut manifest = TileManifest {
        version: PLAN_VERSION,
        tile: tile.id,
        hash: tile.hash.clone(),
        content: None,
        tables: Vec::new(),
        features: tile.features,
        missing: Vec::new(),
        error: None,
        errors: content.as_mut().map(|content| std::mem::take(&mut content.errors)).unwrap_or_default(),
        warnings: Vec::new(),
    };
    let place_of = |feature: &TileFeature| map.degrees(feature.place).ok().map(round_degrees);
    let written = content.and_then(|content| write_content(folder, tile, map, stop, content));
    match written {
        Ok(written) => {
            manifest.missing = missing_features(written.skipped, &features, place_of);
            manifest.content = written.file;
            manifest.tables = written.tables;
            manifest.warnings = written.warnings;
        }
        Err(error) if is_retriable(&error) => return Err(error),
        Err(error) => {
            let message = portable_message(&error);
            manifest.missing.extend(features.into_iter().map(|feature| MissingFeature {
                place: place_of(&feature),
                layer: feature.layer,
                feature: feature.id,
                cause: error.message().to_owned(),
            }));
            let code = error.kind().code().to_owned();
            manifest.error = Some(ManifestError { code, message, of_other_data: !is_of_plan });
        }
    }
    if manifest.content.is_none() {
        remove_file(&folder.content(tile.id))?;
    }
    for format in TableFormat::ALL {
        if manifest.tables.iter().all(|table| table.format != format) {
            remove_file(&folder.table(tile.id, format))?;
        }
    }
    manifest.write(folder)?;
    Ok(TileOutcome::Made(manifest))
}

/// Returns skipped features (layers, ids and causes) with the places of those in `features`.
fn missing_features(
    skipped: Vec<(String, String, String)>,
    features: &[TileFeature],
    place_of: impl Fn(&TileFeature) -> Option<[f64; 2]>,
) -> Vec<MissingFeature> {
    let places: BTreeMap<(&str, &str), &TileFeature> = match skipped.is_empty() {
        true => BTreeMap::new(),
        // The first of several features with the same id stays.
        false => features.iter().rev().map(|it| ((it.layer.as_str(), it.id.as_str()), it)).collect(),
    };
    let missing = |(layer, feature, cause): (String, String, String)| {
        let place = places.get(&(layer.as_str(), feature.as_str())).and_then(|it| place_of(it));
        MissingFeature { layer, feature, place, cause }
    };
    skipped.into_iter().map(missing).collect()
}

/// Returns the message of an error with its line, without the folder of the file, which differs between machines.
pub fn portable_message(error: &Error) -> String {
    match error.place() {
        Some(place) => {
            let name = place.file.rsplit(['/', '\\']).next().unwrap_or_default();
            format!("{name}:{}: {}", place.line, error.message())
        }
        None => error.message().to_owned(),
    }
}

/// Rounds degrees to about a centimetre, for lists.
fn round_degrees(degrees: [f64; 2]) -> [f64; 2] {
    degrees.map(|angle| (angle * 1e7).round() / 1e7)
}

/// Files of a tile that were written.
struct WrittenContent {
    file: Option<TileFile>,
    tables: Vec<TableFile>,
    skipped: Vec<(String, String, String)>,
    warnings: Vec<String>,
}

/// Margin (m) of a bounding box around the points, for their rounding.
const MARGIN: f64 = 0.01;

/// Writes the tables of a tile, and its content, if it draws something.
fn write_content(
    folder: &TileFolder,
    tile: &PlannedTile,
    map: &EarthMap<'_>,
    stop: &Arc<Stop>,
    content: TileContent,
) -> Result<WrittenContent> {
    let TileContent { mut scene, systems, metadata, model, skipped, warnings, tables, .. } = content;
    let tables = tables.map(|tables| tables.write((folder, tile.id), &scene, &systems, stop));
    let tables = tables.transpose()?.unwrap_or_default();
    let nothing = WrittenContent { file: None, tables, skipped, warnings };
    if scene.triangles() == 0 {
        return Ok(nothing);
    }
    let axes = map.axes(tile.origin())?;
    place_scene(&mut scene, map, &axes)?;
    let Some((low, high)) = scene.bounds() else { return Ok(nothing) };
    let path = folder.content(tile.id);
    path.parent().map_or(Ok(()), make_folder)?;
    let facts = SceneFacts { systems: &systems, metadata: Some(&metadata), ..SceneFacts::default() };
    let mut files = Files::new(stop);
    let counts = write_tile_model(&scene, &facts, &model, &path, &mut files)?;
    files.publish()?;
    let (bytes, hash) = sync_file(&path)?;
    let file = TileFile {
        bytes,
        hash,
        degrees: axes.degrees,
        bounds: bounding_box(low - MARGIN, high + MARGIN),
        triangles: counts.triangles,
        instances: counts.instances,
        primitives: counts.primitives,
    };
    Ok(WrittenContent { file: Some(file), ..nothing })
}

/// Returns a box along the axes as 3D Tiles have it.
pub(crate) fn bounding_box(low: DVec3, high: DVec3) -> [f64; 12] {
    let (DVec3 { x, y, z }, half) = (low.midpoint(high), (high - low) / 2.0);
    [x, y, z, half.x, 0.0, 0.0, 0.0, half.y, 0.0, 0.0, 0.0, half.z]
}
