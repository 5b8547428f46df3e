//! The types of expressions, and their translation from PostgreSQL to SQLite.

use sqlparser::ast::{
    CaseWhen, CeilFloorKind, DateTimeField, Expr, FunctionArg, FunctionArgExpr, TrimWhereField,
    UnaryOperator, Value, WindowSpec,
};
use std::borrow::Cow;

use super::conversions::{error_at, no_operator, parse_generated, unsupported_error};
use super::scope::{TypeScope, Typing};
use crate::sql::rewrite::types::SqlType;
use burgeon_base::error::Result;

impl Typing<'_> {
    /// Types the condition of a `clause`.
    pub(super) fn condition(
        &mut self,
        expression: &mut Expr,
        scope: &TypeScope<'_>,
        clause: &str,
    ) -> Result<()> {
        let kind = self.expression(expression, scope)?;
        if matches!(kind, SqlType::Text | SqlType::Geometry | SqlType::List) {
            let name = kind.name();
            return Err(error_at(
                expression,
                &format!("argument of {clause} must be type boolean, not type {name}"),
            )
            .help("write a comparison, such as name IS NOT NULL"));
        }
        Ok(())
    }

    /// Types an expression, and rewrites it for SQLite.
    pub(super) fn expression(&mut self, expression: &mut Expr, scope: &TypeScope<'_>) -> Result<SqlType> {
        use SqlType as T;
        Ok(match expression {
            Expr::Identifier(name) => scope.column(None, &name.value),
            Expr::CompoundIdentifier(parts) => match parts.as_slice() {
                [.., owner, name] => scope.column(Some(&owner.value), &name.value),
                _ => T::Unknown,
            },
            Expr::Value(value) => match &value.value {
                Value::Number(number, _) => {
                    let whole = number.bytes().all(|letter| letter.is_ascii_digit());
                    if whole { T::Integer } else { T::Numeric }
                }
                Value::SingleQuotedString(_) => T::Literal,
                Value::Boolean(_) => T::Boolean,
                _ => T::Unknown,
            },
            Expr::Nested(inner) | Expr::Collate { expr: inner, .. } => self.expression(inner, scope)?,
            Expr::IsNull(inner) | Expr::IsNotNull(inner) => {
                self.expression(inner, scope)?;
                T::Boolean
            }
            Expr::IsTrue(inner)
            | Expr::IsNotTrue(inner)
            | Expr::IsFalse(inner)
            | Expr::IsNotFalse(inner)
            | Expr::IsUnknown(inner)
            | Expr::IsNotUnknown(inner) => {
                self.condition(inner, scope, "IS")?;
                T::Boolean
            }
            Expr::IsDistinctFrom(left, right) | Expr::IsNotDistinctFrom(left, right) => {
                self.compare(left, right, scope, "IS DISTINCT FROM")?;
                T::Boolean
            }
            Expr::InList { expr, list, .. } => {
                for item in list {
                    self.compare(expr, item, scope, "=")?;
                }
                T::Boolean
            }
            Expr::InSubquery { expr, subquery, .. } => {
                self.expression(expr, scope)?;
                self.query(subquery, scope)?;
                T::Boolean
            }
            Expr::Exists { subquery, .. } => {
                self.query(subquery, scope)?;
                T::Boolean
            }
            Expr::Subquery(subquery) => {
                let columns = self.query(subquery, scope)?;
                columns.and_then(|columns| columns.first().map(|(_, kind)| *kind)).unwrap_or_default()
            }
            Expr::Between { expr, low, high, .. } => {
                self.compare(expr, low, scope, ">=")?;
                self.compare(expr, high, scope, "<=")?;
                T::Boolean
            }
            Expr::Tuple(values) => {
                for value in values {
                    self.expression(value, scope)?;
                }
                T::Unknown
            }
            Expr::UnaryOp { op, expr } => {
                let kind = self.expression(expr, scope)?;
                match op {
                    UnaryOperator::Not if matches!(kind, T::Text | T::Geometry | T::List) => {
                        let what = format!("argument of NOT must be type boolean, not type {}", kind.name());
                        let error = error_at(expression, &what);
                        return Err(error.help("write a comparison, such as name IS NOT NULL"));
                    }
                    UnaryOperator::Not => T::Boolean,
                    UnaryOperator::Minus | UnaryOperator::Plus if matches!(kind, T::Text | T::Boolean) => {
                        let what = format!("{op} {}", kind.name());
                        return Err(no_operator(expression, &what));
                    }
                    UnaryOperator::PGSquareRoot => {
                        *expression = parse_generated(&format!("sqrt({expr})"), expression)?;
                        T::Double
                    }
                    _ => kind,
                }
            }
            Expr::BinaryOp { .. } => self.operator(expression, scope)?,
            Expr::Like { .. } | Expr::ILike { .. } => self.like(expression, scope)?,
            Expr::SimilarTo { .. } | Expr::RLike { .. } => {
                return Err(unsupported_error(
                    expression,
                    "a regular expression",
                    "write LIKE or ILIKE with % and _",
                ));
            }
            Expr::AnyOp { .. } | Expr::AllOp { .. } => self.quantifier(expression, scope)?,
            Expr::Cast { .. } => self.cast(expression, scope)?,
            Expr::Case { operand, conditions, else_result, .. } => {
                let compared = operand.as_deref_mut();
                let mut found: Option<T> = None;
                let mut add = |kind: T| found = Some(found.map_or(kind, |known| known.or(kind)));
                let is_plain = compared.is_none();
                if let Some(operand) = compared {
                    self.expression(operand, scope)?;
                }
                for CaseWhen { condition, result } in conditions {
                    match is_plain {
                        true => self.condition(condition, scope, "CASE/WHEN")?,
                        false => drop(self.expression(condition, scope)?),
                    }
                    add(self.expression(result, scope)?);
                }
                if let Some(result) = else_result {
                    add(self.expression(result, scope)?);
                }
                found.unwrap_or_default()
            }
            Expr::Ceil { expr, field: CeilFloorKind::DateTimeField(DateTimeField::NoDateTime) }
            | Expr::Floor { expr, field: CeilFloorKind::DateTimeField(DateTimeField::NoDateTime) } => {
                let kind = self.expression(expr, scope)?;
                if kind == T::Numeric { T::Numeric } else { T::Double }
            }
            Expr::Position { expr, r#in } => {
                *expression = parse_generated(&format!("strpos({in}, {expr})"), expression)?;
                self.expression(expression, scope)?
            }
            Expr::Substring { expr, substring_from, substring_for, .. } => {
                let from = substring_from.as_ref().map_or("1".into(), |from| Cow::Owned(from.to_string()));
                let length = substring_for.as_ref().map_or_else(String::new, |length| format!(", {length}"));
                *expression =
                    parse_generated(&format!("burgeon_substr({expr}, {from}{length})"), expression)?;
                self.expression(expression, scope)?
            }
            Expr::Trim { trim_where, trim_what, expr, trim_characters } => {
                let name = match trim_where {
                    Some(TrimWhereField::Leading) => "ltrim",
                    Some(TrimWhereField::Trailing) => "rtrim",
                    _ => "btrim",
                };
                let more = trim_what.iter().map(ToString::to_string);
                let more = more.chain(trim_characters.iter().flatten().map(ToString::to_string));
                let more: String = more.map(|text| format!(", {text}")).collect();
                *expression = parse_generated(&format!("{name}({expr}{more})"), expression)?;
                self.expression(expression, scope)?
            }
            Expr::Overlay { .. } => {
                return Err(unsupported_error(
                    expression,
                    "overlay",
                    "write left(...) || text || substr(...)",
                ));
            }
            Expr::Extract { .. } | Expr::Interval(_) | Expr::AtTimeZone { .. } | Expr::TypedString(_) => {
                return Err(unsupported_error(
                    expression,
                    "a date or a time",
                    "dates are texts here, such as '2024-02-29': compare them as texts, and take parts with substr",
                ));
            }
            Expr::Array(_) | Expr::GroupingSets(_) | Expr::Cube(_) | Expr::Rollup(_) => {
                return Err(unsupported_error(
                    expression,
                    "an array, or a set of groupings",
                    "write IN (...) in place of an array, and UNION ALL in place of several groupings",
                ));
            }
            Expr::Function(_) => self.function(expression, scope)?,
            _ => T::Unknown,
        })
    }

    /// Types an argument of a function.
    pub(super) fn argument(&mut self, argument: &mut FunctionArg, scope: &TypeScope<'_>) -> Result<SqlType> {
        match argument {
            FunctionArg::Named { arg: FunctionArgExpr::Expr(expression), .. }
            | FunctionArg::ExprNamed { arg: FunctionArgExpr::Expr(expression), .. }
            | FunctionArg::Unnamed(FunctionArgExpr::Expr(expression)) => self.expression(expression, scope),
            _ => Ok(SqlType::Unknown),
        }
    }

    /// Types the keys of a window.
    pub(super) fn window(&mut self, spec: &mut WindowSpec, scope: &TypeScope<'_>) -> Result<()> {
        for key in &mut spec.partition_by {
            self.expression(key, scope)?;
        }
        for key in &mut spec.order_by {
            self.expression(&mut key.expr, scope)?;
        }
        Ok(())
    }
}
