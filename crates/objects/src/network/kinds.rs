//! The types of streets, as scripts define them.

use std::sync::Arc;

use burgeon_kit::{Color, Expectation, Field, Parameter, Table, Value, fields};
use burgeon_streets::StreetKind;

/// Default width (m) of a sidewalk. `SIDEWALK_PART` is its maximum as a fraction of the street's width.
const SIDEWALK: f64 = 2.5;
const SIDEWALK_PART: f64 = 0.2;

/// A type of street.
#[fields("street")]
#[derive(PartialEq)]
pub struct StreetOptions {
    /// Name of the street type in layers, such as "avenue". If omitted, "kind 1" and so on.
    pub name: Option<String>,
    /// Width (m) between the outer edges of the sidewalks.
    #[default(12.0)]
    pub width: f64,
    /// Colour of the carriageway. If omitted, the colour of all streets.
    pub asphalt: Option<Color>,
    /// Width (m) of the sidewalk on each side. If omitted, 2.5 or a fifth of the street's width, whichever is less.
    pub sidewalk: Option<f64>,
    /// Number of lanes for both directions. If omitted, as many as fit.
    pub lanes: Option<u32>,
    /// Width (m) of a raised strip between the two directions.
    #[default(0.0)]
    pub median: f64,
    /// Width (m) of a parking strip on each side.
    #[default(0.0)]
    pub parking: f64,
    /// Distance (m) between trees along each sidewalk and in the median; 0 for none.
    #[default(0.0)]
    pub trees: f64,
    /// Distance (m) between lamps along each sidewalk; 0 for none.
    #[default(0.0)]
    pub lamps: f64,
}

impl StreetOptions {
    /// Creates a street type of this width (m), with defaults for the other fields.
    pub(super) fn of_width(width: f64) -> Self {
        Self { width, ..Self::default() }
    }

    /// Converts the options to a street type of the network.
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
            .map_err(|error| Expectation::new(format!("a street type ({})", error.message())))
    }

    fn into_value(self) -> Value {
        Value::Table(Arc::new(Table::default()))
    }
}
