//! State of the files on which a run depends, as it was before they were read.

use std::path::{Path, PathBuf};
use std::time::UNIX_EPOCH;

use super::session::Session;
use burgeon_base::locks::LockRecovery;
use burgeon_packages::hash_file;

impl Session {
    /// Records the size and the time of a file that will be read, and of the journal of a database, once.
    pub(super) fn stamp(&self, path: &Path) {
        if self.options.inputs.derivations.is_some() {
            let mut stamps = self.stamps.lock().recover();
            let stamp = || if self.is_copy(path) { hash_of(path) } else { stamp_of(path) };
            stamps.entry(path.to_path_buf()).or_insert_with(stamp);
        }
    }

    /// Describes the files on which the run depends, as they were before they were read; `None` if one of them was not
    /// recorded.
    pub(crate) fn stamps(&self) -> Option<String> {
        let stamps = self.stamps.lock().recover();
        let mut text = String::new();
        for (path, exists) in self.sought() {
            let stamp = stamps.get(&path)?;
            // The folder of copies differs in each run.
            let name = self.inner_copy(&path).unwrap_or(&path);
            text += &format!("{name:?} {exists} {stamp}\n");
        }
        Some(text)
    }
}

/// Returns the hash of the copy of a file in memory, because its time differs in each run.
fn hash_of(path: &Path) -> String {
    hash_file(path).unwrap_or_default()
}

/// Returns the size and the time of a file and of the journal of a database.
fn stamp_of(path: &Path) -> String {
    let mut journal = path.as_os_str().to_owned();
    journal.push("-wal");
    let files = [path.to_path_buf(), PathBuf::from(journal)];
    let stamp = |file: &PathBuf| {
        let data = std::fs::metadata(file).ok()?;
        let changed = data.modified().ok()?.duration_since(UNIX_EPOCH).ok()?;
        Some(format!("{} {changed:?}", data.len()))
    };
    files.iter().map(|file| stamp(file).unwrap_or_default() + ";").collect()
}
