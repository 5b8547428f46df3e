//! Errors have the line that causes them, in short messages.

use insta::assert_snapshot;

use crate::support::{Folder, HEAD, refused, refused_rules, without_columns};

/// Returns the line of the error of `script`, and its message.
fn told(script: &str) -> (usize, String) {
    let said = without_columns(&refused(script));
    let rest = said.strip_prefix("error: s.lua:").unwrap_or_else(|| panic!("{said}"));
    let (line, rest) = rest.split_once(": ").unwrap();
    (line.parse().unwrap(), rest.lines().next().unwrap().to_owned())
}

#[test]
fn a_wrong_axiom_is_told_where_it_stands() {
    for (axiom, what) in [
        ("s:axiom(A(1), \"B\")", "an axiom must contain only modules, but one item is the string \"B\""),
        ("s:axiom(A(1), { B(), { 5 } })", "an axiom must contain only modules, but one item is the number 5"),
        ("s:axiom(true)", "an axiom must contain only modules, but one item is the boolean true"),
        ("s:axiom(nil)", "an axiom must contain only modules, but one item is nothing"),
        ("s:axiom(A)", "an axiom must contain only modules, but one item is a function"),
        ("s:axiom(s)", "an axiom must contain only modules, but one item is a userdata"),
        (
            "local t: any = {} t[1] = t s:axiom(t)",
            "branches are nested more than 200 deep, or a branch contains itself",
        ),
        (
            "local t: any = {} t[1] = t s:axiom(A(t))",
            "a table is nested more than 64 deep, or contains itself",
        ),
        ("s:axiom(A({ [print] = 1 }))", "a table has a function as a key"),
        (
            "s:axiom(source({ {} }), function(feature) return 5 end)",
            "an axiom must contain only modules, but one item is the number 5",
        ),
    ] {
        let script = format!("{HEAD}\n{axiom}\nlocal x = 1\n\ns:derive(1)\n");
        assert_eq!(told(&script), (4, what.to_owned()), "{axiom}");
    }
}

#[test]
fn an_error_that_is_no_text_is_told_where_it_was_raised() {
    assert_snapshot!(refused_rules("s:rule(\"A(x)\", function(this, x)\n  local y = x\n  error({})\nend)"), @r#"
    error: s.lua:5:3: rule A(x): the script raised an error that is not a string
      | error({})
      | ^^^^^
      module: A(1), step 1
      help: write error("what is wrong")
    "#);
    for value in [
        "",
        "nil",
        "true",
        "false",
        "{}",
        "{ code = 1 }",
        "print",
        "function() end",
        "this",
        "A(1)",
        "buffer.create(1)",
    ] {
        for call in
            [format!("error({value})"), format!("error((select(2, pcall(function() error({value}) end))))")]
        {
            let rule = format!("s:rule(\"A(x)\", function(this, x)\n  local y = x\n  {call}\nend)");
            let said = refused_rules(&rule);
            assert!(
                without_columns(&said).starts_with(
                    "error: s.lua:5: rule A(x): the script raised an error that is not a string\n"
                ),
                "{call}: {said}"
            );
        }
    }
    let (line, what) = told(&format!("{HEAD}local function f()\n  error({{}})\nend\n\nf()\n"));
    assert_eq!((line, what.as_str()), (4, "the script raised an error that is not a string"));
    let (line, what) = told(&format!(
        "{HEAD}s:rule(\"A(x)\", {{ when = function(this, x)\n  error({{}})\nend }}, function() return B() end)\ns:derive(1)\n"
    ));
    assert_eq!((line, what.as_str()), (4, "rule A(x): the script raised an error that is not a string"));
    let (line, _) =
        told(&format!("{HEAD}s:interpret(\"A(x)\", function(this, x)\n  error({{}})\nend)\ns:derive(1)\n"));
    assert_eq!(line, 4);
}

#[test]
fn a_mistake_with_the_library_is_told_in_the_line_of_the_script() {
    for (mistake, what) in [
        ("vec(\"a\") + 1", "x of vec is the string \"a\""),
        ("vec(1, 2, 3) + 1", "+ takes two vectors, but one side is the number 1"),
        ("1 - vec(1, 2, 3)", "- takes two vectors, but one side is the number 1"),
        ("vec(1, 2, 3) * \"a\"", "* takes two vectors, but one side is the string \"a\""),
        (
            "vec(1, 2, 3) / vec(1, 2, 3)",
            "a vector is divided by a number: a vector cannot be divided by a vector",
        ),
        ("vec(nil, nil, nil)", "x of vec is nothing"),
        ("vec(0 / 0, 1, 1)", "x of vec is the number nan"),
        ("vec({ 1, 1 / 0 })", "y of vec is the number inf"),
        ("vec(1, 2, 3).foo", "a vector has no foo"),
        ("vec(1, nil, 3)", "y of vec is nothing"),
        ("vec(1, 2, 3, 4)", "vec takes three numbers, not 4"),
        ("vec({ 1 })", "vec takes a list of two or three numbers, but this table is none"),
        ("vec({ x = 1, y = 2 })", "vec takes a list of two or three numbers, but this table is none"),
        ("vec(1, 2, 3):dot(1)", "dot takes a vector, not the number 1"),
        ("vec(1, 2, 3):cross()", "cross takes a vector, not nothing"),
        (
            "vec(1, 2, 3).length(5)",
            "length is called with a colon, on a vector: v:length(...), not on the number 5",
        ),
        ("vec(1, 2, 3):lerp(vec(), \"a\")", "lerp takes a vector and a number, not the string \"a\""),
        ("lerp(\"a\", 1, 2)", "lerp takes numbers, but argument 1 is the string \"a\""),
        ("lerp(1, 2)", "lerp takes numbers, but argument 3 is nothing"),
        ("remap(1, 2, 3, 4)", "remap takes numbers, but argument 5 is nothing"),
        ("ease.out({})", "ease.out takes numbers, but argument 1 is a table"),
        ("ease[\"in\"]()", "ease.in takes numbers, but argument 1 is nothing"),
        ("noise()", "noise takes numbers, but argument 1 is nothing"),
        ("noise(1, \"a\")", "noise takes numbers, but argument 2 is the string \"a\""),
        ("hsv(1, 2)", "hsv takes numbers, but argument 3 is nothing"),
        (
            "rgb(\"ribbon\")",
            "rgb takes a colour such as \"#336699\" or \"orange\", not the string \"ribbon\"",
        ),
        ("rgb(\"#33669980\")", "rgb takes a colour without opacity, not the string \"#33669980\""),
        ("rgb(nil)", "rgb takes a colour such as \"#336699\" or \"orange\", not nothing"),
        ("mix(\"#ffffff\", 5, 1)", "mix takes a colour such as \"#336699\" or \"orange\", not the number 5"),
        ("mix(\"red\", \"blue\", 0 / 0)", "mix takes an amount from 0 to 1, not nan"),
        ("mix(\"#ffffff\", { 1, 2 }, 1)", "mix of colours takes numbers, but argument 3 is nothing"),
        ("mix(\"#ffffff\", \"#000000\")", "mix takes numbers, but argument 3 is nothing"),
    ] {
        let at_top = format!("{HEAD}\nlocal function f()\n  return {mistake}\nend\n\nf()\n");
        assert_eq!(told(&at_top), (5, what.to_owned()), "{mistake}");
        let in_rule = format!(
            "{HEAD}s:rule(\"A(x)\", function(this, x)\n  local v = {mistake}\n  return A(x)\nend)\ns:derive(1)\n"
        );
        assert_eq!(told(&in_rule), (4, format!("rule A(x): {what}")), "{mistake}");
        let caught = format!("print(select(2, pcall(function()\n  return {mistake}\nend)))\n");
        let said = Folder::new().with("s.lua", &caught).burgeon(&["run", "s.lua", "--json"]).done();
        assert_eq!(said.stderr, format!("s.lua:2: {what}\n"), "{mistake}");
    }
}

#[test]
fn what_a_library_catches_is_raised_again_in_the_line_of_its_caller() {
    let of = |caught: &str, again: &str| {
        let script = format!(
            "local function make(...)\n  local is_made, made = pcall({caught}, ...)\n  if not is_made then\n    {again}\n  end\n  \
             return made\nend\n\nlocal function use(...)\n  return make({{ sidess = 3 }})\nend\nuse()\n"
        );
        refused(&script)
    };
    assert_snapshot!(of("extruder", "error(made, 2)"), @r"
    error: s.lua:10:17: unknown field `sidess` in extruder
      | return make({ sidess = 3 })
      |               ^^^^^^
      help: did you mean sides?
    ");
    assert_snapshot!(of("extruder", "error(made, 3)"), @r"
    error: s.lua:12:1: unknown field `sidess` in extruder
      | use()
      | ^^^^^
      help: did you mean sides?
    ");
    assert_snapshot!(of("rgb", "error(made, 2)"), @r##"
    error: s.lua:10:3: rgb takes a colour such as "#336699" or "orange", not a table
      | return make({ sidess = 3 })
      | ^^^^^^^^^^^^^^^^^^^^^^^^^^^
    "##);
    assert_snapshot!(of("function() error(\"wrong\") end", "error(made, 2)"), @r"
    error: s.lua:10:3: wrong
      | return make({ sidess = 3 })
      | ^^^^^^^^^^^^^^^^^^^^^^^^^^^
    ");
    // A message with additional text is not changed.
    assert_snapshot!(of("extruder", "error(\"no: \" .. made, 2)"), @r"
    error: s.lua:10:17: no: s.lua:2: unknown field `sidess` in extruder
      | return make({ sidess = 3 })
      |               ^^^^^^
    ");
    assert_snapshot!(of("extruder", "error(made, 0)"), @r"
    error: s.lua:2:3: unknown field `sidess` in extruder
      | local is_made, made = pcall(extruder, ...)
      | ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^
      help: did you mean sides?
    ");
    assert_snapshot!(of("extruder", "error(\"no extruder\")"), @r#"
    error: s.lua:4:5: no extruder
      | error("no extruder")
      | ^^^^^^^^^^^^^^^^^^^^
    "#);
    let folder = Folder::new().with(
        "s.lua",
        "local function make(...)\n  local _, made = pcall(extruder, { sidess = 3 })\n  error(made, 2)\nend\n\
         print(select(2, pcall(function()\n  make()\nend)))\n",
    );
    let said = folder.burgeon(&["run", "s.lua", "--json"]).done();
    assert_eq!(said.stderr, "s.lua:6: unknown field `sidess` in extruder\n");
}

#[test]
fn a_vector_is_made_of_a_list_and_read_like_one() {
    let script = r#"
assert(vec({ 1, 2, 3 }) == vec(1, 2, 3) and vec({ 1, 2 }) == vec(1, 2) and vec(vec(4, 5, 6)) == vec(4, 5, 6))
assert(vec() == vec(0, 0, 0) and vec(1) == vec(1, 0, 0) and vec(1, 2, nil) == vec(1, 2, 0))
local v = vec(7, 8, 9)
assert(v[1] == 7 and v[2] == 8 and v[3] == 9 and v[4] == nil and v[0] == nil and #v == 3)
assert(v + { 1, 1, 1 } == vec(8, 9, 10) and { 1, 1 } - v == vec(-6, -7, -9) and v * { 2, 2, 2 } == vec(14, 16, 18))
assert(v:dot({ 1, 0, 0 }) == 7 and v:distance({ 7, 8 }) == 9 and lerp(v, vec(), 0.5) == v / 2 and v:lerp({ 0, 0 }, 1) == vec())
local A = module("A", "v")
local s = lsystem({ object = turtle() })
s:axiom(A(vec({ 1, 2, 3 })))
s:rule("A(v)", function(this, v)
  local here = this:position()
  assert(here[1] == here.x and here[2] == here.y and here[3] == here.z and #v == 3 and v[2] == 2)
  return A(vec(v[3], v[2], v[1]))
end)
print(s:derive(1).chains[1])
"#;
    let said = Folder::new().with("s.lua", script).burgeon(&["run", "s.lua", "--json"]).done();
    assert_eq!(said.stderr.lines().next(), Some("A(vec{x=3,y=2,z=1})"));
}

#[test]
fn what_is_long_is_told_shortly() {
    let long = "string.rep(\"abc\", 300000)";
    for rules in [
        format!("s:axiom(A({long}))\ns:rule(\"A(x)\", function(this, x) error(\"wrong\") end)"),
        format!("s:rule(\"A(x)\", function(this, x) error({long}) end)"),
        format!("s:rule(\"A(x)\", function(this, x) return {long} end)"),
        format!("s:rule(\"A(x)\", function(this, x) return {{ {long} }} end)"),
        format!("s:rule(\"A(x)\", function(this, x) return A(x)[{long}] end)"),
        format!("s:rule(\"A(x)\", function(this, x) return {{ [{long}] = A(x) }} end)"),
        format!("s:rule(\"A(x)\", function(this, x) return this[{long}]() end)"),
        format!(
            "s:axiom(A({{ {long}, {long} }}))\ns:interpret(\"A(x)\", function(this, x) this:forward(x) end)"
        ),
        format!("s:axiom({long})"),
        format!("s:rule({long}, function() end)"),
        "s:rule(\"A > \" .. string.rep(\"A \", 100000) .. \"?\", function() end)".to_owned(),
        format!("s:rule(\"A(x)\", {{ weight = {long} }}, function() end)"),
        format!("s:ignore({long})"),
        format!("turtle({{ [{long}] = 1 }})"),
        format!("module(\" \" .. {long})"),
        format!("s[{long}] = 1"),
        format!("model({long})"),
        format!("module(\"C\", {long}, {long})"),
        format!("param(\"a\", {{ default = 1, min = {long} }})"),
        format!("require({long})"),
        format!("s:derive({long})"),
        format!("source({long})"),
        format!("rgb({long})"),
        format!("lerp({long}, 1, 2)"),
        format!("s:rule(\"A(x)\", function(this, x) random({long}, 1) end)"),
        format!("s:interpret(\"A(x)\", function(this, x) this:color({long}) end)"),
    ] {
        let said = refused_rules(&rules);
        assert!(said.len() < 6000, "{} bytes: {rules}", said.len());
    }
    let said = refused_rules(&format!(
        "s:axiom(A({long}))\ns:rule(\"A(x)\", function(this, x)\n  error(\"wrong\")\nend)"
    ));
    let shown = "abc".repeat(33);
    assert_eq!(
        without_columns(&said),
        format!(
            "error: s.lua:5: rule A(x): wrong\n  | error(\"wrong\")\n  module: A(\"{shown}... (900002 characters in all) ...{shown}\"), step 1\n"
        )
    );
}
