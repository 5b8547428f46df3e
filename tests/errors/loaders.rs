//! Files in memory: loaders of programs, and scripts on standard input.

use std::collections::BTreeMap;
use std::path::Path;
use std::sync::{Arc, Mutex};

use burgeon::script::{FileLoader, Print, RunInputs, RunOptions, RunReports};
use burgeon::{Error, Result, Run};

use crate::short_forms::run_with_input;
use crate::support::Folder;

/// Runs `s.lua` of a loader and returns the texts that it prints.
fn run(loader: FileLoader) -> Result<(Run, Vec<String>)> {
    let texts = Arc::new(Mutex::new(Vec::new()));
    let printed = Arc::clone(&texts);
    let print = Print::new(move |text| printed.lock().unwrap().push(text.to_owned()));
    let run = burgeon::run(
        Path::new("s.lua"),
        RunOptions {
            inputs: RunInputs { loader: Some(loader), ..RunInputs::default() },
            reports: RunReports { print: Some(print), ..RunReports::default() },
            ..burgeon::options()
        },
    )?;
    let texts = texts.lock().unwrap().clone();
    Ok((run, texts))
}

fn files<const N: usize>(files: [(&str, &[u8]); N]) -> BTreeMap<String, Vec<u8>> {
    files.map(|(name, bytes)| (name.to_owned(), bytes.to_vec())).into()
}

/// Returns the error of a script of one line, whose loader also has the file `part.lua`.
fn refused(line: &str) -> String {
    let files = files([("s.lua", line.as_bytes()), ("part.lua", b"return 1")]);
    run(FileLoader::of_files(files)).map(|_| ()).unwrap_err().to_string()
}

/// Asserts that an error names its cause.
fn assert_names(told: &str, cause: &str) {
    assert!(told.contains(cause), "{told}");
}

/// Returns a grey picture of 2 x 2 samples.
fn picture() -> Vec<u8> {
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, 2, 2);
    encoder.set_color(png::ColorType::Grayscale);
    encoder.set_depth(png::BitDepth::Eight);
    let mut writer = encoder.write_header().unwrap();
    writer.write_image_data(&[0, 80, 160, 240]).unwrap();
    writer.finish().unwrap();
    bytes
}

/// A script that reads a file of each type by its name.
const READER: &str = r#"--!strict
local height = require("parts/height")
local Slab = module("Slab")
local tower = lsystem({ object = extruder({ sides = 4 }) })
tower:axiom(Slab())
tower:interpret("Slab", function(this)
  this:material({ texture = "images/bark.png" }):extrude(height)
end)
tower:derive(0)
local Lot = module("Lot", "height")
local lots = lsystem({ object = footprint })
lots:axiom(source("data/lots.geojson"), function(feature)
  print(feature.id, feature.height)
  return footprint(feature.geometry), Lot(feature.height)
end)
lots:interpret("Lot(height)", function(this, height) this:walls({ height = height }) end)
lots:derive(0)
print(model("models/tile.gltf"):high())
"#;

const LOTS: &str = r#"{ "type": "FeatureCollection", "features": [{ "type": "Feature", "id": "a",
  "properties": { "height": 4 }, "geometry": { "type": "Polygon",
  "coordinates": [[[0, 0], [0.0001, 0], [0.0001, 0.0001], [0, 0.0001], [0, 0]]] } }] }"#;

/// A triangle whose positions are in the file `tile.bin`.
const TILE: &str = r#"{ "asset": { "version": "2.0" }, "scene": 0, "scenes": [{ "nodes": [0] }], "nodes": [{ "mesh": 0 }],
  "buffers": [{ "uri": "tile.bin", "byteLength": 36 }], "bufferViews": [{ "buffer": 0, "byteLength": 36 }],
  "accessors": [{ "bufferView": 0, "count": 3, "componentType": 5126, "type": "VEC3", "min": [0, 0, 0], "max": [1, 2, 0] }],
  "meshes": [{ "primitives": [{ "attributes": { "POSITION": 0 } }] }] }"#;

/// Returns the file `tile.bin`.
fn positions() -> Vec<u8> {
    [0.0_f32, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 2.0, 0.0].iter().flat_map(|number| number.to_le_bytes()).collect()
}

#[test]
fn scripts_images_data_and_models_come_from_a_loader() {
    let picture = picture();
    let files = files([
        ("s.lua", READER.as_bytes()),
        ("parts/height.lua", b"return require('more')"),
        ("parts/more.lua", b"return 3"),
        ("images/bark.png", &picture),
        ("data/lots.geojson", LOTS.as_bytes()),
        ("models/tile.gltf", TILE.as_bytes()),
        ("models/tile.bin", &positions()),
    ]);
    let names: Vec<String> = files.keys().cloned().collect();
    let (listed, printed) = run(FileLoader::of_files(files.clone())).unwrap();
    assert_eq!(printed, ["a\t4", "vec(1, 0, 2)"]);
    let (asked, all) = (Arc::new(Mutex::new(Vec::new())), files.clone());
    let requests = Arc::clone(&asked);
    let function = FileLoader::new(move |name| {
        requests.lock().unwrap().push(name.to_owned());
        Ok(all.get(name).cloned())
    });
    let (run_of_function, printed) = run(function).unwrap();
    assert_eq!(printed, ["a\t4", "vec(1, 0, 2)"]);
    let count = listed.scene.triangles();
    assert!(count > 10 && count == run_of_function.scene.triangles(), "{count}");
    let texture = listed.scene.materials.iter().find_map(|material| material.texture.as_ref()).unwrap();
    assert_eq!(texture.content.as_deref(), Some(picture.as_slice()));
    let mut asked = asked.lock().unwrap().clone();
    asked.sort();
    assert!(names.iter().all(|name| asked.contains(name)), "{asked:?}");
    asked.windows(2).for_each(|pair| assert_ne!(pair[0], pair[1], "a file is requested once"));
}

#[test]
fn a_loader_before_a_folder_has_the_first_word() {
    let folder = Folder::new()
        .with("parts/height.lua", "return require('more')")
        .with("parts/more.lua", "error('not this file')")
        .with("images/bark.png", picture())
        .with("data/lots.geojson", LOTS.replace("\"height\": 4", "\"height\": 7"))
        .with("models/tile.gltf", TILE)
        .with("models/tile.bin", positions());
    let files = files([("s.lua", READER.as_bytes()), ("parts/more.lua", b"return 3")]);
    let (run, printed) = run(FileLoader::of_files(files).before(folder.path())).unwrap();
    assert_eq!(printed, ["a\t7", "vec(1, 0, 2)"]);
    let texture = run.scene.materials.iter().find_map(|material| material.texture.as_ref()).unwrap();
    assert!(texture.content.is_none() && texture.path.ends_with("images/bark.png"), "{texture:?}");
}

#[test]
fn names_outside_the_folder_of_a_loader_are_refused() {
    assert_names(&refused("require('../part')"), "require(\"../part\") is outside the script's folder");
    assert_names(&refused("require('/etc/part')"), "require(\"/etc/part\") is outside the script's folder");
    assert_names(
        &refused("source('../lots.geojson')"),
        "the data file ../lots.geojson lies outside the script's folder",
    );
    assert_names(
        &refused("source('/etc/lots.geojson')"),
        "the data file /etc/lots.geojson is named by a path from the root",
    );
    assert_names(
        &refused("model('a/../../tile.glb')"),
        "the model a/../../tile.glb lies outside the script's folder",
    );
    assert_names(&refused("require('parts')"), "require(\"parts\"): file not found: parts.lua");
}

#[test]
fn a_loader_that_fails_stops_the_run_with_its_message() {
    let fails = |at: &'static str, script: &'static str| {
        let loader = FileLoader::new(move |name| match name {
            name if name == at => Err(Error::other(format!("the server is away: {name}"))),
            "s.lua" => Ok(Some(script.as_bytes().to_vec())),
            _ => Ok(None),
        });
        run(loader).map(|_| ()).unwrap_err().to_string()
    };
    assert_names(&fails("s.lua", ""), "the server is away: s.lua");
    assert_names(&fails("part.lua", "\nrequire('part')"), "the server is away: part.lua");
    assert_names(&fails("lots.geojson", "\nsource('lots.geojson')"), "the server is away: lots.geojson");
}

#[test]
fn content_of_another_type_is_an_error_of_its_reader() {
    let wrong = |script: &str, name: &str, bytes: &[u8]| {
        let files = files([("s.lua", script.as_bytes()), (name, bytes)]);
        run(FileLoader::of_files(files)).map(|_| ()).unwrap_err().to_string()
    };
    assert_names(&wrong("require('part')", "part.lua", &[0xff, 0xfe, 0]), "part.lua is not a text file");
    assert_names(
        &wrong("source('lots.geojson')", "lots.geojson", b"return 3"),
        "lots.geojson is not GeoJSON",
    );
    assert_names(
        &wrong("model('tile.glb')", "tile.glb", b"return 3"),
        "the model tile.glb cannot be read: it is not a glTF file",
    );
}

#[test]
fn a_script_on_standard_input_reads_the_files_of_the_working_folder() {
    let folder = Folder::new()
        .with("parts/height.lua", "return require('more')")
        .with("parts/more.lua", "return 3")
        .with("images/bark.png", picture())
        .with("data/lots.geojson", LOTS)
        .with("models/tile.gltf", TILE)
        .with("models/tile.bin", positions());
    let before = folder.files();
    let out = run_with_input(&folder, &["run", "-", "-o", "-", "--format", "glb"], READER.as_bytes());
    let said = String::from_utf8_lossy(&out.stderr).into_owned();
    assert!(out.status.success() && out.stdout.starts_with(b"glTF") && said.starts_with("a\t4\n"), "{said}");
    assert!(out.stdout.windows(8).any(|bytes| *bytes == picture()[..8]), "the model has the texture");
    // The recipe names the files as the script does.
    let model = String::from_utf8_lossy(&out.stdout).into_owned();
    assert!(model.contains("\"script\":\"-\"") && model.contains("parts/more.lua"), "{said}");
    assert!(!model.contains("burgeon-") && folder.files() == before);
    let told = |script: &str| {
        let out = run_with_input(&folder, &["run", "-"], script.as_bytes());
        assert!(!out.status.success());
        String::from_utf8_lossy(&out.stderr).into_owned()
    };
    assert_names(
        &told("\nrequire('../parts')"),
        "error: -:2:10: require(\"../parts\") is outside the script's folder\n  | require('../parts')",
    );
    assert_names(
        &told("local a = require('parts/height')\nprint(a .. nil)"),
        "error: -:2:9: attempt to concatenate number with nil\n  | print(a .. nil)",
    );
}
