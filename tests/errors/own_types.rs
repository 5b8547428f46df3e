//! `burgeon check` and `burgeon api` for script-declared object types.

use std::fmt::Write as _;

use insta::assert_snapshot;

use super::support::Folder;

const LAMP: &str = r#"local lamp = object("lamp", {
  doc = "A lamp.",
  extends = extruder,
  fields = { height = { default = 4, min = 1, unit = "m", doc = "How high it is." }, kind = { default = "gas", choices = { "gas", "arc" } } },
  state = { lit = 0, mast = extruder() },
  reads = {
    lit = { doc = "How many are lit.", function(self): number
      return self.lit
    end },
  },
  changes = {
    light = { doc = "Lights one.", function(self, reach: number, toward: number?)
      self.lit += 1
      self.mast:extrude(reach)
      return self:extrude(self.height)
    end },
  },
})
"#;

/// Returns the output of `check` for a script that begins with the lamp, without the script lines.
fn checked(rest: &str) -> String {
    let script = format!("{LAMP}{rest}");
    let said = Folder::new().with("s.lua", script).burgeon(&["check", "s.lua"]);
    let told = said.stderr.lines().filter(|line| !line.starts_with("  |"));
    told.fold(String::new(), |mut all, line| {
        // Writing to a string cannot fail.
        let _ = writeln!(all, "{line}");
        all
    })
}

#[test]
fn a_check_knows_the_methods_and_fields_of_types_of_the_script() {
    let system = "local A = module(\"A\", \"x\")\nlocal s = lsystem({ object = lamp({ height = 5 }) })\ns:axiom(A(1))\n";
    assert_snapshot!(checked(&format!("{system}s:interpret(\"A(x)\", function(this, x) this:ligth(x) end)")), @r"
    error: s.lua:22:44: rule A(x) (interpretation): unknown method or field `ligth` of lamp
      help: did you mean light?
    ");
    assert_snapshot!(checked(&format!("{system}s:interpret(\"A(x)\", function(this, x) this:light(x, 2, 3) this:light(\"far\") end)")), @r#"
    error: s.lua:22:44: rule A(x) (interpretation): lamp:light takes 1 to 2 arguments, not 3
      help: write lamp:light(reach: number, toward: number?)
    error: s.lua:22:70: rule A(x) (interpretation): lamp:light: reach must be a number, not "far"
      help: write lamp:light(reach: number, toward: number?)
    "#);
    assert_snapshot!(checked(&format!("{system}s:rule(\"A(x)\", function(this, x) this:light(x) return A(this:lit()) end)")), @r"
    error: s.lua:22:39: rule A(x): lamp:light is a write method, so a rule cannot call it
      help: use an interpretation rule: system:interpret(pattern, function(this, ...) ... end)
    ");
    assert_snapshot!(checked("lamp({ height = \"tall\", glow = 3, kind = \"oil\", sides = \"many\" })"), @r#"
    error: s.lua:19:17: lamp: height must be a number, not "tall"
      help: height takes a number, 4 unless given: How high it is
    error: s.lua:19:25: unknown field `glow` in lamp
      help: it has height, kind, sides, shape, smooth, along, around, caps, color, roughness, metallic, position, heading
    error: s.lua:19:42: lamp: kind must be "gas" | "arc", not "oil"
      help: kind takes "gas" | "arc", "gas" unless given: 
    error: s.lua:19:57: lamp: sides must be a number, not "many"
      help: sides takes a number, 16 unless given: Number of sides of the cross-section, a regular polygon with radius 1
    "#);
    assert_snapshot!(checked(&format!("{system}s:interpret(\"A(x)\", function(this, x) this:light(x):extrude(this.height):lightt(1) print(this.hieght, this.mast:extrude(1)) end)")), @r"
    error: s.lua:22:74: rule A(x) (interpretation): unknown method or field `lightt` of lamp
      help: did you mean light?
    error: s.lua:22:95: rule A(x) (interpretation): unknown method or field `hieght` of lamp
      help: did you mean height?
    ");
}

#[test]
fn a_check_knows_what_the_functions_of_a_type_may_do() {
    let of = |parts: &str| {
        checked(&format!(
            "local other = object(\"other\", {{ extends = lamp, state = {{ n = 0 }}, {parts} }})"
        ))
    };
    assert_snapshot!(of("reads = { bad = function(self) self.n = 1 self:extrude(1) return self.m end }"), @r"
    error: s.lua:19:104: other: a read method assigns n
      help: move it to the changes of the type, which interpretations can call
    error: s.lua:19:115: other:extrude is a write method, so a read method cannot call it
      help: move it to the changes of the type
    error: s.lua:19:138: unknown method or field `m` of other
      help: it has as, lit, light, bad, height, kind, lit, n, mast, regular, star, rectangle, polygon, direction, resolution, scale, taper, bend, twist, caps, smooth, extrude, advance, shift, jump, turn, pitch, roll, color, material, mesh, shape, place, position, heading, distance, open_edges, note, detail
    ");
    assert_snapshot!(of("changes = { bad = function(self) self.m = 1 self.height = 2 self.lit = 3 self:light() self:lite(1) end }"), @r"
    error: s.lua:19:106: other: unknown state variable `m`
      help: declare it: state = { m = ... }
    error: s.lua:19:117: height is a field of other, which only the constructor sets
      help: keep changing values in the state
    error: s.lua:19:146: other:light takes 1 to 2 arguments, not 0
      help: write other:light(reach: number, toward: number?)
    error: s.lua:19:159: unknown method or field `lite` of other
      help: did you mean lit?
    ");
    assert_snapshot!(of("begin = function(self) self.mast:extrde(1) self:as(lamp):light(\"a\") self:as(lamp):go() end"), @r#"
    error: s.lua:19:101: unknown method or field `extrde` of extruder
      help: did you mean extrude?
    error: s.lua:19:131: lamp:light: reach must be a number, not "a"
      help: write lamp:light(reach: number, toward: number?)
    error: s.lua:19:150: unknown method or field `go` of lamp
      help: did you mean jump or shift?
    "#);
    // A type that inherits from the allowed parts are methods that the base type lacks.
    assert_snapshot!(of("changes = { go = function(self) self:draw_top() end } })\nobject(\"third\", { extends = other, changes = { draw_top = function(self) end }"), @"s.lua: no problems");
}

#[test]
fn a_check_knows_types_of_required_files_and_of_packages() {
    let folder = Folder::new()
        .with("parts/lamp.lua", format!("{LAMP}return {{ lamp = lamp, more = {{ size = 3 }} }}"))
        .with("mods/lights/mod.toml", "name = \"lights\"\nversion = \"1.0.0\"\napi = \"1.0\"\n")
        .with("mods/lights/init.lua", "local M = {}\nM.arc = require(\"./arc\")\nreturn M")
        .with("mods/lights/arc.lua", "return object(\"arc\", { extends = turtle, fields = { power = 5 }, changes = { shine = function(self, n: number) self:forward(n) end } })")
        .with(
            "s.lua",
            "local parts, lights = require(\"parts/lamp\"), require(\"@lights\")\nlocal A = module(\"A\")\n\
             local s = lsystem({ object = parts.lamp })\ns:axiom(A())\ns:interpret(\"A\", function(this) this:lite(1) end)\n\
             local t = lsystem({ object = lights.arc({ powr = 3 }) })\nt:axiom(A())\nt:interpret(\"A\", function(this) this:shine(\"far\") end)\n\
             extend(parts.lamp, { changes = { dim = function(self) end } })\ns:interpret(\"A\", function(this) this:dim(1) end)",
        );
    assert_snapshot!(folder.burgeon(&["check", "s.lua"]).stderr, @r#"
    error: s.lua:5:38: rule A (interpretation): unknown method or field `lite` of lamp
      | s:interpret("A", function(this) this:lite(1) end)
      |                                      ^^^^
      help: did you mean lit?
    error: s.lua:6:43: unknown field `powr` in lights.arc
      | local t = lsystem({ object = lights.arc({ powr = 3 }) })
      |                                           ^^^^
      help: did you mean power?
    error: s.lua:8:44: rule A (interpretation): lights.arc:shine: n must be a number, not "far"
      | t:interpret("A", function(this) this:shine("far") end)
      |                                            ^^^^^
      help: write lights.arc:shine(n: number)
    "#);
}

#[test]
fn the_types_of_a_script_are_told_like_those_that_come_with_burgeon() {
    let rest = "extend(turtle, { reads = { high = { doc = \"How high it is.\", function(self, above: number?): number return 1 end } } })";
    let folder = Folder::new().with("s.lua", format!("{LAMP}{rest}")).with("empty.lua", "");
    let told = |arguments: &[&str]| folder.burgeon(&[&["api", "--script"], arguments].concat()).done().stdout;
    assert_snapshot!(told(&["s.lua"]), @r##"
    Object types
      lamp    A lamp.
      turtle  A turtle as in The Algorithmic Beauty of Plants, which draws round branches in three dimensions.

    Run burgeon api --script s.lua NAME for details, such as lamp
    "##);
    let lamp = told(&["s.lua", "lamp"]);
    assert!(
        lamp.contains("light(reach: number, toward: number?)") && lamp.contains("lit() -> number"),
        "{lamp}"
    );
    assert!(
        lamp.contains("height: number = 4") && lamp.contains("kind: \"gas\" | \"arc\" = \"gas\""),
        "{lamp}"
    );
    assert_snapshot!(told(&["s.lua", "turtle:high"]), @r##"
    turtle:high(above: number?) -> number
      How high it is.
      Read method: rules and interpretations can call it.
    "##);
    assert_snapshot!(told(&["s.lua", "lamp:as"]), @r"
    lamp:as(constructor: any) -> any
      Returns the object as its base type with this `constructor`: a method that overrides a method of
      the base type can call the original with it, such as self:as(lantern):lamp(1).
      Read method: rules and interpretations can call it.
    ");
    assert_snapshot!(told(&["empty.lua"]), @r##"
    empty.lua neither declares nor extends an object type
    "##);
    let machine = folder.burgeon(&["api", "--script", "s.lua", "--json"]).done().json();
    let names: Vec<_> =
        machine["entries"].as_array().unwrap().iter().map(|entry| entry["name"].clone()).collect();
    assert_eq!(names, ["lamp", "turtle"]);
    assert!(folder.burgeon(&["api", "--script", "none.lua"]).failed().contains("script not found: none.lua"));
}
