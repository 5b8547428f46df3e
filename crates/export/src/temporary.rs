//! Files that have only a temporary name yet: they are gone once they are dropped, and when the program is told to end.

use burgeon_base::locks::LockRecovery;

use std::collections::BTreeSet;
use std::ffi::OsString;
use std::fs::{self, File};
use std::io::{self, ErrorKind};
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Mutex, MutexGuard};

/// The temporary names of this process.
static NAMES: Mutex<BTreeSet<PathBuf>> = Mutex::new(BTreeSet::new());

/// A file under a temporary name, or a folder for files that have only such names.
pub(super) struct Temporary {
    path: PathBuf,
}

/// All temporary names of this process: while this is there, nothing gets one, changes it or loses it.
pub(super) struct TemporaryNames(MutexGuard<'static, BTreeSet<PathBuf>>);

impl TemporaryNames {
    pub(super) fn lock() -> Self {
        Self(NAMES.lock().recover())
    }
}

/// Removes all files that have only a temporary name, and lets none appear any more: for a program that is about to end.
pub fn abandon() {
    let names = TemporaryNames::lock();
    // A folder comes before what is in it.
    for path in names.0.iter().rev() {
        remove(path);
    }
    // Whoever writes waits here for the end.
    std::mem::forget(names);
}

impl Temporary {
    /// An empty file beside `target`.
    pub(super) fn beside(target: &Path) -> io::Result<(Self, File)> {
        let mut names = TemporaryNames::lock();
        loop {
            let path = name_beside(target);
            match File::create_new(&path) {
                // A process that had our number was killed and left its file.
                Err(error) if error.kind() == ErrorKind::AlreadyExists => {}
                other => {
                    let file = other?;
                    names.0.insert(path.clone());
                    return Ok((Self { path }, file));
                }
            }
        }
    }

    /// A second name for the file at `target`, or a copy if it is to be written into or the disk knows no second
    /// names; `None` if there is no such file.
    pub(super) fn of(target: &Path, copied: bool, names: &mut TemporaryNames) -> io::Result<Option<Self>> {
        if !target.is_file() {
            return Ok(None);
        }
        let mut path = name_beside(target);
        let copy = |path: &Path| fs::copy(target, path).map(|_| ()).inspect_err(|_| remove(path));
        if copied && copy(&path).is_err() {
            // Its folder may take no files.
            path = name_beside(&std::env::temp_dir().join(target.file_name().unwrap_or_default()));
            copy(&path)?;
        } else if !copied && fs::hard_link(target, &path).is_err() {
            copy(&path)?;
        }
        names.0.insert(path.clone());
        Ok(Some(Self { path }))
    }

    /// An empty folder at `path`, which is there for good once it is kept.
    pub(super) fn folder(path: &Path) -> io::Result<Self> {
        let mut names = TemporaryNames::lock();
        fs::create_dir(path)?;
        names.0.insert(path.to_path_buf());
        Ok(Self { path: path.to_path_buf() })
    }

    /// Lets it stay under its name.
    pub(super) fn keep(&self, names: &mut TemporaryNames) {
        names.0.remove(&self.path);
    }

    /// Where it is.
    pub(super) fn path(&self) -> &Path {
        &self.path
    }

    /// Gives it the name `target`, in the place of what has it.
    pub(super) fn rename(&self, target: &Path, names: &mut TemporaryNames) -> io::Result<()> {
        fs::rename(&self.path, target)?;
        names.0.remove(&self.path);
        Ok(())
    }
}

impl Drop for Temporary {
    fn drop(&mut self) {
        // One that has been renamed or is kept has no temporary name any more.
        if TemporaryNames::lock().0.remove(&self.path) {
            remove(&self.path);
        }
    }
}

/// Removes a file of ours, or a folder without files; if that fails there is nothing better to do than to leave it.
pub(super) fn remove(path: &Path) {
    if fs::remove_file(path).is_err() {
        let _ = fs::remove_dir(path);
    }
}

/// A name beside `target` that this process has not used yet.
fn name_beside(target: &Path) -> PathBuf {
    static NEXT: AtomicU64 = AtomicU64::new(0);
    let mut name = OsString::from(".");
    name.push(target.file_name().unwrap_or_default());
    name.push(format!(".{}-{}.part", std::process::id(), NEXT.fetch_add(1, Ordering::Relaxed)));
    target.with_file_name(name)
}
