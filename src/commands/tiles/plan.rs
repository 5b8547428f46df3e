//! `burgeon tiles plan`: divides the features of a script among tiles.

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use burgeon::script::{RunOptions, Session};
use burgeon::sources::{DataSources, SourceSurvey, SurveyedSource};
use burgeon::tiles::TileFolder;
use burgeon::tiles::plan::{
    PLAN_VERSION, PlanFrame, PlannedFile, PlannedSource, TileDivision, TilePlan, scan_source,
};
use burgeon::{Error, Result};
use clap::Args;
use serde_json::json;

use super::super::report;
use super::super::shared::ScriptFlags;
use super::inputs::{hash_file, portable_path};

/// Divides the features of a script among tiles, and writes the plan
#[derive(Args)]
pub(super) struct PlanCommand {
    #[command(flatten)]
    script: ScriptFlags,

    /// Folder of the plan and the tiles
    #[arg(short, long, value_name = "FOLDER", group = "division")]
    output: PathBuf,

    /// Number of features of a tile, if they have the average cost
    #[arg(long, value_name = "N", default_value_t = 500, value_parser = clap::value_parser!(u64).range(1..=1_000_000))]
    target_features: u64,

    /// Height of the origin of heights above the WGS 84 ellipsoid (m) [default: 0, with a warning]
    #[arg(long, value_name = "METRES", value_parser = height, allow_negative_numbers = true)]
    geoid_height: Option<f64>,

    /// Attributes of features to include; '*' for all [default: those that the script names]
    #[arg(long, value_name = "NAMES", value_delimiter = ',')]
    metadata: Vec<String>,

    /// Replaces the plan of another script or of other arguments
    #[arg(long)]
    replace: bool,
}

fn height(text: &str) -> Result<f64, &'static str> {
    match text.parse::<f64>() {
        Ok(metres) if metres.abs() < 20_000.0 => Ok(metres),
        _ => Err("write a number of metres, such as 44.5"),
    }
}

impl PlanCommand {
    pub(super) fn json(&self) -> bool {
        self.script.json
    }

    pub(super) fn run(&self) -> Result<()> {
        if self.script.has_databases() {
            return Err(Error::usage("tiles are made from files, and not from databases")
                .help("export the features to a GeoPackage, for example with ogr2ogr"));
        }
        let survey = self.survey()?;
        let (session, survey) = survey;
        let folder = TileFolder(self.output.clone());
        fs::create_dir_all(folder.path()).map_err(|error| {
            Error::file(
                folder.path(),
                format!("cannot create the folder {}: {error}", folder.path().display()),
            )
            .help("write to a folder with write permission")
        })?;
        let plan = self.plan(&session, &survey, folder.path())?;
        let earlier = self.check_earlier(&folder, &plan)?;
        let text = plan.text()?;
        burgeon::export::write_file(&folder.plan(), |out| std::io::Write::write_all(out, text.as_bytes()))?;
        self.report(&plan, earlier.as_ref())
    }

    /// Runs the script without features, and returns its sources. A script that needs features to declare its systems runs
    /// with them.
    fn survey(&self) -> Result<(Arc<Session>, Arc<SourceSurvey>)> {
        let run = |keeps_features| {
            let survey = Arc::new(SourceSurvey::new(keeps_features));
            let mut options = RunOptions { check: true, strict: false, ..self.script.options()? };
            options.part = None;
            options.registry.set_sources(Arc::new(DataSources::surveyed(&survey)));
            let session = Session::new(&self.script.script, options)?;
            burgeon::run_session(&session)?;
            Ok((session, survey))
        };
        run(false).or_else(|_: Error| run(true))
    }

    fn plan(&self, session: &Session, survey: &SourceSurvey, folder: &Path) -> Result<TilePlan> {
        let sources = feature_sources(session, survey)?;
        let Some((crs, place)) = survey.frame() else {
            return Err(Error::script("the coordinates of the tiles do not come from a file of features")
                .help("load the features before other data"));
        };
        let epsg = crs.code.ok_or_else(|| {
            Error::data(format!("{} has no EPSG code", crs.name()))
                .help("specify one: source(file, { crs = 2154 })")
        })?;
        let frame = PlanFrame { epsg, place, geoid_height: self.geoid_height.unwrap_or(0.0) };
        let reference = frame.reference()?;
        let mut division = TileDivision::default();
        let (mut planned, mut left_out, mut notes) = (Vec::new(), Vec::new(), Vec::new());
        for source in &sources {
            let scan = scan_source((&source.path, &source.name, &source.options), &reference, &mut division)?;
            let (key, label) = (source.key.clone(), scan.label);
            planned.push(PlannedSource {
                key,
                label,
                features: scan.features,
                bounds: scan.bounds,
                in_parts: scan.in_parts,
            });
            left_out.extend(scan.left_out);
            notes.extend(scan.notes);
        }
        let portable = |path: &Path| portable_path(folder, path);
        let own: BTreeSet<PathBuf> =
            sources.iter().filter_map(|source| source.path.canonicalize().ok()).collect();
        let read = session.sought().into_iter().filter(|(path, there)| *there && path.is_file());
        let mut files = Vec::new();
        for (path, _) in read {
            if !path.canonicalize().is_ok_and(|path| own.contains(&path)) {
                files.push(PlannedFile { path: portable(&path)?, hash: hash_file(&path)? });
            }
        }
        files.sort_by(|a, b| a.path.cmp(&b.path));
        files.dedup();
        let packages = session.lock()?;
        let packages = packages.iter().map(|it| format!("{} {} {}", it.name, it.version, it.hash)).collect();
        let mut plan = TilePlan {
            version: PLAN_VERSION,
            program: env!("CARGO_PKG_VERSION").to_owned(),
            script: portable(&self.script.script)?,
            arguments: self.script.arguments(portable)?,
            files,
            packages,
            frame,
            reach: self.script.reach(),
            metadata: self.metadata.clone(),
            sources: planned,
            tiles: division.tiles(self.target_features),
            left_out,
            notes,
        };
        plan.set_hashes()?;
        Ok(plan)
    }

    /// Returns the earlier plan of the folder. Fails if it is that of another script or of other arguments.
    fn check_earlier(&self, folder: &TileFolder, plan: &TilePlan) -> Result<Option<TilePlan>> {
        let path = folder.plan();
        if !path.exists() || self.replace {
            return Ok(None);
        }
        let earlier = TilePlan::read(&path)?;
        let same = (&earlier.script, &earlier.arguments) == (&plan.script, &plan.arguments)
            && (earlier.reach, &earlier.metadata) == (plan.reach, &plan.metadata);
        if same {
            return Ok(Some(earlier));
        }
        let message =
            format!("{} has the plan of {} with other arguments", folder.path().display(), earlier.script);
        Err(Error::usage(message).help("choose another folder, or replace the plan: --replace"))
    }

    fn report(&self, plan: &TilePlan, earlier: Option<&TilePlan>) -> Result<()> {
        let features: u64 = plan.sources.iter().map(|source| source.features).sum();
        let known: BTreeSet<&str> =
            earlier.iter().flat_map(|plan| &plan.tiles).map(|tile| tile.hash.as_str()).collect();
        let kept = plan.tiles.iter().filter(|tile| known.contains(tile.hash.as_str())).count();
        let mut warnings = plan.notes.clone();
        if self.geoid_height.is_none() {
            warnings.push(
                "heights are taken as heights above the WGS 84 ellipsoid; national heights are above a geoid: --geoid-height METRES"
                    .to_owned(),
            );
        }
        if !plan.left_out.is_empty() {
            let (count, first) = (plan.left_out.len(), &plan.left_out[0]);
            warnings
                .push(format!("{count} features are in no tile, such as {}: {}", first.feature, first.cause));
        }
        if self.script.json {
            let document = json!({
                "ok": true, "tiles": plan.tiles.len(), "unchanged": kept, "features": features,
                "left_out": plan.left_out.len(), "warnings": warnings, "peak_memory_mb": report::peak_memory(),
            });
            return report::print(&format!("{document}\n"));
        }
        let largest = plan.tiles.iter().map(|tile| tile.features).max().unwrap_or(0);
        report::eprint(&format!(
            "{features} features in {} tiles, at most {largest} in one; {kept} tiles unchanged\n{}",
            plan.tiles.len(),
            report::memory_text()
        ));
        warnings.iter().for_each(|warning| report::eprint(&format!("warning: {warning}\n")));
        Ok(())
    }
}

/// Returns the sources whose features become chains. Fails if there are none, or if they are not distinct layers of files.
fn feature_sources(session: &Session, survey: &SourceSurvey) -> Result<Vec<SurveyedSource>> {
    let labels = session.feature_sources();
    if labels.is_empty() {
        return Err(Error::script("the script makes no chains from features, so there is nothing to divide")
            .help("write system:axiom(source(FILE), function(feature) ... end)"));
    }
    let loaded = survey.sources();
    let mut found = Vec::new();
    for label in labels {
        let Some(label) = label else {
            return Err(Error::script("the script makes chains from a list, which tiles cannot divide")
                .help("write the features to a file, and load it: source(FILE)"));
        };
        let mut own = loaded.iter().filter(|source| source.label == label);
        match (own.next(), own.next()) {
            (Some(source), None) => found.push(source.clone()),
            (None, _) => {
                return Err(Error::script(format!(
                    "{label} is not a layer of a file, so tiles cannot divide it"
                ))
                .help("export it to a GeoPackage"));
            }
            _ => {
                return Err(Error::script(format!("the script loads {label} twice with different options"))
                    .help("load it once"));
            }
        }
    }
    Ok(found)
}
