//! Installs a package from a folder or a zip, completely or not at all.

use std::collections::BTreeMap;
use std::fs::{self, File};
use std::io::{self, Read, Write as _};
use std::path::{Path, PathBuf};

use burgeon_base::error::{Error, Limit, Result};
use burgeon_base::names::{folded, has_bidi_controls, normal_form};
use semver::Version;

use super::find::Packages;
use super::manifest::{MANIFEST, Manifest};
use super::unzip;

/// Maximum total size (bytes) of a package's files.
pub const LARGEST: u64 = 1_000_000_000;

/// Maximum number of files and folders in a package.
pub const MOST: usize = 10_000;

/// Maximum nesting depth of folders in a package.
const DEEPEST: usize = 32;

/// Installed package.
#[derive(Debug, Clone)]
pub struct Installation {
    /// Content of its `mod.toml`.
    pub manifest: Manifest,
    /// Folder of the package.
    pub folder: PathBuf,
    /// Version that was replaced, if any.
    pub replaced: Option<Version>,
    /// Number of files.
    pub files: usize,
    /// Total size (bytes) of the files.
    pub bytes: u64,
}

/// Copies the package in the folder or zip `from` to a folder with the package's name in `into`.
///
/// Files whose names begin with a dot are skipped. Fails if `from` is not a package, or if the package exists already
/// and `replace` is not set. Also fails if the package contains links, devices, names that refer to other folders or
/// differ only in capitalisation, more than [`MOST`] files or more than [`LARGEST`] bytes. On failure all files are as
/// before.
///
/// `check` receives the manifest before the package is moved to its final folder, and may reject it. A folder that is
/// not a package of this name is never replaced, nor is a link or a checkout.
pub fn install(
    from: &Path,
    into: &Path,
    replace: bool,
    check: impl Fn(&Manifest) -> Result<()>,
) -> Result<Installation> {
    let meta = from.metadata().map_err(|_| {
        let shown = from.display();
        Error::not_found("package", &shown, [], format!("there is no folder or zip {shown}"))
            .help("name the folder that has the mod.toml, or a zip of it")
    })?;
    let was_there = into.exists();
    fs::create_dir_all(into).map_err(|error| unwritable(into, &error))?;
    // In the target folder, so that one rename suffices, and hidden, so that it is not taken for a package.
    let built = tempfile::Builder::new().prefix(".burgeon-").tempdir_in(into);
    let installed = built.map_err(|error| unwritable(into, &error)).and_then(|built| {
        let mut copy = PackageCopy::new(built.path().join("new"), LARGEST, MOST)?;
        if meta.is_dir() {
            copy_folder(from, &mut copy)?;
        } else {
            unzip::unpack(from, &mut copy)?;
        }
        copy.put(built.path(), into, from, replace, &check)
    });
    if installed.is_err() && !was_there {
        // Removes the folder only if it is empty.
        let _ = fs::remove_dir(into);
    }
    installed
}

/// Package that is copied to a temporary folder, from which it is moved to its final folder.
pub(crate) struct PackageCopy {
    folder: PathBuf,
    /// Parts of paths by their case-folded form, each with its spelling and a flag that is set for folders.
    names: BTreeMap<String, (String, bool)>,
    files: usize,
    bytes: u64,
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
        let path = parts.iter().fold(self.folder.clone(), |path, part| path.join(part));
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
                .help("it is damaged, or the disk is full; get it again")
        })?;
        self.bytes += copied;
        if copied > left {
            return Err(Error::limit(
                Limit::Size,
                format!("{} has more than {} MB", from.display(), self.most_bytes / 1_000_000),
            )
            .help("a package may not be larger"));
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
            let known = self.names.insert(folded(&path), (path.clone(), is_folder));
            let Some((written, was_folder)) = known else {
                self.files += usize::from(!is_folder);
                let most = self.most_files;
                if self.names.len() > most {
                    let message = format!("{} has more than {most} files and folders", from.display());
                    return Err(Error::limit(Limit::Size, message).help("a package may not have more"));
                }
                continue;
            };
            if written == path && was_folder && is_folder {
                continue;
            }
            let message = match written == path {
                true => format!("{} has {path} twice", from.display()),
                false => {
                    format!("{} has {written} and {path}, which many systems take for one", from.display())
                }
            };
            return Err(Error::data(message).help("this is no sound package; do not use it"));
        }
        Ok(())
    }

    /// Returns the folder that contains the `mod.toml`: the root, or the only folder in it.
    fn package(&self, from: &Path) -> Result<PathBuf> {
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

    /// Moves the package to its final folder in `into`.
    fn put(
        self,
        temporary: &Path,
        into: &Path,
        from: &Path,
        replace: bool,
        check: &dyn Fn(&Manifest) -> Result<()>,
    ) -> Result<Installation> {
        let built = self.package(from)?;
        let inner = built.strip_prefix(&self.folder).unwrap_or(Path::new(""));
        let manifest = Manifest::read(&built, &from.join(inner))?;
        check(&manifest)?;
        let folder = into.join(&manifest.name);
        let there = folder.symlink_metadata().is_ok();
        let before = match there {
            true => Some(Manifest::read(&folder, &folder)),
            false => None,
        };
        if !there && let Some(other) = elsewhere(into, &manifest.name) {
            return Err(Error::data(format!(
                "there is a package {} in {} already",
                manifest.name,
                other.display()
            ))
            .help("remove it first, for its folder has another name than the package"));
        }
        if there && !replace {
            let version = match &before {
                Some(Ok(before)) => format!(" {}", before.version),
                _ => String::new(),
            };
            let (name, new) = (&manifest.name, &manifest.version);
            let message = format!("there is a package {name}{version} in {} already", folder.display());
            return Err(
                Error::file(&folder, message).help(format!("put {name} {new} in its place: --replace"))
            );
        }
        if there {
            refuse_to_replace(&folder, &manifest.name, before.as_ref())?;
        }
        let cannot = |error: io::Error| unwritable(&folder, &error);
        let old = temporary.join("old");
        if there {
            fs::rename(&folder, &old).map_err(cannot)?;
        }
        if let Err(error) = fs::rename(&built, &folder) {
            if there {
                // If restoring the old folder fails too, the first error is reported.
                let _ = fs::rename(&old, &folder);
            }
            return Err(cannot(error));
        }
        let replaced = before.and_then(Result::ok).map(|before| before.version);
        Ok(Installation { manifest, folder, replaced, files: self.files, bytes: self.bytes })
    }
}

/// Fails if the existing folder of the package `name`, whose `mod.toml` contains `before`, has other content than that
/// package. Files of unknown origin are never deleted.
fn refuse_to_replace(folder: &Path, name: &str, before: Option<&Result<Manifest>>) -> Result<()> {
    let shown = folder.display();
    let refuse = |what: &str| {
        Err(Error::file(folder, format!("{shown} {what}, so it is not replaced"))
            .help("move it away, or remove it yourself; then add the package again"))
    };
    if folder.is_symlink() {
        return refuse("is a link");
    }
    match before {
        Some(Ok(before)) if before.name == name => {}
        Some(Ok(before)) => return refuse(&format!("is the package {}", before.name)),
        _ => return refuse("is no package"),
    }
    match CHECKOUTS.iter().find(|inner| folder.join(inner).symlink_metadata().is_ok()) {
        Some(inner) => refuse(&format!("is a checkout, with a folder {inner}")),
        None => Ok(()),
    }
}

/// Folders that mark a package under development, in contrast to an installed copy.
const CHECKOUTS: [&str; 5] = [".git", ".hg", ".svn", ".jj", ".bzr"];

/// Returns the folder in `into` that contains a package `name`, regardless of the folder's name.
fn elsewhere(into: &Path, name: &str) -> Option<PathBuf> {
    let search = super::PackageSearch { given: vec![into.to_path_buf()], ..super::PackageSearch::default() };
    let found = Packages::find(&search, &Version::new(0, 0, 0));
    Some(found.get(name)?.shown.clone())
}

/// Splits the path `name` of a file of the package `from` into its parts. Fails if the path could refer to a location
/// outside the package.
fn parts<'a>(from: &Path, name: &'a str) -> Result<Vec<&'a str>> {
    let refuse = |why: &str| {
        let name = name.escape_debug();
        Err(Error::data(format!("{} has a file {name}, {why}", from.display()))
            .help("this is no sound package; do not use it"))
    };
    let parts: Vec<&str> = name.split('/').collect();
    if name.starts_with('/') || parts.contains(&"..") {
        return refuse("which leads out of the package");
    }
    if parts.len() > DEEPEST {
        return refuse("which is in too many folders");
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
        return refuse("whose name not every system can have");
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

/// Copies the files of the folder `from`.
fn copy_folder(from: &Path, copy: &mut PackageCopy) -> Result<()> {
    let cannot = |path: &Path, error: &io::Error| {
        Error::file(path, format!("cannot read {}: {error}", path.display()))
            .help("see that you may read all of it")
    };
    let mut folders = vec![String::new()];
    while let Some(folder) = folders.pop() {
        let path = from.join(&folder);
        let entries = fs::read_dir(&path).map_err(|error| cannot(&path, &error))?.take(MOST + 1);
        let mut names = Vec::new();
        for entry in entries {
            let entry = entry.map_err(|error| cannot(&path, &error))?;
            names.push(entry.file_name().into_string().map_err(|name| {
                let message = format!("{} has a file {name:?}, whose name is no text", from.display());
                Error::data(message).help("rename it")
            })?);
        }
        names.sort();
        for name in names.into_iter().filter(|name| !name.starts_with('.')) {
            let inner = if folder.is_empty() { name } else { format!("{folder}/{name}") };
            let path = from.join(&inner);
            let meta = path.symlink_metadata().map_err(|error| cannot(&path, &error))?;
            if meta.is_dir() {
                parts(from, &inner)?;
                folders.push(inner);
            } else if meta.is_file() {
                let (mut file, _) =
                    burgeon_base::files::open(&path).map_err(|error| cannot(&path, &error))?;
                copy.add(from, &inner, &mut file)?;
            } else {
                return Err(no_file(from, &inner, meta.is_symlink()));
            }
        }
        if folders.len() > MOST {
            let message = format!("{} has more than {MOST} files and folders", from.display());
            return Err(Error::limit(Limit::Size, message).help("a package may not have more"));
        }
    }
    Ok(())
}

/// Returns the error for an entry that is neither a file nor a folder.
pub(crate) fn no_file(from: &Path, name: &str, is_link: bool) -> Error {
    let what = if is_link { "a link" } else { "a device or a pipe" };
    Error::data(format!("{} has {}, which is {what}", from.display(), name.escape_debug()))
        .help("a package holds files and folders only")
}

fn unwritable(path: &Path, error: &io::Error) -> Error {
    Error::file(path, format!("cannot write {}: {error}", path.display()))
        .help("name another folder: --into FOLDER")
}
