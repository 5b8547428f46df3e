//! `burgeon tiles plan`: divides the features of a script among tiles.

use std::borrow::Cow;
use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use burgeon::export::gltf::{TileCompression, TileModelOptions};
use burgeon::scene::Scene;
use burgeon::script::{RunOptions, Session};
use burgeon::sources::{DataSources, SourceSurvey, SurveyedSource};
use burgeon::tiles::earth::GeoidGrid;
use burgeon::tiles::make::TerrainHeights;
use burgeon::tiles::measure::draws_the_same;
use burgeon::tiles::plan::{
    PLAN_VERSION, PlanFrame, PlannedFile, PlannedSource, PlannedTerrain, TableFormat, TallRule, TileDivision,
    TilePlan, coarse_tiles, scan_source,
};
use burgeon::tiles::{EarthMap, TileFolder};
use burgeon::{Error, Result};
use clap::{Args, ValueHint};
use serde_json::json;

use super::super::report;
use super::super::shared::ScriptFlags;
use super::build::TileBuilder;
use super::ground::ScriptGround;
use super::inputs::{hash_file, planned_files, portable_path, tile_folder};

/// Divides the features of a script among tiles, and writes the plan
#[derive(Args)]
pub(super) struct PlanCommand {
    #[command(flatten)]
    script: ScriptFlags,

    /// Folder of the plan and the tiles
    #[arg(short, long, value_name = "FOLDER", value_parser = tile_folder(), group = "division")]
    #[arg(value_hint = ValueHint::AnyPath)]
    output: TileFolder,

    /// Number of features of a tile, if they have the average cost
    #[arg(long, value_name = "N", default_value_t = 500, value_parser = clap::value_parser!(u64).range(1..=1_000_000))]
    target_features: u64,

    /// Height of the origin of heights above the WGS 84 ellipsoid (m) [default: 0, with a warning]
    #[arg(long, value_name = "METRES", value_parser = height, allow_negative_numbers = true)]
    geoid_height: Option<f64>,

    /// Grid of the heights of the geoid above the WGS 84 ellipsoid, such as a GeoTIFF, instead of a constant
    #[arg(long, value_name = "FILE", conflicts_with = "geoid_height")]
    geoid: Option<PathBuf>,

    /// Number of levels of detail: coarser tiles show the features at lower --lod from afar
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = clap::value_parser!(u8).range(1..=4))]
    levels: u8,

    /// Attributes of features to include; '*' for all [default: those that the script names]
    #[arg(long, value_name = "NAMES", value_delimiter = ',')]
    metadata: Vec<String>,

    /// Copies repeated models into the mesh of each tile, for viewers without EXT_mesh_gpu_instancing
    #[arg(long)]
    expand_instances: bool,

    /// Compression of tiles: none, quantize (KHR_mesh_quantization) or meshopt (also EXT_meshopt_compression)
    #[arg(long, value_name = "METHOD", value_parser = compression, default_value = "none")]
    compress: TileCompression,

    /// Largest step of compressed coordinates (m)
    #[arg(long, value_name = "METRES", default_value_t = 0.001, value_parser = precision)]
    precision: f64,

    /// Puts features whose attribute is at least a number into inner tiles, so that they are seen from afar, such as height:50
    #[arg(long, value_name = "ATTRIBUTE:NUMBER", value_parser = tall, conflicts_with = "levels")]
    tall: Option<TallRule>,

    /// Adds terrain tiles of a grid of heights, such as a GeoTIFF
    #[arg(long, value_name = "FILE")]
    terrain: Option<PathBuf>,

    /// Tables of the features of each tile, beside its content: cityjson (a CityJSON sequence) or geoparquet, or both
    #[arg(long, value_name = "FORMATS", value_delimiter = ',', value_parser = table)]
    tables: Vec<TableFormat>,

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

fn compression(text: &str) -> Result<TileCompression, &'static str> {
    match text {
        "none" => Ok(TileCompression::None),
        "quantize" => Ok(TileCompression::Quantize),
        "meshopt" => Ok(TileCompression::Meshopt),
        _ => Err("write none, quantize or meshopt"),
    }
}

/// Fails if there is no file at `path`; `what` is its content, and `help` the remedy.
fn check_file(path: &Path, what: &'static str, help: &str) -> Result<()> {
    if path.is_file() {
        return Ok(());
    }
    let name = path.display().to_string();
    let message = format!("there is no {what} {name}");
    Err(Error::not_found(what, name, [], message).help(help))
}

fn tall(text: &str) -> Result<TallRule, String> {
    text.parse().map_err(Error::into_message)
}

fn table(text: &str) -> Result<TableFormat, String> {
    let known = TableFormat::ALL.into_iter().find(|format| format.to_string() == text);
    known.ok_or_else(|| format!("write {}", TableFormat::ALL.map(|format| format.to_string()).join(" or ")))
}

fn precision(text: &str) -> Result<f64, &'static str> {
    match text.parse::<f64>() {
        Ok(metres) if (0.0001..=1.0).contains(&metres) => Ok(metres),
        _ => Err("write a number of metres from 0.0001 to 1, such as 0.01"),
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
        if cfg!(not(feature = "parquet")) && self.tables.contains(&TableFormat::Geoparquet) {
            return Err(Error::left_out("GeoParquet", "parquet"));
        }
        let (session, survey) = self.survey()?;
        let folder = &self.output;
        fs::create_dir_all(folder.path()).map_err(|error| {
            Error::file(
                folder.path(),
                format!("cannot create the folder {}: {error}", folder.path().display()),
            )
            .help("write to a folder with write permission")
        })?;
        let plan = self.plan(&session, &survey, folder.path())?;
        let earlier = self.check_earlier(folder, &plan)?;
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
        let geoid_height = self.geoid_height.unwrap_or(0.0);
        let frame = PlanFrame { epsg, place, geoid_height, geoid: None };
        let reference = frame.reference()?;
        let mut division = TileDivision::default();
        let (mut planned, mut left_out, mut notes) = (Vec::new(), Vec::new(), Vec::new());
        let own: BTreeSet<PathBuf> =
            sources.iter().filter_map(|source| source.path.canonicalize().ok()).collect();
        for source in sources {
            let scan = scan_source(
                (&source.path, &source.name, &source.options),
                &reference,
                self.tall.as_ref(),
                &mut division,
            )?;
            planned.push(PlannedSource {
                key: source.key,
                label: scan.label,
                features: scan.features,
                bounds: scan.bounds,
                in_parts: scan.in_parts,
                columns: scan.columns,
            });
            left_out.extend(scan.left_out);
            notes.extend(scan.notes);
        }
        self.check_tall(&planned)?;
        let portable = |path: &Path| portable_path(folder, path);
        let files = planned_files(session, folder, self.script.data_folders(), &own)?;
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
            model: self.model(),
            tables: TableFormat::ALL.into_iter().filter(|format| self.tables.contains(format)).collect(),
            sources: planned,
            tall: self.tall.clone(),
            terrain: None,
            lods: Vec::new(),
            tiles: division.tiles(self.target_features),
            coarse: Vec::new(),
            left_out,
            notes,
        };
        self.add_geoid(&mut plan, folder)?;
        self.add_terrain(&mut plan, folder)?;
        self.add_colors(&mut plan)?;
        self.add_levels(&mut plan)?;
        plan.set_hashes()?;
        Ok(plan)
    }

    /// Fails if no feature has the attribute of tall features.
    fn check_tall(&self, sources: &[PlannedSource]) -> Result<()> {
        let Some(TallRule { attribute, .. }) = &self.tall else { return Ok(()) };
        let names = || sources.iter().flat_map(|source| &source.columns).map(|column| column.name.as_str());
        if names().any(|name| name == attribute) {
            return Ok(());
        }
        let message = format!("--tall: no feature has an attribute named `{attribute}`");
        Err(Error::not_found("attribute", attribute, names().collect::<Vec<_>>(), message)
            .help("run burgeon sources FILE to list the attributes of a file"))
    }

    /// Returns the choices for the models of tiles.
    fn model(&self) -> TileModelOptions {
        TileModelOptions {
            expand_instances: self.expand_instances,
            compression: self.compress,
            precision: self.precision,
        }
    }

    /// Adds the grid of the geoid to a plan. Fails if it does not cover all tiles.
    fn add_geoid(&self, plan: &mut TilePlan, folder: &Path) -> Result<()> {
        let Some(path) = &self.geoid else { return Ok(()) };
        check_file(
            path,
            "geoid grid",
            "download one of your heights, such as a GeoTIFF of cdn.proj.org; or specify a constant: --geoid-height METRES",
        )?;
        let grid = GeoidGrid::open(path, &path.display().to_string())?;
        let frame = plan.frame.reference()?;
        let map = EarthMap::new(&frame, 0.0)?;
        let (mut sum, mut count) = (0.0, 0.0_f64);
        for tile in &plan.tiles {
            let [west, south, east, north] = tile.region;
            for place in [[west, south], [east, south], [east, north], [west, north]] {
                sum += grid.height(map.degrees(place)?)?;
                count += 1.0;
            }
        }
        plan.frame.geoid_height = (sum / count.max(1.0) * 1000.0).round() / 1000.0;
        let path_in_plan = portable_path(folder, path)?;
        plan.files.push(PlannedFile { path: path_in_plan.clone(), hash: hash_file(path)? });
        plan.frame.geoid = Some(path_in_plan);
        Ok(())
    }

    /// Adds the terrain to a plan.
    fn add_terrain(&self, plan: &mut TilePlan, folder: &Path) -> Result<()> {
        let Some(path) = &self.terrain else { return Ok(()) };
        check_file(path, "file of heights", "specify a grid of heights, such as a GeoTIFF")?;
        let frame = plan.frame.reference()?;
        let heights = TerrainHeights::open(path, &path.display().to_string(), &frame)?;
        let file = PlannedFile { path: portable_path(folder, path)?, hash: hash_file(path)? };
        plan.terrain = Some(PlannedTerrain::new(file, heights.area(), heights.step()));
        Ok(())
    }

    /// Finds the terrain of the script that gives the terrain of a plan its colours, and adds notes if there is none, or a choice.
    fn add_colors(&self, plan: &mut TilePlan) -> Result<()> {
        if plan.terrain.is_none() {
            return Ok(());
        }
        let ground = TileBuilder::new(plan, &self.script.script, self.script.options()?)?.ground();
        let one_color = |why: &str| Some(format!("terrain tiles have one colour, because {why}"));
        plan.notes.extend(match &ground {
            // The tiles whose features the script cannot make name the error, too.
            Err(error) => one_color(&format!(
                "the script fails with the features of the first tile: {}",
                error.message()
            )),
            Ok(None) => one_color("the script has no terrain with covers or water, such as terrain({ covers = ..., visible = false })"),
            Ok(Some(ScriptGround { choices: 0, terrains: 1, .. })) => {
                one_color("the terrain of the script has no covers and no water; they take its color")
            }
            Ok(Some(ScriptGround { choices: 0, terrains, .. })) => one_color(&format!(
                "none of the {terrains} terrains of the script has covers or water; they take the color of the first"
            )),
            Ok(Some(ScriptGround { choices: 1, .. })) => None,
            Ok(Some(ScriptGround { choices, .. })) => Some(format!(
                "terrain tiles have the colours of the first of the {choices} terrains with covers or water in the script"
            )),
        });
        if let Some(terrain) = &mut plan.terrain {
            terrain.is_colored = matches!(ground, Ok(Some(_)));
        }
        Ok(())
    }

    /// Adds coarser tiles to a plan, for the levels of detail that the script draws differently in samples.
    fn add_levels(&self, plan: &mut TilePlan) -> Result<()> {
        let options = self.script.options()?;
        let finest = options.lod;
        let lods = (finest.saturating_sub(self.levels - 1)..finest).rev();
        let builder = TileBuilder::new(plan, &self.script.script, options)?;
        let (kept, mut notes) = distinct_lods(plan, &builder, finest, lods);
        plan.coarse = coarse_tiles(&plan.tiles, &kept);
        plan.lods = kept;
        plan.notes.append(&mut notes);
        Ok(())
    }

    /// Returns the earlier plan of the folder. Fails if it is that of another script or of other arguments.
    fn check_earlier(&self, folder: &TileFolder, plan: &TilePlan) -> Result<Option<TilePlan>> {
        let path = folder.plan();
        if !path.exists() || self.replace {
            return Ok(None);
        }
        let earlier = TilePlan::read(&path)?;
        let terrain = |plan: &TilePlan| plan.terrain.as_ref().map(|terrain| terrain.file.path.clone());
        let same = (&earlier.script, &earlier.arguments) == (&plan.script, &plan.arguments)
            && (earlier.reach, &earlier.metadata, earlier.model) == (plan.reach, &plan.metadata, plan.model)
            && (&earlier.tables, &earlier.tall) == (&plan.tables, &plan.tall)
            && terrain(&earlier) == terrain(plan);
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
            earlier.iter().flat_map(|plan| plan.all_tiles()).map(|tile| tile.hash.as_str()).collect();
        let all = plan.all_tiles();
        let kept = all.iter().filter(|tile| known.contains(tile.hash.as_str())).count();
        let mut warnings: Vec<Cow<'_, str>> = plan.notes.iter().map(Cow::from).collect();
        let tall: u64 = plan.tiles.iter().filter(|tile| tile.is_tall()).map(|tile| tile.features).sum();
        if self.geoid_height.is_none() && self.geoid.is_none() {
            warnings.push(
                "heights are taken as heights above the WGS 84 ellipsoid; national heights are above a geoid: --geoid FILE or --geoid-height METRES"
                    .into(),
            );
        }
        if !plan.left_out.is_empty() {
            let (count, first) = (plan.left_out.len(), &plan.left_out[0]);
            let text = format!("{count} features are in no tile, such as {}: {}", first.feature, first.cause);
            warnings.push(text.into());
        }
        if self.script.json {
            let document = json!({
                "ok": true, "tiles": plan.tiles.len(), "tall": tall, "terrain": plan.terrain.as_ref().map_or(0, |terrain| terrain.tile_ids().len()), "coarse": plan.coarse.len(), "lods": plan.lods,
                "geoid": plan.frame.geoid, "geoid_height": plan.frame.geoid_height, "unchanged": kept, "features": features,
                "left_out": plan.left_out.len(), "warnings": warnings, "peak_memory_mb": report::peak_memory(),
            });
            return report::print(&format!("{document}\n"));
        }
        let terrain = plan.terrain.as_ref().map_or(0, |terrain| terrain.tile_ids().len());
        if terrain > 0 {
            report::eprint(&format!("{terrain} terrain tiles\n"));
        }
        let largest = plan.tiles.iter().map(|tile| tile.features).max().unwrap_or(0);
        let height = plan.frame.geoid_height;
        let heights = match &self.geoid {
            Some(path) => {
                format!("heights above the geoid of {}, about {height} m above the ellipsoid", path.display())
            }
            None => format!("heights begin {height} m above the ellipsoid"),
        };
        report::eprint(&format!(
            "{features} features in {} tiles, at most {largest} in one, and {} coarser tiles; {kept} tiles unchanged\n{heights}\n{}",
            plan.tiles.len(),
            plan.coarse.len(),
            report::memory_text()
        ));
        warnings.iter().for_each(|warning| report::eprint(&format!("warning: {warning}\n")));
        Ok(())
    }
}

/// Returns the levels of detail, from fine to coarse, that the script draws differently in three tiles, and notes on the others.
fn distinct_lods(
    plan: &TilePlan,
    builder: &TileBuilder<'_>,
    finest: u8,
    lods: impl ExactSizeIterator<Item = u8>,
) -> (Vec<u8>, Vec<String>) {
    let (mut kept, mut notes) = (Vec::new(), Vec::new());
    if lods.len() == 0 {
        return (kept, notes);
    }
    let count = plan.tiles.len();
    let samples: BTreeSet<usize> = [count / 6, count / 2, count * 5 / 6].into();
    // A tile that fails shows nothing; it reports its failure when it is made.
    let draw = |lod: u8| -> Vec<Option<Scene>> {
        let tiles = samples.iter().filter_map(|index| plan.tiles.get(*index));
        tiles.map(|tile| builder.scene(tile, lod).ok()).collect()
    };
    let mut finer = draw(finest);
    for lod in lods {
        let scenes = draw(lod);
        let pairs = finer.iter().zip(&scenes).filter_map(|(a, b)| a.as_ref().zip(b.as_ref()));
        let same: Vec<bool> = pairs.map(|(a, b)| draws_the_same(a, b)).collect();
        if !same.is_empty() && same.iter().all(|same| *same) {
            let above = kept.last().copied().unwrap_or(finest);
            notes.push(format!(
                "no coarser tiles at --lod {lod}: the script draws the same as at --lod {above}; read lod in the script"
            ));
            continue;
        }
        kept.push(lod);
        finer = scenes;
    }
    (kept, notes)
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
