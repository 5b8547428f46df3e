//! Times and sizes of a database file and of the files next to it.

use std::fs;
use std::path::{Path, PathBuf};
use std::time::{Duration, SystemTime};

use burgeon_base::error::Error;
use burgeon_base::files;

/// Maximum size of a file that is copied (bytes).
pub(super) const COPIED: u64 = 64 << 20;

/// Minimum age of a modification time that distinguishes one write from the next.
const SETTLED: Duration = Duration::from_millis(50);

/// Time, size and identity of a file.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct PackageStamp {
    pub(super) length: u64,
    modified: Option<SystemTime>,
    identity: u64,
}

/// Reason why an attempt returned no state.
pub(super) enum StateFailure {
    /// Another program is writing.
    Busy,
    /// Error that waiting does not resolve.
    Final(Error),
}

impl From<Error> for StateFailure {
    fn from(error: Error) -> Self {
        Self::Final(error)
    }
}

impl PackageStamp {
    /// Returns the stamp of the file at `path`, if it exists.
    pub(super) fn of(path: &Path) -> Option<Self> {
        let meta = fs::metadata(path).ok()?;
        Some(Self { length: meta.len(), modified: meta.modified().ok(), identity: files::identity(&meta) })
    }

    /// Reports whether a write from now on gets a different time.
    pub(super) fn is_settled(&self) -> bool {
        // A time in the future comes from another clock.
        self.modified.and_then(|modified| modified.elapsed().ok()).is_none_or(|age| age > SETTLED)
    }
}

/// Returns the path of the companion file of `path` with `suffix` appended to the name.
pub(super) fn companion_path(path: &Path, suffix: &str) -> PathBuf {
    let mut name = path.as_os_str().to_owned();
    name.push(suffix);
    name.into()
}
