//! The files of packages, as a run's scripts ask for them.

use std::path::{Path, PathBuf};

use super::param::Param;
use super::session::Session;
use burgeon_base::error::{Error, Result, SourcePlace};
use burgeon_base::locks::LockRecovery;
use burgeon_data::split_name;
use burgeon_packages::{FileName, Package, PackageFile};

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
        let located = self.packages().locate(what, name, asker, &mut |path, there| self.seek(path, there));
        if let Some(package) = self.packages().get(&name.package) {
            self.together(package)?;
        }
        located
    }

    /// The files of presets that packages have: of those that are there for this script, and of others that it has used.
    pub fn package_presets(&self) -> Vec<(String, PathBuf)> {
        let used = self.used.lock().recover().clone();
        let meant = |package: &&Package| package.is_replacing || used.contains(&package.manifest.name);
        let found = self.packages().order().iter().filter(meant).filter_map(|package| {
            let name = package.manifest.name.clone();
            let file = FileName { package: name.clone(), path: PRESETS.to_owned() };
            let located = self.packages().locate("file of presets", &file, None, &mut |_, _| {}).ok()?;
            Some((name, located.path))
        });
        found.collect()
    }

    /// Whether there is a package `name` that can be used.
    pub(crate) fn has_package(&self, name: &str) -> bool {
        self.packages().get(name).is_some_and(|package| package.problems.is_empty())
    }

    /// Refuses packages that cannot be used with others whose files were asked for before.
    fn together(&self, package: &Package) -> Result<()> {
        let mut used = self.used.lock().recover();
        if used.contains(&package.manifest.name) {
            return Ok(());
        }
        let needed = self.packages().with_dependencies(&package.manifest.name);
        used.extend(needed.iter().map(|package| package.manifest.name.clone()));
        let problems = self.packages().conflicts(|name| used.contains(name));
        if problems.is_empty() { Ok(()) } else { Err(Error::several(problems)) }
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
        match self.packages().having(name).as_slice() {
            [] => error,
            names => error.help(format!("a package's file is named with it: {}", names.join(" or "))),
        }
    }

    /// Gives a parameter that is declared in `place` the default that packages ask for, if any does.
    pub(crate) fn redefault(&self, param: &mut Param, place: Option<&SourcePlace>) -> Result<()> {
        let Some(owner) = place.and_then(|place| self.package_of(&place.file)) else { return Ok(()) };
        for package in self.packages().order().iter().filter(|package| package.is_replacing) {
            let manifest = &package.manifest;
            let mut params = manifest.params.iter();
            let wanted = params.find(|it| it.package == owner.manifest.name && it.name == param.name);
            let Some(wanted) = wanted else { continue };
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
