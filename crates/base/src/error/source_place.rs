//! Lines of files.

use std::fmt;
use std::path::Path;

use crate::files;
use crate::text::without_passwords;

/// A line of a script or data file.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord)]
pub struct SourcePlace {
    /// File name as the user wrote it.
    pub file: String,
    /// Line number, from 1.
    pub line: usize,
}

/// Maximum size (bytes) of a file whose lines are shown, and maximum length (characters) of a shown line.
const LARGEST: u64 = 16_000_000;

const WIDEST: usize = 160;

impl SourcePlace {
    /// Creates the location of line `line` of `file`.
    pub fn new(file: impl Into<String>, line: usize) -> Self {
        Self { file: file.into(), line }
    }

    /// Returns the lines from `before` lines before the location to `after` lines after it, with their numbers. Empty
    /// if the file cannot be read, or if the line itself is empty or missing.
    pub fn excerpt(&self, before: usize, after: usize) -> Vec<(usize, String)> {
        let Some(text) = self.text() else { return Vec::new() };
        let first = self.line.saturating_sub(before).max(1);
        let lines = text.lines().enumerate().skip(first - 1).take(self.line + after + 1 - first);
        let shown = |line: &str| without_passwords(line.trim_end()).chars().take(WIDEST).collect();
        let lines = lines.map(|(index, line)| (index + 1, shown(line)));
        let lines: Vec<(usize, String)> = lines.collect();
        let there =
            lines.iter().any(|(number, line): &(usize, String)| *number == self.line && !line.is_empty());
        if there { lines } else { Vec::new() }
    }

    /// Returns the line itself. `None` if the file cannot be read, or if the line is empty or missing.
    pub(super) fn line_text(&self) -> Option<String> {
        self.line_of(&self.text()?)
    }

    /// Returns the line of `text`, which is the content of the file. `None` if the line is empty or missing.
    pub(super) fn line_of(&self, text: &str) -> Option<String> {
        let text = text.strip_prefix('\u{feff}').unwrap_or(text);
        let line = text.lines().nth(self.line.checked_sub(1)?)?.trim_end();
        (!line.trim().is_empty()).then(|| line.to_owned())
    }

    /// Returns the content of the file, as far as it is text.
    fn text(&self) -> Option<String> {
        let bytes = files::read(Path::new(&self.file), LARGEST).ok()?;
        String::from_utf8(bytes).ok()
    }
}

impl fmt::Display for SourcePlace {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}:{}", self.file, self.line)
    }
}
