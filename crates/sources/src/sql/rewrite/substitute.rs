//! The substitution of columns by expressions.

use std::borrow::Cow;

use sqlparser::ast::{
    AccessExpr, Expr, Ident, Query, Select, SelectItem, SetExpr, TableFactor, WildcardAdditionalOptions,
};

use super::walk::{StatementPartMut, walk_expressions};

/// A column and its replacement.
pub(super) struct Substitution {
    /// Alias of the column's relation.
    pub(super) owner: String,
    /// Name of the column.
    pub(super) column: Cow<'static, str>,
    /// Set if the unqualified name identifies the column.
    pub(super) alone: bool,
    /// Replacement.
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
            // The expression is a field access such as (dump).geom.
            Expr::CompoundFieldAccess { root, access_chain } => {
                let root = if let Expr::Nested(inner) = &**root { inner } else { root };
                let [AccessExpr::Dot(column)] = access_chain.as_slice() else { return false };
                // The column name may already be replaced.
                matches!(&**root, Expr::Identifier(owner) if is(owner, &self.owner))
                    && (matches!(column, Expr::Identifier(name) if is(name, &self.column))
                        || *column == self.expression)
            }
            _ => false,
        }
    }
}

/// Replaces columns with expressions in a query whose body is a select, except in the queries that it declares.
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

/// Names the expression of an item of a projection `alias`, instead of any alias that it has.
pub(super) fn set_alias(item: &mut SelectItem, alias: Ident) {
    let star = SelectItem::Wildcard(WildcardAdditionalOptions::default());
    *item = match std::mem::replace(item, star) {
        SelectItem::UnnamedExpr(expr) | SelectItem::ExprWithAlias { expr, .. } => {
            SelectItem::ExprWithAlias { expr, alias }
        }
        other => other,
    };
}

/// Returns the select of a query, if its body is a select.
pub(super) fn select_of(query: &mut Query) -> Option<&mut Select> {
    match &mut *query.body {
        SetExpr::Select(select) => Some(select),
        _ => None,
    }
}

/// Returns every relation after FROM, including joined ones.
pub(super) fn factors(select: &mut Select) -> impl Iterator<Item = &mut TableFactor> {
    select.from.iter_mut().flat_map(|item| {
        std::iter::once(&mut item.relation).chain(item.joins.iter_mut().map(|join| &mut join.relation))
    })
}

/// Applies `change` to the queries of a statement, the inner before the outer.
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
