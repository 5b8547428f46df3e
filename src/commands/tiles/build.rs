//! Runs of a script for single tiles.

use std::cell::Cell;
use std::path::Path;
use std::sync::Arc;
use std::time::{Duration, Instant};

use burgeon::error::Limit;
use burgeon::scene::Scene;
use burgeon::script::{FeatureChoice, FeaturePart, RunOptions, Session};
use burgeon::sources::{DataSources, Layer, ReferenceFrame, SourceWindow, WindowBox};
use burgeon::tiles::make::{
    BuiltTile, TileContent, TileTables, is_retriable, portable_message, tile_features, verify_features,
};
use burgeon::tiles::measure::FeatureDrawings;
use burgeon::tiles::plan::TileGrid;
use burgeon::tiles::{PlannedTile, TilePlan};
use burgeon::warning::WarningKind;
use burgeon::{Error, Result, Run, Stop};

use super::super::run::{attributes, systems};
use super::ground::ScriptGround;

/// Script that is run for one tile after another, with the data that tiles share.
pub(super) struct TileBuilder<'a> {
    plan: &'a TilePlan,
    frame: ReferenceFrame,
    options: RunOptions,
    sources: DataSources,
    script: &'a Path,
    /// Set if the top level of the script took long in the last run, so that native code pays from the start.
    is_slow: Cell<bool>,
}

/// Times of the top level of a script with and without native code, above which it is slow.
const SLOW: [Duration; 2] = [Duration::from_millis(30), Duration::from_millis(60)];

impl<'a> TileBuilder<'a> {
    pub(super) fn new(plan: &'a TilePlan, script: &'a Path, mut options: RunOptions) -> Result<Self> {
        options.reports.records = true;
        options.limits.whole_program = true;
        let (frame, sources) = (plan.frame.reference()?, DataSources::cached());
        Ok(Self { plan, frame, options, sources, script, is_slow: Cell::new(false) })
    }

    /// Builds a tile. One of the features also has the errors of the coarser levels of detail, unless `stop` is requested or measuring
    /// them exceeds the time limit of a run.
    pub(super) fn build(&self, tile: &PlannedTile, stop: &Stop) -> BuiltTile {
        let window = self.window(tile);
        let run = self.run(tile, &window, tile.lod.unwrap_or(self.options.lod));
        let served = window.served().into_iter();
        let is_planned = |key: &String| self.plan.sources.iter().any(|source| source.key == *key);
        let layers: Vec<Arc<Layer>> =
            served.filter(|(key, _)| is_planned(key)).map(|(_, layer)| layer).collect();
        let all = layers.len() == self.plan.sources.len();
        let features = tile_features(self.plan, tile, &layers);
        // Changed data explain an error of the script better than the error.
        let verified = if all { verify_features(self.plan, tile, &layers) } else { Ok(()) };
        let is_of_plan = all && verified.is_ok();
        let content = verified.and(run).and_then(|(session, run)| self.content(&session, run));
        let content = content.map(|content| {
            let detail = self.options.lod;
            let tables = TileTables::new(self.plan, tile, &content, &layers, (&self.frame, detail));
            TileContent { tables, ..content }
        });
        let content = content.and_then(|content| match tile.lod {
            None => {
                let errors = self.errors(tile, &content.scene, stop)?;
                Ok(TileContent { errors, ..content })
            }
            Some(_) => Ok(content),
        });
        BuiltTile { features, content, is_of_plan }
    }

    /// Returns the features of a tile in a level of detail.
    pub(super) fn scene(&self, tile: &PlannedTile, lod: u8) -> Result<Scene> {
        self.run(tile, &self.window(tile), lod).map(|(_, run)| run.scene)
    }

    /// Returns the errors (m) of the coarser levels of detail of a tile, whose features are `fine`.
    fn errors(&self, tile: &PlannedTile, fine: &Scene, stop: &Stop) -> Result<Vec<f64>> {
        if self.plan.lods.is_empty() {
            return Ok(Vec::new());
        }
        let scene = |lod: &u8| match self.scene(tile, *lod) {
            Err(error) if is_retriable(&error) => Err(error),
            // Where a coarser level fails, its tile reports the failure, and nothing is drawn.
            scene => Ok(scene.unwrap_or_default()),
        };
        let scenes: Vec<Scene> = self.plan.lods.iter().map(scene).collect::<Result<_>>()?;
        let coarse: Vec<FeatureDrawings<'_>> = scenes.iter().map(FeatureDrawings::new).collect();
        FeatureDrawings::new(fine).errors(
            &coarse,
            &self.proceed(
                stop,
                "measuring the levels of detail",
                "plan smaller tiles, --target-features, or ",
            ),
        )
    }

    /// Returns a function that fails as soon as `stop` is requested, or `work` beside a run exceeds the time limit of a run. `remedy`
    /// precedes that of a higher limit.
    pub(super) fn proceed(&self, stop: &Stop, work: &str, remedy: &str) -> impl Fn() -> Result<()> + Sync {
        let (begin, limit) = (Instant::now(), self.options.limits.time);
        move || {
            stop.check()?;
            if begin.elapsed() < limit {
                return Ok(());
            }
            let message = format!("{work} exceeded the time limit of {} s", limit.as_secs_f64());
            Err(Error::limit(Limit::Time, message)
                .help(format!("{remedy}raise the limit: --time-limit SECONDS")))
        }
    }

    /// Returns the terrain of the script that gives terrain tiles their colours, if there is one.
    ///
    /// The script runs without features, or, if it needs some, with those of the first tile.
    pub(super) fn ground(&self) -> Result<Option<ScriptGround>> {
        let Some(tile) = self.plan.tiles.first() else { return Ok(None) };
        let beside = |[low, _]: [[f64; 3]; 2]| [low[0] - 20.0, low[1] - 20.0, low[0] - 10.0, low[1] - 10.0];
        let without = self.run(tile, &self.window_of(beside), self.options.lod);
        let run = without.or_else(|_: Error| self.run(tile, &self.window(tile), self.options.lod));
        run.map(|(_, run)| ScriptGround::find(run))
    }

    /// Returns the boxes of the features that a tile needs.
    fn window(&self, tile: &PlannedTile) -> Arc<SourceWindow> {
        let needed = self.plan.needed(tile);
        self.window_of(|_| needed)
    }

    /// Returns boxes of features, of which `needed` returns west, south, east and north (m) from the bounds (m) of a source.
    fn window_of(&self, needed: impl Fn([[f64; 3]; 2]) -> [f64; 4]) -> Arc<SourceWindow> {
        let boxes = self.plan.sources.iter().map(|source| {
            let (in_parts, bounds) = (source.in_parts, source.bounds);
            (source.key.clone(), WindowBox { needed: needed(bounds), in_parts, bounds })
        });
        Arc::new(SourceWindow::new(self.frame.clone(), boxes.collect()))
    }

    fn run(&self, tile: &PlannedTile, window: &Arc<SourceWindow>, lod: u8) -> Result<(Arc<Session>, Run)> {
        let mut options = self.options.clone();
        options.lod = lod;
        options.waits_with_native = !self.is_slow.get();
        options.registry.set_sources(Arc::new(self.sources.windowed(window)));
        let cell = Some(TileGrid::bounds(tile.id));
        options.part = Some(FeaturePart { number: 1, count: 1, reach: self.plan.reach, cell });
        options.choice = tile.tall.zip(self.plan.tall.as_ref()).map(|(is_reached, rule)| FeatureChoice {
            attribute: rule.attribute.clone(),
            least: rule.least,
            is_reached,
        });
        let waits = options.waits_with_native;
        let session = Session::new(self.script, options)?;
        let mut run = burgeon::run_session(&session)?;
        self.is_slow.set(run.times.script > SLOW[usize::from(waits)]);
        run.note_packages(&session)?;
        Ok((session, run))
    }

    fn content(&self, session: &Session, run: Run) -> Result<TileContent> {
        let systems = systems(&run);
        let metadata = attributes(session, &self.plan.metadata, &systems)?;
        let mut skipped = Vec::new();
        for system in &run.systems {
            let layer = system.records().map(|records| records.name).unwrap_or_default();
            let skipped_features = system.feature_warnings.iter();
            for warning in skipped_features.filter(|warning| warning.kind() == WarningKind::SkippedFeature) {
                let Some(feature) = warning.feature() else { continue };
                let source = self.plan.sources.iter().find(|source| source.label == warning.source());
                // A label is the file and the layer.
                let named = source.and_then(|source| source.label.rsplit(':').next());
                let layer = if layer.is_empty() { named.unwrap_or_default() } else { &layer };
                skipped.push((layer.to_owned(), feature.to_owned(), warning.cause().to_owned()));
            }
        }
        let warnings = run.warnings.into_iter().map(|warning| portable_message(&warning.into_error()));
        let warnings = warnings.collect();
        let (model, errors) = (self.plan.model, Vec::new());
        Ok(TileContent {
            scene: run.scene,
            systems,
            metadata,
            model,
            skipped,
            warnings,
            errors,
            tables: None,
        })
    }
}
