//! The files of packages, as a run's scripts ask for them.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

use super::param::Param;
use super::session::Session;
use burgeon_base::error::{Error, Result, SourcePlace};
use burgeon_base::locks::LockRecovery;
use burgeon_data::split_name;
use burgeon_packages::{FileName, LockedPackage, Package, PackageFile};

/// The file of a package's presets.
const PRESETS: &str = "presets.json";

impl Session {
    /// The package whose file people find as `file`; none for the script's own.
    pub(crate) fn package_of(&self, file: &str) -> Option<&Package> {
        let packages = self.packages();
        if packages.order().is_empty() { None } else { packages.owner(Path::new(file)) }
    }

    /// The file that `name` means, such as `@castle/stone.png`, which is to be a `what`, where a file of the package
    /// `asker` asks for it. Takes notice of what was looked for.
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
        // It may be of a package that has replaced the file.
        self.together(located.package)?;
        Ok(located)
    }

    /// The packages that the run has used, as they are, in order. Fails if one cannot be read.
    pub fn lock(&self) -> Result<Vec<LockedPackage>> {
        let used = self.used.lock().recover().clone();
        self.packages().lock(|name| used.contains(name))
    }

    /// The files of presets that packages have: of those that are there for this script, and of others that it has used.
    pub fn package_presets(&self) -> Vec<(String, PathBuf)> {
        let used = self.used.lock().recover().clone();
        let meant = |package: &&Package| package.replaces() || used.contains(&package.manifest.name);
        let found = self.packages().order().iter().filter(meant).filter_map(|package| {
            let name = package.manifest.name.clone();
            let file = FileName { package: name.clone(), path: PRESETS.to_owned() };
            let located = self.packages().locate("file of presets", &file, None, &mut |_, _| {}).ok()?;
            Some((name, located.path))
        });
        found.collect()
    }

    /// Where those packages have, or would have, their presets, and whether a file is there.
    pub fn package_preset_places(&self) -> Vec<(PathBuf, bool)> {
        let used = self.used.lock().recover().clone();
        let packages = self.packages().order().iter();
        let meant = packages.filter(|package| package.replaces() || used.contains(&package.manifest.name));
        let places = meant.map(|package| package.folder.join(PRESETS));
        places.map(|path| (path.clone(), path.is_file())).collect()
    }

    /// Whether there is a package `name` that `asker` can use; the script can use all.
    pub(crate) fn has_package(&self, name: &str, asker: Option<&Package>) -> bool {
        let Some(package) = self.packages().get(name) else { return false };
        let wanted = asker.and_then(|asker| asker.manifest.dependencies().find(|wanted| wanted.name == name));
        package.problems.is_empty()
            && wanted.is_none_or(|wanted| wanted.versions.matches(&package.manifest.version))
    }

    /// Refuses packages that cannot be used with others whose files were asked for before.
    fn together(&self, package: &Package) -> Result<()> {
        let mut used = self.used.lock().recover();
        if used.contains(&package.manifest.name) {
            return Ok(());
        }
        let packages = self.packages();
        let needed = packages.with_dependencies(&package.manifest.name);
        let new: Vec<String> = needed
            .iter()
            .map(|package| package.manifest.name.clone())
            .filter(|name| !used.contains(name))
            .collect();
        let together: BTreeSet<String> = used.iter().chain(&new).cloned().collect();
        let problems = packages.conflicts(|name| together.contains(name));
        if !problems.is_empty() {
            return Err(Error::several(problems));
        }
        new.iter().flat_map(|name| packages.notices(name)).for_each(|warning| self.warn(warning.clone()));
        *used = together;
        Ok(())
    }

    /// The file of a package that `name` means, if a name is that of one at all.
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

    /// The errors for the texts of a file that name files of packages which the package it is of does not depend on.
    pub(super) fn undeclared(&self, file: &str, texts: &[(String, usize)]) -> Vec<Error> {
        let Some(owner) = self.package_of(file) else { return Vec::new() };
        let refused = texts.iter().filter_map(|(text, line)| {
            let name = FileName::parse(text).ok()?;
            let known = self.packages().get(&name.package).is_some();
            let error =
                (known && !owner.manifest.may_use(&name.package)).then(|| owner.not_declared(&name.package));
            Some(error?.at(Some(SourcePlace { file: file.to_owned(), line: *line })))
        });
        refused.collect()
    }

    /// The errors for the texts in a file of `package` that name files of packages which are not there.
    pub(crate) fn missing(&self, package: &Package, file: &str, texts: &[(String, usize)]) -> Vec<Error> {
        let missing = texts.iter().filter_map(|(text, line)| {
            let name = FileName::parse(split_name(text).0).ok().filter(|name| !name.path.is_empty())?;
            self.packages().get(&name.package)?;
            let script = FileName { path: format!("{}.lua", name.path), ..name.clone() };
            let error = self.locate("file", &name, Some(package)).err()?;
            // What `require` takes has no extension.
            let found = self.locate("file", &script, Some(package)).is_ok();
            (!found).then(|| error.rather_at(Some(SourcePlace { file: file.to_owned(), line: *line })))
        });
        missing.collect()
    }

    /// Says of an `error` for a file called `name` that some package has one, if one has.
    pub(crate) fn propose_packages(&self, name: &str, error: Error) -> Error {
        match self.packages().files_called(name).as_slice() {
            [] => error,
            names => error.help(format!("a package's file is named with it: {}", names.join(" or "))),
        }
    }

    /// Gives a parameter that is declared in a file of `owner` the default that packages ask for, if any does. Its name is
    /// that without a package yet.
    pub(crate) fn redefault(&self, param: &mut Param, owner: &Package) -> Result<()> {
        for package in self.packages().order().iter().filter(|package| package.replaces()) {
            let manifest = &package.manifest;
            let mut params = manifest.params.iter();
            let wanted = params.find(|it| it.package == owner.manifest.name && it.name == param.name);
            let Some(wanted) = wanted else { continue };
            self.together(package)?;
            param.default = param.accept(&wanted.value).map_err(|error| {
                let message =
                    format!("the default that the package {} sets: {}", manifest.name, error.message());
                let help = error.remedy().unwrap_or("change it").to_owned();
                Error::of(error.kind().clone(), message).help(help).at(Some(wanted.place(manifest)))
            })?;
            param.value = param.default.clone();
        }
        Ok(())
    }
}
