//! Resolves names of files such as `@castle/towers.lua`.

use std::path::{Path, PathBuf};

use burgeon_base::error::{Error, Result};
use burgeon_base::names::normal_form;

use super::check::version_mismatch;
use super::copy::MOST;
use super::manifest::{MANIFEST, Replacement};
use super::names::FileName;
use super::package::{Package, Packages};

/// File that a name refers to.
#[derive(Debug, Clone)]
pub struct PackageFile<'a> {
    /// Name of the effective file, which may replace the requested one.
    pub name: FileName,
    /// Path of the file, with links resolved.
    pub path: PathBuf,
    /// Path as displayed to users.
    pub shown: PathBuf,
    /// Package that contains the file.
    pub package: &'a Package,
}

impl Packages {
    /// Resolves `name` to a file of type `what`, requested by a file of the package `asker`. Without an `asker`, a file
    /// of the script requests it, which may use all packages.
    ///
    /// If other packages replace the file, the replacement of the last package in order is returned. A package that
    /// replaces a file can still refer by name to the file that it replaces. `seek` is called for each path that
    /// affects the result, with a flag that is set if the file exists.
    ///
    /// ```
    /// use burgeon_packages::{FileName, PackageSearch, Packages, Version};
    ///
    /// let folder = tempfile::tempdir()?;
    /// let castle = folder.path().join("mods/castle");
    /// std::fs::create_dir_all(&castle)?;
    /// std::fs::write(castle.join("mod.toml"), "name = \"castle\"\nversion = \"1.2.0\"\napi = \"1.0\"\n")?;
    /// std::fs::write(castle.join("towers.lua"), "return {}")?;
    /// let search = PackageSearch { script: Some(folder.path()), ..PackageSearch::default() };
    /// let packages = Packages::find(search, &Version::new(1, 0, 0));
    /// let mut locate = |name| packages.locate("script", &FileName::script(name)?, None, &mut |_, _| {});
    /// assert!(locate("@castle/towers")?.path.ends_with("mods/castle/towers.lua"));
    /// assert!(locate("@castle/walls").is_err());
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn locate(
        &self,
        what: &'static str,
        name: &FileName,
        asker: Option<&Package>,
        seek: &mut dyn FnMut(&Path, bool),
    ) -> Result<PackageFile<'_>> {
        let owner = self.usable_package(&name.package, asker, seek)?;
        let (mut package, mut path) = (owner, &*name.path);
        let mut by = None;
        while let Some((replacing, replacement)) = self.find_replacement(package, path, asker) {
            (package, path) = (replacing, &*replacement.file);
            by = Some((replacement, name));
        }
        let wanted = spelling(&package.folder, path);
        let shown = package.shown.join(path);
        let found = wanted.canonicalize();
        seek(&wanted, found.is_ok());
        match found {
            Ok(found) if found.starts_with(&package.folder) => {
                let name = FileName::new(&package.manifest.name, path);
                Ok(PackageFile { name, path: found, shown, package })
            }
            Ok(_) => Err(Error::file(
                &shown,
                format!(
                    "{} is a link to a file outside the package {}",
                    shown.display(),
                    package.manifest.name
                ),
            )
            .help("a package can use only files in its own folder")),
            Err(_) => Err(missing_file(what, package, path, by)),
        }
    }

    /// Returns the package `name`, if `asker` may use it.
    fn usable_package(
        &self,
        name: &str,
        asker: Option<&Package>,
        seek: &mut dyn FnMut(&Path, bool),
    ) -> Result<&Package> {
        if let Some(asker) = asker
            && !asker.manifest.may_use(name)
        {
            return Err(asker.not_declared(name));
        }
        if let Some(package) = self.get(name) {
            if let Some(asker) = asker
                && let Some(wanted) = asker.manifest.dependencies().find(|wanted| wanted.name == name)
                && !wanted.versions.matches(&package.manifest.version)
            {
                let place = asker.manifest.place(wanted.line);
                return Err(version_mismatch(self, &asker.manifest, wanted, package).at(Some(place)));
            }
            return match package.problems.as_slice() {
                [] => Ok(package),
                problems => Err(Error::several(problems.to_vec())),
            };
        }
        if self.is_off(name) {
            let file = self.off.1.display();
            return Err(Error::file(name, format!("the package {name} is disabled in {file}"))
                .help(format!("enable it: burgeon mods enable {name}")));
        }
        if let Some(broken) = self.broken_called(name) {
            return Err(broken.error.clone());
        }
        for root in &self.roots {
            seek(&root.join(name).join(MANIFEST), false);
        }
        let known = self.order().iter().map(|package| package.manifest.name.as_str());
        let message = format!("unknown package `{name}`");
        Err(Error::not_found("package", name, known, message).help(
            "put its folder into mods/ next to the script, or specify its parent folder: --mods FOLDER",
        ))
    }

    /// Returns the package that replaces a file of another package for `asker`, and the replacement.
    fn find_replacement(
        &self,
        of: &Package,
        path: &str,
        asker: Option<&Package>,
    ) -> Option<(&Package, &Replacement)> {
        let is = |one: &&Replacement| one.target.package == of.manifest.name && one.target.path == path;
        let before =
            asker.filter(|asker| asker.replaces() && asker.manifest.replaces.iter().any(|one| is(&one)));
        let before = before.and_then(|asker| self.place_in_order(&asker.manifest.name));
        let found = self.replacements(of, path).rev();
        let mut found = found.filter(|(place, ..)| before.is_none_or(|before| *place < before));
        found.next().map(|(_, package, replacement)| (package, replacement))
    }

    /// Returns the packages that replace a file of `of`, in order, each with its index in the order.
    pub(crate) fn replacements<'a>(
        &'a self,
        of: &Package,
        path: &str,
    ) -> impl DoubleEndedIterator<Item = (usize, &'a Package, &'a Replacement)> {
        let replacing = self.order().iter().enumerate().filter(|(_, package)| package.replaces());
        replacing.filter_map(move |(place, package)| {
            let one = package
                .manifest
                .replaces
                .iter()
                .find(|one| one.target.package == of.manifest.name && one.target.path == path)?;
            Some((place, package, one))
        })
    }

    /// Returns the name of the package whose file effectively replaces `target`, if any.
    pub fn replacer(&self, target: &FileName) -> Option<&str> {
        let of = self.get(&target.package)?;
        self.replacements(of, &target.path).next_back().map(|(_, package, _)| package.manifest.name.as_str())
    }

    /// Returns the files of `package` that others replace, each with the package of the effective replacement.
    pub fn replaced_files(&self, package: &Package) -> Vec<(&FileName, &str)> {
        let replacing = self.order().iter().filter(|other| other.replaces());
        let targets = replacing.flat_map(|other| other.manifest.replaces.iter().map(|one| &one.target));
        let mut files: Vec<&FileName> =
            targets.filter(|target| target.package == package.manifest.name).collect();
        files.sort();
        files.dedup();
        files.into_iter().filter_map(|file| Some((file, self.replacer(file)?))).collect()
    }

    /// Returns the package of the file with the displayed path `shown`.
    pub fn owner(&self, shown: &Path) -> Option<&Package> {
        self.order().iter().find(|package| shown.starts_with(&package.shown))
    }

    /// Returns the qualified names of files called `name` in all packages, for a script that used the name without a
    /// package.
    pub fn files_called(&self, name: &str) -> Vec<String> {
        let sound = FileName::parse(&format!("@own/{name}")).is_ok_and(|sound| !sound.path.is_empty());
        let having = self.order().iter().filter(|package| sound && package.folder.join(name).is_file());
        having.map(|package| format!("@{}/{name}", package.manifest.name)).collect()
    }
}

impl Package {
    /// Returns the error for the use of a package that is not declared as a dependency.
    pub fn not_declared(&self, other: &str) -> Error {
        let message = format!("the package {} does not depend on {other}", self.manifest.name);
        Error::scope(message).help(format!("add to its mod.toml, below [depends]: {other} = \"*\""))
    }

    /// Returns the paths of its Lua files relative to its folder, sorted.
    pub fn scripts(&self) -> Vec<String> {
        let mut scripts = Vec::new();
        let mut folders = vec![String::new()];
        while let Some(inner) = folders.pop() {
            let entries = std::fs::read_dir(self.folder.join(&inner)).into_iter().flatten().flatten();
            for entry in entries.take(MOST) {
                let Ok(name) = entry.file_name().into_string() else { continue };
                // Targets of links are listed at their own location.
                let Ok(kind) = entry.file_type() else { continue };
                let list = if kind.is_dir() && !name.starts_with('.') && folders.len() < MOST {
                    &mut folders
                } else if kind.is_file() && name.ends_with(".lua") {
                    &mut scripts
                } else {
                    continue;
                };
                list.push(if inner.is_empty() { name } else { format!("{inner}/{name}") });
            }
        }
        scripts.sort();
        scripts
    }
}

impl Packages {
    /// Returns an error for each replacement in `package` whose own file or target does not exist.
    pub fn check_files(&self, package: &Package) -> Vec<Error> {
        let mut problems = Vec::new();
        for one in &package.manifest.replaces {
            let own = (&package.manifest.name, &one.file);
            for (owner, path) in [(&one.target.package, &one.target.path), own] {
                // Without the replacements of other packages.
                let Some(owner) = self.get(owner) else { continue };
                if !owner.folder.join(path).is_file() {
                    let error = missing_file("file", owner, path, None);
                    problems.push(error.rather_at(Some(package.manifest.place(one.line))));
                }
            }
        }
        problems
    }
}

/// Returns the path of the file `path` in `folder` as spelled on disk, which may differ in Unicode normalisation.
fn spelling(folder: &Path, path: &str) -> PathBuf {
    let plain = folder.join(path);
    if path.is_ascii() || plain.symlink_metadata().is_ok() {
        return plain;
    }
    let mut found = folder.to_path_buf();
    for part in path.split('/') {
        let plain = found.join(part);
        let other = || {
            let entries = std::fs::read_dir(&found).ok()?.take(MOST).flatten();
            let mut same: Vec<_> = entries
                .map(|entry| entry.file_name())
                .filter(|name| name.to_str().is_some_and(|name| normal_form(name) == part))
                .collect();
            same.sort();
            same.into_iter().next()
        };
        found = match plain.symlink_metadata() {
            Ok(_) => plain,
            Err(_) => other().map_or(plain, |name| found.join(name)),
        };
    }
    found
}

/// Returns the error for a missing file; `by` is the replacement that refers to it, with the requested name.
fn missing_file(
    what: &'static str,
    package: &Package,
    path: &str,
    by: Option<(&Replacement, &FileName)>,
) -> Error {
    let folder = package.folder.join(path);
    let near = folder.parent().and_then(|folder| {
        let entries = std::fs::read_dir(folder).ok()?;
        let mut names: Vec<String> =
            entries.filter_map(|entry| entry.ok()?.file_name().into_string().ok()).collect();
        names.sort();
        let wanted = folder.file_name().filter(|_| path.is_empty()).map(|name| name.to_string_lossy());
        let wanted = wanted.unwrap_or_else(|| path.rsplit('/').next().unwrap_or_default().into());
        burgeon_base::error::nearest(&wanted, names.iter().map(String::as_str)).map(str::to_owned)
    });
    let message = match by {
        None => format!("the package {} has no {what} {path}", package.manifest.name),
        Some((_, name)) => {
            format!("the package {} has no {what} {path}, its replacement for {name}", package.manifest.name)
        }
    };
    let shown = package.shown.display();
    let error = Error::not_found(what, path, near.as_deref(), message);
    let error = error.at(by.map(|(by, _)| package.manifest.place(by.line)));
    error.help(format!("the expected location is {shown}"))
}
