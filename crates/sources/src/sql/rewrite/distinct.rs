//! `DISTINCT ON`, which SQLite lacks, as the first row of each window.

use std::borrow::Cow;

use sqlparser::ast::{
    Distinct, Expr, Ident, OrderBy, OrderByExpr, OrderByKind, Query, SelectItem,
    SelectItemQualifiedWildcardKind, SetExpr, Value,
};

use super::Catalogue;
use super::parse;
use super::scope::{FromItem, relations};
use super::substitute::each_query;
use super::typing::column_name;
use crate::sql::statement_text::quote_name;
use burgeon_base::error::{Error, Result};

/// Rewrites each `DISTINCT ON` as a query of the first rows of windows.
pub(super) fn rewrite(query: &mut Query, tables: &Catalogue) -> Result<()> {
    each_query(query, |query| {
        let is_on = matches!(&*query.body, SetExpr::Select(select) if matches!(select.distinct, Some(Distinct::On(_))));
        if is_on {
            let made = window_query(query, tables).ok_or_else(|| {
                Error::argument("SQL: DISTINCT ON is not supported here beside a star of a subquery")
                    .help("name the columns in place of the star")
            })?;
            *query = made;
        }
        Ok(())
    })
}

/// A column of the result, with its name and its expression.
type ResultColumn<'a> = (Cow<'a, str>, Expr);

/// Returns the column that an expression of an order or a key means by its name or its number, or the expression
/// itself.
fn meant<'a>(expression: &'a Expr, columns: &'a [ResultColumn<'_>]) -> Option<&'a Expr> {
    match expression {
        Expr::Value(value) => match &value.value {
            Value::Number(number, _) => {
                let index = number.parse::<usize>().ok()?.checked_sub(1)?;
                columns.get(index).map(|(_, expression)| expression)
            }
            _ => Some(expression),
        },
        Expr::Identifier(name) => {
            let named = columns.iter().find(|(known, _)| known.eq_ignore_ascii_case(&name.value));
            Some(named.map_or(expression, |(_, expression)| expression))
        }
        other => Some(other),
    }
}

/// Returns the query of windows that replaces `query`, whose parts it takes.
fn window_query(query: &mut Query, tables: &Catalogue) -> Option<Query> {
    let SetExpr::Select(select) = &mut *query.body else { return None };
    let Some(Distinct::On(keys)) = select.distinct.take() else { return None };
    let relations = relations(select, tables);
    let mut columns: Vec<ResultColumn<'_>> = Vec::new();
    for item in std::mem::take(&mut select.projection) {
        match item {
            SelectItem::UnnamedExpr(expression) => {
                columns.push((column_name(&expression).into(), expression))
            }
            SelectItem::ExprWithAlias { expr, alias } => columns.push((alias.value.into(), expr)),
            SelectItem::Wildcard(_) => columns.extend(all(&relations, None)?),
            SelectItem::QualifiedWildcard(SelectItemQualifiedWildcardKind::ObjectName(name), _) => {
                columns.extend(all(&relations, Some(&name.0.last()?.as_ident()?.value))?);
            }
            _ => return None,
        }
    }
    let is_ordered = query.order_by.is_some();
    let mut order: Vec<OrderByExpr> = match query.order_by.take().map(|order| order.kind) {
        Some(OrderByKind::Expressions(keys)) => keys,
        Some(OrderByKind::All(_)) => return None,
        None => Vec::new(),
    };
    for key in &mut order {
        let column = meant(&key.expr, &columns)?;
        if !std::ptr::eq(column, &raw const key.expr) {
            key.expr = column.clone();
        }
    }
    // As in PostgreSQL, null is greater than all other values.
    for key in order.iter_mut().filter(|key| key.options.nulls_first.is_none()) {
        let falls = matches!(key.options.sort, Some(sqlparser::ast::OrderBySort::Desc));
        key.options.nulls_first = Some(falls);
    }
    let ties = relations.iter().filter_map(|relation| {
        let (alias, key) = (relation.alias.as_ref()?, relation.table?.key.as_ref()?);
        Some(format!("{}.{}", quote_name(&alias.value), quote_name(key)))
    });
    let ordered: Vec<String> = order.iter().map(ToString::to_string).chain(ties).collect();
    let parts: Option<Vec<String>> = keys.iter().map(|key| Some(meant(key, &columns)?.to_string())).collect();
    let parts = parts?;
    let over = match ordered.is_empty() {
        true => format!("PARTITION BY {}", parts.join(", ")),
        false => format!("PARTITION BY {} ORDER BY {}", parts.join(", "), ordered.join(", ")),
    };
    let outer: Vec<String> = columns
        .iter()
        .enumerate()
        .map(|(index, (name, _))| format!("burgeon_c{} AS {}", index + 1, quote_name(name)))
        .collect();
    // The groups are sorted by their keys, as if PostgreSQL sorts them.
    let sorted: Vec<String> = match order.is_empty() {
        true => (1..=parts.len()).map(|index| format!("burgeon_p{index} NULLS LAST")).collect(),
        false => order
            .iter()
            .enumerate()
            .map(|(index, key)| format!("burgeon_k{}{}", index + 1, key.options))
            .collect(),
    };
    let mut add = |expression: Expr, alias: String| {
        select.projection.push(SelectItem::ExprWithAlias { expr: expression, alias: Ident::new(alias) });
    };
    for (index, (_, expression)) in columns.into_iter().enumerate() {
        add(expression, format!("burgeon_c{}", index + 1));
    }
    for (index, key) in order.into_iter().enumerate() {
        add(key.expr, format!("burgeon_k{}", index + 1));
    }
    for (index, part) in parts.iter().enumerate() {
        add(parse::expression(part)?, format!("burgeon_p{}", index + 1));
    }
    add(parse::expression(&format!("row_number() OVER ({over})"))?, "burgeon_row".into());
    let text = format!(
        "SELECT {} FROM ({select}) AS burgeon_first WHERE burgeon_row = 1 ORDER BY {}",
        outer.join(", "),
        sorted.join(", ")
    );
    let mut made = *parse::parse(&text).ok()?.query;
    made.with = query.with.take();
    made.limit_clause = query.limit_clause.take();
    made.fetch = query.fetch.take();
    if made.limit_clause.is_none() && !is_ordered {
        made.order_by = None::<OrderBy>;
    }
    Some(made)
}

/// Returns the columns of all relations, or of one.
fn all<'a>(relations: &[FromItem<'a>], owner: Option<&str>) -> Option<Vec<ResultColumn<'a>>> {
    let mut columns = Vec::new();
    for relation in relations {
        let alias = &relation.alias.as_ref()?.value;
        if owner.is_some_and(|owner| !owner.eq_ignore_ascii_case(alias)) {
            continue;
        }
        for name in &relation.table?.columns {
            let expression = parse::expression(&format!("{}.{}", quote_name(alias), quote_name(name)))?;
            columns.push((Cow::Borrowed(name.as_str()), expression));
        }
    }
    Some(columns)
}
