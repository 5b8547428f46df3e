//! External programs: the editor that opens a line of a script, and the browser.

use std::io::IsTerminal;
use std::path::Path;
use std::process::{Command, Stdio};

use burgeon_base::error::{Error, Result};
use burgeon_base::named_thread;

/// Command that opens a file at a line, such as `code -g {file}:{line}`.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Editor(Vec<String>);

impl Editor {
    /// Splits a command line at spaces outside of quotes, without a shell. The file is appended if `{file}` does not
    /// occur. Fails if there is no program or a quote is not closed.
    ///
    /// ```
    /// use burgeon_live::Editor;
    ///
    /// assert_eq!(Editor::from_text("code -g")?, Editor::from_text("  'code'   -g  ")?);
    /// assert_ne!(Editor::from_text("code -g")?, Editor::from_text("'code -g'")?);
    /// assert!(Editor::from_text("code '-g").is_err(), "a quote is open");
    /// # Ok::<(), burgeon_base::Error>(())
    /// ```
    pub fn from_text(text: &str) -> Result<Self> {
        let mut words: Vec<String> = Vec::new();
        let mut quote = None;
        let mut in_word = false;
        for character in text.chars() {
            match quote {
                Some(end) if character == end => quote = None,
                None if character == '"' || character == '\'' => {
                    quote = Some(character);
                    if !in_word {
                        words.push(String::new());
                    }
                    in_word = true;
                }
                None if character.is_whitespace() => in_word = false,
                _ => {
                    if !in_word {
                        words.push(String::new());
                    }
                    in_word = true;
                    if let Some(word) = words.last_mut() {
                        word.push(character);
                    }
                }
            }
        }
        if quote.is_some() {
            return Err(Error::usage(format!("a quote does not end in --editor {text:?}"))
                .help("write the command as for a shell, such as --editor 'code -g {file}:{line}'"));
        }
        if words.first().is_none_or(|program| program.is_empty()) {
            return Err(
                Error::usage("--editor contains no program").help("such as --editor 'code -g {file}:{line}'")
            );
        }
        if !words.iter().any(|word| word.contains("{file}")) {
            words.push("{file}".to_owned());
        }
        Ok(Self(words))
    }

    /// Returns the words of the command for `line` of `file`.
    fn words(&self, file: &Path, line: usize) -> Vec<String> {
        let (file, line) = (file.display().to_string(), line.to_string());
        // The name of a file may contain {line}, so {line} is replaced first.
        self.0.iter().map(|word| word.replace("{line}", &line).replace("{file}", &file)).collect()
    }

    /// Starts the editor. Fails if the program does not exist.
    pub(super) fn open(&self, file: &Path, line: usize) -> Result<()> {
        let words = self.words(file, line);
        let Some((program, arguments)) = words.split_first() else { return Ok(()) };
        start(Command::new(program).args(arguments)).map_err(|error| {
            Error::system(format!("cannot start the editor {program}: {error}"))
                .help("specify a program in PATH: --editor 'code -g {file}:{line}'")
        })
    }
}

/// Starts a program that continues independently.
fn start(command: &mut Command) -> std::io::Result<()> {
    let mut child = command.stdin(Stdio::null()).stdout(Stdio::null()).stderr(Stdio::null()).spawn()?;
    // Wait for its exit, so that no zombie process remains. An error is ignored, because nothing else depends on it.
    let _ = named_thread("editor").spawn(move || child.wait());
    Ok(())
}

/// Returns true if the user is likely to see a browser that is opened on this machine.
pub fn has_display() -> bool {
    let set = |name: &str| std::env::var_os(name).is_some_and(|value| !value.is_empty());
    let shown = if cfg!(any(target_os = "macos", windows)) {
        !set("SSH_CONNECTION")
    } else {
        set("DISPLAY") || set("WAYLAND_DISPLAY")
    };
    shown && std::io::stdout().is_terminal()
}

/// Opens `address` in the default browser. Fails if the system cannot do so.
pub fn browse(address: &str) -> Result<()> {
    let mut command = if cfg!(target_os = "macos") {
        Command::new("open")
    } else if cfg!(windows) {
        let mut command = Command::new("rundll32");
        command.arg("url.dll,FileProtocolHandler");
        command
    } else {
        Command::new("xdg-open")
    };
    start(command.arg(address)).map_err(|error| {
        Error::system(format!("cannot open a browser: {error}")).help("open the address yourself")
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn words(template: &str) -> Vec<String> {
        Editor::from_text(template).unwrap().words(Path::new("/a b/{line}.lua"), 7)
    }

    #[test]
    fn a_command_is_split_like_a_shell_and_nothing_in_it_is_run_by_one() {
        assert_eq!(words("code -g {file}:{line}"), ["code", "-g", "/a b/{line}.lua:7"]);
        assert_eq!(words("  vim  +{line} "), ["vim", "+7", "/a b/{line}.lua"]);
        assert_eq!(
            words("'my editor' \"a 'b'\" c''d \"\" {file}"),
            ["my editor", "a 'b'", "cd", "", "/a b/{line}.lua"]
        );
        assert_eq!(words("e; rm $(x) `y` {file}"), ["e;", "rm", "$(x)", "`y`", "/a b/{line}.lua"]);
        for wrong in ["", "   ", "''", "code 'x"] {
            assert!(Editor::from_text(wrong).is_err(), "{wrong}");
        }
    }

    #[test]
    fn an_editor_that_is_not_there_is_told() {
        let editor = Editor::from_text("no-such-editor-anywhere").unwrap();
        let error = editor.open(Path::new("a.lua"), 1).unwrap_err().to_string();
        assert!(error.starts_with("cannot start the editor no-such-editor-anywhere"), "{error}");
    }
}
