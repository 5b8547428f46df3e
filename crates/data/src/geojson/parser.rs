//! Messages of the JSON parser, and the size from which its memory is reserved.

use burgeon_base::text::shown;

/// Length (bytes) from which memory is reserved before the properties of a feature are parsed.
pub(super) const LARGE: usize = 1 << 20;

/// Returns the parser's message, without the position within a part of the text.
pub(super) fn parser_message(error: &serde_json::Error) -> String {
    let text = error.to_string();
    let why = text.rsplit_once(" at line ").map_or(text.as_str(), |(why, _)| why);
    let why = why.replace("struct RawFeature", "a feature").replace("a map", "an object");
    let why = why.replace("struct RawGeometry", "a geometry");
    shown(&why).into_owned()
}
