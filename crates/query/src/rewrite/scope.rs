//! What stands behind FROM, and what an expression speaks of.

use std::ops::ControlFlow;

use sqlparser::ast::{Expr, Ident, JoinConstraint, JoinOperator, ObjectName, Query, Select, TableFactor};

use super::walk::{StatementPart, walk};
use super::{Catalogue, TableInfo};

/// Something behind FROM.
pub(super) struct FromItem<'a> {
    /// What it is called there; nothing if that is not known.
    pub alias: Option<Ident>,
    /// What is known of it; nothing of a query in its place.
    pub table: Option<&'a TableInfo>,
    /// Where it stands: the number of the comma, and of the join behind it, from 1.
    pub place: (usize, usize),
    /// Whether its rows may be missing.
    pub optional: bool,
}

/// The tables that a query means by their names: those that it declares itself hide others.
pub(super) fn visible(query: &Query, catalogue: &Catalogue) -> Catalogue {
    let declared = declared(query);
    let seen = catalogue.iter().filter(|(name, _)| !declared.contains(name));
    seen.map(|(name, table)| (name.clone(), table.clone())).collect()
}

/// The names of the tables that a query declares itself, in small letters.
pub(super) fn declared(query: &Query) -> Vec<String> {
    let mut names = Vec::new();
    let _ = walk(query, |part| {
        if let StatementPart::Query(query) = part {
            let tables = query.with.iter().flat_map(|with| &with.cte_tables);
            names.extend(tables.map(|table| table.alias.name.value.to_ascii_lowercase()));
        }
        ControlFlow::Continue(())
    });
    names
}

/// The table that a name means, which may have a schema.
pub(super) fn table<'a>(name: &ObjectName, tables: &'a Catalogue) -> Option<&'a TableInfo> {
    let parts: Option<Vec<&str>> = name.0.iter().map(|part| Some(part.as_ident()?.value.as_str())).collect();
    tables.get(&parts?.join(".").to_ascii_lowercase())
}

/// All that stands behind FROM.
pub(super) fn relations<'a>(select: &Select, tables: &'a Catalogue) -> Vec<FromItem<'a>> {
    let mut relations = Vec::new();
    for (comma, item) in select.from.iter().enumerate() {
        let first = relations.len();
        relations.push(relation(&item.relation, tables, (comma, 0)));
        for (join, joined) in item.joins.iter().enumerate() {
            let mut next = relation(&joined.relation, tables, (comma, join + 1));
            match &joined.join_operator {
                JoinOperator::Join(_) | JoinOperator::Inner(_) | JoinOperator::CrossJoin(_) => {}
                JoinOperator::Left(_) | JoinOperator::LeftOuter(_) => next.optional = true,
                _ => {
                    next.optional = true;
                    relations[first..].iter_mut().for_each(|relation| relation.optional = true);
                }
            }
            relations.push(next);
        }
    }
    relations
}

fn relation<'a>(factor: &TableFactor, tables: &'a Catalogue, place: (usize, usize)) -> FromItem<'a> {
    let (alias, table) = match factor {
        TableFactor::Table { name, alias, args: None, .. } => {
            let own = || name.0.last().and_then(|part| part.as_ident()).cloned();
            (alias.as_ref().map(|alias| alias.name.clone()).or_else(own), table(name, tables))
        }
        TableFactor::Table { alias, .. } | TableFactor::Derived { alias, .. } => {
            (alias.as_ref().map(|alias| alias.name.clone()), None)
        }
        _ => (None, None),
    };
    FromItem { alias, table, place, optional: false }
}

/// The condition of a join.
pub(super) fn condition(operator: &JoinOperator) -> Option<&Expr> {
    match operator {
        JoinOperator::Join(JoinConstraint::On(on))
        | JoinOperator::Inner(JoinConstraint::On(on))
        | JoinOperator::Left(JoinConstraint::On(on))
        | JoinOperator::LeftOuter(JoinConstraint::On(on))
        | JoinOperator::CrossJoin(JoinConstraint::On(on)) => Some(on),
        _ => None,
    }
}

/// The same, to be changed.
pub(super) fn condition_mut(operator: &mut JoinOperator) -> Option<&mut Expr> {
    match operator {
        JoinOperator::Join(JoinConstraint::On(on))
        | JoinOperator::Inner(JoinConstraint::On(on))
        | JoinOperator::Left(JoinConstraint::On(on))
        | JoinOperator::LeftOuter(JoinConstraint::On(on))
        | JoinOperator::CrossJoin(JoinConstraint::On(on)) => Some(on),
        _ => None,
    }
}

/// Which of the relations an expression speaks of, or may speak of.
pub(super) fn mentioned(expression: &Expr, relations: &[FromItem<'_>]) -> Vec<usize> {
    let mut found = vec![false; relations.len()];
    let _ = walk(expression, |part| {
        if let StatementPart::Expression(part) = part {
            relations
                .iter()
                .zip(&mut found)
                .for_each(|(relation, found)| *found |= speaks_of(part, relation));
        }
        ControlFlow::Continue(())
    });
    found.iter().enumerate().filter(|(_, found)| **found).map(|(index, _)| index).collect()
}

/// Whether an expression is a column of a relation, or may be.
fn speaks_of(expression: &Expr, relation: &FromItem<'_>) -> bool {
    match expression {
        Expr::CompoundIdentifier(parts) => match parts.as_slice() {
            [.., owner, _] => names(relation, owner),
            _ => true,
        },
        Expr::Identifier(name) => {
            relation.table.is_none_or(|table| table.has(&name.value) || is_row_id(&name.value))
        }
        Expr::QualifiedWildcard(..) | Expr::Wildcard(_) => true,
        _ => false,
    }
}

fn is_row_id(name: &str) -> bool {
    ["rowid", "oid", "_rowid_"].iter().any(|known| name.eq_ignore_ascii_case(known))
}

/// Whether `owner` is what a relation is called, or may be.
fn names(relation: &FromItem<'_>, owner: &Ident) -> bool {
    relation.alias.as_ref().is_none_or(|alias| alias.value.eq_ignore_ascii_case(&owner.value))
}

/// The relation and the column of geometries that an expression is, and nothing else.
pub(super) fn geometry_column<'a>(
    expression: &Expr,
    relations: &[FromItem<'a>],
) -> Option<(usize, &'a TableInfo, &'a str)> {
    match expression {
        Expr::Nested(inner) => geometry_column(inner, relations),
        Expr::CompoundIdentifier(parts) => {
            let [owner, column] = parts.as_slice() else { return None };
            let called = |relation: &&(usize, &FromItem<'a>)| {
                relation.1.alias.as_ref().is_some_and(|alias| alias.value.eq_ignore_ascii_case(&owner.value))
            };
            let mut found = relations.iter().enumerate().collect::<Vec<_>>().into_iter();
            let (index, relation) = found.find(|each| called(&each))?;
            let table = relation.table?;
            Some((index, table, table.geometry(&column.value)?))
        }
        Expr::Identifier(name) => {
            // Where something is not known, the name may be its.
            if relations.iter().any(|relation| relation.table.is_none()) {
                return None;
            }
            let having =
                relations.iter().enumerate().filter(|(_, it)| it.table.is_some_and(|it| it.has(&name.value)));
            let having: Vec<_> = having.collect();
            let [(index, relation)] = having.as_slice() else { return None };
            let table = relation.table?;
            Some((*index, table, table.geometry(&name.value)?))
        }
        _ => None,
    }
}

/// A name as it stands in a statement.
pub(super) fn quoted(name: &str) -> String {
    format!("\"{}\"", name.replace('"', "\"\""))
}

/// A text as it stands in a statement.
pub(super) fn text(text: &str) -> String {
    format!("'{}'", text.replace('\'', "''"))
}

/// The parts of a condition that must all hold.
pub(super) fn conjuncts(condition: &Expr) -> Vec<&Expr> {
    use sqlparser::ast::BinaryOperator::And;
    let (mut parts, mut open) = (Vec::new(), vec![condition]);
    while let Some(part) = open.pop() {
        match part {
            Expr::BinaryOp { left, op: And, right } => open.extend([&**right, &**left]),
            Expr::Nested(inner) => open.push(inner),
            other => parts.push(other),
        }
    }
    parts
}
