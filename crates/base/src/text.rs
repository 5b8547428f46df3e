//! Untrusted text for display: control characters are escaped, and long text is shortened.

use std::borrow::Cow;
use std::fmt::Write as _;

/// Maximum length of a shown name or id (characters).
const LONGEST: usize = 80;

/// Escapes `text` to one line, including all characters that control a terminal or change adjacent text.
///
/// ```
/// use burgeon_base::text::escaped;
///
/// assert_eq!(escaped("two\nlines\u{1b}[2J"), "two\\nlines\\u{1b}[2J");
/// assert_eq!(escaped("Größe 日本"), "Größe 日本");
/// ```
pub fn escaped(text: &str) -> Cow<'_, str> {
    escape(text, |_| false)
}

/// Escapes `text` like [`escaped`], but keeps line breaks and tabs.
pub fn escaped_lines(text: &str) -> Cow<'_, str> {
    escape(text, |letter| matches!(letter, '\n' | '\t'))
}

/// Formats a name or an id for a message: escapes it, and shortens long text.
pub fn shown(text: &str) -> Cow<'_, str> {
    // Passwords are hidden first, because a password in a truncated address cannot be recognized.
    let known = without_passwords(text);
    match (known.char_indices().nth(LONGEST), &known) {
        (Some((end, _)), known) => Cow::Owned(format!("{}...", escaped(&known[..end]))),
        (None, Cow::Borrowed(text)) => escaped(text),
        (None, Cow::Owned(text)) => Cow::Owned(escaped(text).into_owned()),
    }
}

/// Joins the first names of a list, and adds the number of the others.
pub fn listed<'a>(names: impl ExactSizeIterator<Item = &'a str>) -> String {
    const MOST: usize = 20;
    let count = names.len();
    let some: Vec<_> = names.take(MOST).map(shown).collect();
    let more = if count > MOST { format!(" and {} more", count - MOST) } else { String::new() };
    format!("{}{more}", some.join(", "))
}

/// Replaces each password in an address such as `postgres://user:password@host/database` by `***`.
///
/// ```
/// use burgeon_base::text::without_passwords;
///
/// assert_eq!(without_passwords("read postgres://me:secret@host/db"), "read postgres://me:***@host/db");
/// assert_eq!(without_passwords("mail me@host"), "mail me@host");
/// ```
pub fn without_passwords(text: &str) -> Cow<'_, str> {
    let mut made = String::new();
    let mut rest = text;
    while let Some(found) = rest.find("://") {
        let (before, address) = rest.split_at(found + 3);
        made.push_str(before);
        // An address ends where a word or a string ends.
        let end = address.find(|letter: char| letter.is_whitespace() || "\"'`<>".contains(letter));
        let (address, after) = address.split_at(end.unwrap_or(address.len()));
        match address.rfind('@').and_then(|at| Some((address[..at].find(':')?, at))) {
            Some((colon, at)) => {
                made.push_str(&address[..=colon]);
                made.push_str("***");
                made.push_str(&address[at..]);
            }
            None => made.push_str(address),
        }
        rest = after;
    }
    if made.is_empty() {
        return Cow::Borrowed(text);
    }
    made.push_str(rest);
    Cow::Owned(made)
}

fn escape(text: &str, stays: impl Fn(char) -> bool) -> Cow<'_, str> {
    let obeyed = |letter: char| is_obeyed(letter) && !stays(letter);
    if !text.contains(obeyed) {
        return Cow::Borrowed(text);
    }
    let mut escaped = String::with_capacity(text.len() + 16);
    for letter in text.chars() {
        match letter {
            '\n' if obeyed(letter) => escaped.push_str("\\n"),
            '\r' => escaped.push_str("\\r"),
            '\t' if obeyed(letter) => escaped.push_str("\\t"),
            // Writing to a string cannot fail.
            letter if obeyed(letter) => drop(write!(escaped, "\\u{{{:x}}}", u32::from(letter))),
            letter => escaped.push(letter),
        }
    }
    Cow::Owned(escaped)
}

/// Returns true for characters that a terminal does not simply display: control characters, line breaks, and characters
/// that change the text direction.
fn is_obeyed(letter: char) -> bool {
    letter.is_control()
        || matches!(letter, '\u{200e}' | '\u{200f}' | '\u{2028}'..='\u{202e}' | '\u{2066}'..='\u{2069}')
}

/// Formats an integer with commas between thousands.
///
/// ```
/// use burgeon_base::text::grouped;
///
/// assert_eq!([999, 1000, 1234567].map(grouped), ["999", "1,000", "1,234,567"]);
/// ```
pub fn grouped(number: usize) -> String {
    let digits = number.to_string();
    let mut text = String::new();
    for (index, digit) in digits.chars().enumerate() {
        if index > 0 && (digits.len() - index).is_multiple_of(3) {
            text.push(',');
        }
        text.push(digit);
    }
    text
}

/// Formats a number for a message. Very large numbers get an exponent, which is clearer than all digits.
pub fn number(value: f64) -> String {
    if value.is_finite() && value.abs() >= 1e15 { format!("{value:e}") } else { value.to_string() }
}

/// Returns the message of a panic.
pub fn panic_message(panic: &(dyn std::any::Any + Send)) -> &str {
    let text = panic.downcast_ref::<String>().map(String::as_str).or(panic.downcast_ref::<&str>().copied());
    text.unwrap_or("without a message")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn passwords_in_addresses_are_hidden_and_nothing_else() {
        for (text, hidden) in [
            ("postgres://me:pw@host/db", "postgres://me:***@host/db"),
            ("read \"x://a:b@c\" and 'y://d:e/f@g:1/h'", "read \"x://a:***@c\" and 'y://d:***@g:1/h'"),
            ("postgres://me:p@w:x@host/db:layer", "postgres://me:***@host/db:layer"),
        ] {
            assert_eq!(without_passwords(text), hidden);
        }
        for text in ["http://host:80/a", "postgres://me@host/db", "a: b@c", "://", "x://:"] {
            assert_eq!(without_passwords(text), text);
        }
        let long = format!("postgres://me:{}@host/db", "pw".repeat(100));
        assert!(!shown(&long).contains("pw"));
    }

    #[test]
    fn what_a_terminal_would_obey_is_written_out() {
        assert_eq!(escaped("a\u{1b}[2J\u{9b}1m\r\n\u{202e}é"), "a\\u{1b}[2J\\u{9b}1m\\r\\n\\u{202e}é");
        assert_eq!(escaped_lines("a\n\tb\u{7}"), "a\n\tb\\u{7}");
        assert!(matches!(escaped("plain"), Cow::Borrowed(_)));
        for letter in (0..=0x10_ffff).filter_map(char::from_u32) {
            assert!(!escaped(&letter.to_string()).contains(char::is_control), "{letter:?}");
        }
    }

    #[test]
    fn very_large_numbers_are_written_with_an_exponent() {
        let written = [1e300, -1.5e15, 999_999_999_999_999.0, 0.25, f64::INFINITY].map(number);
        assert_eq!(written, ["1e300", "-1.5e15", "999999999999999", "0.25", "inf"]);
    }

    #[test]
    fn long_names_and_many_are_cut() {
        assert_eq!(shown(&"é".repeat(200)).chars().count(), LONGEST + 3);
        let names: Vec<String> = (0..30).map(|number| number.to_string()).collect();
        assert!(listed(names.iter().map(String::as_str)).ends_with("18, 19 and 10 more"));
    }
}
