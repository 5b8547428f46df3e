//! Files with temporary names. They are removed when they are dropped, and when the program is told to exit.

use burgeon_base::locks::LockRecovery;

use std::collections::BTreeSet;
use std::ffi::OsString;
use std::fs::{self, File};
use std::io::{self, ErrorKind};
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Mutex, MutexGuard};

/// Temporary names of this process.
static NAMES: Mutex<BTreeSet<PathBuf>> = Mutex::new(BTreeSet::new());

/// File under a temporary name, or a folder for such files.
pub(super) struct Temporary {
    path: PathBuf,
}

/// Lock on all temporary names of this process. While it exists, no other thread adds, renames or removes one.
pub(super) struct TemporaryNames(MutexGuard<'static, BTreeSet<PathBuf>>);

impl TemporaryNames {
    pub(super) fn lock() -> Self {
        Self(NAMES.lock().recover())
    }
}

/// Removes all files that have a temporary name, and prevents new ones. To be called by a program that is about to
/// exit.
pub fn abandon() {
    let names = TemporaryNames::lock();
    // A folder sorts before its content, so remove in reverse order.
    for path in names.0.iter().rev() {
        remove(path);
    }
    // Other writers block here until the process exits.
    std::mem::forget(names);
}

impl Temporary {
    /// Creates an empty file next to `target`.
    pub(super) fn create_beside(target: &Path) -> io::Result<(Self, File)> {
        let mut names = TemporaryNames::lock();
        loop {
            let path = name_beside(target);
            match File::create_new(&path) {
                // A file that a killed process with the same process id has left behind.
                Err(error) if error.kind() == ErrorKind::AlreadyExists => {}
                other => {
                    let file = other?;
                    names.0.insert(path.clone());
                    return Ok((Self { path }, file));
                }
            }
        }
    }

    /// Creates a second hard link to the file at `target`, or a copy if `copied` or if the file system does not support
    /// hard links. Returns `None` if there is no such file.
    pub(super) fn of(target: &Path, copied: bool, names: &mut TemporaryNames) -> io::Result<Option<Self>> {
        if !target.is_file() {
            return Ok(None);
        }
        let mut path = name_beside(target);
        let copy = |path: &Path| fs::copy(target, path).map(|_| ()).inspect_err(|_| remove(path));
        if copied && copy(&path).is_err() {
            // The folder may not be writable.
            path = name_beside(&std::env::temp_dir().join(target.file_name().unwrap_or_default()));
            copy(&path)?;
        } else if !copied && fs::hard_link(target, &path).is_err() {
            copy(&path)?;
        }
        names.0.insert(path.clone());
        Ok(Some(Self { path }))
    }

    /// Creates an empty folder at `path`, which is removed unless it is kept.
    pub(super) fn folder(path: &Path) -> io::Result<Self> {
        let mut names = TemporaryNames::lock();
        fs::create_dir(path)?;
        names.0.insert(path.to_path_buf());
        Ok(Self { path: path.to_path_buf() })
    }

    /// Keeps the file or folder under its name.
    pub(super) fn keep(&self, names: &mut TemporaryNames) {
        names.0.remove(&self.path);
    }

    /// Returns the path.
    pub(super) fn path(&self) -> &Path {
        &self.path
    }

    /// Renames the file to `target`, replacing an existing file.
    pub(super) fn rename(&self, target: &Path, names: &mut TemporaryNames) -> io::Result<()> {
        fs::rename(&self.path, target)?;
        names.0.remove(&self.path);
        Ok(())
    }
}

impl Drop for Temporary {
    fn drop(&mut self) {
        // A renamed or kept file no longer has a temporary name.
        if TemporaryNames::lock().0.remove(&self.path) {
            remove(&self.path);
        }
    }
}

/// Removes a temporary file or an empty folder. An error is ignored, because the file can only be left behind.
pub(super) fn remove(path: &Path) {
    if fs::remove_file(path).is_err() {
        let _ = fs::remove_dir(path);
    }
}

/// Returns a name next to `target` that this process has not used yet.
fn name_beside(target: &Path) -> PathBuf {
    static NEXT: AtomicU64 = AtomicU64::new(0);
    let mut name = OsString::from(".");
    name.push(target.file_name().unwrap_or_default());
    name.push(format!(".{}-{}.part", std::process::id(), NEXT.fetch_add(1, Ordering::Relaxed)));
    target.with_file_name(name)
}
