//! Tables of the features beside the contents of tiles.

use std::collections::BTreeSet;

use burgeon_spatial::Geometry;
use parquet::file::reader::{FileReader as _, SerializedFileReader};
use parquet::record::Field;
use serde_json::Value;

use crate::city::City;

const PLAN: [&str; 6] = ["--reach", "2", "--target-features", "30", "--geoid-height", "44"];

fn plan(city: &City, folder: &str, options: &[&str]) -> Value {
    city.json(&[&["plan", "city.lua", "-o", folder][..], &PLAN, options].concat())
}

/// Row of a GeoParquet file: id, levels and the middle of the first ring.
fn rows(bytes: &[u8]) -> Vec<(String, i64, [f64; 2])> {
    let file = SerializedFileReader::new(bytes::Bytes::copy_from_slice(bytes)).unwrap();
    let read = file.get_row_iter(None).unwrap().map(|row| {
        let row = row.unwrap();
        let names: Vec<String> = row.get_column_iter().map(|(name, _)| name.clone()).collect();
        assert_eq!(names, ["layer", "id", "levels", "geometry"]);
        let mut fields = row.get_column_iter().map(|(_, field)| field.clone());
        assert_eq!(fields.next(), Some(Field::Str("buildings".to_owned())));
        let (Some(Field::Str(id)), Some(Field::Long(levels)), Some(Field::Bytes(geometry))) =
            (fields.next(), fields.next(), fields.next())
        else {
            panic!("{row}")
        };
        let Geometry::Polygon(rings) = Geometry::from_wkb(geometry.data()).unwrap() else { panic!("{id}") };
        let sum = rings[0].iter().fold([0.0; 2], |sum, point| [sum[0] + point.x, sum[1] + point.y]);
        (id, levels, sum.map(|sum| sum / rings[0].len() as f64))
    });
    read.collect()
}

#[test]
fn every_tile_has_its_features_in_both_tables_with_the_attributes_of_the_script() {
    let city = City::new(200);
    plan(&city, "out", &["--tables", "geoparquet,cityjson"]);
    city.json(&["make", "out", "--threads", "1"]);
    city.json(&["join", "out"]);
    let checked = city.json(&["check", "out"]);
    let tiles = checked["tiles"].as_u64().unwrap();
    assert!(tiles > 5 && checked["tables"] == 2 * tiles, "{checked}");
    let files = city.files("out");
    let mut ids = BTreeSet::new();
    for (_, bytes) in files.iter().filter(|(name, _)| name.ends_with(".parquet")) {
        for (id, levels, [longitude, latitude]) in rows(bytes) {
            let number: i64 = id.parse().unwrap();
            assert_eq!(levels, 1 + (number - 1) * 5 % 4, "{id}");
            // The centre of Paris in Lambert 93, at 11 m and 31 m for each column and row.
            let (column, row) = ((number - 1) % 15, (number - 1) / 15);
            assert!((longitude - 2.3454 - column as f64 * 11.0 / 73_200.0).abs() < 2e-3, "{longitude}");
            assert!((latitude - 48.8566 - row as f64 * 31.0 / 111_200.0).abs() < 2e-3, "{latitude}");
            assert!(ids.insert(id));
        }
    }
    assert_eq!(ids.len(), 200);
    let mut objects = BTreeSet::new();
    for (name, bytes) in files.iter().filter(|(name, _)| name.ends_with(".city.jsonl")) {
        let text = String::from_utf8(bytes.clone()).unwrap();
        let mut lines = text.lines().map(|line| serde_json::from_str::<Value>(line).unwrap());
        let first = lines.next().unwrap();
        assert!(first["metadata"]["referenceSystem"].as_str().unwrap().ends_with("/2154"), "{name}");
        for feature in lines {
            let id = feature["id"].as_str().unwrap().to_owned();
            let object = &feature["CityObjects"][id.as_str()];
            assert_eq!(
                (&object["type"], &object["geometry"][0]["type"]),
                (&"Building".into(), &"Solid".into())
            );
            let number: i64 = id.parse().unwrap();
            assert_eq!(object["attributes"]["levels"].as_f64(), Some((1 + (number - 1) * 5 % 4) as f64));
            assert!(object["attributes"].get("name").is_none());
            objects.insert(id);
        }
    }
    assert_eq!(objects, ids);
    // The same bytes in another order, and what is complete is kept.
    plan(&city, "other", &["--tables", "cityjson,geoparquet"]);
    for share in ["2/2", "1/2"] {
        city.json(&["make", "other", "--share", share]);
    }
    city.json(&["join", "other"]);
    city.assert_same("out", "other");
    let again = city.json(&["make", "out"]);
    assert_eq!((&again["made"], &again["kept"]), (&0.into(), &tiles.into()));
}

#[test]
fn a_missing_table_remakes_its_tile_and_a_plan_without_tables_removes_them() {
    let city = City::new(60);
    plan(&city, "out", &["--tables", "geoparquet"]);
    city.json(&["make", "out"]);
    let tables = |city: &City| -> Vec<String> {
        city.files("out").into_keys().filter(|name| name.ends_with(".parquet")).collect()
    };
    let before = city.files("out");
    let first = tables(&city).swap_remove(0);
    std::fs::remove_file(city.path("out").join(&first)).unwrap();
    assert_eq!(city.json(&["make", "out"])["made"], 1);
    assert_eq!(city.files("out"), before);
    city.json(&["join", "out"]);
    let mut bytes = before[&first].clone();
    let last = bytes.len() - 20;
    bytes[last] ^= 1;
    std::fs::write(city.path("out").join(&first), &bytes).unwrap();
    assert!(city.fails(&["check", "out"], 1).contains("is not that of the manifest"));
    plan(&city, "out", &["--replace"]);
    city.json(&["make", "out"]);
    assert_eq!(tables(&city), [""; 0]);
    city.json(&["join", "out"]);
    city.json(&["check", "out"]);
    city.fails(&["plan", "city.lua", "-o", "out", "--tables", "csv"], 2);
}
