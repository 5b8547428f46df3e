//! Flags of several commands.

use std::borrow::Cow;
use std::io::Read as _;
use std::path::{Path, PathBuf};
use std::sync::Mutex;
use std::time::Duration;

use burgeon::locks::LockRecovery as _;
use burgeon::packages::{FileName, PackageSearch, Packages};
use burgeon::picture::Picture;
use burgeon::presets::Presets;
#[cfg(feature = "live")]
use burgeon::scene::Recipe;
use burgeon::script::{
    CurvesFile, FeaturePart, FileLoader, Limits, ParamValues, Print, RunInputs, RunOptions, RunReports,
    api_version,
};
use burgeon::{Error, Result};
use clap::Args;

use super::report;

/// Flags of commands that run a script.
#[derive(Args, Clone)]
pub(crate) struct ScriptFlags {
    /// Script, a Lua file; - is standard input
    pub script: PathBuf,

    /// Sets a parameter of the script
    #[arg(long = "set", value_name = "NAME=VALUE", value_parser = setting)]
    set: Vec<(String, String)>,

    /// Loads parameters and seed from a preset; --set and --seed override it
    #[arg(long, value_name = "NAME")]
    preset: Option<String>,

    /// Allows the script to read data files in this folder and its subfolders; may be repeated
    #[arg(long, value_name = "FOLDER")]
    data: Vec<PathBuf>,

    /// Allows the script to query this database, postgres://USER:PASSWORD@HOST/NAME; may be repeated
    #[arg(long, value_name = "ADDRESS")]
    database: Vec<String>,

    /// Adds a folder of packages, or one package; may be repeated
    #[arg(long, value_name = "FOLDER")]
    mods: Vec<PathBuf>,

    /// Treats warnings as errors, and stops at the first unusable feature
    #[arg(long)]
    strict: bool,

    /// Seed of all random numbers [default: 0]
    #[arg(long, value_name = "N", value_parser = whole::<u64>, allow_negative_numbers = true)]
    seed: Option<u64>,

    /// Derives at most N steps
    #[arg(long, value_name = "N", value_parser = whole::<usize>, allow_negative_numbers = true)]
    steps: Option<usize>,

    /// Builds one of several parts of the features, such as 2/4
    #[arg(long, value_name = "K/N", value_parser = part, group = "division")]
    part: Option<FeaturePart>,

    /// Distance (m) within which features of other parts are derived too, but not written
    #[arg(long, value_name = "METRES", default_value_t = 0.0, value_parser = metres, requires = "division",
          allow_negative_numbers = true)]
    reach: f64,

    /// Level of detail: 0 footprints, 1 blocks, 2 roofs, 3 full detail [default: 3]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u8).range(0..=3), allow_negative_numbers = true)]
    lod: Option<u8>,

    /// Number of threads; does not affect the result [default: number of cores]
    #[arg(long, value_name = "N", value_parser = threads, allow_negative_numbers = true)]
    threads: Option<u16>,

    /// Stops after this time
    #[arg(long, value_name = "SECONDS", default_value_t = 300.0, value_parser = seconds,
          allow_negative_numbers = true, help_heading = "Limits")]
    time_limit: f64,

    /// Memory limit of a run
    #[arg(long, value_name = "MEGABYTES", default_value_t = 4096, value_parser = megabytes,
          allow_negative_numbers = true, help_heading = "Limits")]
    memory_limit: u32,

    /// Maximum number of modules of a system's chains
    #[arg(long, value_name = "N", default_value_t = 50_000_000, value_parser = whole::<u32>,
          allow_negative_numbers = true, help_heading = "Limits")]
    module_limit: u32,

    /// Maximum number of triangles of a system
    #[arg(long, value_name = "N", default_value_t = 50_000_000, value_parser = whole::<u32>,
          allow_negative_numbers = true, help_heading = "Limits")]
    triangle_limit: u32,

    /// Number of modules that a thread processes at a time; does not affect the result
    #[arg(long, value_name = "N", default_value_t = 4096, hide = true)]
    batch: u32,

    /// Replaces the built-in standard library by this file
    #[arg(long, value_name = "FILE")]
    stdlib: Option<PathBuf>,

    /// Prints machine-readable JSON instead of text
    #[arg(long)]
    pub json: bool,
}

impl ScriptFlags {
    /// Returns the files that affect the result even if the script cannot be read.
    pub(crate) fn files(&self) -> Vec<PathBuf> {
        let presets = self.preset.as_ref().and_then(|name| Some(self.presets(name).ok()?.0));
        let curves = Some(CurvesFile::path_of(&self.script)).filter(|path| path.is_file());
        std::iter::once(&self.script).chain(&self.stdlib).cloned().chain(presets).chain(curves).collect()
    }

    /// Returns the file of the preset `name`, and its name in the file: `@castle/grand` is in the presets.json of a
    /// package.
    fn presets<'a>(&self, name: &'a str) -> Result<(PathBuf, Cow<'a, str>)> {
        if !FileName::is_meant(name) {
            return Ok((Presets::path_of(&self.script), Cow::Borrowed(name)));
        }
        let meant = FileName::parse(name)?;
        let user = user_mods();
        let search = PackageSearch { script: self.script.parent(), given: &self.mods, user: user.as_deref() };
        let packages = Packages::find(search, &api_version());
        let file = FileName { package: meant.package, path: "presets.json".to_owned() };
        let located = packages.locate("presets file", &file, None, &mut |_, _| {})?;
        Ok((located.shown, Cow::Owned(meant.path)))
    }

    /// Returns the arguments that a later command needs for the same runs, with paths that `portable` has changed. Threads are
    /// left out, because they do not affect the result.
    pub(crate) fn arguments(&self, portable: impl Fn(&Path) -> Result<String>) -> Result<Vec<String>> {
        let mut arguments = Vec::new();
        let mut add = |name: &str, value: String| arguments.extend([format!("--{name}"), value]);
        self.set.iter().for_each(|(name, value)| add("set", format!("{name}={value}")));
        self.preset.iter().for_each(|preset| add("preset", preset.clone()));
        for (name, paths) in [("data", &self.data), ("mods", &self.mods)] {
            paths.iter().try_for_each(|path| portable(path).map(|path| add(name, path)))?;
        }
        self.stdlib.iter().try_for_each(|path| portable(path).map(|path| add("stdlib", path)))?;
        self.seed.iter().for_each(|seed| add("seed", seed.to_string()));
        self.steps.iter().for_each(|steps| add("steps", steps.to_string()));
        add("lod", self.level().to_string());
        add("time-limit", self.time_limit.to_string());
        add("memory-limit", self.memory_limit.to_string());
        add("module-limit", self.module_limit.to_string());
        add("triangle-limit", self.triangle_limit.to_string());
        arguments.extend(self.strict.then(|| "--strict".to_owned()));
        Ok(arguments)
    }

    /// Changes the paths of the data, packages and standard library, and the number of threads.
    pub(crate) fn relocate(&mut self, local: impl Fn(&Path) -> PathBuf, threads: Option<u16>) {
        for path in self.data.iter_mut().chain(&mut self.mods).chain(&mut self.stdlib) {
            *path = local(path);
        }
        self.script = local(&self.script);
        self.threads = threads;
    }

    /// Returns the flags that were given and that only a run of a script needs.
    #[cfg(feature = "live")]
    pub(crate) fn given_flags(&self) -> Vec<&'static str> {
        let flags = [
            ("--set", !self.set.is_empty()),
            ("--preset", self.preset.is_some()),
            ("--data", !self.data.is_empty()),
            ("--database", !self.database.is_empty()),
            ("--mods", !self.mods.is_empty()),
            ("--strict", self.strict),
            ("--seed", self.seed.is_some()),
            ("--steps", self.steps.is_some()),
            ("--part", self.part.is_some()),
            ("--stdlib", self.stdlib.is_some()),
        ];
        flags.into_iter().filter(|(_, given)| *given).map(|(name, _)| name).collect()
    }

    /// Returns true if the script may query databases.
    pub(crate) fn has_databases(&self) -> bool {
        !self.database.is_empty()
    }

    /// Sets the level of detail.
    pub(crate) fn set_level(&mut self, lod: u8) {
        self.lod = Some(lod);
    }

    /// Returns the level of detail.
    fn level(&self) -> u8 {
        self.lod.unwrap_or(3)
    }

    /// Changes the flags of a model to those of its script, which `recipe` was written to. Values that were given override those
    /// of the recipe, which are in the preset `preset`.
    #[cfg(feature = "live")]
    pub(crate) fn follow(&mut self, script: PathBuf, recipe: &Recipe, preset: Option<&str>) {
        self.script = script;
        self.preset = self.preset.take().or(preset.map(str::to_owned));
        self.seed = self.seed.or(Some(recipe.seed));
        self.steps = self.steps.or(recipe.steps);
        self.lod = self.lod.or(Some(recipe.lod));
        if let (None, Some((text, reach))) = (self.part, &recipe.part) {
            // A part in another form is no part of this version.
            (self.part, self.reach) = (text.parse().ok(), reach.max(0.0));
        }
    }

    /// Finds the packages of the script.
    #[cfg(feature = "live")]
    pub(crate) fn packages(&self) -> Packages {
        let user = user_mods();
        let search = PackageSearch { script: self.script.parent(), given: &self.mods, user: user.as_deref() };
        Packages::find(search, &api_version())
    }

    /// Returns the folders whose data files the script may read, besides its own.
    pub(crate) fn data_folders(&self) -> &[PathBuf] {
        &self.data
    }

    /// Returns the file that replaces the standard library.
    #[cfg(feature = "live")]
    pub(crate) fn stdlib(&self) -> Option<&Path> {
        self.stdlib.as_deref()
    }

    /// Returns true if warnings are errors.
    #[cfg(feature = "live")]
    pub(crate) fn is_strict(&self) -> bool {
        self.strict
    }

    /// Returns the distance (m) within which features of other parts are derived too.
    pub(crate) fn reach(&self) -> f64 {
        self.reach
    }

    /// Returns the run options. Fails if the preset does not exist, or if the script is on standard input and cannot be read.
    pub(crate) fn options(&self) -> Result<RunOptions> {
        let loader = (self.script.as_os_str() == STANDARD).then(standard_script).transpose()?;
        let preset = match &self.preset {
            // The run reports a missing script.
            Some(name) if self.script.is_file() => {
                let (path, inner) = self.presets(name)?;
                let preset = Presets::read_file(&path)?.get(&inner)?;
                Some(match FileName::parse(name) {
                    Ok(file) => preset.of_package(&file.package),
                    Err(_) => preset,
                })
            }
            _ => None,
        };
        let seed = self.seed.or(preset.as_ref().and_then(|preset| preset.seed));
        Ok(RunOptions {
            params: ParamValues { set: self.set.clone(), preset, forgiving: false },
            seed: seed.unwrap_or(0),
            steps: self.steps,
            part: self.part.map(|part| FeaturePart { reach: self.reach, ..part }),
            lod: self.level(),
            threads: self.threads.map(usize::from),
            batch: self.batch as usize,
            limits: Limits {
                time: Duration::from_secs_f64(self.time_limit),
                memory: self.memory_limit as usize * 1_000_000,
                whole_program: false,
                modules: self.module_limit as usize,
                triangles: self.triangle_limit as usize,
                file: None,
            },
            inputs: RunInputs {
                data: self.data.clone(),
                databases: self.database.clone(),
                mods: self.mods.clone(),
                user_mods: user_mods(),
                loader,
                stdlib: self.stdlib.clone(),
                ..RunInputs::default()
            },
            reports: RunReports { print: Some(Print::new(report::printed)), ..RunReports::default() },
            strict: self.strict,
            ..burgeon::options()
        })
    }
}

/// File name of standard input and output.
pub(crate) const STANDARD: &str = "-";

/// Text of the script on standard input, once it has been read.
static STANDARD_TEXT: Mutex<Option<Vec<u8>>> = Mutex::new(None);

/// Returns a loader with the script on standard input as the file `-` before the working folder. Reads standard input once.
fn standard_script() -> Result<FileLoader> {
    let mut text = STANDARD_TEXT.lock().recover();
    if text.is_none() {
        let mut read = Vec::new();
        std::io::stdin()
            .lock()
            .take(LARGEST_SCRIPT + 1)
            .read_to_end(&mut read)
            .map_err(|error| Error::system(format!("cannot read the script on standard input: {error}")))?;
        *text = Some(read);
    }
    let files = text.iter().map(|text| (STANDARD.to_owned(), text.clone())).collect();
    Ok(FileLoader::of_files(files).before("."))
}

/// Returns the text of a script that has no file of its name: that on standard input.
pub(crate) fn text_in_memory(file: &str) -> Option<String> {
    if file != STANDARD {
        return None;
    }
    String::from_utf8(STANDARD_TEXT.lock().recover().clone()?).ok()
}

/// Maximum size (bytes) of a script on standard input; runs refuse scripts of this size.
const LARGEST_SCRIPT: u64 = 8_000_000;

/// Returns a path as a word of a shell's command line, in quotes if it needs them.
pub(crate) fn shell_word(path: &Path) -> String {
    let text = path.display().to_string();
    let text = if text.starts_with('-') { format!("./{text}") } else { text };
    let is_plain =
        |letter: char| letter.is_alphanumeric() || matches!(letter, '.' | '_' | '-' | '/' | '+' | ',' | ':');
    let is_drive = cfg!(windows) && text.chars().all(|letter| is_plain(letter) || letter == '\\');
    match text.chars().all(is_plain) || is_drive {
        true if !text.is_empty() => text,
        _ => format!("'{}'", text.replace('\'', "'\\''")),
    }
}

/// Returns the user's packages folder, which need not exist.
pub(crate) fn user_mods() -> Option<PathBuf> {
    let set = |name: &str| std::env::var_os(name).filter(|value| !value.is_empty()).map(PathBuf::from);
    let home = || set("HOME").map(|home| home.join(".local/share"));
    let data = if cfg!(windows) { set("LOCALAPPDATA") } else { set("XDG_DATA_HOME").or_else(home) };
    data.map(|folder| folder.join("burgeon/mods"))
}

/// Calls `ended` when the user interrupts the program. If the program is still running 0.5 s later, it exits.
pub(crate) fn on_interrupt(ended: impl Fn() + Send + 'static) -> Result<()> {
    ctrlc::set_handler(move || {
        ended();
        std::thread::sleep(Duration::from_millis(500));
        burgeon::export::abandon();
        std::process::exit(0);
    })
    .map_err(deaf)
}

/// Exits the program on an interrupt by the user or the system, without leaving incomplete files.
pub(crate) fn end_on_interrupt() -> Result<()> {
    ctrlc::set_handler(|| {
        burgeon::export::abandon();
        std::process::exit(INTERRUPTED);
    })
    .map_err(deaf)
}

/// Exit status that shells use for an interrupt.
const INTERRUPTED: i32 = 130;

fn deaf(error: ctrlc::Error) -> Error {
    Error::system(format!("cannot wait for an interrupt: {error}"))
}

pub(crate) fn size(text: &str) -> Result<(u32, u32), String> {
    let parts = text
        .split_once(['x', 'X'])
        .and_then(|(width, height)| Some((width.parse().ok()?, height.parse().ok()?)));
    match parts {
        Some((width, height))
            if (1..=Picture::LARGEST).contains(&width) && (1..=Picture::LARGEST).contains(&height) =>
        {
            Ok((width, height))
        }
        _ => Err(format!("write WIDTHxHEIGHT, such as 1280x960, each from 1 to {}", Picture::LARGEST)),
    }
}

fn setting(text: &str) -> Result<(String, String), &'static str> {
    match text.split_once('=') {
        Some((name, value)) if !name.trim().is_empty() => Ok((name.trim().to_owned(), value.to_owned())),
        _ => Err("write NAME=VALUE"),
    }
}

pub(crate) fn whole<T: std::str::FromStr>(text: &str) -> Result<T, &'static str> {
    text.parse().map_err(|_| "write an integer of at least 0")
}

pub(crate) fn threads(text: &str) -> Result<u16, &'static str> {
    match text.parse() {
        Ok(threads) if (1..=1024).contains(&threads) => Ok(threads),
        _ => Err("write an integer from 1 to 1024"),
    }
}

pub(crate) fn megabytes(text: &str) -> Result<u32, &'static str> {
    match text.parse() {
        Ok(megabytes) if megabytes >= 16 => Ok(megabytes),
        _ => Err("write an integer number of megabytes of at least 16"),
    }
}

pub(crate) fn part(text: &str) -> Result<FeaturePart, &'static str> {
    text.parse().map_err(|_| "write the number of a part and the number of parts, such as 2/4")
}

pub(crate) fn metres(text: &str) -> Result<f64, &'static str> {
    match text.parse::<f64>() {
        Ok(metres) if (0.0..1e9).contains(&metres) => Ok(metres),
        _ => Err("write a number of metres of at least 0"),
    }
}

pub(crate) fn seconds(text: &str) -> Result<f64, &'static str> {
    match text.parse::<f64>() {
        Ok(seconds) if seconds > 0.0 && seconds < 1e9 => Ok(seconds),
        _ => Err("write a number of seconds above 0"),
    }
}
