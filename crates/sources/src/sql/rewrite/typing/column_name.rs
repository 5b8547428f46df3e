//! The names of columns without an alias, as PostgreSQL gives them.

use sqlparser::ast::{Expr, Ident, ObjectName, SelectItem, SetExpr, Value};

use crate::sql::rewrite::types::SqlType;

/// Returns the name that PostgreSQL gives to a column without an alias.
pub(in crate::sql::rewrite) fn column_name(expression: &Expr) -> String {
    let last = |name: &ObjectName| {
        let part = name.0.last().and_then(|part| part.as_ident());
        part.map_or_else(String::new, shown_name)
    };
    match expression {
        Expr::Identifier(name) => shown_name(name),
        Expr::CompoundIdentifier(names) => names.last().map_or_else(String::new, shown_name),
        Expr::CompoundFieldAccess { access_chain, .. } => access_chain
            .iter()
            .rev()
            .find_map(|access| match access {
                sqlparser::ast::AccessExpr::Dot(Expr::Identifier(name)) => Some(shown_name(name)),
                _ => None,
            })
            .unwrap_or_else(|| "?column?".into()),
        Expr::Nested(inner) | Expr::Collate { expr: inner, .. } => column_name(inner),
        Expr::Function(function) => last(&function.name),
        Expr::Cast { expr, data_type, .. } => match column_name(expr) {
            name if name != "?column?" => name,
            _ => match SqlType::from_name(&data_type.to_string()) {
                Some(SqlType::Integer) => "int4".into(),
                Some(SqlType::Double) => "float8".into(),
                Some(SqlType::Boolean) => "bool".into(),
                _ => data_type.to_string().to_ascii_lowercase(),
            },
        },
        Expr::Case { else_result, .. } => match else_result.as_deref().map(column_name) {
            Some(name) if name != "?column?" => name,
            _ => "case".into(),
        },
        Expr::Exists { .. } => "exists".into(),
        Expr::Substring { .. } => "substring".into(),
        Expr::Position { .. } => "position".into(),
        Expr::Trim { trim_where, .. } => match trim_where {
            Some(sqlparser::ast::TrimWhereField::Leading) => "ltrim".into(),
            Some(sqlparser::ast::TrimWhereField::Trailing) => "rtrim".into(),
            _ => "btrim".into(),
        },
        Expr::Ceil { .. } => "ceil".into(),
        Expr::Floor { .. } => "floor".into(),
        Expr::Value(value) if matches!(value.value, Value::Boolean(_)) => "bool".into(),
        Expr::Array(_) => "array".into(),
        Expr::Subquery(query) => match &*query.body {
            SetExpr::Select(select) => match select.projection.first() {
                Some(SelectItem::UnnamedExpr(expression)) => column_name(expression),
                Some(SelectItem::ExprWithAlias { alias, .. }) => shown_name(alias),
                _ => "?column?".into(),
            },
            _ => "?column?".into(),
        },
        _ => "?column?".into(),
    }
}

fn shown_name(name: &Ident) -> String {
    if name.quote_style.is_some() { name.value.clone() } else { name.value.to_ascii_lowercase() }
}
