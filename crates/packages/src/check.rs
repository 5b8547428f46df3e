//! Whether packages can be used together.

use std::collections::BTreeMap;

use burgeon_base::WarningKind;
use burgeon_base::error::Error;
use burgeon_base::warning::Warning;
use semver::Version;

use super::find::{Package, PackageOrigin, Packages};
use super::order::DependencyCircle;

/// Notes at each package why it cannot be used, and at `found` what those that are chosen lack.
pub(crate) fn check(found: &mut Packages, api: &Version, circles: Vec<DependencyCircle>) {
    let own: Vec<Vec<Error>> =
        found.order().iter().map(|package| problems(found, package, api, &circles)).collect();
    // What is wrong with a package is wrong with all that need it.
    let all: Vec<Vec<Error>> = found
        .order()
        .iter()
        .map(|package| {
            let needed = found.with_dependencies(&package.manifest.name);
            let needed = needed.into_iter().filter_map(|one| found.place_in_order(&one.manifest.name));
            let mut all: Vec<Error> = needed.flat_map(|place| own[place].clone()).collect();
            let mut known = Vec::new();
            all.retain(|error| {
                let text = error.to_string();
                let new = !known.contains(&text);
                known.push(text);
                new
            });
            all
        })
        .collect();
    let chosen: Vec<String> = found
        .order()
        .iter()
        .filter(|package| package.origin != PackageOrigin::User)
        .flat_map(|package| found.with_dependencies(&package.manifest.name))
        .map(|package| package.manifest.name.clone())
        .collect();
    for (package, problems) in found.order_mut().iter_mut().zip(all) {
        package.problems = problems;
        package.is_replacing = chosen.contains(&package.manifest.name);
    }
    let mut problems: Vec<Error> = found
        .order()
        .iter()
        .zip(own)
        .filter(|(package, _)| package.is_replacing)
        .flat_map(|(_, problems)| problems)
        .collect();
    problems.extend(found.conflicts(|_| false));
    let mut known = Vec::new();
    problems.retain(|error| {
        let text = error.to_string();
        let new = !known.contains(&text);
        known.push(text);
        new
    });
    let warnings = contested(found);
    found.problems.extend(problems);
    found.warnings.extend(warnings);
}

impl Packages {
    /// What is wrong with using the packages together whose names `used` takes.
    pub fn conflicts(&self, used: impl Fn(&str) -> bool) -> Vec<Error> {
        let together: Vec<&Package> = self
            .order()
            .iter()
            .filter(|package| package.is_replacing || used(&package.manifest.name))
            .collect();
        together.iter().flat_map(|package| conflicts(package, &together)).collect()
    }
}

/// The errors for those of `together` that `package` cannot be used with.
fn conflicts(package: &Package, together: &[&Package]) -> Vec<Error> {
    let with = |conflict: &super::Dependency| {
        let other = together.iter().find(|other| other.manifest.name == conflict.name)?;
        let versions = &conflict.versions;
        versions.matches(&other.manifest.version).then(|| {
            let (name, version) = (&other.manifest.name, &other.manifest.version);
            Error::data(format!("the package {} cannot be used with {name} {version}", package.manifest.name))
                .help(format!("remove one of {} and {}", package.shown.display(), other.shown.display()))
                .at(Some(package.manifest.place(conflict.line)))
        })
    };
    package.manifest.conflicts.iter().filter_map(with).collect()
}

/// What is wrong with `package` itself.
fn problems(found: &Packages, package: &Package, api: &Version, circles: &[DependencyCircle]) -> Vec<Error> {
    let manifest = &package.manifest;
    let name = &manifest.name;
    let mut problems = package.problems.clone();
    if !manifest.api.matches(api) {
        let message = format!(
            "the package {name} is made for version {} of the script API, and this is {api}",
            manifest.api
        );
        problems.push(
            Error::data(message)
                .help(format!("get a Burgeon with that version, or a {name} for this one"))
                .at(Some(manifest.place(manifest.api_line))),
        );
    }
    for wanted in &manifest.depends {
        let place = Some(manifest.place(wanted.line));
        let versions = &wanted.versions;
        match found.get(&wanted.name) {
            None => {
                let known = found.order().iter().map(|package| package.manifest.name.as_str());
                let message =
                    format!("the package {name} needs {} {versions}, which is not there", wanted.name);
                let broken =
                    found.broken.iter().any(|it| it.folder.file_name().is_some_and(|it| it == &*wanted.name));
                problems.push(match broken {
                    true => Error::data(message).help("its mod.toml cannot be read").at(place),
                    false => Error::not_found("package", &wanted.name, known, message)
                        .help("put it beside the other packages: burgeon mods add FOLDER")
                        .at(place),
                });
            }
            Some(other) if !versions.matches(&other.manifest.version) => {
                problems.push(unmatched(found, package, wanted, other).at(place));
            }
            Some(_) => {}
        }
    }
    // What is optional is not used in a version that does not fit, and that could not be seen.
    for wanted in &manifest.optional {
        if let Some(other) =
            found.get(&wanted.name).filter(|it| !wanted.versions.matches(&it.manifest.version))
        {
            problems.push(unmatched(found, package, wanted, other).at(Some(manifest.place(wanted.line))));
        }
    }
    for replaced in &manifest.replaces {
        if !manifest.wanted().any(|wanted| wanted.name == replaced.target.package) {
            problems.push(undeclared(
                manifest,
                "replaces a file of",
                &replaced.target.package,
                replaced.line,
            ));
        }
    }
    for param in &manifest.params {
        if !manifest.wanted().any(|wanted| wanted.name == param.package) {
            problems.push(undeclared(manifest, "sets a parameter of", &param.package, param.line));
        }
    }
    for circle in circles.iter().filter(|circle| circle.first() == Some(name)) {
        let line =
            manifest.wanted().find(|wanted| Some(&wanted.name) == circle.get(1)).map_or(1, |it| it.line);
        problems.push(
            Error::data(format!("packages depend on each other in a circle: {}", circle.join(" -> ")))
                .help("move what both need into a third package")
                .at(Some(manifest.place(line))),
        );
    }
    problems
}

/// The error for a package of another version than `package` wants.
fn unmatched(found: &Packages, package: &Package, wanted: &super::Dependency, other: &Package) -> Error {
    let (name, versions) = (&wanted.name, &wanted.versions);
    let (shown, version) = (other.shown.display(), &other.manifest.version);
    let message =
        format!("the package {} needs {name} {versions}, but {version} is in {shown}", package.manifest.name);
    let better = found.hidden.iter().find(|it| it.name == *name && versions.matches(&it.version));
    Error::data(message).help(match better {
        Some(better) => {
            format!("{} in {} would do: remove the other one", better.version, better.shown.display())
        }
        None => format!("get a {name} of that version"),
    })
}

fn undeclared(manifest: &super::Manifest, does: &str, other: &str, line: usize) -> Error {
    Error::data(format!("the package {} {does} {other}, which it does not depend on", manifest.name))
        .help(format!("write below [depends]: {other} = \"*\""))
        .at(Some(manifest.place(line)))
}

/// Warns of what two packages replace, unless the one that counts depends on the other: then it knows.
fn contested(found: &Packages) -> Vec<Warning> {
    let mut claims: BTreeMap<String, Vec<(&Package, usize)>> = BTreeMap::new();
    for package in found.order().iter().filter(|package| package.is_replacing) {
        for one in &package.manifest.replaces {
            claims.entry(one.target.to_string()).or_default().push((package, one.line));
        }
        for param in &package.manifest.params {
            let what = format!("the default of {} of {}", param.name, param.package);
            claims.entry(what).or_default().push((package, param.line));
        }
    }
    let mut warnings = Vec::new();
    for (what, claims) in claims {
        for pair in claims.windows(2) {
            let [(first, line), (then, _)] = pair else { continue };
            let (name, wins) = (&first.manifest.name, &then.manifest.name);
            let knows = found.with_dependencies(wins).iter().any(|package| package.manifest.name == *name);
            if !knows {
                let message = format!("{name} and {wins} both replace {what}, and that of {wins} counts");
                let help = format!("remove one of them, or let {wins} depend on {name} if that is meant");
                let warning = Warning::new(WarningKind::ReplacedTwice, message);
                warnings.push(warning.help(help).at(Some(first.manifest.place(*line))));
            }
        }
    }
    warnings
}
