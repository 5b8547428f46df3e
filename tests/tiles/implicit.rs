//! Implicit tiling beside explicit tiling.

use serde_json::Value;

use crate::city::City;

fn tileset(city: &City, name: &str) -> Value {
    serde_json::from_str(&std::fs::read_to_string(city.path("out").join(name)).unwrap()).unwrap()
}

/// Returns the tiles of a tileset that have implicit tiling.
fn implicit(tile: &Value) -> Vec<Value> {
    let own = (!tile["implicitTiling"].is_null()).then(|| tile.clone());
    let children = tile["children"].as_array().cloned().unwrap_or_default();
    own.into_iter().chain(children.iter().flat_map(implicit)).collect()
}

#[test]
fn both_tilings_list_the_same_tiles_and_a_join_removes_the_files_of_another() {
    let city = City::new(400);
    city.plan("out");
    city.json(&["make", "out"]);
    let explicit = city.json(&["join", "out"]);
    assert_eq!((&explicit["tilesets"], &explicit["subtrees"]), (&1.into(), &0.into()));
    city.json(&["check", "out"]);
    let before = city.files("out");
    let both = city.json(&["join", "out", "--tiling", "both"]);
    assert_eq!(both["tilesets"], 2);
    assert!(both["subtrees"].as_u64() > Some(0), "{both}");
    assert_eq!(city.json(&["check", "out"])["features"], 400);
    assert_eq!(city.files("out")["tileset.json"], before["tileset.json"]);
    let roots = implicit(&tileset(&city, "implicit.json")["root"]);
    assert_eq!(roots.len() as u64, both["subtrees"]);
    for root in &roots {
        assert!(
            root["children"].is_null() && root["implicitTiling"]["subtreeLevels"].as_u64() > Some(1),
            "{root}"
        );
    }
    let alone = city.json(&["join", "out", "--tiling", "implicit"]);
    assert_eq!((&alone["tilesets"], &alone["subtrees"]), (&1.into(), &both["subtrees"]));
    assert!(!city.path("out/implicit.json").exists());
    assert_eq!(implicit(&tileset(&city, "tileset.json")["root"]), roots);
    assert_eq!(city.json(&["check", "out"])["features"], 400);
    city.json(&["join", "out"]);
    assert_eq!(city.files("out"), before);
}

#[test]
fn a_check_finds_subtrees_that_differ_from_the_explicit_tiles() {
    let city = City::new(200);
    city.plan("out");
    city.json(&["make", "out"]);
    city.json(&["join", "out", "--tiling", "both"]);
    let files = city.files("out");
    let (name, bytes) = files.iter().find(|(name, _)| name.ends_with(".subtree")).unwrap();
    let write = |bytes: &[u8]| std::fs::write(city.path("out").join(name), bytes).unwrap();
    let json = u64::from_le_bytes(bytes[8..16].try_into().unwrap()) as usize;
    let text: Value = serde_json::from_slice(&bytes[24..24 + json]).unwrap();
    let offset = |view: &Value| {
        24 + json
            + text["bufferViews"][view.as_u64().unwrap() as usize]["byteOffset"].as_u64().unwrap() as usize
    };
    // The last error is that of a tile without children.
    let mut changed = bytes.clone();
    let last = changed.len() - 8;
    changed[last..].copy_from_slice(&0.5_f64.to_le_bytes());
    write(&changed);
    assert!(city.fails(&["check", "out"], 1).contains("has another volume or error in implicit.json"));
    // A content that is not available.
    let mut changed = bytes.clone();
    let content = offset(&text["contentAvailability"][0]["bitstream"]);
    let byte = changed[content..].iter().position(|byte| *byte != 0).unwrap() + content;
    changed[byte] &= changed[byte] - 1;
    write(&changed);
    assert!(city.fails(&["check", "out"], 1).contains("availableCount is not"));
    write(&bytes[..bytes.len() - 1]);
    assert!(city.fails(&["check", "out"], 1).contains("do not have the lengths of the header"));
    write(bytes);
    city.json(&["check", "out"]);
}
