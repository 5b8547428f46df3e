//! Value of an attribute of a feature.

use std::sync::Arc;

/// Value of an attribute.
#[derive(Debug, Clone, PartialEq)]
pub enum Attribute {
    /// True or false.
    Boolean(bool),
    /// Finite number.
    Number(f64),
    /// Text.
    Text(Arc<str>),
    /// GeoJSON list or object.
    Nested(Arc<serde_json::Value>),
}

impl Attribute {
    /// Returns the approximate memory (bytes) used in addition to the entry in a list.
    pub fn weight(&self) -> usize {
        fn nested(value: &serde_json::Value) -> usize {
            use serde_json::Value as Json;
            match value {
                Json::String(text) => 80 + text.len(),
                Json::Array(items) => 80 + items.iter().map(nested).sum::<usize>(),
                Json::Object(fields) => {
                    80 + fields.iter().map(|(name, value)| 80 + name.len() + nested(value)).sum::<usize>()
                }
                _ => 80,
            }
        }
        match self {
            Self::Boolean(_) | Self::Number(_) => 0,
            Self::Text(text) => 16 + text.len(),
            Self::Nested(value) => nested(value),
        }
    }

    /// Returns the type name: `boolean`, `number`, `text` or `table`.
    pub fn kind(&self) -> &'static str {
        match self {
            Self::Boolean(_) => "boolean",
            Self::Number(_) => "number",
            Self::Text(_) => "text",
            Self::Nested(_) => "table",
        }
    }

    /// Returns the value as a number, also if it is a text that is one; `None` for other values.
    pub fn number(&self) -> Option<f64> {
        match self {
            Self::Number(value) => Some(*value),
            Self::Text(text) => text.trim().parse().ok(),
            Self::Boolean(_) | Self::Nested(_) => None,
        }
    }

    /// Returns the value as text; lists and tables as JSON.
    pub fn text(&self) -> String {
        match self {
            Self::Boolean(value) => value.to_string(),
            Self::Number(value) => value.to_string(),
            Self::Text(text) => text.to_string(),
            Self::Nested(value) => value.to_string(),
        }
    }
}
