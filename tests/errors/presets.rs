//! Presets: `--preset`, `--save-preset`, and the preset file next to the script.

use insta::assert_snapshot;

use crate::support::{Folder, Said};

const SCRIPT: &str = r#"local floors = param("floors", { default = 3, min = 1, max = 90 })
local lit = param("lit", { default = false })
local kind = param("kind", { default = "a", choices = { "a", "b" } })
local A = module("A", "n", "lit", "kind", "chance")
local s = lsystem()
s:axiom(A(floors, lit, kind, 0))
s:rule("A(n, l, k, c)", function(this, n, l, k, c) return A(n, l, k, random()) end)
s:derive(1)
"#;

const PRESETS: &str = r#"{
  "tall": { "seed": 7, "params": { "floors": 60, "lit": true } },
  "other": { "params": { "kind": "b" } }
}
"#;

fn folder() -> Folder {
    Folder::new().with("tower.lua", SCRIPT).with("tower.presets.json", PRESETS)
}

fn chain(said: Said) -> String {
    said.done().stdout
}

fn run(flags: &[&str]) -> String {
    chain(folder().burgeon(&[&["run", "tower.lua", "--chain", "-"], flags].concat()))
}

fn refused(presets: &str, flags: &[&str]) -> String {
    let folder = Folder::new().with("tower.lua", SCRIPT).with("tower.presets.json", presets);
    folder.refuses(&[&["run", "tower.lua"], flags].concat())
}

#[test]
fn a_preset_gives_parameters_and_seed_and_what_is_given_by_hand_wins() {
    let tall = run(&["--preset", "tall"]);
    assert!(tall.starts_with("A(60,true,\"a\","), "{tall}");
    assert_eq!(tall, run(&["--seed", "7", "--set", "floors=60", "--set", "lit=true"]));
    assert_eq!(
        run(&["--preset", "tall", "--set", "floors=5", "--seed", "0"]),
        run(&["--set", "floors=5", "--set", "lit=true"])
    );
    assert_eq!(run(&["--preset", "other", "--seed", "9"]), run(&["--set", "kind=b", "--seed", "9"]));
    assert_eq!(run(&["--preset", "other"]), run(&["--set", "kind=b"]));
    folder().burgeon(&["check", "tower.lua", "--preset", "tall"]).done();
}

#[test]
fn a_style_overrides_the_preset_that_it_extends_and_options_override_both() {
    let presets = "{ \"tall\": { \"seed\": 7, \"params\": { \"floors\": 60, \"lit\": true } },\n\"dark\": { \"extends\": \"tall\", \"params\": { \"lit\": false } } }";
    let run = |flags: &[&str]| {
        let folder = Folder::new().with("tower.lua", SCRIPT).with("tower.presets.json", presets);
        chain(folder.burgeon(&[&["run", "tower.lua", "--chain", "-"], flags].concat()))
    };
    let dark = run(&["--preset", "dark"]);
    assert!(dark.starts_with("A(60,false,\"a\","), "{dark}");
    assert_eq!(dark, run(&["--seed", "7", "--set", "floors=60"]));
    assert!(run(&["--preset", "dark", "--set", "floors=2"]).starts_with("A(2,false"));
    assert_snapshot!(refused("{ \"tall\": { \"params\": {\n\"flors\": 60 } },\n\"dark\": { \"extends\": \"tall\" } }", &["--preset", "dark"]), @r#"
    error: tower.presets.json:2:2: preset dark sets the unknown parameter `flors` of tower.lua
      | "flors": 60 } },
      |  ^^^^^
      help: did you mean floors?
    "#);
}

#[test]
fn an_unknown_preset_is_told_with_the_nearest_or_with_all() {
    assert_snapshot!(refused(PRESETS, &["--preset", "tal"]), @r"
    error: unknown preset `tal` in tower.presets.json
      help: did you mean tall?
    ");
    assert_snapshot!(refused(PRESETS, &["--preset", "wide"]), @r"
    error: unknown preset `wide` in tower.presets.json
      help: it has tall, other
    ");
    assert_snapshot!(Folder::new().with("tower.lua", SCRIPT).refuses(&["run", "tower.lua", "--preset", "tall"]), @r"
    error: unknown preset `tall`: the script has no presets
      help: write presets into tower.presets.json, or save one: burgeon run --save-preset NAME
    ");
    assert_snapshot!(Folder::new().refuses(&["run", "tower.lua", "--preset", "tall"]), @r"
    error: script not found: tower.lua
      help: check the path, or create a script: burgeon new NAME
    ");
}

#[test]
fn a_preset_that_does_not_fit_the_script_any_more_is_told_with_its_line() {
    assert_snapshot!(refused("{ \"tall\": { \"params\": {\n\"flors\": 60 } } }", &["--preset", "tall"]), @r#"
    error: tower.presets.json:2:2: preset tall sets the unknown parameter `flors` of tower.lua
      | "flors": 60 } } }
      |  ^^^^^
      help: did you mean floors?
    "#);
    assert_snapshot!(refused("{ \"tall\": { \"params\": {\n\"wings\": 2 } } }", &["--preset", "tall"]), @r#"
    error: tower.presets.json:2:2: preset tall sets the unknown parameter `wings` of tower.lua
      | "wings": 2 } } }
      |  ^^^^^
      help: remove wings from the preset, or declare it again: param("wings", ...)
    "#);
    assert_snapshot!(refused("{ \"tall\": { \"params\": {\n\"floors\": 100 } } }", &["--preset", "tall"]), @r#"
    error: tower.presets.json:2:1: preset tall: param floors is 100, out of its range
      | "floors": 100 } } }
      | ^^^^^^^^^^^^^^^^^^^
      help: the allowed values are 1 to 90; change the preset
    "#);
    assert_snapshot!(refused("{ \"tall\": { \"params\": {\n\"lit\": \"maybe\" } } }", &["--preset", "tall"]), @r#"
    error: tower.presets.json:2:9: preset tall: param lit must be true or false, not "maybe"
      | "lit": "maybe" } } }
      |         ^^^^^
      help: its default is false; change the preset
    "#);
    assert_snapshot!(refused("{ \"tall\": { \"params\": {\n\"kind\": \"c\" } } }", &["--preset", "tall"]), @r#"
    error: tower.presets.json:2:10: preset tall: param kind is "c", which is not one of the choices
      | "kind": "c" } } }
      |          ^
      help: choose one of a, b; change the preset
    "#);
}

#[test]
fn a_broken_file_is_told_with_its_line_and_kept() {
    let broken = "{\n\"tall\": {\n";
    let said = refused(broken, &["--preset", "tall"]);
    assert_eq!(said, refused(broken, &["--save-preset", "tall"]));
    assert_snapshot!(said, @r"
    error: tower.presets.json:3: this is not JSON: EOF while parsing an object
      help: fix the file, or move it away
    ");
}

#[test]
fn a_run_saves_what_it_was_given_and_keeps_the_other_presets() {
    let folder = folder();
    folder
        .burgeon(&["run", "tower.lua", "--preset", "tall", "--set", "lit=false", "--save-preset", "dark"])
        .done();
    assert_snapshot!(folder.read("tower.presets.json"), @r#"
    {
      "tall": {
        "seed": 7,
        "params": {
          "floors": 60,
          "lit": true
        }
      },
      "other": {
        "params": {
          "kind": "b"
        }
      },
      "dark": {
        "seed": 7,
        "params": {
          "floors": 60,
          "lit": false
        }
      }
    }
    "#);
    let saved = chain(folder.burgeon(&["run", "tower.lua", "--chain", "-", "--preset", "dark"]));
    assert_eq!(saved, run(&["--preset", "tall", "--set", "lit=false"]));
    assert_eq!(folder.files().len(), 2);
}

#[test]
fn a_run_that_fails_saves_nothing() {
    let said = refused(PRESETS, &["--set", "floors=0", "--save-preset", "none"]);
    assert!(said.contains("out of its range"), "{said}");
    assert_snapshot!(refused(PRESETS, &["--save-preset", " "]), @r#"
    error: " " cannot be the name of a preset
      help: use 1 to 80 characters, without line breaks, bidirectional controls, and spaces at the beginning or the end
    "#);
}
