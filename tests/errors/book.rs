//! The book: its reference is what the program writes, its scripts run, and its links lead somewhere.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use super::support::Folder;

fn sources() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("docs/book/src")
}

/// The pages in a folder and the folders in it, by their names.
fn pages(folder: &Path) -> BTreeMap<String, String> {
    let mut pages = BTreeMap::new();
    let mut folders = vec![folder.to_path_buf()];
    while let Some(inner) = folders.pop() {
        for entry in std::fs::read_dir(inner).unwrap() {
            let path = entry.unwrap().path();
            if path.is_dir() {
                folders.push(path);
            } else {
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
        assert!(!name.contains('/') && summary.contains(&format!("({name})")), "{name} is in no summary");
    }
    assert!(written.len() > 18, "{}", written.len());
}

#[test]
fn every_script_of_the_book_runs() {
    let mut count = 0;
    for (name, text) in pages(&sources()) {
        for block in text.split("```lua\n").skip(1) {
            let script = block.split("```").next().unwrap();
            let said = Folder::new().with("s.lua", script).burgeon(&["run", "s.lua", "--strict"]);
            assert_eq!(said.status, 0, "{name}: {}", said.stderr);
            count += 1;
        }
    }
    assert!(count > 12, "{count}");
}

#[test]
fn every_link_of_the_book_leads_to_a_page() {
    let pages = pages(&sources());
    let mut count = 0;
    for (name, text) in &pages {
        for link in text.split("](").skip(1).filter_map(|rest| rest.split_once(')')).map(|(link, _)| link) {
            if !link.ends_with(".md") {
                continue;
            }
            let folder = Path::new(name).parent().unwrap();
            assert!(pages.contains_key(&folder.join(link).display().to_string()), "{name}: {link}");
            count += 1;
        }
    }
    assert!(count > 20, "{count}");
}
