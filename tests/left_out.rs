//! Messages of a program that was built without some of its features, and functions that it still has.

#![allow(clippy::unwrap_used, reason = "a test stops at what is wrong")]

use std::path::Path;
use std::process::Command;

/// Returns standard error and the exit status of the program in `folder`.
fn said(folder: &Path, arguments: &[&str]) -> (String, Option<i32>) {
    let mut command = Command::new(env!("CARGO_BIN_EXE_burgeon"));
    let output = command.args(arguments).current_dir(folder).output().unwrap();
    (String::from_utf8(output.stderr).unwrap(), output.status.code())
}

/// Asserts that the program fails because it lacks `feature`.
#[cfg(not(all(feature = "data", feature = "live", feature = "pictures")))]
fn assert_left_out(folder: &Path, arguments: &[&str], (what, feature): (&str, &str)) {
    let (text, status) = said(folder, arguments);
    assert_eq!(status, Some(1), "{arguments:?}: {text}");
    assert!(text.contains(&format!("this program was built without {what}")), "{arguments:?}: {text}");
    assert!(text.contains(&format!("help: build it with --features {feature}")), "{arguments:?}: {text}");
}

#[test]
fn a_bush_grows_whatever_the_program_is_built_with() {
    let folder = tempfile::tempdir().unwrap();
    let script = Path::new(env!("CARGO_MANIFEST_DIR")).join("scripts/bush.lua");
    for output in ["bush.glb", "bush.gltf", "bush.obj", "bush.svg"] {
        let (text, status) = said(folder.path(), &["run", script.to_str().unwrap(), "-o", output]);
        assert_eq!(status, Some(0), "{text}");
        assert!(folder.path().join(output).metadata().unwrap().len() > 1000);
    }
}

#[cfg(not(feature = "pictures"))]
#[test]
fn without_pictures_whatever_makes_one_says_so_before_it_runs() {
    let folder = tempfile::tempdir().unwrap();
    let write = |name: &str, text: &str| std::fs::write(folder.path().join(name), text).unwrap();
    write("fails.lua", "error('it has run')");
    write(
        "ground.lua",
        "lsystem({ object = terrain({ size = 100, levels = 3, start = 'A', rules = { A = { 'A', 'A', 'A', 'A', change = { 1, -1, 0.5, -0.5 }, decay = 0.5 } }, covers = { { color = '#445522' }, { color = '#aaaaaa' } } }) }):derive()",
    );
    let pictures = ("pictures", "pictures");
    assert_left_out(folder.path(), &["run", "fails.lua", "-o", "a.png"], pictures);
    assert_left_out(folder.path(), &["variations", "fails.lua", "--seeds", "1..2", "-o", "a.png"], pictures);
    assert_left_out(folder.path(), &["run", "ground.lua", "-o", "a.glb"], pictures);
    assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 2);
}

#[cfg(not(feature = "data"))]
#[test]
fn without_data_formats_whatever_reads_or_writes_one_says_so() {
    let folder = tempfile::tempdir().unwrap();
    let write = |name: &str, bytes: &[u8]| std::fs::write(folder.path().join(name), bytes).unwrap();
    write("a.gpkg", b"SQLite format 3\0 and more");
    write("a.geojson", br#"{"type":"Point","coordinates":[7,45]}"#);
    write("a.tif", b"II\x2a\0 and more");
    write("a.png", b"\x89PNG\r\n\x1a\n and more");
    write("a.zip", b"PK\x03\x04 and more");
    let data = ("data formats", "data");
    for (name, script) in [
        ("gpkg.lua", "source('a.gpkg:b')"),
        ("geojson.lua", "source('a.geojson')"),
        ("tif.lua", "elevation('a.tif', {})"),
        ("png.lua", "elevation('a.png', {})"),
        ("zip.lua", "elevation('a.zip', {})"),
    ] {
        write(name, script.as_bytes());
        assert_left_out(folder.path(), &["check", name], data);
    }
    assert_left_out(folder.path(), &["sources", "a.gpkg"], data);
    assert_left_out(folder.path(), &["run", "gpkg.lua", "--heights", "b.tif"], data);
}

#[cfg(not(feature = "live"))]
#[test]
fn without_the_live_page_its_command_says_so() {
    let folder = tempfile::tempdir().unwrap();
    assert_left_out(folder.path(), &["live", "a.lua", "--port", "0"], ("the live page", "live"));
}
