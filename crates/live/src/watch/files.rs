//! Content of watched files, and detection of changes.

use std::collections::BTreeMap;
use std::fs::{self, Metadata};
use std::io::Read;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant, SystemTime};

use super::database;
use burgeon_base::files::{identity, read_unlocked};

/// Size (bytes) beyond which files are compared by size and time only.
const LARGE: u64 = 64 << 20;

/// Maximum number of names in a folder that are compared.
const MOST_NAMES: usize = 20_000;

/// Maximum delay of file times relative to the clock: they are taken from the system's last tick, which is late on a
/// busy machine. An unnecessary report costs a run, whereas a missed change shows the wrong model.
const GRAIN: Duration = Duration::from_millis(100);

/// Watched files with their last known content.
#[derive(Default)]
pub(super) struct WatchedFiles {
    known: BTreeMap<PathBuf, FileState>,
    /// Every path whose change may matter: the files, and the links that lead to them.
    spellings: Vec<PathBuf>,
    /// Watched folders, in which added or removed names matter.
    folders: Vec<PathBuf>,
}

#[derive(Debug, Clone, PartialEq)]
struct FileState {
    content: FileContent,
    stamp: Option<FileStamp>,
}

#[derive(Debug, Clone)]
enum FileContent {
    /// File that has not been looked at yet, so that every look finds a change.
    Unknown,
    /// Missing or unreadable file.
    Missing,
    /// Pipe, device or similar.
    NoFile,
    /// Folder: its path with links resolved, and the hash of the names in it except those that begin with a dot.
    Folder { place: PathBuf, names: blake3::Hash },
    /// Regular file: its path with links resolved, and the hash of its content.
    File { place: PathBuf, hash: blake3::Hash, empty: bool },
    /// Database: its path with links resolved, and the hash of its committed content.
    Database { place: PathBuf, hash: blake3::Hash },
    /// Regular file that is too large to be read repeatedly.
    Large { place: PathBuf, stamp: FileStamp },
}

/// File metadata that shows most changes without reading the file.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct FileStamp {
    length: u64,
    modified: Option<SystemTime>,
    file: u64,
    /// Length (bytes) and time of the log next to a database.
    log: Option<(u64, Option<SystemTime>)>,
}

impl PartialEq for FileContent {
    fn eq(&self, other: &Self) -> bool {
        match (self, other) {
            (Self::Unknown, Self::Unknown)
            | (Self::Missing, Self::Missing)
            | (Self::NoFile, Self::NoFile) => true,
            (
                Self::File { place, hash, empty: _ } | Self::Database { place, hash },
                Self::File { place: other, hash: content, empty: _ }
                | Self::Database { place: other, hash: content },
            ) => (place, hash) == (other, content),
            (Self::Folder { place, names }, Self::Folder { place: other, names: now }) => {
                (place, names) == (other, now)
            }
            (Self::Large { place, stamp }, Self::Large { place: other, stamp: now }) => {
                // A change of the file without a change of the log is a checkpoint.
                let same = stamp.log.is_some_and(|(length, _)| length > 0) && stamp.log == now.log;
                place == other && (same && stamp.file == now.file || stamp == now)
            }
            _ => false,
        }
    }
}

impl FileStamp {
    /// Returns true if the file may have been written again since, within the resolution of file times.
    fn is_new(&self) -> bool {
        self.last_write().is_some_and(|modified| modified + GRAIN > SystemTime::now())
    }

    /// Returns the time of the last write to the file or to the log next to it.
    fn last_write(&self) -> Option<SystemTime> {
        self.modified.max(self.log.and_then(|(_, modified)| modified))
    }
}

/// File whose content has changed.
pub(super) struct FileChange {
    path: PathBuf,
    now: FileState,
    /// Set if the file had content before.
    was_there: bool,
}

impl FileChange {
    /// Returns the path of the file.
    pub(super) fn path(&self) -> &Path {
        &self.path
    }

    /// Returns true if the file is a database, of which only commits matter.
    pub(super) fn is_database(&self) -> bool {
        matches!(self.now.content, FileContent::Database { .. })
    }

    /// Returns true if the file has become missing or empty, as during a save.
    pub(super) fn looks_unfinished(&self) -> bool {
        let nothing = matches!(
            self.now.content,
            FileContent::Missing
                | FileContent::File { empty: true, .. }
                | FileContent::NoFile
                | FileContent::Folder { .. }
        );
        self.was_there && nothing
    }
}

impl FileState {
    /// Returns the path of a regular file or a folder with links resolved.
    fn place(&self) -> Option<&PathBuf> {
        match &self.content {
            FileContent::File { place, .. }
            | FileContent::Database { place, .. }
            | FileContent::Large { place, .. }
            | FileContent::Folder { place, .. } => Some(place),
            _ => None,
        }
    }

    /// Returns true if the file has probably changed since the time `since`, when it existed if `there` is set.
    fn is_newer(&self, since: SystemTime, there: bool) -> bool {
        let modified = self.stamp.and_then(|stamp| stamp.last_write());
        let written = self.place().is_some() && modified.is_some_and(|modified| modified + GRAIN > since);
        written || there == (self.content == FileContent::Missing)
    }
}

impl WatchedFiles {
    /// Watches `files` instead of the previous ones. Returns true if a new one has changed since the time `since`, when
    /// it existed if its flag is set.
    pub(super) fn follow(&mut self, files: Vec<(PathBuf, bool)>, since: Option<SystemTime>) -> bool {
        let mut late = false;
        let mut known = BTreeMap::new();
        // The same file under another name is not new.
        let places: BTreeMap<PathBuf, FileState> =
            self.known.values().filter_map(|seen| Some((seen.place()?.clone(), seen.clone()))).collect();
        for (path, there) in files {
            if known.contains_key(&path) {
                continue;
            }
            let seen = match self.known.remove(&path) {
                Some(seen) => seen,
                None => {
                    let unknown = || FileState { content: FileContent::Unknown, stamp: None };
                    let mut seen = look(&path).unwrap_or_else(unknown);
                    if let Some(same) = seen.place().and_then(|place| places.get(place)) {
                        known.insert(path, same.clone());
                        continue;
                    }
                    if since.is_some_and(|since| seen.is_newer(since, there)) {
                        late = true;
                        seen = unknown();
                    }
                    seen
                }
            };
            known.insert(path, seen);
        }
        self.known = known;
        self.spell();
        late
    }

    /// Returns the files whose content has changed. With `by_stamp`, equal times and sizes are trusted, unless they are
    /// so recent that the next save may have the same ones.
    pub(super) fn changed(&self, by_stamp: bool) -> Vec<FileChange> {
        let mut found = Vec::new();
        for (path, seen) in &self.known {
            let settled =
                seen.content != FileContent::Unknown && !seen.stamp.is_some_and(|stamp| stamp.is_new());
            if by_stamp && settled && stamp_of(path) == seen.stamp {
                continue;
            }
            // A database in the middle of a transaction still has its previous content.
            let Some(now) = look(path) else { continue };
            if now.content != seen.content {
                let was_there = matches!(
                    seen.content,
                    FileContent::File { empty: false, .. }
                        | FileContent::Database { .. }
                        | FileContent::Large { .. }
                        | FileContent::Unknown
                );
                found.push(FileChange { path: path.clone(), now, was_there });
            }
        }
        found
    }

    /// Stores the found changes as known. Returns the paths.
    pub(super) fn accept(&mut self, found: Vec<FileChange>) -> Vec<PathBuf> {
        let paths = found.iter().map(|found| found.path.clone()).collect();
        for FileChange { path, now, .. } in found {
            self.known.insert(path, now);
        }
        self.spell();
        paths
    }

    /// Returns true if an event at `paths`, or at unknown paths if the list is empty, may have changed a file.
    pub(super) fn concerned_by(&self, paths: &[PathBuf]) -> bool {
        let is_in = |path: &PathBuf| self.folders.iter().any(|folder| path.parent() == Some(folder));
        paths.is_empty()
            || self.spellings.iter().any(|file| paths.iter().any(|path| file.starts_with(path)))
            || paths.iter().any(is_in)
    }

    /// Returns the watched folders, by every path that leads to them.
    pub(super) fn folders(&self) -> &[PathBuf] {
        &self.folders
    }

    /// Returns every path whose change may matter, each folder resolved and listed once.
    pub(super) fn spellings(&self) -> &[PathBuf] {
        &self.spellings
    }

    fn spell(&mut self) {
        let mut spellings: Vec<PathBuf> = Vec::new();
        for (path, seen) in &self.known {
            let hops = hops(path);
            if !matches!(seen.content, FileContent::File { .. } | FileContent::NoFile) {
                let beside = |path: &PathBuf| database::SUFFIXES.map(|suffix| database::beside(path, suffix));
                spellings.extend(hops.iter().flat_map(beside));
            }
            spellings.extend(hops);
        }
        spellings.sort();
        spellings.dedup();
        self.spellings = spellings;
        let folders =
            self.known.iter().filter(|(_, seen)| matches!(seen.content, FileContent::Folder { .. }));
        self.folders = folders.flat_map(|(path, _)| hops(path)).filter(|path| path.is_dir()).collect();
        self.folders.sort();
        self.folders.dedup();
    }
}

/// Returns `path` and its link targets, link by link, each also with its folder resolved.
pub(super) fn hops(path: &Path) -> Vec<PathBuf> {
    let mut hops = Vec::new();
    let mut at = std::path::absolute(path).unwrap_or_else(|_| path.to_path_buf());
    // Links may be circular.
    for _ in 0..16 {
        if let (Some(Ok(folder)), Some(name)) = (at.parent().map(Path::canonicalize), at.file_name()) {
            hops.push(folder.join(name));
        }
        let next = fs::read_link(&at).ok().map(|target| at.parent().unwrap_or(&at).join(target));
        hops.push(at);
        match next {
            Some(next) => at = next,
            None => break,
        }
    }
    hops
}

/// Examines a file. Returns `None` if it is a database in the middle of a transaction.
fn look(path: &Path) -> Option<FileState> {
    let begin = Instant::now();
    loop {
        match try_look(path) {
            Ok(state) => return state,
            // Another thread of this process is reading the file, or its log was written in the meantime.
            Err(Again) if begin.elapsed() < GRAIN => std::thread::sleep(GRAIN / 20),
            Err(Again) => return None,
        }
    }
}

/// Marker error: the file could not be read in a consistent state.
struct Again;

fn try_look(path: &Path) -> Result<Option<FileState>, Again> {
    let Some(stamp) = stamp_of(path) else {
        return Ok(Some(FileState { content: FileContent::Missing, stamp: None }));
    };
    let state = |content| Ok(Some(FileState { content, stamp: Some(stamp) }));
    if path.is_dir() {
        return state(FileContent::Folder { place: place(path), names: names(path) });
    }
    if !path.is_file() {
        return state(FileContent::NoFile);
    }
    if stamp.length > LARGE {
        return match database::is_changing(path) {
            true => Ok(None),
            false => state(FileContent::Large { place: place(path), stamp }),
        };
    }
    let log_path = database::beside(&place(path), "-wal");
    // Read the log first: changes that a checkpoint transfers in the meantime are then also in the file.
    let log = fs::read(&log_path).unwrap_or_default();
    let mut bytes = Vec::new();
    match read_unlocked(path, |mut file, _| file.read_to_end(&mut bytes)) {
        Ok(Some(_)) => {}
        Ok(None) => return Err(Again),
        Err(_) => return state(FileContent::Missing),
    }
    let place = place(path);
    if !database::is_one(&bytes) {
        return state(FileContent::File { place, hash: blake3::hash(&bytes), empty: bytes.is_empty() });
    }
    if database::is_changing(&place) {
        return Ok(None);
    }
    if stamp_of(path) != Some(stamp) {
        return Err(Again);
    }
    state(FileContent::Database { hash: database::content(&bytes, &log), place })
}

/// Computes the hash of the names in a folder, limited to the first [`MOST_NAMES`] names.
fn names(folder: &Path) -> blake3::Hash {
    let entries = fs::read_dir(folder).into_iter().flatten().take(MOST_NAMES).flatten();
    let mut names: Vec<_> = entries
        .map(|entry| entry.file_name().into_encoded_bytes())
        .filter(|name| !name.starts_with(b"."))
        .collect();
    names.sort();
    let mut hasher = blake3::Hasher::new();
    for name in names {
        hasher.update(&name).update(b"/");
    }
    hasher.finalize()
}

/// Resolves the links of `path`. A changed target counts as a change, because the neighbours of the file change too.
fn place(path: &Path) -> PathBuf {
    path.canonicalize().unwrap_or_else(|_| path.to_path_buf())
}

pub(super) fn stamp_of(path: &Path) -> Option<FileStamp> {
    let metadata = fs::metadata(path).ok()?;
    let log = fs::metadata(database::beside(&place(path), "-wal")).ok();
    Some(FileStamp { log: log.map(|log| (log.len(), log.modified().ok())), ..stamp(&metadata) })
}

fn stamp(metadata: &Metadata) -> FileStamp {
    FileStamp {
        length: metadata.len(),
        modified: metadata.modified().ok(),
        file: identity(metadata),
        log: None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn changed(files: &mut WatchedFiles) -> usize {
        let found = files.changed(false);
        files.accept(found).len()
    }

    #[test]
    fn only_another_content_is_a_change() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.lua");
        fs::write(&path, "one").unwrap();
        let mut files = WatchedFiles::default();
        files.follow(vec![(path.clone(), true)], None);
        fs::write(&path, "one").unwrap();
        assert_eq!(changed(&mut files), 0);
        fs::write(&path, "two").unwrap();
        assert_eq!(changed(&mut files), 1);
        fs::remove_file(&path).unwrap();
        assert_eq!(changed(&mut files), 1);
        assert_eq!(changed(&mut files), 0);
        fs::create_dir(&path).unwrap();
        assert_eq!(changed(&mut files), 1);
    }

    #[test]
    fn a_file_that_vanishes_or_becomes_empty_looks_unfinished_and_a_new_one_does_not() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.lua");
        let mut files = WatchedFiles::default();
        files.follow(vec![(path.clone(), true)], None);
        let mut unfinished = || {
            let found = files.changed(false);
            let answer = found.iter().any(FileChange::looks_unfinished);
            files.accept(found);
            answer
        };
        fs::write(&path, "").unwrap();
        assert!(!unfinished());
        fs::write(&path, "one").unwrap();
        assert!(!unfinished());
        fs::write(&path, "").unwrap();
        assert!(unfinished());
        fs::write(&path, "one").unwrap();
        assert!(!unfinished());
        fs::remove_file(&path).unwrap();
        assert!(unfinished());
    }

    #[test]
    fn a_file_that_is_new_to_the_list_counts_as_changed_if_it_was_written_since_it_was_read() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.lua");
        let before = SystemTime::now();
        fs::write(&path, "one").unwrap();
        let mut files = WatchedFiles::default();
        assert!(files.follow(vec![(path.clone(), true)], Some(before)));
        assert_eq!((changed(&mut files), changed(&mut files)), (1, 0));
        let mut files = WatchedFiles::default();
        let later = Some(SystemTime::now() + Duration::from_secs(1));
        let none = folder.path().join("none");
        assert!(!files.follow(vec![(path.clone(), true), (none.clone(), false)], later));
        // Regardless of their times, a created and a deleted file have changed.
        assert!(WatchedFiles::default().follow(vec![(path, false)], later));
        assert!(WatchedFiles::default().follow(vec![(none, true)], later));
    }

    #[test]
    fn events_of_other_files_are_not_looked_into() {
        let folder = tempfile::tempdir().unwrap();
        let at = |name: &str| folder.path().join(name);
        fs::create_dir(at("sub")).unwrap();
        let mut files = WatchedFiles::default();
        files.follow(vec![(at("sub/a.lua"), true)], None);
        assert!(files.concerned_by(&[at("sub/a.lua")]) && files.concerned_by(&[at("sub")]));
        assert!(files.concerned_by(&[]));
        assert!(!files.concerned_by(&[at("sub/b.lua"), at("a.lua")]));
    }

    #[test]
    fn a_folder_changes_with_the_names_in_it_and_not_with_what_is_in_the_files() {
        let folder = tempfile::tempdir().unwrap();
        let at = |name: &str| folder.path().join(name);
        let mut files = WatchedFiles::default();
        files.follow(vec![(at("mods"), false)], None);
        fs::create_dir(at("mods")).unwrap();
        assert_eq!((changed(&mut files), changed(&mut files)), (1, 0));
        assert!(files.concerned_by(&[at("mods/castle")]) && !files.concerned_by(&[at("mods/castle/a.lua")]));
        fs::create_dir(at("mods/castle")).unwrap();
        assert_eq!((changed(&mut files), changed(&mut files)), (1, 0));
        fs::write(at("mods/castle/a.lua"), "one").unwrap();
        fs::write(at("mods/.hidden"), "one").unwrap();
        assert_eq!(changed(&mut files), 0);
        fs::rename(at("mods/castle"), at("mods/gate")).unwrap();
        assert_eq!(changed(&mut files), 1);
        fs::remove_dir_all(at("mods")).unwrap();
        assert_eq!((changed(&mut files), changed(&mut files)), (1, 0));
    }

    #[cfg(unix)]
    #[test]
    fn links_are_followed_and_one_that_leads_elsewhere_is_a_change() {
        let folder = tempfile::tempdir().unwrap();
        let at = |name: &str| folder.path().join(name);
        for name in ["one", "two"] {
            fs::create_dir(at(name)).unwrap();
            fs::write(at(name).join("a.lua"), "same").unwrap();
        }
        std::os::unix::fs::symlink("one/a.lua", at("link")).unwrap();
        std::os::unix::fs::symlink("link", at("chain")).unwrap();
        let mut files = WatchedFiles::default();
        files.follow(vec![(at("chain"), true)], None);
        assert!(files.concerned_by(&[at("one/a.lua")]) && files.concerned_by(&[at("link")]));
        fs::remove_file(at("link")).unwrap();
        std::os::unix::fs::symlink("two/a.lua", at("link")).unwrap();
        assert_eq!(changed(&mut files), 1);
        assert!(files.concerned_by(&[at("two/a.lua")]) && !files.concerned_by(&[at("one/a.lua")]));
        fs::remove_file(at("link")).unwrap();
        std::os::unix::fs::symlink("chain", at("link")).unwrap();
        assert_eq!(changed(&mut files), 1);
    }
}
