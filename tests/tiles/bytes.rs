//! The bytes of tiles do not depend on who makes them.

use crate::city::{City, city, write_geojson};

#[test]
fn one_worker_two_shares_and_shuffled_shares_write_the_same_bytes() {
    let city = City::new(400);
    for folder in ["one", "two", "five"] {
        let planned = city.plan(folder);
        assert_eq!((&planned["features"], &planned["left_out"]), (&400.into(), &0.into()));
        assert!(planned["tiles"].as_u64() > Some(12), "{planned}");
    }
    city.json(&["make", "one", "--threads", "1"]);
    for share in ["2/2", "1/2"] {
        city.json(&["make", "two", "--share", share, "--threads", "2"]);
    }
    for (index, of) in [("3", "5"), ("0", "5"), ("4", "5"), ("1", "5"), ("2", "5")] {
        let mut command = city.command(&["make", "five", "--of", of]);
        assert!(command.env("JOB_COMPLETION_INDEX", index).status().unwrap().success());
    }
    for folder in ["one", "two", "five"] {
        let joined = city.json(&["join", folder]);
        assert_eq!(
            (&joined["features"], &joined["missing"], &joined["open"]),
            (&400.into(), &0.into(), &0.into())
        );
        let checked = city.json(&["check", folder]);
        assert_eq!((&checked["features"], &checked["missing"]), (&400.into(), &0.into()));
        assert!(checked["points"].as_u64() > Some(3000), "{checked}");
    }
    city.assert_same("one", "two");
    city.assert_same("one", "five");
    for (name, bytes) in city.files("one") {
        let folder = city.0.path().to_string_lossy().into_owned();
        assert!(
            !bytes.windows(folder.len()).any(|part| part == folder.as_bytes()),
            "{name} has an absolute path"
        );
    }
}

#[test]
fn an_unchanged_second_run_keeps_all_tiles_and_a_changed_feature_remakes_few() {
    let city = City::new(400);
    let tiles = city.plan("out")["tiles"].as_u64().unwrap();
    assert_eq!(city.json(&["make", "out"])["made"], tiles);
    let again = city.json(&["make", "out"]);
    assert_eq!((&again["made"], &again["kept"]), (&0.into(), &tiles.into()));
    let connection = rusqlite::Connection::open(city.path("city.gpkg")).unwrap();
    connection.execute("UPDATE buildings SET levels = 9 WHERE fid = 200", []).unwrap();
    connection.close().unwrap();
    let planned = city.plan("out");
    assert!(planned["unchanged"].as_u64().unwrap() >= tiles - 4, "{planned}");
    let made = city.json(&["make", "out"])["made"].as_u64().unwrap();
    assert!((1..=4).contains(&made), "{made}");
    city.plan("fresh");
    city.json(&["make", "fresh"]);
    city.json(&["join", "out"]);
    city.json(&["join", "fresh"]);
    city.assert_same("out", "fresh");
}

#[test]
fn longitudes_and_latitudes_and_files_that_are_read_whole_make_valid_tiles() {
    let city = City::new(1);
    let degrees = |[x, y]: [f64; 2]| [2.35 + (x - 100.0) / 73_000.0, 48.85 + y / 111_200.0];
    let mut buildings = self::city(150, [0.0, 0.0]);
    buildings.iter_mut().for_each(|it| it.ring.iter_mut().for_each(|point| *point = degrees(*point)));
    write_geojson(&city.path("city.geojson"), &buildings);
    let city = city.script("\"city.geojson\"", "");
    assert_eq!(city.plan("out")["features"], 150);
    city.json(&["make", "out"]);
    city.json(&["join", "out"]);
    let checked = city.json(&["check", "out"]);
    assert_eq!((&checked["features"], &checked["missing"]), (&150.into(), &0.into()));
    let tileset: serde_json::Value =
        serde_json::from_slice(&std::fs::read(city.path("out/tileset.json")).unwrap()).unwrap();
    let at = |index: usize| tileset["root"]["transform"][index].as_f64().unwrap();
    let longitude = at(13).atan2(at(12)).to_degrees();
    assert!((longitude - 2.35).abs() < 0.01 && at(12).hypot(at(13)).hypot(at(14)) > 6.3e6, "{longitude}");
}

#[test]
fn status_counts_tiles_and_names_the_slowest() {
    let city = City::new(120);
    let tiles = city.plan("out")["tiles"].as_u64().unwrap();
    assert_eq!(city.json(&["status", "out"])["open"], tiles);
    city.json(&["make", "out", "--share", "1/2"]);
    let status = city.json(&["status", "out"]);
    let done = status["done"].as_u64().unwrap();
    assert!(done > 0 && done < tiles && status["slowest"][0]["seconds"].as_f64() > Some(0.0), "{status}");
    assert!((0.3..0.7).contains(&status["part"].as_f64().unwrap()), "{status}");
}
