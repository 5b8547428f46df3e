//! The tables of export formats are the only place where extensions and media types are written.

use std::collections::BTreeSet;

use burgeon::export::films::FILM_FORMATS;
use burgeon::export::heights::HEIGHT_FORMATS;
use burgeon::export::{FORMATS, FileFormat};

use super::sources::{Source, collect};
use super::{root, text};

/// Formats that files name outside the tables: in examples of command lines, for files of tilesets and of starting points, and for
/// pages, images and elements of the browser.
const EXCEPTIONS: [(&str, &str); 19] = [
    ("crates/live/src/view/page.rs", ".html"),
    ("crates/live/src/view/page.rs", "text/html"),
    ("crates/live/src/view/tileset/folder.rs", "\"csv\""),
    ("crates/live/src/view/tileset/folder.rs", "text/csv"),
    ("src/commands/command_line.rs", ".glb"),
    ("src/commands/help_examples.rs", ".gif"),
    ("src/commands/help_examples.rs", ".glb"),
    ("src/commands/help_examples.rs", ".gpkg"),
    ("src/commands/help_examples.rs", ".png"),
    ("src/commands/help_examples.rs", ".tif"),
    ("src/commands/new.rs", ".geojson"),
    ("src/commands/run/outputs.rs", ".tif"),
    ("src/commands/tiles/join.rs", ".csv"),
    ("viewer/src/curve.js", "'svg'"),
    ("viewer/src/exports.js", ".png"),
    ("viewer/src/icons.js", "'svg'"),
    ("viewer/src/stage.js", "image/png"),
    ("viewer/src/tileset/main.js", ".geojson"),
    ("viewer/src/tileset/panel.js", ".csv"),
];

/// Returns the rows of all tables.
fn formats() -> impl Iterator<Item = &'static FileFormat> {
    let models = FORMATS.iter().map(|format| &format.file);
    let films = FILM_FORMATS.iter().map(|format| &format.file);
    models.chain(HEIGHT_FORMATS.iter().map(|format| &format.file)).chain(films)
}

/// Returns the extensions and media types that `code` names: with a dot, or as a whole string.
fn named(code: &str) -> BTreeSet<String> {
    let ends = |rest: &str| !rest.starts_with(|c: char| c.is_alphanumeric() || c == '_');
    let mut found = BTreeSet::new();
    for extension in formats().flat_map(|format| format.extensions) {
        let dotted = format!(".{extension}");
        if code.match_indices(&dotted).any(|(at, _)| ends(&code[at + dotted.len()..])) {
            found.insert(dotted);
        }
        let literals = [format!("\"{extension}\""), format!("'{extension}'")];
        found.extend(literals.into_iter().filter(|literal| code.contains(literal.as_str())));
    }
    let media_types = FORMATS.iter().map(|format| format.media_type);
    let media_types = media_types.chain(FILM_FORMATS.iter().map(|format| format.media_type));
    found.extend(media_types.filter(|media_type| code.contains(media_type)).map(str::to_owned));
    found
}

#[test]
fn commands_the_live_view_and_its_page_take_formats_from_the_tables() {
    let mut codes = Vec::new();
    for folder in ["src/commands", "crates/live/src"] {
        for source in Source::all(&root().join(folder)) {
            // Comments of commands are their help.
            let help = if folder == "src/commands" { source.comments.as_str() } else { "" };
            codes.push((source.path, source.code + help));
        }
    }
    let mut pages = Vec::new();
    collect(&root().join("viewer/src"), "js", &mut pages);
    codes.extend(pages.into_iter().map(|path| (path.clone(), text(path))));
    assert!(codes.len() > 80, "{} files", codes.len());
    let mut found = BTreeSet::new();
    for (path, code) in codes {
        let path = path.strip_prefix(root()).unwrap().display().to_string();
        found.extend(named(&code).into_iter().map(|name| (path.clone(), name)));
    }
    let known = EXCEPTIONS.map(|(path, name)| (path.to_owned(), name.to_owned()));
    assert_eq!(found, known.into_iter().collect());
}

#[test]
fn a_format_that_is_written_in_code_is_found() {
    let code = "let a = [\"obj\", 'x3d', \"a.glb\", \"model/gltf+json\", \".pngs\", \"my.city.json\"];";
    let found: Vec<String> = named(code).into_iter().collect();
    assert_eq!(found, ["\"obj\"", "'x3d'", ".city.json", ".glb", "model/gltf+json"]);
}

#[test]
fn the_book_lists_every_format() {
    let page = text("docs/book/src/running.md");
    let (_, outputs) = page.split_once("## Output formats\n").unwrap();
    let outputs = outputs.split("\n## ").next().unwrap();
    for format in &FORMATS {
        assert!(outputs.contains(&format!("`.{}`", format.extension())), ".{}", format.extension());
    }
    let films = page.lines().find(|line| line.starts_with("| `--frames [NAME=]FIRST:LAST:STEP` |")).unwrap();
    for format in &FILM_FORMATS {
        assert!(films.contains(&format!("`.{}`", format.extension())), ".{}", format.extension());
    }
    let heights = page.lines().find(|line| line.starts_with("| `--heights FILE` |")).unwrap();
    for format in &HEIGHT_FORMATS {
        assert!(heights.contains(&format!("`.{}`", format.file.extension())), ".{}", format.file.extension());
    }
}
