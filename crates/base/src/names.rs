//! Human-readable names: names that look alike compare as equal, and no name is displayed in another order than it is
//! written.

use std::borrow::Cow;

use unicode_normalization::{UnicodeNormalization, is_nfc};

/// Returns the name in Unicode normal form C, in which names are compared: `é` as one character and as two are the
/// same.
pub fn normal_form(name: &str) -> Cow<'_, str> {
    if is_nfc(name) { Cow::Borrowed(name) } else { Cow::Owned(name.nfc().collect()) }
}

/// Returns true if `name` has characters that change the text direction, so that `a\u{202e}gpj.lua` is displayed as
/// `aaul.jpg`.
pub fn has_bidi_controls(name: &str) -> bool {
    name.contains(|c| matches!(c, '\u{61c}' | '\u{200e}' | '\u{200f}' | '\u{202a}'..='\u{202e}' | '\u{2066}'..='\u{2069}'))
}

/// Returns the name with its case folded, for comparison on systems that ignore case.
///
/// ```
/// use burgeon_base::names::fold_case;
///
/// assert_eq!(fold_case("STRASSE"), fold_case("straße"));
/// assert_ne!(fold_case("a"), fold_case("á"));
/// ```
pub fn fold_case(name: &str) -> String {
    // Changing the case can produce text that is not in normal form, and normalization can produce other case mappings.
    let lower = normal_form(name).to_lowercase();
    normal_form(&normal_form(&lower).to_uppercase()).to_lowercase()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_that_look_alike_are_one() {
        assert_eq!(normal_form("e\u{301}"), "é");
        assert_eq!(fold_case("E\u{301}COLE"), fold_case("\u{e9}cole"));
        assert_eq!(fold_case("STRASSE"), fold_case("straße"));
        assert_ne!(fold_case("a"), fold_case("á"));
        assert!(has_bidi_controls("a\u{202e}b") && !has_bidi_controls("日本 é"));
    }
}
