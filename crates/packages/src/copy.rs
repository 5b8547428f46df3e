//! The files of a package that is copied: their names and sizes are checked before they are written.

use std::collections::BTreeMap;
use std::fs::{self, File};
use std::io::{self, Read, Write as _};
use std::path::{Path, PathBuf};

use burgeon_base::error::{Error, Limit, Result};
use burgeon_base::names::{fold_case, has_bidi_controls, normal_form};

use super::manifest::MANIFEST;

/// Maximum total size (bytes) of a package's files.
pub const LARGEST: u64 = 1_000_000_000;

/// Maximum number of files and folders in a package.
pub const MOST: usize = 10_000;

/// Maximum nesting depth of folders in a package.
const DEEPEST: usize = 32;

/// Package that is copied to a temporary folder, from which it is moved to its final folder.
pub(crate) struct PackageCopy {
    pub(super) folder: PathBuf,
    /// Parts of paths by their case-folded form, each with its spelling and a flag that is set for folders.
    names: BTreeMap<String, (String, bool)>,
    pub(super) files: usize,
    pub(super) bytes: u64,
    /// Maximum total size (bytes).
    most_bytes: u64,
    /// Maximum number of files and folders.
    most_files: usize,
}

impl PackageCopy {
    pub(crate) fn new(folder: PathBuf, most_bytes: u64, most_files: usize) -> Result<Self> {
        fs::create_dir(&folder).map_err(|error| unwritable(&folder, &error))?;
        Ok(Self { folder, names: BTreeMap::new(), files: 0, bytes: 0, most_bytes, most_files })
    }

    /// Adds the file `name`, with `/` as separator, from the data of `content`. Errors refer to the package `from`.
    pub(crate) fn add(&mut self, from: &Path, name: &str, content: &mut dyn Read) -> Result<()> {
        let normal = normal_form(name);
        let name = &*normal;
        let parts = parts(from, name)?;
        if is_left_out(&parts) {
            return Ok(());
        }
        self.note(from, &parts)?;
        let path = self.folder.join(parts.iter().collect::<PathBuf>());
        if let Some(folder) = path.parent() {
            fs::create_dir_all(folder).map_err(|error| unwritable(folder, &error))?;
        }
        let mut file = File::create_new(&path).map_err(|error| unwritable(&path, &error))?;
        let left = self.most_bytes - self.bytes;
        // The size in a header is not trusted.
        let copied =
            io::copy(&mut content.take(left + 1), &mut file).and_then(|copied| file.flush().map(|()| copied));
        let copied = copied.map_err(|error| {
            Error::file(from, format!("{} cannot be unpacked: {name}: {error}", from.display()))
                .help("it is damaged, or the disk is full; download it again")
        })?;
        self.bytes += copied;
        if copied > left {
            return Err(Error::limit(
                Limit::Size,
                format!("{} has more than {} MB", from.display(), self.most_bytes / 1_000_000),
            )
            .help("reduce the size of the package"));
        }
        Ok(())
    }

    /// Checks the name of an empty folder, which is not created.
    #[cfg_attr(not(feature = "zip"), expect(dead_code, reason = "only zips name folders"))]
    pub(crate) fn check_folder(&self, from: &Path, name: &str) -> Result<()> {
        parts(from, name).map(drop)
    }

    /// Registers a file and the folders that contain it. Fails if it conflicts with another name.
    fn note(&mut self, from: &Path, parts: &[&str]) -> Result<()> {
        let mut path = String::new();
        for (index, part) in parts.iter().enumerate() {
            if index > 0 {
                path.push('/');
            }
            path += part;
            let is_folder = index + 1 < parts.len();
            let known = self.names.insert(fold_case(&path), (path.clone(), is_folder));
            let Some((written, was_folder)) = known else {
                self.files += usize::from(!is_folder);
                let most = self.most_files;
                if self.names.len() > most {
                    let message = format!("{} has more than {most} files and folders", from.display());
                    return Err(
                        Error::limit(Limit::Size, message).help("remove files that scripts do not need")
                    );
                }
                continue;
            };
            if written == path && was_folder && is_folder {
                continue;
            }
            let message = match written == path {
                true => format!("{} has {path} twice", from.display()),
                false => {
                    format!(
                        "{} has {written} and {path}, which are the same name on many systems",
                        from.display()
                    )
                }
            };
            return Err(Error::data(message).help("this package is unsafe; do not use it"));
        }
        Ok(())
    }

    /// Returns the folder that contains the `mod.toml`: the root, or the only folder in it.
    pub(super) fn package(&self, from: &Path) -> Result<PathBuf> {
        if self.folder.join(MANIFEST).is_file() {
            return Ok(self.folder.clone());
        }
        let tops: Vec<&str> =
            self.names.values().map(|(name, _)| name.as_str()).filter(|name| !name.contains('/')).collect();
        match tops.as_slice() {
            [one] if self.folder.join(one).join(MANIFEST).is_file() => Ok(self.folder.join(one)),
            _ => Err(Error::not_found("file", MANIFEST, [], format!("{} has no {MANIFEST}", from.display()))
                .help("a package is a folder with a mod.toml, or a zip of one")),
        }
    }
}

/// Splits the path `name` of a file of the package `from` into its parts. Fails if the path could refer to a location
/// outside the package.
pub(super) fn parts<'a>(from: &Path, name: &'a str) -> Result<Vec<&'a str>> {
    let refuse = |why: &str| {
        let name = name.escape_debug();
        Err(Error::data(format!("{} has a file {name}, {why}", from.display()))
            .help("this package is unsafe; do not use it"))
    };
    let parts: Vec<&str> = name.split('/').collect();
    if name.starts_with('/') || parts.contains(&"..") {
        return refuse("which is outside the package");
    }
    if parts.len() > DEEPEST {
        return refuse("which is nested too deep");
    }
    let is_odd = |part: &&str| {
        part.is_empty()
            || *part == "."
            || part.len() > 200
            || part.ends_with([' ', '.'])
            || part.contains(['\\', ':', '*', '?', '"', '<', '>', '|'])
            || part.chars().any(char::is_control)
            || has_bidi_controls(part)
            || is_device(part)
    };
    if parts.iter().any(is_odd) {
        return refuse("with a name that not all systems support");
    }
    Ok(parts)
}

/// Returns true if Windows interprets a name as a device.
fn is_device(name: &str) -> bool {
    let stem = name.split('.').next().unwrap_or_default().to_ascii_lowercase();
    let numbered =
        |kind: &str| stem.strip_prefix(kind).is_some_and(|rest| matches!(rest.as_bytes(), [b'0'..=b'9']));
    ["con", "prn", "aux", "nul"].contains(&&*stem) || numbered("com") || numbered("lpt")
}

/// Returns true for files that operating systems and other programs leave behind.
fn is_left_out(parts: &[&str]) -> bool {
    parts.iter().any(|part| part.starts_with('.') || *part == "__MACOSX")
}

/// Returns the error for an entry that is neither a file nor a folder.
pub(crate) fn no_file(from: &Path, name: &str, is_link: bool) -> Error {
    let what = if is_link { "a link" } else { "a device or a pipe" };
    Error::data(format!("{} has {}, which is {what}", from.display(), name.escape_debug()))
        .help("a package can contain only files and folders")
}

/// Returns the error for a path that cannot be written.
pub(super) fn unwritable(path: &Path, error: &io::Error) -> Error {
    Error::file(path, format!("cannot write {}: {error}", path.display()))
        .help("specify another folder: --into FOLDER")
}
