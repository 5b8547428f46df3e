//! Tests of packages with curves, and of packages with changed bytes.

use rusqlite::Connection;

use crate::{Geometry, Layer, Source, SourceOptions};
use burgeon_base::budget::Budget;
use burgeon_base::random::Stream;
use std::path::Path;
use std::sync::Arc;
use std::time::Duration;

/// Returns a GeoPackage blob of a type, with a number of items, and points.
fn blob(kind: u32, count: Option<u32>, points: &[[f64; 2]]) -> Vec<u8> {
    let mut bytes = b"GP\0\x01\0\0\0\0\x01".to_vec();
    bytes.extend(kind.to_le_bytes());
    bytes.extend(count.into_iter().flat_map(u32::to_le_bytes));
    bytes.extend(points.iter().flatten().flat_map(|value| value.to_le_bytes()));
    bytes
}

/// Creates a package of points and an arc, in metres or in degrees.
fn package(path: &Path, crs: i32, middle: [f64; 2], radius: f64) {
    let connection = Connection::open(path).unwrap();
    connection
        .execute_batch(&format!(
            "CREATE TABLE gpkg_contents(table_name TEXT PRIMARY KEY, data_type TEXT);
             CREATE TABLE gpkg_geometry_columns(table_name TEXT, column_name TEXT, srs_id INT);
             CREATE TABLE gpkg_spatial_ref_sys(srs_name TEXT, srs_id INT, organization TEXT, organization_coordsys_id INT);
             INSERT INTO gpkg_spatial_ref_sys VALUES ('a', {crs}, 'EPSG', {crs});
             INSERT INTO gpkg_contents VALUES ('a', 'features');
             INSERT INTO gpkg_geometry_columns VALUES ('a', 'geom', {crs});
             CREATE TABLE a(fid INTEGER PRIMARY KEY, geom BLOB, name TEXT, height REAL);"
        ))
        .unwrap();
    let at = |x: f64, y: f64| [middle[0] + x * radius, middle[1] + y * radius];
    let arc = blob(8, Some(3), &[at(1.0, 0.0), at(0.0, 1.0), at(-1.0, 0.0)]);
    connection.execute("INSERT INTO a VALUES (1, ?1, 'arc', 3)", [arc]).unwrap();
    for number in 2..6 {
        let point = blob(1, None, &[at(0.0, f64::from(number) / 10.0)]);
        connection.execute("INSERT INTO a VALUES (?1, ?2, 'point', ?1)", (number, point)).unwrap();
    }
    connection.close().unwrap();
}

#[test]
fn arcs_are_within_a_centimetre_in_metres_and_in_degrees() {
    let folder = tempfile::tempdir().unwrap();
    for (crs, middle, radius) in [(3067, [385_423.0, 6_671_463.0], 40.0), (4326, [24.9, 60.1], 4e-4)] {
        let path = folder.path().join(format!("{crs}.gpkg"));
        package(&path, crs, middle, radius);
        let table = Source::open(&path, "a").unwrap().read("a", &SourceOptions::default()).unwrap();
        assert_eq!((table.features.len(), table.refused.len()), (5, 0));
        let Geometry::Line(points) = &table.features[0].geometry else { panic!("a line") };
        let step = if crs == 3067 { 1.0 } else { 111_320.0 };
        for pair in points.windows(2) {
            let half = [0, 1].map(|axis| (pair[0][axis] + pair[1][axis]) / 2.0 - middle[axis]);
            let off = (half[0].hypot(half[1]) - radius).abs() * step;
            assert!(off < 0.0101, "{crs}: {off}");
        }
        assert!(points.len() < 2000, "{}", points.len());
        let listing = crate::Listing::read(&path, &Arc::default()).unwrap().text();
        assert!(listing.contains("4 points, 1 line"), "{listing}");
    }
}

#[test]
fn changed_bytes_neither_panic_nor_take_long() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.gpkg");
    package(&path, 3067, [385_423.0, 6_671_463.0], 40.0);
    let whole = std::fs::read(&path).unwrap();
    let (mut stream, mut good, mut bad) = (Stream::new(5), 0, 0);
    let mut dice = |sides: usize| stream.below(sides);
    // Only few bytes carry information.
    let places: Vec<usize> = (0..whole.len()).filter(|at| whole[*at] != 0).collect();
    for case in 0..400 {
        let mut changed = whole.clone();
        for _ in 0..=dice(2) {
            let at = places[dice(places.len())] + dice(2);
            if let Some(byte) = changed.get_mut(at) {
                *byte = u8::try_from(dice(256)).unwrap();
            }
        }
        if case % 10 == 0 {
            changed.truncate(dice(whole.len()));
        }
        std::fs::write(&path, changed).unwrap();
        let budget = Budget::within(Duration::from_secs(20), 100_000_000);
        let wanted =
            SourceOptions { budget, condition: Some("height > 0".into()), ..SourceOptions::default() };
        let begin = std::time::Instant::now();
        let read = Source::open_within(&path, "a", &wanted)
            .and_then(|source| source.read("a", &wanted))
            .and_then(|table| Layer::new(table, &mut None));
        assert!(begin.elapsed().as_secs() < 10, "{case}");
        match read {
            Ok(layer) => {
                assert!(layer.bounds.iter().flatten().all(|value| value.is_finite()));
                good += 1;
            }
            Err(_) => bad += 1,
        }
    }
    assert!(good > 10 && bad > 50, "{good} {bad}");
}

#[test]
fn a_package_without_layers_of_features_is_told_to_have_none() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.gpkg");
    let connection = Connection::open(&path).unwrap();
    let create = "CREATE TABLE gpkg_contents(table_name TEXT PRIMARY KEY, data_type TEXT);
        CREATE TABLE gpkg_spatial_ref_sys(srs_name TEXT, srs_id INT, organization TEXT, organization_coordsys_id INT);";
    connection.execute_batch(create).unwrap();
    connection.close().unwrap();
    let read =
        Source::open(&path, "a.gpkg").and_then(|source| source.read("a.gpkg", &SourceOptions::default()));
    assert_eq!(read.unwrap_err().message(), "a.gpkg has no layers of features");
}
