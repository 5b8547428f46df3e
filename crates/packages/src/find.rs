//! Finds the packages in some folders.

use std::path::{Path, PathBuf};

use burgeon_base::error::{Error, Result};
use burgeon_base::warning::Warning;
use semver::Version;

use super::manifest::{MANIFEST, Manifest};
use super::{check, order};

/// The folder beside a script that its packages are in.
const BESIDE: &str = "mods";

/// The most entries that a folder of packages may have.
const MOST: usize = 10_000;

/// Where packages may be. Who comes first, wins: of packages of one name, the one beside the script counts, then those in
/// the folders that are given, then that of the user.
#[derive(Debug, Clone, Default)]
pub struct PackageSearch {
    /// The folder that the script is in, as it was named, if there is a script.
    pub script: Option<PathBuf>,
    /// Folders that are given, each a package or a folder of packages.
    pub given: Vec<PathBuf>,
    /// The user's own folder of packages, which need not be there.
    pub user: Option<PathBuf>,
}

/// Where a package was found.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum PackageOrigin {
    /// In `mods/` beside the script.
    Beside,
    /// In a folder that was given.
    Given,
    /// In the user's folder. Such a package is there for whoever names it, and replaces nothing by itself.
    User,
}

/// A package that was found.
#[derive(Debug, Clone)]
pub struct Package {
    /// What it says of itself.
    pub manifest: Manifest,
    /// Its folder, without links.
    pub folder: PathBuf,
    /// Its folder as people find it.
    pub shown: PathBuf,
    /// Where it was found.
    pub origin: PackageOrigin,
    /// Whether what it replaces counts: it was put beside the script or given, or one of those depends on it.
    pub is_replacing: bool,
    /// Why it cannot be used; empty if it can.
    pub problems: Vec<Error>,
}

/// A package that is not used, since another one of its name comes first.
#[derive(Debug, Clone)]
pub struct HiddenPackage {
    /// Its name.
    pub name: String,
    /// Its version.
    pub version: Version,
    /// Its folder as people find it.
    pub shown: PathBuf,
    /// The folder of the one that counts.
    pub by: PathBuf,
}

/// A folder with a `mod.toml` that is wrong.
#[derive(Debug, Clone)]
pub struct BrokenPackage {
    /// The folder.
    pub folder: PathBuf,
    /// What is wrong.
    pub error: Error,
}

/// The packages that there are, those that others depend on first, and else by name.
#[derive(Debug, Clone, Default)]
pub struct Packages {
    packages: Vec<Package>,
    /// The folders that were searched, without links.
    pub(crate) roots: Vec<PathBuf>,
    /// Packages of which others count.
    pub hidden: Vec<HiddenPackage>,
    /// Packages that cannot be read.
    pub broken: Vec<BrokenPackage>,
    /// Why no script can be run with these packages; empty if one can.
    pub problems: Vec<Error>,
    /// What people should know.
    pub warnings: Vec<Warning>,
}

impl Packages {
    /// The packages in the folders of `search`, for scripts of version `api` of the script API.
    ///
    /// Only each `mod.toml` is read. What is wrong is kept: with those in the user's folder, until someone asks for them.
    pub fn find(search: &PackageSearch, api: &Version) -> Self {
        let mut found = Self::default();
        if let Some(script) = &search.script {
            let folder = if script.as_os_str().is_empty() { Path::new(".") } else { script };
            if let Ok(script_root) = folder.canonicalize() {
                let root = script_root.join(BESIDE);
                // A link may lead anywhere.
                match root.canonicalize() {
                    Ok(root) if root.starts_with(&script_root) && root.is_dir() => {
                        found.search(&root, &script.join(BESIDE), PackageOrigin::Beside);
                    }
                    Ok(_) => {}
                    // There may be one soon.
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
                    let error = Error::not_found("folder", &shown, [], format!("there is no folder {shown}"));
                    found.problems.push(error.help("--mods names a folder of packages"));
                }
            }
        }
        if let Some(user) = &search.user
            && let Ok(root) = user.canonicalize()
            && root.is_dir()
        {
            found.search(&root, user, PackageOrigin::User);
        }
        let (packages, circles) = order::sort(std::mem::take(&mut found.packages));
        found.packages = packages;
        check::check(&mut found, api, circles);
        found
    }

    /// All of them: each after those that it depends on, and else by name.
    pub fn order(&self) -> &[Package] {
        &self.packages
    }

    pub(crate) fn order_mut(&mut self) -> &mut [Package] {
        &mut self.packages
    }

    /// The package called `name`.
    pub fn get(&self, name: &str) -> Option<&Package> {
        self.packages.iter().find(|package| package.manifest.name == name)
    }

    /// Where the package called `name` stands in the order.
    pub(crate) fn place_in_order(&self, name: &str) -> Option<usize> {
        self.packages.iter().position(|package| package.manifest.name == name)
    }

    /// Every `mod.toml` that was read, which decides what the names of files mean.
    pub fn manifests(&self) -> impl Iterator<Item = PathBuf> {
        let folders = self.packages.iter().map(|package| &package.folder);
        folders.chain(self.broken.iter().map(|broken| &broken.folder)).map(|folder| folder.join(MANIFEST))
    }

    /// The package `name` and all that it comes after, in order.
    pub fn with_dependencies(&self, name: &str) -> Vec<&Package> {
        let mut wanted = vec![name];
        let mut at = 0;
        while at < wanted.len() {
            let next = self.get(wanted[at]).into_iter().flat_map(|package| package.manifest.wanted());
            for dependency in next {
                if !wanted.contains(&&*dependency.name) {
                    wanted.push(&dependency.name);
                }
            }
            at += 1;
        }
        self.packages.iter().filter(|package| wanted.contains(&&*package.manifest.name)).collect()
    }

    /// Adds the packages in the folder `root`, which people find as `shown`.
    fn search(&mut self, root: &Path, shown: &Path, origin: PackageOrigin) {
        self.roots.push(root.to_path_buf());
        let names = match names(root) {
            Ok(names) => names,
            Err(error) => {
                let error = Error::file(shown, format!("cannot look into {}: {error}", shown.display()))
                    .help("packages are folders with a mod.toml in it");
                return self.problems.push(error);
            }
        };
        for name in names {
            let folder = root.join(&name);
            if folder.join(MANIFEST).symlink_metadata().is_err() {
                continue;
            }
            let shown = shown.join(&name);
            match folder.canonicalize() {
                Ok(folder) if folder.starts_with(root) => self.add(folder, shown, origin),
                Ok(_) => {
                    let message = format!("{} is a link that leads out of its folder", shown.display());
                    let error = Error::file(&shown, message);
                    let error = error.help("copy the package, or name where it is: --mods FOLDER");
                    self.add_broken(folder, error, origin);
                }
                // It is gone by now.
                Err(_) => {}
            }
        }
    }

    fn add_broken(&mut self, folder: PathBuf, error: Error, origin: PackageOrigin) {
        if origin != PackageOrigin::User {
            self.problems.push(error.clone());
        }
        self.broken.push(BrokenPackage { folder, error });
    }

    /// Adds the package in `folder`, unless there is one of that name already.
    fn add(&mut self, folder: PathBuf, shown: PathBuf, origin: PackageOrigin) {
        let manifest = match Manifest::read(&folder, &shown) {
            Ok(manifest) => manifest,
            Err(error) => return self.add_broken(folder, error, origin),
        };
        let known = self.packages.iter_mut().find(|known| known.manifest.name == manifest.name);
        let Some(known) = known else {
            let is_replacing = origin != PackageOrigin::User;
            let problems = Vec::new();
            return self.packages.push(Package { manifest, folder, shown, origin, is_replacing, problems });
        };
        if known.folder == folder {
            return;
        }
        let (name, version) = (manifest.name.clone(), manifest.version.clone());
        let both = format!("{} {} in {}", name, known.manifest.version, known.shown.display());
        if known.folder.parent() == folder.parent() {
            let error = Error::data(format!(
                "there are two packages {name}: {both}, and {version} in {}",
                shown.display()
            ))
            .help("remove one of them")
            .at(Some(manifest.begin()));
            // Whoever uses it is told which one is not meant.
            if origin == PackageOrigin::User {
                known.problems.push(error.clone());
            }
            return self.add_broken(folder, error, origin);
        }
        // The user's folder is there for all scripts, and each may have versions of its own.
        if origin != PackageOrigin::User {
            let message = format!("{name} {version} in {} is not used, for there is {both}", shown.display());
            let warning = Warning::new(burgeon_base::WarningKind::HiddenPackage, message);
            self.warnings.push(warning.at(Some(manifest.begin())).help("remove the one that is not meant"));
        }
        let by = known.shown.clone();
        self.hidden.push(HiddenPackage { name, version, shown, by });
    }
}

/// The names of what is in a folder, in their own order; what begins with a point is none of them.
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
