//! Escaping of text in XML.

use std::fmt::Write;

/// Maximum number of characters of a display name in an identifier.
const LONGEST: usize = 40;

/// Escapes `text` for an attribute in quotation marks. XML cannot represent most control characters, so they become
/// U+FFFD.
pub(super) fn escape_attribute(text: &str) -> String {
    let mut escaped = String::with_capacity(text.len());
    for letter in text.chars() {
        match letter {
            '&' => escaped.push_str("&amp;"),
            '<' => escaped.push_str("&lt;"),
            '>' => escaped.push_str("&gt;"),
            '\'' => escaped.push_str("&apos;"),
            '"' => escaped.push_str("&quot;"),
            // Readers would replace these characters by spaces.
            '\t' | '\n' | '\r' => {
                let _ = write!(escaped, "&#{};", u32::from(letter));
            }
            '\u{0}'..='\u{1f}' | '\u{7f}'..='\u{9f}' | '\u{fffe}' | '\u{ffff}' => escaped.push('\u{fffd}'),
            _ => escaped.push(letter),
        }
    }
    escaped
}

/// Escapes a list of strings with the single item `text` for an attribute.
pub(super) fn escape_list_item(text: &str) -> String {
    escape_attribute(&format!("\"{}\"", text.replace('\\', "\\\\").replace('"', "\\\"")))
}

/// Returns an identifier that is unique in the file: for item number `index` of type `kind` with the display name
/// `name`.
pub(super) fn identifier(kind: &str, index: usize, name: &str) -> String {
    let word = |letter: char| if letter.is_ascii_alphanumeric() { letter } else { '_' };
    let name: String = name.chars().take(LONGEST).map(word).collect();
    let name = name.trim_matches('_');
    if name.is_empty() { format!("{kind}_{index}") } else { format!("{kind}_{index}_{name}") }
}
