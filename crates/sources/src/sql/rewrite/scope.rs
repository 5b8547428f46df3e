//! The relations after FROM, and the relations that an expression refers to.

use std::ops::ControlFlow;

use sqlparser::ast::{Expr, Ident, JoinConstraint, JoinOperator, ObjectName, Query, Select, TableFactor};

use super::walk::{StatementPart, walk};
use super::{Catalogue, TableInfo};

/// A relation after FROM.
pub(super) struct FromItem<'a> {
    /// Alias or name, if known.
    pub alias: Option<Ident>,
    /// Table, or `None` for a subquery.
    pub table: Option<&'a TableInfo>,
    /// Position: the number of the item in FROM, and of the join, from 1.
    pub place: (usize, usize),
    /// Set if its rows may be missing.
    pub optional: bool,
}

/// Returns the tables that a query can name: tables that it declares hide others.
pub(super) fn visible_tables(query: &Query, catalogue: &Catalogue) -> Catalogue {
    let declared = declared_names(query);
    let seen = catalogue.iter().filter(|(name, _)| !declared.contains(name));
    seen.map(|(name, table)| (name.clone(), table.clone())).collect()
}

/// Returns the lower-case names of the tables that a query declares.
pub(super) fn declared_names(query: &Query) -> Vec<String> {
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

/// Returns the table with a name, which may have a schema.
pub(super) fn table<'a>(name: &ObjectName, tables: &'a Catalogue) -> Option<&'a TableInfo> {
    let parts: Option<Vec<&str>> = name.0.iter().map(|part| Some(part.as_ident()?.value.as_str())).collect();
    tables.get(&parts?.join(".").to_ascii_lowercase())
}

/// Returns all relations after FROM.
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
        TableFactor::Table { name, args: None, .. } => {
            let own = || name.0.last().and_then(|part| part.as_ident());
            (alias_of(factor).or_else(own), table(name, tables))
        }
        _ => (alias_of(factor), None),
    };
    FromItem { alias: alias.cloned(), table, place, optional: false }
}

/// Returns the alias of a table or a subquery.
pub(super) fn alias_of(factor: &TableFactor) -> Option<&Ident> {
    match factor {
        TableFactor::Table { alias, .. } | TableFactor::Derived { alias, .. } => {
            alias.as_ref().map(|alias| &alias.name)
        }
        _ => None,
    }
}

/// Returns the condition of a join.
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

/// Returns the condition of a join for modification.
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

/// Returns the relations that an expression refers to, or may refer to.
pub(super) fn mentioned_relations(expression: &Expr, relations: &[FromItem<'_>]) -> Vec<usize> {
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

/// Reports whether an expression is a column of a relation, or may be.
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

/// Reports whether `owner` is the name of a relation, or may be.
fn names(relation: &FromItem<'_>, owner: &Ident) -> bool {
    relation.alias.as_ref().is_none_or(|alias| alias.value.eq_ignore_ascii_case(&owner.value))
}

/// Returns the relation and the geometry column of an expression that is only a geometry column.
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
            // The name may belong to a relation whose columns are unknown.
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

/// Returns the parts of a condition that must all hold.
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
