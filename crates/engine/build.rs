//! Compiles the prelude and the standard library to bytecode, which takes half of the time in which a short script runs.

use std::error::Error;
use std::path::PathBuf;
use std::{env, fs};

#[path = "src/declare/bytecode.rs"]
#[expect(dead_code, reason = "the crate compiles scripts, which may be wrong")]
mod bytecode;
#[path = "src/machine/prelude/words.rs"]
mod words;

/// Parts of the prelude: one chunk of Luau, in which each part uses the locals of the parts before it.
const PARTS: [&str; 16] = [
    "batch",
    "constructors",
    "successors",
    "drivers",
    "dependents",
    "calls",
    "script_types",
    "held_objects",
    "declarations",
    "interpretation",
    "queries",
    "randoms",
    "distributions",
    "hooks",
    "globals",
    "exports",
];

fn main() -> Result<(), Box<dyn Error>> {
    let mut prelude = String::new();
    for part in PARTS {
        prelude.push_str(&read(&format!("src/machine/prelude/{part}.luau"))?);
    }
    write("prelude", &expand(&with_words(prelude)))?;
    write("stdlib", &read("../../stdlib.lua")?)
}

/// Reads a file, after whose change this script runs again.
fn read(path: &str) -> Result<String, Box<dyn Error>> {
    println!("cargo::rerun-if-changed={path}");
    Ok(fs::read_to_string(path).map_err(|error| format!("{path}: {error}"))?)
}

/// Writes the bytecode of `text` to a file for the crate.
fn write(name: &str, text: &str) -> Result<(), Box<dyn Error>> {
    let code = bytecode::compiler().compile(text).map_err(|error| format!("{name}: {error}"))?;
    let folder = env::var_os("OUT_DIR").map(PathBuf::from).unwrap_or_default();
    Ok(fs::write(folder.join(format!("{name}.bytecode")), code)?)
}

/// Replaces names such as `@KEEP` by their numbers.
fn with_words(template: String) -> String {
    words::WORDS.into_iter().fold(template, |text, (name, word)| text.replace(name, &word.to_string()))
}

/// Repeats the marked parts of the template for each number of parameters.
fn expand(template: &str) -> String {
    let mut out = String::with_capacity(template.len() * 3);
    let mut lines = template.lines();
    while let Some(line) = lines.next() {
        let Some(range) = line.strip_prefix("--@each K=") else {
            out.push_str(line);
            out.push('\n');
            continue;
        };
        let part: Vec<&str> = lines.by_ref().take_while(|line| *line != "--@end").collect();
        let (first, last) = range.split_once("..").unwrap_or((range, range));
        let bounds = first.parse().unwrap_or(0)..=last.parse().unwrap_or(0);
        for count in bounds {
            for line in &part {
                out.push_str(&instance(line, count));
                out.push('\n');
            }
        }
    }
    out
}

/// Returns one line of the template for `count` parameters.
fn instance(line: &str, count: usize) -> String {
    let names: Vec<String> = (1..=count).map(|index| format!("a{index}")).collect();
    if let Some(each) = line.trim().strip_prefix("@{").and_then(|line| line.strip_suffix('}')) {
        return (1..=count)
            .map(|index| {
                each.replace("aI", &names[index - 1])
                    .replace("OFFSET", &((index - 1) * 8).to_string())
                    .replace(", I)", &format!(", {index})"))
            })
            .collect::<Vec<_>>()
            .join(" ");
    }
    let arguments = names.join(", ");
    let with_comma = if count > 0 { format!(", {arguments}") } else { String::new() };
    line.replace(" @COMMA_ARGS", &with_comma).replace("@ARGS", &arguments).replace('K', &count.to_string())
}
