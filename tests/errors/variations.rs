//! Tests of `burgeon variations`.

use insta::assert_snapshot;

use crate::support::{Folder, assert_decent};

const SCRIPT: &str = r#"local n = param("n", { default = 2, min = 1, max = 6, unit = "m" })
local kind = param("kind", { default = "a", choices = { "a", "b" } })
local A = module("A", "x")
local s = lsystem({ object = turtle({ width = 0.2 }) })
s:axiom(A(n))
s:rule("A(x)", function(this, x)
  if n == 3 then error("three is too many") end
  return F(x * random(0.9, 1.1))
end)
s:derive()
"#;

fn folder() -> Folder {
    Folder::new().with("s.lua", SCRIPT).with("sheet.png", "old")
}

fn arguments<'a>(flags: &[&'a str]) -> Vec<&'a str> {
    [&["variations", "s.lua", "-o", "sheet.png", "--size", "40x30"], flags].concat()
}

/// Returns the error message for a command line that is wrong or does not fit the script.
fn told(flags: &[&str], status: i32) -> String {
    let folder = folder();
    let said = folder.burgeon(&arguments(flags));
    assert_eq!((said.status, said.stdout.as_str()), (status, ""), "{}", said.stderr);
    assert_decent(&said.stderr);
    assert_eq!(folder.read("sheet.png"), "old");
    assert_eq!(folder.burgeon(&arguments(&[flags, &["--json"]].concat())).json()["ok"], false);
    said.stderr
}

#[test]
fn a_sheet_is_the_same_for_any_number_of_threads_and_tells_its_cells() {
    let sheet = |flags: &[&str]| {
        let folder = folder();
        let said = folder.burgeon(&arguments(flags)).done();
        assert_eq!(folder.files().len(), 2);
        (std::fs::read(folder.path().join("sheet.png")).unwrap(), said)
    };
    let (one, said) = sheet(&["--seeds", "1..4", "--threads", "1"]);
    assert!(said.stderr.starts_with("4 variations, 2 in a row; "), "{}", said.stderr);
    let (three, said) = sheet(&["--seeds", "1..4", "--threads", "3", "--json"]);
    assert!(one == three && one.starts_with(b"\x89PNG"));
    let mut document = said.json();
    document["seconds"] = 0.into();
    document["cells"].as_array_mut().unwrap().truncate(1);
    assert_snapshot!(document, @r#"{"ok":true,"columns":2,"rows":2,"size":[92,114],"cells":[{"label":"seed 1","seed":1,"params":{"n":2.0,"kind":"a"},"modules":1,"triangles":28,"warnings":[]}],"warnings":[],"seconds":0}"#);
    assert_eq!(said.stderr, "");
    assert!(sheet(&["--seeds", "5..8"]).0 != one);
    sheet(&["--sweep", "kind", "--fit", "all", "--columns", "1", "--background", "dark", "--azimuth", "10"]);
}

#[test]
fn without_seeds_nine_are_shown_and_equal_pictures_are_told() {
    let folder = folder();
    let said = folder.burgeon(&arguments(&[])).done();
    assert!(said.stderr.starts_with("9 variations, "), "{}", said.stderr);
    let own = SCRIPT.replace("lsystem({ object", "lsystem({ seed = 7, object");
    let folder = folder.with("s.lua", &own);
    let said = folder.burgeon(&arguments(&["--seeds", "1..3"])).done();
    let (warning, rest) = said.stderr.split_once("\n3 variations").expect("a warning");
    assert!(!rest.is_empty());
    assert_snapshot!(warning, @r"
    warning: s.lua:4:21: the 3 pictures are equal: lsystem has its own `seed`
      | local s = lsystem({ seed = 7, object = turtle({ width = 0.2 }) })
      |                     ^^^^
      help: remove `seed` from lsystem, so that each run has another
    ");
    let document = folder.burgeon(&arguments(&["--seeds", "1..3", "--json"])).done().json();
    assert_eq!(document["warnings"][0]["kind"], "no-effect");
    assert_eq!(document["warnings"][0]["file"], "s.lua");
}

#[test]
fn a_variation_that_fails_is_told_and_leaves_the_others_alone() {
    let folder = folder();
    let said = folder.burgeon(&arguments(&["--sweep", "n=2..4"])).done();
    assert!(said.stderr.ends_with(" in all\n"));
    assert_snapshot!(said.stderr.rsplit_once(';').unwrap().0, @r#"
    n 3 m failed
    error: s.lua:7:3: rule A(x): three is too many
      | if n == 3 then error("three is too many") end
      | ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^
      module: A(3), step 1
    3 variations, 1 of them failed, 3 in a row
    "#);
    let document = folder.burgeon(&arguments(&["--sweep", "n=2..4", "--json"])).done().json();
    assert_eq!(document["cells"][1]["errors"][0]["line"], 7);
    assert_eq!(document["cells"][2]["set"]["n"], "4");
}

#[test]
fn if_all_variations_fail_the_reasons_are_told_once() {
    assert_snapshot!(told(&["--seeds", "1..9", "--set", "n=3"], 1), @r#"
    error: s.lua:7:3: rule A(x): three is too many
      | if n == 3 then error("three is too many") end
      | ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^
      module: A(3), step 1
    "#);
    assert_snapshot!(Folder::new().refuses(&["variations", "no.lua", "--seeds", "1..9", "-o", "a.png"]), @r"
    error: script not found: no.lua
      help: check the path, or create a script: burgeon new NAME
    ");
}

#[test]
fn values_that_the_script_does_not_have_are_refused_before_anything_runs() {
    assert_snapshot!(told(&["--sweep", "nn=1..3"], 1), @r"
    error: s.lua: unknown parameter `nn`
      help: did you mean n?
    ");
    assert_snapshot!(told(&["--sweep", "n=1..9"], 1), @r"
    error: param n is 7, out of its range
      help: the allowed values are 1 to 6
    ");
    assert_snapshot!(told(&["--sweep", "kind=a,c"], 1), @r#"
    error: param kind is "c", which is not one of the choices
      help: choose one of a, b
    "#);
    assert_snapshot!(told(&["--sweep", "n"], 1), @r"
    error: param n has no choices
      help: specify the values: n=LOW..HIGH:STEP or n=A,B,C
    ");
    assert_snapshot!(told(&["--sweep", "n=1..3", "--set", "n=2"], 1), @r"
    error: --set and --sweep both use `n`; remove one
      help: remove --set n or --sweep n
    ");
    let flags = ["variations", "s.lua", "--seeds", "1..200", "--columns", "200", "-o", "sheet.png"];
    assert_snapshot!(folder().refuses(&flags), @r"
    error: the sheet would be 66613 x 388 pixels, more than 16384 on a side
      help: use smaller cells, --size WIDTHxHEIGHT, or fewer of them
    ");
}

#[test]
fn a_command_line_that_makes_no_sheet_says_what_would() {
    let folder = folder();
    let wrong = |flags: &[&str]| {
        let said = folder.burgeon(&[&["variations", "s.lua"], flags].concat());
        assert_eq!((said.status, said.stdout.as_str()), (2, ""), "{}", said.stderr);
        said.stderr
    };
    assert_snapshot!(wrong(&["--seeds", "1..4"]), @r"
    error: the following required arguments were not provided:
      --output <FILE>

    Usage: burgeon variations --output <FILE> --seeds <SEEDS> <SCRIPT>

    For more information, try '--help'.
    ");
    assert_snapshot!(wrong(&["--seeds", "1..4", "-o", "a.glb"]), @r"
    error: invalid value 'a.glb' for '--output <FILE>': a contact sheet is an image: specify a .png file

    For more information, try '--help'.
    ");
    assert_snapshot!(wrong(&["--seeds", "1..4", "--sweep", "n=1", "-o", "a.png"]), @r"
    error: the argument '--seeds <SEEDS>' cannot be used with '--sweep <NAME=VALUES>'

    Usage: burgeon variations --output <FILE> --seeds <SEEDS> <SCRIPT>

    For more information, try '--help'.
    ");
    assert_snapshot!(wrong(&["--seeds", "9..4", "-o", "a.png"]), @r"
    error: invalid value '9..4' for '--seeds <SEEDS>': the range 9..4 is empty
      help: write 4..9

    For more information, try '--help'.
    ");
    assert_snapshot!(wrong(&["--sweep", "n=1..900", "-o", "a.png"]), @r"
    error: invalid value 'n=1..900' for '--sweep <NAME=VALUES>': 900 variations exceed the maximum of 256
      help: use a larger step: LOW..HIGH:STEP

    For more information, try '--help'.
    ");
    assert_snapshot!(wrong(&["--seeds", "1..4", "--columns", "0", "-o", "a.png"]), @r"
    error: invalid value '0' for '--columns <N>': write an integer of at least 1

    For more information, try '--help'.
    ");
}
