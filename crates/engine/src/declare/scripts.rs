//! Script files of a run: each file is read once for all virtual machines, and prefetched if possible.

use std::collections::{BTreeSet, VecDeque};
use std::path::{Path, PathBuf};
use std::sync::{Arc, MutexGuard};

use rustc_hash::FxHashMap;

use super::bytecode::compile;
use super::session::Session;
use burgeon_base::MemoryOwner;
use burgeon_base::error::{Error, Limit, Result, SourcePlace, did_you_mean, nearest};
use burgeon_base::locks::LockRecovery;
use burgeon_language::analysis::{Analysis, Globals, ScriptReader, calls_with_text};
use burgeon_packages::FileName;

/// Maximum size (bytes) of one file of a script.
const LARGEST: u64 = 4_000_000;
/// Memory (bytes) that reading a script takes for each byte of it.
const READING: usize = 300;

/// Maximum number of files that are prefetched at the same time.
const MOST_AHEAD: usize = 4;

/// Script file as all virtual machines run it.
#[derive(Debug)]
pub(crate) struct SourceFile {
    /// Display name in messages, relative to the working directory.
    pub name: String,
    /// Content of the file.
    pub text: String,
    /// Result of parsing and analysing the file.
    pub analysis: Analysis,
}

/// Script files that are read, being read or queued.
#[derive(Default)]
pub(super) struct ScriptFiles {
    /// Requested files, by path.
    pub read: FxHashMap<PathBuf, Arc<SourceFile>>,
    ahead: FxHashMap<PathBuf, ScriptReader>,
    /// Paths and display names of the files to prefetch next.
    next: VecDeque<(PathBuf, String)>,
}

impl ScriptFiles {
    /// Starts reading the next queued files. Errors are reported when a file is requested.
    fn begin(&mut self) {
        while self.ahead.len() < MOST_AHEAD
            && let Some((path, name)) = self.next.pop_front()
        {
            if !self.read.contains_key(&path)
                && !self.ahead.contains_key(&path)
                && let Ok(reader) = begin_reading(&path, &name)
            {
                self.ahead.insert(path, reader);
            }
        }
    }

    fn reader(&mut self, path: &Path, name: &str) -> Result<ScriptReader> {
        let reader = self.ahead.remove(path).map_or_else(|| begin_reading(path, name), Ok);
        self.begin();
        reader
    }
}

impl Session {
    /// Returns the script files of the run.
    pub(super) fn script_files(&self) -> MutexGuard<'_, ScriptFiles> {
        self.scripts.lock().recover()
    }

    /// Returns paths and texts of the files that do not belong to packages.
    pub(crate) fn own_texts(&self) -> Vec<(PathBuf, String)> {
        let files = self.script_files();
        let own = files.read.iter().filter(|(_, source)| self.package_of(&source.name).is_none());
        let mut own: Vec<_> = own.map(|(path, source)| (path.clone(), source.text.clone())).collect();
        own.sort();
        own
    }

    /// Starts reading the main file, in parallel with the creation of a machine.
    pub(crate) fn read_ahead(&self) {
        let mut files = self.script_files();
        files.next.push_back((self.path().to_path_buf(), self.script().display().to_string()));
        files.begin();
    }

    /// Returns the source of the file at `path`, which is in the script's folder; `name` is for messages.
    pub(crate) fn source(&self, path: &Path, name: &str, globals: &Globals) -> Result<Arc<SourceFile>> {
        let mut files = self.script_files();
        if let Some(source) = files.read.get(path) {
            return Ok(Arc::clone(source));
        }
        let reader = files.reader(path, name)?;
        let text = reader.text().to_owned();
        let mut analysis = reader.finish(globals);
        self.note(&analysis);
        analysis.doubtful.iter().for_each(|warning| self.warn(warning.clone()));
        for (used, line) in &analysis.deprecated {
            if let Some(deprecation) = globals.deprecated.get(used) {
                let place = SourcePlace::new(name, *line);
                self.use_deprecated(used, deprecation, Some(&place));
            }
        }
        let undeclared = self.undeclared(name, &analysis.packages);
        analysis.problems.extend(undeclared);
        files.next.extend(self.named_scripts(name, &analysis.packages));
        let source = Arc::new(SourceFile { name: name.to_owned(), text, analysis });
        files.read.insert(path.to_path_buf(), Arc::clone(&source));
        files.begin();
        Ok(source)
    }

    /// Returns the first line of the script files that contains the string `text` in quotes.
    pub(crate) fn place_of_string(&self, text: &str) -> Option<SourcePlace> {
        let quoted = [format!("\"{text}\""), format!("'{text}'")];
        let files = self.script_files();
        let mut sources: Vec<&Arc<SourceFile>> = files.read.values().collect();
        sources.sort_by(|a, b| a.name.cmp(&b.name));
        sources.into_iter().find_map(|source| {
            let mut lines = source.analysis.text.lines();
            let line = lines.position(|line| quoted.iter().any(|quoted| line.contains(quoted)))?;
            Some(SourcePlace::new(&*source.name, line + 1))
        })
    }

    /// Returns paths and display names of the package scripts that strings of a file name.
    fn named_scripts(&self, file: &str, texts: &[(String, usize)]) -> Vec<(PathBuf, String)> {
        let asker = self.package_of(file);
        let located = texts.iter().filter_map(|(text, _)| {
            let name = FileName::script(text.strip_suffix(".lua").unwrap_or(text)).ok()?;
            let located = self.packages().locate("file", &name, asker, &mut |_, _| {}).ok()?;
            Some((located.path, located.shown.display().to_string()))
        });
        located.collect()
    }
}

/// Maximum number of files that are searched for parameters.
const MOST_LOOKED_THROUGH: usize = 1000;

/// Returns the names of the parameters that the script of a session declares, and files that it requires from its
/// folder. Considers only calls with literal strings.
pub(super) fn own_params(session: &Session) -> BTreeSet<String> {
    let root = session.root();
    let mut names = BTreeSet::new();
    let mut next: Vec<PathBuf> = vec![session.path().to_path_buf()];
    let mut known: BTreeSet<PathBuf> = next.iter().cloned().collect();
    while let Some(path) = next.pop() {
        let Ok(bytes) = burgeon_base::files::read(&path, LARGEST) else { continue };
        let text = String::from_utf8_lossy(&bytes);
        names.extend(calls_with_text(&text, "param").map(str::to_owned));
        let origin = session.origin(&path);
        let folder = origin.parent().unwrap_or(root);
        for name in calls_with_text(&text, "require").filter(|name| !FileName::is_meant(name)) {
            let file = format!("{}.lua", name.strip_suffix(".lua").unwrap_or(name));
            // The error of a loader is reported when the script requires the file.
            let find = |from: &Path| session.find_file(&from.join(&file)).ok().flatten();
            let found = [folder, root].into_iter().find_map(find);
            let inside = found.filter(|found| session.is_inside(found) && known.len() < MOST_LOOKED_THROUGH);
            next.extend(inside.filter(|found| known.insert(found.clone())));
        }
    }
    names
}

/// Starts reading the file at `path`; `name` is for messages.
fn begin_reading(path: &Path, name: &str) -> Result<ScriptReader> {
    let bytes =
        burgeon_base::files::read(path, LARGEST).map_err(|error| unreadable(Path::new(name), &error))?;
    MemoryOwner::ensure_room(READING * bytes.len())?;
    let text = String::from_utf8(bytes).map_err(|_| {
        Error::file(path, format!("{name} is not a text file"))
            .help("scripts are UTF-8 text; check the file's name")
    })?;
    let text = text.strip_prefix('\u{feff}').unwrap_or(&text);
    // The first line of a program for a shell becomes a comment of the same length, so columns stay.
    let comment = text.strip_prefix("#!").map(|rest| format!("--{rest}"));
    Ok(ScriptReader::begin(name, comment.as_deref().unwrap_or(text), compile))
}

/// Returns name and text of a file that replaces the standard library.
pub(super) fn read_stdlib(path: &Path) -> Result<(String, String)> {
    let name = path.display().to_string();
    let remedy = "--stdlib needs a Lua file; without it, the built-in standard library is used";
    let bytes = burgeon_base::files::read(path, LARGEST).map_err(|error| {
        Error::file(path, format!("cannot read the standard library {name}: {error}")).help(remedy)
    })?;
    let text = String::from_utf8(bytes).map_err(|_| {
        Error::file(path, format!("the standard library {name} is not a text file")).help(remedy)
    })?;
    let text = text.strip_prefix('\u{feff}').map(str::to_owned).unwrap_or(text);
    Ok((name, text))
}

/// Maximum number of entries of a folder that are searched for a script.
const MOST_ENTRIES: usize = 10_000;

/// Returns the file names of the scripts in a folder, sorted.
fn scripts_in(folder: &Path) -> Vec<String> {
    let folder = if folder.as_os_str().is_empty() { Path::new(".") } else { folder };
    let entries = std::fs::read_dir(folder).into_iter().flatten().take(MOST_ENTRIES).flatten();
    let names = entries.filter_map(|entry| entry.file_name().into_string().ok());
    let mut names: Vec<String> = names.filter(|name| name.ends_with(".lua")).collect();
    names.sort();
    names
}

/// Returns the script whose name is nearest to that of a missing file: `tree.lua` for `tre.lua` and for `tree`.
fn nearest_script(path: &Path) -> Option<String> {
    let folder = path.parent()?;
    let name = path.file_name()?.to_str()?;
    let stem = name.strip_suffix(".lua").unwrap_or(name);
    let scripts = scripts_in(folder);
    let stems = scripts.iter().filter_map(|script| script.strip_suffix(".lua"));
    let near = nearest(stem, stems)?;
    Some(folder.join(format!("{near}.lua")).display().to_string())
}

/// Returns the error for a script that cannot be read.
pub(super) fn unreadable(path: &Path, error: &std::io::Error) -> Error {
    let shown = path.display();
    match error.kind() {
        std::io::ErrorKind::NotFound => {
            let error = Error::not_found("script", &shown, [], format!("script not found: {shown}"));
            let error =
                nearest_script(path).into_iter().fold(error, |error, near| error.help(did_you_mean(&near)));
            error.help("check the path, or create a script: burgeon new NAME")
        }
        std::io::ErrorKind::IsADirectory => {
            let inside = scripts_in(path).into_iter().next();
            let inside = inside.map(|name| format!(", such as {}", path.join(name).display()));
            let help = format!("specify a script in the folder{}", inside.unwrap_or_default());
            Error::file(path, format!("{shown} is a folder")).help(help)
        }
        std::io::ErrorKind::FileTooLarge => {
            Error::limit(Limit::Size, format!("{shown} is larger than {} MB", LARGEST / 1_000_000))
                .help("divide it; require loads other files of its folder")
        }
        std::io::ErrorKind::InvalidInput => {
            Error::file(path, format!("cannot read {shown}: {error}")).help("scripts are text files")
        }
        _ => Error::file(path, format!("cannot read {shown}: {error}")),
    }
}
