//! Installs a package from a folder or a zip: the whole of it, or nothing.

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

/// The most (bytes) that all files of a package may have.
pub const LARGEST: u64 = 1_000_000_000;

/// The most files and folders that a package may have.
pub const MOST: usize = 10_000;

/// How deep folders of a package may be within one another.
const DEEPEST: usize = 32;

/// A package that was installed.
#[derive(Debug, Clone)]
pub struct Installation {
    /// What it says of itself.
    pub manifest: Manifest,
    /// Its folder.
    pub folder: PathBuf,
    /// The version that was there before.
    pub replaced: Option<Version>,
    /// How many files it has.
    pub files: usize,
    /// How many bytes they have.
    pub bytes: u64,
}

/// Copies the package in the folder or the zip `from` into a folder of its name in `into`.
///
/// Files whose names begin with a point are left out. Fails if it is no package, if there is one already and `replace`
/// does not say to put this one in its place, and for what a package may not hold: links, devices, names that lead
/// elsewhere or differ by nothing but capitals, more than [`MOST`] files or [`LARGEST`] bytes. Then all is as before.
///
/// `check` sees what the package says of itself before anything is put into its place, and may refuse it. A folder that is
/// no package of this name is never replaced, nor is a link or a checkout.
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
    // Beside what it becomes, so that it takes one renaming, and with a point, so that nobody takes it for a package.
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
        // Only if nobody has put anything there.
        let _ = fs::remove_dir(into);
    }
    installed
}

/// A package that is being copied into a folder from which it is put into its place.
pub(crate) struct PackageCopy {
    folder: PathBuf,
    /// The parts of paths by what they are without capitals: how they are written, and whether it is a folder.
    names: BTreeMap<String, (String, bool)>,
    files: usize,
    bytes: u64,
    /// The most bytes that it may have.
    most_bytes: u64,
    /// The most files and folders.
    most_files: usize,
}

impl PackageCopy {
    pub(crate) fn new(folder: PathBuf, most_bytes: u64, most_files: usize) -> Result<Self> {
        fs::create_dir(&folder).map_err(|error| unwritable(&folder, &error))?;
        Ok(Self { folder, names: BTreeMap::new(), files: 0, bytes: 0, most_bytes, most_files })
    }

    /// Adds what `content` has as the file `name`, whose parts are apart by `/`. It is about the package `from`.
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
        // What a header says of the size need not be true.
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

    /// Looks at the name of an empty folder, which is not made.
    #[cfg_attr(not(feature = "zip"), expect(dead_code, reason = "only zips name folders"))]
    pub(crate) fn check_folder(&self, from: &Path, name: &str) -> Result<()> {
        parts(from, name).map(drop)
    }

    /// Takes notice of a file and of the folders that it is in. Fails if another name is in the way.
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

    /// The folder that has the `mod.toml`: the whole, or the only folder in it.
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

    /// Puts the package into its place in `into`.
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
                // What cannot go back either is told by the first error.
                let _ = fs::rename(&old, &folder);
            }
            return Err(cannot(error));
        }
        let replaced = before.and_then(Result::ok).map(|before| before.version);
        Ok(Installation { manifest, folder, replaced, files: self.files, bytes: self.bytes })
    }
}

/// Fails if the folder, which is in the place of a package `name` and whose `mod.toml` says `before`, is not just that
/// package: what is not known to come from a package is not deleted.
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

/// What tells a folder in which people work on a package from a copy of one.
const CHECKOUTS: [&str; 5] = [".git", ".hg", ".svn", ".jj", ".bzr"];

/// The folder in `into` that holds a package `name`, whatever it is called.
fn elsewhere(into: &Path, name: &str) -> Option<PathBuf> {
    let search = super::PackageSearch { given: vec![into.to_path_buf()], ..super::PackageSearch::default() };
    let found = Packages::find(&search, &Version::new(0, 0, 0));
    Some(found.get(name)?.shown.clone())
}

/// The parts of the path `name` of a file of the package `from`. Fails if it could lead anywhere else.
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

/// Whether Windows takes a name for that of a device.
fn is_device(name: &str) -> bool {
    let stem = name.split('.').next().unwrap_or_default().to_ascii_lowercase();
    let numbered =
        |kind: &str| stem.strip_prefix(kind).is_some_and(|rest| matches!(rest.as_bytes(), [b'0'..=b'9']));
    ["con", "prn", "aux", "nul"].contains(&&*stem) || numbered("com") || numbered("lpt")
}

/// Whether a file is of those that systems and other programs leave behind.
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

/// The error for what is neither a file nor a folder.
pub(crate) fn no_file(from: &Path, name: &str, is_link: bool) -> Error {
    let what = if is_link { "a link" } else { "a device or a pipe" };
    Error::data(format!("{} has {}, which is {what}", from.display(), name.escape_debug()))
        .help("a package holds files and folders only")
}

fn unwritable(path: &Path, error: &io::Error) -> Error {
    Error::file(path, format!("cannot write {}: {error}", path.display()))
        .help("name another folder: --into FOLDER")
}
