//! Puts expressions in the place of columns.

use sqlparser::ast::{AccessExpr, Expr, Ident, Query, Select, SetExpr, TableFactor};

use super::walk::{StatementPartMut, walk_expressions};

/// A column and what stands in its place.
pub(super) struct Substitution {
    /// What the column's relation is called.
    pub(super) owner: String,
    /// The column.
    pub(super) column: String,
    /// Whether the name of the column alone means it.
    pub(super) alone: bool,
    /// What is meant.
    pub(super) expression: Expr,
}

impl Substitution {
    fn matches(&self, expression: &Expr) -> bool {
        let is = |name: &Ident, text: &str| name.value.eq_ignore_ascii_case(text);
        match expression {
            Expr::Identifier(name) => self.alone && is(name, &self.column),
            Expr::CompoundIdentifier(names) => {
                matches!(names.as_slice(), [owner, column] if is(owner, &self.owner) && is(column, &self.column))
            }
            // (dump).geom
            Expr::CompoundFieldAccess { root, access_chain } => {
                let root = if let Expr::Nested(inner) = &**root { inner } else { root };
                let [AccessExpr::Dot(column)] = access_chain.as_slice() else { return false };
                // The column alone may have been put in already.
                matches!(&**root, Expr::Identifier(owner) if is(owner, &self.owner))
                    && (matches!(column, Expr::Identifier(name) if is(name, &self.column))
                        || *column == self.expression)
            }
            _ => false,
        }
    }
}

/// Puts expressions in the place of columns in a query whose body is a select, but not in what it declares.
pub(super) fn substitute(query: &mut Query, substitutions: &[Substitution]) {
    let mut change = |expression: &mut Expr| {
        if let Some(found) = substitutions.iter().find(|it| it.matches(expression)) {
            *expression = found.expression.clone();
        }
    };
    let with = query.with.take();
    walk_expressions(query, &mut change);
    query.with = with;
}

/// The select of a query that is one and nothing else.
pub(super) fn select_of(query: &mut Query) -> Option<&mut Select> {
    match &mut *query.body {
        SetExpr::Select(select) => Some(select),
        _ => None,
    }
}

/// Every relation behind FROM, with what joins it.
pub(super) fn factors(select: &mut Select) -> impl Iterator<Item = &mut TableFactor> {
    select.from.iter_mut().flat_map(|item| {
        std::iter::once(&mut item.relation).chain(item.joins.iter_mut().map(|join| &mut join.relation))
    })
}

/// Applies `change` to the selects of a query, the inner before the outer.
pub(super) fn each_query(
    query: &mut Query,
    mut change: impl FnMut(&mut Query) -> burgeon_base::error::Result<()>,
) -> burgeon_base::error::Result<()> {
    let mut result = Ok(());
    super::walk::walk_mut(query, |part| {
        if let (StatementPartMut::Query(query), true) = (part, result.is_ok()) {
            result = change(query);
        }
    });
    result
}
