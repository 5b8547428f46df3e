//! Scripts and assets that a host program has in memory, in the place of the script's folder or in front of it.

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
/// Names are relative to the folder that the loader replaces, with `/` between folders. It replaces the folder of the script,
/// or is searched before a folder on disk: [`before`](Self::before). Absolute names and names with `..` are refused.
///
/// - **One file at a time**, when the script names it: scripts, `require`, the drawn curves beside the script, data sources,
///   terrains and other rasters, models, textures, normal maps, images, fonts, and files of a model that a
///   script loads (`.mtl`, `.bin`, images).
/// - **Only listed files** ([`of_files`](Self::of_files), [`with_names`](Self::with_names)), because they are found without
///   a question for their names: companion files of data (`.dbf`, `.prj`, `-wal`), folders, patterns such as `*.hgt`, and
///   packages in `mods`. In front of a folder, packages and patterns are read from the folder alone.
/// - **Never**: the folders and files of [`RunInputs`](super::RunInputs) (`data`, `mods`, `user_mods`, `stdlib`), and databases.
#[derive(Clone)]
pub struct FileLoader {
    load: Arc<Load>,
    /// Files that a run loads before it begins.
    names: Arc<[String]>,
    /// Folder in which files are searched that the loader does not have.
    folder: Option<PathBuf>,
}

impl FileLoader {
    /// Creates a loader that calls `load` with the name of each file that a script looks for, at most once in a run and from
    /// any thread. `load` returns `None` if there is no such file.
    ///
    /// Names of folders, patterns of names, packages and the files that models refer to need
    /// [`of_files`](Self::of_files) or [`with_names`](Self::with_names), because such a loader cannot list its files.
    pub fn new(load: impl Fn(&str) -> Result<Option<Vec<u8>>> + Send + Sync + 'static) -> Self {
        Self { load: Arc::new(load), names: Arc::default(), folder: None }
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

    /// Searches `folder` for the files that the loader does not have. Without a folder, there are no other files.
    ///
    /// ```
    /// use burgeon_engine::script::FileLoader;
    ///
    /// // A script without a file, which requires the files of the working folder.
    /// let files = [("-".to_owned(), b"return require('tree')".to_vec())];
    /// let loader = FileLoader::of_files(files.into()).before(".");
    /// # assert_eq!(loader.names(), ["-"]);
    /// ```
    #[must_use]
    pub fn before(self, folder: impl Into<PathBuf>) -> Self {
        Self { folder: Some(folder.into()), ..self }
    }

    /// Creates a loader of these files, by their names.
    pub fn of_files(files: BTreeMap<String, Vec<u8>>) -> Self {
        let names = files.keys().cloned().collect();
        Self { load: Arc::new(move |name| Ok(files.get(name).cloned())), names, folder: None }
    }
}

impl fmt::Debug for FileLoader {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("FileLoader")
    }
}

/// Temporary folder with the files that a run has loaded, because readers of data need files. It is removed with the run.
pub(super) struct LoadedFolder {
    /// Canonical path of the temporary folder.
    path: PathBuf,
    /// Folder that the files seem to be in: the temporary folder, or the one that is searched after the loader.
    root: PathBuf,
    loader: FileLoader,
    requested: Mutex<BTreeSet<PathBuf>>,
}

impl LoadedFolder {
    /// Creates the folder, and loads the files whose names are known.
    pub(super) fn new(loader: &FileLoader) -> Result<Self> {
        let path = create_folder()
            .map_err(|error| Error::system(format!("cannot create a temporary folder: {error}")))?;
        let mut folder =
            Self { root: path.clone(), path, loader: loader.clone(), requested: Mutex::default() };
        if let Some(behind) = &loader.folder {
            folder.root = behind.canonicalize().map_err(|error| {
                Error::file(behind, format!("cannot read the folder {}: {error}", behind.display()))
                    .help("give the loader a folder that exists")
            })?;
        }
        for name in &*folder.loader.names {
            folder.load(Path::new(name), &folder.copy_of(name)?)?;
        }
        Ok(folder)
    }

    /// Returns the folder that the files seem to be in.
    pub(super) fn root(&self) -> &Path {
        &self.root
    }

    /// Returns the path that the file `name` seems to have. Fails if the name is not relative, or leads out of the folder.
    pub(super) fn path_of(&self, name: &str) -> Result<PathBuf> {
        self.copy_of(name).map(|_| self.root.join(name))
    }

    fn copy_of(&self, name: &str) -> Result<PathBuf> {
        let is_inside = Path::new(name).components().all(|part| matches!(part, Component::Normal(_)));
        if name.is_empty() || !is_inside {
            return Err(Error::file(name, format!("{name:?} is not a name of a file in memory")).help(
                "use a name such as tree.lua or textures/bark.png, without .. and without / at the beginning",
            ));
        }
        Ok(self.path.join(name))
    }

    /// Returns the path of a copy of the file that seems to be at `path`, or of a listed folder; `None` if the loader does not
    /// have it. Calls the loader if the file has not been requested before.
    pub(super) fn find(&self, path: &Path) -> Result<Option<PathBuf>> {
        let Some(inner) = path.strip_prefix(&self.root).ok().and_then(without_steps_up) else {
            return Ok(None);
        };
        let copy = self.path.join(&inner);
        self.load(&inner, &copy)?;
        // A folder of which a file has been loaded is not the whole folder.
        let is_there = copy.is_file() || copy.is_dir() && !(self.root != self.path && path.is_dir());
        Ok(is_there.then_some(copy))
    }

    /// Returns the path that the file of a copy seems to have; `None` if `path` is not that of a copy.
    pub(super) fn origin(&self, path: &Path) -> Option<PathBuf> {
        self.inner_copy(path).map(|inner| self.root.join(inner))
    }

    /// Returns the path of a copy from the temporary folder; `None` for other files.
    pub(super) fn inner_copy<'a>(&self, path: &'a Path) -> Option<&'a Path> {
        path.strip_prefix(&self.path).ok()
    }

    /// Copies the file `inner` of the loader to `copy`, if it has not been requested before.
    fn load(&self, inner: &Path, copy: &Path) -> Result<()> {
        let parts: Option<Vec<&str>> = inner.iter().map(|part| part.to_str()).collect();
        let Some(name) = parts.filter(|parts| !parts.is_empty()).map(|parts| parts.join("/")) else {
            return Ok(());
        };
        let mut requested = self.requested.lock().recover();
        if !requested.insert(inner.to_path_buf()) || copy.exists() {
            return Ok(());
        }
        let Some(bytes) = (self.loader.load)(&name)? else { return Ok(()) };
        MemoryOwner::ensure_room(bytes.len())?;
        let refuse = |error: std::io::Error| {
            Error::file(&name, format!("cannot store {name} in a temporary folder: {error}"))
                .help("free some space in it, or set TMPDIR to another folder")
        };
        copy.parent().map_or(Ok(()), std::fs::create_dir_all).map_err(refuse)?;
        std::fs::write(copy, bytes).map_err(refuse)
    }
}

impl Drop for LoadedFolder {
    fn drop(&mut self) {
        // A folder that cannot be removed is left to the system.
        let _ = std::fs::remove_dir_all(&self.path);
    }
}

/// Returns a relative path without `.` and `..`; `None` if it leads out of the folder that it begins in.
fn without_steps_up(path: &Path) -> Option<PathBuf> {
    let mut inner = PathBuf::new();
    for part in path.components() {
        match part {
            Component::Normal(name) => inner.push(name),
            Component::CurDir => {}
            Component::ParentDir if inner.pop() => {}
            _ => return None,
        }
    }
    Some(inner)
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
            assert_eq!(folder.find(&path).unwrap().as_ref(), Some(&path));
            assert_eq!(folder.find(&folder.path.join("missing")).unwrap(), None);
            assert_eq!(folder.find(Path::new("/elsewhere")).unwrap(), None);
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
        assert!(folder.find(&folder.path.join("z.csv")).unwrap().is_some());
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

    #[test]
    fn a_loader_before_a_folder_hides_files_of_the_same_name_and_no_others() {
        let disk = tempfile::tempdir().unwrap();
        std::fs::create_dir(disk.path().join("a")).unwrap();
        for name in ["x.lua", "y.lua", "a/z.csv"] {
            std::fs::write(disk.path().join(name), "disk").unwrap();
        }
        let files = ["-", "x.lua", "a/w.csv", "b/v.csv"].map(|name| (name.to_owned(), b"memory".to_vec()));
        let folder = LoadedFolder::new(&FileLoader::of_files(files.into()).before(disk.path())).unwrap();
        let root = folder.root().to_path_buf();
        assert_eq!(root, disk.path().canonicalize().unwrap());
        for name in ["-", "x.lua", "a/w.csv", "b"] {
            let copy = folder.find(&root.join(name)).unwrap().unwrap();
            assert!(folder.origin(&copy) == Some(root.join(name)), "{name}");
        }
        for name in ["y.lua", "a/z.csv", "a", "none"] {
            assert_eq!(folder.find(&root.join(name)).unwrap(), None, "{name}");
        }
        assert!(folder.find(&root.join("b/../a/./w.csv")).unwrap().is_some());
        let beside = folder.path.with_extension("beside");
        std::fs::write(&beside, "secret").unwrap();
        let up = root.join("a/../..").join(beside.file_name().unwrap());
        assert_eq!(folder.find(&up).unwrap(), None, "a file beside the copies");
        std::fs::remove_file(&beside).unwrap();
        assert_eq!(folder.path_of("y.lua").unwrap(), root.join("y.lua"));
        assert!(folder.path_of("../y.lua").is_err());
        let missing = FileLoader::of_files(BTreeMap::new()).before(disk.path().join("none"));
        assert!(LoadedFolder::new(&missing).is_err());
    }
}
