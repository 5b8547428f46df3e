//! Lines of scripts with the columns that an error is about.

use std::ops::Range;

use unicode_width::UnicodeWidthChar;

use super::columns::find_columns;
use super::source_place::SourcePlace;
use crate::text::{escaped, without_passwords};

/// A line of a script, and the columns of it that an error is about.
///
/// ```
/// use burgeon_base::error::Excerpt;
///
/// let excerpt = Excerpt::of_line("  turtle({ wdth = 3 })", None, "unknown field `wdth` in turtle");
/// assert_eq!((excerpt.column(), excerpt.end_column()), (12, 16));
/// assert_eq!(excerpt.rows(80), ["turtle({ wdth = 3 })", "         ^^^^"]);
/// ```
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Excerpt {
    line: String,
    /// Columns in characters, from 0.
    columns: Range<usize>,
}

/// Smallest number of columns of a terminal in which a line is shown.
const NARROWEST: usize = 12;

impl Excerpt {
    /// Returns the line at `place`, with the columns that are `known` or that `message` names. `None` if the file cannot be
    /// read, or if the line is empty or missing.
    pub(super) fn at(place: &SourcePlace, known: Option<&Range<usize>>, message: &str) -> Option<Self> {
        let line = place.line_text()?;
        Some(Self::of_line(&line, known, message))
    }

    /// Returns the excerpt of `line`, with the columns that are `known` or that `message` names; otherwise with the whole text.
    ///
    /// Columns are counted in characters, from 0.
    pub fn of_line(line: &str, known: Option<&Range<usize>>, message: &str) -> Self {
        let count = line.chars().count();
        let known = known.filter(|known| known.start < known.end && known.start < count);
        let columns = known.map(|known| known.start..known.end.min(count));
        let columns = columns.or_else(|| find_columns(line, message)).unwrap_or_else(|| text_columns(line));
        let hidden = without_passwords(line);
        // The columns of a line without its passwords differ.
        let columns = if hidden == line { columns } else { text_columns(&hidden) };
        Self { line: hidden.into_owned(), columns }
    }

    /// Returns the first column, from 1, in characters.
    pub fn column(&self) -> usize {
        self.columns.start + 1
    }

    /// Returns the column after the last one, from 1, in characters.
    pub fn end_column(&self) -> usize {
        self.columns.end + 1
    }

    /// Returns the text of the line without indentation, and a row of carets below the columns. Both rows have at most `width`
    /// cells of a terminal; a longer line is cut on both sides of the columns.
    pub fn rows(&self, width: usize) -> [String; 2] {
        let width = width.max(NARROWEST);
        let text = text_columns(&self.line);
        let cells: Vec<(String, usize)> = self.line.chars().take(text.end).map(cell).collect();
        let cells_of = |range: Range<usize>| cells[range].iter().map(|(_, width)| *width).sum::<usize>();
        let first = self.columns.start.min(cells.len().saturating_sub(1));
        let mut begin = text.start.min(first);
        let is_cut = cells_of(begin..cells.len()) > width;
        // Cells before the columns: a third, or fewer if the columns need the others.
        let marked = cells_of(first..self.columns.end.clamp(first, cells.len()));
        let before = (width / 3).min(width.saturating_sub(2 * CUT.len() + marked));
        if is_cut && cells_of(begin..first) > before {
            begin = first;
            while begin > text.start && cells_of(begin - 1..first) <= before {
                begin -= 1;
            }
        }
        let lead = if begin > text.start { CUT } else { "" };
        let mut end = begin;
        let mut used = lead.len();
        let room = width - if is_cut { CUT.len() } else { 0 };
        while end < cells.len() && used + cells[end].1 <= room {
            used += cells[end].1;
            end += 1;
        }
        let trail = if end < cells.len() { CUT } else { "" };
        let shown: String = cells[begin..end].iter().map(|(text, _)| text.as_str()).collect();
        let first = first.clamp(begin, end);
        let last = self.columns.end.clamp(first, end);
        let carets = "^".repeat(cells_of(first..last).max(1));
        let indent = " ".repeat(lead.len() + cells_of(begin..first));
        [format!("{lead}{shown}{trail}"), format!("{indent}{carets}")]
    }

    /// Adds `column` and `end_column` to the JSON of an error or a warning.
    pub fn add_to(&self, json: &mut serde_json::Value) {
        json["column"] = self.column().into();
        json["end_column"] = self.end_column().into();
    }
}

/// Mark of a cut line.
const CUT: &str = "...";

/// Returns the text of a character as it is shown, and the number of cells that it takes on a terminal.
fn cell(letter: char) -> (String, usize) {
    match letter {
        '\t' => (" ".to_owned(), 1),
        letter => {
            let text = escaped(letter.encode_utf8(&mut [0; 4])).into_owned();
            let width = match text.chars().count() {
                1 => letter.width().unwrap_or(1),
                count => count,
            };
            (text, width)
        }
    }
}

/// Returns the columns of a line without spaces at both ends.
fn text_columns(line: &str) -> Range<usize> {
    let begin = line.chars().take_while(|letter| letter.is_whitespace()).count();
    let end = line.trim_end().chars().count();
    begin.min(end)..end
}

#[cfg(test)]
mod tests {
    use super::*;

    fn rows(line: &str, columns: Option<Range<usize>>, width: usize) -> [String; 2] {
        Excerpt::of_line(line, columns.as_ref(), "").rows(width)
    }

    #[test]
    fn a_line_without_known_columns_is_marked_without_its_indentation() {
        assert_eq!(rows("\t  return n  ", None, 80), ["return n", "^^^^^^^^"]);
        let excerpt = Excerpt::of_line("\t  return n  ", None, "");
        assert_eq!((excerpt.column(), excerpt.end_column()), (4, 12));
    }

    #[test]
    fn carets_stand_below_wide_letters_and_escaped_ones() {
        assert_eq!(rows("a = '日本' .. n", Some(12..13), 80)[1], "              ^");
        assert_eq!(rows("a\u{1b}b", Some(2..3), 80), ["a\\u{1b}b", "       ^"]);
    }

    #[test]
    fn a_long_line_is_cut_around_its_columns() {
        let line = format!("{}here{}", "x + ".repeat(100), " + y".repeat(100));
        for width in [1, 12, 20, 80, 200] {
            let [text, carets] = rows(&line, Some(400..404), width);
            let width = width.max(NARROWEST);
            assert!(text.len() <= width && carets.len() <= width, "{width}: {text}");
            assert_eq!(&text[carets.trim_end_matches('^').len()..carets.len()], "here", "{width}: {text}");
        }
    }

    #[test]
    fn columns_outside_the_line_mark_its_text_and_a_password_stays_hidden() {
        assert_eq!(rows("abc", Some(9..12), 80)[1], "^^^");
        let [text, carets] = rows("source('postgres://me:secret@host/db')", Some(0..6), 80);
        assert_eq!((text.contains("secret"), carets.len()), (false, text.len()));
    }
}
