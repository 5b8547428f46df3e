//! The book: its reference equals the program's output, its scripts run, and its links have targets.

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

use super::support::Folder;

fn sources() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("docs/book/src")
}

/// Returns the pages in a folder and its subfolders, by path.
fn pages(folder: &Path) -> BTreeMap<String, String> {
    let mut pages = BTreeMap::new();
    let mut folders = vec![folder.to_path_buf()];
    while let Some(inner) = folders.pop() {
        for entry in std::fs::read_dir(inner).unwrap() {
            let path = entry.unwrap().path();
            if path.is_dir() {
                folders.push(path);
            } else if path.extension().is_some_and(|extension| extension == "md") {
                let name = path.strip_prefix(folder).unwrap().display().to_string();
                pages.insert(name, std::fs::read_to_string(path).unwrap());
            }
        }
    }
    pages
}

#[test]
fn the_reference_is_what_the_program_writes() {
    let folder = Folder::new();
    folder.burgeon(&["api", "--book", "."]).done();
    let written = pages(&folder.path().join("src"));
    let known = pages(&sources());
    for (name, text) in &written {
        assert!(known.get(name) == Some(text), "{name} is stale: burgeon api --book docs/book");
    }
    let summary = &known["SUMMARY.md"];
    for name in known.keys().filter(|name| !written.contains_key(*name)) {
        assert!(summary.contains(&format!("({name})")), "{name} is in no summary");
    }
    assert!(written.len() > 18, "{}", written.len());
}

#[test]
fn every_script_of_the_book_runs() {
    let (mut count, mut includes) = (0, 0);
    let buildings = include_bytes!("../../examples/data/quarter/buildings.geojson");
    for (name, text) in pages(&sources()) {
        for block in text.split("```lua\n").skip(1) {
            let script = block.split("```").next().unwrap();
            // tests/course.rs runs the scripts that pages include.
            if let Some((included, _)) =
                script.strip_prefix("{{#include ").and_then(|rest| rest.split_once("}}"))
            {
                let file = sources().join(&name).parent().unwrap().join(included);
                assert!(file.is_file(), "{name}: {included} is missing");
                includes += 1;
                continue;
            }
            let folder =
                Folder::new().with_roads().with("buildings.geojson", buildings).with("s.lua", script);
            let mods = Path::new(env!("CARGO_MANIFEST_DIR")).join("examples/shapes/mods");
            let said =
                folder.burgeon(&["run", "s.lua", "--strict", "--mods", mods.to_str().expect("a path")]);
            assert_eq!(said.status, 0, "{name}: {}", said.stderr);
            count += 1;
        }
    }
    assert!(count > 12 && includes >= 45, "{count} scripts, {includes} included");
}

/// Returns the anchor that mdBook makes of a heading.
fn anchor(heading: &str) -> String {
    let kept = heading.trim().chars().filter(|c| c.is_alphanumeric() || matches!(c, ' ' | '-' | '_'));
    kept.map(|c| if c == ' ' { '-' } else { c.to_ascii_lowercase() }).collect()
}

/// Returns the anchors of a page.
fn anchors(text: &str) -> BTreeSet<String> {
    let mut in_code = false;
    let lines = text.lines().filter(|line| {
        in_code ^= line.trim_start().starts_with("```");
        !in_code && line.starts_with('#')
    });
    lines.map(|line| anchor(line.trim_start_matches('#'))).collect()
}

#[test]
fn every_link_and_every_picture_of_the_book_leads_somewhere() {
    let pages = pages(&sources());
    let (mut links, mut pictures) = (0, 0);
    for (name, text) in pages.iter().filter(|(name, _)| name.ends_with(".md")) {
        // Code blocks contain no links.
        let prose: String = text.split("```").step_by(2).collect();
        for link in prose.split("](").skip(1).filter_map(|rest| rest.split_once(')')).map(|(link, _)| link) {
            if link.starts_with("https://") {
                continue;
            }
            let (file, place) = link.split_once('#').unwrap_or((link, ""));
            let page = if file.is_empty() {
                sources().join(name)
            } else {
                sources().join(name).parent().unwrap().join(file)
            };
            assert!(page.is_file() || page.is_dir(), "{name}: {link}");
            // The built book contains only files of this folder.
            let within = page.canonicalize().unwrap().starts_with(sources().canonicalize().unwrap());
            assert!(within, "{name}: {link} leads out of the book");
            if !place.is_empty() {
                assert!(anchors(&std::fs::read_to_string(&page).unwrap()).contains(place), "{name}: {link}");
            }
            links += 1;
            pictures += usize::from(file.ends_with(".png") || file.ends_with(".jpg"));
        }
    }
    assert!(links > 80 && pictures > 60, "{links} links, {pictures} pictures");
}

#[test]
fn every_picture_of_the_reference_shows_its_script_as_it_is_and_is_small() {
    let folder = Folder::new();
    let (from, to) = (sources().join("reference/pictures"), folder.path().join("src/reference/pictures"));
    std::fs::create_dir_all(&to).unwrap();
    let (mut count, mut bytes) = (0, 0);
    for entry in std::fs::read_dir(&from).unwrap() {
        let path = entry.unwrap().path();
        let size = std::fs::copy(&path, to.join(path.file_name().unwrap())).unwrap();
        assert!(size < 40_000, "{}: {size} bytes", path.display());
        (count, bytes) = (count + usize::from(path.extension().is_some_and(|it| it == "png")), bytes + size);
    }
    assert!(count > 45 && bytes < 1_000_000, "{count} pictures of {bytes} bytes");
    let said = folder.burgeon(&["api", "--book", ".", "--pictures"]).done();
    assert!(!said.stderr.contains("drew"), "burgeon api --book docs/book --pictures\n{}", said.stderr);
    let shown: BTreeSet<String> = folder
        .read("src/reference/pictures/pictures.txt")
        .lines()
        .map(|line| line.split(['/', ' ']).nth(1).unwrap().to_owned())
        .collect();
    let there =
        std::fs::read_dir(&from).unwrap().map(|entry| entry.unwrap().file_name().into_string().unwrap());
    let there: BTreeSet<String> = there.filter(|name| name.ends_with(".png")).collect();
    assert_eq!(there, shown, "a picture that nothing shows, or the other way round");
}
