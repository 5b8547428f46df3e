//! Page of a tileset: its files, its events, and folders that have none.

use std::path::Path;
use std::process::{Command, Output};
use std::time::Duration;

use serde_json::json;

use crate::support::Server;

const HOUSES: &str = r#"local Walls = module("Walls", "height")
local houses = lsystem({ object = footprint })
houses:axiom(source("buildings.geojson"), function(feature)
  if feature.name == "b12" then error("houses of this kind are not supported") end
  return footprint(feature.geometry), Walls(3 * feature.floors)
end)
houses:interpret("Walls(height)", function(this, height) this:walls({ height = height }) end)
houses:derive(0)
"#;

fn burgeon(folder: &Path, arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_burgeon")).args(arguments).current_dir(folder).output().unwrap()
}

/// Returns a folder with a planned tileset `out`, one of whose tiles fails.
fn planned() -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("houses.lua"), HOUSES).unwrap();
    let data = concat!(env!("CARGO_MANIFEST_DIR"), "/examples/data/quarter");
    let plan = ["tiles", "plan", "houses.lua", "--data", data, "-o", "out", "--target-features", "12"];
    let output = burgeon(folder.path(), &plan);
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    folder
}

fn make_and_join(folder: &Path) {
    assert_eq!(burgeon(folder, &["tiles", "make", "out"]).status.code(), Some(1));
    assert!(burgeon(folder, &["tiles", "join", "out"]).status.success());
}

/// Returns the path of a tile with content, relative to the folder of the tileset.
fn first_content(folder: &Path) -> String {
    fn find(folder: &Path) -> Option<std::path::PathBuf> {
        let mut entries: Vec<_> =
            std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()).collect();
        entries.sort();
        entries.into_iter().find_map(|path| match path.is_dir() {
            true => find(&path),
            false => path.extension().is_some_and(|it| it == "glb").then_some(path),
        })
    }
    let root = folder.join("out");
    find(&root.join("tiles")).unwrap().strip_prefix(&root).unwrap().to_string_lossy().replace('\\', "/")
}

#[test]
fn the_page_of_a_tileset_and_its_files_are_served_with_their_media_types() {
    let folder = planned();
    make_and_join(folder.path());
    let content = first_content(folder.path());
    let bytes = std::fs::read(folder.path().join("out").join(&content)).unwrap();
    let server = Server::of_tileset(folder, "out");
    let expected = [
        ("", "text/html"),
        ("tileset.js", "text/javascript"),
        ("tileset.css", "text/css"),
        ("viewer.css", "text/css"),
        ("tileset/tileset.json", "application/json"),
        ("tileset/missing.geojson", "application/geo+json"),
        ("tileset/missing.csv", "text/csv"),
    ];
    for (path, kind) in expected {
        let answer = server.get(path);
        assert_eq!(answer.status, 200, "{path}");
        for header in [
            &format!("content-type: {kind}"),
            "content-security-policy: default-src 'none'",
            "cache-control: no-store",
            "x-content-type-options: nosniff",
        ] {
            assert!(answer.head.contains(header), "{path}: {header}: {}", answer.head);
        }
    }
    let answer = server.get(&format!("tileset/{content}"));
    assert!(answer.head.contains("content-type: model/gltf-binary"), "{}", answer.head);
    assert!(answer.head.contains(&format!("content-length: {}", bytes.len())), "{}", answer.head);
    assert_eq!(answer.body, bytes);
    // The page of a script has other parts.
    for path in ["viewer.js", "export/x.glb", "model/0.glb"] {
        assert_eq!(server.get(path).status, 404, "{path}");
    }
    let host = format!("Host: 127.0.0.1:{}\r\n", server.port);
    let path = format!("GET /{}/tileset/tileset.json HTTP/1.1\r\n", "0".repeat(32));
    assert_eq!(server.request(&format!("{path}{host}")).status, 403);
    let path = format!("GET /{}/tileset/tileset.json HTTP/1.1\r\n", server.token);
    assert_eq!(server.request(&format!("{path}Host: example.org\r\n")).status, 403);
    assert_eq!(server.request(&format!("{path}{host}Origin: http://example.org\r\n")).status, 403);
}

#[test]
fn nothing_outside_the_folder_of_a_tileset_is_served() {
    let folder = planned();
    make_and_join(folder.path());
    std::fs::write(folder.path().join("secret.json"), "{}").unwrap();
    std::fs::write(folder.path().join("out/.secret.json"), "{}").unwrap();
    std::fs::write(folder.path().join("out/rules.lua"), "").unwrap();
    #[cfg(unix)]
    std::os::unix::fs::symlink("../secret.json", folder.path().join("out/link.json")).unwrap();
    let server = Server::of_tileset(folder, "out");
    let refused = [
        "tileset/../secret.json",
        "tileset/%2e%2e/secret.json",
        "tileset/..%2fsecret.json",
        "tileset/tiles/..%2f..%2f..%2fsecret.json",
        "tileset/..%5csecret.json",
        "tileset//etc/passwd",
        "tileset/%2fetc%2fpasswd",
        "tileset/link.json",
        "tileset/.secret.json",
        "tileset/rules.lua",
        "tileset/tiles",
        "tileset/",
        "tileset",
        "secret.json",
    ];
    for path in refused {
        assert_eq!(server.get(path).status, 404, "{path}");
    }
}

#[test]
fn pages_hear_of_a_join_and_of_the_progress() {
    let folder = planned();
    assert!(burgeon(folder.path(), &["tiles", "join", "out"]).status.success());
    let server = Server::of_tileset(folder, "out");
    let mut page = server.connect();
    let hello = page.next("hello");
    assert_eq!((&hello["tileset"], &hello["path"]), (&json!("out"), &json!("out")));
    let before = page.next("tileset")["revision"].clone();
    let making = page.next("making");
    let all = making["open"].as_u64().unwrap();
    assert_eq!((&making["done"], &making["failed"]), (&json!(0), &json!(0)));
    assert!(all > 4, "{making}");
    make_and_join(&server.path(""));
    let mut revision = before.clone();
    let mut last = json!(null);
    while revision == before || last["open"] != 0 {
        let message = page.any();
        match message["type"].as_str() {
            Some("tileset") => revision = message["revision"].clone(),
            Some("making") => last = message,
            other => panic!("{other:?}"),
        }
    }
    assert_eq!((&last["failed"], last["done"].as_u64().unwrap()), (&json!(1), all - 1));
    page.is_quiet(Duration::from_millis(1500));
}

#[test]
fn a_folder_without_a_tileset_and_flags_of_scripts_are_errors_with_remedies() {
    let folder = planned();
    let refused = |arguments: &[&str], text: &str, status: i32| {
        let output = burgeon(folder.path(), &[&["live", "--no-open", "--port", "0"], arguments].concat());
        let said = String::from_utf8_lossy(&output.stderr).into_owned();
        assert_eq!(output.status.code(), Some(status), "{said}");
        assert!(said.contains(text), "{said}");
    };
    refused(&["out"], "burgeon tiles join out", 1);
    refused(&["."], "burgeon tiles plan SCRIPT -o FOLDER", 1);
    make_and_join(folder.path());
    refused(&["out", "--set", "a=1", "--seed", "2"], "--set, --seed", 1);
    refused(&["out", "--editor", "vim"], "--editor", 1);
}
