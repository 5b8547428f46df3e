//! The kinds of streets, as scripts write them.

use std::sync::Arc;

use burgeon_kit::{Color, Expectation, Field, Parameter, Table, Value, fields};
use burgeon_streets::StreetKind;

/// The width (m) of a sidewalk that is not told, and the part of the street's width that it is at most.
const SIDEWALK: f64 = 2.5;
const SIDEWALK_PART: f64 = 0.2;

/// A kind of streets.
#[fields("street")]
#[derive(PartialEq)]
pub struct StreetOptions {
    /// What streets of it are called in layers, such as "avenue"; "kind 1" and so on if it is left out.
    pub name: Option<String>,
    /// Width (m) from one outer edge of the sidewalks to the other.
    #[default(12.0)]
    pub width: f64,
    /// Colour of its carriageway; that of all streets if it is left out.
    pub asphalt: Option<Color>,
    /// Width (m) of the sidewalk on each side; 2.5 if it is left out, or a fifth of the width if that is less.
    pub sidewalk: Option<f64>,
    /// The number of lanes for both directions; as many as fit, if it is left out.
    pub lanes: Option<u32>,
    /// Width (m) of a raised strip between the two directions.
    #[default(0.0)]
    pub median: f64,
    /// Width (m) of a strip to park on, on each side.
    #[default(0.0)]
    pub parking: f64,
    /// Distance (m) of trees along each sidewalk, and in the median; 0 for none.
    #[default(0.0)]
    pub trees: f64,
    /// Distance (m) of lamps along each sidewalk; 0 for none.
    #[default(0.0)]
    pub lamps: f64,
}

impl StreetOptions {
    /// One of this width (m), and the rest as it is usual.
    pub(super) fn of_width(width: f64) -> Self {
        Self { width, ..Self::default() }
    }

    /// What streets of it are made of.
    pub(super) fn kind(&self) -> StreetKind {
        StreetKind {
            width: self.width,
            sidewalk: self.sidewalk.unwrap_or_else(|| SIDEWALK.min(self.width * SIDEWALK_PART)),
            lanes: self.lanes,
            median: self.median,
            parking: self.parking,
            trees: self.trees,
            lamps: self.lamps,
        }
    }
}

impl Parameter for StreetOptions {
    fn luau() -> String {
        "{ name: string?, width: number?, asphalt: Color?, sidewalk: number?, lanes: number?, median: number?, parking: number?, trees: number?, lamps: number? }"
            .into()
    }

    fn fields() -> Vec<Field> {
        Self::fields()
    }

    fn from_value(value: Value) -> Result<Self, Expectation> {
        let Value::Table(table) = &value else {
            return Err(Expectation::new("a table of a street's fields: { width = 14, lanes = 2 }"));
        };
        Self::from_table(table)
            .map_err(|error| Expectation::new(format!("a kind of street ({})", error.message())))
    }

    fn into_value(self) -> Value {
        Value::Table(Arc::new(Table::default()))
    }
}
