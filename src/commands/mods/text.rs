//! Output of `burgeon mods`.

use std::fmt::Write as _;

use burgeon::packages::{Dependency, Package, PackageOrigin, Packages};
use serde_json::{Value, json};

use crate::commands::report;

/// Lists all packages as text.
pub(super) fn list(packages: &Packages) -> String {
    let mut text = String::new();
    for package in packages.order() {
        let manifest = &package.manifest;
        // Writing into a string cannot fail.
        let _ = writeln!(text, "{} {}  {}", manifest.name, manifest.version, package.shown.display());
        if !manifest.doc.is_empty() {
            let _ = writeln!(text, "  {}", manifest.doc);
        }
        if !manifest.depends.is_empty() {
            let _ = writeln!(text, "  depends on {}", wanted(&manifest.depends));
        }
        text += &replaced(packages, package);
        text += &problems(package);
    }
    if packages.order().is_empty() && packages.disabled.is_empty() {
        text += "no packages; create one with burgeon mods new NAME, or install one with burgeon mods add FOLDER\n";
    }
    for disabled in &packages.disabled {
        let (name, version, shown) = (&disabled.name, &disabled.version, disabled.shown.display());
        let _ = writeln!(text, "disabled: {name} {version} in {shown}");
    }
    for hidden in &packages.hidden {
        let (name, version, by) = (&hidden.name, &hidden.version, hidden.by.display());
        let _ =
            writeln!(text, "ignored: {name} {version} in {}: {by} takes precedence", hidden.shown.display());
    }
    let broken = packages.broken.iter().map(|broken| &broken.error);
    for error in broken.chain(&packages.problems) {
        let said = format!("problem: {error}\n");
        if !text.contains(&said) {
            text += &said;
        }
    }
    for warning in &packages.warnings {
        let _ = writeln!(text, "warning: {warning}");
    }
    text
}

/// Describes one package and its relations to others as text.
pub(super) fn explain(packages: &Packages, package: &Package) -> String {
    let manifest = &package.manifest;
    let mut text = format!("{} {} in {}\n", manifest.name, manifest.version, package.shown.display());
    for line in [&manifest.doc, &manifest.licence].into_iter().filter(|line| !line.is_empty()) {
        let _ = writeln!(text, "  {line}");
    }
    if !manifest.authors.is_empty() {
        let _ = writeln!(text, "  by {}", manifest.authors.join(", "));
    }
    let why = match package.origin {
        PackageOrigin::Beside => "in mods/ next to the script",
        PackageOrigin::Given => "in a folder of --mods",
        PackageOrigin::User => "in the user's folder, for scripts that require it",
    };
    let _ = writeln!(text, "found: {why}");
    for hidden in packages.hidden.iter().filter(|hidden| hidden.name == manifest.name) {
        let _ = writeln!(text, "comes before: {} in {}", hidden.version, hidden.shown.display());
    }
    let order = packages.order();
    let place = order.iter().position(|other| other.manifest.name == manifest.name).unwrap_or(0);
    let _ = writeln!(text, "order: {} of {}", place + 1, order.len());
    for (what, list) in [
        ("depends on", &manifest.depends),
        ("may use", &manifest.optional),
        ("not with", &manifest.conflicts),
    ] {
        if !list.is_empty() {
            let _ = writeln!(text, "{what}: {}", wanted(list));
        }
    }
    let users = users(packages, package);
    if !users.is_empty() {
        let _ = writeln!(text, "used by: {}", users.join(", "));
    }
    let _ = writeln!(text, "script API: {}", manifest.api);
    text += &replaced(packages, package);
    text += &problems(package);
    text
}

/// Describes the replacements by and of a package as text.
fn replaced(packages: &Packages, package: &Package) -> String {
    let mut text = String::new();
    for one in &package.manifest.replaces {
        let winner = packages.replacer(&one.target);
        let but = match winner {
            _ if !package.is_replacing => " (not automatically: in the user's folder)",
            _ if !package.replaces() => " (not at present: it has problems)",
            Some(winner) if winner != package.manifest.name => &format!(" ({winner} takes precedence)"),
            _ => "",
        };
        let _ = writeln!(text, "  replaces {} with {}{but}", one.target, one.file);
    }
    for one in &package.manifest.params {
        let _ = writeln!(text, "  sets {} of {} to {}", one.name, one.package, one.value);
    }
    for (file, by) in packages.replaced_files(package) {
        let _ = writeln!(text, "  {file} is replaced by {by}");
    }
    text
}

fn problems(package: &Package) -> String {
    package
        .problems
        .iter()
        .map(|problem| format!("  problem: {}\n", problem.to_string().replace('\n', "\n  ")))
        .collect()
}

fn wanted(list: &[Dependency]) -> String {
    let list: Vec<String> = list.iter().map(|one| format!("{} {}", one.name, one.versions)).collect();
    list.join(", ")
}

/// Returns the packages that depend on a package, required or optional.
fn users<'a>(packages: &'a Packages, package: &Package) -> Vec<&'a str> {
    let uses =
        |other: &&Package| other.manifest.dependencies().any(|wanted| wanted.name == package.manifest.name);
    packages.order().iter().filter(uses).map(|other| other.manifest.name.as_str()).collect()
}

/// Lists all packages as JSON.
pub(super) fn list_json(packages: &Packages) -> Value {
    let all: Vec<Value> = packages.order().iter().map(|package| package_json(packages, package)).collect();
    let hidden: Vec<Value> = packages
        .hidden
        .iter()
        .map(|it| json!({ "name": it.name, "version": it.version.to_string(), "folder": it.shown, "by": it.by }))
        .collect();
    let disabled: Vec<Value> = packages
        .disabled
        .iter()
        .map(|it| json!({ "name": it.name, "version": it.version.to_string(), "folder": it.shown }))
        .collect();
    let broken: Vec<Value> =
        packages.broken.iter().flat_map(|broken| report::error_list(&broken.error)).collect();
    let problems: Vec<Value> = packages.problems.iter().flat_map(report::error_list).collect();
    let warnings: Vec<Value> = packages.warnings.iter().map(burgeon::Warning::to_json).collect();
    json!({
        "ok": true, "packages": all, "hidden": hidden, "disabled": disabled, "broken": broken, "problems": problems, "warnings": warnings,
    })
}

/// Describes one package as JSON.
pub(super) fn package_json(packages: &Packages, package: &Package) -> Value {
    let manifest = &package.manifest;
    let list = |list: &[Dependency]| -> Value {
        list.iter().map(|one| (one.name.as_str(), Value::String(one.versions.to_string()))).collect()
    };
    let place = packages.order().iter().position(|other| other.manifest.name == manifest.name);
    let replaces: serde_json::Map<String, Value> = manifest
        .replaces
        .iter()
        .map(|one| {
            let with = json!({ "with": one.file, "by": packages.replacer(&one.target) });
            (one.target.to_string(), with)
        })
        .collect();
    let replaced: serde_json::Map<String, Value> = packages
        .replaced_files(package)
        .into_iter()
        .map(|(file, by)| (file.to_string(), by.into()))
        .collect();
    let origin = match package.origin {
        PackageOrigin::Beside => "beside",
        PackageOrigin::Given => "given",
        PackageOrigin::User => "user",
    };
    let params: Vec<Value> = manifest
        .params
        .iter()
        .map(|one| json!({ "package": one.package, "name": one.name, "value": one.value }))
        .collect();
    let problems: Vec<Value> = package.problems.iter().map(burgeon::Error::to_json).collect();
    json!({
        "name": manifest.name, "version": manifest.version.to_string(), "api": manifest.api.to_string(),
        "doc": manifest.doc, "authors": manifest.authors, "licence": manifest.licence,
        "folder": package.shown, "found": origin, "order": place.map(|place| place + 1),
        "depends": list(&manifest.depends), "optional": list(&manifest.optional),
        "conflicts": list(&manifest.conflicts), "used_by": users(packages, package),
        "replaces": replaces, "params": params, "replaced": replaced, "problems": problems,
    })
}
