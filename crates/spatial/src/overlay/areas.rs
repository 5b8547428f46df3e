//! Set operations on areas.

use geo::bool_ops::{FillRule, OpType};
use geo::{BooleanOps, Coord, MultiPolygon};
use rustc_hash::FxHashMap;

/// What is inside of rings: all that they go around, in whatever direction, so that polygons of one geometry may overlap.
pub(crate) const FILL: FillRule = FillRule::NonZero;

/// The area that an operation makes of two. Its corners that are as good as corners of one of them are these.
///
/// Outer rings are counter-clockwise, and holes clockwise.
pub(super) fn combine(one: &MultiPolygon, two: &MultiPolygon, operation: OpType) -> MultiPolygon {
    let mut made = one.boolean_op_with_fill_rule(two, operation, FILL);
    snap(&mut made, [one, two]);
    made
}

/// The places of the grid that i_overlay computes on, to each side of the middle.
const GRID: f64 = 268_435_456.0;

/// Moves corners that were put on the grid to where they came from, and leaves out what has no area but for that.
pub(super) fn snap<'a>(made: &mut MultiPolygon, from: impl IntoIterator<Item = &'a MultiPolygon>) {
    if made.0.is_empty() {
        return;
    }
    let corners: Vec<Coord> = from
        .into_iter()
        .flat_map(|shape| shape.iter())
        .flat_map(|polygon| std::iter::once(polygon.exterior()).chain(polygon.interiors()))
        .flat_map(|ring| ring.0.iter().copied())
        .collect();
    let extent = corners.iter().fold(0.0_f64, |most, at| most.max(at.x.abs()).max(at.y.abs()));
    if extent == 0.0 {
        return;
    }
    let step = 4.0 * extent / GRID;
    #[allow(clippy::cast_possible_truncation, reason = "far less than 2^63 steps")]
    let cell = |at: Coord| ((at.x / step).floor() as i64, (at.y / step).floor() as i64);
    let mut known: FxHashMap<(i64, i64), Vec<Coord>> = FxHashMap::default();
    for corner in corners {
        let there = known.entry(cell(corner)).or_default();
        if !there.contains(&corner) {
            there.push(corner);
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
        Some(geo::Polygon::new(outer, polygon.interiors().iter().map(mend).filter(is_area).collect()))
    });
    made.0 = polygons.collect();
}
