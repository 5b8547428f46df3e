//! Functions of numbers like PostgreSQL's, because they are optional in SQLite. A result that does not exist is an
//! error.

use rusqlite::Connection;
use rusqlite::functions::{Context, FunctionFlags};
use rusqlite::types::{Value, ValueRef};

use super::texts::wrong_argument;

/// The name of a function of one number, and its implementation.
type UnaryFunction = (&'static str, fn(f64) -> f64);

/// The name of a function of two numbers, and its implementation.
type BinaryFunction = (&'static str, fn(f64, f64) -> f64);

/// Functions of one number.
const OF_ONE: [UnaryFunction; 26] = [
    ("acos", f64::acos),
    ("acosh", f64::acosh),
    ("asin", f64::asin),
    ("asinh", f64::asinh),
    ("atan", f64::atan),
    ("atanh", f64::atanh),
    ("cbrt", f64::cbrt),
    ("ceil", f64::ceil),
    ("ceiling", f64::ceil),
    ("cos", f64::cos),
    ("cot", |angle| 1.0 / angle.tan()),
    ("cosh", f64::cosh),
    ("degrees", f64::to_degrees),
    ("exp", f64::exp),
    ("floor", f64::floor),
    ("ln", f64::ln),
    ("log", f64::log10),
    ("log10", f64::log10),
    ("log2", f64::log2),
    ("radians", f64::to_radians),
    ("sin", f64::sin),
    ("sinh", f64::sinh),
    ("sqrt", f64::sqrt),
    ("tan", f64::tan),
    ("tanh", f64::tanh),
    ("trunc", f64::trunc),
];

/// Functions of two numbers.
const OF_TWO: [BinaryFunction; 5] = [
    ("atan2", f64::atan2),
    ("log", |base, number| number.ln() / base.ln()),
    ("trunc", |number, decimals| {
        let scale = 10f64.powf(decimals.trunc());
        (number * scale).trunc() / scale
    }),
    ("pow", f64::powf),
    ("power", f64::powf),
];

/// Registers the functions with a connection.
pub(super) fn register(connection: &Connection) -> rusqlite::Result<()> {
    let flags = FunctionFlags::SQLITE_UTF8 | FunctionFlags::SQLITE_DETERMINISTIC;
    for (name, run) in OF_ONE {
        connection.create_scalar_function(name, 1, flags, move |context| {
            call_finite(context, name, |of| run(of[0]))
        })?;
    }
    for (name, run) in OF_TWO {
        connection.create_scalar_function(name, 2, flags, move |context| {
            call_finite(context, name, |of| run(of[0], of[1]))
        })?;
    }
    connection.create_scalar_function("pi", 0, flags, |_| Ok(std::f64::consts::PI))
}

/// Returns the result of a function, or null if an argument is null. Fails if the result is not a finite number.
fn call_finite(context: &Context<'_>, name: &str, run: impl Fn([f64; 2]) -> f64) -> rusqlite::Result<Value> {
    let failed = |why: String| rusqlite::Error::UserFunctionError(format!("{name}: {why}").into());
    let mut numbers = [0.0; 2];
    for (index, number) in numbers.iter_mut().enumerate().take(context.len()) {
        *number = match context.get_raw(index) {
            ValueRef::Null => return Ok(Value::Null),
            #[allow(clippy::cast_precision_loss, reason = "SQLite does the same")]
            ValueRef::Integer(value) => value as f64,
            ValueRef::Real(value) => value,
            other => return Err(failed(wrong_argument(index, "a number", other))),
        };
    }
    let found = run(numbers);
    if found.is_finite() { Ok(Value::Real(found)) } else { Err(failed("input is out of range".into())) }
}
