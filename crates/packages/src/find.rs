//! Finds the packages in a list of folders.

use std::collections::{BTreeSet, HashMap};
use std::path::{Path, PathBuf};

use burgeon_base::error::{Error, Result};
use burgeon_base::warning::Warning;
use semver::Version;

use super::manifest::{MANIFEST, Manifest};
use super::switches::{SWITCHES, disabled_names};
use super::{check, order};

/// Name of the packages folder next to a script.
pub(crate) const BESIDE: &str = "mods";

/// Maximum number of entries in a packages folder.
const MOST: usize = 10_000;

/// Folders to search for packages. If several packages have the same name, the one next to the script takes precedence,
/// then one in the specified folders, then the user's.
#[derive(Debug, Clone, Default)]
pub struct PackageSearch {
    /// Folder of the script, as named, if there is a script.
    pub script: Option<PathBuf>,
    /// Specified folders, each a package or a folder of packages.
    pub given: Vec<PathBuf>,
    /// User's packages folder, which need not exist.
    pub user: Option<PathBuf>,
}

/// Origin of a package.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum PackageOrigin {
    /// In `mods/` next to the script.
    Beside,
    /// In a specified folder.
    Given,
    /// In the user's folder. Such a package is available by name, and replaces nothing unless it is required.
    User,
}

/// Package that was found.
#[derive(Debug, Clone)]
pub struct Package {
    /// Content of its `mod.toml`.
    pub manifest: Manifest,
    /// Folder of the package, with links resolved.
    pub folder: PathBuf,
    /// Folder of the package as displayed to users.
    pub shown: PathBuf,
    /// Origin of the package.
    pub origin: PackageOrigin,
    /// Set if the package replaces files and defaults of others: its folder is next to the script or was specified, or
    /// a package for which that is true depends on it.
    pub is_replacing: bool,
    /// Errors that stop every script that uses the package; empty if it can be used.
    pub problems: Vec<Error>,
}

/// Package that is disabled in a file next to the script.
#[derive(Debug, Clone)]
pub struct DisabledPackage {
    /// Name of the package.
    pub name: String,
    /// Version of the package.
    pub version: Version,
    /// Folder of the package as displayed to users.
    pub shown: PathBuf,
}

/// Package that is not used because another one with the same name takes precedence.
#[derive(Debug, Clone)]
pub struct HiddenPackage {
    /// Name of the package.
    pub name: String,
    /// Version of the package.
    pub version: Version,
    /// Folder of the package as displayed to users.
    pub shown: PathBuf,
    /// Folder of the package that takes precedence.
    pub by: PathBuf,
}

/// Folder with an invalid `mod.toml`.
#[derive(Debug, Clone)]
pub struct BrokenPackage {
    /// Folder of the package.
    pub folder: PathBuf,
    /// Error in the file.
    pub error: Error,
}

/// Available packages, in dependency order and otherwise by name.
#[derive(Debug, Clone, Default)]
pub struct Packages {
    packages: Vec<Package>,
    /// Indices into `packages` by name.
    places: HashMap<String, usize>,
    /// Folders that were searched, and missing folders that would be searched if they existed, with links resolved.
    pub(crate) roots: Vec<PathBuf>,
    /// Paths that determine the available packages, each with a flag that is set if the path exists.
    sought: Vec<(PathBuf, bool)>,
    /// Packages over which others take precedence.
    pub hidden: Vec<HiddenPackage>,
    /// Disabled packages.
    pub disabled: Vec<DisabledPackage>,
    /// Disabled names, sorted, and the path of the file that lists them, as displayed to users.
    pub(crate) off: (Vec<String>, PathBuf),
    /// Packages that cannot be read. They only stop scripts that use them.
    pub broken: Vec<BrokenPackage>,
    /// Errors that stop every script: specified folders that do not exist.
    pub problems: Vec<Error>,
    /// Warnings about all packages, used or not.
    pub warnings: Vec<Warning>,
    /// Warnings for scripts that use the package with that name.
    pub(crate) notices: Vec<(String, Warning)>,
}

impl Package {
    /// Returns true if the package's replacements are effective. A package with problems replaces nothing.
    pub fn replaces(&self) -> bool {
        self.is_replacing && self.problems.is_empty()
    }
}

impl Packages {
    /// Finds the packages in the folders of `search`, for scripts with version `api` of the script API.
    ///
    /// Only each `mod.toml` is read. Errors in a package are stored with it until a script uses it.
    pub fn find(search: &PackageSearch, api: &Version) -> Self {
        let mut found = Self::default();
        if let Some(script) = &search.script {
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
        for given in &search.given {
            match given.canonicalize() {
                Ok(root) if root.join(MANIFEST).is_file() => {
                    found.add(root, given.clone(), PackageOrigin::Given)
                }
                Ok(root) if root.is_dir() => found.search(&root, given, PackageOrigin::Given),
                _ => {
                    let shown = given.display();
                    found.sought.push((given.clone(), false));
                    let error = Error::not_found("folder", &shown, [], format!("there is no folder {shown}"));
                    found.problems.push(error.help("--mods names a folder of packages"));
                }
            }
        }
        if let Some(user) = &search.user {
            match user.canonicalize() {
                Ok(root) if root.is_dir() => found.search(&root, user, PackageOrigin::User),
                Ok(_) => {}
                Err(_) => found.roots.push(user.clone()),
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
        let places = found.packages.iter().enumerate().map(|(place, it)| (it.manifest.name.clone(), place));
        found.places = places.collect();
        check::check(&mut found, api, circles);
        found
    }

    /// Returns all packages in dependency order and otherwise by name.
    pub fn order(&self) -> &[Package] {
        &self.packages
    }

    pub(crate) fn order_mut(&mut self) -> &mut [Package] {
        &mut self.packages
    }

    /// Returns the package called `name`.
    pub fn get(&self, name: &str) -> Option<&Package> {
        self.place_in_order(name).map(|place| &self.packages[place])
    }

    /// Returns the index of the package called `name` in the order.
    pub(crate) fn place_in_order(&self, name: &str) -> Option<usize> {
        self.places.get(name).copied()
    }

    /// Returns true if packages called `name` are disabled.
    pub(crate) fn is_off(&self, name: &str) -> bool {
        self.off.0.binary_search_by(|known| known.as_str().cmp(name)).is_ok()
    }

    /// Returns every path that determines the available packages and their properties: the folders that were searched,
    /// each `mod.toml`, and the file that disables packages. The flag of each path is set if the path exists.
    pub fn sought(&self) -> Vec<(PathBuf, bool)> {
        let roots = self.roots.iter().map(|root| (root.clone(), root.is_dir()));
        self.sought.iter().cloned().chain(roots).collect()
    }

    /// Returns the package `name` and all packages that it requires, in order.
    pub fn with_dependencies(&self, name: &str) -> Vec<&Package> {
        self.closure(name, false)
    }

    /// Returns the package `name` and all packages that precede it as required or as optional dependencies, in order.
    pub(crate) fn with_wanted(&self, name: &str) -> Vec<&Package> {
        self.closure(name, true)
    }

    fn closure(&self, name: &str, with_optional: bool) -> Vec<&Package> {
        let mut wanted: BTreeSet<usize> = self.place_in_order(name).into_iter().collect();
        let mut next: Vec<usize> = wanted.iter().copied().collect();
        while let Some(place) = next.pop() {
            let manifest = &self.packages[place].manifest;
            let optional = manifest.optional.iter().filter(|_| with_optional);
            for dependency in manifest.depends.iter().chain(optional) {
                if let Some(other) = self.place_in_order(&dependency.name)
                    && wanted.insert(other)
                {
                    next.push(other);
                }
            }
        }
        wanted.into_iter().map(|place| &self.packages[place]).collect()
    }

    /// Returns the package that cannot be read in a folder called `name`.
    pub(crate) fn broken_called(&self, name: &str) -> Option<&BrokenPackage> {
        self.broken.iter().find(|broken| broken.folder.file_name().is_some_and(|it| it == name))
    }

    fn warn(&mut self, error: Error) {
        let warning = Warning::new(burgeon_base::WarningKind::BrokenPackage, error.message());
        let warning = warning.help(error.remedy().unwrap_or("burgeon mods check tells more"));
        self.warnings.push(warning.at(error.place().cloned()));
    }

    /// Adds the packages in the folder `root`, which is displayed to users as `shown`.
    fn search(&mut self, root: &Path, shown: &Path, origin: PackageOrigin) {
        self.roots.push(root.to_path_buf());
        let names = match names(root) {
            Ok(names) => names,
            Err(error) => {
                let error = Error::file(shown, format!("cannot look into {}: {error}", shown.display()))
                    .help("packages are folders with a mod.toml in it");
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
                    let message = format!("{} is a link that leads to nothing", shown.display());
                    let error = Error::file(&shown, message).help("remove it, or put a package there");
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
        let Some(known) = self.places.get(&manifest.name).map(|place| &mut self.packages[*place]) else {
            let is_replacing = origin != PackageOrigin::User;
            let problems = Vec::new();
            self.places.insert(manifest.name.clone(), self.packages.len());
            return self.packages.push(Package { manifest, folder, shown, origin, is_replacing, problems });
        };
        if known.folder == folder {
            return;
        }
        let (name, version) = (manifest.name.clone(), manifest.version.clone());
        let both = format!("{} {} in {}", name, known.manifest.version, known.shown.display());
        if known.shown.parent() == shown.parent() {
            let error = Error::data(format!(
                "there are two packages {name}: {both}, and {version} in {}",
                shown.display()
            ))
            .help("remove one of them")
            .at(Some(manifest.begin()));
            // Users of either package learn of the conflict.
            known.problems.push(error.clone());
            return self.broken.push(BrokenPackage { folder, error });
        }
        // The user's folder is shared by all scripts, and each script may have its own versions.
        if origin != PackageOrigin::User {
            let message = format!("{name} {version} in {} is not used, for there is {both}", shown.display());
            let warning = Warning::new(burgeon_base::WarningKind::HiddenPackage, message);
            let warning = warning.at(Some(manifest.begin())).help("remove the one that is not meant");
            self.warnings.push(warning.clone());
            self.notices.push((name.clone(), warning));
        }
        let by = known.shown.clone();
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
