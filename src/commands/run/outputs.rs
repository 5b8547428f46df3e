//! Outputs of `burgeon run`: checked before the run, and written together after it.

use std::path::Path;
use std::sync::Arc;

use burgeon::export::heights::{self, HeightFormat, HeightMap};
use burgeon::export::{Export, Files, Format, GLB, Need, SceneFacts, SystemFacts, extension_list};
use burgeon::kit::declare::as_ref;
use burgeon::objects::Terrain;
use burgeon::picture::Picture;
use burgeon::results::{DerivedSystem, FeatureReport, layers};
use burgeon::script::Session;
use burgeon::terrain::{GroundMap, TilePlace};
use burgeon::{Error, Result};

use super::super::report;
use super::super::shared::STANDARD;
use super::RunCommand;
use super::command::gltf_extensions;

impl RunCommand {
    /// Fails, before any work, if an output file could not be written.
    pub(super) fn check_files(&self) -> Result<()> {
        self.output.iter().try_for_each(|output| Format::of(output)?.file.check())?;
        self.check_storage()?;
        self.check_text(self.chain.as_deref(), "chain", "the chains", "chains.txt")?;
        self.check_text(self.report.as_deref(), "report", "the report", "report.json")?;
        self.check_text(self.heights.as_deref(), "heights", "the heights", "heights.tif")?;
        self.check_text(self.edits.as_deref(), "edits", "the edits", "ground.json")?;
        let heights = self.heights.as_deref().map(HeightFormat::of).transpose()?;
        heights.map_or(Ok(()), |format| format.file.check())?;
        if self.script.json && self.report.as_deref() == Some(Path::new(STANDARD)) {
            return Err(Error::usage("standard output cannot take both a report and the JSON document")
                .help("specify a file: --report report.json; the document contains the counts"));
        }
        let beside = self.output.iter().filter_map(|output| Format::of(output).ok()?.file.companion(output));
        let projection = heights.zip(self.heights.as_deref());
        let projection = projection.and_then(|(format, path)| format.file.companion(path));
        let beside: Vec<_> = beside.chain(projection).collect();
        let tile =
            self.tiles.as_ref().map(|folder| folder.join(tile_name(TilePlace { level: 0, x: 0, y: 0 })));
        let mut files = Files::default();
        self.tiles.as_deref().map_or(Ok(()), |folder| files.folder(folder))?;
        let all = self.output.iter().chain(&beside).chain(&tile).map(|path| path.as_path());
        all.chain(self.named()).try_for_each(|path| files.write(path, |_| Ok(())))
    }

    /// Fails if an option on the arrays of models has no model to apply to.
    fn check_storage(&self) -> Result<()> {
        let types: Vec<_> =
            self.output.iter().filter_map(|output| Some(Format::of(output).ok()?.media_type)).collect();
        let (is_glb, is_gltf) =
            (types.contains(&GLB.media_type), types.iter().any(|it| it.starts_with("model/gltf")));
        let refuse = |option: &str, formats: &str| {
            let help = format!("write such a file: -o model.{}", GLB.extension());
            Err(Error::usage(format!("{option} applies to {formats} files, and no output is one")).help(help))
        };
        match (self.compress && !is_glb, self.quantize && !is_gltf) {
            (true, _) => refuse("--compress", &extension_list([&GLB], "and")),
            (_, true) => refuse("--quantize", &gltf_extensions()),
            _ => Ok(()),
        }
    }

    /// Returns the named files other than models.
    fn named(&self) -> impl Iterator<Item = &Path> {
        let texts = [&self.chain, &self.report, &self.heights, &self.edits];
        texts.into_iter().flatten().map(|path| path.as_path()).filter(|path| *path != Path::new(STANDARD))
    }

    /// Fails if a text file could not be written; - is standard output.
    fn check_text(&self, path: Option<&Path>, flag: &str, what: &str, example: &str) -> Result<()> {
        let Some(path) = path.filter(|path| *path != Path::new(STANDARD)) else { return Ok(()) };
        let same =
            |a: &Path, b: &Path| matches!((a.canonicalize(), b.canonicalize()), (Ok(a), Ok(b)) if a == b);
        let shown = path.display();
        if same(path, &self.script.script) {
            return Err(Error::usage(format!("{what} would overwrite the script {shown}"))
                .help(format!("specify another file: --{flag} {example}, or - for standard output")));
        }
        if path.is_dir() {
            return Err(Error::file(path, format!("cannot write {shown}: it is a folder"))
                .help(format!("specify a file in it, such as {}", path.join(example).display())));
        }
        Ok(())
    }

    /// Fails if an output would overwrite an input of the run. Terrain edits may be written to the file from which they
    /// were read.
    pub(super) fn check_inputs(&self, session: &Session) -> Result<()> {
        let read = session.sought().into_iter().filter(|(path, there)| *there && path.is_file());
        let read: Vec<_> = read.filter_map(|(path, _)| path.canonicalize().ok()).collect();
        let is_read = |path: &&Path| path.canonicalize().is_ok_and(|path| read.contains(&path));
        let written = self.output.iter().map(|path| path.as_path()).chain(self.named());
        match written.filter(|path| Some(*path) != self.edits.as_deref()).find(is_read) {
            Some(path) => Err(Error::usage(format!("cannot write {}: the script reads it", path.display()))
                .help("specify another file")),
            None => Ok(()),
        }
    }

    /// Writes all outputs of a run of `session`, and adds their notes and warnings to it. Either all files are published,
    /// or none. In strict mode a warning prevents that.
    pub(super) fn write(&self, run: &mut burgeon::Run, session: &Session) -> Result<()> {
        let mut files = self.written(run, session)?;
        let warnings = files.take_warnings();
        if let (true, Some(first)) = (session.options.strict, warnings.first()) {
            return Err(first.clone().into_error());
        }
        run.warnings.extend(warnings);
        run.notes.extend(files.take_notes());
        files.publish()
    }

    /// Writes all outputs of a run of `session` to future files.
    fn written(&self, run: &burgeon::Run, session: &Session) -> Result<Files> {
        if run.systems.is_empty() && !self.output.is_empty() {
            let script = self.script.script.display();
            return Err(Error::script(format!("{script} derives no system, so there is nothing to write"))
                .help("end it with system:derive()"));
        }
        self.check_inputs(session)?;
        let mut files = Files::new(&session.stop);
        if let Some(path) = &self.heights {
            let GroundMap { columns, rows, corner, step, heights } = terrain(run)?.map()?;
            let map = HeightMap { columns, rows, corner, step, heights, frame: run.service().cloned() };
            heights::write(&map, path, &mut files)?;
        }
        if let Some(path) = &self.edits {
            let text = terrain(run)?.edits_json();
            files.write(path, |out| std::io::Write::write_all(out, text.as_bytes()))?;
        }
        let picture = self.picture.picture(self.size);
        let (systems, layers) = (
            systems(run),
            if self.writes(Need::Layers) { layers(session, &run.systems) } else { Vec::new() },
        );
        let metadata =
            self.metadata.as_ref().map(|names| attributes(session, names, &systems)).transpose()?;
        let reports: Vec<_> = run.systems.iter().map(|system| (system.system, system.reports())).collect();
        let wanted = !self.no_recipe && self.writes(Need::Recipe);
        let recipe = wanted.then(|| session.recipe(&run.params).complete()).transpose()?;
        let facts = SceneFacts {
            frame: run.service(),
            detail: session.options.lod,
            systems: &systems,
            layers: &layers,
            metadata: metadata.as_deref(),
            instances: self.instances.map(Into::into).unwrap_or_default(),
            is_compressed: self.compress,
            is_quantized: self.quantize,
            reports: &reports,
            recipe: recipe.as_ref(),
        };
        // Copies of textures are written last, so that their names differ from all other names.
        let has_copies =
            |output: &&std::path::PathBuf| Format::of(output).is_ok_and(|format| format.has_textures);
        let (last, first): (Vec<_>, Vec<_>) = self.output.iter().partition(has_copies);
        for output in first.into_iter().chain(last) {
            files.export(&Export { scene: &run.scene, picture: &picture, facts }, output)?;
        }
        if let Some(folder) = &self.tiles {
            write_tiles(run, folder, &mut files)?;
        }
        if let Some(path) = &self.report {
            write_report(path, &run.report(), &mut files)?;
        }
        if let Some(path) = self.chain.as_ref().filter(|_| !self.chain_in_json()) {
            write_chains(path, &run.systems, &mut files)?;
        }
        Ok(files)
    }

    /// Returns true if the chains are part of the JSON document on standard output.
    pub(super) fn chain_in_json(&self) -> bool {
        self.script.json && self.chain.as_deref() == Some(Path::new(STANDARD))
    }
}

/// Returns the facts about the systems of a run, if there are any.
pub(in crate::commands) fn systems(run: &burgeon::Run) -> Vec<SystemFacts> {
    let known = run.systems.iter().filter_map(|system| {
        let records = system.records();
        let is_known = records.is_some() || system.city.is_some();
        let (records, class) = (records.unwrap_or_default(), system.city);
        is_known.then_some(SystemFacts { system: system.system, records, class })
    });
    known.collect()
}

/// Returns the attributes that `--metadata` selects: its `names`, all for `*`, or without names the attributes that the
/// script specifies. Fails if no feature has one of the names.
pub(in crate::commands) fn attributes(
    session: &Session,
    names: &[String],
    systems: &[SystemFacts],
) -> Result<Vec<String>> {
    let known = || systems.iter().flat_map(|system| &system.records.columns);
    let names: Vec<&String> = names.iter().filter(|name| !name.is_empty()).collect();
    for name in names.iter().filter(|name| **name != "*") {
        if !known().any(|column| column == *name) {
            let message = format!("--metadata: no feature has an attribute named `{name}`");
            let known: Vec<&str> = known().map(String::as_str).collect();
            return Err(Error::not_found("attribute", name, known, message)
                .help("run burgeon sources FILE to list the attributes of a file"));
        }
    }
    let is_wanted = |column: &&String| match names.as_slice() {
        [] => session.names_attribute(column),
        names => names.iter().any(|name| name == column || *name == "*"),
    };
    Ok(known().filter(is_wanted).cloned().collect())
}

/// Writes each tile of the terrain to a separate file, named by level, column and row.
fn write_tiles(run: &burgeon::Run, folder: &Path, files: &mut Files) -> Result<()> {
    let tiles = terrain(run)?.ground().tiles();
    files.folder(folder)?;
    for tile in tiles {
        let TilePlace { level, x, y } = tile.place;
        let name = format!("{level}/{x}/{y}");
        let scene = run.scene.only(|instance| instance.name.rsplit(' ').next() == Some(name.as_str()));
        files.scene(&scene, &folder.join(tile_name(tile.place)), &Picture::default())?;
    }
    Ok(())
}

/// Returns the file name of the tile at `place`.
fn tile_name(TilePlace { level, x, y }: TilePlace) -> String {
    format!("{level}_{x}_{y}.{}", GLB.extension())
}

/// Returns the terrain of a run. Fails unless there is exactly one.
fn terrain(run: &burgeon::Run) -> Result<&Terrain> {
    let objects = run.systems.iter().flat_map(|system| &system.objects);
    let mut terrains = objects.filter_map(|object| as_ref::<Terrain>(&**object));
    match (terrains.next(), terrains.next()) {
        (Some(terrain), None) => Ok(terrain),
        (None, _) => Err(Error::script("the script has no terrain whose heights or edits to write")
            .help("write lsystem({ object = terrain({ ... }) }):derive()")),
        _ => Err(Error::script("the script has several terrains whose heights or edits to write")
            .help("keep one of them in the script")),
    }
}

/// Writes the report of skipped and simplified features.
fn write_report(path: &Path, report: &FeatureReport, files: &mut Files) -> Result<()> {
    if path == Path::new(STANDARD) {
        return report::print_all(|out| report.write_json(out));
    }
    files.write(path, |out| report.write_json(out))
}

/// Writes the chains of all systems, in the order of their derivation.
fn write_chains(path: &Path, systems: &[Arc<DerivedSystem>], files: &mut Files) -> Result<()> {
    if path == Path::new(STANDARD) {
        return report::print_all(|out| systems.iter().try_for_each(|system| system.write_chains(out)));
    }
    files.write(path, |out| systems.iter().try_for_each(|system| system.write_chains(out)))
}
