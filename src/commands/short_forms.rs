//! Command lines without a command: `burgeon tree.lua` runs a script.

use std::ffi::{OsStr, OsString};
use std::path::Path;

use burgeon::error::nearest;
use clap::Command;
use clap::error::{ContextKind, ContextValue, Error, ErrorKind};

use super::shared::STANDARD;

/// Returns the arguments with the command `run` before a script, if `arguments` begin with a script in place of a command:
/// `tree.lua`, `-` for standard input, any other file, or `tree` for an existing `tree.lua`. The flag is set if the command was
/// added.
pub(super) fn with_command(program: &Command, arguments: Vec<OsString>) -> (Vec<OsString>, bool) {
    let Some(script) = arguments.get(1).and_then(|first| script_of(program, first)) else {
        return (arguments, false);
    };
    let mut complete = arguments;
    complete[1] = script;
    complete.insert(1, "run".into());
    (complete, true)
}

/// Returns the script that an argument in place of a command means.
fn script_of(program: &Command, first: &OsStr) -> Option<OsString> {
    let text = first.to_string_lossy();
    if text == STANDARD {
        return Some(first.to_owned());
    }
    let is_command = text == "help" || program.get_subcommands().any(|inner| inner.get_name() == text);
    if is_command || text.starts_with('-') || text.is_empty() {
        return None;
    }
    let path = Path::new(first);
    let is_lua = path.extension().is_some_and(|extension| extension.eq_ignore_ascii_case("lua"));
    if is_lua || path.is_file() {
        return Some(first.to_owned());
    }
    let mut named = first.to_owned();
    named.push(".lua");
    Path::new(&named).is_file().then_some(named)
}

/// Adds to the error of an unknown command the command or the script with a similar name.
pub(super) fn suggest(program: &Command, mut error: Error) -> Error {
    let Some(ContextValue::String(name)) = error.get(ContextKind::InvalidSubcommand) else { return error };
    let is_told = error.get(ContextKind::SuggestedSubcommand).is_some();
    if error.kind() != ErrorKind::InvalidSubcommand || is_told {
        return error;
    }
    let name = name.clone();
    let commands = program.get_subcommands().map(Command::get_name);
    if let Some(near) = nearest(&name, commands) {
        error.insert(ContextKind::SuggestedSubcommand, ContextValue::Strings(vec![near.to_owned()]));
        return error;
    }
    let entries = std::fs::read_dir(".").into_iter().flatten().flatten().take(1000);
    let files: Vec<String> = entries.filter_map(|entry| entry.file_name().into_string().ok()).collect();
    let mut stems: Vec<&str> = files.iter().filter_map(|file| file.strip_suffix(".lua")).collect();
    stems.sort_unstable();
    let tip = match nearest(&name, stems) {
        Some(near) => format!("a script with a similar name exists: '{near}.lua'"),
        None => format!("to run a script, name its file: 'burgeon run {name}.lua'"),
    };
    error.insert(ContextKind::Suggested, ContextValue::StyledStrs(vec![tip.into()]));
    error
}

#[cfg(test)]
mod tests {
    use super::*;

    fn short(arguments: &[&str]) -> Vec<String> {
        let program =
            Command::new("burgeon").subcommand(Command::new("run")).subcommand(Command::new("live"));
        let arguments =
            std::iter::once("burgeon").chain(arguments.iter().copied()).map(OsString::from).collect();
        let (complete, _) = with_command(&program, arguments);
        complete.into_iter().skip(1).map(|argument| argument.to_string_lossy().into_owned()).collect()
    }

    #[test]
    fn a_script_in_place_of_a_command_is_run() {
        assert_eq!(short(&["tree.lua", "-o", "a.glb"]), ["run", "tree.lua", "-o", "a.glb"]);
        assert_eq!(short(&["-"]), ["run", "-"]);
        assert_eq!(short(&["live", "tree.lua"]), ["live", "tree.lua"]);
        assert_eq!(short(&["rnu", "tree.lua"]), ["rnu", "tree.lua"]);
        assert_eq!(short(&["--help"]), ["--help"]);
        assert_eq!(short(&[]), [""; 0]);
        // A file of this crate's folder, which tests run in.
        assert_eq!(short(&["README.md"]), ["run", "README.md"]);
        assert_eq!(short(&["scripts/tower"]), ["run", "scripts/tower.lua"]);
    }
}
