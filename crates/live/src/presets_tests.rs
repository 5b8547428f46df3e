//! Tests of the presets of a script.

use burgeon_engine::script::{PointRows, Preset, Setting};

use crate::presets::Presets;

fn preset(name: &str, twist: f64) -> Preset {
    let params = vec![
        ("twist".to_owned(), Setting::Number(twist)),
        ("lit".to_owned(), Setting::Boolean(true)),
        ("kind".to_owned(), Setting::Text("a \"b\"".to_owned())),
        ("taper".to_owned(), Setting::Points(PointRows(vec![vec![0.0, 1.0], vec![1.0, 0.25]]))),
    ];
    Preset { name: name.to_owned(), seed: Some(u64::MAX), params, ..Preset::default() }
}

fn refused(text: &str) -> String {
    let folder = tempfile::tempdir().unwrap();
    let script = folder.path().join("tower.lua");
    std::fs::write(Presets::path_of(&script), text).unwrap();
    let error = Presets::read(&script).unwrap_err();
    assert!(error.place().is_some(), "{error}");
    Presets::save(&script, preset("tall", 1.0)).unwrap_err();
    assert_eq!(std::fs::read_to_string(Presets::path_of(&script)).unwrap(), text);
    error.to_string().replace(&folder.path().display().to_string(), "FOLDER")
}

#[test]
fn what_is_saved_reads_back_and_the_others_stay() {
    let folder = tempfile::tempdir().unwrap();
    let script = folder.path().join("tower.lua");
    assert_eq!(Presets::read(&script).unwrap().names().count(), 0);
    for (name, twist) in [("tall", 2.5), ("flat", 3.0), ("tall", -4.0)] {
        Presets::save(&script, preset(name, twist)).unwrap();
    }
    let presets = Presets::read(&script).unwrap();
    assert_eq!(presets.names().collect::<Vec<_>>(), ["tall", "flat"]);
    let tall = presets.get("tall").unwrap();
    assert_eq!((&tall.params, tall.seed), (&preset("tall", -4.0).params, Some(u64::MAX)));
    assert_eq!(tall.places.iter().map(|place| place.line).collect::<Vec<_>>(), [5, 6, 7, 8]);
    insta::assert_snapshot!(std::fs::read_to_string(Presets::path_of(&script)).unwrap(), @r#"
    {
      "tall": {
        "seed": 18446744073709551615,
        "params": {
          "twist": -4,
          "lit": true,
          "kind": "a \"b\"",
          "taper": [
            [0, 1],
            [1, 0.25]
          ]
        }
      },
      "flat": {
        "seed": 18446744073709551615,
        "params": {
          "twist": 3,
          "lit": true,
          "kind": "a \"b\"",
          "taper": [
            [0, 1],
            [1, 0.25]
          ]
        }
      }
    }
    "#);
    Presets::remove(&script, "tall").unwrap();
    assert_eq!(Presets::read(&script).unwrap().names().collect::<Vec<_>>(), ["flat"]);
    assert!(Presets::remove(&script, "tall").is_err());
    assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 1);
    Presets::remove(&script, "flat").unwrap();
    assert_eq!(Presets::read(&script).unwrap().names().count(), 0);
    assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 0);
}

#[test]
fn a_file_of_another_form_is_refused_with_its_line_and_kept() {
    insta::assert_snapshot!(refused("{\n  \"tall\": {\n    \"seed\": 7,,\n"), @r"
    FOLDER/tower.presets.json:3: this is not JSON: key must be a string
      help: fix the file, or move it away
    ");
    insta::assert_snapshot!(refused(""), @r"
    FOLDER/tower.presets.json:1: this is not JSON: EOF while parsing a value
      help: fix the file, or move it away
    ");
    insta::assert_snapshot!(refused("[1, 2]"), @r#"
    FOLDER/tower.presets.json:1: the file is [1, 2], not an object
      help: write { "name": { "seed": 0, "params": {} } }
    "#);
    insta::assert_snapshot!(refused("{ \"tall\": 3 }"), @r#"
    FOLDER/tower.presets.json:1: preset tall is 3, not an object
      help: write { "seed": 0, "params": {} }
    "#);
    insta::assert_snapshot!(refused("{ \"tall\": {\n\"sed\": 3 } }"), @r"
    FOLDER/tower.presets.json:2: unknown field `sed` in preset tall
      help: did you mean seed?
    ");
    insta::assert_snapshot!(refused("{ \"tall\": {\n\"floors\": 3 } }"), @r"
    FOLDER/tower.presets.json:2: unknown field `floors` in preset tall
      help: a preset has a seed, params, and another one that it extends; put parameters into params
    ");
    insta::assert_snapshot!(refused("{ \"tall\": { \"seed\": -1 } }"), @r"
    FOLDER/tower.presets.json:1: preset tall: invalid seed -1
      help: write an integer of at least 0
    ");
    insta::assert_snapshot!(refused("{ \"tall\": { \"seed\": 1e400 } }"), @r"
    FOLDER/tower.presets.json:1: preset tall: invalid seed 1e400
      help: write an integer of at least 0
    ");
    insta::assert_snapshot!(refused("{ \"tall\": { \"params\": {\n\n\"a\": [[0, 1],\n1] } } }"), @r"
    FOLDER/tower.presets.json:4: preset tall: a: point 2 is 1, not a list of numbers
      help: write a list of points: [[0, 1], [1, 0.2]]
    ");
    insta::assert_snapshot!(refused("{ \"tall\": { \"params\": {\n\n\"a\": null } } }"), @r"
    FOLDER/tower.presets.json:3: preset tall: invalid value null for a
      help: write a number, true, false, a string or a list of points
    ");
    insta::assert_snapshot!(refused("{ \"tall\": { \"params\": { \"a\": 1e999 } } }"), @r"
    FOLDER/tower.presets.json:1: preset tall: invalid value 1e999 for a
      help: write a number, true, false, a string or a list of points
    ");
    insta::assert_snapshot!(refused("{ \"tall\": {},\n\"tall\": {} }"), @r"
    FOLDER/tower.presets.json:2: the file has two members named `tall`
      help: remove or rename one of them
    ");
}

#[test]
fn a_preset_that_extends_others_has_their_values_and_the_nearest_ones_win() {
    let folder = tempfile::tempdir().unwrap();
    let script = folder.path().join("t.lua");
    let file = r#"{ "dark": { "extends": "tall", "params": { "lit": false } },
        "tall": { "extends": "base", "seed": 7, "params": { "floors": 60 } },
        "base": { "seed": 1, "params": { "floors": 3, "lit": true, "twist": 2 } } }"#;
    std::fs::write(Presets::path_of(&script), file).unwrap();
    let dark = Presets::read(&script).unwrap().get("dark").unwrap();
    let number = |name: &str, value: f64| (name.to_owned(), Setting::Number(value));
    let lit = ("lit".to_owned(), Setting::Boolean(false));
    assert_eq!((dark.params, dark.seed), (vec![lit, number("floors", 60.0), number("twist", 2.0)], Some(7)));
    let lines: Vec<usize> = dark.places.iter().map(|place| place.line).collect();
    assert_eq!(lines, [1, 2, 3]);
    // The file keeps what extends what.
    Presets::save(&script, preset("new", 1.0)).unwrap();
    let written = std::fs::read_to_string(Presets::path_of(&script)).unwrap();
    assert_eq!(written.matches("\"extends\"").count(), 2);
    let kept = Presets::remove(&script, "tall").unwrap_err().to_string();
    assert!(kept.contains("preset dark extends tall, which stays"), "{kept}");
    Presets::remove(&script, "dark").unwrap();
    Presets::remove(&script, "tall").unwrap();
}

#[test]
fn a_preset_that_extends_itself_or_nothing_is_refused() {
    let unknown = refused("{ \"a\": {\n\"extends\": \"b\" }, \"c\": {} }");
    assert!(unknown.contains(":2: preset a extends the unknown preset `b`"), "{unknown}");
    let circle = refused("{ \"a\": { \"extends\": \"b\" },\n\"b\": { \"extends\": \"a\" } }");
    assert!(circle.contains(":1: preset a extends itself, by way of"), "{circle}");
    let number = refused("{ \"a\": { \"extends\": 3 } }");
    assert!(number.contains("preset a: invalid name 3 in extends"), "{number}");
    let chain: Vec<String> =
        (0..40).map(|number| format!("\"p{number}\": {{ \"extends\": \"p{}\" }}", number + 1)).collect();
    let long = refused(&format!("{{ {}, \"p40\": {{}} }}", chain.join(",\n")));
    assert!(long.contains("preset p0 extends more than 16 others"), "{long}");
}

#[test]
fn names_that_look_the_same_are_one() {
    let folder = tempfile::tempdir().unwrap();
    let script = folder.path().join("t.lua");
    Presets::save(&script, preset("e\u{301}te\u{301}", 1.0)).unwrap();
    let presets = Presets::save(&script, preset("\u{e9}t\u{e9}", 2.0)).unwrap();
    assert_eq!(presets.names().collect::<Vec<_>>(), ["\u{e9}t\u{e9}"]);
    assert_eq!(presets.get("e\u{301}te\u{301}").unwrap().params[0].1, Setting::Number(2.0));
    assert!(refused("{ \"\u{e9}\": {},\n\"e\u{301}\": {} }").contains("two members named"));
}

#[cfg(unix)]
#[test]
fn a_link_is_not_read_and_nothing_of_its_target_is_shown() {
    let folder = tempfile::tempdir().unwrap();
    let (script, secret) = (folder.path().join("t.lua"), folder.path().join("secret"));
    std::fs::write(&secret, "password = hunter2\n").unwrap();
    std::os::unix::fs::symlink(&secret, Presets::path_of(&script)).unwrap();
    for error in [
        Presets::read(&script).unwrap_err(),
        Presets::save(&script, preset("a", 1.0)).unwrap_err(),
        Presets::remove(&script, "a").unwrap_err(),
    ] {
        let text = format!("{error} {:?}", error.place());
        assert!(text.contains("it is a link") && !text.contains("hunter2"), "{text}");
        assert!(error.place().is_none(), "{text}");
    }
    assert_eq!(std::fs::read_to_string(&secret).unwrap(), "password = hunter2\n");
}

#[test]
fn a_name_that_is_hard_to_write_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    for name in ["", " ", "a ", "a\nb", "\u{7}", "a\u{202e}b", "\u{2067}a", &"x".repeat(81)] {
        assert!(Presets::save(&folder.path().join("t.lua"), preset(name, 1.0)).is_err(), "{name:?}");
    }
    assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 0);
}
