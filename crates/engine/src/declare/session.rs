//! Shared state of one run: script files, parameters, warnings and the signal to stop.

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::{Arc, Mutex, OnceLock};

use super::api::api_version;
use super::curves_file::CurvesFile;
use super::data::Data;
use super::deprecations::Deprecations;
use super::file_loader::LoadedFolder;
use super::options::RunOptions;
use super::param::Param;
use super::positions::RandomPositions;
use super::progress::RunProgress;
use super::scripts::{ScriptFiles, SourceFile, own_params, read_stdlib, unreadable};
use super::types::DeclaredTypes;
use crate::queries::{ChainView, RowCache};
use burgeon_base::error::{Error, Result};
use burgeon_base::memory::make_room;
use burgeon_base::warning::{Warning, Warnings};
use burgeon_base::{locks::LockRecovery, stop::Stop};
use burgeon_kit::Values;
use burgeon_language::CallForm;
use burgeon_language::analysis::{
    Analysis, CheckedFile, QueryCall, asks_for_chains, call_problems, has_metatables, inspects_tables,
    observes_steps,
};
use burgeon_packages::{PackageSearch, Packages};
use burgeon_rewriting::Symbol;
use rustc_hash::FxHashSet;

/// Facts about the script files, found by static analysis.
#[derive(Default)]
struct ScriptFacts {
    /// Set if a file may draw random numbers.
    randoms: AtomicBool,
    /// Set if a file may read the number of the step.
    steps: AtomicBool,
    /// Set if a file may end a derivation.
    stops: AtomicBool,
    /// Set if a file may distinguish a new table from an existing one.
    inspects_tables: AtomicBool,
    /// Set if a file may set metatables.
    metatables: AtomicBool,
    /// Set if rules of a file may print, or ask for the chain.
    observes_steps: AtomicBool,
    /// Set if rules may ask for the chain before a step.
    asks_for_chains: AtomicBool,
}

/// Run of a script.
pub struct Session {
    /// Options of the run.
    pub options: RunOptions,
    /// Signal to stop the run.
    pub stop: Arc<Stop>,
    /// Progress of the run.
    pub progress: RunProgress,
    /// Module parameters other than numbers.
    pub(crate) values: Arc<Values>,
    script: PathBuf,
    /// Canonical path of the script.
    path: PathBuf,
    root: PathBuf,
    /// Folder for files in memory, if the run has a loader.
    pub(super) loaded: Option<LoadedFolder>,
    data_roots: Vec<PathBuf>,
    packages: Packages,
    /// Names of the packages whose files were requested.
    pub(super) used: Mutex<BTreeSet<String>>,
    /// Data files that were read.
    pub(crate) data: Data,
    /// Results of SQL queries.
    pub(crate) rows: RowCache,
    /// Chains that queries of rules and interpretations see.
    pub(super) chains: Mutex<Arc<ChainView>>,
    /// Symbols of the modules that queries have named.
    pub(super) asked: Mutex<FxHashSet<Symbol>>,
    /// Positions in the random stream of the top level.
    pub(crate) drawn: RandomPositions,
    /// Object types that scripts have declared, and methods that they have added to others.
    pub(crate) declared: Mutex<DeclaredTypes>,
    stdlib: Option<(String, String)>,
    curves: CurvesFile,
    /// For each file, its arguments of `require` and the files that they refer to.
    required: Mutex<BTreeMap<String, BTreeMap<String, String>>>,
    pub(super) scripts: Mutex<ScriptFiles>,
    sought: Mutex<BTreeMap<PathBuf, bool>>,
    /// Sizes and times of the files on which the run depends, from before they were read.
    pub(super) stamps: Mutex<BTreeMap<PathBuf, String>>,
    notes: Mutex<BTreeSet<String>>,
    /// Labels of the layers whose features became chains; `None` for a list of the script.
    feature_sources: Mutex<BTreeSet<Option<String>>>,
    params: Mutex<Vec<Param>>,
    pub(super) cameras: Mutex<Vec<burgeon_scene::SceneCamera>>,
    left_out: Mutex<Vec<(String, Error)>>,
    warnings: Warnings,
    /// Deprecated names, and the names that scripts have used.
    pub(super) deprecated: Deprecations,
    /// Counter that numbers the shapes of the rules' results.
    pub(crate) shapes: Arc<AtomicUsize>,
    facts: ScriptFacts,
    /// Set once a placeholder module has been made.
    pending: AtomicBool,
    /// Handles of the values in the chains of earlier systems.
    kept: Mutex<Vec<u32>>,
    /// Number of texts that scripts have printed.
    prints: AtomicUsize,
    /// Names of the parameters that the script's own files declare, as far as static analysis finds them.
    own_params: OnceLock<BTreeSet<String>>,
}

impl Session {
    /// Creates a run of the file `script`, or of the file in memory with this name if the options have a loader.
    pub fn new(script: &Path, options: RunOptions) -> Result<Arc<Self>> {
        options.registry.check()?;
        let loaded = options.inputs.loader.as_ref().map(LoadedFolder::new).transpose()?;
        let file = match &loaded {
            Some(folder) => folder.path_of(&script.to_string_lossy())?,
            None => script.to_path_buf(),
        };
        let find = |path: &Path| loaded.as_ref().map_or(Ok(None), |folder| folder.find(path));
        let found = find(&file)?.map_or_else(|| file.canonicalize(), Ok);
        let path = found.map_err(|error| unreadable(script, &error))?;
        if path.is_dir() {
            return Err(unreadable(script, &std::io::ErrorKind::IsADirectory.into()));
        }
        let root = match &loaded {
            Some(folder) => folder.root().join(script).parent().map(Path::to_path_buf),
            None => path.parent().map(Path::to_path_buf),
        };
        let root = root.unwrap_or_default();
        let stdlib = options.inputs.stdlib.as_deref().map(read_stdlib).transpose()?;
        let curves = CurvesFile::path_of(&file);
        let curves = CurvesFile::read_file(find(&curves)?.unwrap_or(curves))?;
        let data_roots = options.inputs.data.iter().map(|folder| data_root(folder)).collect::<Result<_>>()?;
        let search = PackageSearch {
            script: file.parent(),
            given: &options.inputs.mods,
            user: options.inputs.user_mods.as_deref(),
        };
        let packages = Packages::find(search, &api_version());
        let warnings = Warnings::default();
        let deprecated = Deprecations::new(&options.registry);
        let stop = Stop::under(options.stop.clone()).with_memory_limit(options.limits.memory);
        if let Some(memory) = stop.memory().filter(|_| options.limits.whole_program) {
            memory.adopt_threads();
        }
        let data = Data::new(&options.registry);
        let session = Arc::new(Self {
            stop: Arc::new(stop),
            options,
            progress: RunProgress::default(),
            values: Arc::default(),
            script: script.to_path_buf(),
            path: path.clone(),
            root,
            loaded,
            data_roots,
            packages,
            used: Mutex::default(),
            data,
            rows: RowCache::default(),
            chains: Mutex::default(),
            asked: Mutex::default(),
            drawn: RandomPositions::default(),
            declared: Mutex::default(),
            stdlib,
            curves,
            required: Mutex::default(),
            scripts: Mutex::default(),
            sought: Mutex::default(),
            stamps: Mutex::default(),
            notes: Mutex::default(),
            feature_sources: Mutex::default(),
            params: Mutex::default(),
            cameras: Mutex::default(),
            left_out: Mutex::default(),
            warnings,
            deprecated,
            shapes: Arc::default(),
            facts: ScriptFacts::default(),
            pending: AtomicBool::new(false),
            kept: Mutex::default(),
            prints: AtomicUsize::new(0),
            own_params: OnceLock::new(),
        });
        session.stamp(&path);
        session.seek(session.curves.path(), session.curves.path().is_file());
        session.sought().iter().for_each(|(path, _)| session.stamp(path));
        Ok(session)
    }

    /// Returns the path of the script as given by the caller.
    pub fn script(&self) -> &Path {
        &self.script
    }

    /// Returns the canonical path of the script, which for a script in memory is the path of a copy.
    pub(crate) fn path(&self) -> &Path {
        &self.path
    }

    /// Returns the folder of the script, which contains all files that it may read by default.
    pub fn root(&self) -> &Path {
        &self.root
    }

    /// Returns the additional folders whose data files the script may read.
    pub(crate) fn data_roots(&self) -> &[PathBuf] {
        &self.data_roots
    }

    /// Returns the packages that the scripts may use.
    pub fn packages(&self) -> &Packages {
        &self.packages
    }

    /// Returns true if one of the script's own files, outside packages, declares a parameter `name` in a
    /// literal call.
    pub(crate) fn declares_own(&self, name: &str) -> bool {
        self.own_params.get_or_init(|| own_params(self)).contains(name)
    }

    /// Returns all script files that were read, sorted by path.
    pub fn files(&self) -> Vec<PathBuf> {
        let mut files: Vec<PathBuf> = self.script_files().read.keys().cloned().collect();
        files.sort();
        files
    }

    /// Returns all paths on which the run depends, sorted, and whether each exists: the script, the
    /// replacement of the standard library, files that were read or searched, and package folders.
    pub fn sought(&self) -> Vec<(PathBuf, bool)> {
        let mut files = self.sought.lock().recover().clone();
        files.extend(self.files().into_iter().map(|path| (path, true)));
        let named = std::iter::once(&self.script).chain(&self.options.inputs.stdlib);
        files.extend(named.map(|path| (path.clone(), true)));
        files.extend(self.packages.searched_paths().map(|(path, exists)| (path.to_path_buf(), exists)));
        files.into_iter().collect()
    }

    /// Adds a report entry about the run's data that is not a warning.
    pub(crate) fn add_note(&self, text: String) {
        self.notes.lock().recover().insert(text);
    }

    /// Returns the report entries about the run's data that are not warnings, sorted.
    pub fn notes(&self) -> Vec<String> {
        self.notes.lock().recover().iter().cloned().collect()
    }

    /// Records the label of a layer whose features become the chains of a system; `None` for a list of the script.
    pub(crate) fn note_feature_source(&self, label: Option<&str>) {
        self.feature_sources.lock().recover().insert(label.map(str::to_owned));
    }

    /// Returns the labels of the layers whose features became the chains of a system, sorted; `None` for a list of the
    /// script.
    pub fn feature_sources(&self) -> Vec<Option<String>> {
        self.feature_sources.lock().recover().iter().cloned().collect()
    }

    /// Records a path that was looked up, and whether it exists.
    pub(crate) fn seek(&self, path: &Path, there: bool) {
        self.stamp(path);
        self.sought.lock().recover().insert(path.to_path_buf(), there);
    }

    /// Returns name and text of the file that replaces the standard library, if there is one.
    pub(crate) fn stdlib(&self) -> Option<(&str, &str)> {
        self.stdlib.as_ref().map(|(name, text)| (name.as_str(), text.as_str()))
    }

    /// Returns the drawn curves in the file next to the script.
    pub fn curves(&self) -> &CurvesFile {
        &self.curves
    }

    /// Returns the parameter values that a forgiving run skipped, with the name of the parameter and the
    /// error.
    pub fn left_out(&self) -> Vec<(String, Error)> {
        self.left_out.lock().recover().clone()
    }

    /// Returns `error`, or records it if the run skips unusable values of parameters.
    pub(crate) fn forgive(&self, name: &str, error: Error) -> Result<()> {
        if !self.options.params.forgiving {
            return Err(error);
        }
        let mut left_out = self.left_out.lock().recover();
        if !left_out.iter().any(|(known, _)| known == name) {
            left_out.push((name.to_owned(), error));
        }
        Ok(())
    }

    /// Adds a warning; repeated warnings are counted.
    pub fn warn(&self, warning: Warning) {
        self.warnings.add(warning);
    }

    /// Returns the warnings so far, in the order of files and lines.
    pub fn warnings(&self) -> Vec<Warning> {
        let mut warnings = self.warnings.list();
        warnings.extend(self.deprecated.warnings());
        warnings.sort_by(|a, b| (a.place().is_none(), a.place()).cmp(&(b.place().is_none(), b.place())));
        warnings
    }

    /// Returns the declared parameters, in order.
    pub fn params(&self) -> Vec<Param> {
        self.params.lock().recover().clone()
    }

    pub(crate) fn add_param(&self, param: Param) {
        let mut params = self.params.lock().recover();
        if !params.iter().any(|known| known.name == param.name) {
            params.push(param);
        }
    }

    /// Returns true if a script file may draw random numbers.
    pub(crate) fn draws_random(&self) -> bool {
        self.facts.randoms.load(Ordering::Acquire)
    }

    /// Returns true if a script file may read the number of the step.
    pub(crate) fn reads_step(&self) -> bool {
        self.facts.steps.load(Ordering::Acquire)
    }

    /// Returns true if a script file may end a derivation.
    pub(crate) fn may_stop(&self) -> bool {
        self.facts.stops.load(Ordering::Acquire)
    }

    /// Returns true if a script file may distinguish a new table from an existing one.
    pub(crate) fn inspects_tables(&self) -> bool {
        self.facts.inspects_tables.load(Ordering::Acquire)
    }

    /// Returns true if functions of a script file may print in a step, or ask for the chain before it.
    pub(crate) fn observes_steps(&self) -> bool {
        self.facts.observes_steps.load(Ordering::Acquire)
    }

    /// Returns true if functions of rules may ask for the chain before a step.
    pub(crate) fn asks_for_chains(&self) -> bool {
        self.facts.asks_for_chains.load(Ordering::Acquire)
    }

    /// Returns true if the functions that begin at a line of a file have no side effects.
    pub(crate) fn is_pure(&self, file: &str, line: usize) -> bool {
        !self.facts.metatables.load(Ordering::Acquire)
            && self.source_called(file).is_some_and(|source| source.analysis.pure.contains(&line))
    }

    /// Returns true if the functions that begin at a line of a file do not use their first parameter.
    pub(crate) fn is_blind(&self, file: &str, line: usize) -> bool {
        self.source_called(file).is_some_and(|source| source.analysis.blind.contains(&line))
    }

    /// Returns true if the functions that begin at a line of a file use their first parameter only to ask for its place.
    pub(crate) fn asks_place(&self, file: &str, line: usize) -> bool {
        self.source_called(file).is_some_and(|source| source.analysis.asks_place.contains(&line))
    }

    /// Returns true if the functions that begin at a line of a file do nothing but divide a shape into modules.
    pub(crate) fn only_divides(&self, file: &str, line: usize) -> bool {
        self.source_called(file).is_some_and(|source| source.analysis.divides.contains(&line))
    }

    /// Returns the numbers of the parameters after the first that the functions that begin at a line of a file read; `None` if
    /// they may read all.
    pub(crate) fn parameters_read(&self, file: &str, line: usize) -> Option<Vec<usize>> {
        let source = self.source_called(file)?;
        let reads = source.analysis.reads.get(&line)?;
        Some(reads.iter().copied().filter(|number| *number > 0).collect())
    }

    /// Returns the source text of the guard that begins at a line of a file, if it is the only guard there.
    pub(crate) fn guard_text(&self, file: &str, line: usize) -> Option<String> {
        self.read_source(file, |source| source.analysis.guards.get(&line))
    }

    /// Returns the line at which the rule function that begins at `line` returns only a table that it has filled, if static
    /// analysis finds one.
    pub(crate) fn returns_filled(&self, file: &str, line: usize) -> Option<usize> {
        self.source_called(file)?.analysis.filled.get(&line).copied()
    }

    /// Returns the signature of the function that begins at a line of a file, if it is the only function there.
    pub(crate) fn signature(&self, file: &str, line: usize) -> Option<CallForm> {
        self.read_source(file, |source| source.analysis.signatures.get(&line))
    }

    /// Records that `require(name)` in the file `asker` refers to the file `meant`.
    pub(crate) fn note_required(&self, asker: &str, name: &str, meant: &str) {
        let mut required = self.required.lock().recover();
        required.entry(asker.to_owned()).or_default().insert(name.to_owned(), meant.to_owned());
    }

    /// Returns the errors in the calls of all files, once the script has declared its object types.
    pub(crate) fn call_problems(&self) -> Vec<Error> {
        let (required, none) = (self.required.lock().recover(), BTreeMap::new());
        let scripts = self.script_files();
        let mut files: Vec<CheckedFile> = scripts
            .read
            .values()
            .filter_map(|source| {
                let (name, ast) = (source.name.as_str(), source.analysis.ast.as_deref()?);
                let required = required.get(name).unwrap_or(&none);
                let package = self.package_of(name).map(|package| package.manifest.name.as_str());
                Some(CheckedFile { name, package, ast, required })
            })
            .collect();
        files.sort_by(|a, b| a.name.cmp(b.name));
        call_problems(&files, &self.registry_with_types())
    }

    /// Returns the SQL queries of the rule functions that begin at a line of a file, as far as static analysis finds them.
    pub(crate) fn queries(&self, file: &str, line: usize) -> Vec<QueryCall> {
        self.read_source(file, |source| source.analysis.queries.get(&line)).unwrap_or_default()
    }

    /// Returns the display name of a file.
    pub(crate) fn name_of(&self, path: &Path) -> String {
        let scripts = self.script_files();
        let known = scripts.read.get(path).filter(|_| !path.starts_with(&self.root));
        let inner = path.strip_prefix(&self.root).unwrap_or(path);
        known.map_or_else(|| inner.display().to_string(), |source| source.name.clone())
    }

    /// Returns a part of the source of a file, if the file has been read.
    fn read_source<T: Clone>(&self, file: &str, find: impl FnOnce(&SourceFile) -> Option<&T>) -> Option<T> {
        let scripts = self.script_files();
        scripts.read.values().find(|source| source.name == file).and_then(|source| find(source)).cloned()
    }

    fn source_called(&self, file: &str) -> Option<Arc<SourceFile>> {
        let scripts = self.script_files();
        scripts.read.values().find(|source| source.name == file).cloned()
    }

    /// Returns true if a script file contains `name` as a word, so that it may use an attribute of that name.
    pub fn names_attribute(&self, name: &str) -> bool {
        let scripts = self.script_files();
        let is_letter = |letter: char| letter.is_alphanumeric() || letter == '_';
        let mut texts = scripts.read.values().map(|source| &*source.analysis.text);
        !name.is_empty()
            && texts.any(|text| {
                text.match_indices(name).any(|(at, _)| {
                    !text[..at].ends_with(is_letter) && !text[at + name.len()..].starts_with(is_letter)
                })
            })
    }

    /// Records the facts that the analysis found.
    pub(crate) fn note(&self, analysis: &Analysis) {
        self.facts.randoms.fetch_or(analysis.random, Ordering::AcqRel);
        self.facts.steps.fetch_or(analysis.reads_step, Ordering::AcqRel);
        self.facts.stops.fetch_or(analysis.stops, Ordering::AcqRel);
        self.facts.metatables.fetch_or(has_metatables(&analysis.text), Ordering::AcqRel);
        self.facts.inspects_tables.fetch_or(inspects_tables(&analysis.text), Ordering::AcqRel);
        self.facts.observes_steps.fetch_or(observes_steps(&analysis.text), Ordering::AcqRel);
        self.facts.asks_for_chains.fetch_or(asks_for_chains(&analysis.text), Ordering::AcqRel);
    }

    /// Records that a placeholder module has been made.
    pub(crate) fn note_pending(&self) {
        self.pending.store(true, Ordering::Release);
    }

    /// Counts a text that a script has printed.
    pub(crate) fn count_print(&self) {
        self.prints.fetch_add(1, Ordering::Relaxed);
    }

    /// Returns the number of texts that scripts have printed.
    pub(crate) fn prints(&self) -> usize {
        self.prints.load(Ordering::Relaxed)
    }

    /// Returns true if chains may contain placeholder modules.
    pub(crate) fn has_pending(&self) -> bool {
        self.pending.load(Ordering::Acquire)
    }

    /// Keeps the values that `params` refers to until the end of the run.
    pub(crate) fn keep(&self, params: &[f64]) {
        if self.values.is_empty() {
            return;
        }
        let handles = Values::handles(params);
        let mut kept = self.kept.lock().recover();
        make_room(&mut *kept, handles.clone().count());
        kept.extend(handles);
    }

    /// Drops the values that neither `params` nor earlier systems refer to, if there are many values or
    /// memory is scarce.
    pub(crate) fn forget_unused(&self, params: &[f64]) {
        let kept = self.kept.lock().recover();
        match self.stop.memory() {
            Some(memory) if memory.is_half_full() => self.values.retain_if_new(params, &kept),
            _ => self.values.retain_if_many(params, &kept),
        }
    }

    /// Returns true if so many values have been added that [`forget_unused`](Self::forget_unused) may drop some.
    pub(crate) fn has_many_unused(&self) -> bool {
        self.values.has_many_new(self.stop.memory().is_some_and(|memory| memory.is_half_full()))
    }

    /// Returns all errors found while reading the files, sorted by file name.
    pub(crate) fn problems(&self) -> Vec<Error> {
        let scripts = self.script_files();
        let mut sources: Vec<_> = scripts.read.values().collect();
        sources.sort_by(|a, b| a.name.cmp(&b.name));
        sources.iter().flat_map(|source| source.analysis.problems.clone()).collect()
    }
}

/// Returns the canonical path of a data folder.
fn data_root(folder: &Path) -> Result<PathBuf> {
    let found = folder.canonicalize().ok().filter(|found| found.is_dir());
    found.ok_or_else(|| {
        let shown = folder.display();
        Error::not_found("folder", &shown, [], format!("folder not found: {shown}"))
            .help("--data needs a folder of data files")
    })
}
