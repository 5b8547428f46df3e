//! Folders that must be watched to observe every change of some files.

use std::collections::{BTreeMap, BTreeSet};
use std::fs::{self, Metadata};
use std::path::{Path, PathBuf};

use notify::event::{AccessKind, AccessMode, ModifyKind, RenameMode};
use notify::{Event, EventKind, RecursiveMode, Watcher};

use super::files::WatchedFiles;
use burgeon_base::files::identity;

/// Meaning of an event for a file.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Sign {
    /// Write to the file, which may continue.
    Write,
    /// End of a write: the file is closed or renamed to its final name.
    End,
    /// Any other event.
    Other,
}

/// Handler of a watcher's events.
pub(super) type Handler = Box<dyn FnMut(notify::Result<Event>) + Send>;

/// Watcher of any type.
pub(super) type AnyWatcher = Box<dyn Watcher + Send>;

/// Creates the watcher that suits the system best.
pub(super) fn recommended(handler: Handler) -> notify::Result<AnyWatcher> {
    Ok(Box::new(notify::recommended_watcher(handler)?))
}

/// Watches the folders of files, and their parents, in which a deleted folder may be created again.
pub(super) struct Folders {
    watcher: Result<AnyWatcher, String>,
    /// Watched folders with their identities. A new folder of the same name is not watched yet.
    watched: BTreeMap<PathBuf, u64>,
    failure: Option<String>,
}

impl Folders {
    /// Creates the watcher with `make`; no folder is watched yet. `seen` is called with the paths of each event, or no
    /// paths if any file may be affected, and the meaning of the event.
    pub(super) fn new(
        make: impl FnOnce(Handler) -> notify::Result<AnyWatcher>,
        seen: impl Fn(Vec<PathBuf>, Sign) + Send + 'static,
    ) -> Self {
        let handle = move |event: notify::Result<Event>| match event {
            Ok(event) if event.need_rescan() => seen(Vec::new(), Sign::Other),
            Ok(event) if matters(event.kind) && !event.paths.is_empty() => {
                let sign = sign(event.kind);
                seen(event.paths, sign);
            }
            Ok(_) => {}
            // Events were lost.
            Err(_) => seen(Vec::new(), Sign::Other),
        };
        let watcher = make(Box::new(handle)).map_err(|error| error.to_string());
        Self { watcher, watched: BTreeMap::new(), failure: None }
    }

    /// Returns the reason that changes may be missed, if any.
    pub(super) fn failure(&self) -> Option<&str> {
        self.failure.as_ref().or(self.watcher.as_ref().err()).map(String::as_str)
    }

    /// Watches exactly the folders that `files` require.
    pub(super) fn cover(&mut self, files: &WatchedFiles) {
        let Ok(watcher) = &mut self.watcher else { return };
        let mut wanted: BTreeSet<PathBuf> = files.spellings().iter().flat_map(|path| around(path)).collect();
        wanted.extend(files.folders().iter().cloned());
        self.watched.retain(|folder, known| {
            let keep = wanted.contains(folder) && identity_of(folder) == Some(*known);
            if !keep {
                // The system stops watching a folder that is deleted, so an error is ignored.
                let _ = watcher.unwatch(folder);
            }
            keep
        });
        let mut failure = None;
        for folder in wanted {
            if self.watched.contains_key(&folder) {
                continue;
            }
            let Some(identity) = identity_of(&folder) else { continue };
            match watcher.watch(&folder, RecursiveMode::NonRecursive) {
                Ok(()) => {
                    self.watched.insert(folder, identity);
                }
                // The folder has been deleted in the meantime.
                Err(_) if identity_of(&folder).is_none() => {}
                Err(error) => failure = Some(error.to_string()),
            }
        }
        self.failure = failure;
    }
}

/// Returns true if an event of this type can change a file; a read access cannot.
fn matters(kind: EventKind) -> bool {
    match kind {
        EventKind::Access(kind) => kind == AccessKind::Close(AccessMode::Write),
        _ => true,
    }
}

fn sign(kind: EventKind) -> Sign {
    match kind {
        EventKind::Access(AccessKind::Close(AccessMode::Write))
        | EventKind::Modify(ModifyKind::Name(RenameMode::To | RenameMode::Both)) => Sign::End,
        EventKind::Modify(ModifyKind::Data(_)) => Sign::Write,
        _ => Sign::Other,
    }
}

/// Returns the folder of the file at `path` and its parent, or the nearest existing folder.
fn around(path: &Path) -> Vec<PathBuf> {
    let above = path.ancestors().skip(1).filter(|folder| folder.is_dir());
    let mut folders: Vec<PathBuf> = above.take(2).map(Path::to_path_buf).collect();
    if path.parent() != folders.first().map(PathBuf::as_path) {
        folders.truncate(1);
    }
    folders
}

fn identity_of(folder: &Path) -> Option<u64> {
    fs::metadata(folder).ok().filter(Metadata::is_dir).map(|metadata| identity(&metadata))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_file_needs_its_folder_and_the_one_above_or_the_nearest_that_is_there() {
        let folder = tempfile::tempdir().unwrap();
        let at = |name: &str| folder.path().join(name);
        fs::create_dir(at("sub")).unwrap();
        assert_eq!(around(&at("sub/a.lua")), [at("sub"), folder.path().to_path_buf()]);
        assert_eq!(around(&at("no/such/a.lua")), [folder.path()]);
    }
}
