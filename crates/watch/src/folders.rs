//! The folders that are watched so that every change of some files is seen.

use std::collections::{BTreeMap, BTreeSet};
use std::fs::{self, Metadata};
use std::path::{Path, PathBuf};

use notify::event::{AccessKind, AccessMode, ModifyKind, RenameMode};
use notify::{Event, EventKind, RecursiveMode, Watcher};

use super::files::WatchedFiles;
use burgeon_base::files::identity;

/// What an event tells of a file.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Sign {
    /// Someone has written into it, and may write more.
    Write,
    /// It comes when a file has been written: it is closed, or gets its name.
    End,
    /// Anything else.
    Other,
}

/// Takes what a watcher tells.
pub(super) type Handler = Box<dyn FnMut(notify::Result<Event>) + Send>;

/// A watcher of some kind.
pub(super) type AnyWatcher = Box<dyn Watcher + Send>;

/// The watcher that suits the system best.
pub(super) fn recommended(handler: Handler) -> notify::Result<AnyWatcher> {
    Ok(Box::new(notify::recommended_watcher(handler)?))
}

/// Watches the folders of files, and the folders above, where a deleted folder appears again.
pub(super) struct Folders {
    watcher: Result<AnyWatcher, String>,
    /// The watched folders. Another one of the same name is not watched yet.
    watched: BTreeMap<PathBuf, u64>,
    failure: Option<String>,
}

impl Folders {
    /// Watches no folder yet, by what `make` makes. `seen` gets the paths that something has happened to, none if any may
    /// be meant, and what it was.
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
            // Something was lost.
            Err(_) => seen(Vec::new(), Sign::Other),
        };
        let watcher = make(Box::new(handle)).map_err(|error| error.to_string());
        let failure = watcher.as_ref().err().cloned();
        Self { watcher, watched: BTreeMap::new(), failure }
    }

    /// Why changes may go unseen, if so.
    pub(super) fn failure(&self) -> Option<&str> {
        self.failure.as_deref()
    }

    /// Watches what `files` need, and nothing else.
    pub(super) fn cover(&mut self, files: &WatchedFiles) {
        let Ok(watcher) = &mut self.watcher else { return };
        let mut wanted: BTreeSet<PathBuf> = files.spellings().iter().flat_map(|path| around(path)).collect();
        wanted.extend(files.folders().iter().cloned());
        self.watched.retain(|folder, known| {
            let keep = wanted.contains(folder) && identity_of(folder) == Some(*known);
            if !keep {
                // The system may have stopped watching it by itself, with the folder.
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
                // It has gone since.
                Err(_) if identity_of(&folder).is_none() => {}
                Err(error) => failure = Some(error.to_string()),
            }
        }
        self.failure = failure;
    }
}

/// Whether something of this kind can change a file; that it was read cannot.
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

/// The folder of the file at `path` and the one above it, or the nearest one that is there.
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
