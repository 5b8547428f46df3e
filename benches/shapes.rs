//! Shapes in rules: a mass that is split into a million boxes, 520 towers with 1.9 million shapes and 3.8 million triangles,
//! 1,000 facades beside those of the wall grammar, and unions of two balls of 9,800 triangles each. `cargo bench --bench shapes`.

#![allow(clippy::print_stdout, reason = "a bench prints its figures")]

use std::process::Command;

/// Number of measurements; the best counts.
const ROUNDS: usize = 3;

const MILLION: &str = r#"
local Mass, Row, Cell = module("Mass", "s"), module("Row", "s"), module("Cell", "s")
local boxes = lsystem({ object = extruder() })
boxes:axiom(Mass(cuboid(1000, 1000, 10)))
boxes:rule("Mass(s)", function(this, s) return split(s, "x", { { "~1*", Row } }) end)
boxes:rule("Row(s)", function(this, s) return split(s, "y", { { "~1*", Cell } }) end)
boxes:derive()
"#;

const TOWERS: &str = r##"
local Tower, Wall, Storey = module("Tower", "s"), module("Wall", "s"), module("Storey", "s")
local towers = lsystem({ object = extruder() })
local axiom = {}
for i = 0, 519 do
  table.insert(axiom, Tower(cuboid(20 + i % 7, 24, 120):translate(vec(40 * (i % 23), 40 * (i // 23), 0))))
end
towers:axiom(sequence(axiom))
towers:rule("Tower(s)", function(this, s) return components(s, "faces", { { "side", Wall }, { "top", Draw } }) end)
towers:rule("Wall(s)", function(this, s) return split(s, "y", { { "~3*", Storey } }) end)
towers:rule("Storey(s)", function(this, s)
  return split(s, "x", { { { "~1", Draw }, { 1.2, Draw, "#445566" }, { "~1", Draw } } })
end)
towers:derive()
"##;

const UNIONS: &str = r#"
local one = ball(1, 100)
local both = one
for _ = 1, 20 do both = one:union(one:translate(vec(0.5, 0.3, 0.2))) end
local balls = lsystem({ object = extruder() })
balls:axiom(Draw(both))
balls:derive()
"#;

/// Facades of 1,000 houses with 130,000 windows by the wall grammar.
const WALLS: &str = r##"
local House = module("House")
local glass = panel({ width = { 1.2, 1.2 }, height = { 1.6, 1.6 }, material = { color = "#445566" } })
local pane = extruded(glass, { depth = -0.18 })
local bay = bordered(pane, { left = 0.6, right = 0.6, bottom = 0.8, top = 0.6 })
local style = facade({ template({ wall = grid(bay) }) })
local lots = {}
for i = 0, 999 do
  local x, y = 30 * (i % 32), 30 * (i // 32)
  table.insert(lots, footprint({ { x, y }, { x + 20, y }, { x + 20, y + 12 }, { x, y + 12 } }))
end
for _, lot in lots do
  local s = lsystem({ object = lot })
  s:axiom(House())
  s:interpret("House", function(this)
    this:walls({ height = 15, templates = style })
  end)
  s:derive(0)
end
"##;

/// The same facades by shapes.
const FACADES: &str = r##"
local House, Wall, Storey = module("House", "s"), module("Wall", "s"), module("Storey", "s")
local Tile, Row, Window = module("Tile", "s"), module("Row", "s"), module("Window", "s")
local town = lsystem({ object = extruder() })
local axiom = {}
for i = 0, 999 do
  table.insert(axiom, House(cuboid(20, 12, 15):translate(vec(30 * (i % 32), 30 * (i // 32), 0))))
end
town:axiom(sequence(axiom))
town:rule("House(s)", function(this, s) return components(s, "faces", { { "side", Wall } }) end)
town:rule("Wall(s)", function(this, s) return split(s, "y", { { "~3*", Storey } }) end)
town:rule("Storey(s)", function(this, s) return split(s, "x", { { "~2.4*", Tile } }) end)
town:rule("Tile(s)", function(this, s)
  return split(s, "y", { { 0.8, Draw }, { 1.6, Row }, { "~0.6", Draw } })
end)
town:rule("Row(s)", function(this, s)
  return split(s, "x", { { "~0.6", Draw }, { 1.2, Window }, { "~0.6", Draw } })
end)
town:rule("Window(s)", function(this, s)
  local glass, reveal = { "tag:recess.back", Draw, "#445566" }, { "tag:recess.side", Draw }
  return components(s:recess(0.18), "faces", { glass, reveal })
end)
town:derive()
"##;

fn main() {
    let folder = tempfile::tempdir().expect("a folder");
    for (name, script, asked) in [
        ("a million boxes", MILLION, "1 s of CPU"),
        ("520 towers", TOWERS, "1.5 s on 2 cores"),
        ("1,000 facades of walls", WALLS, "nothing"),
        ("1,000 facades of shapes", FACADES, "1.5 times those of walls"),
        ("20 unions", UNIONS, "3 times manifold3d"),
    ] {
        let path = folder.path().join("shapes.lua");
        std::fs::write(&path, script).expect("a file");
        for threads in ["1", "2"] {
            let mut best: Option<serde_json::Value> = None;
            for _ in 0..ROUNDS {
                let mut command = Command::new(env!("CARGO_BIN_EXE_burgeon"));
                command.args(["run", "--json", "--threads", threads, "--triangle-limit", "20000000"]);
                command.args(["--memory-limit", "8000", "--module-limit", "10000000"]).arg(&path);
                let done = command.output().expect("the program starts");
                assert!(done.status.success(), "{}", String::from_utf8_lossy(&done.stderr));
                let summary: serde_json::Value = serde_json::from_slice(&done.stdout).expect("a summary");
                let seconds = |summary: &serde_json::Value| summary["seconds"]["total"].as_f64();
                if best.as_ref().is_none_or(|best| seconds(&summary) < seconds(best)) {
                    best = Some(summary);
                }
            }
            let best = best.unwrap_or_default();
            println!(
                "{name}, {threads} threads: {} modules, {} triangles in {:.2} s; asked {asked}",
                best["modules"],
                best["triangles"],
                best["seconds"]["total"].as_f64().unwrap_or_default()
            );
        }
    }
}
