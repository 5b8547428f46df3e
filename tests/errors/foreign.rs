//! Untrusted data: a faulty feature never ends a run, no file exceeds the time or memory limit of its reader,
//! and no content of a file reaches the terminal unescaped.

use std::process::Command;
use std::time::{Duration, Instant};

use rusqlite::Connection;
use serde_json::{Value, json};

use crate::support::{Folder, without_columns};

/// Returns a square of 8 m, number `number` in a row.
fn square(number: usize) -> Value {
    let (x, y) = (6.1 + 2e-4 * number as f64, 45.9);
    json!({ "type": "Polygon", "coordinates": [[[x, y], [x + 1e-4, y], [x + 1e-4, y + 1e-4], [x, y + 1e-4], [x, y]]] })
}

fn feature(id: &Value, geometry: &Value, properties: Value) -> Value {
    let mut all = json!({ "height": 5, "levels": 2, "colour": "lightblue" });
    if let (Some(all), Value::Object(given)) = (all.as_object_mut(), properties) {
        all.extend(given);
    }
    json!({ "type": "Feature", "id": id, "geometry": geometry, "properties": all })
}

const CITY: &str = r#"
local Building = module("Building", "height", "levels", "colour")
local Walls = module("Walls", "height", "colour")
local Roof = module("Roof", "kind")
local s = lsystem({ object = footprint })
s:axiom(source("town.geojson"), function(f)
  local ring = f.geometry
  if f.lua == "nan" then
    ring = { { 0, 0 }, { 9, 0 }, { 9, 0 / 0 }, { 0, 9 } }
  elseif f.lua == "text" then
    ring = { { 0, 0 }, { 9, 0 }, { "9", 9 }, { 0, 9 } }
  elseif f.lua == "empty" then
    ring = { {} }
  end
  return footprint(ring, { color = f.colour }), Building(f.height, f.levels, f.colour)
end)
s:rule("Building(h, n, c)", {
  when = function(this, h, n, c)
    return n > 0 and h ~= nil
  end,
}, function(this, h, n, c)
  return Walls(h * n / 2, c), Roof(n == 7 and "oniun" or "flat")
end)
s:interpret("Walls(h, c)", function(this, h, c)
  this:walls({ height = h + 1, color = c })
end)
s:interpret("Roof(kind)", function(this, kind)
  this:roof({ kind = kind })
end)
s:derive()
"#;

/// Returns faulty features, each with a part of the expected message.
fn bad() -> Vec<(Value, &'static str)> {
    let with = |properties: Value| feature(&Value::Null, &square(3), properties);
    let at = |geometry: Value| feature(&Value::Null, &geometry, json!({}));
    let ring = |ring: Value| at(json!({ "type": "Polygon", "coordinates": [ring] }));
    vec![
        (ring(json!([[30, -10], [30.1, -10], [30.1, -10.1]])), "more than 2,000 km from the centre"),
        (ring(json!([[6.1, 95], [6.2, 95], [6.2, 96]])), "not a valid longitude and latitude"),
        (ring(json!([[6.1, "a"], [6.2, 45.9], [6.2, 46]])), "has text instead of"),
        (
            ring(json!([[6.1, 45.9], [6.1001, 45.9], [6.1002, 45.9], [6.1, 45.9]])),
            "nowhere wider than 0.002 m",
        ),
        (at(json!({ "type": "Point", "coordinates": [6.1, 45.9] })), "geometry of kind"),
        (at(json!({ "type": "LineString", "coordinates": [[6.1, 45.9], [6.1, 46]] })), "geometry of kind"),
        (with(json!({ "height": "tall" })), "attempt to perform arithmetic"),
        (with(json!({ "height": [1, 2] })), "attempt to perform arithmetic"),
        (with(json!({ "height": 1e300 })), "footprint:walls: height is"),
        (with(json!({ "height": -40 })), "footprint:walls: height is"),
        (with(json!({ "height": null })), "height is missing"),
        (with(json!({ "levels": "many" })), "attempt to compare"),
        (with(json!({ "levels": { "a": 1 } })), "attempt to compare"),
        (with(json!({ "levels": 7 })), "unknown kind \"oniun\""),
        (with(json!({ "colour": "no such" })), "color must be a colour"),
        (with(json!({ "colour": "lightblu" })), "such as \"lightblue\""),
        (with(json!({ "colour": 7 })), "color must be a colour"),
        (with(json!({ "colour": ["a"] })), "color must be a colour"),
        (with(json!({ "lua": "nan" })), "vector of finite numbers, not {9,nan}"),
        (with(json!({ "lua": "text" })), "geometry must be a list"),
        (with(json!({ "lua": "empty" })), "0 distinct points"),
    ]
}

#[test]
fn one_bad_feature_never_stops_a_city() {
    let bad = bad();
    let good = 10;
    let town = |which: &[&Value]| {
        let mut features: Vec<Value> =
            (0..good).map(|at| feature(&json!(at), &square(at), json!({}))).collect();
        which.iter().enumerate().for_each(|(at, bad)| features.insert(3 * at % good, (*bad).clone()));
        json!({ "type": "FeatureCollection", "features": features }).to_string()
    };
    let run = |which: &[&Value], flags: &[&str]| {
        let folder = Folder::new().with("s.lua", CITY).with("town.geojson", town(which));
        let said = folder.burgeon(&[&["run", "s.lua", "-o", "a.glb", "--report", "r.json"], flags].concat());
        let report = std::fs::read_to_string(folder.path().join("r.json")).unwrap_or_default();
        (said, report)
    };
    let triangles = |text: &str| text.lines().find(|line| line.contains("triangles")).map(str::to_owned);
    let (alone, _) = run(&[], &[]);
    let alone = alone.done();
    assert!(!alone.stderr.contains("warning"), "{}", alone.stderr);
    let all: Vec<&Value> = bad.iter().map(|(feature, _)| feature).collect();
    for threads in ["1", "2"] {
        let (said, report) = run(&all, &["--threads", threads]);
        let said = said.done();
        let report: Value = serde_json::from_str(&report).unwrap();
        let whys: Vec<&str> =
            report["remarks"].as_array().unwrap().iter().filter_map(|it| it["why"].as_str()).collect();
        for (feature, why) in &bad {
            assert!(whys.iter().any(|it| it.contains(why)), "{why}: {feature}\n{whys:#?}");
        }
        assert_eq!(report["skipped"], bad.len(), "{whys:#?}");
        let count =
            |text: &str| triangles(text).map(|line| line.split(" triangles").next().unwrap().to_owned());
        assert_eq!(count(&said.stderr), count(&alone.stderr));
        assert!(said.stderr.contains("warning: s.lua:"), "{}", said.stderr);
    }
    // Each feature alone causes a report with the reason, and an error in a strict run.
    for (feature, why) in bad.iter().step_by(3) {
        let (said, _) = run(&[feature], &[]);
        let said = said.done();
        assert!(said.stderr.contains("skipped") && said.stderr.contains(why), "{why}: {}", said.stderr);
        let (said, _) = run(&[feature], &["--strict"]);
        assert!(said.failed().contains(why), "{why}");
    }
}

#[test]
fn a_mistake_of_the_script_is_an_error_for_any_number_of_features() {
    let features: Vec<Value> = (0..4).map(|at| feature(&json!(at), &square(at), json!({}))).collect();
    let town = json!({ "type": "FeatureCollection", "features": features }).to_string();
    let told = |from: &str, to: &str| {
        let script = CITY.replace(from, to);
        assert_ne!(script, CITY);
        Folder::new().with("s.lua", script).with("town.geojson", &town).burgeon(&["run", "s.lua"]).failed()
    };
    assert!(told("color = f.colour }", "colr = f.colour }").contains("unknown field `colr`"));
    assert!(
        told("this:walls({ height = h + 1", "this:walls({ hight = h + 1").contains("unknown field `hight`")
    );
    assert!(told("h * n / 2", "h * m.x / 2").contains("m"));
    assert!(told("h * n / 2", "nil * n").contains("attempt to perform arithmetic"));
    assert!(told("local ring = f.geometry", "local ring = f.geometry error(\"wrong\")").contains("wrong"));
}

#[test]
fn pipes_and_devices_are_refused_before_anything_is_read() {
    let scripts = [
        (
            "texture.lua",
            "local A = module(\"A\")\nlocal s = lsystem({ object = turtle() })\ns:axiom(A())\n\
             s:interpret(\"A\", function(this) this:material({ texture = \"pipe\" }):forward(1) end)\ns:derive()\n",
        ),
        ("require.lua", "require(\"pipe\")\n"),
        ("source.lua", "source(\"pipe\")\n"),
        ("model.lua", "model(\"pipe\")\n"),
        ("elevation.lua", "elevation(\"pipe\")\n"),
        ("edits.lua", "edits(\"pipe\")\n"),
        ("zero.lua", "source(\"zero\")\n"),
        ("preset.lua", "print(1)\n"),
    ];
    let mut folder = Folder::new();
    for (name, script) in scripts {
        folder = folder.with(name, script);
    }
    for name in ["pipe", "pipe.lua", "preset.presets.json"] {
        assert!(Command::new("mkfifo").arg(folder.path().join(name)).status().unwrap().success());
    }
    std::os::unix::fs::symlink("/dev/zero", folder.path().join("zero")).unwrap();
    let begin = Instant::now();
    for (name, _) in scripts {
        let preset: &[&str] = if name == "preset.lua" { &["--preset", "a"] } else { &[] };
        for output in ["a.glb", "a.png"] {
            let text = folder.burgeon(&[&["run", name, "-o", output], preset].concat()).failed();
            let told = ["pipe or a device", "is not a file", "outside the script"]
                .iter()
                .any(|it| text.contains(it));
            assert!(told, "{name}: {text}");
        }
    }
    for arguments in
        [["run", "pipe.lua"], ["check", "pipe.lua"], ["sources", "pipe"], ["sources", "/dev/zero"]]
    {
        let text = folder.burgeon(&arguments).failed();
        assert!(text.contains("pipe or a device"), "{arguments:?}: {text}");
    }
    assert!(begin.elapsed() < Duration::from_secs(60), "{:?}", begin.elapsed());
}

/// Returns a GeoPackage of one layer with `count` points.
fn package(count: usize) -> Vec<u8> {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.gpkg");
    let mut connection = Connection::open(&path).unwrap();
    connection
        .execute_batch(
            "CREATE TABLE gpkg_contents(table_name TEXT PRIMARY KEY, data_type TEXT);
             CREATE TABLE gpkg_geometry_columns(table_name TEXT, column_name TEXT, srs_id INT);
             CREATE TABLE gpkg_spatial_ref_sys(srs_name TEXT, srs_id INT, organization TEXT, organization_coordsys_id INT);
             INSERT INTO gpkg_spatial_ref_sys VALUES ('a', 3067, 'EPSG', 3067);
             INSERT INTO gpkg_contents VALUES ('a', 'features');
             INSERT INTO gpkg_geometry_columns VALUES ('a', 'geom', 3067);
             CREATE TABLE a(fid INTEGER PRIMARY KEY, geom BLOB, id TEXT, height REAL);",
        )
        .unwrap();
    let transaction = connection.transaction().unwrap();
    for number in 0..count {
        let mut blob = b"GP\0\x01\0\0\0\0\x01\x01\0\0\0".to_vec();
        blob.extend(
            [385_423.0 + number as f64, 6_671_463.0].iter().flat_map(|value: &f64| value.to_le_bytes()),
        );
        transaction
            .execute("INSERT INTO a(geom, id, height) VALUES (?1, 'same', ?2)", (blob, number as f64))
            .unwrap();
    }
    transaction.commit().unwrap();
    connection.close().unwrap();
    std::fs::read(path).unwrap()
}

#[test]
fn a_query_of_a_box_of_a_geopackage_reads_the_box_only() {
    let script = "local some = source(\"a.gpkg\", { within = { 385430, 6671460, 385439.5, 6671470 } })
        local count = query(\"select count(*) as n from a\")[1].n
        assert(#some == 10 and count == 10, `{#some} features, {count} rows`)";
    let folder = Folder::new().with("a.gpkg", package(100)).with("s.lua", script);
    folder.burgeon(&["run", "s.lua"]).done();
    let whole = script.replace("{ within = { 385430, 6671460, 385439.5, 6671470 } }", "{}");
    let folder = folder.with("s.lua", whole.replace("== 10", "== 100"));
    folder.burgeon(&["run", "s.lua"]).done();
}

#[test]
fn a_condition_ends_with_its_time_and_takes_no_more_memory_than_it_may() {
    let folder = Folder::new().with("a.gpkg", package(2000));
    let endless = "WITH RECURSIVE c(x) AS (SELECT 1 UNION ALL SELECT x + 1 FROM c";
    for (condition, why) in [
        (format!("height > ({endless}) SELECT count(*) FROM c)"), "time limit of 2 s"),
        // One function call, and one sort.
        (
            "instr(hex(zeroblob(40000000)), hex(zeroblob(20000000)) || 'x') > 0".to_owned(),
            "time limit of 2 s",
        ),
        (
            format!("height > ({endless} LIMIT 100000000) SELECT x FROM c ORDER BY x % 97, -x)"),
            "time limit of 2 s",
        ),
        (
            "height > (SELECT count(*) FROM a b, a c, a d WHERE b.height + c.height < d.height)".to_owned(),
            "time limit of 2 s",
        ),
        ("length(zeroblob(900000000)) > 0".to_owned(), "too big"),
        ("length(randomblob(1000000000)) > 0".to_owned(), "too big"),
        ("1) UNION SELECT 1 FROM pragma_database_list WHERE (1".to_owned(), ""),
        ("(SELECT count(*) FROM sqlite_master) > 0) ; ATTACH 'b' AS b --".to_owned(), ""),
        ("writefile('b', 'x')".to_owned(), "no such function"),
    ] {
        let script = format!("print(#source(\"a.gpkg\", {{ where = [==[{condition}]==] }}))\n");
        let path = folder.path().join("s.lua");
        std::fs::write(path, script).unwrap();
        let begin = Instant::now();
        let text = folder.burgeon(&["run", "s.lua", "--time-limit", "2", "--memory-limit", "200"]).failed();
        assert!(begin.elapsed() < Duration::from_secs(12), "{condition}: {:?}", begin.elapsed());
        let told = text.contains(why) || text.contains("out of memory") || text.contains("memory limit");
        assert!(told, "{condition}: {text}");
    }
    assert!(!folder.path().join("b").exists());
}

#[test]
fn sources_has_limits_and_lists_equal_ids_and_what_is_wrong_quickly() {
    let folder = Folder::new().with("a.gpkg", package(60_000));
    let begin = Instant::now();
    let said = folder.burgeon(&["sources", "a.gpkg"]).done();
    assert!(said.stdout.contains("a: 60000 points; EPSG:3067"), "{}", said.stdout);
    assert!(begin.elapsed() < Duration::from_secs(20), "{:?}", begin.elapsed());
    let text = folder.burgeon(&["sources", "a.gpkg", "--time-limit", "0.001"]).failed();
    assert!(
        text.contains("reading exceeded the time limit of 0.001 s") && text.contains("--time-limit"),
        "{text}"
    );
    let folder = folder.with("many.gpkg", package(200_000));
    let text = folder.burgeon(&["sources", "many.gpkg", "--memory-limit", "16"]).failed();
    assert!(text.contains("memory limit of 16 MB") && text.contains("--memory-limit"), "{text}");
}

#[test]
fn what_a_terminal_would_obey_is_written_out_everywhere() {
    let odd = "a\u{1b}[2J\u{9b}31m\r\u{7}\u{202e}b\nerror: c";
    let mut bad = feature(&json!(odd), &square(1), json!({ "height": "tall", odd: odd }));
    bad["geometry"]["coordinates"][0][1][0] = json!(odd);
    let features = [feature(&json!(odd), &square(0), json!({ odd: "x" })), bad.clone()];
    let town = json!({ "type": "FeatureCollection", "name": odd, "features": features }).to_string();
    let one = json!({ "type": "FeatureCollection", "name": odd, "features": [bad] }).to_string();
    let folder = Folder::new().with("s.lua", CITY).with("town.geojson", town).with("one.geojson", one);
    let clean = |text: &str| {
        let wrong = |letter: char| (letter.is_control() && letter != '\n') || letter == '\u{202e}';
        assert!(!text.contains(wrong) && !text.contains("\nerror: c"), "{text:?}");
    };
    let said = folder.burgeon(&["sources", "town.geojson"]).done();
    clean(&said.stdout);
    assert!(said.stdout.contains("\\u{1b}[2J"), "{}", said.stdout);
    let said = folder.burgeon(&["run", "s.lua"]).done();
    clean(&said.stderr);
    assert!(said.stderr.contains("skipped"), "{}", said.stderr);
    clean(&folder.burgeon(&["run", "s.lua", "--strict"]).failed());
    let script = format!("source(\"one.geojson\", {{ id = {:?} }})", "x\u{1b}[1m").replace("\\u{1b}", "\\27");
    std::fs::write(folder.path().join("t.lua"), script).unwrap();
    clean(&folder.burgeon(&["run", "t.lua"]).failed());
}

#[test]
fn a_grid_with_surplus_numbers_is_read_with_a_warning() {
    let grid = "ncols 2\nnrows 2\nxllcorner 0\nyllcorner 0\ncellsize 10\n1 2\n3 4\n5 6\n";
    let script = "local e = elevation(\"a.asc\", { bounds = { 0, 0, 20, 20 } })\nprint(e:height({ 5, 5 }))\n";
    let folder = Folder::new().with("a.asc", grid).with("s.lua", script);
    let said = folder.burgeon(&["run", "s.lua"]).done();
    let warning = "warning: s.lua:1: a.asc has 2 numbers more than the 2 x 2 heights of its header";
    assert!(
        said.stderr.starts_with("3\n") && without_columns(&said.stderr).contains(warning),
        "{}",
        said.stderr
    );
    assert!(folder.burgeon(&["run", "s.lua", "--strict"]).failed().contains("2 numbers more"));
}
