//! Scripts and assets that a host program has in memory, in the place of the script's folder.

use std::collections::{BTreeMap, BTreeSet};
use std::fmt;
use std::path::{Component, Path, PathBuf};
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Arc, Mutex};

use burgeon_base::MemoryOwner;
use burgeon_base::error::{Error, Result};
use burgeon_base::locks::LockRecovery;

type Load = dyn Fn(&str) -> Result<Option<Vec<u8>>> + Send + Sync;

/// Files of a script that are not in a folder: the script itself, the files that it requires, data, models and textures.
///
/// Names are relative to the folder that the loader replaces, with `/` between folders.
#[derive(Clone)]
pub struct FileLoader {
    load: Arc<Load>,
    /// Files that a run loads before it begins.
    names: Arc<[String]>,
}

impl FileLoader {
    /// Creates a loader that calls `load` with the name of each file that a script looks for, at most once in a run and from
    /// any thread. `load` returns `None` if there is no such file.
    ///
    /// Names of folders, patterns of names, packages and the files that models refer to need
    /// [`of_files`](Self::of_files) or [`with_names`](Self::with_names), because such a loader cannot list its files.
    pub fn new(load: impl Fn(&str) -> Result<Option<Vec<u8>>> + Send + Sync + 'static) -> Self {
        Self { load: Arc::new(load), names: Arc::default() }
    }

    /// Adds names of files, which a run loads before it begins. The loader can have others too.
    ///
    /// ```
    /// use burgeon_engine::script::FileLoader;
    ///
    /// let loader = FileLoader::new(|name| Ok(name.ends_with(".lua").then(|| b"return 3".to_vec())));
    /// let loader = loader.with_names(["mods/castle/size.lua".to_owned()]);
    /// assert_eq!(loader.names(), ["mods/castle/size.lua"]);
    /// ```
    #[must_use]
    pub fn with_names(self, names: impl IntoIterator<Item = String>) -> Self {
        Self { names: self.names.iter().cloned().chain(names).collect(), ..self }
    }

    /// Returns the names of the files that a run loads before it begins.
    pub fn names(&self) -> &[String] {
        &self.names
    }

    /// Creates a loader of these files, by their names.
    pub fn of_files(files: BTreeMap<String, Vec<u8>>) -> Self {
        let names = files.keys().cloned().collect();
        Self { load: Arc::new(move |name| Ok(files.get(name).cloned())), names }
    }
}

impl fmt::Debug for FileLoader {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("FileLoader")
    }
}

/// Temporary folder with the files that a run has loaded, because readers of data need files. It is removed with the run.
pub(super) struct LoadedFolder {
    path: PathBuf,
    loader: FileLoader,
    requested: Mutex<BTreeSet<PathBuf>>,
}

impl LoadedFolder {
    /// Creates the folder, and loads the files whose names are known.
    pub(super) fn new(loader: &FileLoader) -> Result<Self> {
        let path = create_folder()
            .map_err(|error| Error::system(format!("cannot create a temporary folder: {error}")))?;
        let folder = Self { path, loader: loader.clone(), requested: Mutex::default() };
        for name in &*folder.loader.names {
            let path = folder.path_of(name)?;
            folder.provide(&path)?;
        }
        Ok(folder)
    }

    /// Returns the path of the file `name`. Fails if the name is not relative, or leads out of the folder.
    pub(super) fn path_of(&self, name: &str) -> Result<PathBuf> {
        let is_inside = Path::new(name).components().all(|part| matches!(part, Component::Normal(_)));
        if name.is_empty() || !is_inside {
            return Err(Error::file(name, format!("{name:?} is not a name of a file in memory")).help(
                "use a name such as tree.lua or textures/bark.png, without .. and without / at the beginning",
            ));
        }
        Ok(self.path.join(name))
    }

    /// Loads the file for a path, if it is in the folder and has not been requested before.
    pub(super) fn provide(&self, path: &Path) -> Result<()> {
        let Ok(inner) = path.strip_prefix(&self.path) else { return Ok(()) };
        let parts: Option<Vec<&str>> = inner.iter().map(|part| part.to_str()).collect();
        let Some(name) = parts.filter(|parts| !parts.is_empty()).map(|parts| parts.join("/")) else {
            return Ok(());
        };
        let mut requested = self.requested.lock().recover();
        if !requested.insert(inner.to_path_buf()) || path.exists() {
            return Ok(());
        }
        let Some(bytes) = (self.loader.load)(&name)? else { return Ok(()) };
        MemoryOwner::ensure_room(bytes.len())?;
        let refuse = |error: std::io::Error| {
            Error::file(&name, format!("cannot store {name} in a temporary folder: {error}"))
                .help("free some space in it, or set TMPDIR to another folder")
        };
        path.parent().map_or(Ok(()), std::fs::create_dir_all).map_err(refuse)?;
        std::fs::write(path, bytes).map_err(refuse)
    }
}

impl Drop for LoadedFolder {
    fn drop(&mut self) {
        // A folder that cannot be removed is left to the system.
        let _ = std::fs::remove_dir_all(&self.path);
    }
}

/// Creates an empty folder that only this user can read, and returns its canonical path.
fn create_folder() -> std::io::Result<PathBuf> {
    static NEXT: AtomicUsize = AtomicUsize::new(0);
    loop {
        let number = NEXT.fetch_add(1, Ordering::Relaxed);
        let path = std::env::temp_dir().join(format!("burgeon-{}-{number}", std::process::id()));
        match folder_builder().create(&path) {
            Err(error) if error.kind() == std::io::ErrorKind::AlreadyExists => {}
            Err(error) => return Err(error),
            Ok(()) => return path.canonicalize(),
        }
    }
}

#[cfg(unix)]
fn folder_builder() -> std::fs::DirBuilder {
    use std::os::unix::fs::DirBuilderExt;
    let mut builder = std::fs::DirBuilder::new();
    builder.mode(0o700);
    builder
}

#[cfg(not(unix))]
fn folder_builder() -> std::fs::DirBuilder {
    std::fs::DirBuilder::new()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_file_is_loaded_once_and_the_folder_goes_with_the_run() {
        let calls = Arc::new(Mutex::new(Vec::new()));
        let seen = Arc::clone(&calls);
        let loader = FileLoader::new(move |name| {
            seen.lock().unwrap().push(name.to_owned());
            Ok((name == "a/b \"🌳\".lua").then(|| b"text".to_vec()))
        });
        let folder = LoadedFolder::new(&loader).unwrap();
        let path = folder.path_of("a/b \"🌳\".lua").unwrap();
        for _ in 0..2 {
            folder.provide(&path).unwrap();
            folder.provide(&folder.path.join("missing")).unwrap();
            folder.provide(Path::new("/elsewhere")).unwrap();
        }
        assert_eq!(std::fs::read(&path).unwrap(), b"text");
        assert_eq!(*calls.lock().unwrap(), ["a/b \"🌳\".lua", "missing"]);
        drop(folder);
        assert!(!path.exists());
    }

    #[test]
    fn files_that_a_loader_lists_are_in_the_folder_before_the_run() {
        let loader =
            FileLoader::new(|name| Ok((!name.starts_with("gone")).then(|| name.as_bytes().to_vec())));
        let loader = loader.with_names(["a/x.csv", "a/y.csv", "gone.csv"].map(str::to_owned));
        let folder = LoadedFolder::new(&loader).unwrap();
        let listed = std::fs::read_dir(folder.path.join("a")).unwrap();
        assert_eq!(listed.count(), 2);
        assert!(!folder.path.join("gone.csv").exists());
        folder.provide(&folder.path.join("z.csv")).unwrap();
        assert_eq!(std::fs::read(folder.path.join("z.csv")).unwrap(), b"z.csv");
        let outside = loader.with_names(["../b.csv".to_owned()]);
        assert!(LoadedFolder::new(&outside).is_err());
    }

    #[test]
    fn names_that_lead_out_of_the_folder_are_refused() {
        for name in ["", "/etc/passwd", "../a.lua", "a/../../b.lua"] {
            let files = BTreeMap::from([(name.to_owned(), Vec::new())]);
            assert!(LoadedFolder::new(&FileLoader::of_files(files)).is_err(), "{name}");
        }
    }
}
