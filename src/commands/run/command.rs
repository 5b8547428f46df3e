//! Command `run`.

use std::io::IsTerminal;
use std::path::PathBuf;
use std::sync::Arc;
use std::time::Instant;

use super::deadline::WritingDeadline;
use super::films::FilmFlags;
use super::levels::LevelFlags;
use super::{parts, watch};
use crate::commands::picture_flags::PictureFlags;
use crate::commands::progress::ProgressDisplay;
use crate::commands::report;
use crate::commands::shared::{STANDARD, ScriptFlags, end_on_interrupt, shell_word, size};
use burgeon::export::films::FilmFormat;
use burgeon::export::heights::{HEIGHT_FORMATS, HeightFormat};
use burgeon::export::{
    FORMATS, FileFormat, Format, GLB, InstanceStorage, Need, PAGE, PAGE_TRIANGLES, extension_list,
    refused_page,
};
use burgeon::picture::{CameraChoice, is_inside};
use burgeon::presets::Presets;
use burgeon::results::layers;
use burgeon::script::{FileLimit, Param, Preset, Print, RunOptions, Session};
use burgeon::{Error, Result, Warning, WarningKind};
use clap::builder::ArgPredicate;
use clap::{Args, ValueEnum};

/// Storage of repeated models
#[derive(Debug, Clone, Copy, ValueEnum)]
pub(super) enum InstancesFlag {
    /// A node for each instance, which every program reads
    Nodes,
    /// Smallest files, with EXT_mesh_gpu_instancing
    Extension,
    /// A mesh for each system and feature
    Expanded,
}

impl From<InstancesFlag> for InstanceStorage {
    fn from(flag: InstancesFlag) -> Self {
        match flag {
            InstancesFlag::Nodes => Self::Nodes,
            InstancesFlag::Extension => Self::Extension,
            InstancesFlag::Expanded => Self::Expanded,
        }
    }
}

/// Runs a script and writes its model
#[derive(Args, Clone)]
pub(crate) struct RunCommand {
    #[command(flatten)]
    pub(super) script: ScriptFlags,

    /// Files of the model
    #[arg(short, long, value_name = "FILE", value_parser = output, help = output_help(), long_help = output_list())]
    pub(super) output: Vec<PathBuf>,

    /// Format of the model on standard output, -o -
    #[arg(long, value_name = "EXTENSION", value_parser = standard_format, requires = "output")]
    pub(super) format: Option<String>,

    /// Attributes of features to include
    #[arg(long, value_name = "NAMES", num_args = 0..=1, require_equals = true, value_delimiter = ',')]
    #[arg(default_missing_value = "", help = metadata_help())]
    pub(super) metadata: Option<Vec<String>>,

    /// Storage of repeated models
    #[arg(long, value_name = "KIND", help = instances_help())]
    pub(super) instances: Option<InstancesFlag>,

    /// Leaves the recipe out of models: the script, its values, and the hashes of its packages and data
    #[arg(long)]
    pub(super) no_recipe: bool,

    /// Compresses arrays of models
    #[arg(long, help = compress_help(), conflicts_with = "film")]
    pub(super) compress: bool,

    /// Writes integers to models
    #[arg(long, help = quantize_help(), conflicts_with = "film")]
    pub(super) quantize: bool,

    /// Writes the final chains as text, one per line; - is standard output, or the JSON document with --json
    #[arg(long, value_name = "FILE")]
    pub(super) chain: Option<PathBuf>,

    /// File of the heights of the terrain
    #[arg(long, value_name = "FILE", value_parser = heights, help = heights_help(), long_help = heights_list())]
    pub(super) heights: Option<PathBuf>,

    /// Writes the terrain edits, for edits(FILE) in a script
    #[arg(long, value_name = "FILE")]
    pub(super) edits: Option<PathBuf>,

    /// Folder of the tiles of the terrain
    #[arg(long, value_name = "FOLDER", help = tiles_help())]
    pub(super) tiles: Option<PathBuf>,

    /// Writes a JSON report of skipped and simplified features; - is standard output
    #[arg(long, value_name = "FILE")]
    pub(super) report: Option<PathBuf>,

    /// Writes the model in N parts, one after another: FILE-1 to FILE-N. Memory is that of one part
    #[arg(long, value_name = "N", value_parser = parts::count, group = "division")]
    #[arg(conflicts_with_all = ["watch", "save_preset"])]
    pub(super) parts: Option<u32>,

    /// Runs and writes again on every save, until interrupted
    #[arg(long)]
    watch: bool,

    /// Prints file and line before each text that the script prints; of a film, also the frame
    #[arg(long)]
    places: bool,

    #[command(flatten)]
    pub(super) detail: LevelFlags,

    #[command(flatten)]
    pub(super) film: FilmFlags,

    /// Width and height of a render (pixels); 800x600 for films
    #[arg(long, value_name = "WIDTHxHEIGHT", value_parser = size, default_value = "1280x960", help_heading = "Pictures")]
    #[arg(default_value_ifs = [("frames", ArgPredicate::IsPresent, "800x600"), ("turntable", ArgPredicate::IsPresent, "800x600")])]
    pub(super) size: (u32, u32),

    #[command(flatten)]
    pub(super) picture: PictureFlags,

    /// Saves the seed and the given values as a preset, if the run succeeds
    #[arg(long, value_name = "NAME")]
    save_preset: Option<String>,
}

fn output_help() -> String {
    let formats = extension_list(&FORMATS, "or");
    format!("Writes the model to this file; the extension selects the format: {formats}. May be repeated")
}

fn output_list() -> String {
    let formats = format_list(FORMATS.iter().map(|format| &format.file));
    format!("Writes the model to this file; the extension selects the format. May be repeated\n\n{formats}")
}

fn metadata_help() -> String {
    let formats = extension_list(FORMATS.iter().filter(|format| format.has_metadata), "and");
    format!(
        "Includes ids and attributes of features in {formats} files: the attributes that the script names, or =NAMES, or \
         all with ='*'"
    )
}

fn instances_help() -> String {
    let is_gltf = |format: &&Format| format.media_type.starts_with("model/gltf");
    let formats = extension_list(FORMATS.iter().filter(is_gltf), "and");
    let most = InstanceStorage::MOST_NODES;
    format!(
        "Storage of repeated models in {formats} files [default: nodes up to {most} instances, else extension]"
    )
}

fn compress_help() -> String {
    format!("Compresses the arrays of .{} files, for viewers with EXT_meshopt_compression", GLB.extension())
}

/// Lists the extensions of glTF files.
pub(super) fn gltf_extensions() -> String {
    let is_gltf = |format: &&Format| format.media_type.starts_with("model/gltf");
    extension_list(FORMATS.iter().filter(is_gltf), "and")
}

fn quantize_help() -> String {
    let formats = gltf_extensions();
    format!("Writes the arrays of {formats} files as integers, for programs with KHR_mesh_quantization")
}

fn heights_help() -> String {
    let formats = extension_list(&HEIGHT_FORMATS, "or");
    format!("Writes the heights of the terrain as a height map: {formats}")
}

fn heights_list() -> String {
    let formats = format_list(HEIGHT_FORMATS.iter().map(|format| &format.file));
    format!(
        "Writes the heights of the terrain as a height map; the extension selects the format\n\n{formats}"
    )
}

fn tiles_help() -> String {
    format!("Writes a .{} file for each tile of the terrain to this folder", GLB.extension())
}

/// Lists `formats`, one per line.
fn format_list<'a>(formats: impl Iterator<Item = &'a FileFormat>) -> String {
    let line = |format: &FileFormat| format!("  {:<11} {}", format!(".{}", format.extension()), format.title);
    formats.map(line).collect::<Vec<_>>().join("\n")
}

impl RunCommand {
    pub(crate) fn json(&self) -> bool {
        self.script.json
    }

    /// Tells how to write or show the model, if nothing was written: to a person at a terminal, and after a command line without
    /// a command, which `is_short`.
    pub(crate) fn hint_at_outputs(&self, is_short: bool) {
        let files = [&self.chain, &self.heights, &self.tiles, &self.report];
        let writes =
            !self.output.is_empty() || files.into_iter().any(Option::is_some) || self.save_preset.is_some();
        let is_told = is_short || std::io::stderr().is_terminal();
        if is_told && !writes && !self.script.json && self.script.script.as_os_str() != STANDARD {
            let script = shell_word(&self.script.script);
            let model = shell_word(&self.script.script.with_extension(GLB.extension()));
            let live = if cfg!(feature = "live") {
                format!("; to see it: burgeon live {script}")
            } else {
                String::new()
            };
            report::eprint(&format!(
                "note: no file was written; to write it: burgeon {script} -o {model}{live}\n"
            ));
        }
    }

    /// Returns true if the command runs again on every save.
    pub(super) fn is_watching(&self) -> bool {
        self.watch
    }

    pub(crate) fn run(&self) -> Result<()> {
        if self.writes_standard() {
            return self.run_to_standard();
        }
        if self.format.is_some() {
            return Err(Error::usage(
                "--format is the format of standard output; the extension selects that of a file",
            )
            .help("leave it out, or write to standard output: -o - --format glb"));
        }
        if self.watch && self.script.script.as_os_str() == STANDARD {
            return Err(Error::usage("standard input cannot be watched").help("name a file in place of -"));
        }
        if let Some(axis) = &self.film.frames {
            return self.run_frames(axis);
        }
        if let Some(frames) = self.film.turntable {
            return self.run_turntable(frames);
        }
        self.refuse_films()?;
        if !self.detail.levels.is_empty() {
            return self.run_levels();
        }
        self.check_files()?;
        if let Some(name) = &self.save_preset {
            burgeon::presets::check_name(name)?;
            Presets::read(&self.script.script)?;
        }
        if self.watch {
            return watch::again_and_again(self);
        }
        if let Some(count) = self.parts {
            return self.run_parts(count);
        }
        end_on_interrupt()?;
        let begin = Instant::now();
        let session = self.session()?;
        let made = self.make(&session, begin, &|| false)?;
        // Exiting the process frees all memory at once, which is faster than dropping the values.
        std::mem::forget((made, session));
        Ok(())
    }

    /// Creates the session of the script, with its options.
    pub(super) fn session(&self) -> Result<Arc<Session>> {
        Session::new(&self.script.script, self.options()?)
    }

    /// Returns the options of the run.
    pub(super) fn options(&self) -> Result<RunOptions> {
        let records = self.metadata.is_some() || self.writes(Need::Attributes);
        let mut options = self.script.options()?;
        options.reports.records = records;
        self.place_prints(&mut options);
        options.limits.whole_program = true;
        if self.output.iter().any(|output| Format::of(output).is_ok_and(|format| format == &PAGE)) {
            let ((message, help), triangles) = (refused_page(), PAGE_TRIANGLES as usize);
            options.limits.file = Some(Arc::new(FileLimit { triangles, message, help: help.into() }));
        }
        Ok(options)
    }

    /// Lets the script print with places, if they are wanted.
    pub(super) fn place_prints(&self, options: &mut RunOptions) {
        if self.places {
            options.reports.print =
                Some(Print::with_places(|text, place| report::printed_at(text, place.as_ref())));
        }
    }

    /// Runs `session`, writes all outputs and reports the result, unless the run is `stale` before anything is written.
    pub(super) fn make(
        &self,
        session: &Arc<Session>,
        begin: Instant,
        stale: &dyn Fn() -> bool,
    ) -> Result<Option<burgeon::Run>> {
        let (run, writing) = {
            let _progress = ProgressDisplay::show(session, !self.script.json);
            let mut run = burgeon::run_session(session)?;
            if stale() {
                return Ok(None);
            }
            run.note_packages(session)?;
            self.warn_of_nothing(session, &mut run)?;
            self.warn_of_cameras(session, &mut run)?;
            let writing = Instant::now();
            let deadline = WritingDeadline::new(session);
            self.write(&mut run, session)?;
            drop(deadline);
            if let Some(name) = &self.save_preset {
                self.save(name, session, &run.params)?;
            }
            (run, writing.elapsed())
        };
        if self.script.json {
            let mut summary = report::summary_json(&run, writing, begin.elapsed());
            if self.chain_in_json() {
                let texts = run.systems.iter().map(|system| system.chain_text());
                let lines: Vec<String> =
                    texts.flat_map(|text| text.lines().map(str::to_owned).collect::<Vec<_>>()).collect();
                summary["chain"] = lines.into();
            }
            report::print(&format!("{summary}\n"))?;
        } else {
            report::eprint(&report::summary(&run, writing, begin.elapsed(), self.report.as_deref()));
        }
        Ok(Some(run))
    }

    /// Adds warnings about files without content. In strict mode such a run fails.
    fn warn_of_nothing(&self, session: &Session, run: &mut burgeon::Run) -> Result<()> {
        let is_bare = || layers(session, &run.systems).iter().all(|layer| layer.records.is_empty());
        if self.writes(Need::Layers) && is_bare() {
            let text = "no layers to write: no module of the final chains has a geometry";
            let warning = Warning::new(WarningKind::EmptyModel, text)
                .help("pass a geometry, such as Lot(feature.geometry, area)");
            let warning = match run.systems.first() {
                Some(system) => system.locate(warning),
                None => warning,
            };
            if session.options.strict {
                return Err(warning.into_error());
            }
            run.warnings.push(warning);
        }
        if self.writes(Need::Reports) && run.systems.iter().all(|system| system.reports().records.is_empty())
        {
            let text = "no numbers to write: no interpretation of the last drawing reports any";
            let warning = Warning::new(WarningKind::NoEffect, text)
                .help("call report in one, such as report(\"floor area\", this:area())");
            if session.options.strict {
                return Err(warning.into_error());
            }
            run.warnings.push(warning);
        }
        let known = run.warnings.iter().any(|warning| warning.kind() == WarningKind::EmptyModel);
        let (Some(first), false) = (run.systems.first(), known || !self.writes(Need::Scene)) else {
            return Ok(());
        };
        if run.scene.triangles() > 0 || session.options.steps.is_some() || session.options.part.is_some() {
            return Ok(());
        }
        let text = "the model is empty: no system has an object that draws";
        let warning = first.locate(Warning::new(WarningKind::EmptyModel, text));
        let warning = warning
            .help("set one, such as lsystem({ object = turtle() }); to write chains, use --chain FILE");
        if session.options.strict {
            return Err(warning.into_error());
        }
        run.warnings.push(warning);
        Ok(())
    }

    /// Adds warnings about cameras inside solids, which see nothing of the model but backs of faces. In strict mode such a run
    /// fails.
    fn warn_of_cameras(&self, session: &Session, run: &mut burgeon::Run) -> Result<()> {
        if !self.writes(Need::Scene) {
            return Ok(());
        }
        let given = match self.picture.picture(self.size).camera {
            CameraChoice::View(view) => {
                view.position().map(|from| ("the camera at --from".to_owned(), from, None))
            }
            CameraChoice::Automatic | CameraChoice::Named(_) => None,
        };
        let declared = run.scene.cameras.iter().filter_map(|camera| {
            Some((format!("camera {}", camera.name), camera.view.position()?, camera.place.clone()))
        });
        for (name, from, place) in declared.chain(given).collect::<Vec<_>>() {
            if !is_inside(&run.scene, from)? {
                continue;
            }
            let text =
                format!("{name} is inside a solid of the model, so it sees only the back of its faces");
            let warning = Warning::new(WarningKind::Doubtful, text)
                .at(place)
                .help("move it outside: from = { x, y, z }");
            if session.options.strict {
                return Err(warning.into_error());
            }
            run.warnings.push(warning);
        }
        Ok(())
    }

    /// Returns true if an output has a format with this need.
    pub(super) fn writes(&self, need: Need) -> bool {
        self.output.iter().any(|output| Format::of(output).is_ok_and(|format| format.needs(need)))
    }

    /// Saves the parameters and the seed of this run as a preset.
    fn save(&self, name: &str, session: &Session, params: &[Param]) -> Result<()> {
        let options = &session.options;
        let preset = options.params.preset.iter().flat_map(|preset| &preset.params).map(|(name, _)| name);
        let given = preset.chain(options.params.set.iter().map(|(name, _)| name));
        // Parameters that were set by a short name are saved under their full name.
        let given: Vec<&str> = given
            .filter_map(|name| Param::find(params, name).ok().flatten())
            .map(|param| &*param.name)
            .collect();
        let params = params.iter().filter(|param| given.contains(&&*param.name));
        let params = params.map(|param| (param.name.clone(), param.value.clone())).collect();
        let preset = Preset { name: name.to_owned(), seed: Some(options.seed), params, ..Preset::default() };
        Presets::save(&self.script.script, preset).map(|_| ())
    }
}

/// Parses the format of standard output: an extension, with or without a dot.
fn standard_format(text: &str) -> Result<String, String> {
    let extension = text.trim_start_matches('.').to_ascii_lowercase();
    let path = PathBuf::from(format!("model.{extension}"));
    if FilmFormat::of(&path).is_ok() || Format::of(&path).is_ok() {
        return Ok(extension);
    }
    Err(format!("write one of {}", extension_list(&FORMATS, "and")))
}

fn output(text: &str) -> Result<PathBuf, String> {
    let path = PathBuf::from(text);
    if text == STANDARD {
        return Ok(path);
    }
    if FilmFormat::of(&path).is_ok() {
        return Ok(path);
    }
    Format::of(&path).map(|_| path).map_err(|error| error.to_string())
}

fn heights(text: &str) -> Result<PathBuf, String> {
    let path = PathBuf::from(text);
    HeightFormat::of(&path).map(|_| path).map_err(|error| error.to_string())
}
