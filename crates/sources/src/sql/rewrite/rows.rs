//! Functions that return several rows, after FROM or in a projection, as lists that SQLite reads.

use std::borrow::Cow;

use sqlparser::ast::{
    AccessExpr, Expr, Function, FunctionArguments, Ident, Query, Select, SelectItem, Spanned, TableFactor,
};

use super::Catalogue;
use super::parse;
use super::scope::relations;
use super::substitute::{Substitution, each_query, factors, select_of, set_alias, substitute};
use super::typing::{column_name, error_at};
use super::walk::walk_expressions;
use crate::sql::functions::ROW_FUNCTIONS;
use crate::sql::statement_text::quote_name;
use burgeon_base::error::Result;

/// Columns of the results of ST_Dump and similar functions, and the corresponding columns of a list.
const DUMPED: [(&str, &str); 3] = [("geom", "value"), ("path[1]", "rowid"), ("path", "rowid")];

/// Rewrites functions of rows as lists.
pub(super) fn expand(query: &mut Query, tables: &Catalogue) -> Result<()> {
    each_query(query, |query| {
        if let Some(select) = select_of(query) {
            let mut found = in_from(select, tables);
            found.extend(in_projection(query, tables)?);
            if !found.is_empty() {
                substitute_named(query, &found);
            }
        }
        Ok(())
    })
}

/// Substitutes columns, and keeps the names of the columns of the projection.
fn substitute_named(query: &mut Query, found: &[Substitution]) {
    let plain = |item: &SelectItem| match item {
        SelectItem::UnnamedExpr(expression) => Some((column_name(expression), expression.to_string())),
        _ => None,
    };
    let names: Vec<Option<(String, String)>> =
        select_of(query).map(|select| select.projection.iter().map(plain).collect()).unwrap_or_default();
    substitute(query, found);
    let Some(select) = select_of(query) else { return };
    for (item, named) in select.projection.iter_mut().zip(names) {
        if let (SelectItem::UnnamedExpr(expression), Some((name, text))) = (&*item, named)
            && expression.to_string() != text
        {
            set_alias(item, Ident::with_quote('"', name));
        }
    }
}

/// Returns the function of SQLite that replaces a function of rows.
fn own(name: &str) -> Option<(&'static str, &'static str)> {
    let plain = name.trim_matches('"').to_ascii_lowercase();
    ROW_FUNCTIONS.iter().find(|(known, _)| *known == plain).copied()
}

fn in_from(select: &mut Select, tables: &Catalogue) -> Vec<Substitution> {
    let known: Vec<String> = relations(select, tables)
        .iter()
        .filter_map(|relation| relation.table)
        .flat_map(|table| table.columns.iter().map(|name| name.to_ascii_lowercase()))
        .collect();
    let mut found = Vec::new();
    for factor in factors(select) {
        let (name, arguments, alias) = match factor {
            TableFactor::Table { name, args: Some(args), alias, .. } => (name, &args.args, alias),
            TableFactor::Function { name, args, alias, .. } => (name, &*args, alias),
            _ => continue,
        };
        let Some((plain, own)) = own(&name.to_string()) else { continue };
        let arguments: Vec<String> = arguments.iter().map(ToString::to_string).collect();
        let called = alias.as_ref().map_or(plain, |alias| alias.name.value.as_str());
        let text = format!("rarray({own}({})) AS {}", arguments.join(", "), quote_name(called));
        let Some(list) = parse::relation(&text) else { continue };
        let (TableFactor::Table { alias, .. } | TableFactor::Function { alias, .. }) =
            std::mem::replace(factor, list)
        else {
            continue;
        };
        let (called, columns) = match alias {
            Some(alias) => (Cow::Owned(alias.name.value), alias.columns),
            None => (Cow::Borrowed(plain), Vec::new()),
        };
        let mut add = |column: Cow<'static, str>, of_list: &str, alone: bool| {
            if let Some(expression) = parse::expression(&format!("{}.{of_list}", quote_name(&called))) {
                found.push(Substitution { owner: called.to_string(), column, alone, expression });
            }
        };
        if plain.starts_with("st_dump") {
            for (column, of_list) in DUMPED {
                add(column.into(), of_list, !known.iter().any(|known| known == column));
            }
        } else {
            let named = columns.into_iter().next().map(|column| Cow::Owned(column.name.value));
            let column = named.unwrap_or_else(|| called.clone());
            let alone = !known.contains(&column.to_ascii_lowercase());
            add(column, "value", alone);
        }
    }
    found
}

/// Adds a list for the function of rows in a projection. Returns no substitutions, because each call is replaced
/// directly.
fn in_projection(query: &mut Query, _: &Catalogue) -> Result<Vec<Substitution>> {
    let Some(select) = select_of(query) else { return Ok(Vec::new()) };
    let mut calls: Vec<String> = Vec::new();
    let mut wrong = None;
    for item in &mut select.projection {
        let (SelectItem::UnnamedExpr(expression) | SelectItem::ExprWithAlias { expr: expression, .. }) = item
        else {
            continue;
        };
        let (before, written) = (calls.len(), column_name(expression));
        let start = expression.span().start;
        walk_expressions(expression, &mut |part: &mut Expr| {
            let (call, column) = match &*part {
                Expr::CompoundFieldAccess { root, access_chain } => {
                    let root = if let Expr::Nested(inner) = &**root { &**inner } else { &**root };
                    let [AccessExpr::Dot(Expr::Identifier(column))] = access_chain.as_slice() else { return };
                    (root, DUMPED.iter().find(|(name, _)| column.value.eq_ignore_ascii_case(name)))
                }
                other => (other, None),
            };
            let Expr::Function(Function { name, args: FunctionArguments::List(list), over: None, .. }) = call
            else {
                return;
            };
            let Some((plain, own)) = own(&name.to_string()) else { return };
            let column = match (plain.starts_with("st_dump"), column) {
                (true, Some((_, column))) => *column,
                (false, None) => "value",
                // The field access around the call is handled later in the walk.
                _ => return,
            };
            let text = format!("{own}({list})");
            let index = calls.iter().position(|known| *known == text).unwrap_or_else(|| {
                calls.push(text);
                calls.len() - 1
            });
            if let Some(made) = parse::expression(&format!("burgeon_rows{}.{column}", index + 1)) {
                *part = made;
            }
        });
        if calls.len() > 1 {
            wrong.get_or_insert_with(|| {
                error_at(&start, "several functions that give rows stand in one SELECT")
                    .help("put them behind FROM: SELECT ... FROM houses, ST_Dump(houses.geom) AS d")
            });
        }
        // A column keeps its name.
        if let (SelectItem::UnnamedExpr(_), true) = (&*item, calls.len() > before) {
            set_alias(item, Ident::with_quote('"', written));
        }
    }
    if let Some(wrong) = wrong {
        return Err(wrong);
    }
    for (index, call) in calls.iter().enumerate() {
        let text = format!("rarray({call}) AS burgeon_rows{}", index + 1);
        let Some(list) = parse::relation(&text) else { continue };
        select.from.push(sqlparser::ast::TableWithJoins { relation: list, joins: Vec::new() });
    }
    Ok(Vec::new())
}
