//! Finds the packages in a list of folders.

use std::path::{Path, PathBuf};

use burgeon_base::error::{Error, Result};
use burgeon_base::warning::Warning;
use semver::Version;

use super::manifest::{MANIFEST, Manifest};
use super::package::{
    BESIDE, BrokenPackage, DisabledPackage, HiddenPackage, Package, PackageOrigin, Packages,
};
use super::switches::{SWITCHES, disabled_names};
use super::{check, order};

/// Maximum number of entries in a packages folder.
const MOST: usize = 10_000;

/// Folders to search for packages. If several packages have the same name, the one next to the script takes precedence,
/// then one in the specified folders, then the user's.
#[derive(Debug, Clone, Copy, Default)]
pub struct PackageSearch<'a> {
    /// Folder of the script, as named, if there is a script.
    pub script: Option<&'a Path>,
    /// Specified folders, each a package or a folder of packages.
    pub given: &'a [PathBuf],
    /// User's packages folder, which need not exist.
    pub user: Option<&'a Path>,
}

impl Packages {
    /// Finds the packages in the folders of `search`, for scripts with version `api` of the script API.
    ///
    /// Only each `mod.toml` is read. Errors in a package are stored with it until a script uses it.
    ///
    /// ```
    /// use burgeon_packages::{PackageSearch, Packages, Version};
    ///
    /// let folder = tempfile::tempdir()?;
    /// let castle = folder.path().join("mods/castle");
    /// std::fs::create_dir_all(&castle)?;
    /// std::fs::write(castle.join("mod.toml"), "name = \"castle\"\nversion = \"1.2.0\"\napi = \"1.0\"\n")?;
    /// let search = PackageSearch { script: Some(folder.path()), ..PackageSearch::default() };
    /// let packages = Packages::find(search, &Version::new(1, 0, 0));
    /// assert_eq!(packages.get("castle").map(|package| package.manifest.version.clone()), Some(Version::new(1, 2, 0)));
    /// assert!(packages.get("masonry").is_none());
    /// # Ok::<(), std::io::Error>(())
    /// ```
    pub fn find(search: PackageSearch<'_>, api: &Version) -> Self {
        let mut found = Self::default();
        if let Some(script) = search.script {
            let folder = if script.as_os_str().is_empty() { Path::new(".") } else { script };
            if let Ok(script_root) = folder.canonicalize() {
                let root = script_root.join(BESIDE);
                found.sought.push((root.join(SWITCHES), root.join(SWITCHES).exists()));
                match disabled_names(&root) {
                    Ok(names) => found.off = (names, script.join(BESIDE).join(SWITCHES)),
                    Err(error) => found.warn(error),
                }
                // A link there refers to its target, such as a checkout.
                match root.canonicalize() {
                    Ok(root) if root.is_dir() => {
                        found.search(&root, &script.join(BESIDE), PackageOrigin::Beside);
                    }
                    Ok(_) => {}
                    // The folder may be created later.
                    Err(_) => found.roots.push(root),
                }
            }
        }
        for given in search.given {
            match given.canonicalize() {
                Ok(root) if root.join(MANIFEST).is_file() => {
                    found.add(root, given.clone(), PackageOrigin::Given)
                }
                Ok(root) if root.is_dir() => found.search(&root, given, PackageOrigin::Given),
                _ => {
                    let shown = given.display();
                    found.sought.push((given.clone(), false));
                    let error = Error::not_found("folder", &shown, [], format!("folder not found: {shown}"));
                    found.problems.push(error.help("--mods needs a folder of packages"));
                }
            }
        }
        if let Some(user) = search.user {
            match user.canonicalize() {
                Ok(root) if root.is_dir() => found.search(&root, user, PackageOrigin::User),
                Ok(_) => {}
                Err(_) => found.roots.push(user.to_path_buf()),
            }
        }
        let off = std::mem::take(&mut found.packages);
        let (packages, off) = off.into_iter().partition::<Vec<_>, _>(|it| !found.is_off(&it.manifest.name));
        found.disabled.extend(off.into_iter().map(|package| DisabledPackage {
            name: package.manifest.name,
            version: package.manifest.version,
            shown: package.shown,
        }));
        let (packages, circles) = order::sort(packages);
        found.packages = packages;
        let mut places: Vec<usize> = (0..found.packages.len()).collect();
        places.sort_by_key(|place| &*found.packages[*place].manifest.name);
        found.places = places;
        check::check(&mut found, api, circles);
        found
    }

    fn warn(&mut self, error: Error) {
        let warning = Warning::new(burgeon_base::WarningKind::BrokenPackage, error.message());
        let warning = warning.help(error.remedy().unwrap_or("run burgeon mods check for details"));
        self.warnings.push(warning.at_place(error.place()));
    }

    /// Adds the packages in the folder `root`, which is displayed to users as `shown`.
    fn search(&mut self, root: &Path, shown: &Path, origin: PackageOrigin) {
        self.roots.push(root.to_path_buf());
        let names = match names(root) {
            Ok(names) => names,
            Err(error) => {
                let error =
                    Error::file(shown, format!("cannot read the folder {}: {error}", shown.display()))
                        .help("packages are folders that contain a mod.toml");
                return match origin {
                    PackageOrigin::Given => self.problems.push(error),
                    _ => self.warn(error),
                };
            }
        };
        for name in names {
            let (folder, shown) = (root.join(&name), shown.join(&name));
            match folder.canonicalize() {
                // The target of a link is a package under development elsewhere.
                Ok(place) => {
                    let there = place.join(MANIFEST).symlink_metadata().is_ok();
                    if there {
                        self.add(place, shown, origin);
                    } else if place.is_dir() {
                        // The folder may become a package.
                        self.sought.push((folder.join(MANIFEST), false));
                    }
                }
                Err(_) if folder.is_symlink() => {
                    let message = format!("{} is a broken link", shown.display());
                    let error = Error::file(&shown, message).help("remove it, or replace it by a package");
                    self.sought.push((folder.join(MANIFEST), false));
                    self.broken.push(BrokenPackage { folder, error });
                }
                // The entry has been deleted in the meantime.
                Err(_) => {}
            }
        }
    }

    /// Adds the package in `folder`, unless a package with that name exists.
    fn add(&mut self, folder: PathBuf, shown: PathBuf, origin: PackageOrigin) {
        self.sought.push((folder.join(MANIFEST), true));
        let manifest = match Manifest::read(&folder, &shown) {
            Ok(manifest) => manifest,
            Err(error) => return self.broken.push(BrokenPackage { folder, error }),
        };
        let known = match self.search_places(&manifest.name) {
            Ok(found) => &mut self.packages[self.places[found]],
            Err(missing) => {
                let is_replacing = origin != PackageOrigin::User;
                let problems = Vec::new();
                self.places.insert(missing, self.packages.len());
                return self.packages.push(Package {
                    manifest,
                    folder,
                    shown,
                    origin,
                    is_replacing,
                    problems,
                });
            }
        };
        if known.folder == folder {
            return;
        }
        let begin = manifest.begin();
        let Manifest { name, version, .. } = manifest;
        let both = format!("{} {} in {}", name, known.manifest.version, known.shown.display());
        if known.shown.parent() == shown.parent() {
            let error = Error::data(format!(
                "duplicate package {name}: {both}, and {version} in {}",
                shown.display()
            ))
            .help("remove one of them")
            .at(Some(begin));
            // Users of either package learn of the conflict.
            known.problems.push(error.clone());
            return self.broken.push(BrokenPackage { folder, error });
        }
        // The user's folder is shared by all scripts, and each script may have its own versions.
        let by = known.shown.clone();
        if origin != PackageOrigin::User {
            let message = format!("ignored {name} {version} in {}: {both} takes precedence", shown.display());
            let warning = Warning::new(burgeon_base::WarningKind::HiddenPackage, message);
            self.notify(name.clone(), warning.at(Some(begin)).help("remove one of them"));
        }
        self.hidden.push(HiddenPackage { name, version, shown, by });
    }
}

/// Returns the sorted names of the entries of a folder, without hidden ones that begin with a dot.
fn names(root: &Path) -> Result<Vec<String>, std::io::Error> {
    let entries = std::fs::read_dir(root)?.take(MOST + 1);
    let mut names: Vec<String> =
        entries.filter_map(|entry| entry.ok()?.file_name().into_string().ok()).collect();
    if names.len() > MOST {
        return Err(std::io::Error::other(format!("it has more than {MOST} entries")));
    }
    names.retain(|name| !name.starts_with('.'));
    names.sort();
    Ok(names)
}
