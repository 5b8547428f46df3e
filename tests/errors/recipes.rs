//! Recipes of models: written by `run`, read by `open`, and refused where they are broken or dangerous.

use std::fs;

use serde_json::{Value, json};

use crate::support::Folder;

/// Script with a parameter, a required file and a data file.
const SCRIPT: &str = r#"-- "quotes", </script> and 🌱
local parts = require("lib/parts")
local size = param("size", { default = 2, min = 1, max = 9, unit = "m" })
local dark = param("dark", { default = false })
local A = module("A", "x")
local s = lsystem({ object = extruder({ sides = 4 }) })
s:axiom(source("lots.geojson"), function(feature) return extruder({ sides = 4 }), A(parts.height) end)
s:interpret("A(x)", function(this, x) this:scale(size):extrude(x * random(1, 2)) end)
s:derive(1)
"#;

const LOTS: &str =
    r#"{"type":"Feature","id":"a","properties":{},"geometry":{"type":"Point","coordinates":[7.4,43.7]}}"#;

fn folder() -> Folder {
    Folder::new()
        .with("in/s.lua", SCRIPT)
        .with("in/lib/parts.lua", "return { height = 3 }\n")
        .with("data/lots.geojson", LOTS)
}

const RUN: [&str; 7] = ["run", "in/s.lua", "--data", "data", "--set", "size=4", "--seed=7"];

/// Returns the description of a `.glb` file.
fn document(folder: &Folder, name: &str) -> Value {
    let bytes = folder.read_bytes(name);
    let length = u32::from_le_bytes(bytes[12..16].try_into().unwrap()) as usize;
    serde_json::from_slice(&bytes[20..20 + length]).unwrap()
}

/// Writes a `.gltf` file with this recipe.
fn model(recipe: &Value) -> Folder {
    let document = json!({ "asset": { "version": "2.0", "extras": { "recipe": recipe } } });
    Folder::new().with("m.gltf", document.to_string())
}

fn recipe(files: &[(&str, &str)]) -> Value {
    let files: Vec<Value> = files.iter().map(|(name, text)| json!({ "name": name, "text": text })).collect();
    json!({ "program": env!("CARGO_PKG_VERSION"), "script": files[0]["name"], "files": files })
}

#[test]
fn a_model_has_its_scripts_values_and_hashes_and_no_absolute_path() {
    let folder = folder();
    folder.burgeon(&[&RUN[..], &["-o", "a.glb", "-o", "a.gltf", "--no-recipe"]].concat()).done();
    assert!(document(&folder, "a.glb")["asset"]["extras"]["recipe"].is_null());
    folder.burgeon(&[&RUN[..], &["-o", "a.glb"]].concat()).done();
    let recipe = document(&folder, "a.glb")["asset"]["extras"]["recipe"].clone();
    assert_eq!((&recipe["script"], &recipe["seed"]), (&json!("s.lua"), &json!(7)));
    assert_eq!(recipe["files"][0], json!({ "name": "s.lua", "text": SCRIPT }));
    assert_eq!(recipe["files"][1]["name"], "lib/parts.lua");
    assert_eq!(recipe["values"][0], json!({ "name": "size", "value": 4.0, "default": 2.0, "unit": "m" }));
    assert_eq!(recipe["values"][1], json!({ "name": "dark", "value": false }));
    assert_eq!(recipe["data"][0]["name"], "lots.geojson");
    assert_eq!(recipe["data"].as_array().unwrap().len(), 1);
    assert!(recipe["data"][0]["hash"].as_str().unwrap().starts_with("blake3:"));
    let text = String::from_utf8_lossy(&folder.read_bytes("a.glb")).into_owned();
    assert!(!text.contains(folder.path().to_str().unwrap()));
}

#[test]
fn the_bytes_depend_neither_on_the_folder_nor_on_the_threads() {
    let made = |threads: &str, name: &str| {
        let folder = folder();
        folder.burgeon(&[&RUN[..], &["-o", name, "--threads", threads]].concat()).done();
        folder.read_bytes(name)
    };
    for name in ["a.glb", "a.html"] {
        assert_eq!(made("1", name), made("4", name));
    }
}

#[test]
fn an_opened_model_is_made_again_with_the_same_values() {
    let folder = folder();
    folder.burgeon(&[&RUN[..], &["-o", "a.glb"]].concat()).done();
    let opened = folder.burgeon(&["open", "a.glb", "--no-live", "--data", "data", "--json"]).done().json();
    assert_eq!((&opened["script"], &opened["preset"]), (&json!("a-recipe/s.lua"), &json!("recipe")));
    assert_eq!(opened["missing"], json!([]));
    assert_eq!(folder.read("a-recipe/s.lua"), SCRIPT);
    let again = ["run", "a-recipe/s.lua", "--data", "data", "--preset", "recipe", "-o", "b.glb"];
    folder.burgeon(&again).done();
    let (mut old, mut new) = (document(&folder, "a.glb"), document(&folder, "b.glb"));
    for document in [&mut old, &mut new] {
        document["asset"]["extras"]["recipe"] = Value::Null;
    }
    assert_eq!(old, new);
    // Another folder is used the second time, and nothing is overwritten.
    let files = folder.files();
    let said = folder.burgeon(&["open", "a.glb", "--no-live", "--data", "data"]).done().stderr;
    insta::assert_snapshot!(said, @r"
    wrote the script to a-recipe-2/s.lua
    now: burgeon live a-recipe-2/s.lua --preset recipe
    ");
    let mut later = folder.files();
    later.retain(|name, _| !name.starts_with("a-recipe-2/"));
    assert_eq!(later, files);
    let error = folder.burgeon(&["open", "a.glb", "--no-live", "--into", "in"]).failed();
    assert!(error.contains("in exists and is no empty folder"), "{error}");
}

#[test]
fn missing_and_changed_parts_are_named() {
    let castle = "name = \"castle\"\nversion = \"1.2.0\"\napi = \"1.0\"\n";
    let folder = folder()
        .with("mods/castle/mod.toml", castle)
        .with("mods/castle/size.lua", "return 2")
        .with("in/s.lua", SCRIPT.replace("local A", "local wide = require(\"@castle/size\")\nlocal A"));
    folder.burgeon(&[&RUN[..], &["--mods", "mods", "-o", "a.glb"]].concat()).done();
    let said = |arguments: &[&str]| {
        folder.burgeon(&[&["open", "a.glb", "--no-live"], arguments].concat()).done().stderr
    };
    let all = said(&[]);
    assert!(all.contains("missing package: castle 1.2.0") && all.contains("--mods FOLDER"), "{all}");
    assert!(all.contains("missing data file: lots.geojson") && all.contains("--data FOLDER"), "{all}");
    let none = said(&["--mods", "mods", "--data", "data"]);
    assert!(!none.contains("warning"), "{none}");
    let folder = folder
        .with("mods/castle/size.lua", "return 3")
        .with("data/lots.geojson", LOTS.replace("43.7", "43.8"));
    let arguments = ["open", "a.glb", "--no-live", "--mods", "mods", "--data", "data"];
    let changed = folder.burgeon(&arguments).done().stderr;
    assert!(changed.contains("the package castle 1.2.0 has other files"), "{changed}");
    assert!(changed.contains("data/lots.geojson has changed since the model was made"), "{changed}");
    let error = folder.burgeon(&[&arguments[..], &["--strict"]].concat());
    assert_eq!(error.status, 1);
    let folder = folder.with("mods/castle/mod.toml", castle.replace("1.2.0", "1.3.0"));
    let newer = folder.burgeon(&arguments).done().stderr;
    assert!(newer.contains("the package castle has version 1.3.0, not 1.2.0"), "{newer}");
    assert!(newer.contains("install that version"), "{newer}");
}

#[test]
fn a_script_of_a_recipe_without_its_package_names_the_package() {
    let castle = "name = \"castle\"\nversion = \"1.2.0\"\napi = \"1.0\"\n";
    let folder = folder()
        .with("mods/castle/mod.toml", castle)
        .with("mods/castle/size.lua", "return 2")
        .with("in/s.lua", SCRIPT.replace("local A", "local wide = require(\"@castle/size\")\nlocal A"));
    folder.burgeon(&[&RUN[..], &["--mods", "mods", "-o", "a.glb"]].concat()).done();
    folder.burgeon(&["open", "a.glb", "--no-live", "--data", "data"]).done();
    let error = folder.burgeon(&["run", "a-recipe/s.lua", "--data", "data"]).failed();
    assert!(error.contains("castle") && error.contains("a-recipe/s.lua:5:"), "{error}");
}

#[test]
fn another_version_of_the_program_is_named() {
    let mut recipe = recipe(&[("s.lua", "")]);
    recipe["program"] = "0.0.1".into();
    let said = model(&recipe).burgeon(&["open", "m.gltf", "--no-live"]).done().stderr;
    assert!(said.contains("the model was made by Burgeon 0.0.1, and this is"), "{said}");
}

#[test]
fn names_that_lead_out_of_the_folder_are_refused_before_anything_is_written() {
    let long = "a/".repeat(600) + "s.lua";
    for name in [
        "../s.lua",
        "/tmp/s.lua",
        "a/../../s.lua",
        "c:\\s.lua",
        "a\\s.lua",
        ".s.lua",
        "a/.git/s.lua",
        "s.presets.json",
        "s",
        "s.lua/",
        "./s.lua",
        "a//s.lua",
        "s\n.lua",
        "\u{202e}s.lua",
        &long,
    ] {
        let folder = model(&recipe(&[(name, "return 1")]));
        let error = folder.burgeon(&["open", "m.gltf", "--no-live"]).failed();
        assert!(error.contains("which is no Lua file in its folder"), "{name:?}: {error}");
        assert_eq!(folder.files().len(), 1, "{name:?}");
    }
    let twice = model(&recipe(&[("s.lua", "return 1"), ("s.lua", "return 2")]));
    assert!(
        twice.burgeon(&["open", "m.gltf", "--no-live"]).failed().contains("several files with the same name")
    );
    assert_eq!(twice.files().len(), 1);
    // Quotes, spaces and emoji are names like others.
    let name = "a \"b\" </script> '\u{1f331}.lua".replace('/', "");
    let folder = model(&recipe(&[(&name, "return 1")]));
    folder.burgeon(&["open", "m.gltf", "--no-live"]).done();
    assert_eq!(folder.read(&format!("m-recipe/{name}")), "return 1");
}

#[test]
fn files_without_a_usable_recipe_are_refused() {
    let folder = Folder::new()
        .with("text.glb", "hello")
        .with("cut.glb", b"glTF\x02\0\0\0\x99\0\0\0\x40\0\0\0JSON{}")
        .with("none.gltf", r#"{ "asset": { "version": "2.0" } }"#);
    let said = |name: &str| folder.burgeon(&["open", name, "--no-live"]).failed();
    assert!(said("text.glb").contains("text.glb is broken: it is neither glTF nor a page"));
    assert!(said("cut.glb").contains("it is shorter than its headers say"));
    assert!(said("none.gltf").contains("none.gltf has no recipe"));
    assert!(said("missing.glb").contains("cannot read missing.glb"));
    assert_eq!(folder.files().len(), 3);
    let large = model(&recipe(&[("s.lua", &"x".repeat(1_000_000))]));
    let error = large.burgeon(&["open", "m.gltf", "--no-live"]).failed();
    assert!(error.contains("at most 1,000,000 are allowed"), "{error}");
    let mut values = recipe(&[("s.lua", "return 1")]);
    values["values"] = json!([{ "name": "a", "value": { "b": 1 }, "default": 1 }]);
    let folder = model(&values);
    let error = folder.burgeon(&["open", "m.gltf", "--no-live"]).failed();
    assert!(error.contains("m-recipe/s.presets.json"), "{error}");
}

#[test]
fn a_script_that_is_too_large_for_a_recipe_names_the_remedy() {
    let script = format!("{SCRIPT}--[[{}]]\n", "x".repeat(1_000_000));
    let folder = folder().with("in/s.lua", script);
    let error = folder.burgeon(&[&RUN[..], &["-o", "a.glb"]].concat()).failed();
    assert!(error.contains("--no-recipe"), "{error}");
    assert!(fs::metadata(folder.path().join("a.glb")).is_err());
    folder.burgeon(&[&RUN[..], &["-o", "a.glb", "--no-recipe"]].concat()).done();
}

#[test]
fn passwords_in_a_script_are_not_in_its_recipe() {
    let script = "-- postgres://me:secret@host/db\n".to_owned() + SCRIPT;
    let folder = folder().with("in/s.lua", script);
    folder.burgeon(&[&RUN[..], &["-o", "a.gltf"]].concat()).done();
    let text = folder.read("a.gltf");
    assert!(text.contains("postgres://me:***@host/db") && !text.contains("secret"));
}
