//! Tall features in inner tiles.

use burgeon::tiles::TilePlan;
use serde_json::Value;

use crate::city::City;

const PLAN: [&str; 6] = ["--reach", "2", "--target-features", "30", "--geoid-height", "44"];

/// Returns a city with ten towers among 400 houses.
fn city() -> City {
    let city = City::new(400);
    let connection = rusqlite::Connection::open(city.path("city.gpkg")).unwrap();
    connection.execute("UPDATE buildings SET levels = 20 WHERE fid % 40 = 0", []).unwrap();
    connection.close().unwrap();
    city
}

fn plan(city: &City, folder: &str, options: &[&str]) -> Value {
    city.json(&[&["plan", "city.lua", "-o", folder][..], &PLAN, options].concat())
}

/// Returns the contents of tiles with children, with their refinement and their geometric errors.
fn inner(tile: &Value) -> Vec<(String, String, f64)> {
    let children = tile["children"].as_array().cloned().unwrap_or_default();
    let mut found: Vec<_> = children.iter().flat_map(inner).collect();
    if let (Some(uri), false) = (tile["content"]["uri"].as_str(), children.is_empty()) {
        let error = tile["geometricError"].as_f64().unwrap();
        let below =
            children.iter().map(|child| child["geometricError"].as_f64().unwrap()).fold(0.0, f64::max);
        assert!(error > below);
        found.push((uri.to_owned(), tile["refine"].as_str().unwrap().to_owned(), error));
    }
    found
}

#[test]
fn towers_are_in_inner_tiles_and_every_feature_is_in_one_tile_of_both_tilings() {
    let city = city();
    let planned = plan(&city, "out", &["--tall", "levels:20"]);
    assert_eq!((&planned["features"], &planned["tall"]), (&400.into(), &10.into()));
    for share in ["2/2", "1/2"] {
        city.json(&["make", "out", "--share", share]);
    }
    city.json(&["join", "out", "--tiling", "both"]);
    let checked = city.json(&["check", "out"]);
    assert_eq!((&checked["features"], &checked["missing"]), (&400.into(), &0.into()));
    let tileset = std::fs::read_to_string(city.path("out/tileset.json")).unwrap();
    let tileset: Value = serde_json::from_str(&tileset).unwrap();
    let inner = inner(&tileset["root"]);
    let read = TilePlan::read(&city.path("out/plan.json")).unwrap();
    let tall: Vec<_> = read.tiles.iter().filter(|tile| tile.is_tall()).collect();
    assert!(!tall.is_empty() && inner.len() == tall.len());
    // Towers are 60 m tall and more. They are shown while the houses, up to 15 m tall, are not.
    assert!(inner.iter().all(|(_, refine, error)| refine == "ADD" && *error > 10.0), "{inner:?}");
    // The same features have the same shapes without inner tiles.
    plan(&city, "flat", &[]);
    city.json(&["make", "flat"]);
    city.json(&["join", "flat"]);
    let flat = city.json(&["check", "flat"]);
    assert_eq!((&flat["triangles"], &flat["features"]), (&checked["triangles"], &checked["features"]));
    // The same bytes by one process.
    plan(&city, "other", &["--tall", "levels:20"]);
    city.json(&["make", "other", "--threads", "1"]);
    city.json(&["join", "other", "--tiling", "both"]);
    city.assert_same("out", "other");
}

#[test]
fn a_check_finds_towers_that_are_replaced_and_features_that_are_shown_twice() {
    let city = city();
    plan(&city, "out", &["--tall", "levels:20"]);
    city.json(&["make", "out"]);
    city.json(&["join", "out"]);
    let path = city.path("out/tileset.json");
    let text = std::fs::read_to_string(&path).unwrap();
    std::fs::write(&path, text.replace("\"ADD\"", "\"REPLACE\"")).unwrap();
    assert!(
        city.fails(&["check", "out"], 1).contains("is replaced by tiles inside that have other features")
    );
    std::fs::write(&path, text).unwrap();
    // A plan whose inner tile has all features of its square repeats those of the tiles inside.
    let plan = city.path("out/plan.json");
    let text = std::fs::read_to_string(&plan).unwrap();
    std::fs::write(&plan, text.replace(",\"tall\":true}", ",\"tall\":false}")).unwrap();
    assert!(city.fails(&["check", "out"], 1).contains("has tiles inside, but no coarser level of detail"));
}

#[test]
fn a_moved_threshold_and_an_unknown_attribute_are_noticed() {
    let city = city();
    plan(&city, "out", &["--tall", "levels:20"]);
    let arguments = [&["plan", "city.lua", "-o", "out"][..], &PLAN].concat();
    let text = city.fails(&[&arguments[..], &["--tall", "levels:4"]].concat(), 1);
    assert!(text.contains("--replace"), "{text}");
    let text = city.fails(&[&arguments[..], &["--tall", "level:4"]].concat(), 1);
    assert!(text.contains("no feature has an attribute named `level`") && text.contains("levels"), "{text}");
    for rule in ["levels", "levels:many", ":4"] {
        city.fails(&[&arguments[..], &["--tall", rule]].concat(), 2);
    }
    city.fails(&[&arguments[..], &["--tall", "levels:4", "--levels", "2"]].concat(), 2);
}
