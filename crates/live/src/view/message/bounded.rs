//! Serialisation of messages with a limit on the length of strings.

use std::io;

use serde::Serialize;
use serde_json::ser::{CharEscape, CompactFormatter, Formatter, Serializer};

/// Maximum length (bytes) of a string in a message. Strings from scripts may have many millions.
const LONGEST: usize = 16_000;

/// Serialises `value` as JSON whose strings are cut to a length that pages can show.
pub(super) fn to_text(value: &impl Serialize) -> String {
    let mut bytes = Vec::with_capacity(256);
    let mut serializer = Serializer::with_formatter(&mut bytes, TextLimiter::default());
    // Keys are strings and numbers are finite or null, so serialisation cannot fail.
    let _ = value.serialize(&mut serializer);
    String::from_utf8(bytes).unwrap_or_default()
}

/// JSON formatter that cuts long strings, and appends the number of omitted bytes.
#[derive(Default)]
struct TextLimiter {
    /// Length of the current string (bytes).
    length: usize,
}

impl TextLimiter {
    /// Returns the number of `more` bytes that fit.
    fn room(&mut self, more: usize) -> usize {
        let room = LONGEST.saturating_sub(self.length);
        self.length += more;
        room.min(more)
    }
}

impl Formatter for TextLimiter {
    fn begin_string<W: ?Sized + io::Write>(&mut self, writer: &mut W) -> io::Result<()> {
        self.length = 0;
        CompactFormatter.begin_string(writer)
    }

    fn end_string<W: ?Sized + io::Write>(&mut self, writer: &mut W) -> io::Result<()> {
        let left_out = self.length.saturating_sub(LONGEST);
        if left_out > 0 {
            write!(writer, "… ({left_out} bytes more)")?;
        }
        CompactFormatter.end_string(writer)
    }

    fn write_string_fragment<W: ?Sized + io::Write>(
        &mut self,
        writer: &mut W,
        fragment: &str,
    ) -> io::Result<()> {
        let room = self.room(fragment.len());
        let end = (0..=room).rev().find(|end| fragment.is_char_boundary(*end)).unwrap_or(0);
        CompactFormatter.write_string_fragment(writer, &fragment[..end])
    }

    fn write_char_escape<W: ?Sized + io::Write>(
        &mut self,
        writer: &mut W,
        escape: CharEscape,
    ) -> io::Result<()> {
        if self.room(1) == 0 {
            return Ok(());
        }
        CompactFormatter.write_char_escape(writer, escape)
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;
    use serde_json::{Value, json};

    use super::*;

    #[test]
    fn a_long_text_is_cut_wherever_it_stands_and_short_ones_are_not() {
        for text in ["x".repeat(20_000_000), "\n".repeat(100_000), "ö\"\u{1}".repeat(100_000)] {
            let value = json!({ "a": [text, { "b": text }], "short": "a\"\n\u{1}…" });
            let cut = to_text(&value);
            assert!(cut.len() < 6 * 3 * LONGEST, "{}", cut.len());
            let read: Value = serde_json::from_str(&cut).unwrap();
            assert_eq!(read["short"], value["short"]);
            let end = format!("… ({} bytes more)", text.len() - LONGEST);
            assert!(read["a"][0].as_str().unwrap().ends_with(&end) && read["a"][0] == read["a"][1]["b"]);
        }
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(256))]
        #[test]
        fn what_is_short_is_as_without_a_bound(texts in prop::collection::vec(".{0,40}", 0..8), number: f64) {
            let value = json!({ "texts": texts, "number": number, "nothing": null });
            prop_assert_eq!(to_text(&value), value.to_string());
        }

        #[test]
        fn what_is_long_is_valid_and_begins_alike(text in "(\\PC|\n|\"|\u{7}){1,60}", times in 300usize..2_000) {
            let text = text.repeat(times);
            let read: String = serde_json::from_str(&to_text(&text)).unwrap();
            let kept = read.rsplit_once("… (").map_or(&read[..], |(kept, _)| kept);
            prop_assert!(text.starts_with(kept) && read.len() < LONGEST + 60);
            prop_assert!(kept.len() + 4 > LONGEST.min(text.len()));
        }
    }
}
