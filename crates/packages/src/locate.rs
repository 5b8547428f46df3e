//! Which file a name such as `@castle/towers.lua` means.

use std::fmt;
use std::path::{Path, PathBuf};

use burgeon_base::error::{Error, Result};
use burgeon_base::names::{has_bidi_controls, normal_form};

use super::check::unmatched;
use super::find::{Package, Packages};
use super::install::MOST;
use super::manifest::{MANIFEST, Replacement, is_name};

/// The name of a package's file.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord)]
pub struct FileName {
    /// The package.
    pub package: String,
    /// The file from the package's folder, with `/` between its parts; empty for the package itself.
    pub path: String,
}

impl fmt::Display for FileName {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let separator = if self.path.is_empty() { "" } else { "/" };
        write!(f, "@{}{separator}{}", self.package, self.path)
    }
}

impl FileName {
    /// Whether a name that a script gives is meant to be that of a package's file.
    pub fn is_meant(name: &str) -> bool {
        name.starts_with('@')
    }

    /// Reads `@castle/towers.lua`. Fails for what leads out of the package, and for a name that no package can have.
    pub fn parse(name: &str) -> Result<Self> {
        let inner = name.strip_prefix('@').unwrap_or(name);
        let (package, path) = inner.split_once('/').unwrap_or((inner, ""));
        if !name.starts_with('@') || !is_name(package) {
            return Err(Error::file(name, format!("{name:?} names no file of a package"))
                .help("write \"@castle/stone.png\" for stone.png of the package castle"));
        }
        let leads_out = |part: &str| part == ".." || part.contains(['\\', ':', '\0']);
        if path.starts_with('/') || path.split('/').any(leads_out) {
            return Err(Error::file(name, format!("{name} leads outside the package {package}"))
                .help(format!("name a file in its folder or below it: \"@{package}/stone.png\"")));
        }
        if has_bidi_controls(path) {
            return Err(Error::file(
                name,
                format!("{} has a character that turns text round", name.escape_unicode()),
            )
            .help("rename the file: such names do not read as they are written"));
        }
        let parts: Vec<&str> = path.split('/').filter(|part| !part.is_empty() && *part != ".").collect();
        Ok(Self { package: package.to_owned(), path: normal_form(&parts.join("/")).into_owned() })
    }

    /// Reads `@castle/towers`, without an ending, as the name of a script: `towers.lua` of that package, `init.lua` where
    /// it is the package's own name.
    pub fn script(name: &str) -> Result<Self> {
        let Self { package, path } = Self::parse(name)?;
        let path = if path.is_empty() { "init.lua".to_owned() } else { format!("{path}.lua") };
        Ok(Self { package, path })
    }
}

/// The file that a name means.
#[derive(Debug, Clone)]
pub struct PackageFile<'a> {
    /// Its own name: that of the file that counts, where others replace the one that was asked for.
    pub name: FileName,
    /// Where it is, without links.
    pub path: PathBuf,
    /// How people find it.
    pub shown: PathBuf,
    /// The package that it is of.
    pub package: &'a Package,
}

impl Packages {
    /// The file that `name` means, which is to be a `what`, where a file of the package `asker` asks for it; the script's
    /// own files may ask for all.
    ///
    /// A file in whose place another package has its own means that one: that of the last package in order. A package
    /// that replaces a file still finds, by its name, the one that it replaces. `seek` is told of each path that decides
    /// the answer, and whether a file is there.
    pub fn locate(
        &self,
        what: &'static str,
        name: &FileName,
        asker: Option<&Package>,
        seek: &mut dyn FnMut(&Path, bool),
    ) -> Result<PackageFile<'_>> {
        let owner = self.used(&name.package, asker, seek)?;
        let (mut package, mut path) = (owner, name.path.clone());
        let mut by = None;
        while let Some((replacing, replacement)) = self.replacing(package, &path, asker) {
            (package, path) = (replacing, replacement.file.clone());
            by = Some(replacement);
        }
        let wanted = spelling(&package.folder, &path);
        let shown = package.shown.join(&path);
        let found = wanted.canonicalize();
        seek(&wanted, found.is_ok());
        match found {
            Ok(found) if found.starts_with(&package.folder) => {
                let name = FileName { package: package.manifest.name.clone(), path };
                Ok(PackageFile { name, path: found, shown, package })
            }
            Ok(_) => Err(Error::file(
                &shown,
                format!(
                    "{} is a link that leads outside the package {}",
                    shown.display(),
                    package.manifest.name
                ),
            )
            .help("a package has only files in its own folder")),
            Err(_) => Err(missing(what, name, package, &path, by)),
        }
    }

    /// The package `name`, for `asker`.
    fn used(
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
                && let Some(wanted) = asker.manifest.wanted().find(|wanted| wanted.name == name)
                && !wanted.versions.matches(&package.manifest.version)
            {
                let place = asker.manifest.place(wanted.line);
                return Err(unmatched(self, &asker.manifest, wanted, package).at(Some(place)));
            }
            return match package.problems.as_slice() {
                [] => Ok(package),
                problems => Err(Error::several(problems.to_vec())),
            };
        }
        if self.is_off(name) {
            let file = self.off.1.display();
            return Err(Error::file(name, format!("the package {name} is switched off in {file}"))
                .help(format!("switch it on: burgeon mods enable {name}")));
        }
        if let Some(broken) = self.broken_called(name) {
            return Err(broken.error.clone());
        }
        for root in &self.roots {
            seek(&root.join(name).join(MANIFEST), false);
        }
        let known = self.order().iter().map(|package| package.manifest.name.as_str());
        let message = format!("there is no package {name}");
        Err(Error::not_found("package", name, known, message).help(
            "put its folder into mods/ beside the script, or name the folder that it is in: --mods FOLDER",
        ))
    }

    /// The package that replaces a file of another for `asker`, and how.
    fn replacing(
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

    /// The packages that replace a file of `of`, in order, each with its place in the order.
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

    /// The name of the package whose file counts in the place of `target`, if any replaces it.
    pub fn replacer(&self, target: &FileName) -> Option<&str> {
        let of = self.get(&target.package)?;
        self.replacements(of, &target.path).next_back().map(|(_, package, _)| package.manifest.name.as_str())
    }

    /// The files of `package` that others replace, each with the package whose file counts.
    pub fn replaced(&self, package: &Package) -> Vec<(FileName, &str)> {
        let replacing = self.order().iter().filter(|other| other.replaces());
        let targets = replacing.flat_map(|other| other.manifest.replaces.iter().map(|one| &one.target));
        let mut files: Vec<FileName> =
            targets.filter(|target| target.package == package.manifest.name).cloned().collect();
        files.sort();
        files.dedup();
        files.into_iter().filter_map(|file| Some((file.clone(), self.replacer(&file)?))).collect()
    }

    /// The package whose file people find as `shown`.
    pub fn owner(&self, shown: &Path) -> Option<&Package> {
        self.order().iter().find(|package| shown.starts_with(&package.shown))
    }

    /// The names behind which packages have a file called `name`, which a script has named without a package.
    pub fn having(&self, name: &str) -> Vec<String> {
        let sound = FileName::parse(&format!("@own/{name}")).is_ok_and(|sound| !sound.path.is_empty());
        let having = self.order().iter().filter(|package| sound && package.folder.join(name).is_file());
        having.map(|package| format!("@{}/{name}", package.manifest.name)).collect()
    }
}

impl Package {
    /// The error for what it uses of a package that it does not depend on.
    pub fn not_declared(&self, other: &str) -> Error {
        let message = format!("the package {} does not depend on {other}", self.manifest.name);
        Error::scope(message).help(format!("write into its mod.toml, below [depends]: {other} = \"*\""))
    }

    /// Its Lua files from its folder, sorted.
    pub fn scripts(&self) -> Vec<String> {
        let mut scripts = Vec::new();
        let mut folders = vec![String::new()];
        while let Some(inner) = folders.pop() {
            let entries = std::fs::read_dir(self.folder.join(&inner)).into_iter().flatten().flatten();
            for entry in entries.take(MOST) {
                let Ok(name) = entry.file_name().into_string() else { continue };
                let path = if inner.is_empty() { name.clone() } else { format!("{inner}/{name}") };
                // What a link leads to is looked at where it is.
                let Ok(kind) = entry.file_type() else { continue };
                if kind.is_dir() && !name.starts_with('.') && folders.len() < MOST {
                    folders.push(path);
                } else if kind.is_file() && name.ends_with(".lua") {
                    scripts.push(path);
                }
            }
        }
        scripts.sort();
        scripts
    }
}

impl Packages {
    /// What `package` replaces with a file that it has not, or of a package that has no such file.
    pub fn check_files(&self, package: &Package) -> Vec<Error> {
        let mut problems = Vec::new();
        for one in &package.manifest.replaces {
            let own = FileName { package: package.manifest.name.clone(), path: one.file.clone() };
            for name in [&one.target, &own] {
                // As it is without what others replace.
                let Some(owner) = self.get(&name.package) else { continue };
                if !owner.folder.join(&name.path).is_file() {
                    let error = missing("file", name, owner, &name.path, None);
                    problems.push(error.rather_at(Some(package.manifest.place(one.line))));
                }
            }
        }
        problems
    }
}

/// The path of the file `path` in `folder` as it is written there: its name may not be in normal form.
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

/// The error for a file that is not there; `by` is why it is looked for there.
fn missing(
    what: &'static str,
    name: &FileName,
    package: &Package,
    path: &str,
    by: Option<&Replacement>,
) -> Error {
    let folder = package.folder.join(path);
    let near = folder.parent().and_then(|folder| {
        let entries = std::fs::read_dir(folder).ok()?;
        let mut names: Vec<String> =
            entries.filter_map(|entry| entry.ok()?.file_name().into_string().ok()).collect();
        names.sort();
        let wanted =
            folder.file_name().filter(|_| path.is_empty()).map(|name| name.to_string_lossy().into_owned());
        let wanted = wanted.unwrap_or_else(|| path.rsplit('/').next().unwrap_or_default().to_owned());
        burgeon_base::error::nearest(&wanted, names.iter().map(String::as_str)).map(str::to_owned)
    });
    let message = match by {
        None => format!("the package {} has no {what} {path}", package.manifest.name),
        Some(_) => format!(
            "the package {} has no {what} {path}, which it puts in the place of {name}",
            package.manifest.name
        ),
    };
    let shown = package.shown.display();
    let error = Error::not_found(what, path, near.as_deref(), message);
    let error = error.at(by.map(|by| package.manifest.place(by.line)));
    error.help(format!("it is looked for in {shown}"))
}
