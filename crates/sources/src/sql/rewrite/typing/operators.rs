//! The types of operators, and their translation from PostgreSQL to SQLite.

use sqlparser::ast::{BinaryOperator, Expr, Query, Value};

use super::conversions::{make_number, make_text, no_operator, parse_generated, unsupported_error};
use super::scope::{TypeScope, Typing};
use crate::sql::rewrite::types::SqlType;
use burgeon_base::error::Result;

impl Typing<'_> {
    /// Types an operator and its operands.
    pub(super) fn operator(&mut self, expression: &mut Expr, scope: &TypeScope<'_>) -> Result<SqlType> {
        use BinaryOperator as Op;
        use SqlType as T;
        let Expr::BinaryOp { left, op, right } = expression else { return Ok(T::Unknown) };
        match op {
            Op::Eq | Op::NotEq | Op::Lt | Op::LtEq | Op::Gt | Op::GtEq => {
                let name = op.to_string();
                let kinds = self.compare(left, right, scope, &name)?;
                if kinds == [T::Geometry; 2] && matches!(op, Op::Eq | Op::NotEq) {
                    let not = if *op == Op::Eq { "" } else { "NOT " };
                    *expression =
                        parse_generated(&format!("({not}geometry_same({left}, {right}))"), expression)?;
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
                *expression = parse_generated(&format!("power({left}, {right})"), expression)?;
                self.expression(expression, scope)
            }
            Op::StringConcat => {
                let kinds = [self.expression(left, scope)?, self.expression(right, scope)?];
                if kinds.iter().all(|kind| kind.is_number()) {
                    let what = format!("{} || {}", kinds[0].name(), kinds[1].name());
                    return Err(no_operator(expression, &what));
                }
                for (side, kind) in [left, right].into_iter().zip(kinds) {
                    make_text(side, kind)?;
                }
                Ok(T::Text)
            }
            Op::LtDashGt => {
                *expression = parse_generated(&format!("ST_Distance({left}, {right})"), expression)?;
                self.expression(expression, scope)
            }
            Op::PGOverlap => {
                *expression = parse_generated(&format!("geometry_overlaps({left}, {right})"), expression)?;
                self.expression(expression, scope)
            }
            Op::PGRegexMatch | Op::PGRegexIMatch | Op::PGRegexNotMatch | Op::PGRegexNotIMatch => {
                Err(unsupported_error(expression, "a regular expression", "write LIKE or ILIKE with % and _"))
            }
            _ => {
                self.expression(left, scope)?;
                self.expression(right, scope)?;
                Ok(T::Unknown)
            }
        }
    }

    /// Types an arithmetic operator.
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
            make_number(side, other)?;
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
                *expression = parse_generated(&format!("{name}({left}, {right})"), expression)?;
            }
            Op::Modulo if kind == T::Double => {
                let what = format!("{} % {}", kinds[0].name(), kinds[1].name());
                return Err(no_operator(expression, &what)
                    .help("take mod(x::numeric, y), or whole numbers: x::integer"));
            }
            Op::Modulo if kind == T::Integer && nonzero => {}
            Op::Modulo => {
                *expression = parse_generated(&format!("burgeon_modulo({left}, {right})"), expression)?
            }
            _ => {}
        }
        Ok(kind)
    }

    /// Types two values that are compared; a quoted string takes the type of the other value.
    pub(super) fn compare(
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
                match other {
                    T::Boolean => *side = parse_generated(&format!("burgeon_boolean({side})"), side)?,
                    T::Integer => *side = parse_generated(&format!("burgeon_whole({side})"), side)?,
                    _ => make_number(side, other)?,
                }
            } else if own == T::Unknown && other.is_number() && is_placeholder(side) {
                // A parameter with a string value is converted to a number.
                *side = parse_generated(
                    &format!("CASE typeof({side}) WHEN 'text' THEN burgeon_number({side}) ELSE {side} END"),
                    side,
                )?;
            }
        }
        Ok(kinds)
    }

    /// Types LIKE or ILIKE.
    pub(super) fn like(&mut self, expression: &mut Expr, scope: &TypeScope<'_>) -> Result<SqlType> {
        let name = if matches!(expression, Expr::Like { .. }) { "burgeon_like" } else { "burgeon_ilike" };
        let (Expr::Like { negated, any, expr, pattern, escape_char }
        | Expr::ILike { negated, any, expr, pattern, escape_char }) = expression
        else {
            return Ok(SqlType::Unknown);
        };
        if *any {
            return Err(unsupported_error(expression, "LIKE ANY", "write several LIKE with OR between them"));
        }
        let kinds = [self.expression(expr, scope)?, self.expression(pattern, scope)?];
        if kinds.iter().any(|kind| kind.is_known() && *kind != SqlType::Text) {
            let what = format!("{} ~~ {}", kinds[0].name(), kinds[1].name());
            return Err(no_operator(expression, &what));
        }
        let not = if *negated { "NOT " } else { "" };
        let escape = escape_char.as_ref().map_or_else(String::new, |escape| format!(", {escape}"));
        *expression = parse_generated(&format!("({not}{name}({expr}, {pattern}{escape}))"), expression)?;
        Ok(SqlType::Boolean)
    }

    /// Rewrites a comparison with ANY or ALL as IN.
    pub(super) fn quantifier(&mut self, expression: &mut Expr, scope: &TypeScope<'_>) -> Result<SqlType> {
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
                *expression = parse_generated(&written, expression)?;
                self.expression(expression, scope)
            }
            None => Err(unsupported_error(
                expression,
                "a comparison with ANY or ALL",
                "write IN (...) or NOT IN (...), or compare with (SELECT min(...) ...) or (SELECT max(...) ...)",
            )),
        }
    }
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
