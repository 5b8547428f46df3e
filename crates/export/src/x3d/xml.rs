//! Text as XML holds it.

use std::fmt::Write;

/// The most letters of a name for people in one for programs.
const LONGEST: usize = 40;

/// `text` between the quotation marks of an attribute. XML has no way to write most control characters: they become
/// U+FFFD.
pub(super) fn escaped(text: &str) -> String {
    let mut escaped = String::with_capacity(text.len());
    for letter in text.chars() {
        match letter {
            '&' => escaped.push_str("&amp;"),
            '<' => escaped.push_str("&lt;"),
            '>' => escaped.push_str("&gt;"),
            '\'' => escaped.push_str("&apos;"),
            '"' => escaped.push_str("&quot;"),
            // Readers would make blanks of these.
            '\t' | '\n' | '\r' => {
                let _ = write!(escaped, "&#{};", u32::from(letter));
            }
            '\u{0}'..='\u{1f}' | '\u{7f}'..='\u{9f}' | '\u{fffe}' | '\u{ffff}' => escaped.push('\u{fffd}'),
            _ => escaped.push(letter),
        }
    }
    escaped
}

/// A list of strings that has `text` alone, as an attribute holds it.
pub(super) fn listed(text: &str) -> String {
    escaped(&format!("\"{}\"", text.replace('\\', "\\\\").replace('"', "\\\"")))
}

/// A name that nothing else in the file has: thing number `index` of a `kind`, which people call `name`.
pub(super) fn identifier(kind: &str, index: usize, name: &str) -> String {
    let word = |letter: char| if letter.is_ascii_alphanumeric() { letter } else { '_' };
    let name: String = name.chars().take(LONGEST).map(word).collect();
    let name = name.trim_matches('_');
    if name.is_empty() { format!("{kind}_{index}") } else { format!("{kind}_{index}_{name}") }
}
