//! Packages that were found, and queries of them.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

use burgeon_base::error::Error;
use burgeon_base::warning::Warning;
use semver::Version;

use super::manifest::Manifest;

/// Name of the packages folder next to a script.
pub(crate) const BESIDE: &str = "mods";

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
    pub(super) packages: Vec<Package>,
    /// Indices into `packages`, sorted by name.
    pub(super) places: Vec<usize>,
    /// Folders that were searched, and missing folders that would be searched if they existed, with links resolved.
    pub(crate) roots: Vec<PathBuf>,
    /// Paths that determine the available packages, each with a flag that is set if the path exists.
    pub(super) sought: Vec<(PathBuf, bool)>,
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
    /// Indices of the warnings for scripts that use the package with that name.
    notices: Vec<(String, usize)>,
}

impl Package {
    /// Returns true if the package's replacements are effective. A package with problems replaces nothing.
    pub fn replaces(&self) -> bool {
        self.is_replacing && self.problems.is_empty()
    }
}

impl Packages {
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
        self.search_places(name).ok().map(|found| self.places[found])
    }

    /// Returns the index in `places` of the package called `name`, or the index where it would be inserted.
    pub(crate) fn search_places(&self, name: &str) -> Result<usize, usize> {
        self.places.binary_search_by(|place| self.packages[*place].manifest.name.as_str().cmp(name))
    }

    /// Adds a warning for scripts that use the package called `users`.
    pub(crate) fn notify(&mut self, users: String, warning: Warning) {
        self.notices.push((users, self.warnings.len()));
        self.warnings.push(warning);
    }

    /// Returns the warnings for scripts that use the package called `name`.
    pub fn notices(&self, name: &str) -> impl Iterator<Item = &Warning> {
        let own = self.notices.iter().filter(move |(users, _)| users == name);
        own.filter_map(|(_, index)| self.warnings.get(*index))
    }

    /// Returns true if packages called `name` are disabled.
    pub(crate) fn is_off(&self, name: &str) -> bool {
        self.off.0.binary_search_by(|known| known.as_str().cmp(name)).is_ok()
    }

    /// Returns every path that determines the available packages and their properties: the folders that were searched,
    /// each `mod.toml`, and the file that disables packages. The flag of each path is set if the path exists.
    pub fn searched_paths(&self) -> impl Iterator<Item = (&Path, bool)> {
        let roots = self.roots.iter().map(|root| (&**root, root.is_dir()));
        self.sought.iter().map(|(path, exists)| (&**path, *exists)).chain(roots)
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
}
