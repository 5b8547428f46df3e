//! Tests of layers: what is written reads back.

#![cfg(feature = "data")]

use glam::DVec3;
use proptest::prelude::*;

use super::*;
use burgeon_base::stop::Stop;
use burgeon_data::{FeatureTable, Layer, Source, SourceOptions};
use burgeon_spatial::{Attribute, Crs, Geometry, Record, RecordTable, ReferenceFrame, Rings};

/// Returns the frame at a position in a coordinate system.
fn frame(code: u32, [x, y]: [f64; 2]) -> ReferenceFrame {
    ReferenceFrame::around(&Crs::epsg(code).unwrap(), [x, y], "a place").unwrap()
}

fn ring(points: &[[f64; 2]]) -> Vec<DVec3> {
    points.iter().map(|[x, y]| DVec3::new(*x, *y, 0.0)).collect()
}

fn lots() -> RecordTable {
    let values = |number: f64, text: &str| {
        vec![
            (0, Attribute::Number(number)),
            (1, Attribute::Text(text.into())),
            (2, Attribute::Boolean(number > 1.0)),
        ]
    };
    let square = |at: f64| ring(&[[at, 0.0], [at + 10.0, 0.0], [at + 10.0, 8.0], [at, 8.0]]);
    let hole = ring(&[[2.0, 2.0], [2.0, 4.0], [4.0, 4.0], [4.0, 2.0]]);
    let polygon = |rings: Vec<Vec<DVec3>>| Some(Geometry::Polygon(Rings(rings)));
    RecordTable {
        name: "Lot".into(),
        columns: ["area", "use", "corner", "odd"].map(str::to_owned).to_vec(),
        records: vec![
            Record {
                id: "a".into(),
                geometry: polygon(vec![square(0.0), hole]),
                values: values(76.5, "house"),
            },
            Record {
                id: "b".into(),
                geometry: polygon(vec![square(20.0)]),
                values: values(1.0, "it's \"b\"\u{1}"),
            },
            Record {
                id: "c".into(),
                geometry: None,
                values: vec![
                    (0, Attribute::Number(f64::NAN)),
                    (3, Attribute::Nested(std::sync::Arc::new(serde_json::json!([1, {"a": null}])))),
                ],
            },
        ],
    }
}

/// Reads back the layer called `layer` from written bytes, in metres relative to its own origin.
fn read(bytes: &[u8], extension: &str, layer: Option<&str>) -> (FeatureTable, Vec<String>) {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join(format!("a.{extension}"));
    std::fs::write(&path, bytes).unwrap();
    let source = Source::open(&path, "a").unwrap();
    let layers = source.layers().into_iter().map(str::to_owned).collect();
    let wanted = SourceOptions { layer: layer.map(str::to_owned), ..SourceOptions::default() };
    (source.read("a", &wanted).unwrap(), layers)
}

fn json(tables: &[RecordTable], frame: Option<&ReferenceFrame>) -> serde_json::Value {
    let mut bytes = Vec::new();
    write_geojson(tables, frame, &mut bytes).unwrap();
    serde_json::from_slice(&bytes).unwrap()
}

#[test]
fn a_geopackage_reads_back_with_its_projection_its_attributes_and_what_is_missing() {
    let frame = frame(3067, [385_423.0, 6_671_463.0]);
    let mut streets =
        RecordTable { name: "lot".into(), columns: vec!["FID".into(), "ID".into()], records: Vec::new() };
    let line = Geometry::Line(vec![DVec3::ZERO, DVec3::new(3.0, 4.0, 1.5)]);
    streets.records.push(Record {
        id: "s".into(),
        geometry: Some(line),
        values: vec![(0, Attribute::Number(0.5)), (1, Attribute::Text("x".into()))],
    });
    let bytes = write_geopackage(&[lots(), streets], Some(&frame), &Stop::default()).unwrap();
    let (table, layers) = read(&bytes, "gpkg", Some("Lot"));
    assert_eq!(layers, ["Lot", "lot_2"]);
    assert_eq!(table.crs.as_ref().unwrap().code, Some(3067));
    assert_eq!((table.features.len(), table.empty), (2, 1));
    let corner = table.features[0].geometry.points().next().unwrap();
    assert_eq!(corner.truncate().to_array(), frame.origin);
    let values: Vec<&Attribute> = table.features[1].attributes.iter().map(|(_, value)| value).collect();
    assert_eq!(values.len(), 4, "{values:?}");
    let (table, _) = read(&bytes, "gpkg", Some("lot_2"));
    assert_eq!(table.names, ["id", "FID_2", "ID_2"]);
    assert!(table.features[0].geometry.points().any(|point| point.z == 1.5));
}

#[test]
fn what_has_no_projection_that_others_know_is_written_in_degrees_and_what_is_nowhere_in_metres() {
    let own = frame(4326, [7.42, 43.73]);
    assert_eq!(own.epsg, None);
    let (table, _) = read(&write_geopackage(&[lots()], Some(&own), &Stop::default()).unwrap(), "gpkg", None);
    assert_eq!(table.crs.as_ref().unwrap().code, Some(4326));
    let back = Layer::new(table, &mut Some(own.clone())).unwrap();
    let given = lots();
    for (feature, record) in back.features.iter().zip(&given.records) {
        let points = record.geometry.as_ref().unwrap().points();
        assert!(feature.geometry.points().zip(points).all(|(a, b)| a.distance(*b) < 1e-6));
    }
    let bytes = write_geopackage(&[lots()], None, &Stop::default()).unwrap();
    let find = |text: &[u8]| bytes.windows(text.len()).any(|found| found == text);
    assert!(find(b"Undefined cartesian SRS") && find(b"gpkg_rtree_index") && find(b"rtree_Lot_geom_update4"));
}

#[test]
fn geojson_is_in_degrees_with_outer_rings_to_the_left() {
    let frame = frame(3067, [385_423.0, 6_671_463.0]);
    let mut lots = lots();
    if let Some(Geometry::Polygon(rings)) = &mut lots.records[1].geometry {
        rings.0[0].reverse();
    }
    let read = json(&[lots], Some(&frame));
    let features = read["features"].as_array().unwrap();
    assert_eq!(features.len(), 3);
    for feature in &features[..2] {
        for (number, ring) in feature["geometry"]["coordinates"].as_array().unwrap().iter().enumerate() {
            let points: Vec<[f64; 2]> = serde_json::from_value(ring.clone()).unwrap();
            assert_eq!(points.first(), points.last());
            let area: f64 = points.windows(2).map(|it| it[0][0] * it[1][1] - it[1][0] * it[0][1]).sum();
            assert_eq!(area > 0.0, number == 0);
            assert!(points.iter().all(|[x, y]| (24.0..26.0).contains(x) && (60.0..61.0).contains(y)));
        }
    }
    assert_eq!(
        features[0]["properties"],
        serde_json::json!({ "area": 76.5, "use": "house", "corner": true, "odd": null })
    );
    assert_eq!(features[1]["properties"]["use"], "it's \"b\"\u{1}");
    assert_eq!(
        features[2],
        serde_json::json!({ "type": "Feature", "id": "c", "geometry": null,
        "properties": { "area": null, "use": null, "corner": null, "odd": [1, { "a": null }] } })
    );
}

#[test]
fn what_has_no_place_on_the_earth_is_no_geojson() {
    let mut bytes = Vec::new();
    let error = write_geojson(&[lots()], None, &mut bytes).unwrap_err();
    insta::assert_snapshot!(error, @r"
    the model has no location on the earth, which GeoJSON needs
      help: read data with a location, source(FILE), or write a .gpkg, which accepts metres without a location
    ");
    assert_eq!(json(&[], None), serde_json::json!({ "type": "FeatureCollection", "features": [] }));
}

#[test]
fn a_line_across_the_antimeridian_goes_on_beyond_it() {
    let frame = frame(4326, [179.99, -16.0]);
    let line = Geometry::Line(vec![DVec3::new(-5000.0, 0.0, 0.0), DVec3::new(5000.0, 0.0, 0.0)]);
    let record = Record { id: "a".into(), geometry: Some(line), values: Vec::new() };
    let table = RecordTable { name: "a".into(), columns: Vec::new(), records: vec![record] };
    let read = json(&[table], Some(&frame));
    let points: Vec<[f64; 2]> =
        serde_json::from_value(read["features"][0]["geometry"]["coordinates"].clone()).unwrap();
    assert!(
        points[0][0] < 180.0 && points[1][0] > points[0][0] && points[1][0] - points[0][0] < 0.1,
        "{points:?}"
    );
}

fn attribute() -> impl Strategy<Value = Attribute> {
    prop_oneof![
        any::<bool>().prop_map(Attribute::Boolean),
        any::<f64>().prop_map(Attribute::Number),
        (-9i32..9).prop_map(|number| Attribute::Number(f64::from(number))),
        "\\PC{0,6}".prop_map(|text| Attribute::Text(text.into())),
    ]
}

fn geometry() -> impl Strategy<Value = Geometry> {
    let point = || prop::array::uniform3(-900.0f64..900.0).prop_map(DVec3::from_array);
    prop_oneof![
        point().prop_map(Geometry::point),
        prop::collection::vec(point(), 2..6).prop_map(Geometry::Line),
        (point(), 1.0f64..50.0).prop_map(|(at, size)| {
            Geometry::Polygon(Rings(vec![vec![
                at,
                at + DVec3::X * size,
                at + DVec3::new(size, size, 0.0),
                at + DVec3::Y * size,
            ]]))
        }),
    ]
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(256))]
    #[test]
    fn every_table_reads_back_from_both_formats(
        columns in prop::collection::btree_set("[a-z]{1,5}", 0..4),
        records in prop::collection::vec((geometry(), prop::collection::vec(prop::option::of(attribute()), 4)), 1..8),
    ) {
        let columns: Vec<String> = columns.into_iter().filter(|name| !["fid", "geom", "id", "layer"].contains(&name.as_str())).collect();
        let records = records.into_iter().enumerate().map(|(number, (geometry, values))| {
            let values = values.into_iter().enumerate().take(columns.len());
            let values = values.filter_map(|(column, value)| Some((column, value?))).collect();
            Record { id: format!("r{number}"), geometry: Some(geometry), values }
        });
        let table = RecordTable { name: "Things".into(), records: records.collect(), columns };
        let frame = frame(3067, [385_423.0, 6_671_463.0]);
        let bytes = write_geopackage(std::slice::from_ref(&table), Some(&frame), &Stop::default()).unwrap();
        prop_assert_eq!(&bytes, &write_geopackage(std::slice::from_ref(&table), Some(&frame), &Stop::default()).unwrap());
        let mut text = Vec::new();
        write_geojson(std::slice::from_ref(&table), Some(&frame), &mut text).unwrap();
        for (bytes, extension, near) in [(&bytes, "gpkg", 1e-9), (&text, "geojson", 2e-4)] {
            let (read, _) = read(bytes, extension, None);
            prop_assert_eq!(read.features.len(), table.records.len());
            let layer = Layer::new(read, &mut Some(frame.clone())).unwrap();
            for (feature, record) in layer.features.iter().zip(&table.records) {
                let points = record.geometry.as_ref().unwrap().points();
                for (a, b) in feature.geometry.points().zip(points) {
                    prop_assert!(a.distance(*b) < near, "{a} {b} {extension}");
                }
                for (column, name) in table.columns.iter().enumerate() {
                    let found = layer.names.iter().position(|known| known == name);
                    let found = feature.attributes.iter().find(|(index, _)| Some(*index) == found).map(|(_, value)| value);
                    let given = record.value(column);
                    prop_assert_eq!(found.is_some(), given.is_some(), "{} {:?} {:?}", extension, found, given);
                    if let (Some(found), Some(given)) = (found, given) {
                        let same = match (found, given) {
                            (Attribute::Number(a), Attribute::Number(b)) => (a - b).abs() <= b.abs() * 1e-15,
                            (Attribute::Number(a), Attribute::Boolean(b)) => *a == f64::from(u8::from(*b)),
                            (a, b) => a.text() == b.text(),
                        };
                        prop_assert!(same, "{extension} {found:?} {given:?}");
                    }
                }
            }
        }
    }
}

/// Writes the files to the folder `BURGEON_SAMPLES` if it is set, for inspection with other programs.
#[test]
fn samples_are_written_for_other_programs() {
    let temporary = tempfile::tempdir().unwrap();
    let folder = std::env::var_os("BURGEON_SAMPLES").map_or(temporary.path().to_path_buf(), Into::into);
    let frames = [
        ("metres", frame(3067, [385_423.0, 6_671_463.0])),
        ("lambert", frame(2154, [652_000.0, 6_862_000.0])),
        ("degrees", frame(4326, [7.42, 43.73])),
    ];
    for (name, frame) in &frames {
        let package = write_geopackage(&[lots()], Some(frame), &Stop::default()).unwrap();
        std::fs::write(folder.join(format!("{name}.gpkg")), package).unwrap();
        let mut text = Vec::new();
        write_geojson(&[lots()], Some(frame), &mut text).unwrap();
        std::fs::write(folder.join(format!("{name}.geojson")), text).unwrap();
        let origin = format!("{:?} {:?}", frame.origin, frame.epsg);
        std::fs::write(folder.join(format!("{name}.txt")), origin).unwrap();
    }
    assert!(folder.join("degrees.gpkg").metadata().unwrap().len() > 10_000);
}

#[test]
fn every_kind_of_geometry_is_written_and_mixed_kinds_are_told() {
    let texts = [
        "POINT (1 2)",
        "POINT EMPTY",
        "LINESTRING (0 0, 3 4)",
        "POLYGON ((0 0, 4 0, 4 4, 0 4, 0 0), (1 1, 1 2, 2 2, 2 1, 1 1))",
        "MULTIPOINT ((1 1), (2 2))",
        "MULTILINESTRING ((0 0, 1 1), (2 2, 3 3, 4 2))",
        "MULTIPOLYGON (((0 0, 1 0, 1 1, 0 0)), ((5 5, 6 5, 6 6, 5 5)))",
        "GEOMETRYCOLLECTION (POINT (1 1), LINESTRING (0 0, 1 1))",
        "POINT Z (1 2 3)",
    ];
    let record = |(number, text): (usize, &&str)| Record {
        id: number.to_string(),
        geometry: Some(Geometry::from_wkt(text).unwrap()),
        values: Vec::new(),
    };
    let table = RecordTable {
        name: "all".into(),
        columns: Vec::new(),
        records: texts.iter().enumerate().map(record).collect(),
    };
    let frame = frame(3067, [385_423.0, 6_671_463.0]);
    let bytes = write_geopackage(std::slice::from_ref(&table), Some(&frame), &Stop::default()).unwrap();
    assert!(bytes.windows(8).any(|found| found == b"GEOMETRY"));
    let (read, _) = read(&bytes, "gpkg", None);
    // Each feature has one part.
    assert_eq!((read.features.len(), read.empty), (1 + 1 + 1 + 2 + 2 + 2 + 2 + 1, 1));
    let written = json(&[table], Some(&frame));
    let kinds: Vec<&str> = written["features"]
        .as_array()
        .unwrap()
        .iter()
        .map(|it| it["geometry"]["type"].as_str().unwrap())
        .collect();
    assert_eq!(
        kinds,
        [
            "Point",
            "Point",
            "LineString",
            "Polygon",
            "MultiPoint",
            "MultiLineString",
            "MultiPolygon",
            "GeometryCollection",
            "Point"
        ]
    );
    assert_eq!(written["features"][1]["geometry"]["coordinates"], serde_json::json!([]));
    assert_eq!(written["features"][8]["geometry"]["coordinates"][2], 3.0);
}
