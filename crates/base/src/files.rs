//! Opens what a script or a command names: files, and nothing that could keep a reader waiting.

use std::fs::{File, Metadata};
use std::io::{Error, ErrorKind, Read, Result};
use std::path::Path;

/// Opens the file at `path` for reading. A pipe, a socket or a device is refused before anything is read from it, and
/// so is a folder.
pub fn open(path: &Path) -> Result<(File, Metadata)> {
    check(&path.metadata()?)?;
    let file = open_at_once(path)?;
    // Something else may have taken its place.
    let meta = file.metadata()?;
    check(&meta)?;
    Ok((file, meta))
}

/// The whole file at `path`. Fails if it has more than `most` bytes.
pub fn read(path: &Path, most: u64) -> Result<Vec<u8>> {
    let (file, meta) = open(path)?;
    let too_large = || Error::new(ErrorKind::FileTooLarge, format!("it has more than {most} bytes"));
    if meta.len() > most {
        return Err(too_large());
    }
    let mut bytes = Vec::with_capacity(usize::try_from(meta.len()).unwrap_or(0));
    // It may grow while it is read.
    file.take(most.saturating_add(1)).read_to_end(&mut bytes)?;
    if bytes.len() as u64 > most { Err(too_large()) } else { Ok(bytes) }
}

/// Fails unless `meta` is that of a file.
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
    // A pipe that nobody writes to is opened at once, too.
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
}
