//! Access to the files of packages, for the scripts of a run.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

use super::param::Param;
use super::session::Session;
use burgeon_base::error::{Error, Result, SourcePlace};
use burgeon_base::locks::LockRecovery;
use burgeon_packages::{FileName, LockedPackage, Package, PackageFile};

/// File name of the presets of a package.
const PRESETS: &str = "presets.json";

impl Session {
    /// Returns the package of the file with the display name `file`; `None` for the script's own files.
    pub(crate) fn package_of(&self, file: &str) -> Option<&Package> {
        let packages = self.packages();
        if packages.order().is_empty() { None } else { packages.owner(Path::new(file)) }
    }

    /// Finds the package file `name` of type `what`, such as `@castle/stone.png`, for a file of the package
    /// `asker`. Records the paths that were searched.
    pub(crate) fn locate(
        &self,
        what: &'static str,
        name: &FileName,
        asker: Option<&Package>,
    ) -> Result<PackageFile<'_>> {
        let located = self.packages().locate(what, name, asker, &mut |path, there| self.seek(path, there))?;
        if let Some(package) = self.packages().get(&name.package) {
            self.together(package)?;
        }
        // The file can belong to a package that replaces it.
        self.together(located.package)?;
        Ok(located)
    }

    /// Returns the names of the packages that the run has used.
    pub(crate) fn used_packages(&self) -> BTreeSet<String> {
        self.used.lock().recover().clone()
    }

    /// Returns the packages that the run has used, in order, with versions and content hashes. Fails if a
    /// package cannot be read.
    pub fn lock(&self) -> Result<Vec<LockedPackage>> {
        let used = self.used.lock().recover();
        self.packages().lock(|name| used.contains(name))
    }

    /// Returns the preset files of the packages that replace files, and of the packages that the script has
    /// used.
    pub fn package_presets(&self) -> Vec<(String, PathBuf)> {
        let used = self.used.lock().recover();
        let meant = |package: &&Package| package.replaces() || used.contains(&package.manifest.name);
        let found = self.packages().order().iter().filter(meant).filter_map(|package| {
            let file = FileName::new(&package.manifest.name, PRESETS);
            let located = self.packages().locate("presets file", &file, None, &mut |_, _| {}).ok()?;
            Some((file.package, located.path))
        });
        found.collect()
    }

    /// Returns the paths of these preset files, and whether each file exists.
    pub fn package_preset_places(&self) -> Vec<(PathBuf, bool)> {
        let used = self.used.lock().recover();
        let packages = self.packages().order().iter();
        let meant = packages.filter(|package| package.replaces() || used.contains(&package.manifest.name));
        let place = |package: &Package| {
            let path = package.folder.join(PRESETS);
            let exists = path.is_file();
            (path, exists)
        };
        meant.map(place).collect()
    }

    /// Returns true if there is a package `name` that `asker` can use. The script can use all packages.
    pub(crate) fn has_package(&self, name: &str, asker: Option<&Package>) -> bool {
        let Some(package) = self.packages().get(name) else { return false };
        let wanted = asker.and_then(|asker| asker.manifest.dependencies().find(|wanted| wanted.name == name));
        package.problems.is_empty()
            && wanted.is_none_or(|wanted| wanted.versions.matches(&package.manifest.version))
    }

    /// Adds a package and its dependencies to the used packages. Fails if they conflict with packages used
    /// before.
    fn together(&self, package: &Package) -> Result<()> {
        let mut used = self.used.lock().recover();
        if used.contains(&package.manifest.name) {
            return Ok(());
        }
        let packages = self.packages();
        let needed = packages.with_dependencies(&package.manifest.name);
        let names = needed.iter().map(|package| &*package.manifest.name);
        let new: Vec<&str> = names.filter(|name| !used.contains(*name)).collect();
        let problems = packages.conflicts(|name| used.contains(name) || new.contains(&name));
        if !problems.is_empty() {
            return Err(Error::several(problems));
        }
        new.iter().flat_map(|name| packages.notices(name)).for_each(|warning| self.warn(warning.clone()));
        used.extend(new.into_iter().map(str::to_owned));
        Ok(())
    }

    /// Finds a package file if `name` has a package prefix; otherwise returns `None`.
    pub(crate) fn package_file(
        &self,
        what: &'static str,
        name: &str,
        asker: Option<&Package>,
    ) -> Option<Result<PackageFile<'_>>> {
        if !FileName::is_meant(name) {
            return None;
        }
        Some(FileName::parse(name).and_then(|name| self.locate(what, &name, asker)))
    }

    /// Returns the errors for strings in a file that name files of packages which the file's package does not
    /// depend on.
    pub(super) fn undeclared(&self, file: &str, texts: &[(String, usize)]) -> Vec<Error> {
        let Some(owner) = self.package_of(file) else { return Vec::new() };
        let refused = texts.iter().filter_map(|(text, line)| {
            let name = FileName::parse(text).ok()?;
            let known = self.packages().get(&name.package).is_some();
            let error =
                (known && !owner.manifest.may_use(&name.package)).then(|| owner.not_declared(&name.package));
            Some(error?.at_line(file, *line))
        });
        refused.collect()
    }

    /// Returns the errors for strings in a file of `package` that name missing files of packages.
    pub(crate) fn missing(&self, package: &Package, file: &str, texts: &[(String, usize)]) -> Vec<Error> {
        let missing = texts.iter().filter_map(|(text, line)| {
            let name = FileName::parse(self.file_name(text)).ok().filter(|name| !name.path.is_empty())?;
            self.packages().get(&name.package)?;
            let error = self.locate("file", &name, Some(package)).err()?;
            let script = FileName { path: format!("{}.lua", name.path), ..name };
            // The argument of `require` has no file extension.
            let found = self.locate("file", &script, Some(package)).is_ok();
            (!found).then(|| error.rather_at(Some(SourcePlace::new(file, *line))))
        });
        missing.collect()
    }

    /// Returns the part of an argument of `source` that names a file.
    fn file_name<'a>(&self, text: &'a str) -> &'a str {
        self.options.registry.sources().map_or(text, |sources| sources.file_name(text))
    }

    /// Adds to an `error` about a missing file `name` the packages that have such a file, if any.
    pub(crate) fn propose_packages(&self, name: &str, error: Error) -> Error {
        match self.packages().files_called(name).as_slice() {
            [] => error,
            names => {
                error.help(format!("a package file needs the name of its package: {}", names.join(" or ")))
            }
        }
    }

    /// Sets the default of a parameter, declared in a file of `owner`, to the default that another package
    /// defines, if one does. The name of `param` does not have its package prefix yet.
    pub(crate) fn redefault(&self, param: &mut Param, owner: &Package) -> Result<()> {
        for package in self.packages().order().iter().filter(|package| package.replaces()) {
            let manifest = &package.manifest;
            let mut params = manifest.params.iter();
            let wanted = params.find(|it| it.package == owner.manifest.name && it.name == param.name);
            let Some(wanted) = wanted else { continue };
            self.together(package)?;
            param.default = param.accept(&wanted.value).map_err(|error| {
                let message =
                    format!("the default set by the package {}: {}", manifest.name, error.message());
                error.saying(message).help("change it").at(Some(wanted.place(manifest)))
            })?;
            param.value = param.default.clone();
        }
        Ok(())
    }
}
