//! What PostgreSQL writes otherwise than SQLite.

use sqlparser::ast::{
    BinaryOperator, CastKind, DataType, Expr, Function, FunctionArg, FunctionArgExpr, FunctionArguments,
    Query, UnaryOperator, Value,
};

use super::parse;
use super::walk::{StatementPartMut, walk_mut};
use crate::functions;

/// Writes operators and casts of PostGIS as SQLite has them.
pub(super) fn translate(query: &mut Query) {
    walk_mut(query, |part| {
        if let StatementPartMut::Expression(expression) = part
            && let Some(other) = translated(expression)
        {
            *expression = other;
        }
    });
}

fn translated(expression: &mut Expr) -> Option<Expr> {
    match expression {
        Expr::BinaryOp { left, op: BinaryOperator::LtDashGt, right } => {
            parse::expression(&format!("ST_Distance({left}, {right})"))
        }
        Expr::BinaryOp { left, op: BinaryOperator::PGOverlap, right } => {
            parse::expression(&format!("geometry_overlaps({left}, {right})"))
        }
        Expr::ILike { negated, any: false, expr, pattern, escape_char: None } => {
            let not = if *negated { "NOT " } else { "" };
            parse::expression(&format!("(lower({expr}) {not}LIKE lower({pattern}))"))
        }
        Expr::Cast { kind: kind @ (CastKind::DoubleColon | CastKind::Cast), expr, data_type, .. } => {
            if data_type.to_string().to_ascii_lowercase().starts_with("geometry") {
                return Some(match &**expr {
                    text @ Expr::Value(_) if is_text(text) => {
                        parse::expression(&format!("ST_GeomFromText({text})"))?
                    }
                    other => other.clone(),
                });
            }
            if matches!(data_type, DataType::Boolean | DataType::Bool) {
                return Some((**expr).clone());
            }
            // SQLite makes a number of what is cast to a type that it does not know.
            if let DataType::Custom(name, _) = data_type {
                return parse::expression(&format!("{name}({expr})"));
            }
            *kind = CastKind::Cast;
            None
        }
        _ => None,
    }
}

fn is_text(expression: &Expr) -> bool {
    matches!(expression, Expr::Value(value) if matches!(value.value, Value::SingleQuotedString(_)))
}

/// The name in small letters and the arguments of a plain call of a function.
pub(super) fn call(expression: &Expr) -> Option<(String, Vec<&Expr>)> {
    let Expr::Function(Function {
        name, args: FunctionArguments::List(list), filter: None, over: None, ..
    }) = expression
    else {
        return None;
    };
    let [part] = name.0.as_slice() else { return None };
    let plain = |argument| match argument {
        &FunctionArg::Unnamed(FunctionArgExpr::Expr(ref expression)) => Some(expression),
        _ => None,
    };
    let arguments: Option<Vec<&Expr>> = list.args.iter().map(plain).collect();
    Some((part.as_ident()?.value.to_ascii_lowercase(), arguments?))
}

/// Whether an expression is true or false, whatever it is made of.
pub(super) fn is_boolean(expression: &Expr) -> bool {
    use BinaryOperator as Op;
    match expression {
        Expr::Nested(inner) => is_boolean(inner),
        Expr::IsNull(_)
        | Expr::IsNotNull(_)
        | Expr::IsTrue(_)
        | Expr::IsNotTrue(_)
        | Expr::IsFalse(_)
        | Expr::IsNotFalse(_)
        | Expr::IsDistinctFrom(..)
        | Expr::IsNotDistinctFrom(..)
        | Expr::InList { .. }
        | Expr::InSubquery { .. }
        | Expr::Between { .. }
        | Expr::Like { .. }
        | Expr::ILike { .. }
        | Expr::Exists { .. }
        | Expr::UnaryOp { op: UnaryOperator::Not, .. } => true,
        Expr::BinaryOp { op, .. } => matches!(
            op,
            Op::Gt
                | Op::Lt
                | Op::GtEq
                | Op::LtEq
                | Op::Eq
                | Op::NotEq
                | Op::And
                | Op::Or
                | Op::PGOverlap
                | Op::Glob
        ),
        Expr::Value(value) => matches!(value.value, Value::Boolean(_)),
        Expr::Cast { data_type, .. } => matches!(data_type, DataType::Boolean | DataType::Bool),
        other => call(other).is_some_and(|(name, _)| functions::is_predicate(&name)),
    }
}
