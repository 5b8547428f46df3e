//! Tables of which a script reads a part: on a server, statements see that part alone, as of files.

use std::collections::BTreeMap;
use std::ops::ControlFlow;

use sqlparser::ast::{Query, SetExpr, TableFactor, VisitMut, VisitorMut};

use super::Catalogue;
use super::parse::{SyntaxTree, parse};
use super::scope::{quoted, table};

/// What is seen of tables, as a statement: by their names in small letters.
pub(crate) type ChosenRows = BTreeMap<String, String>;

/// Puts in what is seen of the tables that a query names.
pub(super) fn put_in(query: &mut Query, tables: &Catalogue, chosen: &ChosenRows) {
    if !chosen.is_empty() {
        let _ = VisitMut::visit(query, &mut ChosenVisitor { tables, chosen });
    }
}

struct ChosenVisitor<'a> {
    tables: &'a Catalogue,
    chosen: &'a ChosenRows,
}

impl VisitorMut for ChosenVisitor<'_> {
    type Break = ();

    fn post_visit_table_factor(&mut self, factor: &mut TableFactor) -> ControlFlow<()> {
        let TableFactor::Table { name, alias, args: None, .. } = factor else {
            return ControlFlow::Continue(());
        };
        let known = table(name, self.tables);
        let seen = known.and_then(|known| Some((known, self.chosen.get(&known.name.to_ascii_lowercase())?)));
        let Some((known, select)) = seen else { return ControlFlow::Continue(()) };
        let parsed = parse(&format!("SELECT * FROM ({select}) AS {}", quoted(&known.name)));
        let Some(mut part) = parsed.ok().and_then(first_relation) else { return ControlFlow::Continue(()) };
        if let (TableFactor::Derived { alias: own, .. }, Some(alias)) = (&mut part, alias.take()) {
            *own = Some(alias);
        }
        *factor = part;
        ControlFlow::Continue(())
    }
}

/// What stands behind FROM.
fn first_relation(parsed: SyntaxTree) -> Option<TableFactor> {
    match *parsed.query.body {
        SetExpr::Select(mut select) => Some(select.from.pop()?.relation),
        _ => None,
    }
}
