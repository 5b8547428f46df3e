//! The minimum distance of a group, `min(ST_Distance(a.geom, b.geom)) ... GROUP BY a.fid`, as the distance to the
//! nearest row.
//!
//! If a table is joined only for the minimum distance to it, each row of the other tables needs only its nearest row:
//! `min((SELECT ST_Distance(a.geom, b.geom) FROM b ORDER BY ... LIMIT 1))`, which uses an index.

use sqlparser::ast::{Expr, JoinConstraint, JoinOperator, Query, SetExpr, TableFactor};

use super::Catalogue;
use super::operators::call;
use super::parse;
use super::scope::{FromItem, condition, conjuncts, geometry_column, mentioned_relations, relations};
use super::substitute::select_of;
use super::walk::{StatementPart, walk, walk_expressions};
use crate::sql::statement_text::quote_name;
use std::ops::ControlFlow;

/// Rewrites a query whose aggregates are minimum distances to one table.
pub(super) fn rewrite(query: &mut Query, tables: &Catalogue) {
    if let Some(made) = least_query(query, tables) {
        *query = made;
    }
}

/// The table of which only the nearest row is needed.
struct NearestTable {
    /// Position after FROM.
    place: (usize, usize),
    /// Name and alias.
    relation: String,
    /// Conditions on its rows.
    conditions: Vec<String>,
    /// Set if rows without a match are kept.
    optional: bool,
}

fn least_query(query: &Query, tables: &Catalogue) -> Option<Query> {
    let SetExpr::Select(select) = &*query.body else { return None };
    if select.distinct.is_some() || query.with.is_some() {
        return None;
    }
    let items = relations(select, tables);
    if items.len() < 2 || items.iter().any(|item| item.table.is_none() || item.alias.is_none()) {
        return None;
    }
    // All aggregates must be minimum distances to one relation, and no other expression may refer to it.
    let mut target: Option<usize> = None;
    let mut fits = true;

    let mut holder = query.clone();
    let inner = select_of(&mut holder)?;
    let (from, selection) = (std::mem::take(&mut inner.from), inner.selection.take());
    walk_expressions(&mut holder, &mut |part: &mut Expr| {
        if let Some((name, arguments)) = call(part)
            && name == "min"
            && let [only] = arguments.as_slice()
            && let Some(relation) = distance_to(only, &items)
        {
            fits &= *target.get_or_insert(relation) == relation;
            *part = Expr::Value(sqlparser::ast::Value::Null.into());
        }
    });
    let target = target.filter(|_| fits)?;
    let item = &items[target];
    let rest = walk(&holder, |part| match part {
        StatementPart::Expression(expression) if is_other_aggregate(expression) => ControlFlow::Break(()),
        StatementPart::Expression(expression)
            if mentioned_relations(expression, &items).contains(&target) =>
        {
            ControlFlow::Break(())
        }
        _ => ControlFlow::Continue(()),
    });
    if rest.is_break() {
        return None;
    }
    let nearest = nearest(item, target, &items, &from, selection.as_ref())?;
    let mut made = query.clone();
    let select = select_of(&mut made)?;
    let filter = match nearest.conditions.is_empty() {
        true => String::new(),
        false => format!(" WHERE {}", nearest.conditions.join(" AND ")),
    };
    // Conditions that do not involve the table remain.
    let own = |expression: &&Expr| mentioned_relations(expression, &items).contains(&target);
    let mut kept: Vec<String> = selection
        .iter()
        .flat_map(|selection| conjuncts(selection))
        .filter(|part| !own(part))
        .map(|part| format!("({part})"))
        .collect();
    let relation = &nearest.relation;
    if !nearest.optional {
        kept.push(format!("EXISTS (SELECT 1 FROM {relation}{filter})"));
    }
    select.selection = if kept.is_empty() { None } else { Some(parse::expression(&kept.join(" AND "))?) };
    let (comma, join) = nearest.place;
    if join == 0 {
        let item = select.from.remove(comma);
        if !item.joins.is_empty() {
            return None;
        }
    } else {
        select.from.get_mut(comma)?.joins.remove(join - 1);
    }
    if select.from.is_empty() {
        return None;
    }
    walk_expressions(&mut made, &mut |part: &mut Expr| {
        if let Some((name, arguments)) = call(part)
            && name == "min"
            && let [only] = arguments.as_slice()
            && distance_to(only, &items) == Some(target)
            && let Some(expression) = parse::expression(&format!(
                "min((SELECT {only} FROM {relation}{filter} ORDER BY {only} LIMIT 1))"
            ))
        {
            *part = expression;
        }
    });
    Some(made)
}

/// Returns the relation to whose geometry a distance is measured. Of two relations, it is the later one.
fn distance_to(expression: &Expr, items: &[FromItem<'_>]) -> Option<usize> {
    let (name, arguments) = call(expression)?;
    let [a, b] = arguments.as_slice() else { return None };
    if name != "st_distance" {
        return None;
    }
    let side = |own: &Expr, other: &Expr| {
        let (relation, table, _) = geometry_column(own, items)?;
        table.key.as_ref()?;
        let others = mentioned_relations(other, items);
        (!others.is_empty() && !others.contains(&relation)).then_some(relation)
    };
    side(a, b).into_iter().chain(side(b, a)).max()
}

fn is_other_aggregate(expression: &Expr) -> bool {
    let Some((name, _)) = call(expression) else {
        // Calls with filters, windows or stars are not analysed, so they count as aggregates.
        return matches!(expression, Expr::Function(_));
    };
    // These aggregates do not depend on the number of duplicate rows.
    !matches!(name.as_str(), "min" | "max" | "bool_or" | "bool_and") && super::order::is_aggregate(expression)
}

fn nearest(
    item: &FromItem<'_>,
    target: usize,
    items: &[FromItem<'_>],
    from: &[sqlparser::ast::TableWithJoins],
    selection: Option<&Expr>,
) -> Option<NearestTable> {
    let (comma, join) = item.place;
    let mut conditions: Vec<String> = Vec::new();
    let mut optional = false;
    let take = |expression: &Expr, conditions: &mut Vec<String>, all: bool| {
        for part in conjuncts(expression) {
            if all || mentioned_relations(part, items).contains(&target) {
                conditions.push(format!("({part})"));
            }
        }
    };
    if join == 0 {
        if !from.get(comma)?.joins.is_empty() {
            return None;
        }
    } else {
        let joined = from.get(comma)?.joins.get(join - 1)?;
        match &joined.join_operator {
            JoinOperator::Left(_) | JoinOperator::LeftOuter(_) => optional = true,
            JoinOperator::Join(_) | JoinOperator::Inner(_) | JoinOperator::CrossJoin(_) => {}
            _ => return None,
        }
        match &joined.join_operator {
            JoinOperator::Join(constraint)
            | JoinOperator::Inner(constraint)
            | JoinOperator::Left(constraint)
            | JoinOperator::LeftOuter(constraint)
            | JoinOperator::CrossJoin(constraint) => {
                if matches!(constraint, JoinConstraint::Using(_) | JoinConstraint::Natural) {
                    return None;
                }
            }
            _ => return None,
        }
        if let Some(on) = condition(&joined.join_operator) {
            take(on, &mut conditions, true);
        }
    }
    // Other joins may refer to the table.
    for (index, other) in from.iter().enumerate() {
        for (place, joined) in other.joins.iter().enumerate() {
            if (index, place + 1) != item.place
                && condition(&joined.join_operator)
                    .is_some_and(|on| mentioned_relations(on, items).contains(&target))
            {
                return None;
            }
        }
    }
    if let Some(selection) = selection {
        // A condition after WHERE also applies to the null row of an outer join.
        if optional && mentioned_relations(selection, items).contains(&target) {
            return None;
        }
        take(selection, &mut conditions, false);
    }
    let factor = match join {
        0 => &from.get(comma)?.relation,
        join => &from.get(comma)?.joins.get(join - 1)?.relation,
    };
    let TableFactor::Table { .. } = factor else { return None };
    let alias = item.alias.as_ref()?;
    let relation = format!("{} AS {}", quote_name(&item.table?.name), quote_name(&alias.value));
    Some(NearestTable { place: item.place, relation, conditions, optional })
}
