//! Streets: 200 seeds of each pattern, checked and compared with real cities, and 100,000 segments grown by a script.
//! `cargo bench --bench streets [-- SEEDS]`; `-- towns` only compares the statistics of unplanned towns with real ones.

#![allow(clippy::print_stdout, reason = "a bench prints its figures")]

use std::time::Instant;

#[path = "../tests/streets/check.rs"]
mod check;
#[path = "../tests/streets/looks.rs"]
mod looks;

use burgeon::script::RunOptions;
use check::{PATTERNS, check, grown};
use looks::{EACH, MEANS, NAMES, faults, looks, real};

/// Statistics for comparison with a pattern: a city's name and its values.
const CITIES: [(&str, [f64; 9]); 4] = [
    ("Vancouver", [3.22, 0.08, 0.56, 0.36, 1.03, 0.30, f64::NAN, f64::NAN, f64::NAN]),
    ("London", [2.56, 0.25, 0.67, 0.07, 1.06, 0.14, f64::NAN, f64::NAN, f64::NAN]),
    ("Helsinki", [3.23, 0.08, 0.53, 0.39, 1.09, 0.22, 0.42, 7000.0, 0.64]),
    ("Monaco", [2.80, 0.14, 0.78, 0.08, 1.21, 0.21, 0.06, 1660.0, 0.70]),
];

/// Town of 100,000 segments.
const LARGE: &str = r#"
local Tip = module("Tip", "junction", "heading", "depth")
local roads = lsystem({ object = network({ markings = false }) })
roads:axiom(Tip(1, 0, 0), Tip(1, 90, 0), Tip(1, 180, 0), Tip(1, 270, 0))
roads:rule("Tip(junction, heading, depth)", function(this, junction, heading, depth)
  local at = this:open_end(junction, heading)
  if not at or this:size() > 100000 then
    return nil
  elseif random() < 0.5 then
    return Tip(at, heading + random(-8, 8), depth)
  end
  return Tip(at, heading + random(-8, 8), depth), Tip(at, heading + 90, 1), Tip(at, heading - 90, 1)
end)
roads:interpret("Tip(junction, heading, depth)", function(this, junction, heading, depth)
  this:grow(junction, heading, 80, depth)
end)
roads:derive(400)
"#;

/// Prints all statistics of unplanned towns next to those of real ones.
fn look_at_towns(seeds: u64) {
    let row = |name: &str, of: &[f64; 16]| {
        let values = of.iter().map(|value| match value {
            value if value.abs() >= 100.0 => format!("{value:10.0}"),
            value => format!("{value:10.3}"),
        });
        println!("{name:12}{}", values.collect::<String>());
    };
    println!("{:12}{}", "", NAMES.iter().map(|name| format!("{name:>10}")).collect::<String>());
    for file in ["helsinki.gpkg", "monaco.gpkg"] {
        if let Some(network) = real(file) {
            row(file.trim_end_matches(".gpkg"), &looks(&network));
        }
    }
    let begin = Instant::now();
    let all: Vec<[f64; 16]> = (1..=seeds)
        .map(|seed| looks(grown("roads.lua", seed, &[("pattern", "organic"), ("extent", "1000")]).network()))
        .collect();
    let of = |index: usize| all.iter().map(move |of| of[index]);
    let means = std::array::from_fn(|index| of(index).sum::<f64>() / seeds.max(1) as f64);
    row("organic", &means);
    row("the least", &std::array::from_fn(|index| of(index).fold(f64::INFINITY, f64::min)));
    row("the greatest", &std::array::from_fn(|index| of(index).fold(0.0, f64::max)));
    println!("means out of bounds: {:?}", faults(&means, &MEANS));
    for (seed, of) in (1..).zip(&all) {
        let wrong = faults(of, &EACH);
        if !wrong.is_empty() {
            println!("seed {seed}: {}", wrong.join("; "));
        }
    }
    println!("{seeds} seeds in {:.1} s", begin.elapsed().as_secs_f64());
}

fn main() {
    let seeds = std::env::args().skip(1).find_map(|word| word.parse().ok()).unwrap_or(200);
    if std::env::args().any(|word| word == "towns") {
        return look_at_towns(seeds.min(100));
    }
    println!("{:12} degree  ends  3-way  4-way  circ.  mesh.  order  block (m²)  spread  pieces", "");
    let row = |name: &str, of: [f64; 9], pieces: f64| {
        let [degree, ends, three, four, circuity, meshedness, order, block, spread] = of;
        println!(
            "{name:12} {degree:6.2} {ends:5.2} {three:6.2} {four:6.2} {circuity:6.2} {meshedness:6.2} {order:6.2} {block:11.0} {spread:7.2} {pieces:7.0}"
        );
    };
    for (name, of) in CITIES {
        row(name, of, f64::NAN);
    }
    for (pattern, radius) in PATTERNS {
        let begin = Instant::now();
        let (mut sums, mut pieces) = ([0.0; 9], 0.0);
        for seed in 1..=seeds {
            let grown = grown("roads.lua", seed, &[("pattern", pattern), ("extent", "1000")]);
            check(&grown, radius, &format!("{pattern}, seed {seed}"));
            let of = grown.network().measures();
            let [ends, three, four] = of.shares;
            let [degree, circuity, order] = [of.degree, of.circuity, of.orientation_order];
            let all = [degree, ends, three, four, circuity, of.meshedness, order, of.block, of.block_spread];
            sums = std::array::from_fn(|index| sums[index] + all[index]);
            pieces += grown.size() as f64;
        }
        row(pattern, sums.map(|sum| sum / seeds as f64), pieces / seeds as f64);
        println!("{:12} {seeds} seeds kept all in {:.1} s", "", begin.elapsed().as_secs_f64());
    }
    look_at_towns(seeds.min(100));
    let path = std::env::temp_dir().join(format!("burgeon bench streets {}.lua", std::process::id()));
    std::fs::write(&path, LARGE).expect("the temporary folder can be written to");
    let begin = Instant::now();
    let run = burgeon::run(&path, RunOptions { lod: 0, ..burgeon::options() });
    let all = begin.elapsed().as_secs_f64();
    std::fs::remove_file(&path).ok();
    let run = run.expect("the town grows");
    let size = {
        let object: std::sync::Arc<dyn std::any::Any + Send + Sync> = run.systems[0].objects[0].clone();
        object.downcast::<burgeon::objects::Network>().expect("a network").size()
    };
    println!("{size} pieces by a script: {all:.2} s with the scene: {:?}", run.times);
}
