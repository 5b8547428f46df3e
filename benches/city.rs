//! The buildings of a real city, from the data file to the finished `.glb`: time, CPU time, memory and size.
//! `cargo bench --bench city`. Needs `../shared/data`.

#![allow(clippy::print_stdout, reason = "a bench prints its figures")]

use std::path::{Path, PathBuf};
use std::process::Command;
use std::time::Instant;

/// Number of measurements; the best counts.
const ROUNDS: usize = 4;

fn main() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let data = root.join("../shared/data");
    if !data.join("france_buildings.gpkg").is_file() {
        println!("skipped: there is no {}", data.display());
        return;
    }
    let output = std::env::temp_dir().join(format!("burgeon bench {}.glb", std::process::id()));
    println!("| city | faces | time | CPU time | M faces/s of CPU | memory | file |");
    println!("|---|---|---|---|---|---|---|");
    for (name, settings) in [
        ("simple templates", [].as_slice()),
        ("a model for every bay, as instances", &["rich=true"]),
        ("a model for every bay, as faces", &["rich=true", "expand=true"]),
    ] {
        let best = (0..ROUNDS)
            .map(|_| measure(&root.join("benches/city.lua"), &data, settings, &output))
            .min_by(|a, b| a.time.total_cmp(&b.time));
        if let Some(Measured { faces, time, cpu, memory, file }) = best {
            let rate = faces / cpu / 1e6;
            println!(
                "| {name} | {faces} | {time:.2} s | {cpu:.2} s | {rate:.1} | {memory:.0} MB | {file:.0} MB |"
            );
        }
    }
    std::fs::remove_file(output).ok();
}

/// Measurements of a run.
struct Measured {
    faces: f64,
    /// Wall-clock time from the start of the program to its end (s).
    time: f64,
    /// CPU time of all threads, including system time (s).
    cpu: f64,
    /// Peak memory (MB).
    memory: f64,
    /// Size of the model (MB).
    file: f64,
}

fn measure(script: &Path, data: &Path, settings: &[&str], output: &PathBuf) -> Measured {
    let mut command = Command::new(env!("CARGO_BIN_EXE_burgeon"));
    command.arg("run").arg(script).arg("--data").arg(data).arg("--json").arg("-o").arg(output);
    settings.iter().for_each(|setting| {
        command.args(["--set", setting]);
    });
    let (before, begin) = (children_cpu(), Instant::now());
    let done = command.output().expect("the program starts");
    let time = begin.elapsed().as_secs_f64();
    assert!(done.status.success(), "{}", String::from_utf8_lossy(&done.stderr));
    let summary: serde_json::Value = serde_json::from_slice(&done.stdout).expect("a summary");
    let number = |name: &str| summary[name].as_f64().unwrap_or(f64::NAN);
    #[allow(clippy::cast_precision_loss, reason = "shown in whole megabytes")]
    let file = std::fs::metadata(output).map_or(f64::NAN, |file| file.len() as f64 / 1e6);
    Measured {
        faces: number("triangles"),
        time,
        cpu: children_cpu() - before,
        memory: number("peak_memory_mb"),
        file,
    }
}

/// Returns the CPU time (s) of all child processes that have ended; only on Linux.
fn children_cpu() -> f64 {
    let stat = std::fs::read_to_string("/proc/self/stat").unwrap_or_default();
    let fields: Vec<&str> = stat.rsplit(')').next().unwrap_or_default().split_whitespace().collect();
    let ticks = |index: usize| fields.get(index).and_then(|field| field.parse::<f64>().ok());
    // Fields 16 and 17 of proc_pid_stat(5), in hundredths of a second, counted without the fields up to the process
    // name.
    ticks(13).zip(ticks(14)).map_or(f64::NAN, |(user, system)| (user + system) / 100.0)
}
