//! Tests of `param` and `--set`.

use insta::assert_snapshot;

use crate::support::{Folder, refused, without_columns};

const PARAMS: &str = r##"local n = param("n", { default = 3, min = 0, max = 10, step = 2.5, unit = "m" })
local mode = param("mode", { default = "day", choices = { "day", "night" } })
local on = param("on", { default = true, doc = "whether it shines" })
local hue = param("hue", { default = "#ff0000" })
print(n, mode, on, hue)
"##;

fn set(values: &[&str]) -> String {
    let silent = PARAMS.replace("default = 3", "default = 5").replace("print(", "tostring(");
    let folder = Folder::new().with("s.lua", silent);
    let flags: Vec<&str> = values.iter().flat_map(|value| ["--set", *value]).collect();
    folder.refuses(&[&["run", "s.lua"][..], &flags].concat())
}

#[test]
fn an_unknown_parameter_is_told_with_the_nearest_one() {
    assert_snapshot!(set(&["moed=day"]), @r"
    error: s.lua: unknown parameter `moed`
      help: did you mean mode?
    ");
    assert_snapshot!(set(&["height=3"]), @r"
    error: s.lua: unknown parameter `height`
      help: it has n, mode, on, hue
    ");
    assert_snapshot!(Folder::new().with("s.lua", "local x = 1\n").refuses(&["run", "s.lua", "--set", "x=1"]), @r"
    error: s.lua: unknown parameter `x`
      help: the script declares no parameters
    ");
    assert_snapshot!(Folder::new().with("s.lua", "local x = 1\n").refuses(&["check", "s.lua", "--set", "x=1"]), @r"
    error: s.lua: unknown parameter `x`
      help: the script declares no parameters
    ");
}

#[test]
fn a_value_out_of_range_or_between_steps_is_told_with_what_is_allowed() {
    assert_snapshot!(set(&["n=11"]), @r#"
    error: s.lua:1:11: param n is 11, out of its range
      | local n = param("n", { default = 5, min = 0, max = 10, step = 2.5, unit = "m" })
      |           ^^^^^
      help: the allowed values are 0 to 10
    "#);
    assert_snapshot!(set(&["n=-1e300"]), @r#"
    error: s.lua:1:11: param n is -1e300, out of its range
      | local n = param("n", { default = 5, min = 0, max = 10, step = 2.5, unit = "m" })
      |           ^^^^^
      help: the allowed values are 0 to 10
    "#);
    assert_snapshot!(set(&["n=3"]), @r#"
    error: s.lua:1:11: param n is 3, between two steps of 2.5
      | local n = param("n", { default = 5, min = 0, max = 10, step = 2.5, unit = "m" })
      |           ^^^^^
      help: choose 2.5 or 5
    "#);
}

#[test]
fn a_value_of_the_wrong_type_is_told_with_the_default() {
    for value in ["n=many", "n=", "n=nan", "n=inf", "n=0x10", "n=1,5"] {
        let said = set(&[value]);
        assert!(
            without_columns(&said).starts_with("error: s.lua:1: param n must be a number, not "),
            "{value}: {said}"
        );
    }
    assert_snapshot!(set(&["n=many"]), @r#"
    error: s.lua:1:11: param n must be a number, not "many"
      | local n = param("n", { default = 5, min = 0, max = 10, step = 2.5, unit = "m" })
      |           ^^^^^
      help: its default is 5
    "#);
    assert_snapshot!(set(&["mode=dusk"]), @r#"
    error: s.lua:2:14: param mode is "dusk", which is not one of the choices
      | local mode = param("mode", { default = "day", choices = { "day", "night" } })
      |              ^^^^^
      help: choose one of day, night
    "#);
    assert_snapshot!(set(&["on=maybe"]), @r#"
    error: s.lua:3:12: param on must be true or false, not "maybe"
      | local on = param("on", { default = true, doc = "whether it shines" })
      |            ^^^^^
      help: its default is true
    "#);
    assert_snapshot!(set(&["hue=rde"]), @r##"
    error: s.lua:4:13: param hue must be a colour, #rrggbb, not "rde"
      | local hue = param("hue", { default = "#ff0000" })
      |             ^^^^^
      help: its default is #ff0000
    "##);
}

#[test]
fn the_last_value_set_counts() {
    let folder = Folder::new().with("s.lua", PARAMS.replace("default = 3", "default = 5"));
    let said = folder
        .burgeon(&[
            "run",
            "s.lua",
            "--json",
            "--set",
            "n=0",
            "--set",
            " n = 7.5 ",
            "--set",
            "on=off",
            "--set",
            "mode=night",
            "--set",
            "hue=#00ff00",
        ])
        .done();
    assert_eq!(said.stderr, "7.5\tnight\tfalse\t#00ff00\n");
    let params = &said.json()["params"];
    assert_eq!(params.to_string(), r##"{"n":7.5,"mode":"night","on":false,"hue":"#00ff00"}"##);
}

#[test]
fn a_declaration_is_checked() {
    assert_snapshot!(refused(PARAMS), @r#"
    error: s.lua:1:24: the default of param n is 3, between two steps of 2.5
      | local n = param("n", { default = 3, min = 0, max = 10, step = 2.5, unit = "m" })
      |                        ^^^^^^^
      help: choose 2.5 or 5
    "#);
    assert_snapshot!(refused("param(\"a\", { defualt = 3 })\n"), @r#"
    error: s.lua:1:14: unknown field `defualt` in param a
      | param("a", { defualt = 3 })
      |              ^^^^^^^
      help: did you mean default?
    "#);
    assert_snapshot!(refused("param(\"a\", {})\n"), @r#"
    error: s.lua:1:1: param a has no default
      | param("a", {})
      | ^^^^^
      help: write param("a", { default = ... })
    "#);
    assert_snapshot!(refused("param(\"a\", { default = 3, min = \"low\" })\n"), @r#"
    error: s.lua:1:34: param a: min must be a number, not "low"
      | param("a", { default = 3, min = "low" })
      |                                  ^^^
    "#);
    assert_snapshot!(refused("param(\"a\", { default = 3, min = 5, max = 1 })\n"), @r#"
    error: s.lua:1:1: param a: min 5 is above max 1
      | param("a", { default = 3, min = 5, max = 1 })
      | ^^^^^
    "#);
    assert_snapshot!(refused("param(\"a\", { default = 3, step = 0 })\n"), @r#"
    error: s.lua:1:1: param a: step must be above 0
      | param("a", { default = 3, step = 0 })
      | ^^^^^
    "#);
    for (field, default) in [("min", "true"), ("max", "\"b\""), ("step", "ramp({ { 0, 1 }, { 1, 0 } })")] {
        let said = refused(&format!("param(\"a\", {{ default = {default}, {field} = 1 }})\n"));
        assert!(said.contains(&format!("param a is not a number, so it cannot have {field}")), "{said}");
    }
    assert_snapshot!(refused("param(\"a\", { default = {} })\n"), @r#"
    error: s.lua:1:1: param a: default must be a number, a boolean, a string, a function, a curve or a surface, not a table
      | param("a", { default = {} })
      | ^^^^^
      help: functions, curves and surfaces are drawn: default = ramp({ { 0, 1 }, { 1, 0.2 } })
    "#);
    assert_snapshot!(refused("param(\"a\", { default = 30, max = 10 })\n"), @r#"
    error: s.lua:1:14: the default of param a is 30, out of its range
      | param("a", { default = 30, max = 10 })
      |              ^^^^^^^
      help: the maximum is 10
    "#);
    assert_snapshot!(refused("param(\"a\", { default = 3, unit = 4 })\n"), @r#"
    error: s.lua:1:1: param a: unit must be a string, not 4
      | param("a", { default = 3, unit = 4 })
      | ^^^^^
    "#);
    assert_snapshot!(refused("param(\"a\", { default = 3, choices = { \"b\" } })\n"), @r#"
    error: s.lua:1:1: param a: the default must be a string, as the choices, not 3
      | param("a", { default = 3, choices = { "b" } })
      | ^^^^^
    "#);
    assert_snapshot!(refused("param(\"a\", { default = \"c\", choices = { \"b\" } })\n"), @r#"
    error: s.lua:1:25: the default of param a is "c", which is not one of the choices
      | param("a", { default = "c", choices = { "b" } })
      |                         ^
      help: choose one of b
    "#);
}
