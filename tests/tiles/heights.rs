//! Heights above the ellipsoid, from a geoid grid or a constant.

use burgeon::tiles::{TileFolder, TileManifest, TilePlan};

use crate::city::City;

/// Writes a grid around Paris that rises to the east by 2 m for a degree, from 44 m at 2 degrees.
fn write_geoid(city: &City) {
    let row = "44 45 46\n";
    let grid = format!("ncols 3\nnrows 3\nxllcenter 2\nyllcenter 48.5\ncellsize 0.5\n{row}{row}{row}");
    std::fs::write(city.path("geoid.asc"), grid).unwrap();
    let degrees = r#"GEOGCS["WGS 84",DATUM["WGS_1984",SPHEROID["WGS 84",6378137,298.257223563]],PRIMEM["Greenwich",0],UNIT["degree",0.0174532925199433],AUTHORITY["EPSG","4326"]]"#;
    std::fs::write(city.path("geoid.prj"), degrees).unwrap();
}

fn plan(city: &City, folder: &str, heights: [&str; 2]) -> serde_json::Value {
    city.json(&[&["plan", "city.lua", "-o", folder, "--target-features", "30"], &heights[..]].concat())
}

/// Returns the centres and the largest heights (m) of the boxes of all contents above the ellipsoid of the plan.
fn tops(city: &City, folder: &str) -> Vec<f64> {
    let folder = TileFolder(city.path(folder));
    let plan = TilePlan::read(&folder.plan()).unwrap();
    let top = |manifest: TileManifest| {
        let bounds = manifest.content.unwrap().bounds;
        bounds[2] + bounds[11] + plan.frame.geoid_height
    };
    plan.tiles.iter().map(|tile| top(TileManifest::read(&folder, tile.id).unwrap().unwrap())).collect()
}

#[test]
fn heights_above_a_geoid_grid_follow_the_grid() {
    let city = City::new(120);
    write_geoid(&city);
    let planned = plan(&city, "grid", ["--geoid", "geoid.asc"]);
    // The town is at a longitude of 2.345 degrees.
    let height = planned["geoid_height"].as_f64().unwrap();
    assert!((height - 44.69).abs() < 0.02, "{planned}");
    assert_eq!(planned["warnings"], serde_json::json!([]));
    plan(&city, "constant", ["--geoid-height", "40"]);
    for folder in ["grid", "constant"] {
        city.json(&["make", folder]);
        city.json(&["join", folder]);
        assert_eq!(city.json(&["check", folder])["features"], 120);
    }
    for (grid, constant) in tops(&city, "grid").into_iter().zip(tops(&city, "constant")) {
        assert!((grid - constant - (height - 40.0)).abs() < 0.02, "{grid} {constant}");
    }
    // A grid that changed is noticed.
    std::fs::write(city.path("geoid.asc"), "ncols 2\nnrows 2\n").unwrap();
    assert!(city.fails(&["make", "grid"], 1).contains("geoid.asc has changed since the plan was made"));
}

#[test]
fn a_missing_grid_and_one_that_does_not_cover_the_data_are_errors() {
    let city = City::new(20);
    let arguments = ["plan", "city.lua", "-o", "out", "--geoid"];
    let with = |file: &'static str| [&arguments[..], &[file]].concat();
    assert!(city.fails(&with("none.tif"), 1).contains("there is no geoid grid none.tif"));
    write_geoid(&city);
    let grid = std::fs::read_to_string(city.path("geoid.asc")).unwrap();
    std::fs::write(city.path("geoid.asc"), grid.replace("xllcenter 2", "xllcenter 7")).unwrap();
    let text = city.fails(&with("geoid.asc"), 1);
    assert!(
        text.contains("geoid.asc does not cover longitude 2.3") && text.contains("--geoid-height"),
        "{text}"
    );
    assert!(!city.path("out/plan.json").exists());
    city.fails(&[&with("geoid.asc")[..], &["--geoid-height", "44"]].concat(), 2);
}
