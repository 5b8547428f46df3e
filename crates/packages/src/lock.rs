//! Lock of a run: the packages that it used, with their versions and the hashes of their files.

use std::fs::File;
use std::io::Read as _;
use std::path::Path;

use burgeon_base::error::{Error, Limit, Result};
use semver::Version;

use super::copy::{LARGEST, MOST};
use super::package::{Package, Packages};

/// Package as it was when a run used it.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct LockedPackage {
    /// Name of the package.
    pub name: String,
    /// Version of the package.
    pub version: Version,
    /// Hash of its files: `blake3:` and 64 hexadecimal digits.
    pub hash: String,
}

impl Packages {
    /// Locks the packages whose names `used` accepts, in order.
    ///
    /// Fails if a file cannot be read, or if a package has more than [`MOST`] files or [`LARGEST`] bytes.
    pub fn lock(&self, used: impl Fn(&str) -> bool) -> Result<Vec<LockedPackage>> {
        let used = self.order().iter().filter(|package| used(&package.manifest.name));
        used.map(Package::lock).collect()
    }
}

impl Package {
    /// Locks the package in its current state.
    ///
    /// The hash covers all files in the order of their names, except files whose names begin with a dot. For each file
    /// it includes the name relative to the package's folder and the content, each after its length. It does not depend
    /// on the location of the package or on times.
    fn lock(&self) -> Result<LockedPackage> {
        let mut files = Vec::new();
        list(&self.folder, String::new(), 0, &mut files);
        let name = self.manifest.name.clone();
        let refuse = |what: String| {
            Error::limit(Limit::Size, format!("the package {name} has more than {what}"))
                .help("move files that scripts do not need out of its folder")
        };
        if files.len() > MOST {
            return Err(refuse(format!("{MOST} files")));
        }
        files.sort();
        let mut hasher = blake3::Hasher::new();
        let mut left = LARGEST;
        for file in files {
            let path = self.folder.join(&file);
            let cannot = |error: std::io::Error| {
                Error::file(&path, format!("cannot read {}: {error}", self.shown.join(&file).display()))
                    .help("get read permission for the whole package")
            };
            let (opened, meta) = burgeon_base::files::open(&path).map_err(cannot)?;
            let length = meta.len();
            left = left.checked_sub(length).ok_or_else(|| refuse(format!("{} MB", LARGEST / 1_000_000)))?;
            hasher.update(&(file.len() as u64).to_le_bytes()).update(file.as_bytes());
            hasher.update(&length.to_le_bytes());
            add(&mut hasher, opened, length).map_err(cannot)?;
        }
        let version = self.manifest.version.clone();
        Ok(LockedPackage { name, version, hash: format!("blake3:{}", hasher.finalize().to_hex()) })
    }
}

/// Returns the hash of the content of a file: `blake3:` and 64 hexadecimal digits.
pub fn hash_file(path: &Path) -> std::io::Result<String> {
    let (file, _) = burgeon_base::files::open(path)?;
    let mut hasher = blake3::Hasher::new();
    hasher.update_reader(file)?;
    Ok(format!("blake3:{}", hasher.finalize().to_hex()))
}

/// Adds the first `length` bytes of a file; data that is appended in the meantime is ignored.
fn add(hasher: &mut blake3::Hasher, file: File, length: u64) -> std::io::Result<()> {
    hasher.update_reader(file.take(length)).map(drop)
}

/// Adds the files in `inner` of the folder to `files`, stopping once there are too many.
fn list(folder: &Path, inner: String, depth: usize, files: &mut Vec<String>) {
    let entries = std::fs::read_dir(folder.join(&inner)).into_iter().flatten().flatten();
    for entry in entries.take(MOST + 1) {
        let Ok(name) = entry.file_name().into_string() else { continue };
        let Ok(kind) = entry.file_type() else { continue };
        if name.starts_with('.') || files.len() > MOST {
            continue;
        }
        let path = if inner.is_empty() { name } else { format!("{inner}/{name}") };
        if kind.is_dir() && depth < 32 {
            list(folder, path, depth + 1, files);
        } else if kind.is_file() {
            files.push(path);
        }
    }
}
