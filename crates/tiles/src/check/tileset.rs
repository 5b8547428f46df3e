//! Check of a tileset against its plan.

use std::borrow::Cow;
use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::Path;

use burgeon_base::error::{Error, Result};
use glam::{DAffine3, DMat4, DVec3};
use serde_json::Value;

use super::glb::GlbModel;
use super::terrain::TerrainCheck;
use crate::earth::east_north_up;
use crate::folder::{IMPLICIT_NAME, TileFolder, content_name};
use crate::make::{TileFile, TileManifest};
use crate::plan::{FeatureDigest, PlannedTile, TableFormat, TileId, TilePlan, hash_text, id_digest};

/// Result of a check.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct TilesetReport {
    /// Number of tiles with content.
    pub tiles: usize,
    /// Number of points, counted for each instance.
    pub points: usize,
    /// Number of triangles, counted for each instance.
    pub triangles: usize,
    /// Number of coarser tiles with content.
    pub coarse: usize,
    /// Number of features in contents, without coarser tiles.
    pub features: u64,
    /// Number of features of the plan that no content has.
    pub missing: u64,
    /// Number of terrain tiles.
    pub terrain: usize,
    /// Number of tables.
    pub tables: usize,
    /// Contradictions, at most 100.
    pub problems: Vec<String>,
}

/// Tolerance (m) of points, for their rounding.
const NEAR: f64 = 1e-3;

/// Largest number of listed problems.
const LISTED: usize = 100;

/// Largest depth of a tileset.
const DEPTH: usize = 64;

/// Check in progress.
pub(super) struct TilesetCheck<'a> {
    pub(super) folder: &'a TileFolder,
    /// Formats of the tables of tiles.
    pub(super) formats: &'a [TableFormat],
    plan: BTreeMap<String, &'a PlannedTile>,
    /// Tiles with content in this tileset.
    seen: BTreeMap<TileId, SeenTile>,
    /// Errors (m) of coarser levels of detail, of the manifests of tiles, by the positions of the tiles on the curve.
    errors: BTreeMap<u64, Vec<f64>>,
    /// Parts of the digests of the features in contents, without coarser tiles.
    finest: Vec<u64>,
    geoid: f64,
    /// Set to read contents.
    pub(super) reads: bool,
    pub(super) terrain: TerrainCheck,
    pub(super) report: TilesetReport,
}

/// Volume and error of a tile, or of the tile around it.
#[derive(Clone, Copy)]
pub(super) struct ParentTile {
    /// Transform from the tile's axes to geocentric coordinates (m).
    pub(super) transform: DAffine3,
    pub(super) bounds: Option<[f64; 12]>,
    pub(super) error: f64,
}

/// Content of a tile.
pub(super) struct ShownContent<'a> {
    pub(super) uri: &'a str,
    pub(super) has_children: bool,
    /// Set if the children replace the content.
    pub(super) replaces: bool,
}

/// Tile with content in a tileset.
struct SeenTile {
    /// Corners of the volume in geocentric coordinates (m).
    corners: [DVec3; 8],
    error: f64,
}

/// Checks that the tileset of `folder` is what `plan` says. Fails if it cannot be read.
///
/// Every point of a content must be in the volume of its tile, every volume in that around it, and geometric errors must fall
/// from parents to children. Contents must be those of the manifests and lie at the places of the plan. Every feature of the
/// plan must be in exactly one content or in the list of missing features, and each number of a feature must be a row of a
/// property table. Coarser tiles must have the features of the tiles inside, which replace them, and at least the errors that
/// were measured. If there is a second tileset with implicit tiling, it must have the same tiles.
pub fn check_tileset(folder: &TileFolder, plan: &TilePlan) -> Result<TilesetReport> {
    let mut check = TilesetCheck {
        folder,
        formats: &plan.tables,
        plan: plan.all_tiles().into_iter().map(|tile| (content_name("", tile.id), tile)).collect(),
        seen: BTreeMap::new(),
        errors: BTreeMap::new(),
        finest: Vec::new(),
        geoid: plan.frame.geoid_height,
        reads: true,
        terrain: TerrainCheck::new(plan)?,
        report: TilesetReport::default(),
    };
    check.whole("tileset.json")?;
    check.terrain_rest()?;
    check.rest(plan)?;
    check.coarse(plan);
    check.finest.sort_unstable();
    let repeated = check.finest.windows(2).filter(|pair| pair[0] == pair[1]).count();
    if repeated > 0 {
        check.problem(format!("{repeated} features are in several tiles"));
    }
    if folder.implicit_tileset().exists() {
        let explicit = std::mem::take(&mut check.seen);
        check.reads = false;
        check.whole(IMPLICIT_NAME)?;
        check.compare(&explicit);
        check.terrain_rest()?;
    }
    Ok(check.report)
}

impl TilesetCheck<'_> {
    /// Checks a tileset.
    fn whole(&mut self, name: &str) -> Result<()> {
        let document = self.document(name)?;
        let error = document["geometricError"].as_f64().unwrap_or(f64::NAN);
        let parent = ParentTile { transform: DAffine3::IDENTITY, bounds: None, error };
        self.tile(&document["root"], &parent, &document["schema"], 0)
    }

    /// Checks that the contents are those of another tileset, with the same volumes and errors.
    fn compare(&mut self, other: &BTreeMap<TileId, SeenTile>) {
        let seen = std::mem::take(&mut self.seen);
        let only = seen.keys().filter(|id| !other.contains_key(id));
        let only: Vec<TileId> =
            only.chain(other.keys().filter(|id| !seen.contains_key(id))).copied().collect();
        for id in only {
            self.problem(format!("tile {id} is in one of tileset.json and {IMPLICIT_NAME} only"));
        }
        for (id, tile) in &seen {
            let Some(known) = other.get(id) else { continue };
            let is_near = tile.corners.iter().zip(known.corners).all(|(a, b)| a.abs_diff_eq(b, NEAR));
            // Larger tiles also contain the regular boxes of implicit tiling.
            let is_near = is_near || id.level < TileId::ANCHOR;
            if !is_near || (tile.error - known.error).abs() > NEAR {
                self.problem(format!("tile {id} has another volume or error in {IMPLICIT_NAME}"));
            }
        }
    }

    /// Checks that coarser tiles have at least the measured errors of the tiles inside.
    fn coarse(&mut self, plan: &TilePlan) {
        for tile in &plan.coarse {
            let Some(seen) = self.seen.get(&tile.id) else { continue };
            let Some(level) = plan.lods.iter().position(|lod| Some(*lod) == tile.lod) else { continue };
            let inside = self.errors.range(tile.id.span());
            let measured = inside.filter_map(|(_, errors)| errors.get(level)).copied().fold(0.0, f64::max);
            if seen.error < measured {
                let error = seen.error;
                self.problem(format!("tile {} has the error {error}, but {measured} was measured", tile.id));
            }
        }
    }

    pub(super) fn problem(&mut self, text: String) {
        if self.report.problems.len() < LISTED {
            self.report.problems.push(text);
        }
    }

    /// Reads a file of the tileset.
    fn document(&mut self, name: &str) -> Result<Value> {
        let path = self.folder.path().join(name);
        let refuse = |why: String| {
            Error::file(&path, format!("cannot read {}: {why}", path.display()))
                .help("write it: burgeon tiles join FOLDER")
        };
        let text = fs::read_to_string(&path).map_err(|error| refuse(error.to_string()))?;
        let document: Value = serde_json::from_str(&text).map_err(|error| refuse(error.to_string()))?;
        if document["asset"]["version"] != "1.1" {
            self.problem(format!("{name}: the version is not 1.1"));
        }
        if !["ADD", "REPLACE"].contains(&document["root"]["refine"].as_str().unwrap_or_default()) {
            self.problem(format!("{name}: the root has no refinement"));
        }
        Ok(document)
    }

    /// Checks a tile and those below it. `schema` describes the metadata of the file.
    fn tile(&mut self, described: &Value, parent: &ParentTile, schema: &Value, depth: usize) -> Result<()> {
        let uri = described["content"]["uri"].as_str();
        let name = uri.map_or_else(|| format!("a tile without content at depth {depth}"), str::to_owned);
        if depth > DEPTH {
            self.problem(format!("{name} is nested too deeply"));
            return Ok(());
        }
        let transform = match transform(&described["transform"]) {
            Ok(own) => parent.transform * own,
            Err(why) => {
                self.problem(format!("{name}: {why}"));
                return Ok(());
            }
        };
        let numbers =
            |value: &Value| -> Option<Vec<f64>> { value.as_array()?.iter().map(Value::as_f64).collect() };
        let bounds =
            numbers(&described["boundingVolume"]["box"]).and_then(|list| <[f64; 12]>::try_from(list).ok());
        let Some(bounds) = bounds else {
            self.problem(format!("{name} has no bounding box"));
            return Ok(());
        };
        let error = described["geometricError"].as_f64().unwrap_or(f64::NAN);
        let own = ParentTile { transform, bounds: Some(bounds), error };
        self.volume(&name, &own, parent);
        if !described["implicitTiling"].is_null() {
            return self.implicit(described, &own, schema);
        }
        let children = described["children"].as_array().map_or(&[][..], Vec::as_slice);
        match uri {
            Some(uri) if uri.ends_with(".json") => {
                let document = self.document(uri)?;
                self.tile(&document["root"], &own, &document["schema"], depth + 1)?;
            }
            Some(uri) => {
                let (has_children, replaces) = (!children.is_empty(), described["refine"] == "REPLACE");
                self.content(&ShownContent { uri, has_children, replaces }, &own)?;
            }
            None => {}
        }
        for child in children {
            self.tile(child, &own, schema, depth + 1)?;
        }
        Ok(())
    }

    /// Checks the volume and the error of a tile against those of its parent.
    pub(super) fn volume(&mut self, name: &str, own: &ParentTile, parent: &ParentTile) {
        let error = own.error;
        if !(error >= 0.0 && error <= parent.error) {
            self.problem(format!(
                "{name}: the geometric error {error} is not between 0 and that of its parent, {}",
                parent.error
            ));
        }
        if let (Some(outer), Some(bounds)) = (&parent.bounds, &own.bounds) {
            let size = outer[3..].iter().fold(1.0_f64, |most, value| most.max(value.abs()));
            let back = parent.transform.inverse();
            for corner in crate::join::corners(bounds) {
                let point = back.transform_point3(own.transform.transform_point3(corner));
                if !is_inside(outer, point, NEAR + size * 1e-9) {
                    self.problem(format!("{name}: the volume is not inside that of its parent"));
                    break;
                }
            }
        }
    }

    /// Checks the content of a tile.
    pub(super) fn content(&mut self, content: &ShownContent<'_>, tile: &ParentTile) -> Result<()> {
        let uri = content.uri;
        if self.terrain(content, tile)? {
            return Ok(());
        }
        let Some(planned) = self.plan.get(uri).copied() else {
            self.problem(format!("{uri} is not in the plan"));
            return Ok(());
        };
        let corners = crate::join::corners(&tile.bounds.unwrap_or_default());
        let seen = SeenTile {
            corners: corners.map(|corner| tile.transform.transform_point3(corner)),
            error: tile.error,
        };
        if self.seen.insert(planned.id, seen).is_some() {
            self.problem(format!("{uri} is in the tileset twice"));
            return Ok(());
        }
        if content.has_children && content.replaces && planned.is_tall() {
            self.problem(format!("{uri} is replaced by tiles inside that have other features"));
        }
        if content.has_children && !content.replaces && !planned.is_tall() {
            self.problem(format!("{uri} is shown together with the same features in the tiles inside"));
        }
        if content.has_children && planned.lod.is_none() && !planned.is_tall() {
            self.problem(format!("{uri} has tiles inside, but no coarser level of detail"));
        }
        if !self.reads {
            return Ok(());
        }
        let Some(manifest) = TileManifest::fitting(self.folder, planned)? else {
            self.problem(format!("{uri} has no manifest that fits the plan"));
            return Ok(());
        };
        self.tables(planned, &manifest)?;
        let Some(file) = manifest.content else {
            self.problem(format!("{uri}: the manifest has no content"));
            return Ok(());
        };
        let Some(model) = self.model(uri, &self.folder.content(planned.id), &file, tile)? else {
            return Ok(());
        };
        match planned.lod {
            Some(_) => self.report.coarse += 1,
            None => {
                self.report.tiles += 1;
                self.errors.insert(planned.id.curve().0, manifest.errors);
            }
        }
        self.report.points += model.points;
        self.report.triangles += model.triangles;
        let mut ids: BTreeSet<(&str, &str)> = BTreeSet::new();
        for table in &model.tables {
            for id in &table.ids {
                ids.insert((table.name.as_str(), id.as_str()));
            }
        }
        let shown = ids.len() as u64;
        for feature in &manifest.missing {
            if !ids.insert((feature.layer.as_str(), feature.feature.as_str())) {
                self.problem(format!("{uri}: feature {} is shown and missing", feature.feature));
            }
        }
        self.features(uri, planned, &ids);
        if planned.lod.is_none() {
            self.finest.extend(ids.iter().map(|(layer, id)| id_digest(layer, id).short()));
            self.report.features += shown;
            self.report.missing += manifest.missing.len() as u64;
        }
        Ok(())
    }

    /// Reads the content at `path` of a tile, and checks its place, its hash, its volume and its number of triangles; `None` if it
    /// cannot be read as a model.
    pub(super) fn model(
        &mut self,
        uri: &str,
        path: &Path,
        file: &TileFile,
        tile: &ParentTile,
    ) -> Result<Option<GlbModel>> {
        let expected = east_north_up(file.degrees, self.geoid);
        let far = tile.transform.to_cols_array().iter().zip(expected.to_cols_array()).any(|(is, wanted)| {
            // Translations are about 6,400 km long.
            (is - wanted).abs() > 1e-5
        });
        if far {
            self.problem(format!("{uri}: its transforms do not lead to its place on the ellipsoid"));
        }
        let bytes = fs::read(path).map_err(|error| {
            Error::file(path, format!("cannot read {}: {error}", path.display()))
                .help("check its permissions")
        })?;
        if hash_text(blake3::hash(&bytes)) != file.hash {
            self.problem(format!("{uri}: the content is not that of the manifest"));
        }
        let model = match GlbModel::read(&bytes) {
            Ok(model) => model,
            Err(why) => {
                self.problem(format!("{uri}: {why}"));
                return Ok(None);
            }
        };
        let bounds = tile.bounds.unwrap_or_default();
        // The box is along the axes of the content, so the extreme points decide for all.
        if !(is_inside(&bounds, model.low, NEAR) && is_inside(&bounds, model.high, NEAR)) {
            self.problem(format!(
                "{uri}: points from {} to {} are outside the volume",
                model.low, model.high
            ));
        }
        if model.triangles != file.triangles {
            let (is, said) = (model.triangles, file.triangles);
            self.problem(format!("{uri} has {is} triangles, but the manifest says {said}"));
        }
        Ok(Some(model))
    }

    /// Checks that these features are those of the plan.
    fn features(&mut self, name: &str, planned: &PlannedTile, ids: &BTreeSet<(&str, &str)>) {
        let mut digest = FeatureDigest::default();
        ids.iter().for_each(|(layer, id)| digest.add(id_digest(layer, id)));
        if digest.text() != planned.ids {
            let (is, wanted) = (ids.len(), planned.features);
            self.problem(format!("{name}: its {is} features are not the {wanted} of the plan"));
        }
    }

    /// Checks the tiles of the plan without content.
    fn rest(&mut self, plan: &TilePlan) -> Result<()> {
        let rest = plan.all_tiles().into_iter().filter(|tile| !self.seen.contains_key(&tile.id));
        for tile in rest.collect::<Vec<_>>() {
            let name = format!("tile {}", tile.id);
            // Features of coarser tiles are counted in the tiles inside.
            let features = if tile.lod.is_none() { tile.features } else { 0 };
            match TileManifest::fitting(self.folder, tile)? {
                None => self.report.missing += features,
                Some(manifest) if manifest.content.is_some() => {
                    self.problem(format!("{name} was made, but is not in the tileset: join again"));
                }
                Some(manifest) if manifest.error.is_none() && tile.lod.is_none() => {
                    self.tables(tile, &manifest)?;
                    self.report.missing += manifest.missing.len() as u64;
                }
                Some(manifest) if manifest.error.is_some() => {
                    self.report.missing += features;
                    if !manifest.missing.is_empty() {
                        let ids = manifest.missing.iter();
                        let ids =
                            ids.map(|feature| (feature.layer.as_str(), feature.feature.as_str())).collect();
                        self.features(&name, tile, &ids);
                    }
                }
                Some(_) => {}
            }
        }
        Ok(())
    }
}

/// Returns the transform of a tile; fails with the reason if it is no rotation with a translation.
fn transform(value: &Value) -> std::result::Result<DAffine3, Cow<'static, str>> {
    if value.is_null() {
        return Ok(DAffine3::IDENTITY);
    }
    let numbers: Option<Vec<f64>> =
        value.as_array().and_then(|list| list.iter().map(Value::as_f64).collect());
    let numbers = numbers.and_then(|list| <[f64; 16]>::try_from(list).ok());
    let matrix = DMat4::from_cols_array(&numbers.ok_or("the transform has not 16 numbers")?);
    let transform = DAffine3::from_mat4(matrix);
    let product = transform.matrix3.transpose() * transform.matrix3;
    let is_rigid = product.abs_diff_eq(glam::DMat3::IDENTITY, 1e-9) && transform.matrix3.determinant() > 0.0;
    if is_rigid { Ok(transform) } else { Err("the transform changes lengths".into()) }
}

/// Returns true if a point is in a box, with a tolerance (m).
fn is_inside(bounds: &[f64; 12], point: DVec3, near: f64) -> bool {
    let at = |index: usize| DVec3::new(bounds[index], bounds[index + 1], bounds[index + 2]);
    let away = point - at(0);
    [at(3), at(6), at(9)].into_iter().all(|half| {
        let length = half.length();
        // A flat box has a half axis without a direction, which its tolerance covers.
        length > 0.0 && away.dot(half).abs() / length <= length + near
    })
}
