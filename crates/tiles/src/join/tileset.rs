//! Join of the tiles of a plan.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};

use burgeon_base::error::{Error, Result};
use rayon::prelude::*;

use super::document::TilesetWriter;
use super::missing::{MissingList, write_missing};
use super::tree::{JoinedTile, TilesetTile, join_terrain, join_tree};
use crate::earth::EarthMap;
use crate::folder::{IMPLICIT_NAME, TERRAIN, TileFolder};
use crate::make::TileManifest;
use crate::plan::{PlannedTile, TilePlan};

/// Way in which a tileset lists its tiles.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Tiling {
    /// Each tile in `tileset.json` and its external tilesets.
    #[default]
    Explicit,
    /// Tiles with a side of more than 8 km in `tileset.json`, the others as bits in `.subtree` files.
    Implicit,
    /// `tileset.json` with explicit tiling, and `implicit.json` with the same contents.
    Both,
}

/// Result of a join.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct JoinReport {
    /// Number of tiles with content, without coarser ones.
    pub tiles: usize,
    /// Number of coarser tiles with content.
    pub coarse: usize,
    /// Number of terrain tiles.
    pub terrain: usize,
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
    /// Number of tileset files.
    pub tilesets: usize,
    /// Number of subtree files.
    pub subtrees: usize,
}

/// Writes `tileset.json`, its external tilesets and subtrees, `missing.geojson` and `missing.csv` from the manifests of the
/// tiles of a plan.
///
/// Reads no content. The tileset is valid even if tiles failed or have not been made: their features are listed as missing.
pub fn join_tiles(folder: &TileFolder, plan: &TilePlan, tiling: Tiling) -> Result<JoinReport> {
    let frame = plan.frame.reference()?;
    let map = EarthMap::new(&frame, plan.frame.geoid_height)?;
    let mut report = JoinReport::default();
    let mut missing = MissingList::new(plan);
    let planned = plan.all_tiles();
    let read = planned.par_iter().map(|tile| TileManifest::fitting(folder, tile));
    let mut manifests: Vec<Option<TileManifest>> = read.collect::<Result<_>>()?;
    for (tile, manifest) in planned.iter().zip(&mut manifests) {
        count(tile, manifest.as_mut(), &map, &mut report, &mut missing);
    }
    report.missing = missing.count;
    let contents = planned.iter().zip(&manifests).filter_map(|(tile, manifest)| {
        let manifest = manifest.as_ref()?;
        let file = manifest.content.as_ref()?;
        Some(JoinedTile { planned: tile, file, errors: &manifest.errors })
    });
    let mut contents: Vec<JoinedTile<'_>> = contents.collect();
    contents.sort_by_key(|tile| tile.planned.id.curve());
    let root = join_tree(&contents, &map, &plan.lods)?;
    let terrain = terrain_tree(folder, plan, &map, &mut report)?;
    write_missing(folder, &missing)?;
    let mut written = BTreeSet::new();
    let stem = IMPLICIT_NAME.split('.').next().unwrap_or_default();
    let ways: &[(&'static str, bool)] = match tiling {
        Tiling::Explicit => &[("tileset", false)],
        Tiling::Implicit => &[("tileset", true)],
        Tiling::Both => &[(stem, true), ("tileset", false)],
    };
    if let Some(terrain) = &terrain {
        let (map, written_here, grown) = (&map, BTreeSet::new(), BTreeMap::new());
        let mut writer = TilesetWriter {
            folder,
            map,
            stem: TERRAIN,
            within: TERRAIN,
            is_implicit: false,
            written: written_here,
            grown,
        };
        report.tilesets += writer.write(Some(terrain), None)?;
        written.append(&mut writer.written);
    }
    for (stem, is_implicit) in ways {
        let (is_implicit, map) = (*is_implicit, &map);
        let mut writer = TilesetWriter {
            folder,
            map,
            stem,
            within: "",
            is_implicit,
            written: BTreeSet::new(),
            grown: BTreeMap::new(),
        };
        report.tilesets += writer.write(root.as_ref(), terrain.as_ref())?;
        written.append(&mut writer.written);
    }
    report.subtrees = written.len() - report.tilesets;
    remove_others(folder, &written)?;
    Ok(report)
}

/// Returns the tree of the terrain tiles with content, and counts them.
fn terrain_tree(
    folder: &TileFolder,
    plan: &TilePlan,
    map: &EarthMap<'_>,
    report: &mut JoinReport,
) -> Result<Option<TilesetTile>> {
    let (folder, planned) = (folder.terrain(), plan.terrain_tiles()?);
    let read = planned.par_iter().map(|tile| TileManifest::fitting(&folder, tile));
    let manifests: Vec<Option<TileManifest>> = read.collect::<Result<_>>()?;
    let mut contents = Vec::new();
    for (planned, manifest) in planned.iter().zip(&manifests) {
        match manifest {
            None => report.open += 1,
            Some(TileManifest { error: Some(_), .. }) => report.failed += 1,
            Some(TileManifest { content: None, .. }) => report.empty += 1,
            Some(TileManifest { content: Some(file), errors, .. }) => {
                report.terrain += 1;
                contents.push(JoinedTile { planned, file, errors });
            }
        }
    }
    join_terrain(&contents, map)
}

/// Counts a tile and its missing features.
fn count(
    tile: &PlannedTile,
    manifest: Option<&mut TileManifest>,
    map: &EarthMap<'_>,
    report: &mut JoinReport,
    missing: &mut MissingList<'_>,
) {
    let is_coarse = tile.lod.is_some();
    let Some(manifest) = manifest else {
        report.open += 1;
        if !is_coarse {
            missing.add_tile(tile, map, "the tile has not been made: burgeon tiles make FOLDER");
        }
        return;
    };
    match (&manifest.error, &manifest.content) {
        (Some(_), _) => report.failed += 1,
        (None, Some(_)) if is_coarse => report.coarse += 1,
        (None, Some(_)) => report.tiles += 1,
        (None, None) => report.empty += 1,
    }
    if is_coarse {
        // The tiles inside have the same features.
        return;
    }
    let absent = manifest.missing.len() as u64;
    if let Some(error) = manifest.error.as_ref().filter(|_| absent < tile.features) {
        return missing.add_tile(tile, map, &error.message);
    }
    report.features += tile.features.saturating_sub(absent);
    missing.add(tile.id, std::mem::take(&mut manifest.missing));
}

/// Removes tilesets and subtrees of earlier joins.
fn remove_others(folder: &TileFolder, written: &BTreeSet<PathBuf>) -> Result<()> {
    let is_tileset = |name: &str| {
        name == IMPLICIT_NAME
            || name == format!("{TERRAIN}.json")
            || name.ends_with(".json")
                && ["tileset-", "implicit-", "terrain-"].into_iter().any(|start| name.starts_with(start))
    };
    for entry in fs::read_dir(folder.path()).into_iter().flatten().flatten() {
        if is_tileset(&entry.file_name().to_string_lossy()) && !written.contains(&entry.path()) {
            remove(&entry.path())?;
        }
    }
    remove_subtrees(&folder.subtrees(), written)
}

/// Removes the subtrees below a folder that have not been written, and empty folders.
fn remove_subtrees(folder: &Path, written: &BTreeSet<PathBuf>) -> Result<()> {
    for entry in fs::read_dir(folder).into_iter().flatten().flatten() {
        let path = entry.path();
        if entry.file_type().is_ok_and(|kind| kind.is_dir()) {
            remove_subtrees(&path, written)?;
        } else if path.extension().is_some_and(|extension| extension == "subtree") && !written.contains(&path)
        {
            remove(&path)?;
        }
    }
    // A folder that is not empty stays.
    let _ = fs::remove_dir(folder);
    Ok(())
}

fn remove(path: &Path) -> Result<()> {
    fs::remove_file(path).map_err(|error| {
        Error::file(path, format!("cannot remove {}: {error}", path.display()))
            .help("remove it: it belongs to an earlier tileset")
    })
}
