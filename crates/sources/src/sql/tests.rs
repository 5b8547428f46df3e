//! Tests of queries of a small town and of generated packages.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use super::*;
use burgeon_base::budget::Budget;
use burgeon_kit::QueryRows;
use burgeon_spatial::Geometry;

mod meaning;
mod odd;
mod plans;
#[cfg(feature = "postgis")]
mod postgis;
#[cfg(feature = "postgis")]
mod postgis_connections;
mod safety;
mod same;
#[cfg(feature = "postgis")]
mod silent;

/// Writes a GeoPackage with houses on a lattice, roads between them and lamps, in EPSG:3067.
pub(crate) fn town(folder: &Path, houses: usize) -> PathBuf {
    let path = folder.join("town.gpkg");
    let connection = rusqlite::Connection::open(&path).unwrap();
    connection
        .execute_batch(
            "CREATE TABLE gpkg_contents (table_name TEXT, data_type TEXT, srs_id INTEGER);
             CREATE TABLE gpkg_geometry_columns (table_name TEXT, column_name TEXT, srs_id INTEGER);
             CREATE TABLE gpkg_spatial_ref_sys (srs_name TEXT, srs_id INTEGER, organization TEXT, organization_coordsys_id INTEGER);
             INSERT INTO gpkg_spatial_ref_sys VALUES ('TM35', 3067, 'EPSG', 3067);
             CREATE TABLE houses (fid INTEGER PRIMARY KEY, geom POLYGON, name TEXT, height REAL, levels INTEGER, part BOOLEAN);
             CREATE TABLE roads (fid INTEGER PRIMARY KEY, geom LINESTRING, kind TEXT);
             CREATE TABLE lamps (fid INTEGER PRIMARY KEY, geom POINT, lit BOOLEAN);
             BEGIN;",
        )
        .unwrap();
    let add = |table: &str, wkt: Option<String>, values: &[rusqlite::types::Value]| {
        let blob = wkt.map(|wkt| blob::write(&Geometry::from_wkt(&wkt).unwrap()));
        let marks: String = values.iter().map(|_| ", ?").collect();
        let mut all: Vec<rusqlite::types::Value> =
            vec![blob.map_or(rusqlite::types::Value::Null, Into::into)];
        all.extend(values.iter().cloned());
        let sql = format!("INSERT INTO {table} SELECT NULL, ?{marks}");
        connection.execute(&sql, rusqlite::params_from_iter(all)).unwrap();
    };
    for layer in ["houses", "roads", "lamps"] {
        connection
            .execute_batch(&format!(
                "INSERT INTO gpkg_contents VALUES ('{layer}', 'features', 3067);
                 INSERT INTO gpkg_geometry_columns VALUES ('{layer}', 'geom', 3067);"
            ))
            .unwrap();
    }
    // The positions are deterministic, and not on a lattice.
    let mut seed = 7u64;
    let mut next = |most: f64| {
        seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        #[allow(clippy::cast_precision_loss, reason = "a test")]
        let part = (seed >> 11) as f64 / (1u64 << 53) as f64;
        part * most
    };
    let side = (houses as f64).sqrt() * 14.0;
    let (west, south) = (385_000.0, 6_672_000.0);
    for number in 0..houses {
        let (x, y) = (west + next(side), south + next(side));
        let (w, h) = (6.0 + next(10.0), 6.0 + next(10.0));
        let wkt = format!("POLYGON(({x} {y}, {} {y}, {} {}, {x} {}, {x} {y}))", x + w, x + w, y + h, y + h);
        let name = (number % 3 != 0).then(|| format!("house {number}"));
        let levels = i64::try_from(number % 5).unwrap() + 1;
        add(
            "houses",
            (number % 97 != 96).then_some(wkt),
            &[
                name.map_or(rusqlite::types::Value::Null, Into::into),
                (levels as f64 * 3.25).into(),
                levels.into(),
                i64::from(number % 4 == 0).into(),
            ],
        );
    }
    for number in 0..houses / 6 {
        let (x, y) = (west + next(side), south + next(side));
        let points: Vec<String> = (0..6)
            .map(|step| format!("{} {}", x + f64::from(step) * 9.0, y + next(12.0) * f64::from(step % 3)))
            .collect();
        let kind = ["street", "path", "lane"][number % 3];
        add("roads", Some(format!("LINESTRING({})", points.join(", "))), &[kind.to_owned().into()]);
    }
    for number in 0..houses / 3 {
        let (x, y) = (west + next(side), south + next(side));
        add("lamps", Some(format!("POINT({x} {y})")), &[i64::from(number % 2 == 0).into()]);
    }
    connection.execute_batch("COMMIT").unwrap();
    path
}

/// Creates a database with such a town.
pub(crate) fn database(folder: &Path, houses: usize) -> Database {
    let path = town(folder, houses);
    let database = Database::new(None).unwrap();
    for layer in ["houses", "roads", "lamps"] {
        database.add_geopackage(layer, &path, "town.gpkg", layer, &budget()).unwrap();
    }
    database
}

/// Returns each row as a list.
pub(crate) fn lists(rows: &QueryRows<Cell>) -> Vec<Vec<Cell>> {
    rows.iter().map(<[Cell]>::to_vec).collect()
}

pub(crate) fn budget() -> Arc<Budget> {
    Budget::within(std::time::Duration::from_secs(60), 1_000_000_000)
}

#[test]
fn geometries_numbers_texts_and_nothing_come_back_as_they_are() {
    let database = Database::new(None).unwrap();
    let geometry = Arc::new(Geometry::from_wkt("POLYGON Z ((0 0 1, 4 0 2, 4 4 3, 0 0 1))").unwrap());
    let parameters = [
        ("g", Cell::Geometry(Arc::clone(&geometry))),
        ("n", Cell::Number(1.5)),
        ("t", Cell::Text("it's".into())),
        ("b", Cell::Boolean(true)),
        ("z", Cell::Null),
    ];
    let sql = "SELECT $g AS g, $n AS n, $t AS t, $b AS b, $z AS z, ST_AsText($g) AS w, $n > 1 AS more";
    let answer = database.query(sql, &parameters, &budget()).unwrap();
    assert_eq!(answer.names.join(" "), "g n t b z w more");
    let row = &answer.row(0);
    assert_eq!(row[0], Cell::Geometry(geometry));
    assert_eq!(row[1..5], [Cell::Number(1.5), Cell::Text("it's".into()), Cell::Number(1.0), Cell::Null]);
    assert_eq!(row[6], Cell::Boolean(true));
}

#[test]
fn threads_ask_at_the_same_time() {
    let folder = tempfile::tempdir().unwrap();
    let database = database(folder.path(), 500);
    let sql = "SELECT a.fid, b.fid AS other FROM houses a JOIN houses b ON a.fid < b.fid AND ST_Intersects(a.geom, b.geom)";
    let alone = database.query(sql, &[], &budget()).unwrap();
    assert!(alone.len() > 50, "{}", alone.len());
    std::thread::scope(|scope| {
        for _ in 0..6 {
            scope.spawn(|| {
                for _ in 0..3 {
                    assert_eq!(database.query(sql, &[], &budget()).unwrap().values, alone.values);
                }
            });
        }
    });
}

#[test]
fn a_layer_of_another_format_is_a_table() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("huts.geojson");
    let feature = |id: usize, x: f64| {
        format!(
            r#"{{"type":"Feature","id":"hut/{id}","properties":{{"name":"Hut {id}","height":{},"Height":2,"open":{}}},
            "geometry":{{"type":"Polygon","coordinates":[[[{x},60.0],[{},60.0],[{},60.0002],[{x},60.0]]]}}}}"#,
            id + 2,
            id == 1,
            x + 0.0002,
            x + 0.0002
        )
    };
    let features: Vec<String> = (0..5).map(|id| feature(id, 24.0 + 0.0001 * id as f64)).collect();
    std::fs::write(&path, format!(r#"{{"type":"FeatureCollection","features":[{}]}}"#, features.join(",")))
        .unwrap();
    let wanted = burgeon_data::SourceOptions::default();
    let table = burgeon_data::Source::open_within(&path, "huts.geojson", &wanted)
        .unwrap()
        .read("huts.geojson", &wanted)
        .unwrap();
    let mut frame = None;
    let layer = burgeon_data::Layer::new(table, &mut frame).unwrap();
    let database = Database::new(frame).unwrap();
    database.add_layer("huts", &layer, &budget()).unwrap();
    database.add_layer("huts", &layer, &budget()).unwrap();
    let sql = "SELECT a.id, a.name, a.height, a.open, a.geom, count(b.fid) AS near FROM huts a \
               LEFT JOIN huts b ON a.fid <> b.fid AND ST_DWithin(a.geom, b.geom, 3) GROUP BY a.fid";
    let answer = database.query(sql, &[], &budget()).unwrap();
    assert_eq!(answer.len(), 5);
    assert_eq!(
        answer.row(1)[..4],
        [Cell::Text("hut/1".into()), Cell::Text("Hut 1".into()), Cell::Number(3.0), Cell::Boolean(true)]
    );
    let near: Vec<String> = answer.iter().map(|row| row[5].to_string()).collect();
    assert_eq!(near, ["2", "3", "4", "3", "2"]);
    // Results are in metres relative to the origin, as in the layer.
    let Cell::Geometry(geometry) = &answer.row(1)[4] else { panic!("a geometry") };
    let known: Vec<_> = layer.features[1].geometry.points().copied().collect();
    assert!(geometry.points().zip(&known).all(|(a, b)| a.distance(*b) < 1e-6), "{geometry:?} {known:?}");
    // Parameters are in the same coordinates.
    let at = [("g", Cell::Geometry(Arc::clone(geometry)))];
    let found = database.query("SELECT id FROM huts WHERE ST_Intersects(geom, $g)", &at, &budget()).unwrap();
    assert!(lists(&found).contains(&vec![Cell::Text("hut/1".into())]), "{found}");
    let error =
        database.add_layer("huts", &burgeon_data::Layer { shown: "other".into(), ..layer }, &budget());
    insta::assert_snapshot!(error.unwrap_err(), @r#"
    there are two tables called huts
      help: name one of them otherwise: source(file, { table = "houses" })
    "#);
}
