//! Faulty features are skipped and reported, and everything else is built.

use serde_json::Value;

use crate::support::{Folder, without_columns};

/// Returns a town of `count` houses; every tenth cannot be built because of its plan, its kind or its height.
fn town(count: usize) -> Folder {
    let features: Vec<String> = (0..count)
        .map(|index| {
            let (x, y) = (index % 20 * 30, index / 20 * 30);
            let (height, ring) = match index % 40 {
                // A degenerate ring: a line to and fro.
                10 => (6, vec![[0, 0], [8, 0], [4, 0]]),
                20 => (0, vec![[0, 0], [8, 0], [8, 8], [0, 8]]),
                30 => (-3, vec![[0, 0], [8, 0], [8, 8], [0, 8]]),
                _ => (6, vec![[0, 0], [8, 0], [8, 8], [0, 8]]),
            };
            let mut points: Vec<String> =
                ring.iter().map(|[a, b]| format!("[{}, {}]", a + x, b + y)).collect();
            points.push(points[0].clone());
            format!(
                r#"{{"type":"Feature","id":"b{index}","properties":{{"height":{height}}},
                "geometry":{{"type":"Polygon","coordinates":[[{}]]}}}}"#,
                points.join(",")
            )
        })
        .collect();
    let crs = r#""crs":{"type":"name","properties":{"name":"EPSG:3067"}}"#;
    let file = format!(r#"{{"type":"FeatureCollection",{crs},"features":[{}]}}"#, features.join(","));
    let script = r#"local House = module("House", "height")
local town = lsystem({ object = footprint })
town:axiom(source("town.geojson"), function(feature)
  return footprint(feature.geometry), House(feature.height)
end)
town:interpret("House(height)", function(this, height)
  this:groundwork("z_min"):walls({ height = height }):roof({ kind = "flat" })
end)
town:derive()
"#;
    Folder::new().with("town.geojson", file).with("s.lua", script)
}

fn json(text: &str) -> Value {
    serde_json::from_str(text).unwrap()
}

#[test]
fn bad_features_are_left_out_and_listed() {
    let folder = town(120);
    let said = folder.burgeon(&["run", "s.lua", "-o", "a.glb", "--report", "report.json"]).done();
    let last = said.stderr.lines().last().unwrap_or_default().to_owned();
    assert_eq!(last, "9 of 120 features skipped: report.json lists them");
    let report = json(&folder.read("report.json"));
    assert_eq!(
        (&report["features"], &report["skipped"], &report["counts"]["skipped"]),
        (&120.into(), &9.into(), &9.into())
    );
    let listed: Vec<String> = report["remarks"]
        .as_array()
        .unwrap()
        .iter()
        .map(|remark| {
            format!("{} {} {} {}", remark["source"], remark["feature"], remark["done"], remark["why"])
        })
        .collect();
    insta::assert_snapshot!(listed[..4].join("\n"), @r#"
    "town.geojson" "b10" "skipped" "the outer ring of the footprint has no area: its points lie on one line"
    "town.geojson" "b50" "skipped" "the outer ring of the footprint has no area: its points lie on one line"
    "town.geojson" "b90" "skipped" "the outer ring of the footprint has no area: its points lie on one line"
    "town.geojson" "b20" "skipped" "footprint:walls: height is 0 m"
    "#);
    assert_eq!(listed.len(), 9);
}

#[test]
fn rings_that_cross_or_touch_are_repaired_and_listed() {
    let script = r#"local A = module("A")
local s = lsystem({ object = footprint })
s:axiom(source({
  { id = "hourglass", rings = { { 0, 0 }, { 8, 8 }, { 8, 0 }, { 0, 8 } } },
  { id = "hole", rings = { { { 0, 0 }, { 8, 0 }, { 0, 8 } }, { { 9, 9 }, { 10, 9 }, { 9, 10 } } } },
  { id = "sound", rings = { { 0, 0 }, { 4, 0 }, { 8, 0 }, { 0, 8 } } },
}), function(f)
  return footprint(f.rings, { height = 3 }), A()
end)
s:interpret("A", function(this) this:walls():roof({ kind = "flat" }) end)
s:derive()
"#;
    let said = Folder::new().with("s.lua", script).burgeon(&["run", "s.lua", "--report", "-"]).done();
    insta::assert_snapshot!(said.stdout, @r#"
    {"features":3,"skipped":0,"simplified":2,"counts":{"a hole outside the outer ring removed":1,"loops of the outer ring removed":1},"remarks":[
    {"source":"","feature":"hourglass","done":"simplified","what":"loops of the outer ring removed","why":"edges 1-2 and 3-4 of the outer ring of the footprint meet at (4.000, 4.000)"},
    {"source":"","feature":"hole","done":"simplified","what":"a hole outside the outer ring removed","why":"hole 1 of the footprint is outside the outer ring: it begins at (9.000, 9.000)"}
    ]}
    "#);
    assert!(said.stderr.ends_with("2 of 3 features simplified\n"), "{}", said.stderr);
}

#[test]
fn what_is_left_out_does_not_depend_on_threads_or_batches() {
    let folder = town(400);
    let run = |threads: &str, batch: &str| {
        let out = format!("{threads}-{batch}.glb");
        let arguments =
            ["run", "s.lua", "-o", &out, "--report", "r.json", "--threads", threads, "--batch", batch];
        folder.burgeon(&arguments).done();
        (std::fs::read(folder.path().join(&out)).unwrap(), folder.read("r.json"))
    };
    let one = run("1", "4096");
    assert!(run("2", "7") == one && run("3", "100") == one);
}

#[test]
fn a_strict_run_ends_at_the_first_bad_feature() {
    let folder = town(120);
    let text = folder.refuses(&["run", "s.lua", "-o", "a.glb", "--strict"]);
    assert!(text.contains("(feature b10)"), "{text}");
    let counts = folder.burgeon(&["run", "s.lua", "--json"]).done().json()["features"].clone();
    assert_eq!(counts["skipped"], 9);
}

#[test]
fn where_nothing_is_left_the_error_is_told() {
    let bad = "local A = module(\"A\")\nlocal s = lsystem({ object = footprint })\n\
        s:axiom(source({ {}, {} }), function(f)\n  return footprint({ { 0, 0 }, { 1, 0 } }), A()\nend)\ns:derive()\n";
    let text = Folder::new().with("s.lua", bad).refuses(&["run", "s.lua"]);
    assert!(
        without_columns(&text).contains("s.lua:4: the outer ring of the footprint has 2 distinct points"),
        "{text}"
    );
    // Errors of the script are reported regardless of the data.
    let wrong = bad.replace("{ {}, {} }", "{ { ring = { { 0, 0 }, { 8, 0 }, { 8, 8 } } }, {} }");
    let wrong = wrong.replace("{ { 0, 0 }, { 1, 0 } }", "f.ring.points.none");
    let text = Folder::new().with("s.lua", wrong).refuses(&["run", "s.lua"]);
    assert!(text.contains("attempt to index nil"), "{text}");
}

#[test]
fn a_report_that_cannot_be_written_is_refused_before_the_run() {
    let folder = town(20);
    let said = folder.refuses(&["run", "s.lua", "--report", "s.lua"]);
    assert!(said.contains("the report would overwrite the script"), "{said}");
    let said = folder.refuses(&["run", "s.lua", "--report", "none/report.json"]);
    assert!(said.contains("folder not found: none"), "{said}");
}
