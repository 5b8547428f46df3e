//! Unusual geometries, in every function and in tables of mixed types.

use super::*;
use crate::sql::functions::FUNCTIONS;

/// Geometries that are empty, without extent, invalid, far away, mixed, with heights, and with measures.
const ODD: [&str; 21] = [
    "POINT EMPTY",
    "LINESTRING EMPTY",
    "POLYGON EMPTY",
    "MULTIPOLYGON EMPTY",
    "GEOMETRYCOLLECTION EMPTY",
    "POINT (3 4)",
    "POINT ZM (3 4 5 6)",
    "LINESTRING (1 1, 1 1)",
    "LINESTRING M (0 0 1, 9 0 2, 9 9 3)",
    "LINESTRING (0 0, 9 9, 9 0, 0 9)",
    "MULTIPOINT (1 1, 1 1, (2 2))",
    "MULTILINESTRING ((0 0, 1 1), EMPTY, (5 5, 5 5))",
    "POLYGON ((0 0, 4 4, 4 0, 0 4, 0 0))",
    "POLYGON ((0 0, 9 0, 4 0, 0 0))",
    "POLYGON ((0 0, 9 0, 9 9, 0 9, 0 0), (0 0, 9 0, 9 9, 0 9, 0 0))",
    "POLYGON ((0 0, 9 0, 9 9, 0 9, 0 0), (20 20, 30 20, 30 30, 20 20))",
    "POLYGON Z ((0 0 1, 9 0 2, 9 9 3, 0 9 4, 0 0 1))",
    "MULTIPOLYGON (((0 0, 9 0, 9 9, 0 9, 0 0)), ((5 5, 14 5, 14 14, 5 14, 5 5)))",
    "GEOMETRYCOLLECTION (POINT (1 1), LINESTRING (0 0, 5 5), POLYGON ((0 0, 9 0, 9 9, 0 9, 0 0)))",
    "LINESTRING (-1e9 0, 1e9 1e-9)",
    "POLYGON ((0 0, 3e-309 0, 3e-309 3e-309, 0 0))",
];

/// Returns the arguments to try for a parameter with this name, in attempt `turn`.
fn argument(name: &str, turn: usize) -> Vec<String> {
    let numbers = ["0", "-1.5", "2", "1e300", "0.5"];
    match name {
        "geometry" | "line" | "point" | "polygon" => {
            ODD.iter().map(|wkt| format!("ST_GeomFromText('{wkt}')")).collect()
        }
        "pattern" => vec!["'F***1****'".into(), "'nothing'".into()],
        "options" => vec!["'endcap=flat join=mitre'".into(), "4".into(), "'side=odd'".into()],
        "text" => vec!["'POLYGON ((0 0'".into(), "'POINT (1 2)'".into(), "''".into()],
        "bytes" => vec!["x'0101'".into(), "x'0101000000000000000000f87f000000000000f87f'".into()],
        _ => vec![numbers[turn % numbers.len()].into(), "NULL".into(), "'three'".into()],
    }
}

#[test]
fn every_function_takes_odd_geometries_or_says_why_not() {
    let folder = tempfile::tempdir().unwrap();
    let database = database(folder.path(), 1);
    let (mut given, mut told) = (0, 0);
    for (turn, function) in FUNCTIONS.iter().enumerate() {
        let names = function.takes.trim_matches(['(', ')']).replace(['[', ']', ','], " ");
        let names: Vec<&str> = names.split_whitespace().filter(|name| *name != "or").collect();
        for count in function.least..=function.most {
            let mut calls = vec![String::new()];
            for (place, name) in names.iter().take(usize::from(count)).enumerate() {
                let values = argument(name, turn + place);
                let more = |call: &String| {
                    let comma = if place == 0 { "" } else { ", " };
                    values.iter().map(|value| format!("{call}{comma}{value}")).collect::<Vec<_>>()
                };
                calls = calls.iter().flat_map(more).collect();
            }
            for call in calls.iter().step_by(1 + calls.len() / 150) {
                let sql = format!("SELECT {}({call}) AS it", function.name);
                match database.query(&sql, &[], &budget()) {
                    Ok(_) => given += 1,
                    Err(error) => {
                        assert!(error.kind().code() != "internal", "{sql}: {error}");
                        told += 1;
                    }
                }
            }
        }
    }
    assert!(given > 3000 && told > 100, "{given} {told}");
}

#[test]
fn tables_of_mixed_and_invalid_geometries_are_joined_and_none_is_lost() {
    let folder = tempfile::tempdir().unwrap();
    let database = database(folder.path(), 40);
    let odd: Vec<String> =
        ODD.iter().enumerate().map(|(id, wkt)| format!("({id}, ST_GeomFromText('{wkt}'))")).collect();
    let odd = format!("WITH odd(id, geom) AS (VALUES {})", odd.join(", "));
    let count = |sql: &str| {
        let answer = database.query(&format!("{odd} {sql}"), &[], &budget());
        answer.unwrap_or_else(|error| panic!("{sql}: {error}")).len()
    };
    assert_eq!(count("SELECT a.id, b.id AS other FROM odd a LEFT JOIN odd b ON a.id = b.id"), ODD.len());
    assert_eq!(count("SELECT id FROM odd WHERE ST_IsEmpty(geom)"), 5);
    assert_eq!(count("SELECT id FROM odd WHERE NOT ST_IsValid(geom)"), 8);
    assert_eq!(count("SELECT id FROM odd WHERE NOT ST_IsValid(ST_MakeValid(geom))"), 0);
    assert_eq!(
        count("SELECT o.id, h.fid FROM odd o LEFT JOIN houses h ON ST_Intersects(o.geom, h.geom)"),
        ODD.len()
    );
    assert_eq!(count("SELECT ST_Union(geom) AS geom, ST_Collect(geom) AS both FROM odd"), 1);
}

#[test]
fn a_row_whose_geometry_cannot_be_read_is_named() {
    let folder = tempfile::tempdir().unwrap();
    let path = town(folder.path(), 30);
    let connection = rusqlite::Connection::open(&path).unwrap();
    let no_number = [b"GP\0\x01\0\0\0\0\x01\x01\0\0\0".as_slice(), &f64::NAN.to_le_bytes(), &[0; 8]].concat();
    for (blob, fid) in [(&no_number[..], 17), (&no_number[..20], 23)] {
        connection.execute("UPDATE houses SET geom = ?1 WHERE fid = ?2", (blob, fid)).unwrap();
    }
    drop(connection);
    let database = Database::new(None).unwrap();
    database.add_geopackage("houses", &path, "town.gpkg", "houses", &budget()).unwrap();
    database.add_geopackage("built", &path, "town.gpkg", "houses", &budget()).unwrap();
    let told = |sql: &str| database.query(sql, &[], &budget()).unwrap_err().message().to_owned();
    insta::assert_snapshot!(
        [
            "SELECT ST_Area(geom) FROM houses WHERE fid > 10",
            "SELECT fid FROM built WHERE fid > 20 AND ST_Area(geom) > 50",
            "SELECT geom AS place FROM houses WHERE fid = 17",
            "SELECT a.fid FROM houses a, built b WHERE b.fid = 17 AND ST_Distance(a.geom, b.geom) < 2",
            "SELECT ST_Area(x'0101')",
        ]
        .map(told)
        .join("\n"),
        @r"
    SQL, line 1, column 8: ST_Area: the geometry of argument 1 has a coordinate that is no finite number (geom of houses with fid 17)
    SQL, line 1, column 42: ST_Area: the geometry of argument 1 ends too early (geom of built with fid 23)
    a geometry has a coordinate that is no finite number (column place) (geom of houses with fid 17)
    SQL: a geometry has a coordinate that is no finite number (geom of built with fid 17)
    SQL, line 1, column 8: ST_Area: the geometry of argument 1 ends too early
    "
    );
    // An invalid geometry that is not read causes no error.
    assert_eq!(database.query("SELECT fid FROM houses WHERE fid = 17", &[], &budget()).unwrap().len(), 1);
}
