//! Opening of files that a script or a command names. Refuses everything that can block a reader.

use std::fs::{File, Metadata};
use std::io::{Error, ErrorKind, Read, Result};
use std::path::Path;
use std::sync::RwLock;

use crate::locks::LockRecovery;

/// Identities of the files that databases of this process have locked, see [`identity`], one entry per lock.
static LOCKED: RwLock<Vec<u64>> = RwLock::new(Vec::new());

/// Mark for a file that a database of this process has locked, until it is dropped.
///
/// On Unix a process loses its locks on a file when it closes any handle of the file. No other code of the process may
/// therefore open the file while it is locked; [`read_unlocked`] and [`is_locked`] check this.
#[derive(Debug)]
pub struct FileLock(u64);

impl FileLock {
    /// Marks the file at `path` before a database locks it. Waits for readers of the file.
    pub fn announce(path: &Path) -> Result<Self> {
        let identity = identity(&path.metadata()?);
        LOCKED.write().recover().push(identity);
        Ok(Self(identity))
    }
}

impl Drop for FileLock {
    fn drop(&mut self) {
        let mut locked = LOCKED.write().recover();
        if let Some(index) = locked.iter().position(|known| *known == self.0) {
            locked.swap_remove(index);
        }
    }
}

/// Reports whether a database of this process has locked the file.
pub fn is_locked(meta: &Metadata) -> bool {
    cfg!(unix) && LOCKED.read().recover().contains(&identity(meta))
}

/// Opens the file at `path` and returns the result of `read`, or `None` if a database of this process has locked the
/// file. No database can lock the file during the call.
pub fn read_unlocked<T>(path: &Path, read: impl FnOnce(File, Metadata) -> Result<T>) -> Result<Option<T>> {
    let locked = LOCKED.read().recover();
    if cfg!(unix) && locked.contains(&identity(&path.metadata()?)) {
        return Ok(None);
    }
    let (file, meta) = open(path)?;
    let read = read(file, meta).map(Some);
    drop(locked);
    read
}

/// Returns a number that distinguishes a file or folder from a later one with the same name, from the inode and the
/// device.
#[cfg(unix)]
pub fn identity(metadata: &Metadata) -> u64 {
    use std::os::unix::fs::MetadataExt;
    metadata.ino() ^ metadata.dev().rotate_left(48)
}

/// Returns a number that distinguishes a file or folder from a later one with the same name, from the time of creation.
#[cfg(not(unix))]
pub fn identity(metadata: &Metadata) -> u64 {
    let made = metadata.created().ok().and_then(|made| made.duration_since(std::time::UNIX_EPOCH).ok());
    made.map_or(0, |made| made.as_secs() ^ u64::from(made.subsec_nanos()).rotate_left(32))
}

/// Opens the file at `path` for reading. Fails for folders, and for pipes, sockets and devices before anything is read
/// from them.
pub fn open(path: &Path) -> Result<(File, Metadata)> {
    check(&path.metadata()?)?;
    let file = open_at_once(path)?;
    // The file may have been replaced since the first check.
    let meta = file.metadata()?;
    check(&meta)?;
    Ok((file, meta))
}

/// Reads the whole file at `path`. Fails if it has more than `most` bytes.
pub fn read(path: &Path, most: u64) -> Result<Vec<u8>> {
    let (file, meta) = open(path)?;
    let too_large = || Error::new(ErrorKind::FileTooLarge, format!("it has more than {most} bytes"));
    if meta.len() > most {
        return Err(too_large());
    }
    let mut bytes = Vec::with_capacity(usize::try_from(meta.len()).unwrap_or(0));
    // The file may grow while it is read.
    file.take(most.saturating_add(1)).read_to_end(&mut bytes)?;
    if bytes.len() as u64 > most { Err(too_large()) } else { Ok(bytes) }
}

/// Fails if `meta` does not belong to a regular file.
fn check(meta: &Metadata) -> Result<()> {
    if meta.is_file() {
        return Ok(());
    }
    if meta.is_dir() {
        return Err(Error::new(ErrorKind::IsADirectory, "it is a folder"));
    }
    Err(Error::new(ErrorKind::InvalidInput, "it is a pipe or a device, not a file"))
}

#[cfg(unix)]
fn open_at_once(path: &Path) -> Result<File> {
    use std::os::unix::fs::OpenOptionsExt;
    // Opening a pipe without a writer must not block.
    File::options().read(true).custom_flags(libc::O_NONBLOCK).open(path)
}

#[cfg(not(unix))]
fn open_at_once(path: &Path) -> Result<File> {
    File::open(path)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[cfg(unix)]
    #[test]
    fn pipes_devices_and_folders_are_refused_at_once() {
        let folder = tempfile::tempdir().unwrap();
        let pipe = folder.path().join("pipe");
        assert!(std::process::Command::new("mkfifo").arg(&pipe).status().unwrap().success());
        let told = |path: &Path| read(path, 10).unwrap_err().to_string();
        assert_eq!(told(&pipe), "it is a pipe or a device, not a file");
        assert_eq!(told(Path::new("/dev/zero")), "it is a pipe or a device, not a file");
        assert_eq!(told(folder.path()), "it is a folder");
        std::fs::write(folder.path().join("a"), "12345678901").unwrap();
        assert_eq!(told(&folder.path().join("a")), "it has more than 10 bytes");
        assert_eq!(read(&folder.path().join("a"), 11).unwrap(), b"12345678901");
    }

    #[cfg(unix)]
    #[test]
    fn a_file_that_a_database_has_locked_is_not_opened() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a");
        std::fs::write(&path, "text").unwrap();
        let text = || {
            read_unlocked(&path, |mut file, _| {
                let mut text = String::new();
                file.read_to_string(&mut text)?;
                Ok(text)
            })
        };
        let locks = [FileLock::announce(&path).unwrap(), FileLock::announce(&path).unwrap()];
        for lock in locks {
            assert!(is_locked(&path.metadata().unwrap()) && text().unwrap().is_none());
            drop(lock);
        }
        assert!(!is_locked(&path.metadata().unwrap()));
        assert_eq!(text().unwrap().as_deref(), Some("text"));
    }
}
