//! Street lines with the attributes of their features.

use std::fmt;
use std::sync::Arc;

use burgeon_data::{Attribute, Features, Layer};
use burgeon_geometry::Line;
use burgeon_kit::{Expectation, Parameter, Table, Value};
use burgeon_spatial::{Geometry, Lines};
use glam::DVec3;

/// Maximum nesting depth of lists.
const DEEPEST: usize = 4;

/// A number for all lines, or the name of an attribute of each line.
#[derive(Debug, Clone, PartialEq)]
pub enum ByLine {
    /// Number for all lines.
    Number(f64),
    /// Name of the attribute with the number of each line.
    Attribute(String),
}

impl Parameter for ByLine {
    fn luau() -> String {
        "number | string".into()
    }

    fn from_value(value: Value) -> Result<Self, Expectation> {
        match value {
            Value::Number(number) if number.is_finite() => Ok(Self::Number(number)),
            Value::Text(name) => Ok(Self::Attribute(name.to_string())),
            _ => Err(Expectation::new("a number or the name of an attribute")),
        }
    }

    fn into_value(self) -> Value {
        match self {
            Self::Number(number) => Value::Number(number),
            Self::Attribute(name) => Value::Text(name.into()),
        }
    }
}

/// Lines (m) of a source, of features, of geometries or of lists of points.
#[derive(Debug, Clone, Default)]
pub struct StreetLines {
    pub(super) lines: Vec<ExistingLine>,
    /// Number of list items that are not lines, and the first error.
    pub(super) refused: Option<(usize, String)>,
}

/// A line and its attributes.
#[derive(Debug, Clone)]
pub(super) struct ExistingLine {
    pub(super) line: Line<DVec3>,
    pub(super) id: Option<String>,
    facts: LineFacts,
}

/// The location of a line's attributes.
#[derive(Debug, Clone)]
enum LineFacts {
    None,
    Table(Arc<Table>),
    /// Layer, and the index of the feature in it.
    Layer(Arc<Layer>, usize),
}

/// The value of an attribute.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum LineFact<'a> {
    Boolean(bool),
    Number(f64),
    Text(&'a str),
}

impl LineFact<'_> {
    /// Returns the string, if the value is a string that is not blank.
    pub(super) fn text(&self) -> Option<String> {
        match self {
            Self::Text(text) if !text.trim().is_empty() => Some((*text).to_string()),
            _ => None,
        }
    }

    /// Returns the value as it appears in a message.
    pub(super) fn display_text(&self) -> String {
        match self {
            Self::Text(text) => format!("{:?}", text.chars().take(40).collect::<String>()),
            other => other.to_string(),
        }
    }
}

impl fmt::Display for LineFact<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Boolean(value) => value.fmt(f),
            Self::Number(value) => value.fmt(f),
            Self::Text(value) => value.fmt(f),
        }
    }
}

/// Returns the number that an attribute is or begins with, such as 7.5 of "7.5 m", or `None`.
pub(super) fn number_of(fact: &LineFact<'_>) -> Option<f64> {
    match fact {
        LineFact::Number(number) => Some(*number).filter(|number| number.is_finite()),
        LineFact::Boolean(_) => None,
        LineFact::Text(text) => {
            let text = text.trim();
            let is_number = |at: char| at.is_ascii_digit() || matches!(at, '.' | '-' | '+');
            let end = text.find(|at| !is_number(at)).unwrap_or(text.len());
            text[..end].parse().ok().filter(|number: &f64| number.is_finite())
        }
    }
}

/// Returns true if an attribute is set: any value except no, false, none, 0 or a blank string.
pub(super) fn is_set(fact: &LineFact<'_>) -> bool {
    match fact {
        LineFact::Boolean(value) => *value,
        LineFact::Number(value) => *value != 0.0,
        LineFact::Text(text) => {
            !matches!(text.trim().to_ascii_lowercase().as_str(), "" | "no" | "false" | "0" | "none")
        }
    }
}

impl ExistingLine {
    /// Returns an attribute of the line, or `None` if there is no attribute of that name.
    pub(super) fn fact<'a>(&'a self, name: &str) -> Option<LineFact<'a>> {
        match &self.facts {
            LineFacts::None => None,
            LineFacts::Table(table) => match table.get(name)? {
                Value::Boolean(value) => Some(LineFact::Boolean(*value)),
                Value::Number(value) => Some(LineFact::Number(*value)),
                Value::Text(value) => Some(LineFact::Text(value)),
                _ => None,
            },
            LineFacts::Layer(layer, feature) => {
                let column = layer.names.iter().position(|known| known == name)?;
                let attributes = &layer.features.get(*feature)?.attributes;
                match &attributes.iter().find(|(known, _)| *known == column)?.1 {
                    Attribute::Boolean(value) => Some(LineFact::Boolean(*value)),
                    Attribute::Number(value) => Some(LineFact::Number(*value)),
                    Attribute::Text(value) => Some(LineFact::Text(value)),
                    Attribute::Nested(_) => None,
                }
            }
        }
    }
}

impl Parameter for StreetLines {
    fn luau() -> String {
        "any".into()
    }

    fn from_value(value: Value) -> Result<Self, Expectation> {
        let mut lines = Self::default();
        lines.collect(&value, 0)?;
        Ok(lines)
    }

    fn into_value(self) -> Value {
        self.lines
            .into_iter()
            .map(|line| Geometry::Line(line.line.into_points()).into_value())
            .collect::<Vec<_>>()
            .into_value()
    }
}

impl StreetLines {
    /// Adds the lines of a value, as [`Lines`] finds them, with the attributes of the value's feature.
    fn collect(&mut self, value: &Value, depth: usize) -> Result<(), Expectation> {
        let layer = match value {
            Value::Object(object) => {
                let any: &dyn std::any::Any = &**object;
                any.downcast_ref::<Features>()
            }
            _ => None,
        };
        if let Some(Features(layer)) = layer {
            for (number, feature) in layer.features.iter().enumerate() {
                let facts = LineFacts::Layer(Arc::clone(layer), number);
                self.add(Lines::of(&feature.geometry), &facts, Some(feature.id.to_string()));
            }
            return Ok(());
        }
        let Value::Table(table) = value else {
            self.add(Lines::read_value(value)?, &LineFacts::None, None);
            return Ok(());
        };
        if table.get("geometry").is_some() {
            let id = match table.get("id") {
                Some(Value::Text(id)) => Some(id.to_string()),
                Some(Value::Number(id)) => Some(Value::Number(*id).to_string()),
                _ => None,
            };
            let facts = LineFacts::Table(Arc::clone(table));
            self.add(Lines::read_value(value)?, &facts, id);
            return Ok(());
        }
        let list = table.list();
        let is_nested = |item: &Value| match item {
            Value::Object(_) => true,
            Value::Table(table) => {
                table.get("geometry").is_some()
                    || matches!(table.list().first(), Some(Value::Table(_) | Value::Object(_)))
            }
            _ => false,
        };
        if depth > DEEPEST || list.len() != table.entries.len() || !list.iter().copied().any(is_nested) {
            self.add(Lines::read_value(value)?, &LineFacts::None, None);
            return Ok(());
        }
        // An invalid item of a list does not affect the other items.
        let (mut good, mut bad) = (0, None);
        for (number, item) in (1..).zip(list) {
            match self.collect(item, depth + 1) {
                Ok(()) => good += 1,
                Err(error) => {
                    let (count, _) = self.refused.get_or_insert_with(|| (0, error.item(number)));
                    *count += 1;
                    bad.get_or_insert(error);
                }
            }
        }
        match (good, bad) {
            (0, Some(error)) => Err(error),
            _ => Ok(()),
        }
    }

    fn add(&mut self, found: Lines, facts: &LineFacts, id: Option<String>) {
        if let Some((more, first)) = found.refused {
            let (count, _) = self.refused.get_or_insert((0, first));
            *count += more;
        }
        let lines = found.lines.into_iter();
        self.lines.extend(lines.map(|line| ExistingLine { line, id: id.clone(), facts: facts.clone() }));
    }
}
