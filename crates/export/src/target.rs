//! Target of a file: resolves links, and preserves the mode and the owner of an existing file.

use std::fs::{self, File, Metadata};
use std::io::{self, ErrorKind};
use std::path::{Path, PathBuf};

use super::temporary::Temporary;
use burgeon_base::error::{Error, Result};

/// Maximum length of a chain of links.
const LINKS: usize = 40;

/// Path that a file can be written to.
pub(super) struct FileTarget {
    /// Path as the caller named it.
    named: PathBuf,
    /// Path with all links resolved.
    real: PathBuf,
    /// Metadata of the existing file, if any.
    there: Option<Metadata>,
}

/// Method to move a file from its temporary name to its target.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum ReplaceMethod {
    /// Renames the file, replacing the existing one.
    Instead,
    /// Copies the content into the existing file, because it has other hard links or an owner that this process cannot
    /// set.
    Into,
    /// Copies the content into a target that cannot be restored, such as a pipe.
    Through,
}

impl FileTarget {
    /// Resolves `named`. Fails if its folder does not exist, if it is a folder, or if it is not writable.
    pub(super) fn of(named: &Path) -> Result<Self> {
        let there = named.metadata().ok();
        if there.as_ref().is_some_and(Metadata::is_dir) {
            let error = Error::file(named, format!("cannot write {}: it is a folder", named.display()));
            return Err(
                error.help(format!("specify a file in it, such as {}", named.join("model.glb").display()))
            );
        }
        let real = match &there {
            // The names that the system gives to open pipes are links without a target.
            Some(there) if !there.is_file() => named.to_path_buf(),
            _ => follow(named).map_err(|error| path_error(named, &error))?,
        };
        let folder = folder(&real);
        if !folder.is_dir() {
            let (shown, folder) = (named.display(), folder.display());
            return Err(Error::file(named, format!("cannot write {shown}: folder not found: {folder}"))
                .help("create the folder first, or write to an existing folder"));
        }
        // Replacing a file does not require permission to write to it, but its owner may have write-protected it on
        // purpose.
        if there.as_ref().is_some_and(Metadata::is_file) {
            File::options().write(true).open(&real).map_err(|error| path_error(named, &error))?;
        }
        let real = match (folder.canonicalize(), real.file_name()) {
            (Ok(folder), Some(name)) if there.as_ref().is_none_or(Metadata::is_file) => folder.join(name),
            _ => real,
        };
        Ok(Self { named: named.to_path_buf(), real, there })
    }

    /// Returns the resolved path.
    pub(super) fn real(&self) -> &Path {
        &self.real
    }

    /// Returns true if both are the same file.
    pub(super) fn is(&self, other: &Self) -> bool {
        let same = |(a, b): (&Metadata, &Metadata)| identity(a).is_some_and(|a| identity(b) == Some(a));
        self.real == other.real || self.there.as_ref().zip(other.there.as_ref()).is_some_and(same)
    }

    /// Creates a temporary file for the content, and selects the method to replace the target.
    pub(super) fn create(&self) -> Result<(Temporary, File, ReplaceMethod)> {
        let elsewhere = |way: ReplaceMethod| {
            let name = self.real.file_name().unwrap_or_default();
            let (temporary, file) = Temporary::create_beside(&std::env::temp_dir().join(name))?;
            hide(&file)?;
            Ok((temporary, file, way))
        };
        let created = match &self.there {
            None => Temporary::create_beside(&self.real)
                .map(|(temporary, file)| (temporary, file, ReplaceMethod::Instead)),
            Some(there) if !there.is_file() => elsewhere(ReplaceMethod::Through),
            Some(there) => match Temporary::create_beside(&self.real) {
                Ok((temporary, file)) => {
                    let alike = !has_other_names(there) && liken(&file, there).is_ok();
                    Ok((temporary, file, if alike { ReplaceMethod::Instead } else { ReplaceMethod::Into }))
                }
                // The file may be writable although its folder is not.
                Err(error) if is_forbidden(&error) => elsewhere(ReplaceMethod::Into),
                Err(error) => Err(error),
            },
        };
        created.map_err(|error: io::Error| self.write_error(&error))
    }

    /// Returns the error for a failed write.
    pub(super) fn write_error(&self, error: &io::Error) -> Error {
        path_error(&self.named, error)
    }

    /// Copies the file at `path` into the existing target.
    pub(super) fn fill(&self, path: &Path) -> io::Result<()> {
        let mut out = File::options().write(true).open(&self.real)?;
        if self.there.as_ref().is_some_and(Metadata::is_file) {
            out.set_len(0)?;
        }
        io::copy(&mut File::open(path)?, &mut out).map(|_| ())
    }
}

/// Resolves the links at `path`, even if the final target does not exist.
fn follow(path: &Path) -> io::Result<PathBuf> {
    let mut path = path.to_path_buf();
    for _ in 0..LINKS {
        match fs::read_link(&path) {
            Ok(next) => path = folder(&path).join(next),
            Err(_) => return Ok(path),
        }
    }
    Err(io::Error::other("circular symbolic link"))
}

/// Returns the folder that contains `path`.
fn folder(path: &Path) -> &Path {
    match path.parent() {
        Some(folder) if folder.as_os_str().is_empty() => Path::new("."),
        Some(folder) => folder,
        None => path,
    }
}

/// Sets the owner and the mode of `file` to those of `like`.
#[cfg(unix)]
fn liken(file: &File, like: &Metadata) -> io::Result<()> {
    use std::os::unix::fs::{MetadataExt, fchown};
    let own = file.metadata()?;
    if (own.uid(), own.gid()) != (like.uid(), like.gid()) {
        fchown(file, Some(like.uid()), Some(like.gid()))?;
    }
    file.set_permissions(like.permissions())
}

#[cfg(not(unix))]
fn liken(_: &File, _: &Metadata) -> io::Result<()> {
    Ok(())
}

/// Restricts access to `file`, which is in a shared folder, to its owner.
#[cfg(unix)]
fn hide(file: &File) -> io::Result<()> {
    file.set_permissions(std::os::unix::fs::PermissionsExt::from_mode(0o600))
}

#[cfg(not(unix))]
fn hide(_: &File) -> io::Result<()> {
    Ok(())
}

#[cfg(unix)]
fn has_other_names(there: &Metadata) -> bool {
    std::os::unix::fs::MetadataExt::nlink(there) > 1
}

#[cfg(not(unix))]
fn has_other_names(_: &Metadata) -> bool {
    false
}

/// Returns a key that identifies a file regardless of its name.
#[cfg(unix)]
fn identity(there: &Metadata) -> Option<(u64, u64)> {
    use std::os::unix::fs::MetadataExt;
    Some((there.dev(), there.ino()))
}

#[cfg(not(unix))]
fn identity(_: &Metadata) -> Option<(u64, u64)> {
    None
}

fn is_forbidden(error: &io::Error) -> bool {
    matches!(error.kind(), ErrorKind::PermissionDenied | ErrorKind::ReadOnlyFilesystem)
}

/// Returns the error for a failed write to `path`.
fn path_error(path: &Path, error: &io::Error) -> Error {
    let said = Error::file(path, format!("cannot write {}: {error}", path.display()));
    match error.kind() {
        ErrorKind::NotFound => said.help("create the folder first, or write to an existing folder"),
        ErrorKind::PermissionDenied | ErrorKind::ReadOnlyFilesystem => {
            let (file, folder) = (path.display(), folder(path).display());
            said.help(match path.is_file() {
                true => format!("get write permission for {file}, or choose another name"),
                false => format!("write to a folder other than {folder}, with write permission"),
            })
        }
        ErrorKind::StorageFull | ErrorKind::QuotaExceeded => {
            said.help("free some space, or write to another disk")
        }
        ErrorKind::IsADirectory => said.help("remove that folder, or choose another name"),
        _ => said.help("write to another folder or disk"),
    }
}
