//! Positions of points relative to areas and lines, by exact predicates.

use std::cmp::Ordering;

use geo::{Coord, Kernel, Orientation, kernels::RobustKernel};
use glam::DVec2;

use super::edges::{DirectedEdge, WayEdges};

/// Returns the side of the line from `a` to `b` on which a point lies: greater is left.
///
/// Method: J. Shewchuk, "Adaptive precision floating-point arithmetic and fast robust geometric predicates", 1997.
pub(crate) fn side(a: DVec2, b: DVec2, place: DVec2) -> Ordering {
    let coord = |at: DVec2| Coord { x: at.x, y: at.y };
    match RobustKernel::orient2d(coord(a), coord(b), coord(place)) {
        Orientation::CounterClockwise => Ordering::Greater,
        Orientation::Collinear => Ordering::Equal,
        Orientation::Clockwise => Ordering::Less,
    }
}

/// Returns true if a point on the line of an edge lies on the edge, including its ends.
pub(crate) fn is_between(edge: &DirectedEdge, place: DVec2) -> bool {
    edge.low().cmple(place).all() && place.cmple(edge.high()).all()
}

/// Returns true if a point lies on an edge.
pub(crate) fn is_on(edge: &DirectedEdge, place: DVec2) -> bool {
    is_between(edge, place) && side(edge.from, edge.to, place) == Ordering::Equal
}

/// Returns the position of a point relative to areas: greater is inside, equal is on the border.
pub(crate) fn place_in(areas: &WayEdges, place: DVec2) -> Ordering {
    let mut winding = 0;
    let mut touches = false;
    areas.meeting(place, DVec2::new(f64::MAX, place.y), |_, DirectedEdge { from, to }| {
        let edge = DirectedEdge { from: *from, to: *to };
        touches |= is_on(&edge, place);
        if from.y <= place.y && place.y < to.y {
            winding += i32::from(side(*from, *to, place) == Ordering::Greater);
        } else if to.y <= place.y && place.y < from.y {
            winding -= i32::from(side(*from, *to, place) == Ordering::Less);
        }
    });
    match (touches, winding) {
        (true, _) => Ordering::Equal,
        (_, 0) => Ordering::Less,
        _ => Ordering::Greater,
    }
}

/// Returns true if a point lies on one of the edges.
pub(crate) fn is_on_any(edges: &WayEdges, place: DVec2) -> bool {
    let mut found = false;
    edges.meeting(place, place, |_, edge| found = found || is_on(edge, place));
    found
}

/// Returns true if the line from `from`, on the border of areas, to `to` begins inside them. `around` are the
/// border edges through `from`; none of them has the same direction.
///
/// Method: rotating clockwise from the line's direction, the first border edge decides: if it leaves `from`,
/// the area lies on the side of the line, if it arrives at `from`, it does not.
pub(crate) fn begins_inside(around: impl Iterator<Item = DirectedEdge>, from: DVec2, to: DVec2) -> bool {
    // Directions to the right come before the opposite direction, and that before directions to the left.
    let turn = |way: DVec2| match side(from, to, way) {
        Ordering::Less => 0,
        Ordering::Equal => 1,
        Ordering::Greater => 2,
    };
    let mut first: Option<(u8, DVec2, bool)> = None;
    let mut meet = |way: DVec2, leads_away: bool| {
        let turned = turn(way);
        let is_earlier = first.is_none_or(|(known, other, _)| {
            turned < known || turned == known && side(from, way, other) == Ordering::Less
        });
        if is_earlier {
            first = Some((turned, way, leads_away));
        }
    };
    for edge in around {
        if edge.to != from {
            meet(edge.to, true);
        }
        if edge.from != from {
            meet(edge.from, false);
        }
    }
    first.is_some_and(|(_, _, leads_away)| leads_away)
}
