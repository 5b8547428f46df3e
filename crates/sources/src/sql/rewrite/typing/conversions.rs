//! Expressions that replace those of a statement: conversions of operands, and the errors if there are none.

use sqlparser::ast::{Expr, Spanned, Value};

use crate::sql::rewrite::parse;
use crate::sql::rewrite::types::SqlType;
use burgeon_base::error::{Error, Result};
use burgeon_base::text::shown;

/// Converts a value to a string.
pub(super) fn as_text(expression: &Expr, kind: SqlType) -> Result<Expr> {
    Ok(match kind {
        SqlType::Text | SqlType::Literal | SqlType::List => expression.clone(),
        SqlType::Boolean => parse_generated(&format!("burgeon_truth({expression})"), expression)?,
        _ => parse_generated(&format!("burgeon_text({expression})"), expression)?,
    })
}

/// Converts a quoted string to a number of the type of the other operand.
pub(super) fn as_number(expression: &Expr, other: SqlType) -> Result<Expr> {
    let Expr::Value(value) = expression else { return Ok(expression.clone()) };
    let Value::SingleQuotedString(text) = &value.value else { return Ok(expression.clone()) };
    let number = text.trim();
    let fits = match other {
        SqlType::Numeric | SqlType::Double => number.parse::<f64>().is_ok_and(f64::is_finite),
        _ => number.parse::<i64>().is_ok(),
    };
    match fits {
        true => parse_generated(&format!("({number})"), expression),
        false => {
            let kind = if other.is_number() { other.name() } else { "integer" };
            Err(error_at(expression, &format!("invalid input syntax for type {kind}: {:?}", shown(text)))
                .help("compare numbers with numbers, and texts with texts"))
        }
    }
}

/// Parses an expression that Burgeon wrote.
pub(super) fn parse_generated(text: &str, instead: &Expr) -> Result<Expr> {
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
pub(super) fn unsupported_error(expression: &Expr, what: &str, remedy: &str) -> Error {
    error_at(expression, &format!("{what} is not supported here")).help(remedy)
}

/// Creates an error about an expression, with its position in the statement.
pub(in crate::sql::rewrite) fn error_at(expression: &Expr, message: &str) -> Error {
    let start = expression.span().start;
    let place = match start.line {
        0 => String::new(),
        line => format!(", line {line}, column {}", start.column),
    };
    Error::argument(format!("SQL{place}: {message}"))
}
