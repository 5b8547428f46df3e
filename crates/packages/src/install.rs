//! Installs a package from a folder or a zip, completely or not at all.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use burgeon_base::error::{Error, Limit, Result};
use semver::Version;

use super::copy::{LARGEST, MOST, PackageCopy, no_file, parts, unwritable};
use super::find::PackageSearch;
use super::manifest::Manifest;
use super::package::Packages;
use super::unzip;

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
///
/// ```
/// use burgeon_packages::install;
///
/// let folder = tempfile::tempdir()?;
/// let (from, into) = (folder.path().join("download"), folder.path().join("mods"));
/// std::fs::create_dir(&from)?;
/// std::fs::write(from.join("mod.toml"), "name = \"castle\"\nversion = \"1.2.0\"\napi = \"1.0\"\n")?;
/// let installation = install(&from, &into, false, |_| Ok(()))?;
/// assert_eq!((installation.files, installation.folder.ends_with("mods/castle")), (1, true));
/// assert!(install(&from, &into, false, |_| Ok(())).is_err(), "it is already installed");
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn install(
    from: &Path,
    into: &Path,
    replace: bool,
    check: impl Fn(&Manifest) -> Result<()>,
) -> Result<Installation> {
    let meta = from.metadata().map_err(|_| {
        let shown = from.display();
        Error::not_found("package", &shown, [], format!("folder or zip not found: {shown}"))
            .help("specify the folder that contains the mod.toml, or a zip of it")
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
        move_into_place(copy, built.path(), into, from, replace, &check)
    });
    if installed.is_err() && !was_there {
        // Removes the folder only if it is empty.
        let _ = fs::remove_dir(into);
    }
    installed
}

/// Moves the copied package to its final folder in `into`.
fn move_into_place(
    copy: PackageCopy,
    temporary: &Path,
    into: &Path,
    from: &Path,
    replace: bool,
    check: &dyn Fn(&Manifest) -> Result<()>,
) -> Result<Installation> {
    let built = copy.package(from)?;
    let inner = built.strip_prefix(&copy.folder).unwrap_or(Path::new(""));
    let manifest = Manifest::read(&built, &from.join(inner))?;
    check(&manifest)?;
    let folder = into.join(&manifest.name);
    let there = folder.symlink_metadata().is_ok();
    let before = match there {
        true => Some(Manifest::read(&folder, &folder)),
        false => None,
    };
    if !there && let Some(other) = find_other_folder(into, &manifest.name) {
        return Err(Error::data(format!(
            "a package {} already exists in {}",
            manifest.name,
            other.display()
        ))
        .help("remove it first, because its folder is not named after the package"));
    }
    if there && !replace {
        let version = match &before {
            Some(Ok(before)) => format!(" {}", before.version),
            _ => String::new(),
        };
        let (name, new) = (&manifest.name, &manifest.version);
        let message = format!("a package {name}{version} already exists in {}", folder.display());
        return Err(Error::file(&folder, message).help(format!("replace it by {name} {new}: --replace")));
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
    Ok(Installation { manifest, folder, replaced, files: copy.files, bytes: copy.bytes })
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
        _ => return refuse("is not a package"),
    }
    match CHECKOUTS.iter().find(|inner| folder.join(inner).symlink_metadata().is_ok()) {
        Some(inner) => refuse(&format!("is a checkout with a folder {inner}")),
        None => Ok(()),
    }
}

/// Folders that mark a package under development, in contrast to an installed copy.
const CHECKOUTS: [&str; 5] = [".git", ".hg", ".svn", ".jj", ".bzr"];

/// Returns the folder in `into` that contains a package `name`, regardless of the folder's name.
fn find_other_folder(into: &Path, name: &str) -> Option<PathBuf> {
    let given = [into.to_path_buf()];
    let found =
        Packages::find(PackageSearch { given: &given, ..PackageSearch::default() }, &Version::new(0, 0, 0));
    Some(found.get(name)?.shown.clone())
}

/// Copies the files of the folder `from`.
fn copy_folder(from: &Path, copy: &mut PackageCopy) -> Result<()> {
    let cannot = |path: &Path, error: &io::Error| {
        Error::file(path, format!("cannot read {}: {error}", path.display()))
            .help("get read permission for the whole folder")
    };
    let mut folders = vec![String::new()];
    while let Some(folder) = folders.pop() {
        let path = from.join(&folder);
        let entries = fs::read_dir(&path).map_err(|error| cannot(&path, &error))?.take(MOST + 1);
        let mut names = Vec::new();
        for entry in entries {
            let entry = entry.map_err(|error| cannot(&path, &error))?;
            names.push(entry.file_name().into_string().map_err(|name| {
                let message =
                    format!("{} has a file {name:?} with a name that is not valid text", from.display());
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
            return Err(Error::limit(Limit::Size, message).help("remove files that scripts do not need"));
        }
    }
    Ok(())
}
