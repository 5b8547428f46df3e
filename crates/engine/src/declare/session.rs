//! What all virtual machines of one run share: source files, parameters, the reason to stop.

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::{Arc, Mutex, OnceLock};
use std::time::Duration;

use super::api::api_version;
use super::data::Data;
use super::deprecations::Deprecations;
use super::options::RunOptions;
use super::param::Param;
use super::positions::RandomPositions;
use super::scripts::{ScriptFiles, SourceFile, own_params, read_stdlib, unreadable};
#[cfg(feature = "data")]
use super::tables::ModuleRows;
use super::types::DeclaredTypes;
#[cfg(feature = "data")]
use crate::questions::RowSource;
use crate::questions::{AskedRows, ChainView, Question, RowCache, Rows};
use burgeon_analysis::{Analysis, CheckedFile, QueryCall, call_problems, has_metatables, inspects_tables};
use burgeon_base::error::{Error, Result};
use burgeon_base::locks::LockRecovery;
use burgeon_base::stop::Stop;
use burgeon_base::text::grouped;
use burgeon_base::warning::{Warning, Warnings};
use burgeon_kit::Values;
use burgeon_language::CallForm;
use burgeon_packages::{PackageSearch, Packages};
use burgeon_rewriting::Symbol;
use rustc_hash::FxHashSet;

/// How far a run has come, for those who wait.
#[derive(Debug, Default)]
pub struct RunProgress {
    step: AtomicUsize,
    steps: AtomicUsize,
    modules: AtomicUsize,
    total: AtomicUsize,
}

impl RunProgress {
    /// Notes that `step` of at most `steps` has made a chain of `modules`.
    pub(crate) fn note(&self, step: usize, steps: usize, modules: usize) {
        self.step.store(step, Ordering::Relaxed);
        self.steps.store(steps, Ordering::Relaxed);
        self.modules.store(modules, Ordering::Relaxed);
        self.total.fetch_add(modules, Ordering::Relaxed);
    }

    /// The last step that is done, the greatest number of steps if there is one, and the modules of the chain.
    pub fn counts(&self) -> (usize, Option<usize>, usize) {
        let load = |count: &AtomicUsize| count.load(Ordering::Relaxed);
        let steps = load(&self.steps);
        (load(&self.step), (steps != usize::MAX && steps > 0).then_some(steps), load(&self.modules))
    }

    /// Says it in words, with the rate and an estimate of the time left.
    pub fn message(&self, elapsed: Duration) -> String {
        let load = |count: &AtomicUsize| count.load(Ordering::Relaxed);
        let (step, steps) = (load(&self.step), load(&self.steps));
        if steps == 0 {
            return "running the script".to_owned();
        }
        #[allow(clippy::cast_precision_loss, reason = "shown with three digits")]
        let rate = load(&self.total) as f64 / elapsed.as_secs_f64().max(1e-3) / 1e6;
        let modules = load(&self.modules);
        let of = if steps == usize::MAX { String::new() } else { format!(" of {steps}") };
        // Chains grow, so the steps that are left take at least as long as those that are done.
        let left = match (step, steps) {
            (1.., steps) if steps != usize::MAX && steps > step => {
                #[allow(clippy::cast_precision_loss, reason = "an estimate")]
                let seconds = elapsed.as_secs_f64() * (steps - step) as f64 / step as f64;
                if seconds < 1.0 { String::new() } else { format!(", at least {seconds:.0} s left") }
            }
            _ => String::new(),
        };
        format!("step {step}{of}, {} modules, {rate:.1} M modules/s{left}", grouped(modules))
    }
}

/// What any of the files of a script may do, as far as their texts tell.
#[derive(Default)]
struct ScriptFacts {
    /// Draw random numbers.
    randoms: AtomicBool,
    /// Tell a table that is made later from one that is there.
    inspects_tables: AtomicBool,
    /// Give tables metatables.
    metatables: AtomicBool,
}

/// One run of a script.
pub struct Session {
    /// How to run it.
    pub options: RunOptions,
    /// Asks the run to stop.
    pub stop: Arc<Stop>,
    /// How far the run has come.
    pub progress: RunProgress,
    /// The parameters of modules that are not numbers.
    pub(crate) values: Arc<Values>,
    script: PathBuf,
    root: PathBuf,
    data_roots: Vec<PathBuf>,
    packages: Packages,
    /// The packages whose files were asked for, by name.
    pub(super) used: Mutex<BTreeSet<String>>,
    /// The data files that were read.
    pub(crate) data: Data,
    /// What was asked of them.
    pub(crate) rows: RowCache,
    /// The chains that rules and interpretations see.
    chains: Mutex<Arc<ChainView>>,
    /// The modules that questions have named.
    asked: Mutex<FxHashSet<Symbol>>,
    /// How far its random numbers have got.
    pub(crate) drawn: RandomPositions,
    /// The types of objects that scripts have declared, and the methods that they have added to others.
    pub(crate) declared: Mutex<DeclaredTypes>,
    stdlib: Option<(String, String)>,
    /// By file: what it writes in `require`, and the files that are meant.
    required: Mutex<BTreeMap<String, BTreeMap<String, String>>>,
    pub(super) scripts: Mutex<ScriptFiles>,
    sought: Mutex<BTreeMap<PathBuf, bool>>,
    notes: Mutex<BTreeSet<String>>,
    params: Mutex<Vec<Param>>,
    left_out: Mutex<Vec<(String, Error)>>,
    warnings: Warnings,
    /// The names that will go, all of them and those that scripts have used.
    pub(super) deprecated: Deprecations,
    /// Counts the shapes of the rules' returns.
    pub(crate) shapes: Arc<AtomicUsize>,
    facts: ScriptFacts,
    /// Whether modules have been made that stand for others.
    pending: AtomicBool,
    kept: Mutex<Vec<f64>>,
    /// The names of the parameters that the script's own files declare, as far as their texts tell, once someone asks.
    own_params: OnceLock<BTreeSet<String>>,
}

impl Session {
    /// A run of the file `script`.
    pub fn new(script: &Path, options: RunOptions) -> Result<Arc<Self>> {
        options.registry.check()?;
        let path = script.canonicalize().map_err(|error| unreadable(script, &error))?;
        let root = path.parent().map_or_else(PathBuf::new, Path::to_path_buf);
        let stdlib = options.inputs.stdlib.as_deref().map(read_stdlib).transpose()?;
        let data_roots = options.inputs.data.iter().map(|folder| data_root(folder)).collect::<Result<_>>()?;
        let search = PackageSearch {
            script: script.parent().map(Path::to_path_buf),
            given: options.inputs.mods.clone(),
            user: options.inputs.user_mods.clone(),
        };
        let packages = Packages::find(&search, &api_version());
        let warnings = Warnings::default();
        let deprecated = Deprecations::new(&options.registry);
        let stop = Stop::under(options.stop.clone()).limited(options.limits.memory);
        if let Some(memory) = stop.memory().filter(|_| options.limits.whole_program) {
            memory.adopt_threads();
        }
        Ok(Arc::new(Self {
            stop: Arc::new(stop),
            options,
            progress: RunProgress::default(),
            values: Arc::default(),
            script: script.to_path_buf(),
            root,
            data_roots,
            packages,
            used: Mutex::default(),
            data: Data::default(),
            rows: RowCache::default(),
            chains: Mutex::default(),
            asked: Mutex::default(),
            drawn: RandomPositions::default(),
            declared: Mutex::default(),
            stdlib,
            required: Mutex::default(),
            scripts: Mutex::default(),
            sought: Mutex::default(),
            notes: Mutex::default(),
            params: Mutex::default(),
            left_out: Mutex::default(),
            warnings,
            deprecated,
            shapes: Arc::default(),
            facts: ScriptFacts::default(),
            pending: AtomicBool::new(false),
            kept: Mutex::default(),
            own_params: OnceLock::new(),
        }))
    }

    /// The script's file as it was named.
    pub fn script(&self) -> &Path {
        &self.script
    }

    /// The folder that holds the script and all that it may read.
    pub fn root(&self) -> &Path {
        &self.root
    }

    /// The folders besides the script's whose data files it may read.
    pub(crate) fn data_roots(&self) -> &[PathBuf] {
        &self.data_roots
    }

    /// The packages that its scripts may use.
    pub fn packages(&self) -> &Packages {
        &self.packages
    }

    /// Whether a file of the script's own, and none of a package, declares a parameter `name`, as far as their texts tell.
    pub(crate) fn declares_own(&self, name: &str) -> bool {
        self.own_params.get_or_init(|| own_params(&self.script, &self.root)).contains(name)
    }

    /// Every file that was read, in the order of their paths.
    pub fn files(&self) -> Vec<PathBuf> {
        let mut files: Vec<PathBuf> = self.script_files().read.keys().cloned().collect();
        files.sort();
        files
    }

    /// Every path that decides what the run makes, and whether something was there: the script, the standard library's
    /// replacement, all that was read or looked for, and the folders of packages, in the order of their paths.
    pub fn sought(&self) -> Vec<(PathBuf, bool)> {
        let mut files = self.sought.lock().recover().clone();
        let read =
            self.files().into_iter().chain([self.script.clone()]).chain(self.options.inputs.stdlib.clone());
        files.extend(read.map(|path| (path, true)));
        files.extend(self.packages.searched_paths());
        files.into_iter().collect()
    }

    /// Adds a remark about the run's data that is no warning.
    pub(crate) fn add_note(&self, text: String) {
        self.notes.lock().recover().insert(text);
    }

    /// The remarks about the run's data that are no warnings, sorted.
    pub fn notes(&self) -> Vec<String> {
        self.notes.lock().recover().iter().cloned().collect()
    }

    /// Takes notice of a file that was looked for, and whether it was there.
    pub(crate) fn seek(&self, path: &Path, there: bool) {
        self.sought.lock().recover().insert(path.to_path_buf(), there);
    }

    /// The name and the text of the file in the place of the standard library, if there is one.
    pub(crate) fn stdlib(&self) -> Option<(&str, &str)> {
        self.stdlib.as_ref().map(|(name, text)| (name.as_str(), text.as_str()))
    }

    /// The values that a forgiving run did not use: the parameter's name and what is wrong.
    pub fn left_out(&self) -> Vec<(String, Error)> {
        self.left_out.lock().recover().clone()
    }

    /// Passes `error` on, or notes it if the run forgives that a value of `name` cannot be used.
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

    /// Takes notice of something that people should know; what is said twice is counted.
    pub fn warn(&self, warning: Warning) {
        self.warnings.add(warning);
    }

    /// What people should know of the run so far, in the order of files and lines.
    pub fn warnings(&self) -> Vec<Warning> {
        let mut warnings = self.warnings.list();
        warnings.extend(self.deprecated.warnings());
        warnings.sort_by(|a, b| (a.place().is_none(), a.place()).cmp(&(b.place().is_none(), b.place())));
        warnings
    }

    /// The parameters that the script declared, in order.
    pub fn params(&self) -> Vec<Param> {
        self.params.lock().recover().clone()
    }

    pub(crate) fn add_param(&self, param: Param) {
        let mut params = self.params.lock().recover();
        if !params.iter().any(|known| known.name == param.name) {
            params.push(param);
        }
    }

    /// Whether any file of the script names `random`.
    pub(crate) fn draws_random(&self) -> bool {
        self.facts.randoms.load(Ordering::Acquire)
    }

    /// Whether any file of the script could tell a table that is made later from one that is there.
    pub(crate) fn inspects_tables(&self) -> bool {
        self.facts.inspects_tables.load(Ordering::Acquire)
    }

    /// Whether the functions that begin in a line of a file leave nothing behind.
    pub(crate) fn is_pure(&self, file: &str, line: usize) -> bool {
        !self.facts.metatables.load(Ordering::Acquire)
            && self.source_called(file).is_some_and(|source| source.analysis.pure.contains(&line))
    }

    /// Whether the functions that begin in a line of a file do not look at their first parameter.
    pub(crate) fn is_blind(&self, file: &str, line: usize) -> bool {
        self.source_called(file).is_some_and(|source| source.analysis.blind.contains(&line))
    }

    /// The text of the guard that begins in a line of a file, if it is the only one there.
    pub(crate) fn guard_text(&self, file: &str, line: usize) -> Option<String> {
        self.source_called(file)?.analysis.guards.get(&line).cloned()
    }

    /// Where the interpretation that begins in a line of a file returns modules, if that can be seen.
    pub(crate) fn loses_modules(&self, file: &str, line: usize) -> Option<usize> {
        self.source_called(file)?.analysis.lost.get(&line).copied()
    }

    /// How the function is called that begins in a line of a file, if it is the only one there.
    pub(crate) fn signature(&self, file: &str, line: usize) -> Option<CallForm> {
        self.source_called(file)?.analysis.signatures.get(&line).cloned()
    }

    /// Takes notice that the file `asker` means the file `meant` by `require(name)`.
    pub(crate) fn note_required(&self, asker: &str, name: &str, meant: &str) {
        let mut required = self.required.lock().recover();
        required.entry(asker.to_owned()).or_default().insert(name.to_owned(), meant.to_owned());
    }

    /// What is wrong with the calls of all files that were read, once the script has declared its types of objects.
    pub(crate) fn call_problems(&self) -> Vec<Error> {
        let required = self.required.lock().recover().clone();
        let scripts = self.script_files();
        let mut files: Vec<CheckedFile> = scripts
            .read
            .values()
            .filter_map(|source| {
                let (name, ast) = (source.name.clone(), Arc::clone(source.analysis.ast.as_ref()?));
                let required = required.get(&name).cloned().unwrap_or_default();
                let package = self.package_of(&name).map(|package| package.manifest.name.clone());
                Some(CheckedFile { name, package, ast, required })
            })
            .collect();
        files.sort_by(|a, b| a.name.cmp(&b.name));
        call_problems(&files, &self.registry_with_types())
    }

    /// What the functions of rules ask of data that begin in a line of a file, as far as that can be seen.
    pub(crate) fn queries(&self, file: &str, line: usize) -> Vec<QueryCall> {
        let queries = self.source_called(file).and_then(|source| source.analysis.queries.get(&line).cloned());
        queries.unwrap_or_default()
    }

    /// How people find a file that was read.
    pub(crate) fn name_of(&self, path: &Path) -> String {
        let scripts = self.script_files();
        let known = scripts.read.get(path).filter(|_| !path.starts_with(&self.root));
        let inner = path.strip_prefix(&self.root).unwrap_or(path);
        known.map_or_else(|| inner.display().to_string(), |source| source.name.clone())
    }

    fn source_called(&self, file: &str) -> Option<Arc<SourceFile>> {
        let scripts = self.script_files();
        scripts.read.values().find(|source| source.name == file).cloned()
    }

    /// Checks if a file of the script has `name` as a word, so that it may use an attribute of that name.
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

    /// Takes notice of what a piece of the script may do.
    pub(crate) fn note(&self, analysis: &Analysis) {
        self.facts.randoms.fetch_or(analysis.random, Ordering::AcqRel);
        self.facts.metatables.fetch_or(has_metatables(&analysis.text), Ordering::AcqRel);
        self.facts.inspects_tables.fetch_or(inspects_tables(&analysis.text), Ordering::AcqRel);
    }

    /// Notes that a module has been made that stands for others.
    pub(crate) fn note_pending(&self) {
        self.pending.store(true, Ordering::Release);
    }

    /// Whether there may be modules that stand for others.
    pub(crate) fn has_pending(&self) -> bool {
        self.pending.load(Ordering::Acquire)
    }

    /// Shows questions of rules and interpretations another state of the chains. Nobody is asking.
    pub(crate) fn show_chains(&self, view: ChainView) {
        *self.chains.lock().recover() = Arc::new(view);
        self.rows.forget_views();
    }

    /// The rows that answer `question` of a rule or an interpretation, the same for as long as they are kept.
    pub(crate) fn ask(&self, question: &Question) -> Result<Arc<Rows>> {
        let view = Arc::clone(&self.chains.lock().recover());
        self.ask_about(question, &view, false)
    }

    /// The rows that answer `question` about a state of the chains, the same for as long as they are kept, which is to the end
    /// if the answer `stays`.
    #[cfg(feature = "data")]
    pub(crate) fn ask_about(&self, question: &Question, view: &ChainView, stays: bool) -> Result<Arc<Rows>> {
        let words = self.rows.words(&question.statement(), burgeon_query::table_words);
        let modules = view.find_modules(&words, question.scope());
        if !modules.is_empty() {
            self.asked.lock().recover().extend(modules.iter().map(|module| module.symbol));
        }
        let own = ModuleRows { session: self, view, modules: &modules };
        let source: &dyn RowSource = self.options.inputs.rows.as_deref().unwrap_or(&own);
        let asked = AskedRows {
            source,
            most: self.options.limits.modules,
            view: if modules.is_empty() { 0 } else { view.number() },
            stays,
        };
        let rows = self.rows.ask(question, &asked);
        self.stop.check()?;
        rows
    }

    /// Reports whether a question has named modules with a symbol.
    pub(crate) fn has_asked(&self, symbol: Symbol) -> bool {
        self.asked.lock().recover().contains(&symbol)
    }

    /// The words that may name tables in the queries of all rules, as far as their texts are known.
    pub(crate) fn queried_words(&self) -> BTreeSet<String> {
        #[cfg(feature = "data")]
        {
            let scripts = self.script_files();
            let queries = scripts.read.values().flat_map(|source| source.analysis.queries.values().flatten());
            let words = queries.flat_map(|query| burgeon_query::table_words(&query.sql));
            // The last part names the module.
            words.filter_map(|word| Some(word.rsplit('.').next()?.to_owned())).collect()
        }
        #[cfg(not(feature = "data"))]
        BTreeSet::new()
    }

    /// The rows that answer `question`, the same for as long as they are kept, which is to the end if the answer `stays`.
    #[cfg(not(feature = "data"))]
    pub(crate) fn ask_about(&self, question: &Question, _: &ChainView, stays: bool) -> Result<Arc<Rows>> {
        let Some(source) = self.options.inputs.rows.as_deref() else {
            return Err(Error::unavailable("this program was built without databases")
                .help("build it with the feature data"));
        };
        let asked = AskedRows { source, most: self.options.limits.modules, view: 0, stays };
        let rows = self.rows.ask(question, &asked);
        self.stop.check()?;
        rows
    }

    /// Keeps the values that `params` names for the rest of the run.
    pub(crate) fn keep(&self, params: &[f64]) {
        if self.values.is_empty() {
            return;
        }
        let boxed = params.iter().filter(|stored| stored.is_nan());
        self.kept.lock().recover().extend(boxed);
    }

    /// Drops the values that neither `params` nor earlier systems name, once they are many or memory is scarce.
    pub(crate) fn forget_unused(&self, params: &[f64]) {
        let kept = self.kept.lock().recover();
        let columns = [params, &kept];
        match self.stop.memory() {
            Some(memory) if memory.is_half_full() => self.values.retain_if_new(&columns),
            _ => self.values.retain_if_many(&columns),
        }
    }

    /// All problems that reading the files showed, in the order of the files' names.
    pub(crate) fn problems(&self) -> Vec<Error> {
        let scripts = self.script_files();
        let mut sources: Vec<_> = scripts.read.values().collect();
        sources.sort_by(|a, b| a.name.cmp(&b.name));
        sources.iter().flat_map(|source| source.analysis.problems.clone()).collect()
    }
}

/// A folder of data files, without links in its path.
fn data_root(folder: &Path) -> Result<PathBuf> {
    let found = folder.canonicalize().ok().filter(|found| found.is_dir());
    found.ok_or_else(|| {
        let shown = folder.display();
        Error::not_found("folder", &shown, [], format!("there is no folder {shown}"))
            .help("--data names a folder of data files")
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn progress_tells_the_time_left_once_there_is_some() {
        let progress = RunProgress::default();
        let after = |seconds: f64| progress.message(Duration::from_secs_f64(seconds));
        assert_eq!(after(0.2), "running the script");
        progress.note(5, 20, 1_000_000);
        assert_eq!(after(0.2), "step 5 of 20, 1,000,000 modules, 5.0 M modules/s");
        assert_eq!(after(4.0), "step 5 of 20, 1,000,000 modules, 0.2 M modules/s, at least 12 s left");
    }
}
