//! Tables of which a script reads a part. On a server, statements see only this part, as with files.

use std::collections::BTreeMap;

use sqlparser::ast::{Query, SetExpr, TableFactor};

use super::Catalogue;
use super::parse::{SyntaxTree, parse};
use super::scope::table;
use super::walk::{StatementPartMut, walk_mut};
use crate::sql::statement_text::quote_name;

/// The visible part of tables as a SELECT statement, by lower-case name.
pub(crate) type ChosenRows = BTreeMap<String, String>;

/// Replaces the tables that a query names with their visible parts.
pub(super) fn put_in(query: &mut Query, tables: &Catalogue, chosen: &ChosenRows) {
    if !chosen.is_empty() {
        walk_mut(query, |part| {
            if let StatementPartMut::TableFactor(factor) = part
                && let Some(seen) = visible_part(factor, tables, chosen)
            {
                *factor = seen;
            }
        });
    }
}

/// Returns the visible part of a table after FROM, if it is not the whole table.
fn visible_part(factor: &mut TableFactor, tables: &Catalogue, chosen: &ChosenRows) -> Option<TableFactor> {
    let TableFactor::Table { name, alias, args: None, .. } = factor else { return None };
    let known = table(name, tables)?;
    let select = chosen.get(&known.name.to_ascii_lowercase())?;
    let own = known.place.as_ref().map_or(&known.name, |(_, name)| name);
    let parsed = parse(&format!("SELECT * FROM ({select}) AS {}", quote_name(own)));
    let mut part = parsed.ok().and_then(first_relation)?;
    if let (TableFactor::Derived { alias: own, .. }, Some(alias)) = (&mut part, alias.take()) {
        *own = Some(alias);
    }
    Some(part)
}

/// Returns the first relation after FROM.
fn first_relation(parsed: SyntaxTree) -> Option<TableFactor> {
    match *parsed.query.body {
        SetExpr::Select(mut select) => Some(select.from.pop()?.relation),
        _ => None,
    }
}
