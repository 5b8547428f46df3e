//! Luau accepts the definitions for editors, and finds no type errors in the shipped scripts.

#![allow(clippy::unwrap_used, reason = "a test stops at what is wrong")]

use std::path::{Path, PathBuf};

use luau_analyze::Checker;

fn checker() -> Checker {
    let definitions = burgeon_language::definitions(&burgeon_objects::registry());
    let mut checker = Checker::new().unwrap();
    checker.add_definitions(&definitions.luau).unwrap_or_else(|error| panic!("{error}"));
    checker
}

/// Returns the errors that the checker finds in a script, each with its line.
fn errors(checker: &mut Checker, script: &str) -> Vec<String> {
    let checked = checker.check(script).unwrap();
    assert!(!checked.timed_out);
    checked.errors().iter().map(|error| format!("{}: {}", error.line + 1, error.message)).collect()
}

fn scripts(folder: &str) -> Vec<PathBuf> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..").join(folder);
    let entries = std::fs::read_dir(folder).unwrap();
    let mut paths: Vec<PathBuf> = entries.map(|entry| entry.unwrap().path()).collect();
    paths.retain(|path| path.extension().is_some_and(|extension| extension == "lua"));
    paths.sort();
    paths
}

#[test]
fn no_shipped_script_has_an_error_in_strict_mode() {
    let mut checker = checker();
    let (mut count, mut wrong) = (0, Vec::new());
    for folder in [
        "scripts",
        "scripts/templates",
        "scripts/templates/roads",
        "examples",
        "examples/course",
        "examples/films",
        "examples/first_hour",
        "examples/models/abop",
        "examples/models/abop/shared",
        "examples/models/environment",
        "examples/models/classics",
        "examples/models/lpy",
        "examples/models/vlab",
        "examples/shapes",
        "examples/shapes/mods/elements",
        "crates/objects/scripts",
        "src/commands/starters",
    ] {
        for path in scripts(folder) {
            // The program next to it declares its object type.
            if path.ends_with("examples/beads.lua") {
                continue;
            }
            let text = std::fs::read_to_string(&path).unwrap();
            let errors = errors(&mut checker, &format!("--!strict\n{text}"));
            wrong.extend(errors.iter().map(|error| format!("{}:{error}", path.display())));
            count += 1;
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
    assert!(count >= 240, "{count}");
}

#[test]
fn what_is_wrong_with_a_call_is_found_in_an_editor() {
    let mut checker = checker();
    for (script, expected) in [
        ("this:extrde(1)", "Key 'extrde' not found in class 'Extruder'"),
        ("this:extrude(\"1\")", "Expected this to be 'number', but got 'string'"),
        ("this:extrude()", "Argument count mismatch"),
        ("this:extrude(1):bend(3):nothing()", "Key 'nothing' not found in class 'Extruder'"),
        ("local height: string = this:position().z", "Expected this to be 'string', but got 'number'"),
        ("noise()", "Argument count mismatch"),
        ("noise(\"a\")", "Expected this to be 'number', but got 'string'"),
        ("print(unheard)", "Unknown global 'unheard'"),
    ] {
        let script = format!(
            "--!strict\nlocal s = lsystem({{ object = extruder({{ sides = 8 }}) }})\n\
             s:interpret(\"A(x)\", function(this, x)\n{script}\nend)"
        );
        let found = errors(&mut checker, &script);
        assert!(found.iter().any(|error| error.contains(expected)), "{script}\n{found:?}");
    }
    let given = "--!strict\nextruder({ sides = \"8\" })";
    assert_eq!(errors(&mut checker, given).len(), 1);
}

#[test]
fn what_luau_cannot_know_is_allowed() {
    let mut checker = checker();
    for script in [
        "local s = lsystem() s:rule(\"A\", \"return B()\") s:derive(3)",
        "local s = lsystem({ object = footprint }) s:interpret(\"A\", function(this) this:walls():roof({ kind = \"hip\" }) end)",
        "local s = lsystem({ object = turtle(), interpret = \"last\" }) s:axiom(F(1), { Turn(3), F() })",
        "local s = lsystem({ seed = 3 }) s:rule(\"A(x)\", { weight = 2 }, function(this, x) return F(x - 1), { F(x) } end)",
        "local s = lsystem() s:rule(\"A\", { weight = 2 }, \"return B()\" :: any):decompose(\"A\", { weight = 1 }, \"F\" :: any)",
        "local t = lsystem({ object = turtle }) local d = t:derive() t:interpret(\"A\", function(this) this:place(d) end)",
        "local v = vec(1, 2) * 3 + vec({ 1, 2 }) print(v.x, v[2], -v:unit(), lerp(v, v, 0.5), lerp(1, 2, 0.5))",
        "local p = param(\"p\", { default = true }) if p then print(param(\"n\", { default = 3 }) + 1) end",
        "for index, feature in source(\"a.geojson\") do print(index + 1, feature.height, feature.geometry.points[1][1]) end",
        "local w = panel({ width = { 1, 2 } }) local f = facade({ template(grid(w)), template(list({ w, w })) }) print(f)",
        "local tile = { color = \"red\" } footprint({ { 0, 0 }, { 1, 0 }, { 1, 1 } }, { height = 3 }) panel({ material = tile })",
    ] {
        let found = errors(&mut checker, &format!("--!strict\n{script}"));
        assert!(found.is_empty(), "{script}\n{found:?}");
    }
}

#[test]
fn all_that_scripts_can_use_is_in_the_definitions() {
    let registry = burgeon_objects::registry();
    let definitions = burgeon_language::definitions(&registry);
    for kind in registry.kinds() {
        assert!(
            definitions.luau.contains(&format!("declare class {} extends", kind.luau())),
            "{}",
            kind.name
        );
        for method in &kind.methods {
            let symbol = format!("@burgeon/globaltype/{}.{}", kind.luau(), method.name);
            assert!(definitions.docs.contains_key(&symbol), "{symbol}");
        }
    }
    assert!(definitions.docs.values().all(|doc| doc.ends_with('.')), "{:?}", definitions.docs);
    assert!(definitions.docs.len() > 200, "{}", definitions.docs.len());
}
