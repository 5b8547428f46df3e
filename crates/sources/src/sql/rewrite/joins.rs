//! Spatial conditions that use an index: their boxes are compared first.
//!
//! If a required condition `P(a.geom, b.geom)` implies that the boxes intersect, or are near, then `b.fid IN (...)` is
//! added, with the keys of the rows whose boxes do so. SQLite then looks up `b` by key for each row of `a`. The choice
//! of the table to look up is made here, because SQLite lacks statistics of both: it is the table with more remaining
//! rows.

use std::borrow::Cow;
use std::ops::ControlFlow;

use sqlparser::ast::{BinaryOperator, Expr, Select, Value};

use super::Catalogue;
use super::operators::call;
use super::scope::{
    FromItem, condition, condition_mut, conjuncts, geometry_column, mentioned_relations, relations,
};
use super::walk::{StatementPart, walk};
use super::{TableInfo, parse};
use crate::sql::statement_text::{quote_name, quote_text};

/// Assumed number of rows of an unknown relation.
const UNKNOWN_ROWS: f64 = 1000.0;

/// Assumed fraction of rows that remain after a condition: equality of a column, any other condition, and a condition
/// with an index.
const LEFT: [f64; 3] = [0.02, 0.3, 0.01];

/// The position of a condition.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum ConditionPlace {
    /// Condition after WHERE.
    Where,
    /// Condition after ON of a join: the number of the item in FROM, and of the join.
    On(usize, usize),
}

/// A way to look up rows by key.
enum Lookup {
    /// Lookup of the rows whose boxes in the index are near the box of a geometry.
    Near {
        /// Name of the index.
        index: String,
        /// Geometry, as SQL.
        other: String,
        /// Maximum distance between the boxes, as SQL.
        distance: Cow<'static, str>,
    },
    /// Lookup of the row with a key.
    Key(String),
}

impl Lookup {
    /// Returns the keys as a query.
    fn sql(&self) -> String {
        match self {
            Self::Near { index, other, distance } => {
                format!("SELECT value FROM rarray(burgeon_near({}, {other}, {distance}))", quote_text(index))
            }
            Self::Key(key) => format!("SELECT {key}"),
        }
    }
}

/// A side of a spatial condition, whose table can be looked up.
struct ConditionSide<'a> {
    relation: usize,
    table: &'a TableInfo,
    /// Lookups of its rows; a row that any of them returns may satisfy the condition.
    lookups: Vec<Lookup>,
    /// Relations that the lookups depend on.
    needs: Vec<usize>,
}

/// A spatial condition.
struct SpatialCondition<'a> {
    site: ConditionPlace,
    sides: Vec<ConditionSide<'a>>,
}

/// Adds conditions on boxes to a query, and returns the names of the indexes that they use.
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
    let mut add = |site, side: &ConditionSide<'_>| {
        let ConditionSide { relation, table, lookups, .. } = side;
        let Some((alias, key)) = relations[*relation].alias.as_ref().zip(table.key.as_ref()) else { return };
        let indexes = lookups.iter().filter_map(|lookup| match lookup {
            Lookup::Near { index, .. } => Some(index.clone()),
            Lookup::Key(_) => None,
        });
        let keys: Vec<String> = lookups.iter().map(Lookup::sql).collect();
        added.push((
            site,
            indexes.collect::<Vec<String>>(),
            format!("{}.{} IN ({})", quote_name(&alias.value), quote_name(key), keys.join(" UNION ")),
        ));
    };
    // Comparisons with a constant come first, because they determine the table to start with.
    for condition in &found {
        for side in condition.sides.iter().filter(|side| side.needs.is_empty()) {
            if !looked_up[side.relation] {
                looked_up[side.relation] = true;
                rows[side.relation] *= LEFT[2];
                add(condition.site, side);
            }
        }
    }
    for condition in &found {
        let open = condition.sides.iter().filter(|side| !side.needs.is_empty() && !looked_up[side.relation]);
        // Among equally large tables, the later one is looked up.
        let best = open
            .max_by(|a, b| rows[a.relation].total_cmp(&rows[b.relation]).then(a.relation.cmp(&b.relation)));
        if let Some(side) = best {
            looked_up[side.relation] = true;
            add(condition.site, side);
        }
    }
    let attached = added.into_iter().filter(|(site, _, condition)| attach(select, *site, condition));
    attached.flat_map(|(_, names, _)| names).collect()
}

fn rows(relation: &FromItem<'_>) -> f64 {
    #[allow(clippy::cast_precision_loss, reason = "an estimate")]
    relation.table.map_or(UNKNOWN_ROWS, |table| table.rows as f64)
}

/// Returns all conditions of a query.
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

/// Inserts a condition before the conditions at a position.
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

/// Reduces the estimated number of rows for a condition on a single table.
fn weigh(part: &Expr, relations: &[FromItem<'_>], rows: &mut [f64]) {
    let [only] = mentioned_relations(part, relations)[..] else { return };
    let equals =
        matches!(part, Expr::BinaryOp { op: BinaryOperator::Eq, .. } | Expr::InList { negated: false, .. });
    rows[only] *= LEFT[usize::from(!equals)];
}

/// Returns the sides of a condition for which an index can be used.
fn spatial<'a>(
    part: &Expr,
    site: ConditionPlace,
    relations: &[FromItem<'a>],
) -> Option<SpatialCondition<'a>> {
    if let Some((a, b, distance)) = near_geometries(part) {
        let sides = [(a, b), (b, a)].into_iter();
        let sides = sides.filter_map(|(own, other)| side(own, other, distance, site, relations));
        let sides: Vec<ConditionSide<'a>> = sides.collect();
        return (!sides.is_empty()).then_some(SpatialCondition { site, sides });
    }
    let parts = disjuncts(part);
    if parts.len() < 2 {
        return None;
    }
    let sides = (0..relations.len()).filter_map(|relation| any(&parts, relation, site, relations));
    let sides: Vec<ConditionSide<'a>> = sides.collect();
    (!sides.is_empty()).then_some(SpatialCondition { site, sides })
}

/// Returns the parts of a condition of which at least one must hold.
fn disjuncts(condition: &Expr) -> Vec<&Expr> {
    match condition {
        Expr::BinaryOp { left, op: BinaryOperator::Or, right } => {
            let mut parts = disjuncts(left);
            parts.extend(disjuncts(right));
            parts
        }
        Expr::Nested(inner) => disjuncts(inner),
        other => vec![other],
    }
}

/// Returns the lookups of a relation's rows for a disjunction, if there is one for each part.
fn any<'a>(
    parts: &[&Expr],
    relation: usize,
    site: ConditionPlace,
    relations: &[FromItem<'a>],
) -> Option<ConditionSide<'a>> {
    let mut all: Option<ConditionSide<'a>> = None;
    for part in parts {
        let found = conjuncts(part).into_iter().find_map(|part| {
            if let Some((a, b, distance)) = near_geometries(part) {
                let mut sides = [(a, b), (b, a)]
                    .into_iter()
                    .filter_map(|(own, other)| side(own, other, distance, site, relations));
                return sides.find(|side| side.relation == relation);
            }
            key_lookup(part, relation, site, relations)
        })?;
        match &mut all {
            Some(all) => {
                all.lookups.extend(found.lookups);
                all.needs.extend(found.needs);
            }
            None => all = Some(found),
        }
    }
    let mut all = all?;
    all.needs.sort_unstable();
    all.needs.dedup();
    // SQLite itself looks up keys.
    all.lookups.iter().any(|lookup| matches!(lookup, Lookup::Near { .. })).then_some(all)
}

/// Returns the lookup of a relation's row by an equality of its key.
fn key_lookup<'a>(
    part: &Expr,
    relation: usize,
    site: ConditionPlace,
    relations: &[FromItem<'a>],
) -> Option<ConditionSide<'a>> {
    let Expr::BinaryOp { left, op: BinaryOperator::Eq, right } = part else { return None };
    let item = &relations[relation];
    let (table, alias) = (item.table?, item.alias.as_ref()?);
    let key = table.key.as_ref()?;
    let is_key = |expression: &Expr| match expression {
        Expr::CompoundIdentifier(names) => matches!(names.as_slice(), [owner, name]
            if owner.value.eq_ignore_ascii_case(&alias.value) && name.value.eq_ignore_ascii_case(key)),
        _ => false,
    };
    let other = match (is_key(left), is_key(right)) {
        (true, false) => right,
        (false, true) => left,
        _ => return None,
    };
    let needs = mentioned_relations(other, relations);
    let fits = is_allowed(relation, site, relations) && !needs.contains(&relation) && is_plain(other);
    fits.then(|| ConditionSide { relation, table, lookups: vec![Lookup::Key(other.to_string())], needs })
}

/// Reports whether a condition at a position may filter the rows of a relation.
fn is_allowed(relation: usize, site: ConditionPlace, relations: &[FromItem<'_>]) -> bool {
    let place = relations[relation].place;
    // The condition of an outer join only selects the rows to join, and does not filter the rows of the other
    // relations.
    match site {
        ConditionPlace::Where => !relations[relation].optional,
        ConditionPlace::On(comma, join) => {
            let joined = relations.iter().find(|relation| relation.place == (comma, join + 1));
            place == (comma, join + 1)
                || joined.is_some_and(|joined| !joined.optional && !relations[relation].optional)
        }
    }
}

fn side<'a>(
    own: &Expr,
    other: &Expr,
    distance: Option<&Expr>,
    site: ConditionPlace,
    relations: &[FromItem<'a>],
) -> Option<ConditionSide<'a>> {
    let (relation, table, column) = geometry_column(own, relations)?;
    table.key.as_ref()?;
    // The distance is evaluated before the row is available.
    if distance.is_some_and(|distance| !mentioned_relations(distance, relations).is_empty()) {
        return None;
    }
    let needs = mentioned_relations(other, relations);
    let fits = is_allowed(relation, site, relations) && !needs.contains(&relation) && is_plain(other);
    let lookup = Lookup::Near {
        index: format!("{}.{column}", table.name),
        other: other.to_string(),
        distance: distance.map_or("0".into(), |distance| distance.to_string().into()),
    };
    fits.then(|| ConditionSide { relation, table, lookups: vec![lookup], needs })
}

/// Reports whether an expression may be evaluated again: it contains no subquery.
fn is_plain(expression: &Expr) -> bool {
    let walked = walk(expression, |part| match part {
        StatementPart::Query(_) => ControlFlow::Break(()),
        _ => ControlFlow::Continue(()),
    });
    walked.is_continue()
}

/// Returns the two geometries of a condition that implies that their boxes intersect, or are within a distance.
fn near_geometries(part: &Expr) -> Option<(&Expr, &Expr, Option<&Expr>)> {
    use BinaryOperator as Op;
    match part {
        Expr::Nested(inner) | Expr::IsTrue(inner) => near_geometries(inner),
        Expr::BinaryOp { left, op: Op::Eq, right } => {
            let (call, constant) = if is_one(right) { (left, right) } else { (right, left) };
            if is_one(constant) { near_geometries(call) } else { None }
        }
        Expr::BinaryOp { left, op: Op::Lt | Op::LtEq, right } => geometries_within(left, right),
        Expr::BinaryOp { left, op: Op::Gt | Op::GtEq, right } => geometries_within(right, left),
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

/// Returns the geometries of a comparison of their distance `measured` with a limit.
fn geometries_within<'a>(
    measured: &'a Expr,
    distance: &'a Expr,
) -> Option<(&'a Expr, &'a Expr, Option<&'a Expr>)> {
    let measured = if let Expr::Nested(inner) = measured { inner } else { measured };
    let (name, arguments) = call(measured)?;
    let [a, b] = arguments.as_slice() else { return None };
    (name == "st_distance").then_some((a, b, Some(distance)))
}
