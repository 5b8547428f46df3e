//! Checks which packages can be used, alone and together.

use std::collections::{BTreeMap, BTreeSet, HashSet};

use burgeon_base::WarningKind;
use burgeon_base::error::{Error, Result};
use burgeon_base::warning::Warning;
use semver::Version;

use super::manifest::{Dependency, Manifest};
use super::order::DependencyCircle;
use super::package::{Package, PackageOrigin, Packages};

/// Maximum number of packages that an error names as the cause of another one's problem.
const MOST_CAUSES: usize = 20;

/// Stores at each package the reason that it cannot be used, and in `found` the warnings about packages.
pub(crate) fn check(found: &mut Packages, api: &Version, circles: Vec<DependencyCircle>) {
    let own: Vec<Vec<Error>> =
        found.order().iter().map(|package| problems(found, package, api, &circles)).collect();
    let all = inherit_problems(found, &own);
    let mut chosen: BTreeSet<&str> = BTreeSet::new();
    for package in found.order().iter().filter(|package| package.origin != PackageOrigin::User) {
        if !chosen.contains(&*package.manifest.name) {
            let wanted = found.with_wanted(&package.manifest.name);
            chosen.extend(wanted.into_iter().map(|package| &*package.manifest.name));
        }
    }
    let is_replacing = |package: &Package| chosen.contains(&*package.manifest.name);
    let replacing: Vec<bool> = found.order().iter().map(is_replacing).collect();
    for ((package, problems), is_replacing) in found.order_mut().iter_mut().zip(all).zip(replacing) {
        package.problems = problems;
        package.is_replacing = is_replacing;
    }
    let mut warnings = conflicting_replacements(found);
    warnings.extend(unused_packages(found));
    warnings.into_iter().for_each(|(users, warning)| found.notify(users, warning));
    let everyone: Vec<&Package> = found.order().iter().collect();
    let conflicts = everyone.iter().flat_map(|package| conflicts(package, &everyone));
    let conflicts: Vec<Warning> = conflicts
        .map(|error| {
            let warning = Warning::new(WarningKind::BrokenPackage, error.message());
            warning.help(error.remedy().unwrap_or_default()).at_place(error.place())
        })
        .collect();
    found.warnings.extend(conflicts);
}

impl Packages {
    /// Returns an error for each conflict between the packages whose names `used` accepts.
    pub fn conflicts(&self, used: impl Fn(&str) -> bool) -> Vec<Error> {
        let together: Vec<&Package> =
            self.order().iter().filter(|package| used(&package.manifest.name)).collect();
        together.iter().flat_map(|package| conflicts(package, &together)).collect()
    }

    /// Fails if a package with `manifest` requires packages that are missing or have other versions.
    pub fn check_needs(&self, manifest: &Manifest) -> Result<()> {
        let missing: Vec<Error> =
            manifest.depends.iter().filter_map(|wanted| need(self, manifest, wanted)).collect();
        if missing.is_empty() { Ok(()) } else { Err(Error::several(missing)) }
    }
}

/// Combines the problems of each package with the problems of the packages that it requires.
fn inherit_problems(found: &Packages, own: &[Vec<Error>]) -> Vec<Vec<Error>> {
    // Required packages come first in the order, except for packages in cycles, which have no order.
    let mut causes: Vec<BTreeSet<usize>> = Vec::with_capacity(own.len());
    for (place, package) in found.order().iter().enumerate() {
        let mut of: BTreeSet<usize> = (!own[place].is_empty()).then_some(place).into_iter().collect();
        for wanted in &package.manifest.depends {
            match found.place_in_order(&wanted.name) {
                Some(other) if other < place => of.extend(causes[other].iter().take(MOST_CAUSES)),
                Some(other) if other > place => {
                    let needed = found.with_dependencies(&wanted.name);
                    let places = needed.iter().filter_map(|it| found.place_in_order(&it.manifest.name));
                    of.extend(places.filter(|it| !own[*it].is_empty()).take(MOST_CAUSES));
                }
                _ => {}
            }
        }
        causes.push(of.into_iter().take(MOST_CAUSES).collect());
    }
    let of = causes.into_iter().map(|causes| {
        let mut known = HashSet::new();
        let all = causes.into_iter().flat_map(|place| own[place].iter());
        all.filter(|error| known.insert(error.to_string())).cloned().collect()
    });
    of.collect()
}

/// Returns an error for each of `together` that conflicts with `package`.
fn conflicts(package: &Package, together: &[&Package]) -> Vec<Error> {
    let with = |conflict: &Dependency| {
        let other = together.iter().find(|other| other.manifest.name == conflict.name)?;
        let versions = &conflict.versions;
        versions.matches(&other.manifest.version).then(|| {
            let (name, version) = (&other.manifest.name, &other.manifest.version);
            Error::data(format!("the package {} conflicts with {name} {version}", package.manifest.name))
                .help(format!("remove one of {} and {}", package.shown.display(), other.shown.display()))
                .at(Some(package.manifest.place(conflict.line)))
        })
    };
    package.manifest.conflicts.iter().filter_map(with).collect()
}

/// Returns the problems of `package` itself.
fn problems(found: &Packages, package: &Package, api: &Version, circles: &[DependencyCircle]) -> Vec<Error> {
    let manifest = &package.manifest;
    let name = &manifest.name;
    let mut problems = package.problems.clone();
    if !manifest.api.matches(api) {
        let message =
            format!("the package {name} needs version {} of the script API, but this is {api}", manifest.api);
        problems.push(
            Error::data(message)
                .help(format!("use a Burgeon with that version, or a {name} for this version"))
                .at(Some(manifest.place(manifest.api_line))),
        );
    }
    problems.extend(manifest.depends.iter().filter_map(|wanted| need(found, manifest, wanted)));
    for replaced in &manifest.replaces {
        if !manifest.dependencies().any(|wanted| wanted.name == replaced.target.package) {
            problems.push(undeclared_dependency(
                manifest,
                "replaces a file of",
                &replaced.target.package,
                replaced.line,
            ));
        }
    }
    for param in &manifest.params {
        if !manifest.dependencies().any(|wanted| wanted.name == param.package) {
            problems.push(undeclared_dependency(manifest, "sets a parameter of", &param.package, param.line));
        }
    }
    for circle in circles.iter().filter(|circle| circle.first() == Some(name)) {
        let line = manifest
            .depends
            .iter()
            .find(|wanted| Some(&wanted.name) == circle.get(1))
            .map_or(1, |it| it.line);
        problems.push(
            Error::data(format!("circular package dependency: {}", circle.join(" -> ")))
                .help("move the common part into a third package")
                .at(Some(manifest.place(line))),
        );
    }
    // Required packages are used together with the package, so none of them may conflict.
    let needed = found.with_dependencies(name);
    if needed.len() > 1 {
        problems.extend(needed.iter().flat_map(|package| conflicts(package, &needed)));
    }
    problems
}

/// Returns the error for the requirement `wanted` of a package with `manifest`, if it is not satisfied.
fn need(found: &Packages, manifest: &Manifest, wanted: &Dependency) -> Option<Error> {
    let place = Some(manifest.place(wanted.line));
    let (name, versions) = (&manifest.name, &wanted.versions);
    let Some(other) = found.get(&wanted.name) else {
        if found.is_off(&wanted.name) {
            let file = found.off.1.display();
            let message = format!("the package {name} needs {}, which is disabled in {file}", wanted.name);
            let help = format!("enable it: burgeon mods enable {}", wanted.name);
            return Some(Error::data(message).help(help).at(place));
        }
        let known = found.order().iter().map(|package| package.manifest.name.as_str());
        let message = format!("the package {name} needs {} {versions}, which is not installed", wanted.name);
        return Some(match found.broken_called(&wanted.name) {
            Some(broken) => {
                Error::data(message).help(format!("fix it first: {}", broken.error.message())).at(place)
            }
            None => Error::not_found("package", &wanted.name, known, message)
                .help("install it next to the other packages: burgeon mods add FOLDER")
                .at(place),
        });
    };
    (!versions.matches(&other.manifest.version))
        .then(|| version_mismatch(found, manifest, wanted, other).at(place))
}

/// Returns the error for a package whose version does not satisfy `manifest`.
pub(crate) fn version_mismatch(
    found: &Packages,
    manifest: &Manifest,
    wanted: &Dependency,
    other: &Package,
) -> Error {
    let (name, versions) = (&wanted.name, &wanted.versions);
    let (shown, version) = (other.shown.display(), &other.manifest.version);
    let message =
        format!("the package {} needs {name} {versions}, but {version} is in {shown}", manifest.name);
    let better = found.hidden.iter().find(|it| it.name == *name && versions.matches(&it.version));
    Error::data(message).help(match better {
        Some(better) => {
            format!("{} in {} is suitable: remove the other one", better.version, better.shown.display())
        }
        None => format!("install a {name} of that version"),
    })
}

fn undeclared_dependency(manifest: &Manifest, does: &str, other: &str, line: usize) -> Error {
    Error::data(format!("the package {} {does} {other}, but does not depend on it", manifest.name))
        .help(format!("write below [depends]: {other} = \"*\""))
        .at(Some(manifest.place(line)))
}

/// Returns the warnings about packages that exist but are not used: replacing packages with problems, and optional
/// packages of another version. Each warning comes with the package whose users receive it.
fn unused_packages(found: &Packages) -> Vec<(String, Warning)> {
    let mut warnings = Vec::new();
    for package in found.order() {
        let manifest = &package.manifest;
        let name = &manifest.name;
        if let (true, Some(problem)) = (package.is_replacing, package.problems.first()) {
            let targets: BTreeSet<&str> = manifest
                .replaces
                .iter()
                .map(|one| one.target.package.as_str())
                .chain(manifest.params.iter().map(|one| one.package.as_str()))
                .collect();
            for target in targets {
                let message = format!("{name} changes nothing of {target}: {}", problem.message());
                let warning = Warning::new(WarningKind::BrokenPackage, message);
                let help = problem.remedy().unwrap_or("run burgeon mods check for details");
                warnings.push((target.to_owned(), warning.help(help).at_place(problem.place())));
            }
        }
        for wanted in &manifest.optional {
            let Some(other) = found.get(&wanted.name) else { continue };
            let mismatch;
            let why = if !wanted.versions.matches(&other.manifest.version) {
                mismatch = version_mismatch(found, manifest, wanted, other);
                &mismatch
            } else if let Some(problem) = other.problems.first() {
                problem
            } else {
                continue;
            };
            let message =
                format!("{name} does not use its optional dependency {}: {}", wanted.name, why.message());
            let warning = Warning::new(WarningKind::BrokenPackage, message);
            let warning = warning.help(why.remedy().unwrap_or("run burgeon mods check for details"));
            warnings.push((name.clone(), warning.at(Some(manifest.place(wanted.line)))));
        }
    }
    warnings
}

/// Returns the warnings about files and defaults that two packages replace, each with the package that owns them. There
/// is no warning if the effective package depends on the other one, because it then replaces on purpose.
fn conflicting_replacements(found: &Packages) -> Vec<(String, Warning)> {
    let mut claims: BTreeMap<(String, &str), Vec<(&Package, usize)>> = BTreeMap::new();
    for package in found.order().iter().filter(|package| package.replaces()) {
        for one in &package.manifest.replaces {
            let key = (one.target.to_string(), &*one.target.package);
            claims.entry(key).or_default().push((package, one.line));
        }
        for param in &package.manifest.params {
            let what = format!("the default of {} of {}", param.name, param.package);
            claims.entry((what, &*param.package)).or_default().push((package, param.line));
        }
    }
    let mut warnings = Vec::new();
    for ((what, of), claims) in claims {
        for pair in claims.windows(2) {
            let [(first, line), (then, _)] = pair else { continue };
            let (name, wins) = (&first.manifest.name, &then.manifest.name);
            let knows = found.with_wanted(wins).iter().any(|package| package.manifest.name == *name);
            if !knows {
                let message = format!("{name} and {wins} both replace {what}; {wins} takes precedence");
                let help = format!(
                    "remove one of them, or add {name} to the dependencies of {wins} if this is intended"
                );
                let warning = Warning::new(WarningKind::ReplacedTwice, message);
                let warning = warning.help(help).at(Some(first.manifest.place(*line)));
                warnings.push((of.to_owned(), warning));
            }
        }
    }
    warnings
}
