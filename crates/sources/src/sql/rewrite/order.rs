//! A fixed order of rows, independent of the database's plan: an unspecified order is completed with keys, or with all
//! columns.

use std::ops::ControlFlow;

use sqlparser::ast::{
    Expr, GroupByExpr, OrderBy, OrderByExpr, OrderByKind, OrderByOptions, OrderBySort, Query, Select,
    SelectItem, SetExpr,
};

use super::operators::call;
use super::scope::relations;
use super::walk::{StatementPart, walk};
use super::{Catalogue, Dialect, parse};
use crate::sql::functions::BOOLEAN_LIST;
use crate::sql::statement_text::quote_name;

/// Maximum number of columns by which rows are ordered.
const MOST_COLUMNS: usize = 64;

/// Aggregate functions.
const AGGREGATES: [&str; 18] = [
    "avg",
    "count",
    "group_concat",
    "max",
    "min",
    "string_agg",
    "sum",
    "total",
    "st_collect",
    "st_union",
    "st_extent",
    "bool_and",
    "bool_or",
    "every",
    "json_group_array",
    "array_agg",
    BOOLEAN_LIST,
    "st_memunion",
];

/// Completes the order of a query, so that rows with equal keys are ordered too, and so that LIMIT without ORDER BY is
/// deterministic.
pub(super) fn settle(query: &mut Query, tables: &Catalogue, dialect: Dialect) {
    let (given, cut) = (query.order_by.is_some(), query.limit_clause.is_some());
    if !given && !cut {
        return;
    }
    let more = last_resort(query, tables);
    let order = query
        .order_by
        .get_or_insert_with(|| OrderBy { kind: OrderByKind::Expressions(Vec::new()), interpolate: None });
    let OrderByKind::Expressions(keys) = &mut order.kind else { return };
    if dialect == Dialect::Sqlite {
        // As in PostgreSQL, null is greater than all other values.
        for key in keys.iter_mut().filter(|key| key.options.nulls_first.is_none()) {
            key.options.nulls_first = Some(matches!(key.options.sort, Some(OrderBySort::Desc)));
        }
    }
    keys.extend(more);
    if keys.is_empty() {
        query.order_by = None;
    }
}

/// Returns the final sort keys: the keys of all tables if each combination of their rows gives one row, otherwise all
/// columns.
fn last_resort(query: &Query, tables: &Catalogue) -> Vec<OrderByExpr> {
    let key = |text: &str| {
        let expr = parse::expression(text)?;
        Some(OrderByExpr { expr, options: OrderByOptions::default(), with_fill: None })
    };
    let SetExpr::Select(select) = &*query.body else {
        return columns(&query.body).map_or_else(Vec::new, |count| numbers(count, key));
    };
    let grouped = !matches!(&select.group_by, GroupByExpr::Expressions(keys, _) if keys.is_empty());
    if select.distinct.is_none() && !grouped && !aggregates(select) {
        let relations = relations(select, tables);
        let keys = relations.iter().map(|relation| {
            let (alias, own) = (relation.alias.as_ref()?, relation.table?.key.as_ref()?);
            key(&format!("{}.{}", quote_name(&alias.value), quote_name(own)))
        });
        if let Some(keys) = keys.collect::<Option<Vec<_>>>() {
            return keys;
        }
    }
    columns(&query.body).map_or_else(Vec::new, |count| numbers(count, key))
}

fn numbers(count: usize, key: impl Fn(&str) -> Option<OrderByExpr>) -> Vec<OrderByExpr> {
    (1..=count.min(MOST_COLUMNS)).filter_map(|number| key(&number.to_string())).collect()
}

/// Returns the number of columns, or `None` if it is hidden by a star.
fn columns(body: &SetExpr) -> Option<usize> {
    match body {
        SetExpr::Select(select) => {
            let plain = |item: &SelectItem| {
                matches!(item, SelectItem::UnnamedExpr(_) | SelectItem::ExprWithAlias { .. })
            };
            select.projection.iter().all(plain).then_some(select.projection.len())
        }
        SetExpr::SetOperation { left, .. } => columns(left),
        SetExpr::Query(query) => columns(&query.body),
        _ => None,
    }
}

/// Returns true if there is no GROUP BY.
pub(super) fn is_ungrouped(keys: &GroupByExpr) -> bool {
    matches!(keys, GroupByExpr::Expressions(keys, _) if keys.is_empty())
}

/// Reports whether the projection contains an aggregate.
pub(super) fn aggregates(select: &Select) -> bool {
    let walked = walk(&select.projection, |part| match part {
        StatementPart::Expression(expression) if is_aggregate(expression) => ControlFlow::Break(()),
        _ => ControlFlow::Continue(()),
    });
    walked.is_break()
}

/// Reports whether an expression is a call of an aggregate function.
pub(super) fn is_aggregate(expression: &Expr) -> bool {
    let Expr::Function(function) = expression else { return false };
    // With several arguments, these are scalar functions.
    let of_one_row = call(expression).is_some_and(|(name, arguments)| {
        matches!(name.as_str(), "max" | "min" | "st_collect" | "st_union") && arguments.len() > 1
    });
    !of_one_row && AGGREGATES.contains(&function.name.to_string().to_ascii_lowercase().as_str())
}
