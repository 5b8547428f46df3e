//! Calls of a function: reading arguments and writing the result.

use std::rc::Rc;
use std::sync::Arc;

use rusqlite::functions::Context;
use rusqlite::types::{ToSqlOutput, Value, ValueRef};
use rusqlite::vtab::array::Array;

use super::argument::GeometryArgument;
use super::state::ConnectionState;
use crate::sql::blob;
use burgeon_spatial::Geometry;

/// The result of a function.
pub(crate) enum FunctionResult {
    /// Null.
    Nothing,
    /// Boolean.
    Boolean(bool),
    /// Number.
    Number(f64),
    /// Integer.
    Count(usize),
    /// String.
    Text(String),
    /// Geometry, in the reference system of the arguments.
    Geometry(Geometry),
    /// Geometry in the reference system with a code, or in the run's.
    Placed(Geometry, Option<u32>),
    /// Bytes.
    Bytes(Vec<u8>),
}

impl From<Option<f64>> for FunctionResult {
    fn from(number: Option<f64>) -> Self {
        number.map_or(Self::Nothing, Self::Number)
    }
}

/// The arguments of a call.
pub(crate) struct FunctionCall<'a> {
    /// Name of the function.
    pub(super) name: &'static str,
    /// Arguments that the function takes.
    pub(super) takes: &'static str,
    pub(super) context: &'a Context<'a>,
    pub(super) state: &'a ConnectionState,
}

impl std::fmt::Debug for FunctionCall<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str("FunctionCall")
    }
}

/// Creates the error with which a statement ends.
pub(super) fn function_error(message: String) -> rusqlite::Error {
    rusqlite::Error::UserFunctionError(message.into())
}

/// Returns the common reference system of all geometry arguments, if it is not the run's. Fails if they have different
/// ones.
pub(super) fn foreign(context: &Context<'_>) -> Result<Option<u32>, String> {
    let mut found: Option<Option<u32>> = None;
    for index in 0..context.len() {
        if let ValueRef::Blob(bytes) = context.get_raw(index) {
            let own = blob::foreign(bytes);
            if *found.get_or_insert(own) != own {
                return Err("the geometries have different reference systems; bring both into one: ST_Transform(geometry, srid)".into());
            }
        }
    }
    Ok(found.flatten())
}

/// Runs a function that returns a list of geometries.
pub(super) fn run_list(
    context: &Context<'_>,
    state: &ConnectionState,
    name: &str,
    run: impl FnOnce(Geometry, &Context<'_>) -> Result<Vec<Geometry>, String>,
) -> rusqlite::Result<KeyList> {
    state.budget().tick().map_err(|error| function_error(error.into_message()))?;
    let told = |why: String| function_error(format!("{name}: {why}"));
    let foreign = foreign(context).map_err(told)?;
    let geometry = match context.get_raw(0) {
        ValueRef::Null => return Ok(keys(&[])),
        ValueRef::Blob(bytes) => state.geometry(bytes).map_err(told)?.geometry.clone(),
        ValueRef::Text(text) => {
            let read = Geometry::from_wkt_within(&String::from_utf8_lossy(text), &state.budget());
            read.map_err(|error| told(error.into_message()))?
        }
        other => return Err(told(super::texts::wrong_argument(0, "a geometry", other))),
    };
    let made = run(geometry, context).map_err(told)?;
    let values = made.iter().map(|geometry| Value::Blob(blob::write_in(geometry, foreign))).collect();
    Ok(KeyList(Rc::new(values)))
}

/// Converts a result to a value of SQLite.
pub(super) fn value(output: FunctionResult) -> rusqlite::Result<Value> {
    Ok(match output {
        FunctionResult::Nothing => Value::Null,
        FunctionResult::Boolean(value) => Value::Integer(i64::from(value)),
        FunctionResult::Number(value) => Value::Real(value),
        FunctionResult::Count(count) => Value::Integer(i64::try_from(count).unwrap_or(i64::MAX)),
        FunctionResult::Text(text) => Value::Text(text),
        FunctionResult::Geometry(geometry) => Value::Blob(blob::write(&geometry)),
        FunctionResult::Placed(geometry, foreign) => Value::Blob(blob::write_in(&geometry, foreign)),
        FunctionResult::Bytes(bytes) => Value::Blob(bytes),
    })
}

impl FunctionCall<'_> {
    /// Returns the number of arguments.
    pub(super) fn len(&self) -> usize {
        self.context.len()
    }

    fn wrong_argument(&self, index: usize, wanted: &str) -> String {
        let found = match self.context.get_raw(index) {
            ValueRef::Null => "nothing",
            ValueRef::Integer(_) | ValueRef::Real(_) => "a number",
            ValueRef::Text(_) => "a text",
            ValueRef::Blob(_) => "a geometry",
        };
        format!("argument {} must be {wanted}, not {found}: {}{}", index + 1, self.name, self.takes)
    }

    /// Returns the message that a geometry is not of the required type.
    pub(super) fn wrong_geometry(&self, index: usize, wanted: &str) -> String {
        let (name, takes) = (self.name, self.takes);
        format!("argument {} must be {wanted}: {name}{takes}", index + 1)
    }

    /// Returns an argument as a geometry.
    pub(super) fn geometry(&self, index: usize) -> Result<Arc<GeometryArgument>, String> {
        match self.context.get_raw(index) {
            ValueRef::Blob(bytes) => {
                let read = self.state.geometry(bytes);
                read.map_err(|why| format!("the geometry of argument {} {why}", index + 1))
            }
            // PostGIS also accepts well-known text.
            ValueRef::Text(text) => {
                let text = std::str::from_utf8(text).map_err(|_| self.wrong_argument(index, "a geometry"))?;
                let read = Geometry::from_wkt_within(text, &self.state.budget());
                read.map(|geometry| Arc::new(GeometryArgument::from(geometry)))
                    .map_err(|error| error.into_message())
            }
            _ => Err(self.wrong_argument(index, "a geometry")),
        }
    }

    /// Returns an argument as a geometry that the function may change.
    pub(super) fn copy_geometry(&self, index: usize) -> Result<Geometry, String> {
        // Geometries that were read from a blob are kept for later calls.
        Ok(match Arc::try_unwrap(self.geometry(index)?) {
            Ok(own) => own.geometry,
            Err(kept) => kept.geometry.clone(),
        })
    }

    /// Returns the bounds of a geometry argument, if it is not empty.
    pub(super) fn bounds(&self, index: usize) -> Result<Option<[f64; 4]>, String> {
        if let ValueRef::Blob(bytes) = self.context.get_raw(index)
            && let Some(bounds) = blob::told_bounds(bytes)
        {
            return Ok(Some(bounds));
        }
        let parsed = self.geometry(index)?;
        Ok(bounds(&parsed))
    }

    /// Returns an argument as a number.
    pub(super) fn number(&self, index: usize) -> Result<f64, String> {
        number(self.context.get_raw(index)).ok_or_else(|| self.wrong_argument(index, "a number"))
    }

    /// Returns an argument as a number, or `other` if there is no such argument.
    pub(super) fn number_or(&self, index: usize, other: f64) -> Result<f64, String> {
        if index < self.len() { self.number(index) } else { Ok(other) }
    }

    /// Returns an argument as a string.
    pub(super) fn text(&self, index: usize) -> Result<&str, String> {
        match self.context.get_raw(index) {
            ValueRef::Text(text) => {
                std::str::from_utf8(text).map_err(|_| self.wrong_argument(index, "a text"))
            }
            _ => Err(self.wrong_argument(index, "a text")),
        }
    }

    /// Returns an argument as bytes.
    pub(super) fn bytes(&self, index: usize) -> Result<&[u8], String> {
        match self.context.get_raw(index) {
            ValueRef::Blob(bytes) => Ok(bytes),
            _ => Err(self.wrong_argument(index, "well-known binary")),
        }
    }

    /// Returns the code of the reference system of a geometry argument, if it is not the run's.
    pub(super) fn foreign(&self, index: usize) -> Option<u32> {
        match self.context.get_raw(index) {
            ValueRef::Blob(bytes) => blob::foreign(bytes),
            _ => None,
        }
    }

    /// Returns the state of the connection.
    pub(super) fn state(&self) -> &ConnectionState {
        self.state
    }

    /// Returns the budget of the statement.
    pub(super) fn budget(&self) -> Arc<burgeon_base::budget::Budget> {
        self.state.budget()
    }
}

pub(super) fn number(value: ValueRef<'_>) -> Option<f64> {
    match value {
        #[allow(clippy::cast_precision_loss, reason = "SQLite does the same")]
        ValueRef::Integer(value) => Some(value as f64),
        ValueRef::Real(value) => Some(value),
        _ => None,
    }
}

pub(super) fn bounds(parsed: &GeometryArgument) -> Option<[f64; 4]> {
    let [low, high] = parsed.geometry.bounds()?;
    Some([low.x, low.y, high.x, high.y])
}

/// Returns the greatest or the least of the arguments that are not null.
pub(super) fn extreme(context: &Context<'_>, greater: bool) -> rusqlite::Result<Value> {
    let mut best: Option<Value> = None;
    for index in 0..context.len() {
        let next = Value::try_from(context.get_raw(index))?;
        let better = match (&next, &best) {
            (Value::Null, _) => false,
            (_, None) => true,
            (Value::Text(a), Some(Value::Text(b))) => (a > b) == greater,
            (a, Some(b)) => match (number(a.into()), number(b.into())) {
                (Some(a), Some(b)) => (a > b) == greater,
                _ => {
                    return Err(function_error(
                        "greatest and least compare numbers with numbers, and texts with texts".into(),
                    ));
                }
            },
        };
        if better {
            best = Some(next);
        }
    }
    Ok(best.unwrap_or(Value::Null))
}

/// Returns keys as a list for `rarray`.
pub(super) fn keys(keys: &[i64]) -> KeyList {
    KeyList(Rc::new(keys.iter().map(|key| Value::Integer(*key)).collect()))
}

/// A list for `rarray`.
pub(super) struct KeyList(pub(super) Array);

impl rusqlite::ToSql for KeyList {
    fn to_sql(&self) -> rusqlite::Result<ToSqlOutput<'_>> {
        self.0.to_sql()
    }
}
