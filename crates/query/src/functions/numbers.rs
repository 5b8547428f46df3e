//! Functions of numbers, which SQLite has only where it is built so: as PostgreSQL's, but that NULL is what has no value.

use rusqlite::Connection;
use rusqlite::functions::{Context, FunctionFlags};
use rusqlite::types::{Value, ValueRef};

/// A function of one number, by its name.
type UnaryFunction = (&'static str, fn(f64) -> f64);

/// A function of two.
type BinaryFunction = (&'static str, fn(f64, f64) -> f64);

/// Those of one number.
const OF_ONE: [UnaryFunction; 24] = [
    ("acos", f64::acos),
    ("acosh", f64::acosh),
    ("asin", f64::asin),
    ("asinh", f64::asinh),
    ("atan", f64::atan),
    ("atanh", f64::atanh),
    ("ceil", f64::ceil),
    ("ceiling", f64::ceil),
    ("cos", f64::cos),
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

/// Those of two.
const OF_TWO: [BinaryFunction; 5] = [
    ("atan2", f64::atan2),
    ("log", |base, number| number.ln() / base.ln()),
    ("mod", |number, by| number % by),
    ("pow", f64::powf),
    ("power", f64::powf),
];

/// Gives a connection all of them.
pub(super) fn register(connection: &Connection) -> rusqlite::Result<()> {
    let flags = FunctionFlags::SQLITE_UTF8 | FunctionFlags::SQLITE_DETERMINISTIC;
    for (name, run) in OF_ONE {
        connection
            .create_scalar_function(name, 1, flags, move |context| called(context, name, |of| run(of[0])))?;
    }
    for (name, run) in OF_TWO {
        connection.create_scalar_function(name, 2, flags, move |context| {
            called(context, name, |of| run(of[0], of[1]))
        })?;
    }
    connection.create_scalar_function("pi", 0, flags, |_| Ok(std::f64::consts::PI))
}

/// What a function gives: NULL if an argument is, or if there is no such number.
fn called(context: &Context<'_>, name: &str, run: impl Fn([f64; 2]) -> f64) -> rusqlite::Result<Value> {
    let mut numbers = [0.0; 2];
    let mut whole = true;
    for (index, number) in numbers.iter_mut().enumerate().take(context.len()) {
        *number = match context.get_raw(index) {
            ValueRef::Null => return Ok(Value::Null),
            #[allow(clippy::cast_precision_loss, reason = "SQLite does the same")]
            ValueRef::Integer(value) => value as f64,
            ValueRef::Real(value) => {
                whole = false;
                value
            }
            ValueRef::Text(_) | ValueRef::Blob(_) => {
                let why = format!("argument {} of {name} must be a number", index + 1);
                return Err(rusqlite::Error::UserFunctionError(why.into()));
            }
        };
    }
    let found = run(numbers);
    #[allow(clippy::cast_possible_truncation, reason = "the range is checked")]
    Ok(if !found.is_finite() {
        Value::Null
    } else if whole && found.fract() == 0.0 && found.abs() < 9e15 {
        // What counts rows, and divides as whole numbers do, stays whole.
        Value::Integer(found as i64)
    } else {
        Value::Real(found)
    })
}
