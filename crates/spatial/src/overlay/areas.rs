//! Set operations on areas.

use burgeon_base::budget::Budget;
use geo::bool_ops::{FillRule, OpType};
use geo::orient::{Direction, Orient};
use geo::{BooleanOps, Coord, MultiPolygon};
use rustc_hash::FxHashMap;

use crate::ways::multi_polygon_flaw;

/// What is inside of rings: all that they go around, in whatever direction, so that polygons of one geometry may overlap.
pub(crate) const FILL: FillRule = FillRule::NonZero;

/// The area that an operation makes of two. Its corners are those of `nodes` that they were meant to be.
///
/// Outer rings are counter-clockwise, and holes clockwise.
pub(super) fn combine(
    one: &MultiPolygon,
    two: &MultiPolygon,
    operation: OpType,
    nodes: impl IntoIterator<Item = Coord>,
) -> MultiPolygon {
    let mut made = one.boolean_op_with_fill_rule(two, operation, FILL);
    snap(&mut made, nodes);
    // Where none can be with another area, holes are where they belong.
    let has_holes = made.iter().any(|area| !area.interiors().is_empty());
    if made.0.len() > 1 && has_holes { untangled(made) } else { made }
}

/// How often areas are computed again until they are valid.
const MOST_ROUNDS: usize = 8;

/// Areas that were computed, made valid. Where edges cross hundreds of times, holes come out with areas that they do not
/// lie in, and edges that the grid moves cross others; what lies on the grid already is computed again without either.
pub(super) fn untangled(mut made: MultiPolygon) -> MultiPolygon {
    for _ in 0..MOST_ROUNDS {
        if !matches!(multi_polygon_flaw(&made, &Budget::default()), Ok(Some(_))) {
            break;
        }
        made = made.union_with_fill_rule(&MultiPolygon::new(Vec::new()), FILL);
    }
    made
}

/// The corners of areas.
pub(super) fn corners(areas: &MultiPolygon) -> impl Iterator<Item = Coord> {
    let rings = areas.iter().flat_map(|it| std::iter::once(it.exterior()).chain(it.interiors()));
    rings.flat_map(|ring| ring.0.iter().copied())
}

/// The places of the grid that i_overlay computes on, to each side of the middle.
const GRID: f64 = 268_435_456.0;

/// Moves corners that were put on the grid to the nodes that they came from, and leaves out what has no area but for that.
pub(super) fn snap(made: &mut MultiPolygon, nodes: impl IntoIterator<Item = Coord>) {
    if made.0.is_empty() {
        return;
    }
    let nodes: Vec<Coord> = nodes.into_iter().collect();
    let extent = nodes.iter().fold(0.0_f64, |most, at| most.max(at.x.abs()).max(at.y.abs()));
    if extent == 0.0 {
        return;
    }
    let step = 4.0 * extent / GRID;
    #[allow(clippy::cast_possible_truncation, reason = "far less than 2^63 steps")]
    let cell = |at: Coord| ((at.x / step).floor() as i64, (at.y / step).floor() as i64);
    let mut known: FxHashMap<(i64, i64), Vec<Coord>> = FxHashMap::default();
    for node in nodes {
        let there = known.entry(cell(node)).or_default();
        if !there.contains(&node) {
            there.push(node);
        }
    }
    let snapped = |at: Coord| {
        let (x, y) = cell(at);
        let near = (-1..=1).flat_map(|i| (-1..=1).map(move |j| (x + i, y + j)));
        let found = near.filter_map(|cell| known.get(&cell)).flatten();
        let far = |other: &Coord| (other.x - at.x).hypot(other.y - at.y);
        let nearest = found.min_by(|a, b| far(a).total_cmp(&far(b)));
        nearest.copied().filter(|nearest| far(nearest) <= step).unwrap_or(at)
    };
    let mend = |ring: &geo::LineString| {
        let mut ring: Vec<Coord> = ring.0.iter().map(|at| snapped(*at)).collect();
        ring.dedup();
        geo::LineString::new(ring)
    };
    // A ring whose width is as little as the steps of the grid is none.
    let is_area = |ring: &geo::LineString| {
        use geo::{Area, Euclidean, Length};
        ring.0.len() > 3
            && geo::Polygon::new(ring.clone(), Vec::new()).unsigned_area()
                > Euclidean.length(ring) * step / 4.0
    };
    let polygons = std::mem::take(&mut made.0).into_iter().filter_map(|polygon| {
        let outer = Some(mend(polygon.exterior())).filter(is_area)?;
        let holes = polygon.interiors().iter().map(mend).filter(is_area).collect();
        // A hole that meets the outer ring may come out with the area to its left, and would be filled the next time.
        Some(geo::Polygon::new(outer, holes).orient(Direction::Default))
    });
    made.0 = polygons.collect();
}
