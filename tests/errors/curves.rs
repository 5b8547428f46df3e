//! Parameters that are functions and curves: `--set`, presets, and the file of drawn curves next to the script.

use insta::assert_snapshot;

use crate::support::Folder;

const SCRIPT: &str = r#"local taper = param("taper", { default = ramp({ { 0, 1 }, { 1, 0.5 } }, { kind = "linear" }) })
local leaf = param("leaf", { default = curve({ { 0, 0 }, { 1, 1 }, { 2, 0 } }) })
local path = param("path", { default = curve({ vec(0, 0, 0), vec(0, 0, 2) }, { kind = "linear" }) })
local floors = param("floors", { default = 3 })
local A = module("A", "taper", "leaf", "path")
local s = lsystem()
s:axiom(A(taper:at(0.5), leaf:point(1).x, path:length()))
s:derive(1)
"#;

fn folder(curves: &str) -> Folder {
    let folder = Folder::new().with("vase.lua", SCRIPT);
    if curves.is_empty() { folder } else { folder.with("vase.curves.json", curves) }
}

fn chain(curves: &str, flags: &[&str]) -> String {
    let said = folder(curves).burgeon(&[&["run", "vase.lua", "--chain", "-"], flags].concat()).done();
    said.stdout.trim().to_owned()
}

fn refused(curves: &str, flags: &[&str]) -> String {
    folder(curves).refuses(&[&["run", "vase.lua"], flags].concat())
}

#[test]
fn the_file_replaces_the_default_and_presets_and_flags_override_the_file() {
    let curves =
        "{ \"taper\": [[0, 4], [1, 4]],\n \"leaf\": [[0, 0], [5, 0]], \"path\": [[0, 0, 0], [0, 7, 0]] }";
    assert_eq!(chain("", &[]), "A(0.75,2,2)");
    assert_eq!(chain(curves, &[]), "A(4,5,7)");
    assert_eq!(chain(curves, &["--set", "taper=[[0, 1], [1, 2]]"]), "A(1.5,5,7)");
    let presets = r#"{ "thin": { "params": { "taper": [[0, 0.1], [1, 0.3]], "leaf": [[0, 0], [9, 0]] } } }"#;
    let folder = folder(curves).with("vase.presets.json", presets);
    let run = |flags: &[&str]| {
        let said =
            folder.burgeon(&[&["run", "vase.lua", "--chain", "-", "--preset", "thin"], flags].concat());
        said.done().stdout.trim().to_owned()
    };
    assert_eq!(run(&[]), "A(0.2,9,7)");
    assert_eq!(run(&["--set", "leaf=[[0,0],[1,0]]"]), "A(0.2,1,7)");
    // Drawn values keep the kind of the script's own.
    assert_eq!(run(&["--set", "taper=[[0,0],[0.25,0],[0.75,1],[1,1]]"]), "A(0.5,9,7)");
}

#[test]
fn an_invalid_file_is_reported_with_its_line() {
    assert_snapshot!(refused("{\n  \"taper\": [[0, 1],,\n", &[]), @"");
    assert_snapshot!(refused("{ \"taper\": [[0, 1],\n [1, NaN]] }", &[]), @"");
    assert_snapshot!(refused("[[0, 1], [1, 2]]", &[]), @"");
    assert_snapshot!(refused("{\n\"taper\": 3 }", &[]), @"");
    assert_snapshot!(refused("{ \"taper\": [[0, 1],\n \"x\"] }", &[]), @"");
    assert_snapshot!(refused("{ \"taper\": [[0, 1],\n [1, 2, 3]] }", &[]), @"");
    assert_snapshot!(refused("{ \"taper\": [[0, 1],\n [0.5, 2],\n [0.5, 3]] }", &[]), @"");
    assert_snapshot!(refused("{\n \"taper\": [[0, 1]] }", &[]), @"");
    assert_snapshot!(refused("{\n \"path\": [[0, 0, 0], [1, 0]] }", &[]), @"");
    assert_snapshot!(refused("{\n \"taper\": [],\n \"taper\": [] }", &[]), @"");
    let many: Vec<String> = (0..1001).map(|x| format!("[{x}, 0]")).collect();
    assert_snapshot!(refused(&format!("{{\n \"taper\": [{}] }}", many.join(",")), &[]).replace(&many.join(","), "..."), @"");
}

#[test]
fn an_invalid_value_of_a_flag_is_reported() {
    assert_snapshot!(refused("", &["--set", "taper=3"]), @"");
    assert_snapshot!(refused("", &["--set", "taper=straight"]), @"");
    assert_snapshot!(refused("", &["--set", "taper=[[1,0],[0,1]]"]), @"");
    assert_snapshot!(refused("", &["--set", "leaf=[[0,0],[0,0],[1,1]]"]), @"");
    assert_snapshot!(refused("", &["--set", "leaf=[[0,0],[1e999,0]]"]), @"");
}

#[test]
fn points_without_a_drawn_parameter_are_warned_of() {
    let warned = |curves: &str| folder(curves).burgeon(&["run", "vase.lua", "--chain", "-"]).done().stderr;
    assert_snapshot!(warned("{\n\"tapr\": [[0, 1], [1, 1]] }"), @"");
    assert_snapshot!(warned("{\n\"floors\": [[0, 1], [1, 1]] }"), @"");
    assert_snapshot!(warned("{\n\"outline\": [[0, 1], [1, 1]] }"), @"");
    assert_snapshot!(refused("{\n\"tapr\": [[0, 1], [1, 1]] }", &["--strict"]), @"");
}

#[test]
fn a_default_that_cannot_be_drawn_is_refused() {
    let script =
        "local a = ramp({ { 0, 1 }, { 1, 2 } })\nlocal x = param(\"x\", { default = a:mix(a, 0.5) })\n";
    assert_snapshot!(Folder::new().with("s.lua", script).refuses(&["run", "s.lua"]), @"");
    let script = "local x = param(\"x\", { default = extruder({}) })\n";
    assert_snapshot!(Folder::new().with("s.lua", script).refuses(&["run", "s.lua"]), @"");
}
