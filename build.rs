//! Lists the example scripts and their data for `burgeon examples`, which writes them after an installation.

#![allow(
    clippy::print_stdout,
    reason = "cargo reads the instructions of a build script from its standard output"
)]

use std::error::Error;
use std::fmt::Write as _;
use std::path::{Path, PathBuf};
use std::{env, fs};

/// Folders of the repository that the program contains.
const FOLDERS: [&str; 2] = ["scripts", "examples"];

fn main() -> Result<(), Box<dyn Error>> {
    let root = PathBuf::from(env::var("CARGO_MANIFEST_DIR")?);
    let mut files = Vec::new();
    for folder in FOLDERS {
        println!("cargo:rerun-if-changed={folder}");
        collect(&root.join(folder), &mut files)?;
    }
    files.sort();
    let mut table = String::from("[\n");
    for path in &files {
        let parts: Vec<_> = path.strip_prefix(&root)?.iter().map(|part| part.to_string_lossy()).collect();
        writeln!(table, "    ({:?}, include_bytes!({path:?})),", parts.join("/"))?;
    }
    table.push(']');
    fs::write(Path::new(&env::var("OUT_DIR")?).join("examples.rs"), table)?;
    Ok(())
}

/// Adds the files of a folder and its subfolders that a user of the program needs.
fn collect(folder: &Path, files: &mut Vec<PathBuf>) -> Result<(), Box<dyn Error>> {
    for entry in fs::read_dir(folder)? {
        let path = entry?.path();
        if path.is_dir() {
            collect(&path, files)?;
        } else if is_needed(&path) {
            files.push(path);
        }
    }
    Ok(())
}

/// Returns false for Rust programs, which need the source of Burgeon, and for renders of the published models.
fn is_needed(path: &Path) -> bool {
    match path.extension().and_then(|extension| extension.to_str()) {
        Some("png") => !path.with_extension("lua").is_file(),
        Some("rs") => false,
        _ => path.file_name().is_some_and(|name| !name.to_string_lossy().starts_with('.')),
    }
}
