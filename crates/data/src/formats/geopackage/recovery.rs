//! Private copy of a database that a program left in the middle of a change, in which SQLite recovers it.

use std::fs;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicUsize, Ordering};

use rusqlite::{Connection, OpenFlags};

use super::connection::begin;
use super::stamp::{COPIED, PackageStamp, StateFailure, companion_path};
use burgeon_base::error::{Error, Result};
use burgeon_base::files;

/// Number of the next folder of this process.
static FOLDERS: AtomicUsize = AtomicUsize::new(0);

/// Folder that is removed when the value is dropped.
pub(super) struct PrivateCopy(PathBuf);

impl PrivateCopy {
    /// Copies the database at `path` and its companion file with `suffix` appended to the name. Fails with `Busy` while
    /// another program writes either of them.
    pub(super) fn of(path: &Path, suffix: &str, shown: &str) -> std::result::Result<Self, StateFailure> {
        let log = companion_path(path, suffix);
        let stamps = || [PackageStamp::of(path), PackageStamp::of(&log)];
        let before = stamps();
        if before.iter().any(|stamp| stamp.is_none_or(|stamp| !stamp.is_settled())) {
            return Err(StateFailure::Busy);
        }
        if before.iter().flatten().any(|stamp| stamp.length > 4 * COPIED) {
            return Err(Error::unavailable(format!(
                "the log next to {shown} is too large to recover it in a copy"
            ))
            .help("open the file once in the program that wrote it, and run again")
            .into());
        }
        let copy = Self::new()?;
        let cannot = |error: std::io::Error| {
            StateFailure::Final(Error::system(format!("cannot recover {shown} in a private copy: {error}")).help(
                "free space in the folder for temporary files, or open the file once in the program that wrote it",
            ))
        };
        let write = |from: &Path, to: &Path| {
            files::read_unlocked(from, |mut file, _| std::io::copy(&mut file, &mut fs::File::create(to)?))
        };
        let target = copy.path();
        let copied = [write(path, &target), write(&log, &companion_path(&target, suffix))];
        for copied in copied {
            match copied {
                Ok(Some(_)) => {}
                Ok(None) => return Err(StateFailure::Busy),
                Err(error) if error.kind() == std::io::ErrorKind::NotFound => return Err(StateFailure::Busy),
                Err(error) => return Err(cannot(error)),
            }
        }
        if stamps() != before { Err(StateFailure::Busy) } else { Ok(copy) }
    }

    fn new() -> Result<Self> {
        let number = FOLDERS.fetch_add(1, Ordering::Relaxed);
        let folder = std::env::temp_dir().join(format!("burgeon-{}-{number}", std::process::id()));
        let mut builder = fs::DirBuilder::new();
        #[cfg(unix)]
        std::os::unix::fs::DirBuilderExt::mode(&mut builder, 0o700);
        builder.create(&folder).map_err(|error| {
            Error::system(format!("cannot make a folder for temporary files: {error}"))
                .help("free space in it, or specify another: TMPDIR=FOLDER")
        })?;
        Ok(Self(folder))
    }

    fn path(&self) -> PathBuf {
        self.0.join("copy.gpkg")
    }

    /// Opens the copy, which recovers it, and begins a transaction.
    pub(super) fn connect(&self) -> rusqlite::Result<Connection> {
        let flags = OpenFlags::SQLITE_OPEN_READ_WRITE | OpenFlags::SQLITE_OPEN_NO_MUTEX;
        let connection = Connection::open_with_flags(self.path(), flags)?;
        begin(&connection)?;
        Ok(connection)
    }
}

impl Drop for PrivateCopy {
    fn drop(&mut self) {
        // The system removes folders that cannot be removed here.
        let _ = fs::remove_dir_all(&self.0);
    }
}
