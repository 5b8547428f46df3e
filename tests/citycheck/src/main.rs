//! Reports which of the given CityJSON files and sequences (`.jsonl`) are invalid, with the reasons. It is not a member of the
//! workspace, because the validator needs a hundred additional crates; the gate builds it separately.

use std::process::ExitCode;
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};

use cjval::CJValidator;

// The validator compiles its schemas for each feature, and half of that time is allocation.
#[global_allocator]
static ALLOCATOR: mimalloc::MiMalloc = mimalloc::MiMalloc;

/// Features of a sequence that one thread validates together.
const BATCH: usize = 16;

/// One document, or some features of a sequence with its first line.
struct Part {
    file: usize,
    head: String,
    features: Vec<String>,
}

fn main() -> ExitCode {
    let files: Vec<String> = std::env::args().skip(1).collect();
    let next = AtomicUsize::new(0);
    let failed = Mutex::new(vec![false; files.len()]);
    let parts: Vec<Part> = files.iter().enumerate().flat_map(|(index, file)| read_parts(index, file, &failed)).collect();
    std::thread::scope(|scope| {
        for _ in 0..std::thread::available_parallelism().map_or(1, usize::from) {
            scope.spawn(|| {
                while let Some(part) = parts.get(next.fetch_add(1, Ordering::Relaxed)) {
                    if !is_valid(&files[part.file], part) {
                        set_failed(&failed, part.file);
                    }
                }
            });
        }
    });
    let failed = failed.lock().map_or(files.len(), |failed| failed.iter().filter(|failed| **failed).count());
    println!("{} passed, {failed} failed", files.len() - failed);
    if failed > 0 || files.is_empty() { ExitCode::FAILURE } else { ExitCode::SUCCESS }
}

/// Reads a file as parts that can be validated at the same time.
fn read_parts(index: usize, file: &str, failed: &Mutex<Vec<bool>>) -> Vec<Part> {
    let text = match std::fs::read_to_string(file) {
        Ok(text) => text,
        Err(error) => {
            println!("{file}: {error}");
            set_failed(failed, index);
            return Vec::new();
        }
    };
    if !file.ends_with(".jsonl") {
        return vec![Part { file: index, head: text, features: Vec::new() }];
    }
    // The first line of a sequence has what its features share.
    let mut lines = text.lines().map(str::to_owned);
    let head = lines.next().unwrap_or_default();
    let features: Vec<String> = lines.collect();
    let mut parts = vec![Part { file: index, head: head.clone(), features: Vec::new() }];
    parts.extend(features.chunks(BATCH).map(|features| Part { file: index, head: head.clone(), features: features.to_vec() }));
    parts
}

/// Marks a file as invalid.
fn set_failed(failed: &Mutex<Vec<bool>>, file: usize) {
    if let Ok(mut failed) = failed.lock() {
        failed[file] = true;
    }
}

/// Returns true if a part is valid; prints the reasons otherwise.
fn is_valid(file: &str, part: &Part) -> bool {
    let mut validator = CJValidator::from_str(&part.head);
    if part.features.is_empty() {
        return report(file, &validator);
    }
    let mut valid = true;
    for feature in &part.features {
        if let Err(error) = validator.from_str_cjfeature(feature) {
            println!("{file}: {error}");
            return false;
        }
        valid &= report(file, &validator);
    }
    valid
}

/// Prints the errors of a validator, and returns true if there are none.
fn report(file: &str, validator: &CJValidator) -> bool {
    for (criterion, found) in validator.validate() {
        for error in found.get_errors().iter().take(5) {
            println!("{file}: {criterion}: {error}");
        }
    }
    validator.is_valid()
}
