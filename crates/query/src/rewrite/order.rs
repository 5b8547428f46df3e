//! One order of rows, whatever way a database goes: what a statement leaves open is decided by keys, and by all columns.

use std::ops::ControlFlow;

use sqlparser::ast::{
    Expr, GroupByExpr, OrderBy, OrderByExpr, OrderByKind, OrderByOptions, OrderBySort, Query, Select,
    SelectItem, SetExpr,
};

use super::operators::call;
use super::scope::{quoted, relations};
use super::walk::{StatementPart, walk};
use super::{Catalogue, Dialect, parse};
use crate::functions::BOOLEAN_LIST;

/// The most columns that rows are ordered by.
const MOST_COLUMNS: usize = 64;

/// Functions of many rows.
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

/// Has rows that are equal in what a query orders by ordered too, and those that are cut off where it orders by nothing.
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
        // As PostgreSQL has it: what is not known is greater than all else.
        for key in keys.iter_mut().filter(|key| key.options.nulls_first.is_none()) {
            key.options.nulls_first = Some(matches!(key.options.sort, Some(OrderBySort::Desc)));
        }
    }
    keys.extend(more);
    if keys.is_empty() {
        query.order_by = None;
    }
}

/// What decides last: the keys of all tables where each row of theirs gives one, or all columns.
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
            key(&format!("{}.{}", quoted(&alias.value), quoted(own)))
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

/// How many columns there are; nothing where a star hides it.
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

/// Whether rows are not grouped by anything.
pub(super) fn is_ungrouped(keys: &GroupByExpr) -> bool {
    matches!(keys, GroupByExpr::Expressions(keys, _) if keys.is_empty())
}

/// Whether many rows give one.
pub(super) fn aggregates(select: &Select) -> bool {
    let walked = walk(&select.projection, |part| match part {
        StatementPart::Expression(expression) if is_aggregate(expression) => ControlFlow::Break(()),
        _ => ControlFlow::Continue(()),
    });
    walked.is_break()
}

/// Whether an expression is the call of a function of many rows.
pub(super) fn is_aggregate(expression: &Expr) -> bool {
    let Expr::Function(function) = expression else { return false };
    // With several arguments these are functions of one row.
    let of_one_row = call(expression).is_some_and(|(name, arguments)| {
        matches!(name.as_str(), "max" | "min" | "st_collect" | "st_union") && arguments.len() > 1
    });
    !of_one_row && AGGREGATES.contains(&function.name.to_string().to_ascii_lowercase().as_str())
}
