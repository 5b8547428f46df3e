//! Time that packages add to the start of a run: a package of 200 files of which one is required, and one of which all
//! are.
//! `cargo bench --bench packages`.

#![allow(clippy::print_stdout, reason = "a bench prints its figures")]
#![allow(clippy::unwrap_used, reason = "a bench stops at what is wrong")]

use std::fs;
use std::path::Path;
use std::time::{Duration, Instant};

const FILES: usize = 200;

/// Maximum time that a package may add to the start of a run (ms).
const MOST: f64 = 50.0;

/// Creates a package with this number of scripts and images.
fn package(folder: &Path, name: &str, files: usize) {
    let inner = folder.join("mods").join(name);
    fs::create_dir_all(inner.join("textures")).unwrap();
    fs::write(inner.join("mod.toml"), format!("name = \"{name}\"\nversion = \"1.0.0\"\napi = \"1\"\n"))
        .unwrap();
    let body: String = (0..40).map(|line| format!("local a{line} = math.sin({line}) * 2\n")).collect();
    for file in 0..files {
        fs::write(inner.join(format!("part{file}.lua")), format!("{body}return a1 + {file}\n")).unwrap();
        fs::write(inner.join(format!("textures/{file}.png")), vec![0; 40_000]).unwrap();
    }
}

/// Returns the median time of a run of `script` without export.
fn start(folder: &Path, script: &str) -> Duration {
    let path = folder.join("s.lua");
    fs::write(&path, script).unwrap();
    let mut times: Vec<Duration> = (0..21)
        .map(|_| {
            let begin = Instant::now();
            burgeon::run(&path, burgeon::options()).unwrap();
            begin.elapsed()
        })
        .collect();
    times.sort();
    times[times.len() / 2]
}

fn main() {
    let ms = |time: Duration| time.as_secs_f64() * 1e3;
    let folder = tempfile::tempdir().unwrap();
    let alone = start(folder.path(), "local a = 1");
    println!("a script alone: {:.2} ms", ms(alone));
    package(folder.path(), "large", FILES);
    let one = start(folder.path(), "local a = require(\"@large/part7\")");
    let added = ms(one) - ms(alone);
    let verdict = if added < MOST { "met" } else { "missed" };
    println!(
        "with a package of {FILES} scripts and {FILES} images, one required: {added:+.2} ms of at most {MOST:.0}: {verdict}"
    );
    let all: String = (0..FILES).map(|file| format!("require(\"@large/part{file}\")\n")).collect();
    let all = start(folder.path(), &all);
    println!("with all {FILES} scripts required: {:+.2} ms", ms(all) - ms(alone));
    for number in 0..FILES {
        package(folder.path(), &format!("small{number}"), 1);
    }
    let many = start(folder.path(), "local a = require(\"@large/part7\")");
    println!("with {FILES} more packages: {:+.2} ms", ms(many) - ms(alone));
}
