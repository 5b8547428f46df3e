//! Tests of documents, sequences, and invalid features among valid ones.

use super::super::{Geometry, GeometryKind};
use super::*;
use crate::{FeatureTable, SourceOptions};
use burgeon_base::budget::Budget;
use burgeon_base::error::Result;
use std::path::Path;
use std::sync::Arc;

fn read_as(text: &str, name: &str) -> Result<FeatureTable> {
    read(text.as_bytes(), Path::new(name), name, &SourceOptions::default())
}

fn table(text: &str) -> FeatureTable {
    read_as(text, "a.geojson").unwrap()
}

fn told(table: &FeatureTable) -> Vec<String> {
    table.refused.iter().map(|(id, error)| format!("{id}: {}", error.message())).collect()
}

fn feature(geometry: &str) -> String {
    format!(r#"{{"type":"Feature","properties":{{}},"geometry":{geometry}}}"#)
}

#[test]
fn ids_come_from_the_feature_its_properties_or_its_content() {
    let feature = |inner: &str| {
        format!(r#"{{"type":"Feature",{inner},"geometry":{{"type":"Point","coordinates":[1,2]}}}}"#)
    };
    let features = [
        feature(r#""id":7,"properties":{"id":"b"}"#),
        feature(r#""properties":{"id":"b"}"#),
        feature(r#""properties":null"#),
        feature(r#""id":7.0,"properties":{}"#),
    ];
    let text = format!(r#"{{"type":"FeatureCollection","features":[{}]}}"#, features.join(","));
    let table = table(&text);
    let ids: Vec<&str> = table.features.iter().map(|feature| feature.id.as_str()).collect();
    assert_eq!(ids, ["7", "b", ids[2], "7.2"]);
    assert!(ids[2].len() == 12 && ids[2].starts_with('f') && table.derived == 1, "{ids:?}");
    assert_eq!((table.layer.as_str(), table.crs.unwrap().code), ("a", Some(4326)));
}

#[test]
fn a_feature_or_a_geometry_alone_is_a_layer() {
    let polygon = r#"{"type":"MultiPolygon","coordinates":[[[[0,0],[1,0],[1,1],[0,0]]],[[[5,5,2],[6,5,2],[6,6,2],[5,5,2]]],[]]}"#;
    assert_eq!(table(polygon).features.len(), 2);
    let feature =
        format!(r#"{{"type":"Feature","properties":{{"a":1,"b":null,"c":[1]}},"geometry":{polygon}}}"#);
    let table = table(&feature);
    assert_eq!((table.features.len(), table.names.len(), table.features[1].attributes.len()), (2, 3, 2));
    assert!(table.features[1].geometry.points().all(|point| point[2] == 2.0));
}

#[test]
fn features_without_geometry_are_counted() {
    let text = r#"{"type":"FeatureCollection","features":[
        {"type":"Feature","properties":{},"geometry":null},
        {"type":"Feature","properties":{},"geometry":{"type":"Polygon","coordinates":[]}},
        {"type":"Feature","properties":{},"geometry":{"type":"Polygon","coordinates":[[[0,0],[1,1],[0,0]]]}}]}"#;
    assert_eq!((table(text).empty, table(text).features.len()), (3, 0));
}

#[test]
fn a_collection_gives_a_feature_for_each_part() {
    let point = r#"{"type":"Point","coordinates":[1,2]}"#;
    let line = r#"{"type":"LineString","coordinates":[[0,0],[1,1]]}"#;
    let inner = format!(r#"{{"type":"GeometryCollection","geometries":[{line},null]}}"#);
    let table =
        table(&feature(&format!(r#"{{"type":"GeometryCollection","geometries":[{point},{inner}]}}"#)));
    let kinds: Vec<_> = table.features.iter().map(|part| (part.id.as_str(), part.geometry.kind())).collect();
    let second = format!("{}.2", kinds[0].0);
    assert_eq!(kinds, [(kinds[0].0, GeometryKind::Point), (&*second, GeometryKind::Line)]);
    let mut deep = point.to_owned();
    for _ in 0..60 {
        deep = format!(r#"{{"type":"GeometryCollection","geometries":[{deep}]}}"#);
    }
    let table = self::table(&format!(r#"{{"type":"FeatureCollection","features":[{}]}}"#, feature(&deep)));
    assert_eq!(told(&table), ["1: feature 1 of a.geojson has collections nested more than 32 deep"]);
}

#[test]
fn one_bad_feature_among_others_is_left_out_with_the_reason() {
    let deep = format!("{}1{}", "[".repeat(100_000), "]".repeat(100_000));
    let bad = [
        feature(r#"{"type":"Point","coordinates":["a",2]}"#),
        feature(r#"{"type":"Point","coordinates":[1e999,2]}"#),
        feature(r#"{"type":"Point","coordinates":7}"#),
        feature(r#"{"type":"Point","coordinates":[1]}"#),
        feature(r#"{"type":"Polygon","coordinates":[[0,0],[1,0],[1,1]]}"#),
        feature(r#"{"type":"LineString","coordinates":[[0,null],[1,0]]}"#),
        feature(&format!(r#"{{"type":"Polygon","coordinates":{deep}}}"#)),
        feature(r#"{"type":"Blob","coordinates":[1,2]}"#),
        feature(r#"{"coordinates":[1,2]}"#),
        feature("7"),
        r#"{"type":"Feature","properties":[],"geometry":null}"#.to_owned(),
        r#"{"type":"Feature","properties":{"a":1e999},"geometry":null}"#.to_owned(),
        "null".to_owned(),
        "[[]]".to_owned(),
    ];
    let good = feature(r#"{"type":"Point","coordinates":[1,2]}"#);
    let all = bad.join(&format!(",{good},"));
    let table = table(&format!(r#"{{"type":"FeatureCollection","features":[{good},{all}]}}"#));
    assert_eq!((table.refused.len(), table.features.len()), (bad.len(), bad.len()));
    insta::assert_snapshot!(told(&table).join("\n"), @r#"
    2: feature 2 of a.geojson has text instead of a number in its coordinates
    4: feature 4 of a.geojson has coordinates that cannot be read: number out of range
    6: feature 6 of a.geojson has a number instead of a list in its coordinates
    8: feature 8 of a.geojson has a point of fewer than two numbers
    10: feature 10 of a.geojson has a number instead of a list in its coordinates
    12: feature 12 of a.geojson has null instead of a number in its coordinates
    14: feature 14 of a.geojson has a list instead of a number in its coordinates
    16: feature 16 of a.geojson has a geometry of unknown type "Blob"
    18: feature 18 of a.geojson has a geometry without a type
    20: feature 20 of a.geojson has an invalid geometry: invalid type: integer `7`, expected a geometry
    22: feature 22 of a.geojson has properties that cannot be read: invalid type: sequence, expected an object
    24: feature 24 of a.geojson has properties that cannot be read: number out of range
    26: feature 26 of a.geojson is not a feature: invalid type: null, expected a feature
    28: feature 28 of a.geojson is not a feature: invalid length 1, expected a feature with 3 elements
    "#);
}

#[test]
fn sequences_are_read_with_separators_and_line_by_line() {
    let (a, b) = (
        feature(r#"{"type":"Point","coordinates":[1,2]}"#),
        feature(r#"{"type":"Point","coordinates":[3,4]}"#),
    );
    let ids = |text: &str, name: &str| -> Vec<String> {
        let table = read_as(text, name).unwrap();
        assert_eq!(told(&table), [""; 0]);
        table.features.into_iter().map(|feature| feature.id.to_string()).collect()
    };
    let known = [ids(&a, "a.geojson"), ids(&b, "a.geojson")].concat();
    for text in [
        format!("\u{1e}{a}\n\u{1e}{b}\n"),
        format!("{a}\n{b}"),
        format!("{a}\r\n\r\n{b}\r\n"),
        format!("{{\"type\":\"FeatureCollection\",\"features\":[{a}]}}\n{b}"),
        format!("\u{feff}{a} {b}"),
    ] {
        assert_eq!(ids(&text, "a.geojson"), known, "{text}");
        assert_eq!(ids(&text, "a.ndjson"), known, "{text}");
    }
    assert_eq!(ids(&a, "a.geojsonl"), known[..1]);
    let broken = read_as(&format!("{a}\noops\n{b}\n{{\"a\":1}}\n"), "a.geojsonl").unwrap();
    assert_eq!(broken.features.len(), 2);
    assert_eq!(
        told(&broken),
        [
            "2: line 2 of a.geojsonl is not JSON: expected value",
            "4: feature 4 of a.geojsonl is JSON, but neither a feature nor a geometry",
        ]
    );
    let broken = read_as(&format!("\u{1e}{a}\n\u{1e}{{\"type\n\u{1e}{b}\n"), "a.geojsons").unwrap();
    assert_eq!((broken.features.len(), broken.refused.len()), (2, 1));
}

#[test]
fn memory_is_asked_for_before_it_is_taken_and_time_is_kept() {
    let points = vec!["[1,2]"; 400_000].join(",");
    let text = feature(&format!(r#"{{"type":"LineString","coordinates":[{points}]}}"#));
    let with = |budget: Arc<Budget>| {
        let wanted = SourceOptions { budget, ..SourceOptions::default() };
        read(text.as_bytes(), Path::new("a"), "a", &wanted).map(|table| table.features.len())
    };
    let minute = std::time::Duration::from_secs(60);
    assert_eq!(with(Budget::within(minute, 100_000_000)).unwrap(), 1);
    assert!(with(Budget::within(minute, 1_000_000)).unwrap_err().message().contains("memory limit"));
    assert!(
        with(Budget::within(std::time::Duration::ZERO, 100_000_000))
            .unwrap_err()
            .message()
            .contains("time limit")
    );
}

#[test]
fn changed_bytes_never_make_it_panic() {
    let feature = feature(
        r#"{"type":"GeometryCollection","geometries":[{"type":"Polygon","coordinates":[[[0,0],[1.5,0],[1,1e2],[0,0]]]}]}"#,
    );
    let text =
        format!(r#"{{"type":"FeatureCollection","crs":null,"features":[{feature},{feature}],"name":"a"}}"#);
    let (mut good, mut bad) = (0, 0);
    for at in 0..text.len() {
        for byte in *b"\0 \n\x1e\"[]{},:-0e9n\xff" {
            let mut changed = text.clone().into_bytes();
            changed[at] = byte;
            match read(&changed, Path::new("a"), "a", &SourceOptions::default()) {
                Ok(table) => {
                    good += usize::from(
                        table.features.iter().any(|it| matches!(it.geometry, Geometry::Polygon(_))),
                    )
                }
                Err(_) => bad += 1,
            }
        }
        assert!(read(&text.as_bytes()[..at], Path::new("a"), "a", &SourceOptions::default()).is_err());
    }
    assert!(good > 500 && bad > 500, "{good} {bad}");
}

/// Returns the complete content of a table as text.
fn content(table: &FeatureTable) -> String {
    let FeatureTable { layer, crs, names, features, records, empty, refused, notes, .. } = table;
    format!("{layer} {crs:?} {names:?} {features:?} {records} {empty} {refused:?} {notes:?}")
}

#[test]
fn a_file_says_the_same_when_it_is_read_a_part_at_a_time() {
    let point = r#"{"type":"Point","coordinates":[12.5,-3e1]}"#;
    let (a, b) = (
        feature(r#"{"type":"Polygon","coordinates":[[[0,0],[10,0],[10,10],[0,0]]]}"#),
        format!(r#"{{"id":"\u00e9 }}","type":"Feature","properties":{{"näme":"x\"]"}},"geometry":{point}}}"#),
    );
    let null = r#"{"type":"Feature","properties":null,"geometry":null}"#;
    let utm = r#""crs":{"type":"name","properties":{"name":"urn:ogc:def:crs:EPSG::25831"}}"#;
    let texts = [
        format!(r#"{{"type":"FeatureCollection","features":[{a},{b},{null},{a}]}}"#),
        format!(
            "\u{feff} {{ \"features\" : [ {a}\n,\t{b} ] ,\r\n\"name\":\"town\", \"type\": \"FeatureCollection\", {utm} }} \n"
        ),
        format!(r#"{{"type":"FeatureCollection","features":[7,{a},{{"type":1}},{b}]}}"#),
        format!(r#"{{"f\u0065atures":[{a}],"type":"FeatureCollection","features":[{b}]}}"#),
        r#"{"type":"FeatureCollection","features":[ ]}"#.to_owned(),
        format!("{a}\n{b}\n{{}}\n{point}\n{a}"),
        format!("{a}{{\"type\":\"FeatureCollection\",\"features\":[{a},{b}]}}{b}"),
        format!("\u{1e}{a}\n\u{1e}\u{1e} \n\u{1e}{b}"),
        a.clone(),
        point.to_owned(),
    ];
    let wanted = SourceOptions::default();
    let part =
        |bytes: &[u8], name: &str, window: usize| stream(bytes, Path::new(name), name, &wanted, window);
    for (text, name) in texts.iter().flat_map(|text| [(text, "a.geojson"), (text, "a.ndjson")]) {
        let whole = content(&read_as(text, name).unwrap());
        for window in (1..80).chain([1000, 100_000]) {
            let table = part(text.as_bytes(), name, window).unwrap().expect(text);
            assert_eq!(content(&table), whole, "{text} by {window}");
        }
    }
    let (mut same, mut irregular) = (0, 0);
    for text in texts.iter().map(String::as_bytes) {
        for at in 0..text.len() {
            for byte in *b"\0 \n\x1e\"[]{},:-0e\xff" {
                let changed = [&text[..at], &[byte], &text[at + 1..]].concat();
                let whole = read(&changed, Path::new("a"), "a", &wanted);
                match part(&changed, "a", 1 + at % 50) {
                    Ok(Some(table)) => {
                        assert_eq!(content(&table), content(&whole.unwrap()));
                        same += 1;
                    }
                    Ok(None) => irregular += 1,
                    Err(error) => assert_eq!(whole.unwrap_err().message(), error.message()),
                }
            }
        }
    }
    assert!(same > 5_000 && irregular > 5_000, "{same} {irregular}");
}

#[test]
fn a_part_at_a_time_takes_no_more_memory_than_its_largest_feature() {
    let small = feature(r#"{"type":"Point","coordinates":[1,2]}"#);
    let list = vec![small.as_str(); 20_000].join(",");
    let text = format!(r#"{{"type":"FeatureCollection","features":[{list}]}}"#);
    let with = |text: &str, memory: usize| {
        let budget = Budget::within(std::time::Duration::from_secs(60), memory);
        let wanted = SourceOptions { budget, ..SourceOptions::default() };
        let read = stream(text.as_bytes(), Path::new("a"), "a", &wanted, 1000);
        read.map(|table| (table.unwrap().features.len(), wanted.budget.used_bytes()))
    };
    let (count, taken) = with(&text, 100_000_000).unwrap();
    assert_eq!(count, 20_000);
    assert!(with(&text, taken + 2_000).is_ok() && with(&text, taken - 1_000).is_err());
    let points = vec!["[1,2]"; 400_000].join(",");
    let large = feature(&format!(r#"{{"type":"LineString","coordinates":[{points}]}}"#));
    assert!(with(&large, 1_000_000).unwrap_err().message().contains("memory limit"));
}
