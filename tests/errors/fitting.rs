//! Tests of `burgeon fit`.

use burgeon::terrain::fit::{Search, Target};
use insta::assert_snapshot;

use crate::support::{Folder, assert_decent};

/// Script that prints the height of the ground at every eighth inner corner of the cells.
const SCRIPT: &str = r#"--!strict
local fitted = require("rules")
local ground = lsystem({
  object = terrain({
    size = 1024,
    levels = fitted.levels,
    smooth = false,
    rules = fitted.rules,
    start = fitted.start,
    decay = fitted.decay,
    height = fitted.height,
  }),
})
local Whole = module("Whole")
ground:axiom(Whole())
local made = ground:derive(0).objects[1]
for y = 64, 960, 64 do
  for x = 64, 960, 64 do
    print(string.format("%.17g", made:height({ x - 512, 512 - y, 0 })))
  end
end
"#;

/// Returns the error message for a wrong command line.
fn wrong(arguments: &[&str]) -> String {
    let folder = Folder::new();
    let said = folder.burgeon(arguments);
    assert_eq!((said.status, said.stdout.as_str()), (2, ""), "{}", said.stderr);
    assert_decent(&said.stderr);
    assert!(folder.files().is_empty());
    let machine = folder.burgeon(&[arguments, &["--json"]].concat());
    assert_eq!((machine.status, machine.json()["ok"].as_bool()), (2, Some(false)));
    said.stderr
}

#[test]
fn a_script_reads_what_was_found_and_has_the_map_of_the_search() {
    let folder = Folder::new().with("script.lua", SCRIPT);
    let flags =
        ["fit", "crater", "-o", "rules.lua", "--rounds", "2", "--seed", "5", "--symbols", "9", "--json"];
    let said = folder.burgeon(&flags).done();
    assert_eq!(said.stderr, "");
    let document = said.json();
    let target = Target::named("crater").unwrap();
    let search = Search { rounds: 2, seed: 5, symbols: 9, ..Search::default() };
    let fitted = search.run(&target, &|| false, &mut |_| {});
    // As a number, the value could differ in its last digit.
    assert!(said.stdout.contains(&format!("\"error\":{},", fitted.error())), "{}", said.stdout);
    assert_eq!(document["symbols"], fitted.symbols());
    assert_eq!((document["tried"].as_u64(), &document["file"]), (Some(192), &"rules.lua".into()));
    let text = folder.read("rules.lua");
    assert_snapshot!(text.lines().take(2).collect::<Vec<_>>().join("\n"), @r"
    --!strict
    -- A rule table for terrain: fitted to crater.
    ");
    assert!(text.contains(&format!("error {} of", fitted.error())) && text.contains("; seed 5."));

    let map = fitted.map().unwrap();
    let run = folder.burgeon(&["run", "script.lua", "--json"]).done();
    let heights: Vec<f64> = run.stderr.lines().map(|line| line.parse().unwrap()).collect();
    assert_eq!(heights.len(), 225);
    for (at, height) in heights.into_iter().enumerate() {
        // The height at a corner is the mean of the four cells around it.
        let (x, y) = (8 * (at % 15 + 1), 8 * (at / 15 + 1));
        let around = [(x - 1, y - 1), (x, y - 1), (x - 1, y), (x, y)];
        let mean = around.iter().map(|(x, y)| map[y * 128 + x]).sum::<f64>() / 4.0;
        assert!((height - mean).abs() < 1e-9, "{height} is not {mean} at {x}, {y}");
    }
}

#[test]
fn a_table_is_the_same_for_any_number_of_threads_and_takes_the_place_of_an_older_one() {
    let folder = Folder::new();
    let fit = |flags: &[&str]| {
        let said =
            folder.burgeon(&[&["fit", "hill", "-o", "rules.lua", "--rounds", "2"], flags].concat()).done();
        assert_eq!((said.stdout.as_str(), folder.files().len()), ("", 1));
        assert!(said.stderr.starts_with("rules.lua: root mean square error 0.0"), "{}", said.stderr);
        folder.read("rules.lua")
    };
    let one = fit(&["--threads", "1"]);
    assert_eq!(one, fit(&["--threads", "3", "--seed", "0"]));
    assert_ne!(one, fit(&["--seed", "1"]));
}

#[test]
fn a_table_is_fitted_to_heights_in_each_format_and_wherever_they_lie() {
    let folder = Folder::new();
    let bytes = |columns: usize, rows: usize, write: &dyn Fn(f64) -> Vec<u8>| -> Vec<u8> {
        let height = |at: usize| {
            let [x, y] = [at % columns, at / columns].map(|at| at as f64 / 300.0);
            1000.0 + 200.0 * (x.sin() + (y * 1.3).cos())
        };
        (0..columns * rows).flat_map(|at| write(height(at))).collect()
    };
    let write = |name: &str, bytes: Vec<u8>| std::fs::write(folder.path().join(name), bytes).unwrap();
    let hgt = bytes(1201, 1201, &|height| (height as i16).to_be_bytes().to_vec());
    write("N43E007.hgt", hgt.clone());
    write("copy.hgt", hgt);
    write("ground.r32", bytes(120, 120, &|height| (height as f32).to_le_bytes().to_vec()));
    write("ground.r64", bytes(120, 120, &|height| height.to_le_bytes().to_vec()));
    let grid = bytes(90, 60, &|height| format!("{height:.2} ").into_bytes());
    let head = b"ncols 90\nnrows 60\nxllcorner 380000\nyllcorner 6670000\ncellsize 2\nnodata_value -9999\n";
    write("ground.asc", [&head[..], &grid].concat());
    let cell = "ncols 90\nnrows 60\nxllcorner 7\nyllcorner 43\ncellsize 0.0002\n";
    write("degrees.asc", [cell.as_bytes(), &grid].concat());
    let corpus = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("fuzz/corpus");
    let copied = [
        ("zip/good", "tile.zip"),
        ("geotiff/good_floats_f32", "floats.tif"),
        ("geotiff/good_point_u16", "whole.tif"),
        ("geotiff/good_tiles_i16", "tiles.tif"),
        ("png/good", "gray.png"),
    ];
    for (from, to) in copied {
        std::fs::copy(corpus.join(from), folder.path().join(to)).unwrap();
    }
    let names = ["N43E007.hgt", "copy.hgt", "ground.r32", "ground.r64", "ground.asc", "degrees.asc"];
    for name in names.into_iter().chain(copied.map(|(_, name)| name)) {
        let said =
            folder.burgeon(&["fit", name, "-o", "rules.lua", "--rounds", "1", "--symbols", "4"]).done();
        assert!(said.stderr.starts_with("rules.lua: root mean square error 0."), "{name}: {}", said.stderr);
    }
}

#[test]
fn when_the_time_is_over_the_best_is_written() {
    let folder = Folder::new();
    folder.burgeon(&["fit", "mountains", "-o", "rules.lua", "--seconds", "0.001"]).done();
    assert!(folder.read("rules.lua").ends_with("}\n"));
}

#[test]
fn rounds_end_the_search_however_long_they_take_unless_a_time_is_given_too() {
    let folder = Folder::new();
    let rounds = ["fit", "mountains", "-o", "rules.lua", "--rounds", "3", "--json"];
    let whole = folder.burgeon(&rounds).done().json();
    assert_eq!((&whole["warnings"], &whole["tried"]), (&serde_json::json!([]), &288.into()));
    let cut = folder.burgeon(&[&rounds[..], &["--seconds", "0.001"]].concat()).done().json();
    let told = "--seconds ended the search after 0 of 3 rounds, so the result depends on the machine";
    assert_eq!(cut["warnings"], serde_json::json!([told]));
    let cut = folder.burgeon(&[&rounds[..6], &["--seconds", "0.001"]].concat()).done();
    assert!(cut.stderr.ends_with(&format!("warning: {told}\n  help: remove --seconds\n")), "{}", cut.stderr);
    let help = folder.burgeon(&["fit", "--help"]).done().stdout;
    assert!(help.contains("[default: 60, or no such limit with --rounds]"), "{help}");
}

#[test]
fn a_target_or_a_file_that_cannot_be_is_refused_before_the_search() {
    let folder = Folder::new().with("mine.lua", "local n = 3\n").with("folder.lua/a.txt", "");
    assert_snapshot!(folder.refuses(&["fit", "mountain", "-o", "rules.lua"]), @r"
    error: unknown target `mountain`
      help: did you mean mountains?
    ");
    assert_snapshot!(folder.refuses(&["fit", "heights.tif", "-o", "rules.lua"]), @r"
    error: unknown target `heights.tif`
      help: the targets are hill, ridge, crater, plain, mountains
    ");
    assert_snapshot!(folder.refuses(&["fit", "hill", "-o", "no/rules.lua"]), @r"
    error: cannot write no/rules.lua: folder not found: no
      help: create the folder first, or write to an existing folder
    ");
    assert_snapshot!(folder.refuses(&["fit", "hill", "-o", "folder.lua"]), @r"
    error: cannot write folder.lua: it is a folder
      help: specify a file in it, such as folder.lua/rules.lua
    ");
    assert_snapshot!(folder.refuses(&["fit", "hill", "-o", "mine.lua"]), @r"
    error: mine.lua already exists and is not a fitted rule table
      help: specify another file, or move that file away
    ");
}

#[test]
fn a_wrong_command_line_is_told_what_is_right() {
    assert_snapshot!(wrong(&["fit", "hill"]), @r"
    error: the following required arguments were not provided:
      --output <FILE>

    Usage: burgeon fit --output <FILE> <TARGET>

    For more information, try '--help'.
    ");
    assert_snapshot!(wrong(&["fit", "-o", "rules.lua"]), @r"
    error: the following required arguments were not provided:
      <TARGET>

    Usage: burgeon fit --output <FILE> <TARGET>

    For more information, try '--help'.
    ");
    assert_snapshot!(wrong(&["fit", "hill", "-o", "rules.glb"]), @r"
    error: invalid value 'rules.glb' for '--output <FILE>': a rule table is a Lua file: specify a .lua file

    For more information, try '--help'.
    ");
    let hill = ["fit", "hill", "-o", "rules.lua"];
    assert_snapshot!(wrong(&[&hill[..], &["--seconds", "0"]].concat()), @r"
    error: invalid value '0' for '--seconds <SECONDS>': write a number of seconds above 0

    For more information, try '--help'.
    ");
    assert_snapshot!(wrong(&[&hill[..], &["--seconds", "-3"]].concat()), @r"
    error: invalid value '-3' for '--seconds <SECONDS>': write a number of seconds above 0

    For more information, try '--help'.
    ");
    assert_snapshot!(wrong(&[&hill[..], &["--symbols", "0"]].concat()), @r"
    error: invalid value '0' for '--symbols <N>': 0 is not in 1..=64

    For more information, try '--help'.
    ");
    assert_snapshot!(wrong(&[&hill[..], &["--symbols", "65"]].concat()), @r"
    error: invalid value '65' for '--symbols <N>': 65 is not in 1..=64

    For more information, try '--help'.
    ");
    assert_snapshot!(wrong(&[&hill[..], &["--rounds", "many"]].concat()), @r"
    error: invalid value 'many' for '--rounds <N>': write an integer of at least 0

    For more information, try '--help'.
    ");
}
