//! Values of scripts in queries, and cells of results.

use std::sync::Arc;

use crate::sql::Cell;
use burgeon_base::error::{Error, Result};
use burgeon_kit::{Table, TableKey, Value};
use burgeon_spatial::GeometryObject;

/// Converts a script value to a query parameter called `name`.
pub(super) fn cell(name: &str, value: &Value) -> Result<Cell> {
    Ok(match value {
        Value::Nil => Cell::Null,
        Value::Boolean(value) => Cell::Boolean(*value),
        Value::Number(value) => Cell::Number(*value),
        Value::Text(text) => Cell::Text(Arc::clone(text)),
        Value::Object(object) => match GeometryObject::of(&**object) {
            Some(geometry) => Cell::Geometry(Arc::new(geometry.clone())),
            None => return Err(no_value(name, value)),
        },
        Value::Table(_) => return Err(no_value(name, value)),
    })
}

/// Returns the error for a value that cannot be a query parameter.
fn no_value(name: &str, value: &Value) -> Error {
    Error::argument(format!("${name} of the query cannot be {}", value.describe()))
        .help("values are numbers, strings, booleans and geometries")
}

/// Converts a query result to a script value.
pub(super) fn value(cell: Cell) -> Value {
    match cell {
        Cell::Null => Value::Nil,
        Cell::Boolean(value) => Value::Boolean(value),
        Cell::Number(value) => Value::Number(value),
        Cell::Text(text) => Value::Text(text),
        Cell::Geometry(geometry) => Value::Object(Arc::new(GeometryObject::shared(geometry))),
        Cell::List(cells) => {
            let cells = cells.iter().cloned().zip(1..);
            let entries = cells.map(|(cell, number)| (TableKey::Index(number), value(cell)));
            Value::Table(Arc::new(Table { class: None, entries: entries.collect() }))
        }
    }
}
