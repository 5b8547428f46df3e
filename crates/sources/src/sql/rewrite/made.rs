//! Subqueries that are joined with each other by their geometries: one of them is materialized first, as a table with
//! keys, so that the join can use an index.

use std::hash::BuildHasher as _;
use std::ops::ControlFlow;

use rustc_hash::FxBuildHasher;
use sqlparser::ast::{
    Expr, Ident, Query, Select, SelectItem, SelectItemQualifiedWildcardKind, SetExpr, TableFactor,
};

use super::operators::call;
use super::parse;
use super::scope::{geometry_column, relations};
use super::substitute::factors;
use super::types::{ColumnTypes, SqlType};
use super::typing;
use super::walk::{StatementPart, walk};
use super::{Catalogue, TableInfo};
use crate::sql::statement_text::quote_name;

/// Name of the key of a materialized subquery.
const KEY: &str = "burgeon_key";

/// Functions of two geometries that can use an index.
const FUNCTIONS: [&str; 12] = [
    "st_intersects",
    "st_contains",
    "st_within",
    "st_overlaps",
    "st_touches",
    "st_crosses",
    "st_covers",
    "st_coveredby",
    "st_equals",
    "st_dwithin",
    "st_distance",
    "geometry_overlaps",
];

/// A subquery that is materialized as a table before the statement runs.
#[derive(Debug, Clone)]
pub(crate) struct MadeTable {
    /// Description of the table.
    pub info: TableInfo,
    /// SQL of the subquery.
    pub sql: String,
}

/// Replaces the names of declared subqueries with the subqueries themselves if they are joined by geometries.
pub(super) fn inline(query: &mut Query, tables: &Catalogue) {
    let Some(with) = query.with.as_ref().filter(|with| !with.recursive) else { return };
    let SetExpr::Select(select) = &mut *query.body else { return };
    let wanted = joined_subqueries(select, tables);
    for factor in factors(select) {
        let TableFactor::Table { name, alias, args: None, .. } = factor else { continue };
        let own = name.to_string();
        let called = alias.as_ref().map_or(own.as_str(), |alias| alias.name.value.as_str());
        let declared =
            with.cte_tables.iter().position(|table| table.alias.name.value.eq_ignore_ascii_case(&own));
        let Some(index) = declared.filter(|_| wanted.iter().any(|name| name.eq_ignore_ascii_case(called)))
        else {
            continue;
        };
        let table = &with.cte_tables[index];
        if !table.alias.columns.is_empty() || table.query.with.is_some() {
            continue;
        }
        let before: Vec<String> = with.cte_tables[..index].iter().map(ToString::to_string).collect();
        let before = if before.is_empty() { String::new() } else { format!("WITH {} ", before.join(", ")) };
        let text = format!("({before}{}) AS {}", table.query, quote_name(called));
        if let Some(made) = parse::relation(&text) {
            *factor = made;
        }
    }
}

/// Materializes the subqueries after FROM that need an index, and adds them to `tables`.
pub(super) fn make(select: &mut Select, tables: &mut Catalogue) -> Vec<MadeTable> {
    let mut made = Vec::new();
    for called in joined_subqueries(select, tables) {
        let found = factors(select).find_map(|factor| match factor {
            TableFactor::Derived { lateral: false, subquery, alias: Some(alias), .. }
                if alias.name.value.eq_ignore_ascii_case(&called) && alias.columns.is_empty() =>
            {
                Some(&**subquery)
            }
            _ => None,
        });
        let Some(table) = found.and_then(|subquery| table(subquery, tables)) else { continue };
        // A star must not include the key.
        if !expand_stars(select, tables, &called, &table.info) {
            continue;
        }
        let text = format!("{} AS {}", quote_name(&table.info.name), quote_name(&called));
        for factor in factors(select) {
            let is_it = matches!(factor, TableFactor::Derived { alias: Some(alias), .. }
                if alias.name.value.eq_ignore_ascii_case(&called));
            if let (true, Some(relation)) = (is_it, parse::relation(&text)) {
                *factor = relation;
            }
        }
        tables.insert(table.info.name.to_ascii_lowercase(), table.info.clone());
        made.push(table);
    }
    made
}

/// Returns the names of subqueries whose geometries are compared with those of other subqueries.
fn joined_subqueries(select: &Select, tables: &Catalogue) -> Vec<String> {
    let mut items = relations(select, tables);
    let unknown = |name: &Ident| {
        items
            .iter()
            .rposition(|item| {
                item.alias.as_ref().is_some_and(|alias| alias.value.eq_ignore_ascii_case(&name.value))
            })
            .filter(|index| items[*index].table.is_none())
    };
    let mut found: Vec<usize> = Vec::new();
    let mut look = |expression: &Expr| {
        let _ = walk(expression, |part| {
            let StatementPart::Expression(expression) = part else { return ControlFlow::Continue(()) };
            if let Some((name, arguments)) = call(expression)
                && FUNCTIONS.contains(&name.as_str())
                && let [a, b, ..] = arguments.as_slice()
            {
                let side = |expression: &Expr| match expression {
                    Expr::CompoundIdentifier(names) => match names.as_slice() {
                        [owner, _] => unknown(owner),
                        _ => None,
                    },
                    _ => None,
                };
                let known = [a, b].iter().any(|side| geometry_column(side, &items).is_some());
                // Of two subqueries, the later one is looked up.
                if let (false, Some(index)) = (known, side(a).max(side(b)))
                    && [a, b].iter().any(|other| side(other) != Some(index))
                {
                    found.push(index);
                }
            }
            ControlFlow::Continue(())
        });
    };
    select.selection.iter().for_each(&mut look);
    for item in &select.from {
        for join in &item.joins {
            if let Some(on) = super::scope::condition(&join.join_operator) {
                look(on);
            }
        }
    }
    found.sort_unstable();
    found.dedup();
    found.into_iter().filter_map(|index| Some(items[index].alias.take()?.value)).collect()
}

/// Returns the table of a subquery, if it does not depend on outer columns, and its columns are known.
fn table(subquery: &Query, tables: &Catalogue) -> Option<MadeTable> {
    let mut typed = subquery.clone();
    let columns: ColumnTypes = typing::type_query(&mut typed, tables).ok()?;
    let columns = columns?;
    let geometries: Vec<String> =
        columns.iter().filter(|(_, kind)| *kind == SqlType::Geometry).map(|(name, _)| name.clone()).collect();
    let mut names: Vec<String> = columns.iter().map(|(name, _)| name.to_ascii_lowercase()).collect();
    names.sort_unstable();
    let before = names.len();
    names.dedup();
    let usable = names.len() == before && !names.iter().any(|name| name.is_empty() || name == KEY);
    if geometries.is_empty() || !usable || !is_closed(subquery, tables) {
        return None;
    }
    let sql = subquery.to_string();
    let name = format!("burgeon_made_{:016x}", FxBuildHasher.hash_one(&sql));
    let all = std::iter::once((KEY.into(), SqlType::Integer)).chain(columns);
    let (columns, kinds): (Vec<String>, Vec<SqlType>) = all.unzip();
    let info = TableInfo {
        name,
        key: Some(KEY.into()),
        geometries,
        columns,
        kinds,
        rows: 1000,
        ..TableInfo::default()
    };
    Some(MadeTable { info, sql })
}

/// Reports whether a query does not refer to columns of an outer query.
fn is_closed(query: &Query, tables: &Catalogue) -> bool {
    let (mut owners, mut columns): (Vec<String>, Vec<String>) = (Vec::new(), Vec::new());
    let mut known = true;
    let _ = walk(query, |part| {
        if let StatementPart::Query(query) = part
            && let SetExpr::Select(select) = &*query.body
        {
            for item in relations(select, tables) {
                owners.extend(item.alias.iter().map(|alias| alias.value.to_ascii_lowercase()));
                match item.table {
                    Some(table) => columns.extend(table.columns.iter().map(|name| name.to_ascii_lowercase())),
                    None => known = false,
                }
            }
            for item in &select.projection {
                if let SelectItem::ExprWithAlias { alias, .. } = item {
                    columns.push(alias.value.to_ascii_lowercase());
                }
            }
        }
        ControlFlow::Continue(())
    });
    let walked = walk(query, |part| {
        let StatementPart::Expression(expression) = part else { return ControlFlow::Continue(()) };
        let inside = match expression {
            Expr::CompoundIdentifier(names) => {
                names.first().is_some_and(|owner| owners.contains(&owner.value.to_ascii_lowercase()))
            }
            Expr::Identifier(name) => !known || columns.contains(&name.value.to_ascii_lowercase()),
            _ => true,
        };
        if inside { ControlFlow::Continue(()) } else { ControlFlow::Break(()) }
    });
    walked.is_continue()
}

/// Replaces stars with the names of the columns. Returns true if this was possible.
fn expand_stars(select: &mut Select, tables: &Catalogue, called: &str, info: &TableInfo) -> bool {
    let is_star =
        |item: &SelectItem| matches!(item, SelectItem::Wildcard(_) | SelectItem::QualifiedWildcard(..));
    if !select.projection.iter().any(is_star) {
        return true;
    }
    let items = relations(select, tables);
    let columns = |owner: &str| -> Option<Vec<SelectItem>> {
        let item = items
            .iter()
            .find(|item| item.alias.as_ref().is_some_and(|alias| alias.value.eq_ignore_ascii_case(owner)))?;
        let names: Vec<&String> = match item.table {
            Some(table) => table.columns.iter().collect(),
            None if owner.eq_ignore_ascii_case(called) => info.columns.iter().skip(1).collect(),
            None => return None,
        };
        let column = |name: &&String| {
            let expression = parse::expression(&format!("{}.{}", quote_name(owner), quote_name(name)))?;
            Some(SelectItem::UnnamedExpr(expression))
        };
        names.iter().map(column).collect()
    };
    let mut expanded: Vec<Option<Vec<SelectItem>>> = Vec::new();
    for item in &select.projection {
        let owners: Option<Vec<&str>> = match item {
            SelectItem::Wildcard(_) => {
                items.iter().map(|item| Some(item.alias.as_ref()?.value.as_str())).collect()
            }
            SelectItem::QualifiedWildcard(SelectItemQualifiedWildcardKind::ObjectName(name), _) => {
                name.0.last().and_then(|part| part.as_ident()).map(|name| vec![name.value.as_str()])
            }
            _ => {
                expanded.push(None);
                continue;
            }
        };
        let Some(owners) = owners else { return false };
        let Some(found) = owners.into_iter().map(columns).collect::<Option<Vec<_>>>() else { return false };
        expanded.push(Some(found.into_iter().flatten().collect()));
    }
    let items = std::mem::take(&mut select.projection).into_iter().zip(expanded);
    select.projection = items.flat_map(|(item, columns)| columns.unwrap_or_else(|| vec![item])).collect();
    true
}
