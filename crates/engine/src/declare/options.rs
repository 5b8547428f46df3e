//! Options and limits of a run.

use std::fmt;
use std::path::PathBuf;
use std::sync::{Arc, LazyLock};
use std::time::Duration;

use super::{FeatureChoice, FeaturePart, FileLoader, Preset};
use crate::checkpoints::DerivationStore;
use crate::queries::RowSource;
use burgeon_base::error::SourcePlace;
use burgeon_base::stop::Stop;
use burgeon_kit::Registry;

/// Limits of a run.
#[derive(Debug, Clone)]
pub struct Limits {
    /// Time limit of the whole run.
    pub time: Duration,
    /// Memory limit (bytes) of the run: virtual machines, files, chains, objects and results. If the program
    /// does not use [`CountingAllocator`](burgeon_base::account::CountingAllocator), the limit applies to
    /// each virtual machine, and to the files, separately.
    pub memory: usize,
    /// Set to count the memory of all threads of the program, which then does nothing but this run.
    pub whole_program: bool,
    /// Maximum number of modules in all chains of a system.
    pub modules: usize,
    /// Maximum number of triangles of all objects of a system.
    pub triangles: usize,
    /// Limit of the file that the run is for.
    pub file: Option<Arc<FileLimit>>,
}

/// Limit of the triangles of a system, beyond which a file is too large. A run ends at the limit while it draws.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct FileLimit {
    /// Maximum number of triangles; an instance counts as one.
    pub triangles: usize,
    /// Message of the error.
    pub message: String,
    /// Remedy of the error.
    pub help: String,
}

impl Default for Limits {
    fn default() -> Self {
        Self {
            time: Duration::from_secs(300),
            memory: 4 << 30,
            whole_program: false,
            modules: 50_000_000,
            triangles: 50_000_000,
            file: None,
        }
    }
}

/// Receiver of the texts that scripts print, called from any thread.
#[derive(Clone)]
pub struct Print(PrintReceiver);

type PlacedPrintReceiver = dyn Fn(&str, Option<SourcePlace>) + Send + Sync;

#[derive(Clone)]
enum PrintReceiver {
    Texts(Arc<dyn Fn(&str) + Send + Sync>),
    Places(Arc<PlacedPrintReceiver>),
}

impl Print {
    /// Creates a receiver that passes each printed text to `take`, without a final line break.
    pub fn new(take: impl Fn(&str) + Send + Sync + 'static) -> Self {
        Self(PrintReceiver::Texts(Arc::new(take)))
    }

    /// Creates a receiver that passes each printed text to `take`, with the line of the script that prints it.
    ///
    /// ```
    /// use std::sync::{Arc, Mutex};
    /// use burgeon_engine::run::run;
    /// use burgeon_engine::script::{FileLoader, Print, RunOptions};
    ///
    /// let lines: Arc<Mutex<Vec<usize>>> = Arc::default();
    /// let into = Arc::clone(&lines);
    /// let mut options = RunOptions::default();
    /// options.inputs.loader = Some(FileLoader::new(|name| {
    ///     Ok((name == "a.lua").then(|| b"\nprint(1)".to_vec()))
    /// }));
    /// options.reports.print = Some(Print::with_places(move |_, place| {
    ///     into.lock().unwrap().extend(place.map(|place| place.line));
    /// }));
    /// run("a.lua".as_ref(), options)?;
    /// assert_eq!(*lines.lock().unwrap(), [2]);
    /// # Ok::<(), burgeon_base::error::Error>(())
    /// ```
    pub fn with_places(take: impl Fn(&str, Option<SourcePlace>) + Send + Sync + 'static) -> Self {
        Self(PrintReceiver::Places(Arc::new(take)))
    }

    /// Passes a text to the receiver; `place` finds the line, if the receiver wants it.
    pub fn take(&self, text: &str, place: impl FnOnce() -> Option<SourcePlace>) {
        match &self.0 {
            PrintReceiver::Texts(take) => take(text),
            PrintReceiver::Places(take) => take(text, place()),
        }
    }
}

impl fmt::Debug for Print {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("Print")
    }
}

/// Chains to trace in a run.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct TraceRequest {
    /// Index of the system in the script, from 0. The run ends once the system is derived.
    pub system: usize,
    /// Index of the chain in the system; all chains if `None`.
    pub chain: Option<usize>,
}

/// Values for the `param` declarations of a script.
#[derive(Debug, Clone, Default)]
pub struct ParamValues {
    /// Values by name, as text.
    pub set: Vec<(String, String)>,
    /// Values for parameters that are not in `set`. The seed of the preset is ignored; the seed of the run
    /// applies.
    pub preset: Option<Preset>,
    /// Set to skip unusable values in `set` instead of reporting an error; [`Session::left_out`] returns the
    /// skipped values.
    ///
    /// [`Session::left_out`]: super::Session::left_out
    pub forgiving: bool,
}

impl From<Vec<(String, String)>> for ParamValues {
    fn from(set: Vec<(String, String)>) -> Self {
        Self { set, ..Self::default() }
    }
}

/// Inputs of a run, in addition to the folder of its script.
#[derive(Debug, Clone, Default)]
pub struct RunInputs {
    /// Folders whose data files the script may read.
    pub data: Vec<PathBuf>,
    /// Addresses of the databases that the script may query, with a password if necessary.
    pub databases: Vec<String>,
    /// Source that runs the SQL queries of scripts, instead of the loaded sources.
    pub rows: Option<Arc<dyn RowSource>>,
    /// Chains of earlier runs, from which the run continues if only the number of steps differs.
    pub derivations: Option<Arc<DerivationStore>>,
    /// Package folders, or single packages, in addition to `mods` next to the script.
    pub mods: Vec<PathBuf>,
    /// Package folder of the user; it need not exist.
    pub user_mods: Option<PathBuf>,
    /// Files in memory that replace the folder of the script. The path of the script is then a name of the loader.
    pub loader: Option<FileLoader>,
    /// File that replaces the built-in standard library.
    pub stdlib: Option<PathBuf>,
}

/// Reports of a run, in addition to the model.
#[derive(Debug, Clone, Default)]
pub struct RunReports {
    /// Receiver of the texts that scripts print; `None` discards them.
    pub print: Option<Print>,
    /// Set to measure the time of each interpretation rule, which adds about 5 % to it.
    pub profile: bool,
    /// Set to keep the attributes of features in lists of the script, for export.
    pub records: bool,
    /// Chains whose lineage is recorded; see [`trace`](crate::trace).
    pub trace: Option<TraceRequest>,
}

/// Options of a run.
#[derive(Debug, Clone)]
pub struct RunOptions {
    /// Values for the parameters.
    pub params: ParamValues,
    /// Seed of all random numbers.
    pub seed: u64,
    /// Maximum number of derivation steps of each system; `None` leaves it to the script.
    pub steps: Option<usize>,
    /// Part of the features to build; all features if `None`.
    pub part: Option<FeaturePart>,
    /// Features of the part that are shown; `None` for all.
    pub choice: Option<FeatureChoice>,
    /// Level of detail: 0 footprints, 1 blocks, 2 roofs, 3 full detail. Scripts read it as `lod`.
    pub lod: u8,
    /// Object types and sources that scripts can use.
    pub registry: Registry,
    /// Files and databases that the script may read.
    pub inputs: RunInputs,
    /// Reports of the run.
    pub reports: RunReports,
    /// Limits of the run.
    pub limits: Limits,
    /// Parent signal: if it is stopped, the run is cancelled too.
    pub stop: Option<Arc<Stop>>,
    /// Set to end the run before the first derivation, after all declarations have been read.
    pub check: bool,
    /// Set to treat warnings and faulty data as errors. Otherwise faulty features are skipped, and
    /// [`DerivedSystem::feature_warnings`] lists them.
    ///
    /// [`DerivedSystem::feature_warnings`]: crate::results::DerivedSystem::feature_warnings
    pub strict: bool,
    /// Number of worker threads; the number of cores if `None`.
    pub threads: Option<usize>,
    /// Number of modules that a worker takes at a time. It does not affect the result.
    pub batch: usize,
    /// Set to run bytecode until a machine has worked on derivations for some milliseconds: for many runs that are shorter than the
    /// compilation of native code. It does not affect the result.
    pub waits_with_native: bool,
}

/// Number of threads that can run in parallel. The value is cached, because the system reads files to find
/// it, which takes longer than a step of a small chain.
static CORES: LazyLock<usize> =
    LazyLock::new(|| std::thread::available_parallelism().map_or(1, std::num::NonZero::get));

impl RunOptions {
    /// Returns the number of worker threads.
    pub fn worker_threads(&self) -> usize {
        self.threads.unwrap_or_else(|| *CORES).max(1)
    }
}

impl Default for RunOptions {
    fn default() -> Self {
        Self {
            params: ParamValues::default(),
            seed: 0,
            steps: None,
            part: None,
            choice: None,
            lod: 3,
            registry: Registry::default(),
            inputs: RunInputs::default(),
            reports: RunReports::default(),
            limits: Limits::default(),
            stop: None,
            check: false,
            strict: false,
            threads: None,
            batch: 4096,
            waits_with_native: false,
        }
    }
}
