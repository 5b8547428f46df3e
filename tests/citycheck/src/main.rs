//! Reports which of the given CityJSON files are invalid, with the reasons. It is not a member of the
//! workspace, because the validator needs a hundred additional crates; the gate builds it separately.

use std::process::ExitCode;

use cjval::CJValidator;

fn main() -> ExitCode {
    let files: Vec<String> = std::env::args().skip(1).collect();
    let mut failed = 0;
    for file in &files {
        let text = match std::fs::read_to_string(file) {
            Ok(text) => text,
            Err(error) => {
                println!("{file}: {error}");
                failed += 1;
                continue;
            }
        };
        let validator = CJValidator::from_str(&text);
        for (criterion, found) in validator.validate() {
            for error in found.get_errors().iter().take(5) {
                println!("{file}: {criterion}: {error}");
            }
        }
        failed += usize::from(!validator.is_valid());
    }
    println!("{} passed, {failed} failed", files.len() - failed);
    if failed > 0 || files.is_empty() { ExitCode::FAILURE } else { ExitCode::SUCCESS }
}
