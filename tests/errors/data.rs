//! Data files that are missing, unreadable, of another format than expected, or incomplete.

use insta::assert_snapshot;
use rusqlite::Connection;

use crate::support::{Folder, HEAD, without_columns};

const RING: &str = "[[[6.1,45.9],[6.1001,45.9],[6.1001,45.9001],[6.1,45.9]]]";

/// Returns GeoJSON with one feature, and another member after its features.
fn geojson(kind: &str, coordinates: &str, member: &str) -> String {
    format!(
        r#"{{"type":"FeatureCollection","features":[{{"type":"Feature","properties":{{"height":7,"name":"mill"}},"geometry":{{"type":"{kind}","coordinates":{coordinates}}}}}]{member}}}"#
    )
}

/// Returns a geometry in GeoPackage encoding: a point, or a line of several points.
fn blob(points: &[[f64; 2]]) -> Vec<u8> {
    let mut bytes = b"GP\0\x01\0\0\0\0\x01".to_vec();
    let single = points.len() == 1;
    bytes.extend(if single { 1u32 } else { 2 }.to_le_bytes());
    if !single {
        bytes.extend(u32::try_from(points.len()).unwrap().to_le_bytes());
    }
    bytes.extend(points.iter().flatten().flat_map(|value| value.to_le_bytes()));
    bytes
}

/// Returns a GeoPackage with a road and with buildings, of which one is at `north` and one has no geometry.
fn package(crs: i32, north: f64) -> Vec<u8> {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.gpkg");
    let connection = Connection::open(&path).unwrap();
    connection
        .execute_batch(
            "CREATE TABLE gpkg_contents(table_name TEXT PRIMARY KEY, data_type TEXT);
             CREATE TABLE gpkg_geometry_columns(table_name TEXT, column_name TEXT, srs_id INT);
             CREATE TABLE gpkg_spatial_ref_sys(srs_name TEXT, srs_id INT, organization TEXT, organization_coordsys_id INT);
             INSERT INTO gpkg_spatial_ref_sys VALUES ('a', 3067, 'EPSG', 3067), ('odd', 5000, 'ME', 1), ('n', -1, 'NONE', -1);
             CREATE TABLE buildings(fid INTEGER PRIMARY KEY, geom BLOB, height REAL, name TEXT, listed BOOLEAN);
             CREATE TABLE roads(fid INTEGER PRIMARY KEY, geom BLOB, name TEXT);",
        )
        .unwrap();
    for layer in ["buildings", "roads"] {
        connection.execute("INSERT INTO gpkg_contents VALUES (?1, 'features')", [layer]).unwrap();
        connection
            .execute("INSERT INTO gpkg_geometry_columns VALUES (?1, 'geom', ?2)", (layer, crs))
            .unwrap();
    }
    let mill = blob(&[[385_423.0, 6_671_463.0]]);
    connection.execute("INSERT INTO buildings VALUES (1, ?1, 5, 'mill', 1)", [mill]).unwrap();
    let inn = blob(&[[385_500.0, north]]);
    connection.execute("INSERT INTO buildings VALUES (2, ?1, 15, NULL, 0)", [inn]).unwrap();
    connection.execute("INSERT INTO buildings VALUES (3, NULL, 1, 'ruin', NULL)", []).unwrap();
    let lane = blob(&[[385_423.0, 6_671_463.0], [385_433.0, 6_671_463.0]]);
    connection.execute("INSERT INTO roads VALUES (1, ?1, 'lane')", [lane]).unwrap();
    connection.close().unwrap();
    std::fs::read(path).unwrap()
}

/// Returns a folder with valid and faulty data files.
pub(crate) fn folder() -> Folder {
    let point = |coordinates: &str, member: &str| geojson("Point", coordinates, member);
    let town = package(3067, 6_671_500.0);
    let other = {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a");
        Connection::open(&path).unwrap().execute_batch("CREATE TABLE a(b)").unwrap();
        std::fs::read(path).unwrap()
    };
    let village = geojson("Polygon", RING, "");
    let folder = Folder::new()
        .with("in/village.geojson", village.as_str())
        .with("in/cut.geojson", &village[..150])
        .with("in/town.osm.pbf", include_bytes!("../../fuzz/corpus/osm/good-town.osm.pbf").as_slice())
        .with("in/empty.geojson", "")
        .with("in/broken.geojson", "{\n\"type\": \"FeatureCollection\",\n\"features\": [ oops ]\n}")
        .with("in/plain.json", "{\"a\": 1}")
        .with("in/none.geojson", r#"{"type":"FeatureCollection","features":[]}"#)
        .with("in/collection.geojson", r#"{"type":"FeatureCollection","features":[{"type":"Feature","id":"x","properties":{},"geometry":{"type":"GeometryCollection","geometries":[]}}]}"#)
        .with("in/metres.geojson", point("[385423, 6671463]", ""))
        .with("in/huge.geojson", point("[1e999, 1]", ""))
        .with("in/crs.geojson", point("[1, 1]", r#","crs":{"type":"name","properties":{"name":"urn:ogc:def:crs:EPSG::99999"}}"#))
        .with("in/nowhere.geojson", point("[1, 1]", r#","crs":{"type":"link"}"#))
        .with("in/text.geojson", r#"{"type":"FeatureCollection","features":[{"type":"Feature","properties":{},"geometry":{"type":"Point","coordinates":["a",1]}}]}"#)
        .with("in/binary.geojson", [0xff, 0xfe, 0, 1])
        .with("in/folder/a.txt", "")
        .with("in/town.gpkg", town.as_slice())
        .with("in/cut.gpkg", &town[..9000])
        .with("in/local.gpkg", package(-1, 6_671_500.0))
        .with("in/odd.gpkg", package(5000, 6_671_500.0))
        .with("in/nan.gpkg", package(3067, f64::INFINITY))
        .with("in/other.gpkg", other)
        .with("outside.geojson", village.as_str())
        .with("data/far.geojson", village.as_str());
    std::os::unix::fs::symlink("../outside.geojson", folder.path().join("in/link.geojson")).unwrap();
    folder
}

/// Returns the error message for a script whose second line is `line`.
pub(crate) fn told(line: &str) -> String {
    folder().with("in/s.lua", format!("local a = 1\n{line}\n")).refuses(&["run", "in/s.lua"])
}

/// Returns the output of a script that succeeds.
fn printed(script: &str, flags: &[&str]) -> String {
    let folder = folder().with("in/s.lua", script);
    let before = folder.files();
    let said = folder.burgeon(&[&["run", "in/s.lua", "--json"], flags].concat()).done();
    assert_eq!(folder.files(), before, "reading leaves nothing behind");
    said.stderr
}

#[test]
fn a_data_file_that_is_missing_or_lies_outside_is_told() {
    assert_snapshot!(told(r#"source("vilage.geojson")"#), @r#"
    error: in/s.lua:2:1: data file not found: vilage.geojson
      | source("vilage.geojson")
      | ^^^^^^^^^^^^^^^^^^^^^^^^
      help: did you mean village.geojson?
    "#);
    assert_snapshot!(told(r#"source("zzz_nothing_like_it.gpkg")"#), @r#"
    error: in/s.lua:2:1: data file not found: zzz_nothing_like_it.gpkg
      | source("zzz_nothing_like_it.gpkg")
      | ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^
      help: it is looked for from the script's folder; other folders are given with --data FOLDER
    "#);
    assert_snapshot!(told(r#"source("")"#), @r#"
    error: in/s.lua:2:1: source needs a file name
      | source("")
      | ^^^^^^
      help: write source("village.geojson")
    "#);
    assert_snapshot!(told(r#"source("folder")"#), @r#"
    error: in/s.lua:2:1: folder is a folder
      | source("folder")
      | ^^^^^^^^^^^^^^^^
      help: specify a .geojson, .gpkg, .fgb, .shp, .csv, .gml, .kml, .gpx, .city.json or .osm.pbf file in the folder
    "#);
    assert_snapshot!(told(r#"source("../outside.geojson")"#), @r#"
    error: in/s.lua:2:1: the data file ../outside.geojson lies outside the script's folder
      | source("../outside.geojson")
      | ^^^^^^^^^^^^^^^^^^^^^^^^^^^^
      help: a script reads data in its own folder and below it, and in those that are given: --data FOLDER
    "#);
    assert_snapshot!(told(r#"source("link.geojson")"#), @r#"
    error: in/s.lua:2:1: the data file link.geojson lies outside the script's folder
      | source("link.geojson")
      | ^^^^^^^^^^^^^^^^^^^^^^
      help: a script reads data in its own folder and below it, and in those that are given: --data FOLDER
    "#);
    assert_snapshot!(told(r#"source("/etc/passwd")"#), @r#"
    error: in/s.lua:2:1: the data file /etc/passwd is named by a path from the root
      | source("/etc/passwd")
      | ^^^^^^^^^^^^^^^^^^^^^
      help: name it from the script's folder, or from one that is given: --data FOLDER
    "#);
    assert_snapshot!(told(r#"source("unknown_region.geojson")"#), @r#"
    error: in/s.lua:2:1: data file not found: unknown_region.geojson
      | source("unknown_region.geojson")
      | ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^
      help: it is looked for from the script's folder; other folders are given with --data FOLDER
    "#);
}

#[test]
fn a_file_that_is_no_data_file_is_told() {
    assert_snapshot!(told(r#"source("cut.geojson")"#), @r#"
    error: in/s.lua:2:1: cut.geojson is not GeoJSON: it ends at line 1, column 150, but more should follow
      | source("cut.geojson")
      | ^^^^^^^^^^^^^^^^^^^^^
      help: the file is cut short; download it again
    "#);
    assert_snapshot!(told(r#"source("empty.geojson")"#), @r#"
    error: in/s.lua:2:1: empty.geojson is empty
      | source("empty.geojson")
      | ^^^^^^^^^^^^^^^^^^^^^^^
      help: download the file again
    "#);
    assert_snapshot!(told(r#"source("broken.geojson")"#), @r#"
    error: in/s.lua:2:1: broken.geojson is not GeoJSON: expected value (line 3, column 15)
      | source("broken.geojson")
      | ^^^^^^^^^^^^^^^^^^^^^^^^
      help: GeoJSON is described in RFC 7946
    "#);
    assert_snapshot!(told(r#"source("plain.json")"#), @r#"
    error: in/s.lua:2:1: plain.json is JSON, but not GeoJSON
      | source("plain.json")
      | ^^^^^^^^^^^^^^^^^^^^
      help: it needs "type": "FeatureCollection" and "features": [ ... ]
    "#);
    assert_snapshot!(told(r#"source("text.geojson")"#), @r#"
    error: in/s.lua:2:1: feature 1 of text.geojson has text instead of a number in its coordinates
      | source("text.geojson")
      | ^^^^^^^^^^^^^^^^^^^^^^
      help: supported types are points, lines, polygons, multi-geometries and collections of these
    "#);
    assert_snapshot!(told(r#"source("binary.geojson")"#), @r#"
    error: in/s.lua:2:1: binary.geojson is not GeoJSON: expected value (line 1, column 1)
      | source("binary.geojson")
      | ^^^^^^^^^^^^^^^^^^^^^^^^
      help: GeoJSON is described in RFC 7946
    "#);
    assert_snapshot!(told(r#"source("cut.gpkg")"#), @r#"
    error: in/s.lua:2:1: cannot read cut.gpkg: database disk image is malformed
      | source("cut.gpkg")
      | ^^^^^^^^^^^^^^^^^^
      help: the file is damaged or cut short; download it again
    "#);
    assert_snapshot!(told(r#"source("other.gpkg")"#), @r#"
    error: in/s.lua:2:1: other.gpkg is an SQLite database, but not a GeoPackage
      | source("other.gpkg")
      | ^^^^^^^^^^^^^^^^^^^^
      help: a GeoPackage has the tables gpkg_contents and gpkg_geometry_columns
    "#);
}

#[test]
fn a_layer_that_is_not_there_is_told() {
    assert_snapshot!(told(r#"source("town.gpkg:bulidings")"#), @r#"
    error: in/s.lua:2:19: town.gpkg: no layer named `bulidings`
      | source("town.gpkg:bulidings")
      |                   ^^^^^^^^^
      help: did you mean buildings?
    "#);
    assert_snapshot!(told(r#"source("town.gpkg")"#), @r#"
    error: in/s.lua:2:1: town.gpkg has several layers
      | source("town.gpkg")
      | ^^^^^^^^^^^^^^^^^^^
      help: specify one after a colon: "town.gpkg:buildings"; it has buildings, roads
    "#);
    assert_snapshot!(told(r#"source("village.geojson:roads")"#), @r#"
    error: in/s.lua:2:25: village.geojson: no layer named `roads`
      | source("village.geojson:roads")
      |                         ^^^^^
      help: it has village
    "#);
}

#[test]
fn coordinates_that_cannot_be_used_are_told() {
    assert_snapshot!(told(r#"source("metres.geojson")"#), @r#"
    error: in/s.lua:2:1: feature f8c0fe66c234 of metres.geojson is at 385423, 6671463, which is not a valid longitude and latitude
      | source("metres.geojson")
      | ^^^^^^^^^^^^^^^^^^^^^^^^
      help: specify the coordinate system of the file: source(file, { crs = 3067 })
    "#);
    assert_snapshot!(told(r#"source("huge.geojson")"#), @r#"
    error: in/s.lua:2:1: feature 1 of huge.geojson has coordinates that cannot be read: number out of range
      | source("huge.geojson")
      | ^^^^^^^^^^^^^^^^^^^^^^
      help: supported types are points, lines, polygons, multi-geometries and collections of these
    "#);
    assert_snapshot!(told(r#"source("crs.geojson")"#), @r#"
    error: in/s.lua:2:1: crs.geojson: unknown coordinate system EPSG:99999
      | source("crs.geojson")
      | ^^^^^^^^^^^^^^^^^^^^^
      help: specify the correct one: source(file, { crs = 4326 }), or convert the file to EPSG:4326
    "#);
    assert_snapshot!(told(r#"source("nowhere.geojson")"#), @r#"
    error: in/s.lua:2:1: nowhere.geojson: unknown coordinate system {"type":"link"} in GeoJSON's crs member
      | source("nowhere.geojson")
      | ^^^^^^^^^^^^^^^^^^^^^^^^^
      help: specify it: source(file, { crs = 4326 })
    "#);
    assert_snapshot!(told(r#"source("local.gpkg:roads")"#), @r#"
    error: in/s.lua:2:1: local.gpkg:roads: the layer has no coordinate system
      | source("local.gpkg:roads")
      | ^^^^^^^^^^^^^^^^^^^^^^^^^^
      help: specify its EPSG code: source(file, { crs = 3067 })
    "#);
    assert_snapshot!(told(r#"source("odd.gpkg:roads")"#), @r#"
    error: in/s.lua:2:9: odd.gpkg:roads: the layer's coordinate system "odd" is not an EPSG system
      | source("odd.gpkg:roads")
      |         ^^^
      help: specify its EPSG code: source(file, { crs = 3067 })
    "#);
    assert_snapshot!(told(r#"source("village.geojson") source("metres.geojson", { crs = 32601 })"#), @r#"
    error: in/s.lua:2:1: feature f8c0fe66c234 of metres.geojson is more than 2,000 km from the centre, at 385423, 6671463
      | source("village.geojson") source("metres.geojson", { crs = 32601 })
      | ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^
      help: all sources of a run share one model; check the coordinates and the coordinate system, or read a part
    "#);
}

#[test]
fn a_feature_without_a_place_is_left_out_unless_the_run_is_strict() {
    let script = "local A = module(\"A\", \"id\")\nlocal s = lsystem()\n\
        s:axiom(source(\"nan.gpkg:buildings\"), function(f)\n  return A(f.id)\nend)\nprint(s:derive(1).chains[1])\n";
    let folder = folder().with("in/s.lua", script);
    let said = folder.burgeon(&["run", "in/s.lua", "--report", "-"]).done();
    let why = "feature 2 of nan.gpkg:buildings has a coordinate that is not a finite number";
    for text in [
        "warning: in/s.lua:3: nan.gpkg:buildings: skipped 1 feature without a geometry\n".to_owned(),
        format!("warning: in/s.lua:3: skipped 1 unusable feature: {why}\n"),
    ] {
        assert!(without_columns(&said.stderr).contains(&text), "{}", said.stderr);
    }
    assert!(said.stderr.ends_with("1 of 2 features skipped\n"), "{}", said.stderr);
    assert!(said.stdout.contains(why), "{}", said.stdout);
    let text = folder.burgeon(&["run", "in/s.lua", "--strict"]).failed();
    assert!(without_columns(&text).contains(&format!("in/s.lua:3: {why}")), "{text}");
}

#[test]
fn features_that_are_not_there_are_told() {
    assert_snapshot!(told(r#"source("none.geojson")"#), @r#"
    error: in/s.lua:2:1: none.geojson has no features
      | source("none.geojson")
      | ^^^^^^^^^^^^^^^^^^^^^^
      help: check the file: burgeon sources FILE
    "#);
    assert_snapshot!(told(r#"source("collection.geojson")"#), @r#"
    error: in/s.lua:2:1: collection.geojson has no features with a geometry
      | source("collection.geojson")
      | ^^^^^^^^^^^^^^^^^^^^^^^^^^^^
      help: check the file: burgeon sources FILE
    "#);
    assert_snapshot!(told(r#"source("town.gpkg:buildings", { where = "height > 99" })"#), @r#"
    error: in/s.lua:2:33: no feature of town.gpkg:buildings matches where height > 99
      | source("town.gpkg:buildings", { where = "height > 99" })
      |                                 ^^^^^
      help: run burgeon sources FILE to list attributes and their values
    "#);
    assert_snapshot!(told(r#"source("town.gpkg:roads", { kind = "polygon" })"#), @r#"
    error: in/s.lua:2:29: town.gpkg:roads has only geometries of kind line, not of kind polygon
      | source("town.gpkg:roads", { kind = "polygon" })
      |                             ^^^^
      help: specify another layer, or remove kind
    "#);
    assert_snapshot!(told(r#"source("town.gpkg:roads", { id = "nam" })"#), @r#"
    error: in/s.lua:2:35: town.gpkg:roads: unknown attribute `nam`
      | source("town.gpkg:roads", { id = "nam" })
      |                                   ^^^
      help: did you mean name?
    "#);
}

#[test]
fn a_condition_that_is_no_sql_or_no_question_is_told() {
    assert_snapshot!(told(r#"source("town.gpkg:buildings", { where = "heigt > 1" })"#), @r#"
    error: in/s.lua:2:42: where "heigt > 1" of town.gpkg:buildings: no such column: heigt
      | source("town.gpkg:buildings", { where = "heigt > 1" })
      |                                          ^^^^^^^^^
      help: write an SQL condition on the layer's columns, such as where = "height > 10"
    "#);
    assert_snapshot!(told(r#"source("town.gpkg:buildings", { where = "height >" })"#), @r#"
    error: in/s.lua:2:42: where "height >" of town.gpkg:buildings: near ")": syntax error
      | source("town.gpkg:buildings", { where = "height >" })
      |                                          ^^^^^^^^
      help: write an SQL condition on the layer's columns, such as where = "height > 10"
    "#);
    assert_snapshot!(told(r#"source("town.gpkg:buildings", { where = "1); DROP TABLE roads; --" })"#), @r#"
    error: in/s.lua:2:42: where "1); DROP TABLE roads; --" of town.gpkg:buildings: not authorized
      | source("town.gpkg:buildings", { where = "1); DROP TABLE roads; --" })
      |                                          ^^^^^^^^^^^^^^^^^^^^^^^^
      help: write an SQL condition on the layer's columns, such as where = "height > 10"
    "#);
    assert_snapshot!(told(r#"source("town.gpkg:buildings", { where = "load_extension('x')" })"#), @r#"
    error: in/s.lua:2:58: where "load_extension('x')" of town.gpkg:buildings: not authorized to use function: load_extension
      | source("town.gpkg:buildings", { where = "load_extension('x')" })
      |                                                          ^
      help: write an SQL condition on the layer's columns, such as where = "height > 10"
    "#);
    assert_snapshot!(told(r#"source("village.geojson", { where = "heigt > 1" })"#), @r#"
    error: in/s.lua:2:38: where "heigt > 1" of village.geojson: no such column: heigt
      | source("village.geojson", { where = "heigt > 1" })
      |                                      ^^^^^^^^^
      help: write an SQL condition on the layer's columns, such as where = "height > 10"
    "#);
}

#[test]
fn options_of_a_source_are_checked() {
    assert_snapshot!(told(r#"source("village.geojson", { limt = 1 })"#), @r#"
    error: in/s.lua:2:1: source has no option called limt
      | source("village.geojson", { limt = 1 })
      | ^^^^^^
      help: did you mean limit?
    "#);
    assert_snapshot!(told(r#"source("village.geojson", { limit = -1 })"#), @r#"
    error: in/s.lua:2:1: source: limit must be an integer of at least 0, not -1
      | source("village.geojson", { limit = -1 })
      | ^^^^^^
      help: write { limit = 100 }
    "#);
    assert_snapshot!(told(r#"source("village.geojson", { kind = "poligon" })"#), @r#"
    error: in/s.lua:2:37: source: there is no kind "poligon" of geometry
      | source("village.geojson", { kind = "poligon" })
      |                                     ^^^^^^^
      help: did you mean polygon?
    "#);
    assert_snapshot!(told(r#"source("village.geojson", 7)"#), @r#"
    error: in/s.lua:2:1: source takes a table of options, not a number
      | source("village.geojson", 7)
      | ^^^^^^
      help: write source("town.gpkg:buildings", { limit = 100 })
    "#);
    assert_snapshot!(told("source({}, { limit = 1 })"), @r"
    error: in/s.lua:2:1: a list of features takes no option but table
      | source({}, { limit = 1 })
      | ^^^^^^^^^^^^^^^^^^^^^^^^^
      help: choose among them in Lua: where, limit and the like are for files
    ");
    assert_snapshot!(told("source(7)"), @r#"
    error: in/s.lua:2:1: source takes the name of a data file or a list of features
      | source(7)
      | ^^^^^^
      help: write source("village.geojson") or source({ { id = "a", ... }, ... })
    "#);
    assert_snapshot!(told(r#"local f = source("village.geojson").feature"#), @r#"
    error: in/s.lua:2:11: a source has no field called feature
      | local f = source("village.geojson").feature
      |           ^^^^^^
      help: did you mean features?
    "#);
    assert_snapshot!(told(r#"source("village.geojson").bounds = 1"#), @r#"
    error: in/s.lua:2:27: bounds of a source cannot be assigned
      | source("village.geojson").bounds = 1
      |                           ^^^^^^
      help: make a list of what you need, and a source of it: source(list)
    "#);
}

#[test]
fn a_rule_reads_no_data() {
    let script = format!(
        "{HEAD}s:rule(\"A(x)\", function(this, x) source(\"village.geojson\") return nil end)\ns:derive(1)\n"
    );
    assert_snapshot!(folder().with("in/s.lua", script).refuses(&["run", "in/s.lua"]), @r#"
    error: in/s.lua:3:34: rule A(x): source can be called only at the top level of the script, not in a rule
      | s:rule("A(x)", function(this, x) source("village.geojson") return nil end)
      |                                  ^^^^^^
      module: A(1), step 1
      help: call it before derive, and use the result in the rule
    "#);
}

#[test]
fn a_mistake_in_the_axioms_function_names_the_feature() {
    let script = format!(
        "{HEAD}s:axiom(source(\"town.gpkg:roads\", {{ id = \"name\" }}), function(f)\n  return A(#f.geometry.rings)\nend)\ns:derive(1)\n"
    );
    assert_snapshot!(folder().with("in/s.lua", script).refuses(&["run", "in/s.lua"]), @r"
    error: in/s.lua:4:12: attempt to get length of a nil value (feature lane)
      | return A(#f.geometry.rings)
      |          ^
    ");
}

#[test]
fn a_folder_that_is_given_is_read_and_one_that_is_not_there_is_told() {
    let script = "print(#source(\"far.geojson\"), #source(\"village.geojson\"))\n";
    assert_eq!(printed(script, &["--data", "data"]), "1\t1\n");
    let folder = folder().with("in/s.lua", script);
    assert_snapshot!(folder.refuses(&["run", "in/s.lua", "--data", "nothing"]), @r#"
    error: folder not found: nothing
      help: --data needs a folder of data files
    "#);
}

#[test]
fn what_was_read_is_frozen_and_known_by_its_names() {
    let script = r#"
local town = source("town.gpkg:buildings")
local mill, inn = town.features[1], town.features[2]
print(#town, town.layer, town.crs, town.origin[1], town.origin[2], town.bounds.max[1])
print(mill.id, mill.height, mill.name, mill.listed, mill.layer, inn.name, inn.listed)
print(mill.geometry.kind, mill.geometry.points[1][1], mill.geometry.points[1][2], mill.geometry.points[1][3])
print(pcall(function() mill.geometry.points[1][1] = 0 end))
for index, feature in town do print(index, feature.id) end
print(#source("town.gpkg:buildings", { where = "height > 10 or name = 'none'" }), #source("town.gpkg:buildings", { limit = 1 }))
print(source("town.gpkg:buildings", { id = "name" }).features[1].id)
"#;
    assert_snapshot!(printed(script, &[]), @r#"
    2	buildings	EPSG:3067	385500	6671500	0
    1	5	mill	true	buildings	nil	false
    point	-77	-37	0
    false	in/s.lua:7: attempt to modify a readonly table
    1	1
    2	2
    1	1
    mill
    "#);
}

#[test]
fn a_condition_that_never_ends_is_stopped() {
    let line = "source(\"town.gpkg:buildings\", { where = \"(WITH RECURSIVE c(n) AS (SELECT 1 UNION ALL SELECT n + 1 FROM c) SELECT count(*) FROM c) > 0\" })";
    let folder = folder().with("in/s.lua", line);
    let begin = std::time::Instant::now();
    let said = folder.burgeon(&["run", "in/s.lua", "--time-limit", "0.5"]).failed();
    assert!(begin.elapsed().as_secs() < 10 && said.contains("--time-limit"), "{said}");
}

#[test]
fn sources_are_listed_for_people_and_machines() {
    let folder = folder();
    assert_snapshot!(folder.burgeon(&["sources", "in/town.gpkg", "in/village.geojson"]).done().stdout, @r#"
    in/town.gpkg: GeoPackage
      buildings: 2 points, 1 without geometry; EPSG:3067
        from 385423, 6671463 to 385500, 6671500
        height  number of 2, 5 to 15
        name    text of 1, such as "mill"
        listed  boolean of 2
      roads: 1 line; EPSG:3067
        from 385423, 6671463 to 385433, 6671463
        name  text of 1, such as "lane"
    in/village.geojson: GeoJSON
      village: 1 polygon; EPSG:4326
        from 6.1, 45.9 to 6.1001, 45.9001
        height  number of 1, 7 to 7
        name    text of 1, such as "mill"
    "#);
    let document = folder.burgeon(&["sources", "in/town.gpkg", "--json"]).done().json();
    let layer = &document["files"][0]["layers"][0];
    assert_eq!(
        (layer["records"].as_u64(), layer["empty"].as_u64(), layer["crs"].as_str()),
        (Some(2), Some(1), Some("EPSG:3067"))
    );
    assert_eq!(layer["attributes"][0]["range"], serde_json::json!([5.0, 15.0]));
    assert_snapshot!(folder.refuses(&["sources", "in/vilage.geojson"]), @r#"
    error: data file not found: in/vilage.geojson
      help: did you mean village.geojson?
    "#);
}
