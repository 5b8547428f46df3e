//! Has the readers of foreign bytes look at damaged ones: `fuzz TARGET SECONDS [SEED]`; `fuzz/run.sh` runs all.
//!
//! Inputs are those in `fuzz/corpus/TARGET`, damaged; one that a reader takes joins them for the rest of the run.
//! What makes a reader panic, or keeps it longer than [`PATIENCE`], is left in `fuzz/found`, and the exit status is 1.

#![allow(clippy::print_stdout, reason = "a person reads how it went")]
#![allow(clippy::unwrap_used, reason = "it stops at what is wrong with the corpus")]

mod mutate;
mod targets;

use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::sync::{Arc, Mutex};
use std::time::{Duration, Instant};

use burgeon::random::Stream;
use targets::TARGETS;

/// The longest that a reader may take.
const PATIENCE: Duration = Duration::from_secs(30);
/// The input that takes longest, and longer than this, is left for people to look at.
const SLOW: Duration = Duration::from_secs(1);
/// The most inputs that join those of the corpus.
const MOST: usize = 2000;

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let names: Vec<&str> = TARGETS.iter().map(|target| target.name).collect();
    let wanted = arguments.first().and_then(|name| TARGETS.iter().find(|target| target.name == name));
    let seconds = arguments.get(1).and_then(|seconds| seconds.parse().ok());
    let (Some(target), Some(seconds)) = (wanted, seconds) else {
        println!("fuzz TARGET SECONDS [SEED]; the targets are\n{}", names.join("\n"));
        return ExitCode::from(2);
    };
    let seed = arguments.get(2).and_then(|seed| seed.parse().ok()).unwrap_or(1);
    let folder = &Path::new(env!("CARGO_MANIFEST_DIR")).join("fuzz");
    let mut inputs: Vec<Vec<u8>> = Vec::new();
    let mut paths: Vec<PathBuf> = std::fs::read_dir(folder.join("corpus").join(target.name))
        .unwrap()
        .map(|entry| entry.unwrap().path())
        .collect();
    paths.sort();
    inputs.extend(paths.iter().map(|path| std::fs::read(path).unwrap()));
    let known = inputs.len();

    let panicked = Arc::new(AtomicBool::new(false));
    let hook = std::panic::take_hook();
    let flag = Arc::clone(&panicked);
    // In any thread.
    std::panic::set_hook(Box::new(move |info| {
        flag.store(true, Ordering::SeqCst);
        hook(info);
    }));

    let found = folder.join("found");
    std::fs::create_dir_all(&found).unwrap();
    let present = Arc::new(Mutex::new(Vec::new()));
    let begun = Arc::new(AtomicU64::new(u64::MAX));
    let begin = Instant::now();
    let (late, slow) = (Arc::clone(&begun), Arc::clone(&present));
    let left = found.join(format!("{}-slow", target.name));
    std::thread::spawn(move || {
        loop {
            std::thread::sleep(Duration::from_secs(1));
            let since = Duration::from_millis(late.load(Ordering::SeqCst));
            if begin.elapsed().checked_sub(since).is_some_and(|time| time > PATIENCE) {
                std::fs::write(&left, &*slow.lock().unwrap()).unwrap();
                println!("takes longer than {} s: {}", PATIENCE.as_secs(), left.display());
                std::process::exit(1);
            }
        }
    });

    let scratch = tempfile::tempdir().unwrap();
    let mut dice = Stream::new(seed);
    let (mut runs, mut good, mut longest) = (0u64, 0u64, Duration::ZERO);
    while begin.elapsed() < Duration::from_secs(seconds) {
        let bytes = mutate::damaged(&inputs, target.words, &mut dice);
        present.lock().unwrap().clone_from(&bytes);
        let now = begin.elapsed();
        begun.store(u64::try_from(now.as_millis()).unwrap_or(0), Ordering::SeqCst);
        let read = std::panic::catch_unwind(|| (target.read)(&bytes, scratch.path()));
        begun.store(u64::MAX, Ordering::SeqCst);
        let took = begin.elapsed().saturating_sub(now);
        if took > SLOW && took > longest {
            std::fs::write(found.join(format!("{}-longest", target.name)), &bytes).unwrap();
        }
        longest = longest.max(took);
        runs += 1;
        if panicked.load(Ordering::SeqCst) || read.is_err() {
            let path = found.join(format!("{}-{seed}-{runs}", target.name));
            std::fs::write(&path, &bytes).unwrap();
            println!("{}: panics at {}", target.name, path.display());
            return ExitCode::FAILURE;
        }
        if read.is_ok_and(|read| read) {
            good += 1;
            if inputs.len() < known + MOST {
                inputs.push(bytes);
            } else {
                let place = known + dice.below(MOST);
                inputs[place] = bytes;
            }
        }
    }
    println!("{}: {runs} inputs, {good} read, the longest {} ms", target.name, longest.as_millis());
    ExitCode::SUCCESS
}
