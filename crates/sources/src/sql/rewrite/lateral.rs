//! LATERAL subqueries, which SQLite lacks: each becomes an expression, a scalar subquery, or a join.
//!
//! - Without FROM, its columns are expressions.
//! - An aggregate has one row: each column is a scalar subquery.
//! - Rows of one table are joined by key: `b.fid IN (SELECT ... ORDER BY ... LIMIT 3)`.

use sqlparser::ast::{
    Expr, Ident, JoinOperator, OrderByKind, Query, SelectItem, SetExpr, TableFactor, TableWithJoins, Value,
};

use super::Catalogue;
use super::parse;
use super::scope::{condition_mut, relations};
use super::substitute::{Substitution, each_query, select_of, set_alias, substitute};
use super::typing::column_name;
use super::{order, walk};
use crate::sql::statement_text::quote_name;
use burgeon_base::error::{Error, Result};

/// The replacement of a LATERAL subquery.
struct LateralForm {
    substitutions: Vec<Substitution>,
    /// Relation that replaces it, and the condition of its join.
    join: Option<(TableFactor, Expr)>,
}

/// Rewrites LATERAL subqueries for SQLite.
pub(super) fn flatten(query: &mut Query, tables: &Catalogue) -> Result<()> {
    each_query(query, |query| {
        let Some(select) = select_of(query) else { return Ok(()) };
        let known: Vec<String> = relations(select, tables)
            .iter()
            .filter_map(|relation| relation.table)
            .flat_map(|table| table.columns.iter().map(|name| name.to_ascii_lowercase()))
            .collect();
        let mut substitutions = Vec::new();
        let mut kept: Vec<TableWithJoins> = Vec::new();
        for mut item in std::mem::take(&mut select.from) {
            let joins = std::mem::take(&mut item.joins);
            // A comma is equivalent to CROSS JOIN.
            match flat_form(&mut item.relation, tables, &known)? {
                Some(LateralForm { substitutions: more, join }) => {
                    substitutions.extend(more);
                    if let Some((relation, condition)) = join {
                        and(&mut select.selection, condition);
                        kept.push(TableWithJoins { relation, joins: Vec::new() });
                    }
                }
                None => kept.push(item),
            }
            for mut join in joins {
                let Some(LateralForm { substitutions: more, join: other }) =
                    flat_form(&mut join.relation, tables, &known)?
                else {
                    match kept.last_mut() {
                        Some(last) => last.joins.push(join),
                        None => kept.push(TableWithJoins { relation: join.relation, joins: Vec::new() }),
                    }
                    continue;
                };
                substitutions.extend(more);
                match other {
                    Some((relation, condition)) => {
                        join.relation = relation;
                        match condition_mut(&mut join.join_operator) {
                            Some(on) => *on = both(take(on), condition),
                            None => and(&mut select.selection, condition),
                        }
                        match kept.last_mut() {
                            Some(last) => last.joins.push(join),
                            None => kept.push(TableWithJoins { relation: join.relation, joins: Vec::new() }),
                        }
                    }
                    // There is exactly one row: the join needs no relation, and its condition becomes a condition of
                    // the query.
                    None => {
                        let outer =
                            matches!(join.join_operator, JoinOperator::Left(_) | JoinOperator::LeftOuter(_));
                        if let Some(on) = condition_mut(&mut join.join_operator)
                            && !is_true(on)
                        {
                            if outer {
                                return Err(unsupported_lateral("with a condition other than true"));
                            }
                            and(&mut select.selection, take(on));
                        }
                    }
                }
            }
        }
        select.from = kept;
        if !substitutions.is_empty() {
            let starred = select
                .projection
                .iter()
                .any(|item| matches!(item, SelectItem::Wildcard(_) | SelectItem::QualifiedWildcard(..)));
            if starred {
                return Err(unsupported_lateral("beside a star"));
            }
            for item in &mut select.projection {
                name(item);
            }
            substitute(query, &substitutions);
        }
        Ok(())
    })
}

fn unsupported_lateral(what: &str) -> Error {
    Error::argument(format!("SQL: LATERAL {what} is not supported here"))
        .help("name the columns, and write a scalar subquery in SELECT, a join, or one table behind LATERAL")
}

/// Keeps the name of a column whose expression changes.
fn name(item: &mut SelectItem) {
    if let SelectItem::UnnamedExpr(expression) = item {
        let alias = Ident::with_quote('"', column_name(expression));
        set_alias(item, alias);
    }
}

/// Takes an expression, and leaves null in its place.
fn take(expression: &mut Expr) -> Expr {
    std::mem::replace(expression, Expr::Value(Value::Null.into()))
}

fn is_true(expression: &Expr) -> bool {
    matches!(expression, Expr::Value(value) if matches!(value.value, Value::Boolean(true)))
}

fn and(place: &mut Option<Expr>, condition: Expr) {
    *place = Some(match place.take() {
        Some(known) => both(known, condition),
        None => condition,
    });
}

/// Returns the condition that both conditions hold.
fn both(known: Expr, condition: Expr) -> Expr {
    if is_true(&known) {
        return condition;
    }
    Expr::BinaryOp {
        left: Box::new(Expr::Nested(Box::new(known))),
        op: sqlparser::ast::BinaryOperator::And,
        right: Box::new(condition),
    }
}

/// Returns the replacement of a LATERAL subquery, whose columns it takes. Other relations stay unchanged.
fn flat_form(factor: &mut TableFactor, tables: &Catalogue, known: &[String]) -> Result<Option<LateralForm>> {
    let TableFactor::Derived { lateral: true, subquery, alias: Some(alias), .. } = factor else {
        return Ok(None);
    };
    let owner = std::mem::take(&mut alias.name.value);
    let SetExpr::Select(select) = &mut *subquery.body else {
        return Err(unsupported_lateral("with UNION or VALUES"));
    };
    let plain = subquery.with.is_none() && select.distinct.is_none() && select.having.is_none();
    let aggregates = order::aggregates(select);
    let mut columns: Vec<(String, Expr)> = Vec::new();
    let mut starred = false;
    for item in std::mem::take(&mut select.projection) {
        match item {
            SelectItem::UnnamedExpr(expression) => columns.push((column_name(&expression), expression)),
            SelectItem::ExprWithAlias { expr, alias } => columns.push((alias.value, expr)),
            _ => starred = true,
        }
    }
    for (column, renamed) in columns.iter_mut().zip(std::mem::take(&mut alias.columns)) {
        column.0 = renamed.name.value;
    }
    let substitution = |column: String, expression: Expr| Substitution {
        owner: owner.clone(),
        alone: !known.contains(&column.to_ascii_lowercase()),
        column: column.into(),
        expression: Expr::Nested(Box::new(expression)),
    };
    if plain && select.from.is_empty() && select.selection.is_none() && !starred {
        let substitutions = columns.into_iter().map(|(name, it)| substitution(name, it)).collect();
        return Ok(Some(LateralForm { substitutions, join: None }));
    }
    let grouped = !order::is_ungrouped(&select.group_by);
    if aggregates && !grouped && !starred {
        let scalar = |(name, expression): (String, Expr)| {
            let mut query = subquery.clone();
            if let SetExpr::Select(select) = &mut *query.body {
                select.projection = vec![SelectItem::UnnamedExpr(expression)];
            }
            substitution(name, Expr::Subquery(query))
        };
        return Ok(Some(LateralForm {
            substitutions: columns.into_iter().map(scalar).collect(),
            join: None,
        }));
    }
    if !plain || grouped || aggregates {
        return Err(unsupported_lateral("with DISTINCT, GROUP BY or HAVING"));
    }
    join_form(subquery, &owner, tables, columns, starred, substitution).map(Some)
}

/// Returns the column that an ORDER BY expression refers to by its name or its number.
fn ordered_column<'c>(key: &Expr, columns: &'c [(String, Expr)]) -> Option<&'c (String, Expr)> {
    match key {
        Expr::Identifier(name) => columns.iter().find(|(known, _)| known.eq_ignore_ascii_case(&name.value)),
        Expr::Value(value) => match &value.value {
            Value::Number(number, _) => {
                number.parse::<usize>().ok().and_then(|number| columns.get(number.checked_sub(1)?))
            }
            _ => None,
        },
        _ => None,
    }
}

/// Creates a join with the rows of one table that a subquery returns.
fn join_form(
    keys: &mut Query,
    owner: &str,
    tables: &Catalogue,
    columns: Vec<(String, Expr)>,
    starred: bool,
    substitution: impl Fn(String, Expr) -> Substitution,
) -> Result<LateralForm> {
    let inner = select_of(keys).map(|select| relations(select, tables)).unwrap_or_default();
    let [only] = inner.as_slice() else { return Err(unsupported_lateral("with several tables")) };
    let (Some(table), Some(alias)) = (only.table, &only.alias) else {
        return Err(unsupported_lateral("with another subquery"));
    };
    let Some(key) = &table.key else { return Err(unsupported_lateral("with a table without a key")) };
    if let Some(OrderByKind::Expressions(order)) = keys.order_by.as_mut().map(|order| &mut order.kind) {
        // The columns are removed, so the expressions of the order are written out.
        for key in order {
            if let Some((_, expression)) = ordered_column(&key.expr, &columns) {
                key.expr = Expr::Nested(Box::new(expression.clone()));
            }
        }
    }
    if let SetExpr::Select(select) = &mut *keys.body {
        let key = parse::expression(&format!("{}.{}", quote_name(&alias.value), quote_name(key)));
        select.projection = key.into_iter().map(SelectItem::UnnamedExpr).collect();
    }
    let condition = format!("{}.{} IN ({keys})", quote_name(owner), quote_name(key));
    let relation = format!("{} AS {}", quote_name(&table.name), quote_name(owner));
    let parsed = parse::expression(&condition).zip(parse::relation(&relation));
    let Some((condition, relation)) = parsed else { return Err(unsupported_lateral("so deep")) };
    // The alias in the subquery is replaced with the name of the relation.
    let renamed = |mut expression: Expr| {
        let mut change = |part: &mut Expr| match part {
            Expr::CompoundIdentifier(names)
                if names.len() == 2 && names[0].value.eq_ignore_ascii_case(&alias.value) =>
            {
                names[0] = Ident::with_quote('"', owner);
            }
            Expr::Identifier(name) if table.has(&name.value) => {
                let column = std::mem::replace(name, Ident::new(""));
                *part = Expr::CompoundIdentifier(vec![Ident::with_quote('"', owner), column]);
            }
            _ => {}
        };
        walk::walk_expressions(&mut expression, &mut change);
        expression
    };
    let computed = columns.into_iter().filter_map(|(name, expression)| {
        let made = renamed(expression);
        // A column of the table is available under its own name.
        let same = matches!(&made, Expr::CompoundIdentifier(names)
            if names.len() == 2 && names[0].value == owner && names[1].value.eq_ignore_ascii_case(&name));
        (!same || !starred).then(|| substitution(name, made))
    });
    Ok(LateralForm { substitutions: computed.collect(), join: Some((relation, condition)) })
}
