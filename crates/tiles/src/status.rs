//! Progress of all processes that make the tiles of a plan.

use std::fs;
use std::time::{Duration, SystemTime};

use burgeon_base::error::Result;

use crate::folder::TileFolder;
use crate::make::TileManifest;
use crate::plan::{TileId, TilePlan};

/// Progress of a plan.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct TileStatus {
    /// Number of tiles that were made.
    pub done: usize,
    /// Tiles that failed, with their messages.
    pub failed: Vec<(TileId, String)>,
    /// Number of tiles to be made.
    pub open: usize,
    /// Part of the expected cost that is done, from 0 to 1.
    pub part: f64,
    /// Tiles a minute between the first and the last tile that fits the plan; `None` with fewer than two.
    pub rate: Option<f64>,
    /// Slowest tiles of the times that the processes recorded, with seconds.
    pub slowest: Vec<(String, f64)>,
}

/// Number of slowest tiles that are listed.
const SLOWEST: usize = 5;

impl TileStatus {
    /// Reads the progress from the manifests and from the recorded times.
    pub fn read(folder: &TileFolder, plan: &TilePlan) -> Result<Self> {
        let mut status = Self::default();
        let (mut done, mut all) = (0.0, 0.0);
        let mut times: Vec<SystemTime> = Vec::new();
        let (terrain_folder, terrain) = (folder.terrain(), plan.terrain_tiles()?);
        let of_terrain = terrain.iter().map(|tile| (&terrain_folder, tile));
        for (folder, tile) in plan.all_tiles().into_iter().map(|tile| (folder, tile)).chain(of_terrain) {
            all += tile.cost;
            let Some(manifest) = TileManifest::fitting(folder, tile)? else {
                status.open += 1;
                continue;
            };
            done += tile.cost;
            times.extend(fs::metadata(folder.manifest(tile.id)).and_then(|file| file.modified()));
            match manifest.error {
                Some(error) => status.failed.push((tile.id, error.message)),
                None => status.done += 1,
            }
        }
        status.part = if all > 0.0 { done / all } else { 1.0 };
        let span = times.iter().max().zip(times.iter().min());
        let span = span.and_then(|(last, first)| last.duration_since(*first).ok());
        #[allow(clippy::cast_precision_loss, reason = "a rate is approximate")]
        let rate = |span: Duration| (times.len() - 1) as f64 / span.as_secs_f64() * 60.0;
        status.rate = span.filter(|span| !span.is_zero()).map(rate);
        status.slowest = slowest(folder);
        Ok(status)
    }
}

/// Returns the slowest tiles of all recorded times.
fn slowest(folder: &TileFolder) -> Vec<(String, f64)> {
    let mut times = std::collections::BTreeMap::<String, f64>::new();
    for entry in fs::read_dir(folder.logs()).into_iter().flatten().flatten() {
        let text = fs::read_to_string(entry.path()).unwrap_or_default();
        for line in text.lines() {
            let Some((tile, seconds)) = line.split_once('\t') else { continue };
            if let Ok(seconds) = seconds.parse::<f64>() {
                times.insert(tile.to_owned(), seconds);
            }
        }
    }
    let mut times: Vec<(String, f64)> = times.into_iter().collect();
    times.sort_by(|a, b| b.1.total_cmp(&a.1).then_with(|| a.0.cmp(&b.0)));
    times.truncate(SLOWEST);
    times
}
