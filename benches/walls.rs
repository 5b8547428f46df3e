//! Exposed walls of 15,608 buildings: `scripts/geospatial/facades.lua` on the data file of a region, without its
//! drawings. `cargo bench --bench walls`. Needs `../shared/data`.

#![allow(clippy::print_stdout, reason = "a bench prints its figures")]

use std::path::Path;
use std::process::Command;
use std::time::Instant;

/// Number of measurements; the best counts.
const ROUNDS: usize = 5;

/// Maximum time (s), including the start of the program.
const MOST: f64 = 3.0;

const LAYERS: &str = r#"
source("france_buildings.gpkg:buildings")
return {
  buildings = "select ST_GeometryN(geom, 1) as geom, fid as id, 2 as floors, 1 as style from buildings",
  neighbors = "select fid from buildings where fid <> $id and ST_Intersects(geom, $geom)",
}
"#;

/// Places a small model for every exposed wall, so that the walls can be counted.
const DETAILS: &str = r#"
local Post = module("Post")
local post = lsystem({ object = extruder({ sides = 3 }) })
post:axiom(Post())
post:interpret("Post", function(this) this:extrude(1) end)
local model = post:derive(0)
return {
  volume = function() end,
  facade = function(this, line) this:jump(line:start_point():place()):place(model) end,
}
"#;

fn main() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let data = root.join("../shared/data");
    if !data.join("france_buildings.gpkg").is_file() {
        println!("skipped: there is no {}", data.display());
        return;
    }
    let folder = tempfile::tempdir().expect("a folder");
    let place = |name: &str| folder.path().join(name);
    let script = place("facades.lua");
    std::fs::copy(root.join("scripts/geospatial/facades.lua"), &script).expect("the script");
    std::fs::write(place("layers.lua"), LAYERS).expect("a file");
    std::fs::write(place("details.lua"), DETAILS).expect("a file");
    let mut best = f64::INFINITY;
    let mut walls = 0;
    for _ in 0..ROUNDS {
        let mut command = Command::new(env!("CARGO_BIN_EXE_burgeon"));
        command
            .arg("run")
            .arg(&script)
            .arg("--data")
            .arg(&data)
            .arg("--json")
            .arg("-o")
            .arg(place("walls.glb"));
        let begin = Instant::now();
        let done = command.output().expect("the program starts");
        best = best.min(begin.elapsed().as_secs_f64());
        assert!(done.status.success(), "{}", String::from_utf8_lossy(&done.stderr));
        let summary: serde_json::Value = serde_json::from_slice(&done.stdout).expect("a summary");
        walls = summary["instances"].as_u64().unwrap_or_default();
    }
    let verdict = if best <= MOST { "met" } else { "missed" };
    println!(
        "{walls} walls without neighbours: {best:.2} s of at most {MOST:.0}, the best of {ROUNDS}: {verdict}"
    );
}
