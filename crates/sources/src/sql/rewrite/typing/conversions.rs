//! Expressions that replace those of a statement: conversions of operands, and the errors if there are none.

use sqlparser::ast::{Expr, Spanned, Value};
use sqlparser::tokenizer::Location;

use crate::sql::rewrite::parse;
use crate::sql::rewrite::types::SqlType;
use burgeon_base::error::{Error, Result};
use burgeon_base::text::shown;

/// Position in a statement that an error names.
pub(in crate::sql::rewrite) trait ErrorPlace {
    /// Returns the line and the column; line 0 if they are unknown.
    fn start(&self) -> Location;
}

impl ErrorPlace for Expr {
    fn start(&self) -> Location {
        self.span().start
    }
}

impl ErrorPlace for Location {
    fn start(&self) -> Location {
        *self
    }
}

/// Converts a value to a string.
pub(super) fn make_text(expression: &mut Expr, kind: SqlType) -> Result<()> {
    *expression = match kind {
        SqlType::Text | SqlType::Literal | SqlType::List => return Ok(()),
        SqlType::Boolean => parse_generated(&format!("burgeon_truth({expression})"), expression)?,
        _ => parse_generated(&format!("burgeon_text({expression})"), expression)?,
    };
    Ok(())
}

/// Converts a quoted string to a number of the type of the other operand.
pub(super) fn make_number(expression: &mut Expr, other: SqlType) -> Result<()> {
    let Expr::Value(value) = &*expression else { return Ok(()) };
    let Value::SingleQuotedString(text) = &value.value else { return Ok(()) };
    let number = text.trim();
    let fits = match other {
        SqlType::Numeric | SqlType::Double => number.parse::<f64>().is_ok_and(f64::is_finite),
        _ => number.parse::<i64>().is_ok(),
    };
    if !fits {
        let kind = if other.is_number() { other.name() } else { "integer" };
        return Err(error_at(
            expression,
            &format!("invalid input syntax for type {kind}: {:?}", shown(text)),
        )
        .help("compare numbers with numbers, and texts with texts"));
    }
    *expression = parse_generated(&format!("({number})"), expression)?;
    Ok(())
}

/// Parses an expression that Burgeon wrote.
pub(super) fn parse_generated(text: &str, instead: &impl ErrorPlace) -> Result<Expr> {
    parse::expression(text).ok_or_else(|| {
        error_at(instead, "this is too deep to be read").help("write fewer brackets within one another")
    })
}

/// Creates the error for an operator that does not accept its operands.
pub(super) fn no_operator(expression: &Expr, what: &str) -> Error {
    error_at(expression, &format!("operator does not exist: {what}"))
        .help("a cast makes one type of another: name::integer, height::text")
}

/// Creates the error for a feature that only servers support.
pub(super) fn unsupported_error(place: &impl ErrorPlace, what: &str, remedy: &str) -> Error {
    error_at(place, &format!("{what} is not supported here")).help(remedy)
}

/// Creates an error about an expression, with its position in the statement.
pub(in crate::sql::rewrite) fn error_at(place: &impl ErrorPlace, message: &str) -> Error {
    let start = place.start();
    let place = match start.line {
        0 => String::new(),
        line => format!(", line {line}, column {}", start.column),
    };
    Error::argument(format!("SQL{place}: {message}"))
}
