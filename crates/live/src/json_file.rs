//! JSON files that people read: one value on a line, points on a line of their own.

use std::io::{self, Write as _};
use std::path::Path;

use serde::Serialize as _;
use serde_json::Value;
use serde_json::ser::{Formatter, PrettyFormatter, Serializer};

use burgeon_base::error::Result;

/// Writes `value` to the file at `path`, completely or not at all.
pub(crate) fn write_json(path: &Path, value: &Value) -> Result<()> {
    burgeon_export::write_file(path, |out| writeln!(out, "{}", to_text(value)))
}

/// Returns `value` as JSON with a value on each line, but lists within lists on one line.
fn to_text(value: &Value) -> String {
    let mut bytes = Vec::new();
    let mut serializer = Serializer::with_formatter(&mut bytes, PointFormatter::default());
    // Keys are strings and the writer is memory, so serialisation cannot fail.
    let _ = value.serialize(&mut serializer);
    String::from_utf8(bytes).unwrap_or_default()
}

/// JSON formatter that writes lists within lists on one line.
#[derive(Default)]
struct PointFormatter {
    pretty: PrettyFormatter<'static>,
    /// Number of lists around the present position.
    lists: usize,
}

impl Formatter for PointFormatter {
    fn begin_array<W: ?Sized + io::Write>(&mut self, writer: &mut W) -> io::Result<()> {
        self.lists += 1;
        if self.lists > 1 { writer.write_all(b"[") } else { self.pretty.begin_array(writer) }
    }

    fn end_array<W: ?Sized + io::Write>(&mut self, writer: &mut W) -> io::Result<()> {
        let is_inner = self.lists > 1;
        self.lists -= 1;
        if is_inner { writer.write_all(b"]") } else { self.pretty.end_array(writer) }
    }

    fn begin_array_value<W: ?Sized + io::Write>(&mut self, writer: &mut W, first: bool) -> io::Result<()> {
        match (self.lists > 1, first) {
            (true, true) => Ok(()),
            (true, false) => writer.write_all(b", "),
            (false, _) => self.pretty.begin_array_value(writer, first),
        }
    }

    fn end_array_value<W: ?Sized + io::Write>(&mut self, writer: &mut W) -> io::Result<()> {
        self.pretty.end_array_value(writer)
    }

    fn begin_object<W: ?Sized + io::Write>(&mut self, writer: &mut W) -> io::Result<()> {
        self.pretty.begin_object(writer)
    }

    fn end_object<W: ?Sized + io::Write>(&mut self, writer: &mut W) -> io::Result<()> {
        self.pretty.end_object(writer)
    }

    fn begin_object_key<W: ?Sized + io::Write>(&mut self, writer: &mut W, first: bool) -> io::Result<()> {
        self.pretty.begin_object_key(writer, first)
    }

    fn begin_object_value<W: ?Sized + io::Write>(&mut self, writer: &mut W) -> io::Result<()> {
        self.pretty.begin_object_value(writer)
    }

    fn end_object_value<W: ?Sized + io::Write>(&mut self, writer: &mut W) -> io::Result<()> {
        self.pretty.end_object_value(writer)
    }
}

#[cfg(test)]
mod tests {
    use serde_json::json;

    use super::*;

    #[test]
    fn points_are_on_a_line_of_their_own() {
        let value = json!({ "a": { "taper": [[0, 1], [1, 0.25]], "none": [] }, "b": [1, "x"], "c": [[]] });
        insta::assert_snapshot!(to_text(&value), @r#"
        {
          "a": {
            "taper": [
              [0, 1],
              [1, 0.25]
            ],
            "none": []
          },
          "b": [
            1,
            "x"
          ],
          "c": [
            []
          ]
        }
        "#);
        assert_eq!(serde_json::from_str::<Value>(&to_text(&value)).unwrap(), value);
    }
}
