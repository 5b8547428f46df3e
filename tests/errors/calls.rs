//! Errors that `burgeon check` finds in calls, without running a script to the end.

use std::path::{Path, PathBuf};

use insta::assert_snapshot;

use super::support::Folder;

/// Returns the output of a check of a system of extruders with this interpretation.
fn check(script: &str) -> String {
    let head = "local A = module(\"A\", \"x\")\nlocal s = lsystem({ object = extruder({ sides = 8 }) })\ns:axiom(A(1))\n";
    Folder::new().with("s.lua", format!("{head}{script}")).burgeon(&["check", "s.lua"]).failed()
}

fn drawn(line: &str) -> String {
    check(&format!("s:interpret(\"A(x)\", function(this, x)\n  {line}\nend)"))
}

#[test]
fn a_method_that_there_is_not_is_found() {
    assert_snapshot!(drawn("this:scale(x):extrde(1)"), @r"
    error: s.lua:5:17: rule A(x) (interpretation): unknown method or field `extrde` of extruder
      | this:scale(x):extrde(1)
      |               ^^^^^^
      help: did you mean extrude?
    ");
    assert_snapshot!(drawn("this:window()"), @r"
    error: s.lua:5:8: rule A(x) (interpretation): unknown method or field `window` of extruder
      | this:window()
      |      ^^^^^^
      help: it has regular, star, rectangle, polygon, direction, resolution, scale, taper, bend, twist, caps, smooth, extrude, advance, shift, jump, turn, pitch, roll, color, material, mesh, shape, place, position, heading, distance, open_edges
    ");
    assert_snapshot!(check("s:derve()"), @r"
    error: s.lua:4:3: unknown method `derve` of a system
      | s:derve()
      |   ^^^^^
      help: did you mean derive?
    ");
}

#[test]
fn what_is_too_much_or_too_little_is_found() {
    assert_snapshot!(drawn("this:extrude()"), @r"
    error: s.lua:5:8: rule A(x) (interpretation): extruder:extrude takes 1 argument, not 0
      | this:extrude()
      |      ^^^^^^^
      help: write extruder:extrude(length: number)
    ");
    assert_snapshot!(drawn("this:taper(1, 2, 3)"), @r"
    error: s.lua:5:8: rule A(x) (interpretation): extruder:taper takes 1 to 2 arguments, not 3
      | this:taper(1, 2, 3)
      |      ^^^^^
      help: write extruder:taper(scale: number, y: number? = scale)
    ");
    assert_snapshot!(check("print(lerp(1, 2), math.max())"), @r"
    error: s.lua:4:7: lerp takes 3 arguments, not 2
      | print(lerp(1, 2), math.max())
      |       ^^^^
      help: write lerp(a: number, b: number, t: number)
    error: s.lua:4:24: math.max takes at least 1 argument, not 0
      | print(lerp(1, 2), math.max())
      |                        ^^^
      help: write math.max(x: number, ...number)
    ");
}

#[test]
fn a_value_of_another_type_is_found() {
    assert_snapshot!(drawn("this:extrude(\"1\")"), @r#"
    error: s.lua:5:16: rule A(x) (interpretation): extruder:extrude: length must be a number, not "1"
      | this:extrude("1")
      |              ^^^
      help: write extruder:extrude(length: number)
    "#);
    assert_snapshot!(drawn("this:extrude(this:position())"), @r"
    error: s.lua:5:16: rule A(x) (interpretation): extruder:extrude: length must be a number, not a vector
      | this:extrude(this:position())
      |              ^^^^^^^^^^^^^^^
      help: write extruder:extrude(length: number)
    ");
    assert_snapshot!(drawn("this:color(3)"), @r"
    error: s.lua:5:14: rule A(x) (interpretation): extruder:color: color must be a colour, not a number
      | this:color(3)
      |            ^
      help: write extruder:color(color: Color)
    ");
    assert_snapshot!(check("print(noise(\"a\"))"), @r#"
    error: s.lua:4:13: noise: x must be a number, not "a"
      | print(noise("a"))
      |             ^^^
      help: write noise(x: number, y: number? = 0, z: number? = 0, seed: number? = 0)
    "#);
    assert_snapshot!(check("s:rule(A, \"return nil\")"), @r#"
    error: s.lua:4:3: the first argument of a rule must be a pattern
      | s:rule(A, "return nil")
      |   ^^^^
      help: write system:rule("A(x)", function(this, x) return ... end)
    "#);
}

#[test]
fn a_field_that_there_is_not_is_found() {
    assert_snapshot!(check("local f = footprint({ { 0, 0 }, { 1, 0 }, { 1, 1 } }, { hight = 3 })"), @r"
    error: s.lua:4:57: unknown field `hight` in footprint
      | local f = footprint({ { 0, 0 }, { 1, 0 }, { 1, 1 } }, { hight = 3 })
      |                                                         ^^^^^
      help: did you mean height?
    ");
    assert_snapshot!(check("extruder { sides = \"8\" }"), @r#"
    error: s.lua:4:20: extruder: sides must be a number, not "8"
      | extruder { sides = "8" }
      |                    ^^^
      help: sides takes a number, 16 unless given: Number of sides of the cross-section, a regular polygon with radius 1
    "#);
    let roof = "lsystem({ object = footprint }):interpret(\"A\", function(this)\n\
                  this:roof({ kind = \"hip\", details = { { modle = 3 } } })\nend)";
    assert_snapshot!(check(roof), @r#"
    error: s.lua:5:41: rule A (interpretation): unknown field `modle` in footprint:roof.details
      | this:roof({ kind = "hip", details = { { modle = 3 } } })
      |                                         ^^^^^
      help: did you mean model?
    "#);
    assert_snapshot!(check("s:rule(\"A(x)\", { wieght = 2 }, function() return nil end)"), @r#"
    error: s.lua:4:18: rule A(x): unknown option `wieght` of a rule
      | s:rule("A(x)", { wieght = 2 }, function() return nil end)
      |                  ^^^^^^
      help: did you mean weight?
    "#);
}

#[test]
fn a_change_of_the_object_in_a_rule_is_found() {
    assert_snapshot!(check("s:rule(\"A(x)\", function(this, x)\n  this:extrude(x)\n  return nil\nend)"), @r"
    error: s.lua:5:8: rule A(x): extruder:extrude is a write method, so a rule cannot call it
      | this:extrude(x)
      |      ^^^^^^^
      help: use an interpretation rule: system:interpret(pattern, function(this, ...) ... end)
    ");
    let guard =
        "s:rule(\"A(x)\", { when = function(this) return this:extrude(1) end }, function() return nil end)";
    assert_snapshot!(check(guard), @r#"
    error: s.lua:4:52: rule A(x): extruder:extrude is a write method, so a rule cannot call it
      | s:rule("A(x)", { when = function(this) return this:extrude(1) end }, function() return nil end)
      |                                                    ^^^^^^^
      help: use an interpretation rule: system:interpret(pattern, function(this, ...) ... end)
    "#);
}

#[test]
fn what_scripts_add_to_types_is_known() {
    let script = "local lantern = object(\"lantern\", { extends = extruder, fields = { height = { default = 4 } } })\n\
                  extend(footprint, { reads = { wide = function(self) return self:area() > 9 end } })\n\
                  lsystem({ object = footprint }):rule(\"F\", function(this) print(this:wide()) return nil end)\n\
                  lsystem({ object = lantern({ height = 5 }) }):interpret(\"F\", function(this) this:extrude(1) end)\n";
    Folder::new().with("s.lua", script).burgeon(&["check", "s.lua"]).done();
}

#[test]
fn what_scripts_add_to_one_type_no_other_has() {
    let lamps = |added: &str| {
        format!(
            "{added}(footprint, {{ reads = {{ lamps = function(self) return 1 end }} }})\n\
             local A = module(\"A\")\n\
             local t = lsystem({{ object = turtle }})\n\
             t:axiom(A())\n\
             t:interpret(\"A\", function(this) print(this:lamps()) end)\n\
             t:derive(0)\n"
        )
    };
    let folder = Folder::new().with("s.lua", lamps("extend"));
    for command in [&["check", "s.lua"][..], &["run", "s.lua", "-o", "s.glb"]] {
        let told = folder.burgeon(command).failed();
        assert!(told.contains("unknown method or field `lamps` of turtle"), "{command:?}: {told}");
    }
    // Static analysis cannot find the type, and the script fails before this line.
    let unknown = lamps("error(\"no\")\nextend").replace("(footprint", "(({ turtle })[1]");
    let told = Folder::new().with("s.lua", &unknown).burgeon(&["check", "s.lua"]).failed();
    assert!(!told.contains("lamps"), "{told}");
}

#[test]
fn nothing_is_found_in_scripts_that_run() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let mut count = 0;
    for folder in ["scripts", "crates/objects/scripts", "examples"] {
        for entry in std::fs::read_dir(root.join(folder)).unwrap() {
            let path: PathBuf = entry.unwrap().path();
            // One script needs data that is not in the repository; the other needs an object type that a
            // program declares.
            let skipped = path.ends_with("monaco.lua") || path.ends_with("beads.lua");
            if skipped || path.extension().is_none_or(|extension| extension != "lua") {
                continue;
            }
            let script = path.display().to_string();
            let data = root.join("examples/data").display().to_string();
            Folder::new().burgeon(&["check", &script, "--quick", "--data", &data]).done();
            count += 1;
        }
    }
    assert!(count >= 30, "{count}");
}
