//! Nearest rows: `ORDER BY ST_Distance(t.geom, ...) LIMIT 1` uses an index.
//!
//! Without a condition, the result of a query of one table is the nearest row itself. With a condition, an increasing
//! number of nearest rows is tested until enough of them satisfy it; if too few do, all rows are tested.

use sqlparser::ast::{
    Expr, GroupByExpr, LimitClause, OrderBy, OrderByExpr, OrderByKind, OrderBySort, Query, Select,
    SelectItem, SetExpr, Value,
};
use std::borrow::Cow;

use super::operators::call;
use super::scope::{geometry_column, mentioned_relations, relations};
use super::{Catalogue, order, parse};
use crate::sql::statement_text::{quote_name, quote_text};

/// Numbers of nearest rows to test in turn for a condition: a multiple of the wanted rows, and an additional number. If
/// too few rows satisfy the condition, all rows are tested.
const STEPS: [(usize, usize); 3] = [(1, 64), (8, 1024), (64, 16_384)];

/// Rewrites a query to use an index, and returns the index's name. Also fixes the order of the rows.
pub(super) fn index(query: &mut Query, tables: &Catalogue) -> Option<String> {
    let answer = find_search(query, tables)?;
    let SetExpr::Select(select) = &mut *query.body else { return None };
    select.selection = Some(parse::expression(&answer.condition)?);
    if answer.only {
        query.order_by = None;
    } else {
        order::settle(query, tables, super::Dialect::Sqlite);
    }
    Some(answer.index)
}

struct NearestAnswer {
    /// Name of the index.
    index: String,
    /// Condition after WHERE.
    condition: String,
    /// Set if at most one row remains.
    only: bool,
}

fn find_search(query: &Query, tables: &Catalogue) -> Option<NearestAnswer> {
    let SetExpr::Select(select) = &*query.body else { return None };
    if query.with.is_some() || query.fetch.is_some() || !is_plain(select) {
        return None;
    }
    let keys = order_keys(query.order_by.as_ref()?)?;
    let first = keys.first()?;
    if !matches!(first.options.sort, None | Some(OrderBySort::Asc)) || first.options.nulls_first == Some(true)
    {
        return None;
    }
    let relations = relations(select, tables);
    let [relation] = relations.as_slice() else { return None };
    let (name, arguments) = call(ordered_expression(&first.expr, select))?;
    let [a, b] = arguments.as_slice() else { return None };
    if name != "st_distance" {
        return None;
    }
    let sides = [(a, b), (b, a)].into_iter();
    let (table, column, other) = sides.into_iter().find_map(|(own, other)| {
        let (_, table, column) = geometry_column(own, &relations)?;
        mentioned_relations(other, &relations).is_empty().then_some((table, column, other))
    })?;
    let (alias, key) = (&relation.alias.as_ref()?.value, table.key.as_ref()?);
    let wanted = count(query.limit_clause.as_ref()?)?;
    let column_of_keys = format!("{}.{}", quote_name(alias), quote_name(key));
    let name = format!("{}.{column}", table.name);
    let index = quote_text(&name);
    let (condition, only) = match &select.selection {
        None if wanted == "1" && keys.len() == 1 => {
            (format!("{column_of_keys} = burgeon_nearest_one({index}, {other})"), true)
        }
        None => {
            let nearest = format!("burgeon_nearest({index}, {other}, {wanted})");
            (format!("{column_of_keys} IN (SELECT value FROM rarray({nearest}))"), false)
        }
        Some(condition) => {
            let steps = STEPS.iter().take_while(|(_, more)| *more < 2 * table.rows).map(|(times, more)| {
                let some = format!("{wanted} * {times} + {more}");
                format!(
                    "WHEN (SELECT count(*) FROM (SELECT 1 FROM {} AS {} WHERE ({condition}) AND \
                     {column_of_keys} IN (SELECT value FROM rarray(burgeon_nearest({index}, {other}, {some}))) \
                     LIMIT {wanted})) >= {wanted} THEN {some}",
                    quote_name(&table.name),
                    quote_name(alias)
                )
            });
            let steps: Vec<String> = steps.collect();
            let enough = match steps.is_empty() {
                true => Cow::Borrowed("-1"),
                false => format!("CASE {} ELSE -1 END", steps.join(" ")).into(),
            };
            let nearest = format!("burgeon_nearest({index}, {other}, {enough})");
            (format!("{column_of_keys} IN (SELECT value FROM rarray({nearest})) AND ({condition})"), false)
        }
    };
    Some(NearestAnswer { index: name, condition, only })
}

/// Returns the expression that an order refers to by the name or the number of a column.
fn ordered_expression<'a>(key: &'a Expr, select: &'a Select) -> &'a Expr {
    let found = match key {
        Expr::Identifier(name) => select.projection.iter().find_map(|item| match item {
            SelectItem::ExprWithAlias { expr, alias } if alias.value.eq_ignore_ascii_case(&name.value) => {
                Some(expr)
            }
            _ => None,
        }),
        Expr::Value(value) => match &value.value {
            Value::Number(number, _) => {
                let index = number.parse::<usize>().ok().and_then(|number| number.checked_sub(1));
                match index.and_then(|index| select.projection.get(index)) {
                    Some(SelectItem::UnnamedExpr(expr) | SelectItem::ExprWithAlias { expr, .. }) => {
                        Some(expr)
                    }
                    _ => None,
                }
            }
            _ => None,
        },
        _ => None,
    };
    found.unwrap_or(key)
}

/// Reports whether each row of the table gives one row of the result.
fn is_plain(select: &Select) -> bool {
    let grouped = !matches!(&select.group_by, GroupByExpr::Expressions(keys, _) if keys.is_empty());
    select.distinct.is_none() && !grouped && select.having.is_none() && !order::aggregates(select)
}

fn order_keys(order: &OrderBy) -> Option<&[OrderByExpr]> {
    match &order.kind {
        OrderByKind::Expressions(keys) => Some(keys),
        OrderByKind::All(_) => None,
    }
}

/// Returns the number of wanted rows plus the offset, as a number or a sum.
fn count(limit: &LimitClause) -> Option<String> {
    let (limit, offset) = match limit {
        LimitClause::LimitOffset { limit: Some(limit), offset, .. } => {
            (limit, offset.as_ref().map(|it| &it.value))
        }
        LimitClause::OffsetCommaLimit { offset, limit } => (limit, Some(offset)),
        LimitClause::LimitOffset { limit: None, .. } => return None,
    };
    let number = |expression: &Expr| match expression {
        Expr::Value(value) => match &value.value {
            Value::Number(number, _) => number.parse::<u32>().ok().map(|number| number.to_string()),
            Value::Placeholder(name) => Some(name.clone()),
            _ => None,
        },
        _ => None,
    };
    Some(match offset {
        None => number(limit)?,
        Some(offset) => format!("({} + {})", number(limit)?, number(offset)?),
    })
}
