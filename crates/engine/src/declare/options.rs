//! How a script is to be run, and how much it may use.

use std::fmt;
use std::path::PathBuf;
use std::sync::{Arc, LazyLock};
use std::time::Duration;

use super::Preset;
use crate::questions::RowSource;
use burgeon_base::stop::Stop;
use burgeon_data::Cache;
use burgeon_kit::Registry;

/// How much a run may use.
#[derive(Debug, Clone)]
pub struct Limits {
    /// Time for the whole run.
    pub time: Duration,
    /// Memory (bytes) of the run: its virtual machines, files, chains, objects and results. A program that does not use
    /// [`CountingAllocator`](burgeon_base::account::CountingAllocator) limits each virtual machine, and the files, to it.
    pub memory: usize,
    /// Whether the memory of all threads of the program counts: it does nothing but this run.
    pub whole_program: bool,
    /// Modules in all chains of a system.
    pub modules: usize,
    /// Triangles of all objects of a system.
    pub triangles: usize,
}

impl Default for Limits {
    fn default() -> Self {
        Self {
            time: Duration::from_secs(300),
            memory: 4 << 30,
            whole_program: false,
            modules: 50_000_000,
            triangles: 50_000_000,
        }
    }
}

/// Takes what scripts print, call by call, from any thread.
#[derive(Clone)]
pub struct Print(Arc<dyn Fn(&str) + Send + Sync>);

impl Print {
    /// Hands each text that is printed to `take`, without a line break at its end.
    pub fn new(take: impl Fn(&str) + Send + Sync + 'static) -> Self {
        Self(Arc::new(take))
    }

    pub(crate) fn take(&self, text: &str) {
        (self.0)(text);
    }
}

impl fmt::Debug for Print {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("Print")
    }
}

/// The chains that a run is to trace.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct TraceRequest {
    /// The system's place in the script, from 0. The run ends once it is derived.
    pub system: usize,
    /// The chain's number in the system; all of them if `None`.
    pub chain: Option<usize>,
}

/// Values for the `param` declarations of a script.
#[derive(Debug, Clone, Default)]
pub struct ParamValues {
    /// Values by name, as text.
    pub set: Vec<(String, String)>,
    /// Values for those that are not in `set`. Its seed does not count: that of the run does.
    pub preset: Option<Preset>,
    /// Whether values in `set` that the script does not take are left out, and not an error;
    /// [`Session::left_out`] tells which.
    ///
    /// [`Session::left_out`]: super::Session::left_out
    pub forgiving: bool,
}

impl From<Vec<(String, String)>> for ParamValues {
    fn from(set: Vec<(String, String)>) -> Self {
        Self { set, ..Self::default() }
    }
}

/// What a run may read besides the folder of its script.
#[derive(Debug, Clone, Default)]
pub struct RunInputs {
    /// Folders whose data files it may read.
    pub data: Vec<PathBuf>,
    /// Addresses of databases that it may ask, with a password where one is needed.
    pub databases: Vec<String>,
    /// Answers what scripts ask in SQL, in place of the sources that they have loaded.
    pub rows: Option<Arc<dyn RowSource>>,
    /// Layers that earlier runs have read.
    pub cache: Option<Arc<Cache>>,
    /// Folders besides `mods` beside the script that packages are in, or that are packages.
    pub mods: Vec<PathBuf>,
    /// The user's own folder of packages, which need not be there.
    pub user_mods: Option<PathBuf>,
    /// A file in the place of the built-in standard library.
    pub stdlib: Option<PathBuf>,
}

/// What a run tells besides what it makes.
#[derive(Debug, Clone, Default)]
pub struct RunReports {
    /// Takes what scripts print; without it, nobody does.
    pub print: Option<Print>,
    /// Whether to measure the time of each interpretation rule, which takes about a twentieth of it.
    pub profile: bool,
    /// Whether what is known of the features in lists that scripts make is kept, for files that tell it.
    pub records: bool,
    /// The chains to note the lineage of; see [`trace`](crate::trace).
    pub trace: Option<TraceRequest>,
}

/// How a script is to be run.
#[derive(Debug, Clone)]
pub struct RunOptions {
    /// Values for its parameters.
    pub params: ParamValues,
    /// The seed of all random numbers.
    pub seed: u64,
    /// The greatest number of derivation steps of each system; as the script says if `None`.
    pub steps: Option<usize>,
    /// The level of detail: 0 ground plans, 1 blocks, 2 roofs, 3 everything. Scripts read it as `lod`.
    pub lod: u8,
    /// The types of objects that scripts can use.
    pub registry: Registry,
    /// What it may read.
    pub inputs: RunInputs,
    /// What it tells.
    pub reports: RunReports,
    /// How much it may use.
    pub limits: Limits,
    /// Ends it, too, when it is stopped.
    pub stop: Option<Arc<Stop>>,
    /// Whether to stop before deriving, after all declarations have been read.
    pub check: bool,
    /// Whether warnings end the run as errors, and bad data does; otherwise its features are left out, and
    /// [`DerivedSystem::remarks`] tells which.
    ///
    /// [`DerivedSystem::remarks`]: crate::results::DerivedSystem::remarks
    pub strict: bool,
    /// Worker threads; as many as there are cores if `None`.
    pub threads: Option<usize>,
    /// Modules that a worker takes at a time. The result does not depend on it.
    pub batch: usize,
}

/// How many threads can run at once. Asking the system reads files, which takes longer than a step of a small chain.
static CORES: LazyLock<usize> =
    LazyLock::new(|| std::thread::available_parallelism().map_or(1, std::num::NonZero::get));

impl RunOptions {
    /// The number of worker threads.
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
        }
    }
}
