//! Tiles of synthetic cities, from the data to the checked tileset: times and memory of each step.
//! `cargo bench --bench tiles`, with the numbers of buildings as arguments.

#![allow(
    clippy::print_stdout,
    clippy::unwrap_used,
    clippy::cast_precision_loss,
    reason = "a bench prints its figures, and stops at what is wrong"
)]

#[path = "../tests/tiles/city.rs"]
#[allow(dead_code, reason = "tests use the rest")]
mod city;

use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::time::Instant;

use city::{City, city, write_geopackage};
use serde_json::Value;

fn main() {
    let given: Vec<usize> = std::env::args().filter_map(|argument| argument.parse().ok()).collect();
    let counts = if given.is_empty() { vec![10_000, 100_000] } else { given };
    println!(
        "| buildings | tiles | plan | make, 1 thread | make, 2 threads | again | join | check | memory | size |"
    );
    println!("|---|---|---|---|---|---|---|---|---|---|");
    counts.into_iter().for_each(measure);
}

/// Time (s), CPU time (s) and JSON document of a command.
struct Step {
    time: f64,
    cpu: f64,
    document: Value,
}

/// Starts a command of `burgeon tiles`.
fn start(city: &City, arguments: &[&str]) -> Child {
    let mut command: Command = city.command(arguments);
    command.arg("--json").stdout(Stdio::piped()).spawn().unwrap()
}

/// Waits for commands that run at the same time.
fn steps(children: Vec<Child>) -> Step {
    let (before, begin) = (children_cpu(), Instant::now());
    let mut document = Value::Null;
    for child in children {
        let output = child.wait_with_output().unwrap();
        assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stdout));
        document = serde_json::from_slice(&output.stdout).unwrap();
    }
    Step { time: begin.elapsed().as_secs_f64(), cpu: children_cpu() - before, document }
}

fn step(city: &City, arguments: &[&str]) -> Step {
    steps(vec![start(city, arguments)])
}

fn measure(count: usize) {
    let city = City(tempfile::tempdir().unwrap());
    write_geopackage(&city.path("city.gpkg"), 2154, &self::city(count, [652_000.0, 6_862_000.0]));
    std::fs::write(city.path("city.lua"), include_str!("tiles.lua")).unwrap();
    let plan = |folder: &str| {
        let options = ["--reach", "2", "--geoid-height", "44", "--compress", "meshopt"];
        step(&city, &[&["plan", "city.lua", "-o", folder][..], &options].concat())
    };
    let planned = plan("one");
    plan("two");
    let one = step(&city, &["make", "one", "--threads", "1"]);
    let shares =
        ["1/2", "2/2"].map(|share| start(&city, &["make", "two", "--threads", "1", "--share", share]));
    let two = steps(shares.into());
    let again = step(&city, &["make", "one"]);
    let joined = step(&city, &["join", "one"]);
    let checked = step(&city, &["check", "one"]);
    assert_eq!(checked.document["features"], count);
    let memory = [&planned, &one, &two, &joined, &checked]
        .map(|step| step.document["peak_memory_mb"].as_f64().unwrap_or(0.0));
    let rate = |step: &Step| {
        format!("{:.0}/s ({:.1} s, CPU {:.1} s)", count as f64 / step.time, step.time, step.cpu)
    };
    let time = |step: &Step| format!("{:.1} s (CPU {:.1} s)", step.time, step.cpu);
    println!(
        "| {count} | {} | {} | {} | {} | {} | {} | {} | {:.0} MB | {:.0} MB |",
        planned.document["tiles"],
        time(&planned),
        rate(&one),
        rate(&two),
        time(&again),
        time(&joined),
        time(&checked),
        memory.into_iter().fold(0.0, f64::max),
        size(&city.path("one/tiles")) as f64 / 1e6,
    );
}

/// Returns the size (bytes) of the contents in a folder.
fn size(folder: &Path) -> u64 {
    let mut sum = 0;
    for entry in std::fs::read_dir(folder).unwrap() {
        let entry = entry.unwrap();
        let path = entry.path();
        match path.is_dir() {
            true => sum += size(&path),
            false if path.extension().is_some_and(|extension| extension == "glb") => {
                sum += entry.metadata().unwrap().len();
            }
            false => {}
        }
    }
    sum
}

/// Returns the CPU time (s) of all child processes that have ended; only on Linux.
fn children_cpu() -> f64 {
    let stat = std::fs::read_to_string("/proc/self/stat").unwrap_or_default();
    let fields: Vec<&str> = stat.rsplit(')').next().unwrap_or_default().split_whitespace().collect();
    let ticks = |index: usize| fields.get(index).and_then(|field| field.parse::<f64>().ok());
    // Fields 16 and 17 of proc_pid_stat(5), in hundredths of a second, counted without the fields up to the process name.
    ticks(13).zip(ticks(14)).map_or(f64::NAN, |(user, system)| (user + system) / 100.0)
}
