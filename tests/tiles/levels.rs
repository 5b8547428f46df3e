//! Levels of detail: coarser tiles with measured errors.

use std::collections::BTreeSet;

use burgeon::tiles::TilePlan;
use serde_json::Value;

use crate::city::City;

/// Plans a city with this number of levels of detail.
fn plan(city: &City, folder: &str, levels: &str) -> Value {
    let arguments = ["plan", "city.lua", "-o", folder, "--target-features", "30", "--geoid-height", "44"];
    city.json(&[&arguments[..], &["--levels", levels]].concat())
}

fn read(city: &City, folder: &str) -> TilePlan {
    TilePlan::read(&city.path(folder).join("plan.json")).unwrap()
}

/// Returns the tiles with content and children of a tileset, with their geometric errors.
fn inner(tile: &Value) -> Vec<(String, f64)> {
    let mut found = Vec::new();
    let children = tile["children"].as_array().cloned().unwrap_or_default();
    if let (Some(uri), false) = (tile["content"]["uri"].as_str(), children.is_empty()) {
        assert_eq!(tile["refine"], "REPLACE");
        found.push((uri.to_owned(), tile["geometricError"].as_f64().unwrap()));
    }
    found.extend(children.iter().flat_map(inner));
    found
}

#[test]
fn coarser_tiles_have_the_features_of_those_inside_and_the_errors_that_were_measured() {
    let city = City::new(400);
    let planned = plan(&city, "out", "4");
    // Without facades, roofs on plain walls are the full detail.
    assert_eq!(planned["lods"], serde_json::json!([1, 0]));
    assert!(planned["warnings"].to_string().contains("no coarser tiles at --lod 2"), "{planned}");
    let (tiles, coarse) = (planned["tiles"].as_u64().unwrap(), planned["coarse"].as_u64().unwrap());
    assert!(tiles > 12 && coarse > 4, "{planned}");
    assert_eq!(city.json(&["make", "out", "--share", "2/2"])["failed"], 0);
    city.json(&["make", "out", "--share", "1/2"]);
    let joined = city.json(&["join", "out", "--tiling", "both"]);
    assert_eq!((&joined["tiles"], &joined["coarse"]), (&planned["tiles"], &planned["coarse"]));
    let checked = city.json(&["check", "out"]);
    assert_eq!((&checked["features"], &checked["coarse"]), (&400.into(), &planned["coarse"]));
    let document = std::fs::read_to_string(city.path("out/tileset.json")).unwrap();
    let document: Value = serde_json::from_str(&document).unwrap();
    let inner = inner(&document["root"]);
    assert_eq!(inner.len() as u64, coarse);
    // Hip roofs of 1 to 3 m are a part of blocks, and footprints lack up to 12 m of walls and the roof.
    assert!(inner.iter().all(|(_, error)| (0.2..16.0).contains(error)), "{inner:?}");
    assert!(
        inner.iter().any(|(_, error)| *error < 3.8) && inner.iter().any(|(_, error)| *error > 8.0),
        "{inner:?}"
    );
    // The same bytes in another order.
    plan(&city, "other", "4");
    city.json(&["make", "other", "--threads", "1"]);
    city.json(&["join", "other", "--tiling", "both"]);
    city.assert_same("out", "other");
}

#[test]
fn a_changed_feature_remakes_its_tile_and_the_coarser_ones_above_it() {
    let city = City::new(400);
    plan(&city, "out", "4");
    city.json(&["make", "out"]);
    let before = read(&city, "out");
    let connection = rusqlite::Connection::open(city.path("city.gpkg")).unwrap();
    connection.execute("UPDATE buildings SET levels = 9 WHERE fid = 200", []).unwrap();
    connection.close().unwrap();
    plan(&city, "out", "4");
    let after = read(&city, "out");
    let known: BTreeSet<&str> = before.all_tiles().iter().map(|tile| tile.hash.as_str()).collect();
    let all = after.all_tiles();
    let changed: Vec<_> = all.iter().filter(|tile| !known.contains(tile.hash.as_str())).collect();
    let leaf = changed.iter().find(|tile| tile.lod.is_none()).unwrap().id;
    assert_eq!(changed.iter().filter(|tile| tile.lod.is_none()).count(), 1);
    for tile in &changed {
        assert_eq!(leaf.ancestor(tile.id.level), tile.id);
    }
    assert!(changed.len() > 1 && changed.len() < 5, "{}", changed.len());
    assert_eq!(city.json(&["make", "out"])["made"], changed.len());
    city.json(&["join", "out"]);
    assert_eq!(city.json(&["check", "out"])["features"], 400);
}

#[test]
fn a_script_that_draws_the_same_has_no_coarser_tiles() {
    let city = City::new(120);
    let planned = plan(&city, "out", "2");
    assert_eq!((&planned["coarse"], &planned["lods"]), (&0.into(), &serde_json::json!([])));
    let warnings = planned["warnings"].as_array().unwrap();
    let notes: Vec<&str> = warnings.iter().filter_map(Value::as_str).collect();
    assert_eq!(
        notes,
        ["no coarser tiles at --lod 2: the script draws the same as at --lod 3; read lod in the script"]
    );
}

#[test]
fn a_check_finds_an_error_below_the_measured_one_and_features_that_are_shown_twice() {
    let city = City::new(120);
    plan(&city, "out", "3");
    city.json(&["make", "out"]);
    city.json(&["join", "out"]);
    city.json(&["check", "out"]);
    let path = city.path("out/tileset.json");
    let text = std::fs::read_to_string(&path).unwrap();
    std::fs::write(&path, text.replace("REPLACE", "ADD")).unwrap();
    assert!(city.fails(&["check", "out"], 1).contains("is shown together with the same features"));
    let document: Value = serde_json::from_str(&text).unwrap();
    let errors = inner(&document["root"]);
    let low = text.replace(&format!("\"geometricError\":{}", errors[0].1), "\"geometricError\":0.01");
    assert_ne!(low, text);
    std::fs::write(&path, low).unwrap();
    assert!(city.fails(&["check", "out"], 1).contains("was measured"));
}
