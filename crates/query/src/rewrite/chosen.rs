//! Tables of which a script reads a part: on a server, statements see that part alone, as of files.

use std::collections::BTreeMap;

use sqlparser::ast::{Query, SetExpr, TableFactor};

use super::Catalogue;
use super::parse::{SyntaxTree, parse};
use super::scope::{quoted, table};
use super::walk::{StatementPartMut, walk_mut};

/// What is seen of tables, as a statement: by their names in small letters.
pub(crate) type ChosenRows = BTreeMap<String, String>;

/// Puts in what is seen of the tables that a query names.
pub(super) fn put_in(query: &mut Query, tables: &Catalogue, chosen: &ChosenRows) {
    if !chosen.is_empty() {
        walk_mut(query, |part| {
            if let StatementPartMut::TableFactor(factor) = part
                && let Some(seen) = seen(factor, tables, chosen)
            {
                *factor = seen;
            }
        });
    }
}

/// What is seen of the table that stands behind FROM, if that is less than all.
fn seen(factor: &mut TableFactor, tables: &Catalogue, chosen: &ChosenRows) -> Option<TableFactor> {
    let TableFactor::Table { name, alias, args: None, .. } = factor else { return None };
    let known = table(name, tables)?;
    let select = chosen.get(&known.name.to_ascii_lowercase())?;
    let own = known.place.as_ref().map_or(&known.name, |(_, name)| name);
    let parsed = parse(&format!("SELECT * FROM ({select}) AS {}", quoted(own)));
    let mut part = parsed.ok().and_then(first_relation)?;
    if let (TableFactor::Derived { alias: own, .. }, Some(alias)) = (&mut part, alias.take()) {
        *own = Some(alias);
    }
    Some(part)
}

/// What stands behind FROM.
fn first_relation(parsed: SyntaxTree) -> Option<TableFactor> {
    match *parsed.query.body {
        SetExpr::Select(mut select) => Some(select.from.pop()?.relation),
        _ => None,
    }
}
