//! The course, the cookbook and the translated examples: each script runs without a warning and draws a picture, and a page of
//! the book shows both.

#![allow(clippy::unwrap_used, reason = "a test stops at what is wrong")]

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

use burgeon::export;
use burgeon::picture::{Background, Picture};
use burgeon::script::RunOptions;

/// Folders of scripts, and the least number of scripts in each.
const FOLDERS: [(&str, usize); 5] = [
    ("examples/course", 10),
    ("examples/cookbook", 30),
    ("examples/translated", 5),
    ("src/commands/starters", 6),
    ("examples/first_hour", 6),
];

/// Maximum size of a picture, and of all pictures of these pages (bytes).
const PICTURE: u64 = 60_000;
const PICTURES: u64 = 2_000_000;

fn root() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR"))
}

/// Returns the files of a folder with this extension, sorted by name.
fn files(folder: &str, extension: &str) -> Vec<PathBuf> {
    let entries = fs::read_dir(root().join(folder)).unwrap();
    let mut paths: Vec<PathBuf> = entries.map(|entry| entry.unwrap().path()).collect();
    paths.retain(|path| path.extension().is_some_and(|known| known == extension));
    paths.sort();
    paths
}

/// Returns the share of a picture of the scene that the model covers.
fn coverage(scene: &burgeon::scene::Scene, file: &Path) -> f64 {
    let picture =
        Picture { width: 96, height: 72, background: Background::Clear, ground: false, ..Picture::default() };
    export::write(scene, file, &picture).unwrap();
    let image = image::open(file).unwrap().into_rgba8();
    let covered = image.pixels().filter(|pixel| pixel.0[3] > 127).count();
    covered as f64 / f64::from(image.width() * image.height())
}

#[test]
fn every_script_of_the_course_and_the_cookbook_runs_without_a_warning_and_is_drawn() {
    let folder = tempfile::tempdir().unwrap();
    let mut wrong = Vec::new();
    for (scripts, least) in FOLDERS {
        let scripts = files(scripts, "lua");
        assert!(scripts.len() >= least, "{} scripts, such as {}", scripts.len(), scripts[0].display());
        for path in scripts {
            let options = RunOptions { strict: true, ..burgeon::options() };
            match burgeon::run(&path, options) {
                Err(error) => wrong.push(format!("{}: {error}", path.display())),
                Ok(run) => {
                    let share = coverage(&run.scene, &folder.path().join("picture.png"));
                    if share < 0.01 {
                        wrong.push(format!("{} covers {share} of its picture", path.display()));
                    }
                }
            }
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn every_script_of_the_course_and_the_cookbook_is_shown_once_with_a_small_picture() {
    let book = root().join("docs/book/src");
    let mut pages = String::new();
    for folder in ["docs/book/src/course", "docs/book/src/cookbook"] {
        for page in files(folder, "md") {
            pages += &fs::read_to_string(page).unwrap();
        }
    }
    pages += &fs::read_to_string(book.join("coming_from.md")).unwrap();
    let mut shown = BTreeSet::new();
    for (scripts, _) in &FOLDERS[..3] {
        for path in files(scripts, "lua") {
            let name = path.file_stem().unwrap().to_string_lossy().into_owned();
            let text = fs::read_to_string(&path).unwrap();
            let mut lines = text.lines();
            assert_eq!(lines.next(), Some("--!strict"), "{}", path.display());
            assert!(lines.next().unwrap().starts_with("-- "), "{} has no description", path.display());
            assert_eq!(pages.matches(&format!("{scripts}/{name}.lua}}}}")).count(), 1, "{}", path.display());
            shown.insert(match *scripts {
                "examples/course" => format!("course/pictures/{name}.jpg"),
                "examples/cookbook" => format!("cookbook/pictures/{name}.jpg"),
                _ => format!("cookbook/pictures/from_{name}.jpg"),
            });
        }
    }
    let there: BTreeSet<String> = ["course/pictures", "cookbook/pictures"]
        .into_iter()
        .flat_map(|folder| files(&format!("docs/book/src/{folder}"), "jpg"))
        .map(|path| path.strip_prefix(&book).unwrap().to_string_lossy().into_owned())
        .collect();
    assert_eq!(there, shown, "a picture without a script, or a script without a picture");
    let sizes: Vec<u64> = there.iter().map(|name| fs::metadata(book.join(name)).unwrap().len()).collect();
    assert!(sizes.iter().all(|size| *size < PICTURE), "{sizes:?}");
    assert!(sizes.iter().sum::<u64>() < PICTURES, "{sizes:?}");
}

#[test]
fn every_chapter_has_tasks_and_a_common_mistake() {
    let chapters = files("docs/book/src/course", "md");
    let mut count = 0;
    for path in chapters.iter().filter(|path| !path.ends_with("README.md")) {
        let text = fs::read_to_string(path).unwrap();
        let (_, tasks) = text.split_once("\n## Change next\n").unwrap();
        let (tasks, mistake) = tasks.split_once("\n## A common mistake\n").unwrap();
        for task in ["\n1. ", "\n2. ", "\n3. "] {
            assert!(tasks.contains(task), "{}", path.display());
        }
        assert!(mistake.contains("\n  help: "), "{} shows no message", path.display());
        count += 1;
    }
    assert_eq!(count, 10);
}
