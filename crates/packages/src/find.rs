//! Finds the packages in some folders.

use std::collections::{BTreeSet, HashMap};
use std::path::{Path, PathBuf};

use burgeon_base::error::{Error, Result};
use burgeon_base::warning::Warning;
use semver::Version;

use super::manifest::{MANIFEST, Manifest};
use super::switches::{SWITCHES, disabled_names};
use super::{check, order};

/// The folder beside a script that its packages are in.
pub(crate) const BESIDE: &str = "mods";

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
    /// Whether it is to replace files and defaults of others by itself: it was put beside the script or given, or one of
    /// those depends on it.
    pub is_replacing: bool,
    /// Errors that stop every script that uses it; empty if it can be used.
    pub problems: Vec<Error>,
}

/// A package that is switched off in a file beside the script.
#[derive(Debug, Clone)]
pub struct DisabledPackage {
    /// Its name.
    pub name: String,
    /// Its version.
    pub version: Version,
    /// Its folder as people find it.
    pub shown: PathBuf,
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

/// The packages that there are, those that others depend on first, and otherwise by name.
#[derive(Debug, Clone, Default)]
pub struct Packages {
    packages: Vec<Package>,
    /// The places of `packages` by name.
    places: HashMap<String, usize>,
    /// The folders that were searched, and those that would be if they were there, without links.
    pub(crate) roots: Vec<PathBuf>,
    /// The paths that decide which packages there are, and whether something is there.
    sought: Vec<(PathBuf, bool)>,
    /// Packages of which others count.
    pub hidden: Vec<HiddenPackage>,
    /// Packages that are switched off.
    pub disabled: Vec<DisabledPackage>,
    /// The names that are switched off, sorted, and the file that says so as people find it.
    pub(crate) off: (Vec<String>, PathBuf),
    /// Packages that cannot be read. No script that does not use them is stopped.
    pub broken: Vec<BrokenPackage>,
    /// Errors that stop every script: folders that were named and are not there.
    pub problems: Vec<Error>,
    /// Warnings about all packages, used or not.
    pub warnings: Vec<Warning>,
    /// Warnings for scripts that use the package of the name.
    pub(crate) notices: Vec<(String, Warning)>,
}

impl Package {
    /// Whether its replacements count. A package that cannot be used replaces nothing.
    pub fn replaces(&self) -> bool {
        self.is_replacing && self.problems.is_empty()
    }
}

impl Packages {
    /// The packages in the folders of `search`, for scripts of version `api` of the script API.
    ///
    /// Only each `mod.toml` is read. Errors in a package are kept with it until a script uses it.
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
                // Whoever puts a link there means what it leads to, such as a checkout.
                match root.canonicalize() {
                    Ok(root) if root.is_dir() => {
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

    /// All of them: each after those that it depends on, and else by name.
    pub fn order(&self) -> &[Package] {
        &self.packages
    }

    pub(crate) fn order_mut(&mut self) -> &mut [Package] {
        &mut self.packages
    }

    /// The package called `name`.
    pub fn get(&self, name: &str) -> Option<&Package> {
        self.place_in_order(name).map(|place| &self.packages[place])
    }

    /// Where the package called `name` stands in the order.
    pub(crate) fn place_in_order(&self, name: &str) -> Option<usize> {
        self.places.get(name).copied()
    }

    /// Whether the packages called `name` are switched off.
    pub(crate) fn is_off(&self, name: &str) -> bool {
        self.off.0.binary_search_by(|known| known.as_str().cmp(name)).is_ok()
    }

    /// Every path that decides which packages there are and what they say, and whether something is there: the folders
    /// that were searched, each `mod.toml`, and the file that switches packages off.
    pub fn sought(&self) -> Vec<(PathBuf, bool)> {
        let roots = self.roots.iter().map(|root| (root.clone(), root.is_dir()));
        self.sought.iter().cloned().chain(roots).collect()
    }

    /// The package `name` and all that it needs, in order.
    pub fn with_dependencies(&self, name: &str) -> Vec<&Package> {
        self.closure(name, false)
    }

    /// The package `name` and all that comes before it, since it needs it or uses it if it is there, in order.
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

    /// The package that cannot be read in a folder called `name`.
    pub(crate) fn broken_called(&self, name: &str) -> Option<&BrokenPackage> {
        self.broken.iter().find(|broken| broken.folder.file_name().is_some_and(|it| it == name))
    }

    fn warn(&mut self, error: Error) {
        let warning = Warning::new(burgeon_base::WarningKind::BrokenPackage, error.message());
        let warning = warning.help(error.remedy().unwrap_or("burgeon mods check tells more"));
        self.warnings.push(warning.at(error.place().cloned()));
    }

    /// Adds the packages in the folder `root`, which people find as `shown`.
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
                // A link leads to a package that is worked on elsewhere.
                Ok(place) => {
                    let there = place.join(MANIFEST).symlink_metadata().is_ok();
                    if there {
                        self.add(place, shown, origin);
                    } else if place.is_dir() {
                        // It may become one.
                        self.sought.push((folder.join(MANIFEST), false));
                    }
                }
                Err(_) if folder.is_symlink() => {
                    let message = format!("{} is a link that leads to nothing", shown.display());
                    let error = Error::file(&shown, message).help("remove it, or put a package there");
                    self.sought.push((folder.join(MANIFEST), false));
                    self.broken.push(BrokenPackage { folder, error });
                }
                // It is gone by now.
                Err(_) => {}
            }
        }
    }

    /// Adds the package in `folder`, unless there is one of that name already.
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
            // Whoever uses it is told which one is not meant.
            known.problems.push(error.clone());
            return self.broken.push(BrokenPackage { folder, error });
        }
        // The user's folder is there for all scripts, and each may have versions of its own.
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
