//! Files of the script for the page's editor.

use std::fs;
use std::io::Write as _;
use std::path::{Path, PathBuf};

use super::message::Event;
use super::state::ServerState;
use burgeon_base::error::{Error, Limit, Result};

/// Maximum length (bytes) of a file, which a message can hold.
const LARGEST: usize = 400_000;

/// Maximum length (bytes) of a line, because longer strings are cut in messages.
const LONGEST_LINE: usize = 10_000;

/// Returns the content of a file of the script.
pub(super) fn read(state: &ServerState, id: u64, file: &str) -> Event {
    let answer = own_script(state, file).and_then(|path| content(&path));
    match answer {
        Ok(text) => source(id, file, &text, false),
        Err(error) => Event::rejection(Some(id), &error),
    }
}

/// Writes `text` to a file of the script, whose content the page knows by its `hash`. If the file has changed, it stays
/// as it is, and the answer has its content.
pub(super) fn write(state: &ServerState, id: u64, file: &str, text: &str, hash: &str) -> Event {
    let save = || -> Result<Event> {
        check(Path::new(file), text)?;
        let path = own_script(state, file)?;
        let known = content(&path)?;
        if hash_of(&known) != hash {
            return Ok(source(id, file, &known, true));
        }
        // The file keeps its permissions. A change of them after the write would delay the run.
        burgeon_export::write_file(&path, |out| out.write_all(text.as_bytes()))?;
        Ok(Event::Written { id, file: file.to_owned(), hash: hash_of(text) })
    };
    save().unwrap_or_else(|error| Event::rejection(Some(id), &error))
}

fn source(id: u64, file: &str, text: &str, changed: bool) -> Event {
    let lines = text.split('\n').map(str::to_owned).collect();
    Event::Source { id, file: file.to_owned(), lines, hash: hash_of(text), changed }
}

fn hash_of(text: &str) -> String {
    blake3::hash(text.as_bytes()).to_hex().to_string()
}

/// Returns the path of a file of the script with code. Data and pictures are not edited.
fn own_script(state: &ServerState, file: &str) -> Result<PathBuf> {
    let path = state.own_file(file)?;
    let is_code = path.extension().is_some_and(|it| it == "lua" || it == "luau");
    if is_code || path.canonicalize().ok() == state.script.canonicalize().ok() {
        return Ok(path);
    }
    Err(Error::argument(format!("{file} is not a script")).help("edit it in another program"))
}

fn content(path: &Path) -> Result<String> {
    let bytes = fs::read(path).map_err(|error| Error::file(path, format!("cannot read it: {error}")))?;
    let text = String::from_utf8(bytes)
        .map_err(|_| Error::file(path, "it is not UTF-8").help("edit it in another program"))?;
    check(path, &text)?;
    Ok(text)
}

fn check(path: &Path, text: &str) -> Result<()> {
    let is_long = text.split('\n').any(|line| line.len() > LONGEST_LINE);
    if text.len() <= LARGEST && !is_long {
        return Ok(());
    }
    let what = if is_long { "a line" } else { "the file" };
    let error = Error::limit(Limit::Size, format!("{}: {what} is too long for this page", path.display()));
    Err(error.help("edit it in another program"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn files_and_lines_that_no_message_holds_are_refused() {
        let path = Path::new("a.lua");
        assert!(check(path, &"-- a\n".repeat(1000)).is_ok());
        let long = check(path, &"x".repeat(LONGEST_LINE + 1)).unwrap_err().to_string();
        assert!(long.contains("a line is too long"), "{long}");
        let large = check(path, &"-- a\n".repeat(LARGEST / 5 + 1)).unwrap_err().to_string();
        assert!(large.contains("the file is too long"), "{large}");
    }

    #[test]
    fn a_source_is_its_lines() {
        let Event::Source { lines, changed, .. } = source(1, "a.lua", "one\r\n\ntwo\n", true) else {
            panic!()
        };
        assert_eq!(lines, ["one\r", "", "two", ""]);
        assert!(changed);
    }
}
