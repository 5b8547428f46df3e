//! The types of expressions, and their translation from PostgreSQL to SQLite.

use sqlparser::ast::{
    BinaryOperator, CaseWhen, CeilFloorKind, DateTimeField, Expr, FunctionArg, FunctionArgExpr, Query,
    TrimWhereField, UnaryOperator, Value, WindowSpec,
};

use super::casts::{as_number, as_text};
use super::parse;
use super::types::SqlType;
use super::typing::{TypeScope, Typing, error_at};
use burgeon_base::error::{Error, Result};

/// The typing of a statement's expressions.
pub(super) struct Expressions<'a, 'b> {
    pub(super) typing: &'a mut Typing<'b>,
}

/// Creates the error for a feature that only servers support.
pub(super) fn unsupported(expression: &Expr, what: &str, remedy: &str) -> Error {
    error_at(expression, &format!("{what} is not supported here")).help(remedy)
}

impl<'a, 'b> Expressions<'a, 'b> {
    pub(super) fn new(typing: &'a mut Typing<'b>) -> Self {
        Self { typing }
    }

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
                self.compared(left, right, scope, "IS DISTINCT FROM")?;
                T::Boolean
            }
            Expr::InList { expr, list, .. } => {
                for item in list {
                    self.compared(expr, item, scope, "=")?;
                }
                T::Boolean
            }
            Expr::InSubquery { expr, subquery, .. } => {
                self.expression(expr, scope)?;
                self.typing.query(subquery, scope)?;
                T::Boolean
            }
            Expr::Exists { subquery, .. } => {
                self.typing.query(subquery, scope)?;
                T::Boolean
            }
            Expr::Subquery(subquery) => {
                let columns = self.typing.query(subquery, scope)?;
                columns.and_then(|columns| columns.first().map(|(_, kind)| *kind)).unwrap_or_default()
            }
            Expr::Between { expr, low, high, .. } => {
                self.compared(expr, low, scope, ">=")?;
                self.compared(expr, high, scope, "<=")?;
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
                        *expression = made(&format!("sqrt({expr})"), expression)?;
                        T::Double
                    }
                    _ => kind,
                }
            }
            Expr::BinaryOp { .. } => self.operator(expression, scope)?,
            Expr::Like { .. } | Expr::ILike { .. } => self.like(expression, scope)?,
            Expr::SimilarTo { .. } | Expr::RLike { .. } => {
                return Err(unsupported(
                    expression,
                    "a regular expression",
                    "write LIKE or ILIKE with % and _",
                ));
            }
            Expr::AnyOp { .. } | Expr::AllOp { .. } => self.quantified(expression, scope)?,
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
                *expression = made(&format!("strpos({in}, {expr})"), expression)?;
                self.expression(expression, scope)?
            }
            Expr::Substring { expr, substring_from, substring_for, .. } => {
                let from = substring_from.as_ref().map_or_else(|| "1".to_owned(), ToString::to_string);
                let length = substring_for.as_ref().map_or_else(String::new, |length| format!(", {length}"));
                *expression = made(&format!("burgeon_substr({expr}, {from}{length})"), expression)?;
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
                *expression = made(&format!("{name}({expr}{more})"), expression)?;
                self.expression(expression, scope)?
            }
            Expr::Overlay { .. } => {
                return Err(unsupported(expression, "overlay", "write left(...) || text || substr(...)"));
            }
            Expr::Extract { .. } | Expr::Interval(_) | Expr::AtTimeZone { .. } | Expr::TypedString(_) => {
                return Err(unsupported(
                    expression,
                    "a date or a time",
                    "dates are texts here, such as '2024-02-29': compare them as texts, and take parts with substr",
                ));
            }
            Expr::Array(_) | Expr::GroupingSets(_) | Expr::Cube(_) | Expr::Rollup(_) => {
                return Err(unsupported(
                    expression,
                    "an array, or a set of groupings",
                    "write IN (...) in place of an array, and UNION ALL in place of several groupings",
                ));
            }
            Expr::Function(_) => self.function(expression, scope)?,
            _ => T::Unknown,
        })
    }

    pub(super) fn argument(&mut self, argument: &mut FunctionArg, scope: &TypeScope<'_>) -> Result<SqlType> {
        match argument {
            FunctionArg::Named { arg: FunctionArgExpr::Expr(expression), .. }
            | FunctionArg::ExprNamed { arg: FunctionArgExpr::Expr(expression), .. }
            | FunctionArg::Unnamed(FunctionArgExpr::Expr(expression)) => self.expression(expression, scope),
            _ => Ok(SqlType::Unknown),
        }
    }

    pub(super) fn window(&mut self, spec: &mut WindowSpec, scope: &TypeScope<'_>) -> Result<()> {
        for key in &mut spec.partition_by {
            self.expression(key, scope)?;
        }
        for key in &mut spec.order_by {
            self.expression(&mut key.expr, scope)?;
        }
        Ok(())
    }

    fn operator(&mut self, expression: &mut Expr, scope: &TypeScope<'_>) -> Result<SqlType> {
        use BinaryOperator as Op;
        use SqlType as T;
        let Expr::BinaryOp { left, op, right } = expression else { return Ok(T::Unknown) };
        match op {
            Op::Eq | Op::NotEq | Op::Lt | Op::LtEq | Op::Gt | Op::GtEq => {
                let name = op.to_string();
                let kinds = self.compared(left, right, scope, &name)?;
                if kinds == [T::Geometry; 2] && matches!(op, Op::Eq | Op::NotEq) {
                    let not = if *op == Op::Eq { "" } else { "NOT " };
                    *expression = made(&format!("({not}geometry_same({left}, {right}))"), expression)?;
                }
                Ok(T::Boolean)
            }
            Op::And | Op::Or => {
                let name = op.to_string();
                self.condition(left, scope, &name)?;
                self.condition(right, scope, &name)?;
                Ok(T::Boolean)
            }
            Op::Plus | Op::Minus | Op::Multiply | Op::Divide | Op::Modulo => {
                self.arithmetic(expression, scope)
            }
            // This operator is the power in PostgreSQL; SQLite has none.
            Op::PGExp | Op::BitwiseXor => {
                *expression = made(&format!("power({left}, {right})"), expression)?;
                self.expression(expression, scope)
            }
            Op::StringConcat => {
                let kinds = [self.expression(left, scope)?, self.expression(right, scope)?];
                if kinds.iter().all(|kind| kind.is_number()) {
                    let what = format!("{} || {}", kinds[0].name(), kinds[1].name());
                    return Err(no_operator(expression, &what));
                }
                for (side, kind) in [left, right].into_iter().zip(kinds) {
                    **side = as_text(side, kind)?;
                }
                Ok(T::Text)
            }
            Op::LtDashGt => {
                *expression = made(&format!("ST_Distance({left}, {right})"), expression)?;
                self.expression(expression, scope)
            }
            Op::PGOverlap => {
                *expression = made(&format!("geometry_overlaps({left}, {right})"), expression)?;
                self.expression(expression, scope)
            }
            Op::PGRegexMatch | Op::PGRegexIMatch | Op::PGRegexNotMatch | Op::PGRegexNotIMatch => {
                Err(unsupported(expression, "a regular expression", "write LIKE or ILIKE with % and _"))
            }
            _ => {
                self.expression(left, scope)?;
                self.expression(right, scope)?;
                Ok(T::Unknown)
            }
        }
    }

    fn arithmetic(&mut self, expression: &mut Expr, scope: &TypeScope<'_>) -> Result<SqlType> {
        use BinaryOperator as Op;
        use SqlType as T;
        let Expr::BinaryOp { left, op, right } = expression else { return Ok(T::Unknown) };
        let kinds = [self.expression(left, scope)?, self.expression(right, scope)?];
        if kinds.iter().any(|kind| matches!(kind, T::Text | T::Boolean | T::Geometry | T::List)) {
            let what = format!("{} {op} {}", kinds[0].name(), kinds[1].name());
            return Err(no_operator(expression, &what));
        }
        for (side, other) in [(&mut *left, kinds[1]), (&mut *right, kinds[0])] {
            **side = as_number(side, other)?;
        }
        let kind = kinds[0].with(kinds[1]);
        let nonzero = matches!(&**right, Expr::Value(value) if matches!(&value.value, Value::Number(number, _)
            if number.bytes().any(|letter| matches!(letter, b'1'..=b'9'))));
        match op {
            Op::Divide if kind == T::Integer && nonzero => {}
            Op::Divide => {
                let name = match kind {
                    T::Numeric | T::Double => "burgeon_quotient",
                    _ => "burgeon_divide",
                };
                *expression = made(&format!("{name}({left}, {right})"), expression)?;
            }
            Op::Modulo if kind == T::Double => {
                let what = format!("{} % {}", kinds[0].name(), kinds[1].name());
                return Err(no_operator(expression, &what)
                    .help("take mod(x::numeric, y), or whole numbers: x::integer"));
            }
            Op::Modulo if kind == T::Integer && nonzero => {}
            Op::Modulo => *expression = made(&format!("burgeon_modulo({left}, {right})"), expression)?,
            _ => {}
        }
        Ok(kind)
    }

    /// Types two values that are compared; a quoted string takes the type of the other value.
    fn compared(
        &mut self,
        left: &mut Expr,
        right: &mut Expr,
        scope: &TypeScope<'_>,
        operator: &str,
    ) -> Result<[SqlType; 2]> {
        use SqlType as T;
        let kinds = [self.expression(left, scope)?, self.expression(right, scope)?];
        let class = |kind: T| match kind {
            kind if kind.is_number() => Some(0),
            T::Text => Some(1),
            T::Geometry => Some(2),
            // SQLite stores booleans as 1 or 0, so they can be compared with numbers.
            T::Boolean => Some(0),
            T::List => Some(3),
            _ => None,
        };
        if let (Some(a), Some(b)) = (class(kinds[0]), class(kinds[1]))
            && a != b
        {
            let what = format!("{} {operator} {}", kinds[0].name(), kinds[1].name());
            return Err(no_operator(left, &what).help(
                "compare numbers with numbers and texts with texts; a cast makes one of the other: name::integer",
            ));
        }
        for (side, own, other) in [(&mut *left, kinds[0], kinds[1]), (&mut *right, kinds[1], kinds[0])] {
            if own == T::Literal && (other.is_number() || other == T::Boolean) {
                *side = match other {
                    T::Boolean => made(&format!("burgeon_boolean({side})"), side)?,
                    T::Integer => made(&format!("burgeon_whole({side})"), side)?,
                    _ => as_number(side, other)?,
                };
            } else if own == T::Unknown && other.is_number() && is_placeholder(side) {
                // A parameter with a string value is converted to a number.
                *side = made(
                    &format!("CASE typeof({side}) WHEN 'text' THEN burgeon_number({side}) ELSE {side} END"),
                    side,
                )?;
            }
        }
        Ok(kinds)
    }

    fn like(&mut self, expression: &mut Expr, scope: &TypeScope<'_>) -> Result<SqlType> {
        let name = if matches!(expression, Expr::Like { .. }) { "burgeon_like" } else { "burgeon_ilike" };
        let (Expr::Like { negated, any, expr, pattern, escape_char }
        | Expr::ILike { negated, any, expr, pattern, escape_char }) = expression
        else {
            return Ok(SqlType::Unknown);
        };
        if *any {
            return Err(unsupported(expression, "LIKE ANY", "write several LIKE with OR between them"));
        }
        let kinds = [self.expression(expr, scope)?, self.expression(pattern, scope)?];
        if kinds.iter().any(|kind| kind.is_known() && *kind != SqlType::Text) {
            let what = format!("{} ~~ {}", kinds[0].name(), kinds[1].name());
            return Err(no_operator(expression, &what));
        }
        let not = if *negated { "NOT " } else { "" };
        let escape = escape_char.as_ref().map_or_else(String::new, |escape| format!(", {escape}"));
        *expression = made(&format!("({not}{name}({expr}, {pattern}{escape}))"), expression)?;
        Ok(SqlType::Boolean)
    }

    fn quantified(&mut self, expression: &mut Expr, scope: &TypeScope<'_>) -> Result<SqlType> {
        let written = match expression {
            Expr::AnyOp { left, compare_op: BinaryOperator::Eq, right, .. } => {
                query_of(right).map(|query| format!("{left} IN ({query})"))
            }
            Expr::AllOp { left, compare_op: BinaryOperator::NotEq, right } => {
                query_of(right).map(|query| format!("{left} NOT IN ({query})"))
            }
            _ => None,
        };
        match written {
            Some(written) => {
                *expression = made(&written, expression)?;
                self.expression(expression, scope)
            }
            None => Err(unsupported(
                expression,
                "a comparison with ANY or ALL",
                "write IN (...) or NOT IN (...), or compare with (SELECT min(...) ...) or (SELECT max(...) ...)",
            )),
        }
    }
}

/// Parses an expression that Burgeon wrote.
pub(super) fn made(text: &str, instead: &Expr) -> Result<Expr> {
    parse::expression(text).ok_or_else(|| {
        error_at(instead, "this is too deep to be read").help("write fewer brackets within one another")
    })
}

pub(super) fn no_operator(expression: &Expr, what: &str) -> Error {
    error_at(expression, &format!("operator does not exist: {what}"))
        .help("a cast makes one type of another: name::integer, height::text")
}

/// Returns the query of a subquery expression.
fn query_of(expression: &Expr) -> Option<&Query> {
    match expression {
        Expr::Nested(inner) => query_of(inner),
        Expr::Subquery(query) => Some(query),
        _ => None,
    }
}

fn is_placeholder(expression: &Expr) -> bool {
    matches!(expression, Expr::Value(value) if matches!(value.value, Value::Placeholder(_)))
}
