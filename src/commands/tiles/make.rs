//! `burgeon tiles make`: makes the tiles of a plan, or a share of them.

use std::fs;
use std::io::Write as _;
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::{Duration, Instant};

use burgeon::tiles::make::{
    BuiltTile, GroundColors, PlainGround, TerrainHeights, make_tile, sweep_temporary,
};
use burgeon::tiles::plan::{TileShare, share_of};
use burgeon::tiles::{EarthMap, PlannedTile, TileFolder, TileId, TileManifest, TileOutcome, TilePlan};
use burgeon::{Error, Result, Stop};
use clap::{Args, ValueHint};
use serde_json::json;

use super::super::progress::ProgressDisplay;
use super::super::report;
use super::super::shared::{end_on_interrupt, seconds, threads};
use super::build::TileBuilder;
use super::ground::ScriptGround;
use super::inputs::{geoid, planned_flags, terrain_heights, tile_folder, verify_files};

/// Makes the tiles of a plan that have not been made, or a share of them
#[derive(Args)]
pub(super) struct MakeCommand {
    /// Folder of the plan
    #[arg(value_parser = tile_folder(), value_hint = ValueHint::AnyPath)]
    folder: TileFolder,

    /// Makes one of N shares of about the same cost, such as 3/64
    #[arg(long, value_name = "K/N", value_parser = share, group = "choice")]
    share: Option<TileShare>,

    /// Makes one of N shares, whose number a scheduler sets: SLURM_ARRAY_TASK_ID or JOB_COMPLETION_INDEX
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=1_000_000), group = "choice")]
    of: Option<u32>,

    /// Makes one tile, such as 12/2048/2049
    #[arg(long, value_name = "LEVEL/X/Y", value_parser = tile, group = "choice")]
    tile: Option<TileId>,

    /// Makes tiles again that failed
    #[arg(long)]
    retry_failed: bool,

    /// Age of temporary files that ended processes have left behind and that are removed
    #[arg(long, value_name = "SECONDS", default_value_t = 3600.0, value_parser = age)]
    stale_after: f64,

    /// Number of threads; does not affect the result [default: number of cores]
    #[arg(long, value_name = "N", value_parser = threads, allow_negative_numbers = true)]
    threads: Option<u16>,

    /// Prints machine-readable JSON instead of text
    #[arg(long)]
    pub(super) json: bool,
}

fn share(text: &str) -> Result<TileShare, String> {
    text.parse().map_err(Error::into_message)
}

fn tile(text: &str) -> Result<TileId, String> {
    text.parse().map_err(Error::into_message)
}

fn age(text: &str) -> Result<f64, &'static str> {
    if text == "0" { Ok(0.0) } else { seconds(text) }
}

/// Number of tiles in a row that cannot be written before the command ends.
const PATIENCE: usize = 3;

/// Counts of the tiles of a command.
#[derive(Default)]
struct MakeCounts {
    made: usize,
    kept: usize,
    failed: Vec<String>,
    /// Errors that may not occur again.
    retriable: Vec<Error>,
}

impl MakeCommand {
    pub(super) fn run(&self) -> Result<()> {
        let begin = Instant::now();
        let folder = &self.folder;
        let plan = TilePlan::read(&folder.plan())?;
        let terrain = plan.terrain_tiles()?;
        let planned: Vec<&PlannedTile> = plan.all_tiles().into_iter().chain(&terrain).collect();
        let features = planned.len() - terrain.len();
        let (name, tiles) = self.tiles(&planned)?;
        verify_files(folder.path(), &plan)?;
        end_on_interrupt()?;
        let terrain_folder = folder.terrain();
        for folder in [folder, &terrain_folder] {
            sweep_temporary(folder, Duration::from_secs_f64(self.stale_after));
        }
        let mut ground = None;
        let flags = planned_flags(folder.path(), &plan, self.threads)?;
        let builder = TileBuilder::new(&plan, &flags.script, flags.options()?)?;
        let frame = plan.frame.reference()?;
        let map = EarthMap::new(&frame, plan.frame.geoid_height)?.above(geoid(folder.path(), &plan)?);
        let (done, all) = (Arc::new(AtomicUsize::new(0)), tiles.len());
        let shown = Arc::clone(&done);
        let _progress = ProgressDisplay::saying(
            move || progress(shown.load(Ordering::Relaxed), all, begin.elapsed()),
            !self.json,
        );
        let mut counts = MakeCounts::default();
        let mut in_a_row = 0;
        for index in tiles {
            let tile = planned[index];
            let is_terrain = index >= features;
            let folder = if is_terrain { &terrain_folder } else { folder };
            self.forget_failed(folder, tile.id)?;
            let started = Instant::now();
            // Each tile has its own signal, so that limits apply to a tile.
            let stop = Arc::new(Stop::default());
            let build = |tile: &PlannedTile| match (&plan.terrain, is_terrain) {
                (Some(terrain), true) => {
                    // A share without terrain tiles to be made does not read the heights.
                    match ground.get_or_insert_with(|| self.ground(&plan, &builder)) {
                        Ok(ground) => {
                            let proceed = builder.proceed(&stop, "making a terrain tile", "");
                            ground.heights.build(terrain, tile, plan.model, ground.colors(), &proceed)
                        }
                        Err(error) => BuiltTile::failed(error.clone()),
                    }
                }
                _ => builder.build(tile, &stop),
            };
            match make_tile(folder, tile, &map, &stop, build) {
                Ok(outcome) => {
                    in_a_row = 0;
                    counts.add(&outcome);
                    if matches!(outcome, TileOutcome::Made(_)) {
                        note_time(&self.folder, &name, tile.id, started.elapsed());
                    }
                }
                Err(error) => {
                    in_a_row += 1;
                    counts.retriable.push(error.noting(&format!("tile {}", tile.id)));
                    if in_a_row >= PATIENCE {
                        break;
                    }
                }
            }
            done.fetch_add(1, Ordering::Relaxed);
        }
        drop(_progress);
        self.report(counts, begin.elapsed())
    }

    /// Returns the heights and the colours of the terrain of a plan.
    fn ground(&self, plan: &TilePlan, builder: &TileBuilder<'_>) -> Result<PlannedGround> {
        let heights = terrain_heights(self.folder.path(), plan)?;
        let heights = heights.ok_or_else(|| Error::internal("the plan has no terrain"))?;
        let is_colored = plan.terrain.as_ref().is_some_and(|terrain| terrain.is_colored);
        let script = if is_colored { builder.ground()? } else { None };
        Ok(PlannedGround { heights, script })
    }

    /// Returns the name of the share and the indices of its tiles.
    fn tiles(&self, planned: &[&PlannedTile]) -> Result<(String, Vec<usize>)> {
        if let Some(id) = self.tile {
            let index = planned.iter().position(|tile| tile.id == id).ok_or_else(|| {
                Error::argument(format!("the plan has no tile {id}")).help("plan.json lists the tiles")
            })?;
            let TileId { level, x, y } = id;
            return Ok((format!("tile-{level}-{x}-{y}"), vec![index]));
        }
        let share = match (self.share, self.of) {
            (Some(share), _) => share,
            (None, Some(count)) => TileShare { number: scheduled(count)?, count },
            (None, None) => TileShare::ALL,
        };
        Ok((format!("share-{}-of-{}", share.number, share.count), share_of(planned, share)))
    }

    /// Removes the manifest of a failed tile, if such tiles are to be made again.
    fn forget_failed(&self, folder: &TileFolder, tile: TileId) -> Result<()> {
        if self.retry_failed && TileManifest::read(folder, tile)?.is_some_and(|known| known.error.is_some()) {
            let path = folder.manifest(tile);
            return fs::remove_file(&path).map_err(|error| {
                Error::file(&path, format!("cannot remove {}: {error}", path.display()))
                    .help("check its permissions")
            });
        }
        Ok(())
    }

    fn report(&self, counts: MakeCounts, elapsed: Duration) -> Result<()> {
        let MakeCounts { made, kept, failed, retriable } = counts;
        if self.json && failed.is_empty() && retriable.is_empty() {
            let document = json!({
                "ok": true, "made": made, "kept": kept, "failed": 0,
                "seconds": elapsed.as_secs_f64(), "peak_memory_mb": report::peak_memory(),
            });
            return report::print(&format!("{document}\n"));
        }
        if !self.json {
            let time = report::time(elapsed);
            let memory = report::memory_text();
            report::eprint(&format!("{made} tiles made and {kept} kept in {time}\n{memory}"));
        }
        if let Some(first) = retriable.into_iter().next() {
            return Err(first);
        }
        match failed.first() {
            None => Ok(()),
            Some(first) => Err(Error::data(format!("{} tiles failed, such as {first}", failed.len()))
                .help("burgeon tiles join FOLDER lists the missing features with their causes; once a cause is removed, make the tiles again: --retry-failed")),
        }
    }
}

/// Heights of the terrain of a plan, and the terrain of the script that gives it colours.
struct PlannedGround {
    heights: TerrainHeights,
    script: Option<ScriptGround>,
}

impl PlannedGround {
    fn colors(&self) -> &dyn GroundColors {
        self.script.as_ref().map_or(&PlainGround, |script| script)
    }
}

impl MakeCounts {
    fn add(&mut self, outcome: &TileOutcome) {
        let manifest = outcome.manifest();
        match (&manifest.error, outcome) {
            (Some(error), _) => self.failed.push(format!("{}: {}", manifest.tile, error.message)),
            (None, TileOutcome::Made(_)) => self.made += 1,
            (None, TileOutcome::Kept(_)) => self.kept += 1,
        }
    }
}

/// Returns the number of the share, from 1, that the scheduler of a job array sets.
fn scheduled(count: u32) -> Result<u32> {
    let number = |name: &str| -> Option<u32> { std::env::var(name).ok()?.trim().parse().ok() };
    let first = number("SLURM_ARRAY_TASK_MIN").unwrap_or(0);
    let index = number("SLURM_ARRAY_TASK_ID").map(|task| task.checked_sub(first));
    let index = index.or_else(|| number("JOB_COMPLETION_INDEX").map(Some)).flatten();
    match index {
        Some(index) if index < count => Ok(index + 1),
        Some(index) => {
            Err(Error::usage(format!("the scheduler sets index {index}, but there are {count} shares"))
                .help(format!("submit an array of {count} jobs")))
        }
        None => {
            Err(Error::usage("--of needs the index of a job: SLURM_ARRAY_TASK_ID or JOB_COMPLETION_INDEX")
                .help("outside a job array, write --share 1/4"))
        }
    }
}

/// Appends the time of a tile to the times of a share. They are for people, so a failure is ignored.
fn note_time(folder: &TileFolder, share: &str, tile: TileId, time: Duration) {
    let write = || -> std::io::Result<()> {
        fs::create_dir_all(folder.logs())?;
        let mut log = fs::OpenOptions::new().create(true).append(true).open(folder.log(share))?;
        log.write_all(format!("{tile}\t{:.3}\n", time.as_secs_f64()).as_bytes())
    };
    let _ = write();
}

fn progress(done: usize, all: usize, elapsed: Duration) -> String {
    #[allow(clippy::cast_precision_loss, reason = "a rate is approximate")]
    let rate = done as f64 / elapsed.as_secs_f64().max(1e-3);
    #[allow(clippy::cast_precision_loss, reason = "a rest is approximate")]
    let rest = (all - done.min(all)) as f64 / rate.max(1e-6);
    let left = if done == 0 { String::new() } else { format!(", {rest:.0} s left") };
    format!("{done} of {all} tiles, {:.0} a minute{left}", rate * 60.0)
}
