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
    let presets =
        r#"{ "thin": { "params": { "taper": [[0, 0.125], [1, 0.375]], "leaf": [[0, 0], [9, 0]] } } }"#;
    let folder = folder(curves).with("vase.presets.json", presets);
    let run = |flags: &[&str]| {
        let said =
            folder.burgeon(&[&["run", "vase.lua", "--chain", "-", "--preset", "thin"], flags].concat());
        said.done().stdout.trim().to_owned()
    };
    assert_eq!(run(&[]), "A(0.25,9,7)");
    assert_eq!(run(&["--set", "leaf=[[0,0],[1,0]]"]), "A(0.25,1,7)");
    // Drawn values keep the kind of the script's own.
    assert_eq!(run(&["--set", "taper=[[0,0],[0.25,0],[0.75,1],[1,1]]"]), "A(0.5,9,7)");
}

#[test]
fn an_invalid_file_is_reported_with_its_line() {
    assert_snapshot!(refused("{\n  \"taper\": [[0, 1],,\n", &[]), @r#"
    error: vase.curves.json:2:3: this is not JSON: expected value
      | "taper": [[0, 1],,
      | ^^^^^^^^^^^^^^^^^^
      help: fix the file, or move it away
    "#);
    assert_snapshot!(refused("{ \"taper\": [[0, 1],\n [1, NaN]] }", &[]), @r"
    error: vase.curves.json:2:2: this is not JSON: expected value
      | [1, NaN]] }
      | ^^^^^^^^^^^
      help: fix the file, or move it away
    ");
    assert_snapshot!(refused("[[0, 1], [1, 2]]", &[]), @r#"
    error: vase.curves.json:1:1: the file is [[0, 1], [1, 2]], not an object
      | [[0, 1], [1, 2]]
      | ^^^^^^^^^^^^^^^^
      help: write { "taper": [[0, 1], [1, 0.2]] }
    "#);
    assert_snapshot!(refused("{\n\"taper\": 3 }", &[]), @r#"
    error: vase.curves.json:2:1: taper is 3, not a list of points
      | "taper": 3 }
      | ^^^^^^^^^^^^
      help: write a list of points: [[0, 1], [1, 0.2]]
    "#);
    assert_snapshot!(refused("{ \"taper\": [[0, 1],\n \"x\"] }", &[]), @r#"
    error: vase.curves.json:2:3: taper: point 2 is "x", not a list of numbers
      | "x"] }
      |  ^
      help: write a list of points: [[0, 1], [1, 0.2]]
    "#);
    assert_snapshot!(refused("{ \"taper\": [[0, 1],\n [1, 2, 3]] }", &[]), @r"
    error: vase.curves.json:2:2: param taper: point 2 has 3 numbers, not 2
      | [1, 2, 3]] }
      | ^^^^^^^^^^^^
      help: write [x, y]
    ");
    assert_snapshot!(refused("{ \"taper\": [[0, 1],\n [0.5, 2],\n [0.5, 3]] }", &[]), @r"
    error: vase.curves.json:3:2: param taper: the x of point 3 is 0.5, which is not above 0.5, the x before
      | [0.5, 3]] }
      | ^^^^^^^^^^^
      help: a function has one y for each x: order the points by x, and remove repeated x
    ");
    assert_snapshot!(refused("{\n \"taper\": [[0, 1]] }", &[]), @r#"
    error: vase.curves.json:2:2: param taper: a function needs at least 2 points, not 1
      | "taper": [[0, 1]] }
      | ^^^^^^^^^^^^^^^^^^^
      help: give at least 2 points, such as { { 0, 0.1 }, { 1, 0.8 } }
    "#);
    assert_snapshot!(refused("{\n \"path\": [[0, 0, 0], [1, 0]] }", &[]), @r#"
    error: vase.curves.json:2:2: param path: point 2 has 2 numbers, not 3
      | "path": [[0, 0, 0], [1, 0]] }
      | ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^
      help: write [x, y, z]
    "#);
    assert_snapshot!(refused("{\n \"taper\": [],\n \"taper\": [] }", &[]), @r#"
    error: vase.curves.json:3:3: the file has two members named `taper`
      | "taper": [] }
      |  ^^^^^
      help: remove or rename one of them
    "#);
    let many: Vec<String> = (0..1001).map(|x| format!("[{x}, 0]")).collect();
    assert_snapshot!(refused(&format!("{{\n \"taper\": [{}] }}", many.join(",")), &[]).replace(&many.join(","), "..."), @r#"
    error: vase.curves.json:2:2: param taper: 1001 points are too many to draw
      | "taper": [[0, 0],[1, 0],[2, 0],[3, 0],[4, 0],[5, 0],[6, 0],[7, 0],[8, 0],[9, 0],[10, 0],[11, 0],[12, 0],[13, 0],[14, 0],[15, 0],[16, 0],[17, 0],[18, 0],[19, ...
      | ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^
      help: give at most 1000 points
    "#);
}

#[test]
fn an_invalid_value_of_a_flag_is_reported() {
    assert_snapshot!(refused("", &["--set", "taper=3"]), @r#"
    error: vase.lua:1:15: param taper is 3, not a list of points
      | local taper = param("taper", { default = ramp({ { 0, 1 }, { 1, 0.5 } }, { kind = "linear" }) })
      |               ^^^^^
      help: write a list of points: [[0, 1], [1, 0.2]]
    "#);
    assert_snapshot!(refused("", &["--set", "taper=straight"]), @r#"
    error: vase.lua:1:15: param taper must be points, not "straight": expected value
      | local taper = param("taper", { default = ramp({ { 0, 1 }, { 1, 0.5 } }, { kind = "linear" }) })
      |               ^^^^^
      help: write a list of points: [[0, 1], [1, 0.2]]
    "#);
    assert_snapshot!(refused("", &["--set", "taper=[[1,0],[0,1]]"]), @r#"
    error: vase.lua:1:15: param taper: the x of point 2 is 0, which is not above 1, the x before
      | local taper = param("taper", { default = ramp({ { 0, 1 }, { 1, 0.5 } }, { kind = "linear" }) })
      |               ^^^^^
      help: a function has one y for each x: order the points by x, and remove repeated x
    "#);
    assert_snapshot!(refused("", &["--set", "leaf=[[0,0],[0,0],[1,1]]"]), @r#"
    error: vase.lua:2:14: param leaf: point 2 is equal to point 1
      | local leaf = param("leaf", { default = curve({ { 0, 0 }, { 1, 1 }, { 2, 0 } }) })
      |              ^^^^^
      help: remove one of them
    "#);
    assert_snapshot!(refused("", &["--set", "leaf=[[0,0],[1e999,0]]"]), @r#"
    error: vase.lua:2:14: param leaf: point 2 is [1e999,0], not a list of numbers
      | local leaf = param("leaf", { default = curve({ { 0, 0 }, { 1, 1 }, { 2, 0 } }) })
      |              ^^^^^
      help: write a list of points: [[0, 1], [1, 0.2]]
    "#);
}

#[test]
fn points_without_a_drawn_parameter_are_warned_of() {
    let warned = |curves: &str| {
        let said = folder(curves).burgeon(&["run", "vase.lua", "--chain", "-"]).done().stderr;
        said.split_once("warning: ").unwrap().1.to_owned()
    };
    assert_snapshot!(warned("{\n\"tapr\": [[0, 1], [1, 1]] }"), @r#"
    vase.curves.json:2:2: vase.lua has no parameter `tapr`, so its points are unused
      | "tapr": [[0, 1], [1, 1]] }
      |  ^^^^
      help: did you mean taper?
    "#);
    assert_snapshot!(warned("{\n\"floors\": [[0, 1], [1, 1]] }"), @r#"
    vase.curves.json:2:2: the parameter `floors` of vase.lua is not drawn, so its points are unused
      | "floors": [[0, 1], [1, 1]] }
      |  ^^^^^^
      help: remove floors from the file; only parameters that are functions or curves are drawn
    "#);
    assert_snapshot!(warned("{\n\"outline\": [[0, 1], [1, 1]] }"), @r#"
    vase.curves.json:2:2: vase.lua has no parameter `outline`, so its points are unused
      | "outline": [[0, 1], [1, 1]] }
      |  ^^^^^^^
      help: remove outline from the file, or declare param("outline", { default = ramp(...) })
    "#);
    assert_snapshot!(refused("{\n\"tapr\": [[0, 1], [1, 1]] }", &["--strict"]), @r#"
    error: vase.curves.json:2:2: vase.lua has no parameter `tapr`, so its points are unused
      | "tapr": [[0, 1], [1, 1]] }
      |  ^^^^
      help: did you mean taper?
    "#);
}

#[test]
fn a_default_that_cannot_be_drawn_is_refused() {
    let script =
        "local a = ramp({ { 0, 1 }, { 1, 2 } })\nlocal x = param(\"x\", { default = a:mix(a, 0.5) })\n";
    assert_snapshot!(Folder::new().with("s.lua", script).refuses(&["run", "s.lua"]), @r#"
    error: s.lua:2:11: param x: the default, a ramp from 0 to 1, has no points of its own
      | local x = param("x", { default = a:mix(a, 0.5) })
      |           ^^^^^
      help: give one that is made of points, not one between two others
    "#);
    let script = "local x = param(\"x\", { default = extruder({}) })\n";
    assert_snapshot!(Folder::new().with("s.lua", script).refuses(&["run", "s.lua"]), @r#"
    error: s.lua:1:11: param x: default must be a number, a boolean, a string, a function, a curve or a surface, not an object
      | local x = param("x", { default = extruder({}) })
      |           ^^^^^
      help: functions, curves and surfaces are drawn: default = ramp({ { 0, 1 }, { 1, 0.2 } })
    "#);
}
