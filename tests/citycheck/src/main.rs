//! Reports which of the given CityJSON files and sequences (`.jsonl`) are invalid, with the reasons. It is not a member of the
//! workspace, because the validator needs a hundred additional crates; the gate builds it separately.

use std::process::ExitCode;

use cjval::CJValidator;

fn main() -> ExitCode {
    let files: Vec<String> = std::env::args().skip(1).collect();
    let mut failed = 0;
    for file in &files {
        failed += usize::from(!is_valid(file));
    }
    println!("{} passed, {failed} failed", files.len() - failed);
    if failed > 0 || files.is_empty() { ExitCode::FAILURE } else { ExitCode::SUCCESS }
}

/// Returns true if a file is valid; prints the reasons otherwise.
fn is_valid(file: &str) -> bool {
    let text = match std::fs::read_to_string(file) {
        Ok(text) => text,
        Err(error) => {
            println!("{file}: {error}");
            return false;
        }
    };
    if !file.ends_with(".jsonl") {
        return report(file, &CJValidator::from_str(&text));
    }
    // The first line of a sequence has what its features share.
    let mut lines = text.lines();
    let mut validator = CJValidator::from_str(lines.next().unwrap_or_default());
    let mut valid = report(file, &validator);
    for line in lines {
        if let Err(error) = validator.from_str_cjfeature(line) {
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
