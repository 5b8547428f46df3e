//! Casts with the meaning of PostgreSQL.

use sqlparser::ast::{CastKind, DataType, Expr, Spanned};

use super::conversions::{error_at, make_text, parse_generated, unsupported_error};
use super::scope::{TypeScope, Typing};
use crate::sql::rewrite::types::SqlType;
use burgeon_base::error::Result;
use burgeon_base::text::shown;

impl Typing<'_> {
    /// Types a cast, and rewrites it as a function that rounds and fails like PostgreSQL.
    pub(super) fn cast(&mut self, expression: &mut Expr, scope: &TypeScope<'_>) -> Result<SqlType> {
        use SqlType as T;
        let start = expression.span().start;
        let Expr::Cast { kind, expr, data_type, .. } = &mut *expression else { return Ok(T::Unknown) };
        if !matches!(kind, CastKind::Cast | CastKind::DoubleColon) {
            return Err(unsupported_error(&start, "such a cast", "write value::type"));
        }
        let name = data_type.to_string();
        let from = self.expression(expr, scope)?;
        // The grammar may have another name for the type.
        let Some(to) = SqlType::from_name(&name) else {
            return match data_type {
                DataType::Custom(name, _) if name.to_string().eq_ignore_ascii_case("geography") => {
                    Err(unsupported_error(
                        &start,
                        "the type geography",
                        "geometries are in metres here: leave the cast out",
                    ))
                }
                _ => Err(unsupported_error(
                    &start,
                    &format!("the type {}", shown(&name.to_ascii_lowercase())),
                    "values are text, integer, numeric, double precision, boolean or geometry; dates are texts",
                )),
            };
        };
        let wrong = |to: &str, remedy: &str| -> Result<SqlType> {
            Err(error_at(&start, &format!("cannot cast type {} to {to}", from.name())).help(remedy))
        };
        let written = match to {
            T::Boolean if from == T::Boolean => expr.to_string(),
            T::Boolean if matches!(from, T::Geometry | T::Double | T::Numeric) => {
                return wrong("boolean", "write a comparison");
            }
            T::Boolean => format!("burgeon_boolean({expr})"),
            T::Integer if from == T::Geometry => {
                return wrong("integer", "take ST_X, ST_Area and the like");
            }
            T::Integer if matches!(from, T::Numeric) => format!("burgeon_whole_decimal({expr})"),
            T::Integer => format!("burgeon_whole({expr})"),
            T::Numeric => match scale(&name) {
                Some(scale) => format!("burgeon_round_decimal(burgeon_decimal({expr}), {scale})"),
                None => format!("burgeon_decimal({expr})"),
            },
            T::Double if name.eq_ignore_ascii_case("real") || name.eq_ignore_ascii_case("float4") => {
                return Err(unsupported_error(&start, "the type real", "take double precision"));
            }
            T::Double => format!("burgeon_number({expr})"),
            T::Text => {
                let text = match (from, &**expr) {
                    // The literal is used as written, with its trailing zeros.
                    (T::Numeric, Expr::Value(value)) => format!("'{value}'"),
                    (from, _) => {
                        make_text(expr, from)?;
                        expr.to_string()
                    }
                };
                match length(&name) {
                    Some(length) => format!("left({text}, {length})"),
                    None => text,
                }
            }
            T::Geometry => match &**expr {
                text if from == T::Literal => format!("ST_GeomFromText({text})"),
                other => other.to_string(),
            },
            T::List | T::Literal | T::Unknown => return Ok(T::Unknown),
        };
        *expression = parse_generated(&format!("({written})"), &start)?;
        Ok(to)
    }
}

/// Returns the scale of a type such as `numeric(8, 2)`.
fn scale(name: &str) -> Option<i32> {
    let inside = name.split_once('(')?.1.trim_end_matches(')');
    inside.split_once(',').map_or(Some(0), |(_, scale)| scale.trim().parse().ok())
}

/// Returns the length of a type such as `varchar(8)`.
fn length(name: &str) -> Option<u32> {
    name.split_once('(')?.1.trim_end_matches(')').trim().parse().ok()
}
