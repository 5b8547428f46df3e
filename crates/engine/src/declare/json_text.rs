//! JSON files with the lines of their values, for messages.
//!
//! Input: the text of a file. Output: its members and points as written, and errors with the line.

use std::fmt;

use rustc_hash::FxHashSet;
use serde::de::{Deserializer, MapAccess, Visitor};
use serde_json::value::RawValue;

use burgeon_base::error::{Error, Result, SourcePlace};
use burgeon_base::names::normal_form;
use burgeon_kit::PointRows;

/// Text of a JSON file during parsing.
#[derive(Debug)]
pub struct JsonText<'a> {
    name: String,
    text: &'a str,
}

/// Members of a JSON object in their order, with their values as written.
pub type JsonMembers<'a> = Vec<(String, &'a RawValue)>;

/// Control points of a JSON file, and the line of each.
#[derive(Debug, Clone, PartialEq)]
pub struct PlacedPoints {
    /// Points.
    pub points: PointRows,
    /// Location of each point.
    pub places: Vec<SourcePlace>,
}

impl<'a> JsonText<'a> {
    /// Wraps the `text` of the file with this display name.
    pub fn new(name: String, text: &'a str) -> Self {
        Self { name, text }
    }

    /// Returns the value of the file. Fails with the line if the text is not JSON.
    pub fn value(&self) -> Result<&'a RawValue> {
        serde_json::from_str(self.text.trim_start_matches('\u{feff}')).map_err(|error| {
            Error::data(format!("this is not JSON: {}", reason(&error)))
                .at_line(&self.name, error.line().max(1))
                .help("fix the file, or move it away")
        })
    }

    /// Returns the members of `raw`, called `what` in messages. Fails, with the correct `form` as remedy, if `raw` is
    /// not an object or has two members of one name.
    pub fn members(&self, raw: &'a RawValue, what: &str, form: &str) -> Result<JsonMembers<'a>> {
        let refuse = |message: String, raw: &RawValue| Error::data(message).at(Some(self.place(raw)));
        let members = if raw.get().starts_with('{') { read_members(raw.get()).ok() } else { None };
        let members = members.ok_or_else(|| {
            refuse(format!("{what} is {}, not an object", json_excerpt(raw)), raw)
                .help(format!("write {form}"))
        })?;
        let mut known = FxHashSet::default();
        for (name, raw) in &members {
            if !known.insert(normal_form(name)) {
                return Err(refuse(format!("{what} has two members named `{name}`"), raw)
                    .help("remove or rename one of them"));
            }
        }
        Ok(members)
    }

    /// Returns the points in `raw`, called `what` in messages. Fails if `raw` is not a list of points.
    pub fn points(&self, raw: &'a RawValue, what: &str) -> Result<PlacedPoints> {
        let (points, raws) = read_points(raw, what, &|raw| Some(self.place(raw)))?;
        Ok(PlacedPoints { points, places: raws.into_iter().map(|raw| self.place(raw)).collect() })
    }

    /// Returns the line on which `raw`, a part of the text, begins.
    pub fn place(&self, raw: &RawValue) -> SourcePlace {
        let from = (raw.get().as_ptr() as usize).saturating_sub(self.text.as_ptr() as usize);
        let before = self.text.as_bytes().get(..from).unwrap_or_default();
        let line = 1 + before.iter().filter(|byte| **byte == b'\n').count();
        SourcePlace::new(self.name.as_str(), line)
    }
}

/// Parses control points, `[[0, 1], [1, 0.2]]`, that a user gives for `what`.
pub(crate) fn parse_points(text: &str, what: &str) -> Result<PointRows> {
    let raw: &RawValue = serde_json::from_str(text).map_err(|error| {
        let shown: String = text.chars().take(40).collect();
        Error::argument(format!("{what} must be points, not {shown:?}: {}", reason(&error)))
            .help("write a list of points: [[0, 1], [1, 0.2]]")
    })?;
    Ok(read_points(raw, what, &|_| None)?.0)
}

/// Returns the points in `raw`, and each as written.
fn read_points<'a>(
    raw: &'a RawValue,
    what: &str,
    place: &dyn Fn(&RawValue) -> Option<SourcePlace>,
) -> Result<(PointRows, Vec<&'a RawValue>)> {
    let refuse = |message: String, raw: &RawValue| {
        Error::data(message).help("write a list of points: [[0, 1], [1, 0.2]]").at(place(raw))
    };
    let raws: Vec<&RawValue> = serde_json::from_str(raw.get())
        .map_err(|_| refuse(format!("{what} is {}, not a list of points", json_excerpt(raw)), raw))?;
    let mut points = Vec::with_capacity(raws.len());
    for (index, raw) in raws.iter().enumerate() {
        let row: Vec<f64> = serde_json::from_str(raw.get()).map_err(|_| {
            let number = index + 1;
            refuse(format!("{what}: point {number} is {}, not a list of numbers", json_excerpt(raw)), raw)
        })?;
        points.push(row);
    }
    Ok((PointRows(points), raws))
}

/// Returns the reason of a JSON error, without its position.
fn reason(error: &serde_json::Error) -> String {
    let mut said = error.to_string();
    said.truncate(said.find(" at line ").unwrap_or(said.len()));
    said
}

/// Returns the text of `raw`, shortened for messages.
pub fn json_excerpt(raw: &RawValue) -> String {
    let text: String = raw.get().split_whitespace().collect::<Vec<_>>().join(" ");
    if text.chars().count() <= 40 { text } else { text.chars().take(39).chain(['…']).collect() }
}

fn read_members(text: &str) -> serde_json::Result<JsonMembers<'_>> {
    struct MembersVisitor;
    impl<'de> Visitor<'de> for MembersVisitor {
        type Value = JsonMembers<'de>;

        fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
            f.write_str("an object")
        }

        fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<Self::Value, A::Error> {
            let mut members = Vec::new();
            while let Some(member) = map.next_entry()? {
                members.push(member);
            }
            Ok(members)
        }
    }
    serde_json::Deserializer::from_str(text).deserialize_map(MembersVisitor)
}
