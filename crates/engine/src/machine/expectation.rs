//! Known results that scripts check.

use mlua::Value as LuaValue;

use super::convert::to_value;
use crate::declare::RunOptions;
use burgeon_base::error::{Error, Result};
use burgeon_kit::{Table, TableKey, Value};

/// Maximum depth of nested tables that are compared.
const DEEPEST: usize = 32;

/// Compares a result with its expected value and a tolerance. Does nothing if the run changes values of the script.
pub(super) fn expect(
    options: &RunOptions,
    (actual, expected, tolerance): &(LuaValue, LuaValue, LuaValue),
) -> Result<()> {
    let usage = "write expect(derived.counts.F, 625), or with a tolerance, expect(width, 0.7071, 0.0001)";
    let refuse = |message: &str| Err(Error::argument(message).help(usage));
    let tolerance = match tolerance {
        LuaValue::Nil => 0.0,
        other => match to_value(other, false)? {
            Value::Number(number) if number >= 0.0 && number.is_finite() => number,
            other => {
                return refuse(&format!(
                    "expect: tolerance must be a number of at least 0, not {}",
                    other.describe()
                ));
            }
        },
    };
    if expected.is_nil() {
        return refuse("expect: the expected value is missing");
    }
    let (actual, expected) = (to_value(actual, false)?, to_value(expected, false)?);
    if options.check || changes_values(options) {
        return Ok(());
    }
    match difference(&actual, &expected, tolerance, DEEPEST) {
        None => Ok(()),
        Some(Difference { path, actual, expected }) => {
            let place = if path.is_empty() { String::new() } else { format!("{path}: ") };
            Err(Error::script(format!("{place}expected {expected}, but the result is {actual}"))
                .help("check what the script makes, or correct the expected value"))
        }
    }
}

/// Returns true if the run has another seed, number of steps, part or parameter value than the script alone.
fn changes_values(options: &RunOptions) -> bool {
    let params = &options.params;
    let own = params.set.is_empty() && params.preset.is_none();
    !own || options.seed != 0 || options.steps.is_some() || options.part.is_some()
}

/// First difference of two values.
struct Difference {
    /// Keys of the value in nested tables, joined by dots.
    path: String,
    actual: String,
    expected: String,
}

/// Returns the first difference of two values, in which numbers may differ by `tolerance`. A table may have fields that
/// the expected table does not have.
fn difference(actual: &Value, expected: &Value, tolerance: f64, depth: usize) -> Option<Difference> {
    match (actual, expected) {
        (Value::Number(a), Value::Number(b)) if (a - b).abs() <= tolerance || a == b => None,
        (Value::Table(a), Value::Table(b)) if depth > 0 && (length(b) == 0 || length(a) == length(b)) => {
            b.entries.iter().find_map(|(key, expected)| {
                let actual =
                    a.entries.iter().find(|(other, _)| other == key).map_or(&Value::Nil, |(_, value)| value);
                let mut found = difference(actual, expected, tolerance, depth - 1)?;
                let key = match key {
                    TableKey::Name(name) => name.to_string(),
                    TableKey::Index(index) => format!("[{index}]"),
                };
                let dot = if found.path.is_empty() { "" } else { "." };
                found.path = format!("{key}{dot}{}", found.path);
                Some(found)
            })
        }
        (Value::Table(a), Value::Table(b)) if depth > 0 => Some(Difference {
            path: String::new(),
            actual: format!("a list of {} values", length(a)),
            expected: format!("a list of {} values", length(b)),
        }),
        _ if actual == expected => None,
        _ => Some(Difference {
            path: String::new(),
            actual: actual.to_string(),
            expected: expected.to_string(),
        }),
    }
}

/// Returns the number of values of a table's list.
fn length(table: &Table) -> usize {
    table.entries.iter().filter(|(key, _)| matches!(key, TableKey::Index(_))).count()
}
