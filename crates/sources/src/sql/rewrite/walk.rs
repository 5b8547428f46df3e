//! Walks over the parts of a statement.
//!
//! The parser's walk is compiled again for each visitor type, over all of SQL. So there is only one visitor type for
//! reading and one for changing.

use std::ops::ControlFlow;

use sqlparser::ast::{
    Expr, ObjectName, Query, Select, SetExpr, TableFactor, Visit, VisitMut, Visitor, VisitorMut,
};

/// A part of a statement.
pub(super) enum StatementPart<'a> {
    /// Query, the outermost or a nested one.
    Query(&'a Query),
    /// Expression.
    Expression(&'a Expr),
    /// Relation after FROM.
    #[cfg_attr(not(feature = "postgis"), expect(dead_code, reason = "looked at before a server is asked"))]
    TableFactor(&'a TableFactor),
    /// Name of a table.
    #[cfg_attr(not(feature = "postgis"), expect(dead_code, reason = "looked at before a server is asked"))]
    Relation(&'a ObjectName),
}

/// A part of a statement for modification.
pub(super) enum StatementPartMut<'a> {
    /// Query, the outermost or a nested one.
    Query(&'a mut Query),
    /// Select, the part of a query before ORDER BY.
    Select(&'a mut Select),
    /// Relation after FROM.
    TableFactor(&'a mut TableFactor),
}

/// Calls `look` with the parts of `tree`, the outer before the inner, until it breaks.
pub(super) fn walk(
    tree: &impl Visit,
    mut look: impl FnMut(StatementPart<'_>) -> ControlFlow<()>,
) -> ControlFlow<()> {
    tree.visit(&mut PartVisitor(&mut look))
}

/// Calls `change` with the parts of `query`, the inner before the outer.
pub(super) fn walk_mut(query: &mut Query, mut change: impl FnMut(StatementPartMut<'_>)) {
    let _ = VisitMut::visit(query, &mut PartMutVisitor(&mut change));
}

/// Calls `change` with the expressions of `tree`, a query or an expression, the inner before the outer.
pub(super) fn walk_expressions(tree: &mut impl VisitMut, change: &mut dyn FnMut(&mut Expr)) {
    let _ = tree.visit(&mut ExpressionVisitor(change));
}

struct ExpressionVisitor<'a>(&'a mut dyn FnMut(&mut Expr));

impl VisitorMut for ExpressionVisitor<'_> {
    type Break = ();

    fn post_visit_expr(&mut self, expression: &mut Expr) -> ControlFlow<()> {
        (self.0)(expression);
        ControlFlow::Continue(())
    }
}

/// Reports whether each query in `tree` only returns rows.
pub(super) fn asks_for_rows(tree: &Query) -> bool {
    let asks = |body: &SetExpr| {
        !matches!(body, SetExpr::Insert(_) | SetExpr::Update(_) | SetExpr::Delete(_) | SetExpr::Merge(_))
    };
    let walked = walk(tree, |part| match part {
        StatementPart::Query(query) if !asks(&query.body) => ControlFlow::Break(()),
        _ => ControlFlow::Continue(()),
    });
    walked.is_continue()
}

struct PartVisitor<'a>(&'a mut dyn FnMut(StatementPart<'_>) -> ControlFlow<()>);

impl Visitor for PartVisitor<'_> {
    type Break = ();

    fn pre_visit_query(&mut self, query: &Query) -> ControlFlow<()> {
        (self.0)(StatementPart::Query(query))
    }

    fn pre_visit_expr(&mut self, expression: &Expr) -> ControlFlow<()> {
        (self.0)(StatementPart::Expression(expression))
    }

    fn pre_visit_table_factor(&mut self, factor: &TableFactor) -> ControlFlow<()> {
        (self.0)(StatementPart::TableFactor(factor))
    }

    fn pre_visit_relation(&mut self, name: &ObjectName) -> ControlFlow<()> {
        (self.0)(StatementPart::Relation(name))
    }
}

struct PartMutVisitor<'a>(&'a mut dyn FnMut(StatementPartMut<'_>));

impl VisitorMut for PartMutVisitor<'_> {
    type Break = ();

    fn post_visit_query(&mut self, query: &mut Query) -> ControlFlow<()> {
        (self.0)(StatementPartMut::Query(query));
        ControlFlow::Continue(())
    }

    fn post_visit_select(&mut self, select: &mut Select) -> ControlFlow<()> {
        (self.0)(StatementPartMut::Select(select));
        ControlFlow::Continue(())
    }

    fn post_visit_table_factor(&mut self, factor: &mut TableFactor) -> ControlFlow<()> {
        (self.0)(StatementPartMut::TableFactor(factor));
        ControlFlow::Continue(())
    }
}
