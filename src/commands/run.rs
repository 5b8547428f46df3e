//! `burgeon run`: from a script to files.

use std::io::{BufWriter, Write};
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::Instant;

use burgeon::derive::{Derived, Report};
use burgeon::export::{self, heights::HeightMap};
use burgeon::objects::Terrain;
use burgeon::picture::Picture;
use burgeon::presets::Presets;
use burgeon::script::{Param, Preset, Session};
use burgeon::terrain::{Map, Place};
use burgeon::{Error, Result, Warning, WarningKind};
use clap::Args;

use super::progress::Progress;
use super::report;
use super::shared::{PictureFlags, ScriptFlags, size};

mod watch;

/// Runs a script and writes what it makes
#[derive(Args)]
pub(crate) struct Run {
    #[command(flatten)]
    script: ScriptFlags,

    /// Writes the model; the extension picks the format: .glb, .gltf, .obj, .png or .svg. May be repeated
    #[arg(short, long, value_name = "FILE", value_parser = output)]
    output: Vec<PathBuf>,

    /// Writes the final chains as text, a line for each; - is standard output, in the JSON document if there is one
    #[arg(long, value_name = "FILE")]
    chain: Option<PathBuf>,

    /// Writes the heights of the terrain as a map; the extension picks the format: .png, .asc, .tif, .r32 or .r64
    #[arg(long, value_name = "FILE")]
    heights: Option<PathBuf>,

    /// Writes the changes of the ground of the terrain, for edits(FILE) in a script
    #[arg(long, value_name = "FILE")]
    edits: Option<PathBuf>,

    /// Writes a .glb for each tile of the terrain into this folder
    #[arg(long, value_name = "FOLDER")]
    tiles: Option<PathBuf>,

    /// Writes which features were skipped or simplified, and why, as JSON; - is standard output
    #[arg(long, value_name = "FILE")]
    report: Option<PathBuf>,

    /// Runs and writes again whenever a file of the script changes, until interrupted
    #[arg(long)]
    watch: bool,

    /// Width and height of a picture in pixels
    #[arg(long, value_name = "WIDTHxHEIGHT", value_parser = size, default_value = "1280x960", help_heading = "Pictures")]
    size: (u32, u32),

    #[command(flatten)]
    picture: PictureFlags,

    /// Saves the seed and the values of --set and --preset under a name, once the run has succeeded
    #[arg(long, value_name = "NAME")]
    save_preset: Option<String>,
}

impl Run {
    pub(crate) fn json(&self) -> bool {
        self.script.json
    }

    pub(crate) fn run(&self) -> Result<()> {
        self.check_files()?;
        if let Some(name) = &self.save_preset {
            burgeon::presets::check_name(name)?;
            Presets::read(&self.script.script)?;
        }
        if self.watch {
            return watch::again_and_again(self);
        }
        let begin = Instant::now();
        let session = self.session()?;
        let made = self.make(&session, begin, &|| false)?;
        // The process ends and gives back all its memory at once, which is faster than piece by piece.
        std::mem::forget((made, session));
        Ok(())
    }

    /// The script as it was named, and how it is run.
    fn session(&self) -> Result<Arc<Session>> {
        Session::new(&self.script.script, self.script.options()?)
    }

    /// Runs `session`, writes everything, and says what came of it, unless it is `stale` before anything is written.
    fn make(
        &self,
        session: &Arc<Session>,
        begin: Instant,
        stale: &dyn Fn() -> bool,
    ) -> Result<Option<burgeon::Run>> {
        let (run, writing) = {
            let _progress = Progress::show(session, !self.script.json);
            let mut run = burgeon::run_session(session)?;
            if stale() {
                return Ok(None);
            }
            self.warn_of_nothing(session, &mut run)?;
            if run.systems.is_empty() && !self.output.is_empty() {
                let script = self.script.script.display();
                return Err(Error::new(format!("{script} makes nothing to write, for it derives no system"))
                    .help("end it with system:derive()"));
            }
            let writing = Instant::now();
            let picture = self.picture.picture(self.size);
            for output in &self.output {
                export::write(&run.scene, output, &picture)?;
            }
            if let Some(path) = self.chain.as_ref().filter(|_| !self.chain_in_json()) {
                write_chains(path, &run.systems)?;
            }
            if let Some(path) = &self.heights {
                let Map { columns, rows, corner, step, heights } = terrain(&run)?.map()?;
                let map = HeightMap { columns, rows, corner, step, heights, frame: run.frame.clone() };
                export::heights::write(&map, path)?;
            }
            if let Some(path) = &self.edits {
                let text = terrain(&run)?.edits_json();
                export::write_file(path, |out| out.write_all(text.as_bytes()))?;
            }
            if let Some(folder) = &self.tiles {
                write_tiles(&run, folder)?;
            }
            if let Some(path) = &self.report {
                write_report(path, &run.report())?;
            }
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
            report::print(&format!("{summary}\n"));
        } else {
            report::eprint(&report::summary(&run, writing, begin.elapsed(), self.report.as_deref()));
        }
        Ok(Some(run))
    }

    /// Warns of files without a model in them; such a run fails if it is to be strict.
    fn warn_of_nothing(&self, session: &Session, run: &mut burgeon::Run) -> Result<()> {
        let known = run.warnings.iter().any(|warning| warning.kind() == WarningKind::EmptyModel);
        let place = run.systems.first().map(|system| system.place.clone());
        let (Some(place), false) = (place, known || self.output.is_empty()) else { return Ok(()) };
        if run.scene.triangles() > 0 || session.options.steps.is_some() {
            return Ok(());
        }
        let text = "the model is empty, for no system has an object that draws";
        let warning = Warning::new(WarningKind::EmptyModel, text)
            .at(place)
            .help("give one, such as lsystem({ object = turtle() }); chains are written with --chain FILE");
        if session.options.strict {
            return Err(warning.into_error());
        }
        run.warnings.push(warning);
        Ok(())
    }

    /// Saves what this run was given.
    fn save(&self, name: &str, session: &Session, params: &[Param]) -> Result<()> {
        let options = &session.options;
        let preset = options.preset.iter().flat_map(|preset| &preset.params).map(|(name, _)| name);
        let given: Vec<&String> = preset.chain(options.set.iter().map(|(name, _)| name)).collect();
        let params = params.iter().filter(|param| given.contains(&&param.name));
        let params = params.map(|param| (param.name.clone(), param.value.clone())).collect();
        let preset = Preset { name: name.to_owned(), seed: Some(options.seed), params, ..Preset::default() };
        Presets::save(&self.script.script, preset).map(|_| ())
    }

    /// Whether the chains go to standard output as a part of the JSON document.
    fn chain_in_json(&self) -> bool {
        self.script.json && self.chain.as_deref() == Some(Path::new("-"))
    }

    /// Refuses, before any work, files that could not be written when it is done.
    fn check_files(&self) -> Result<()> {
        for output in &self.output {
            export::check_writable(output)?;
        }
        self.check_text(self.chain.as_deref(), "chain", "the chains", "chains.txt")?;
        self.check_text(self.report.as_deref(), "report", "the report", "report.json")?;
        self.check_text(self.heights.as_deref(), "heights", "the heights", "heights.tif")?;
        self.check_text(self.edits.as_deref(), "edits", "the edits", "ground.json")?;
        self.heights.as_deref().map_or(Ok(()), export::heights::check_name)?;
        if self.script.json && self.report.as_deref() == Some(Path::new("-")) {
            return Err(Error::new("standard output cannot take both a report and the JSON document")
                .help("name a file: --report report.json; the document has the counts"));
        }
        Ok(())
    }

    /// Refuses a file that text could not be written to; - is standard output.
    fn check_text(&self, path: Option<&Path>, flag: &str, what: &str, example: &str) -> Result<()> {
        let Some(path) = path.filter(|path| *path != Path::new("-")) else { return Ok(()) };
        let same =
            |a: &Path, b: &Path| matches!((a.canonicalize(), b.canonicalize()), (Ok(a), Ok(b)) if a == b);
        let shown = path.display();
        if same(path, &self.script.script) {
            return Err(Error::new(format!("{what} would overwrite the script {shown}"))
                .help(format!("name another file: --{flag} {example}, or - for standard output")));
        }
        if path.is_dir() {
            return Err(Error::new(format!("cannot write {shown}: it is a folder"))
                .help(format!("name a file in it, such as {}", path.join(example).display())));
        }
        let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty());
        if let Some(folder) = folder.filter(|folder| !folder.is_dir()) {
            return Err(Error::new(format!("cannot write {shown}: there is no folder {}", folder.display()))
                .help("make the folder first, or write to one that is there"));
        }
        Ok(())
    }
}

/// Writes what was skipped or simplified.
/// Writes each tile of the terrain as a file of its own, called by level, column and row.
fn write_tiles(run: &burgeon::Run, folder: &Path) -> Result<()> {
    let tiles = terrain(run)?.ground().tiles();
    std::fs::create_dir_all(folder)
        .map_err(|error| Error::new(format!("cannot make the folder {}: {error}", folder.display())))?;
    for tile in tiles {
        let Place { level, x, y } = tile.place;
        let name = format!("{level}/{x}/{y}");
        let scene = run.scene.only(|instance| instance.name.rsplit(' ').next() == Some(name.as_str()));
        export::write(&scene, &folder.join(format!("{level}_{x}_{y}.glb")), &Picture::default())?;
    }
    Ok(())
}

/// The terrain of a run; there has to be one.
fn terrain(run: &burgeon::Run) -> Result<&Terrain> {
    let objects = run.systems.iter().flat_map(|system| &system.objects);
    let mut terrains = objects.filter_map(|object| {
        let any: &dyn std::any::Any = &**object;
        any.downcast_ref::<Terrain>()
    });
    match (terrains.next(), terrains.next()) {
        (Some(terrain), None) => Ok(terrain),
        (None, _) => Err(Error::new("there is no terrain to write the heights or the edits of")
            .help("write lsystem({ object = terrain({ ... }) }):derive()")),
        _ => Err(Error::new("there are several terrains to write the heights or the edits of")
            .help("keep one of them in the script")),
    }
}

fn write_report(path: &Path, report: &Report) -> Result<()> {
    if path == Path::new("-") {
        let mut text = Vec::new();
        report.write_json(&mut text).map_err(Error::new)?;
        report::print(&String::from_utf8_lossy(&text));
        return Ok(());
    }
    export::write_file(path, |out| report.write_json(out))
}

/// Writes the chains of all systems, in the order in which they were derived.
fn write_chains(path: &Path, systems: &[Arc<Derived>]) -> Result<()> {
    let failed = |error: std::io::Error| {
        Error::new(format!("cannot write the chains to {}: {error}", path.display()))
            .help("check that the folder exists and may be written to")
    };
    if path == Path::new("-") {
        let mut out = BufWriter::new(std::io::stdout().lock());
        let written =
            systems.iter().try_for_each(|system| system.write_chains(&mut out)).and_then(|()| out.flush());
        return match written {
            // A reader that has gone away wants no more.
            Err(error) if error.kind() != std::io::ErrorKind::BrokenPipe => Err(failed(error)),
            _ => Ok(()),
        };
    }
    export::write_file(path, |out| systems.iter().try_for_each(|system| system.write_chains(out)))
}

fn output(text: &str) -> Result<PathBuf, String> {
    let path = PathBuf::from(text);
    export::Format::of(&path).map(|_| path).map_err(|error| error.to_string())
}
