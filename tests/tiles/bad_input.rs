//! Odd data, changed inputs and disks that are full.

use crate::city::{Building, City, city, write_geojson, write_geopackage};

#[test]
fn features_without_geometry_are_listed_with_their_cause() {
    let city = City::new(1);
    let mut buildings = self::city(60, [652_000.0, 6_862_000.0]);
    buildings[7].ring.clear();
    buildings[31].ring.clear();
    std::fs::remove_file(city.path("city.gpkg")).unwrap();
    write_geopackage(&city.path("city.gpkg"), 2154, &buildings);
    let planned = city.plan("out");
    assert_eq!((&planned["features"], &planned["left_out"]), (&58.into(), &2.into()));
    city.json(&["make", "out"]);
    assert_eq!(city.json(&["join", "out"])["missing"], 2);
    let csv = std::fs::read_to_string(city.path("out/missing.csv")).unwrap();
    assert!(csv.contains("buildings,8,1,,\"the feature has no geometry") && csv.contains("32,1,"), "{csv}");
    // Files of other formats, too.
    write_geojson(&city.path("city.geojson"), &buildings);
    let city = city.script("\"city.geojson\", { crs = 2154 }", "");
    let planned = city.plan("json");
    assert_eq!((&planned["features"], &planned["left_out"]), (&58.into(), &2.into()));
    city.json(&["make", "json"]);
    city.json(&["join", "json"]);
    let csv = std::fs::read_to_string(city.path("json/missing.csv")).unwrap();
    assert!(csv.contains("city,8,1,,\"the feature has no geometry") && csv.contains("city,32,1,"), "{csv}");
}

#[test]
fn tiles_that_failed_without_the_data_of_the_plan_are_made_once_the_data_are_back() {
    let city = City::new(1);
    let buildings = self::city(60, [652_000.0, 6_862_000.0]);
    let path = city.path("city.geojson");
    write_geojson(&path, &buildings);
    let city = city.script("\"city.geojson\", { crs = 2154 }", "");
    let tiles = city.plan("out")["tiles"].clone();
    let text = std::fs::read(&path).unwrap();
    std::fs::write(&path, &text[..text.len() / 2]).unwrap();
    assert!(city.fails(&["make", "out"], 1).contains("is not GeoJSON"));
    std::fs::remove_file(&path).unwrap();
    let absent = city.fails(&["make", "out"], 1);
    assert!(absent.contains("data file not found") && absent.contains("--retry-failed"), "{absent}");
    std::fs::write(&path, text).unwrap();
    assert_eq!(city.json(&["make", "out"])["made"], tiles);
    city.json(&["join", "out"]);
    assert_eq!(city.json(&["check", "out"])["features"], 60);
}

#[test]
fn a_file_that_is_added_or_lost_after_the_plan_is_named() {
    let city = City::new(30);
    write_geojson(&city.path("city.geojson"), &self::city(30, [652_000.0, 6_862_000.0]));
    let city = city.script("\"city.geojson\", { crs = 2154 }", "");
    let script = std::fs::read_to_string(city.path("city.lua")).unwrap();
    let script = format!("pcall(require, \"extra\")\nlocal shared = require(\"shared\")\n{script}");
    std::fs::write(city.path("city.lua"), script).unwrap();
    let shared = city.path("shared.lua");
    std::fs::write(&shared, "return 1").unwrap();
    city.plan("out");
    std::fs::write(city.path("extra.lua"), "return 1").unwrap();
    let text = city.fails(&["make", "out"], 1);
    assert!(text.contains("../extra.lua was not there when the plan was made"), "{text}");
    std::fs::remove_file(city.path("extra.lua")).unwrap();
    std::fs::remove_file(&shared).unwrap();
    // A folder may come back.
    let text = city.fails(&["make", "out"], 75);
    assert!(text.contains("../shared.lua is missing, which the plan needs"), "{text}");
    std::fs::write(&shared, "return 1").unwrap();
    city.json(&["make", "out"]);
}

#[test]
fn doubled_ids_are_numbered_as_in_the_whole_run_and_listed() {
    let city = City::new(1);
    let mut buildings = self::city(60, [652_000.0, 6_862_000.0]);
    buildings[50].id = buildings[2].id;
    write_geojson(&city.path("city.geojson"), &buildings);
    let city = city.script("\"city.geojson\", { crs = 2154 }", "");
    let planned = city.plan("out");
    assert!(planned["warnings"].to_string().contains("several features have the id 3"), "{planned}");
    city.json(&["make", "out"]);
    city.json(&["join", "out"]);
    assert_eq!(city.json(&["check", "out"])["features"], 60);
    // The attribute that names the features of a GeoPackage can repeat in pieces that are read one after another.
    let connection = rusqlite::Connection::open(city.path("city.gpkg")).unwrap();
    connection
        .execute("INSERT INTO buildings SELECT fid + 1, geom, levels, name FROM buildings", [])
        .unwrap();
    connection.close().unwrap();
    let city = city.script("\"city.gpkg\", { id = \"name\" }", "");
    let planned = city.plan("twice");
    assert!(planned["warnings"].to_string().contains("several features have the id house 1"), "{planned}");
    city.json(&["make", "twice"]);
    city.json(&["join", "twice"]);
    assert_eq!(city.json(&["check", "twice"])["features"], 2);
}

#[test]
fn data_that_changed_since_the_plan_are_refused_and_a_new_plan_repairs_it() {
    let city = City::new(100);
    city.plan("out");
    let connection = rusqlite::Connection::open(city.path("city.gpkg")).unwrap();
    connection.execute("UPDATE buildings SET levels = levels + 1 WHERE fid = 5", []).unwrap();
    connection.close().unwrap();
    let text = city.fails(&["make", "out"], 1);
    assert!(
        text.contains("1 tiles failed") && text.contains("have changed since the plan was made"),
        "{text}"
    );
    let joined = city.json(&["join", "out"]);
    assert_eq!((&joined["failed"], joined["missing"].as_u64() > Some(0)), (&1.into(), true), "{joined}");
    city.json(&["check", "out"]);
    city.plan("out");
    city.json(&["make", "out"]);
    city.json(&["join", "out"]);
    assert_eq!(city.json(&["check", "out"])["features"], 100);
}

#[test]
fn a_changed_script_is_refused() {
    let city = City::new(30);
    city.plan("out");
    let city = city.script("\"city.gpkg\"", "");
    assert!(city.fails(&["make", "out"], 1).contains("city.lua has changed since the plan was made"));
}

#[test]
fn a_second_plan_of_other_arguments_does_not_replace_the_first() {
    let city = City::new(30);
    city.plan("out");
    let other = ["plan", "city.lua", "-o", "out", "--seed", "4"];
    assert!(city.fails(&other, 1).contains("with other arguments"));
    city.json(&[&other[..], &["--replace"]].concat());
}

#[test]
fn a_feature_that_fails_is_missing_with_its_cause_and_the_others_are_there() {
    let city = City::new(40).script("\"city.gpkg\"", "if height > 11 then error('too high') end");
    city.plan("out");
    let text = city.fails(&["make", "out"], 1);
    assert!(text.contains("tiles failed") && text.contains("too high"), "{text}");
    let joined = city.json(&["join", "out"]);
    assert_eq!(joined["features"].as_u64().unwrap() + joined["missing"].as_u64().unwrap(), 40, "{joined}");
    let csv = std::fs::read_to_string(city.path("out/missing.csv")).unwrap();
    assert!(csv.contains("too high"), "{csv}");
    city.json(&["check", "out"]);
    // A failed tile is not made again unless that is asked for.
    let started = std::fs::metadata(city.path("out/plan.json")).unwrap().len();
    assert!(city.fails(&["make", "out"], 1).contains("too high") && started > 0);
}

#[test]
fn a_large_feature_that_crosses_many_tiles_is_in_one() {
    let city = City::new(1);
    let mut buildings = self::city(200, [652_000.0, 6_862_000.0]);
    let [x, y] = [651_990.0, 6_861_980.0];
    let ring = vec![[x, y], [x + 900.0, y], [x + 900.0, y + 5.0], [x, y + 5.0], [x, y]];
    buildings.push(Building { id: 1000, ring, levels: 2 });
    std::fs::remove_file(city.path("city.gpkg")).unwrap();
    write_geopackage(&city.path("city.gpkg"), 2154, &buildings);
    assert_eq!(city.plan("out")["features"], 201);
    city.json(&["make", "out"]);
    city.json(&["join", "out"]);
    assert_eq!(city.json(&["check", "out"])["features"], 201);
}

#[cfg(target_os = "linux")]
#[test]
fn a_full_disk_is_worth_a_retry_and_leaves_nothing_incomplete() {
    let city = City::new(60);
    city.plan("out");
    let program = env!("CARGO_BIN_EXE_burgeon");
    // Files of at most 4 KiB, and the signal of the limit ignored, so that writing fails.
    let limited = format!("trap '' XFSZ; ulimit -f 4; exec '{program}' tiles make out");
    let output =
        std::process::Command::new("sh").arg("-c").arg(limited).current_dir(city.0.path()).output().unwrap();
    let text = String::from_utf8_lossy(&output.stderr).into_owned();
    assert_eq!(output.status.code(), Some(75), "{text}");
    let names: Vec<String> = city.files("out").into_keys().collect();
    assert!(names.iter().all(|name| !name.ends_with(".part") && !name.ends_with(".glb")), "{names:?}");
    city.json(&["make", "out"]);
    city.json(&["join", "out"]);
    assert_eq!(city.json(&["check", "out"])["features"], 60);
}

#[test]
fn the_command_line_and_the_scheduler_are_checked() {
    let city = City::new(10);
    assert!(city.fails(&["make", "none"], 1).contains("burgeon tiles plan SCRIPT -o FOLDER"));
    city.plan("out");
    assert!(city.fails(&["make", "out", "--of", "3"], 1).contains("SLURM_ARRAY_TASK_ID"));
    let mut command = city.command(&["make", "out", "--of", "3"]);
    let status = command.env("SLURM_ARRAY_TASK_MIN", "1").env("SLURM_ARRAY_TASK_ID", "4").status().unwrap();
    assert_eq!(status.code(), Some(1));
    assert!(city.fails(&["make", "out", "--tile", "3/0/0"], 1).contains("no tile 3/0/0"));
    for wrong in
        [&["make", "out", "--share", "3/2"][..], &["make", "out", "--tile", "a"], &["plan", "city.lua"]]
    {
        city.fails(wrong, 2);
    }
}

#[test]
fn a_check_finds_content_that_is_not_what_the_plan_says() {
    let city = City::new(60);
    city.plan("out");
    city.json(&["make", "out"]);
    city.json(&["join", "out"]);
    let tileset = city.path("out/tileset.json");
    let text = std::fs::read_to_string(&tileset).unwrap();
    let mut document: serde_json::Value = serde_json::from_str(&text).unwrap();
    let moved = document["root"]["transform"][12].as_f64().unwrap() + 0.5;
    document["root"]["transform"][12] = moved.into();
    std::fs::write(&tileset, document.to_string()).unwrap();
    assert!(city.fails(&["check", "out"], 1).contains("transforms do not lead to its place"));
    let mut document: serde_json::Value = serde_json::from_str(&text).unwrap();
    document["root"]["children"].as_array_mut().unwrap().pop();
    std::fs::write(&tileset, document.to_string()).unwrap();
    assert!(city.fails(&["check", "out"], 1).contains("is not in the tileset"));
    std::fs::write(&tileset, &text).unwrap();
    let (name, mut bytes) = city.files("out").into_iter().find(|(name, _)| name.ends_with(".glb")).unwrap();
    let last = bytes.len() - 40;
    bytes[last] ^= 64;
    std::fs::write(city.path("out").join(name), bytes).unwrap();
    assert!(city.fails(&["check", "out"], 1).contains("not that of the manifest"));
}
