//! Colours and width of messages on a terminal.

use std::borrow::Cow;
use std::io::IsTerminal as _;
use std::sync::OnceLock;

/// Number of cells of a message that no terminal shows.
const WIDEST: usize = 164;

const RED: &str = "\u{1b}[1;31m";
const YELLOW: &str = "\u{1b}[1;33m";
const CYAN: &str = "\u{1b}[1;36m";
const GREEN: &str = "\u{1b}[32m";
const RESET: &str = "\u{1b}[0m";

/// Returns the number of cells in a row of the terminal that shows standard error, or that of a wide one.
pub(super) fn width() -> usize {
    if !std::io::stderr().is_terminal() {
        return WIDEST;
    }
    console::Term::stderr()
        .size_checked()
        .map_or(WIDEST, |(_, columns)| usize::from(columns).clamp(1, WIDEST))
}

/// Colours the beginnings of the lines of a message, if standard error shows colours.
pub(super) fn with_colors(text: &str) -> Cow<'_, str> {
    static SHOWS_COLORS: OnceLock<bool> = OnceLock::new();
    let set = |name: &str| std::env::var(name).ok().filter(|value| !value.is_empty());
    let shows = SHOWS_COLORS.get_or_init(|| shows_colors(set, std::io::stderr().is_terminal()));
    if *shows { Cow::Owned(color_lines(text)) } else { Cow::Borrowed(text) }
}

/// Returns true if messages have colours, given the variables of the environment and the kind of the output.
fn shows_colors(set: impl Fn(&str) -> Option<String>, is_terminal: bool) -> bool {
    let is = |name: &str, value: &str| set(name).is_some_and(|found| found == value);
    if set("NO_COLOR").is_some() {
        return false;
    }
    if set("CLICOLOR_FORCE").is_some_and(|value| value != "0") {
        return true;
    }
    is_terminal && !is("CLICOLOR", "0") && !is("TERM", "dumb")
}

/// Colours the words `error`, `warning`, `note` and `help` at the beginnings of lines, and carets.
fn color_lines(text: &str) -> String {
    let mut colored = String::with_capacity(text.len() + 64);
    for line in text.split_inclusive('\n') {
        let (line, end) = line.strip_suffix('\n').map_or((line, ""), |line| (line, "\n"));
        let words = [("error:", RED), ("warning:", YELLOW), ("note:", CYAN), ("  help:", GREEN)];
        let word = words.iter().find_map(|(word, color)| Some((word, color, line.strip_prefix(word)?)));
        let carets = line
            .strip_prefix("  | ")
            .filter(|row| !row.is_empty() && row.trim_matches([' ', '^']).is_empty());
        match (word, carets) {
            (Some((word, color, rest)), _) => colored.push_str(&format!("{color}{word}{RESET}{rest}")),
            (None, Some(carets)) => colored.push_str(&format!("  | {RED}{carets}{RESET}")),
            (None, None) => colored.push_str(line),
        }
        colored.push_str(end);
    }
    colored
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_environment_decides_on_colours_before_the_terminal_does() {
        let shows = |set: &[(&str, &str)], is_terminal: bool| {
            let find = |name: &str| Some(set.iter().find(|(known, _)| *known == name)?.1.to_owned());
            shows_colors(find, is_terminal)
        };
        assert!(shows(&[], true) && !shows(&[], false));
        assert!(!shows(&[("NO_COLOR", "1")], true) && shows(&[("CLICOLOR_FORCE", "1")], false));
        assert!(!shows(&[("NO_COLOR", "1"), ("CLICOLOR_FORCE", "1")], true));
        assert!(!shows(&[("CLICOLOR_FORCE", "0")], false) && !shows(&[("CLICOLOR", "0")], true));
        assert!(!shows(&[("TERM", "dumb")], true) && shows(&[("TERM", "xterm")], true));
    }

    #[test]
    fn colours_change_no_letter() {
        let text = "error: s.lua:1:3: no\n  | a ^ b\n  |   ^\n  help: yes\nwarning: x\nplain";
        let mut plain = color_lines(text);
        assert_eq!(plain.matches(RESET).count(), 4);
        for color in [RED, YELLOW, CYAN, GREEN, RESET] {
            plain = plain.replace(color, "");
        }
        assert_eq!(plain, text);
    }
}
