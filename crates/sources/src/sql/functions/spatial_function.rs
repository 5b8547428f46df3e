//! The description of a function of geometries, and its calls.

use rusqlite::functions::Context;
use rusqlite::types::{Value, ValueRef};

use super::call::{FunctionCall, FunctionResult, foreign, function_error, value};
use super::state::ConnectionState;

/// A function that statements may call.
#[derive(Debug, Clone, Copy)]
pub struct SpatialFunction {
    /// Name, which is not case-sensitive.
    pub name: &'static str,
    /// Arguments.
    pub takes: &'static str,
    /// Type of the result.
    pub gives: &'static str,
    /// Description.
    pub doc: &'static str,
    /// Minimum number of arguments.
    pub(crate) least: u8,
    /// Maximum number of arguments.
    pub(crate) most: u8,
    run: FunctionBody,
}

type FunctionBody = fn(&FunctionCall<'_>) -> Result<FunctionResult, String>;

/// Creates a row of the table.
pub(super) const fn function(
    name: &'static str,
    (least, most): (u8, u8),
    takes: &'static str,
    gives: &'static str,
    doc: &'static str,
    run: FunctionBody,
) -> SpatialFunction {
    SpatialFunction { name, takes, gives, doc, least, most, run }
}

/// Arguments of functions of two geometries.
pub(super) const PAIR: &str = "(geometry, geometry)";
/// Arguments of functions of one geometry.
pub(super) const ONE: &str = "(geometry)";

/// Runs a function. Returns null if an argument is null.
pub(super) fn run(
    function: &'static SpatialFunction,
    context: &Context<'_>,
    state: &ConnectionState,
) -> rusqlite::Result<Value> {
    if (0..context.len()).any(|index| matches!(context.get_raw(index), ValueRef::Null)) {
        return Ok(Value::Null);
    }
    state.budget().tick().map_err(|error| function_error(error.into_message()))?;
    let name = function.name;
    let told = |why: String| function_error(format!("{name}: {why}"));
    let foreign = foreign(context).map_err(told)?;
    let output = (function.run)(&FunctionCall { name, takes: function.takes, context, state });
    match output.map_err(told)? {
        FunctionResult::Geometry(geometry) => value(FunctionResult::Placed(geometry, foreign)),
        output => value(output),
    }
}
