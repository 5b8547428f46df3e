//! Published models in `examples/models`: each names its source, makes the figures that the source or theory demands, and
//! has a picture.

#![allow(clippy::unwrap_used, reason = "a test stops at what is wrong")]

use std::fs;
use std::path::{Path, PathBuf};

use burgeon::script::RunOptions;

/// Maximum size of a model's picture (bytes).
const PICTURE: u64 = 12 * 1024;

/// Returns the scripts of all models, sorted by name.
fn models() -> Vec<PathBuf> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("examples/models");
    let folders = fs::read_dir(root).unwrap().map(|entry| entry.unwrap().path()).filter(|path| path.is_dir());
    let files = folders.flat_map(|folder| fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()));
    let mut models: Vec<PathBuf> =
        files.filter(|path| path.extension().is_some_and(|extension| extension == "lua")).collect();
    models.sort();
    models
}

#[test]
fn every_model_makes_the_figures_that_it_expects_without_a_warning() {
    let models = models();
    assert!(models.len() >= 154, "{} models", models.len());
    let mut wrong = Vec::new();
    for path in models {
        let options = RunOptions { strict: true, ..burgeon::options() };
        match burgeon::run(&path, options) {
            Err(error) => wrong.push(format!("{}: {error}", path.display())),
            Ok(run) if run.scene.triangles() == 0 => {
                wrong.push(format!("{}: it draws nothing", path.display()))
            }
            Ok(_) => {}
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn every_model_names_its_source_expects_a_figure_and_has_a_small_picture() {
    let mut wrong = Vec::new();
    for path in models() {
        let text = fs::read_to_string(&path).unwrap();
        let mut tell = |what: &str| wrong.push(format!("{}: {what}", path.display()));
        if !text.starts_with("--!strict\n")
            || !text.lines().nth(1).is_some_and(|line| line.starts_with("-- "))
        {
            tell("it does not begin with a description");
        }
        if !text.contains("\n-- Source: ") {
            tell("it names no source");
        }
        if !text.lines().any(|line| line.trim_start().starts_with("expect(")) {
            tell("it expects nothing");
        }
        match fs::metadata(path.with_extension("png")) {
            Ok(picture) if picture.len() > PICTURE => tell("its picture is larger than 12 KB"),
            Ok(_) => {}
            Err(_) => tell("it has no picture"),
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}
