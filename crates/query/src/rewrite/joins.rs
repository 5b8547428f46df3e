//! Spatial conditions that an index answers: of each, the boxes are compared first.
//!
//! Where `P(a.geom, b.geom)` must hold and can do so only where boxes meet, or are near, `b.fid IN (...)` is added, with the
//! keys of the rows whose boxes do. SQLite then looks `b` up by its key for each row of `a`. Which of the two is looked
//! up is decided here, since SQLite knows nothing of either: the one of which more rows are left without it.

use std::ops::ControlFlow;

use sqlparser::ast::{BinaryOperator, Expr, Select, Value};

use super::Catalogue;
use super::operators::call;
use super::scope::{
    FromItem, condition, condition_mut, conjuncts, geometry_column, mentioned, quoted, relations, text,
};
use super::walk::{StatementPart, walk};
use super::{TableInfo, parse};

/// How many rows something is taken to have of which that is not known.
const UNKNOWN_ROWS: f64 = 1000.0;

/// What is left by a condition: that a column equals something, any other, and one that an index answers.
const LEFT: [f64; 3] = [0.02, 0.3, 0.01];

/// Where a condition stands.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum ConditionPlace {
    /// Behind WHERE.
    Where,
    /// Behind ON of a join: the number of the comma and of the join.
    On(usize, usize),
}

/// One side of a spatial condition whose table can be looked up.
struct ConditionSide<'a> {
    relation: usize,
    table: &'a TableInfo,
    column: &'a str,
    /// What its boxes are compared with.
    other: String,
    /// What that speaks of.
    needs: Vec<usize>,
}

/// A spatial condition.
struct SpatialCondition<'a> {
    site: ConditionPlace,
    sides: Vec<ConditionSide<'a>>,
    /// How far the boxes may be from each other.
    distance: String,
}

/// Adds conditions on boxes to a query; gives the names of the indexes that they ask.
pub(super) fn index(select: &mut Select, tables: &Catalogue) -> Vec<String> {
    let relations = relations(select, tables);
    let mut found = Vec::new();
    let mut rows: Vec<f64> = relations.iter().map(rows).collect();
    for (site, condition) in sites(select) {
        for part in conjuncts(condition) {
            match spatial(part, site, &relations) {
                Some(condition) => found.push(condition),
                None => weigh(part, &relations, &mut rows),
            }
        }
    }
    let mut looked_up = vec![false; relations.len()];
    let mut added = Vec::new();
    let mut add = |site, side: &ConditionSide<'_>, distance: &str| {
        let ConditionSide { relation, table, column, other, .. } = side;
        let Some((alias, key)) = relations[*relation].alias.as_ref().zip(table.key.as_ref()) else { return };
        let name = format!("{}.{column}", table.name);
        let index = text(&name);
        added.push((
            site,
            name,
            format!(
                "{}.{} IN (SELECT value FROM rarray(burgeon_near({index}, {other}, {distance})))",
                quoted(&alias.value),
                quoted(key)
            ),
        ));
    };
    // What is compared with a constant comes first: it decides which table the others begin with.
    for condition in &found {
        for side in condition.sides.iter().filter(|side| side.needs.is_empty()) {
            if !looked_up[side.relation] {
                looked_up[side.relation] = true;
                rows[side.relation] *= LEFT[2];
                add(condition.site, side, &condition.distance);
            }
        }
    }
    for condition in &found {
        let open = condition.sides.iter().filter(|side| !side.needs.is_empty() && !looked_up[side.relation]);
        // Of equal ones the one that stands later.
        let best = open
            .max_by(|a, b| rows[a.relation].total_cmp(&rows[b.relation]).then(a.relation.cmp(&b.relation)));
        if let Some(side) = best {
            looked_up[side.relation] = true;
            add(condition.site, side, &condition.distance);
        }
    }
    let attached = added.into_iter().filter(|(site, _, condition)| attach(select, *site, condition));
    attached.map(|(_, name, _)| name).collect()
}

fn rows(relation: &FromItem<'_>) -> f64 {
    #[allow(clippy::cast_precision_loss, reason = "an estimate")]
    relation.table.map_or(UNKNOWN_ROWS, |table| table.rows as f64)
}

/// All conditions of a query.
fn sites(select: &Select) -> Vec<(ConditionPlace, &Expr)> {
    let mut sites = Vec::new();
    for (comma, item) in select.from.iter().enumerate() {
        for (join, joined) in item.joins.iter().enumerate() {
            if let Some(on) = condition(&joined.join_operator) {
                sites.push((ConditionPlace::On(comma, join), on));
            }
        }
    }
    sites.extend(select.selection.iter().map(|condition| (ConditionPlace::Where, condition)));
    sites
}

/// Puts a condition before those of a site.
fn attach(select: &mut Select, site: ConditionPlace, condition: &str) -> bool {
    let place = match site {
        ConditionPlace::Where => select.selection.as_mut(),
        ConditionPlace::On(comma, join) => {
            let joined = select.from.get_mut(comma).and_then(|item| item.joins.get_mut(join));
            joined.and_then(|joined| condition_mut(&mut joined.join_operator))
        }
    };
    let Some((place, condition)) = place.zip(parse::expression(condition)) else { return false };
    let old = std::mem::replace(place, Expr::Value(Value::Null.into()));
    *place = Expr::BinaryOp {
        left: Box::new(condition),
        op: BinaryOperator::And,
        right: Box::new(Expr::Nested(Box::new(old))),
    };
    true
}

/// Counts fewer rows for a condition on one table alone.
fn weigh(part: &Expr, relations: &[FromItem<'_>], rows: &mut [f64]) {
    let [only] = mentioned(part, relations)[..] else { return };
    let equals =
        matches!(part, Expr::BinaryOp { op: BinaryOperator::Eq, .. } | Expr::InList { negated: false, .. });
    rows[only] *= LEFT[usize::from(!equals)];
}

/// What an index can do for a condition.
fn spatial<'a>(
    part: &Expr,
    site: ConditionPlace,
    relations: &[FromItem<'a>],
) -> Option<SpatialCondition<'a>> {
    let (a, b, distance) = near(part)?;
    // The distance is asked before the row is there.
    if distance.is_some_and(|distance| !mentioned(distance, relations).is_empty()) {
        return None;
    }
    let sides = [(a, b), (b, a)].into_iter().filter_map(|(own, other)| side(own, other, site, relations));
    let sides: Vec<ConditionSide<'a>> = sides.collect();
    let distance = distance.map_or_else(|| "0".to_owned(), ToString::to_string);
    (!sides.is_empty()).then_some(SpatialCondition { site, sides, distance })
}

fn side<'a>(
    own: &Expr,
    other: &Expr,
    site: ConditionPlace,
    relations: &[FromItem<'a>],
) -> Option<ConditionSide<'a>> {
    let (relation, table, column) = geometry_column(own, relations)?;
    table.key.as_ref()?;
    let place = relations[relation].place;
    // The condition of an outer join says which of its own rows belong to one that is there already.
    let allowed = match site {
        ConditionPlace::Where => !relations[relation].optional,
        ConditionPlace::On(comma, join) => {
            let joined = relations.iter().find(|relation| relation.place == (comma, join + 1));
            place == (comma, join + 1)
                || joined.is_some_and(|joined| !joined.optional && !relations[relation].optional)
        }
    };
    let needs = mentioned(other, relations);
    let fits = allowed && !needs.contains(&relation) && is_plain(other);
    fits.then(|| ConditionSide { relation, table, column, other: other.to_string(), needs })
}

/// Whether an expression may be computed once more: one that holds no query of its own.
fn is_plain(expression: &Expr) -> bool {
    let walked = walk(expression, |part| match part {
        StatementPart::Query(_) => ControlFlow::Break(()),
        _ => ControlFlow::Continue(()),
    });
    walked.is_continue()
}

/// The two geometries of a condition that holds only where their boxes meet, or are no farther than a distance.
fn near(part: &Expr) -> Option<(&Expr, &Expr, Option<&Expr>)> {
    use BinaryOperator as Op;
    match part {
        Expr::Nested(inner) | Expr::IsTrue(inner) => near(inner),
        Expr::BinaryOp { left, op: Op::Eq, right } => {
            let (call, constant) = if is_one(right) { (left, right) } else { (right, left) };
            if is_one(constant) { near(call) } else { None }
        }
        Expr::BinaryOp { left, op: Op::Lt | Op::LtEq, right } => within(left, right),
        Expr::BinaryOp { left, op: Op::Gt | Op::GtEq, right } => within(right, left),
        other => {
            let (name, arguments) = call(other)?;
            match (name.as_str(), arguments.as_slice()) {
                (
                    "st_intersects" | "st_contains" | "st_within" | "st_overlaps" | "st_touches"
                    | "st_crosses" | "st_covers" | "st_coveredby" | "st_equals" | "geometry_overlaps",
                    [a, b],
                ) => Some((a, b, None)),
                ("st_dwithin", [a, b, distance]) => Some((a, b, Some(distance))),
                _ => None,
            }
        }
    }
}

fn is_one(expression: &Expr) -> bool {
    let Expr::Value(value) = expression else { return false };
    matches!(&value.value, Value::Boolean(true))
        || matches!(&value.value, Value::Number(number, _) if number == "1")
}

/// The geometries that `measured` is the distance of.
fn within<'a>(measured: &'a Expr, distance: &'a Expr) -> Option<(&'a Expr, &'a Expr, Option<&'a Expr>)> {
    let measured = if let Expr::Nested(inner) = measured { inner } else { measured };
    let (name, arguments) = call(measured)?;
    let [a, b] = arguments.as_slice() else { return None };
    (name == "st_distance").then_some((a, b, Some(distance)))
}
