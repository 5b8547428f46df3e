//! The drawing of bridges: a deck with parapets, and its supports.

use glam::{DVec2, DVec3};

use burgeon_base::error::Result;
use burgeon_geometry::face;
use burgeon_scene::Part;
use burgeon_streets::{StreetDeck, StreetSpan};
use smallvec::SmallVec;

/// Thickness (m) of a deck.
const DECK: f64 = 1.1;
/// Height and thickness (m) of parapets.
const PARAPET: [f64; 2] = [1.05, 0.3];
/// Thickness (m) of piers along the street, and the distance (m) by which they are narrower than the street on each
/// side.
const PIER: [f64; 2] = [1.4, 1.2];
/// Thickness (m) of the abutments at the shores.
const ABUTMENT: f64 = 3.0;
/// Tolerance (m) within which a point is on the line of a side.
const ON_SIDE: f64 = 0.02;
/// Depth (m) below the water to which supports extend.
const FOOT: f64 = 2.0;

/// Draws a bridge with kerbs of height `kerb` (m) over water at level `water` (m).
pub(super) fn draw_span(part: &mut Part, span: &StreetSpan, kerb: f64, water: f64) -> Result<()> {
    let [right, left] = &span.sides;
    let low = |at: DVec3| at - DVec3::Z * DECK;
    let top = |at: DVec3| at + DVec3::Z * kerb;
    for index in 1..right.len() {
        let (a, b, c, d) = (right[index - 1], right[index], left[index], left[index - 1]);
        face(part, &[low(a), low(b), top(b), top(a)])?;
        face(part, &[low(c), low(d), top(d), top(c)])?;
        face(part, &[low(a), low(d), low(c), low(b)])?;
    }
    let last = right.len() - 1;
    face(part, &[low(left[0]), low(right[0]), right[0], left[0]])?;
    face(part, &[low(right[last]), low(left[last]), left[last], right[last]])?;
    let inward = span.way.perp() * PARAPET[1];
    parapet(part, right, inward, kerb)?;
    let back: Vec<DVec3> = left.iter().rev().copied().collect();
    parapet(part, &back, -inward, kerb)?;
    let half = right[0].truncate().distance(left[0].truncate()) / 2.0;
    for pier in &span.piers {
        block(part, *pier, span.way, [PIER[0] / 2.0, half - PIER[1]], [water - FOOT, pier.z - DECK])?;
    }
    for (index, shore) in span.shores.iter().enumerate() {
        let aside = span.way * (ABUTMENT / 2.0 - 0.2) * if index == 0 { -1.0 } else { 1.0 };
        let middle = *shore + aside.extend(0.0);
        block(part, middle, span.way, [ABUTMENT / 2.0, half], [water - FOOT, shore.z - DECK])?;
    }
    Ok(())
}

/// Draws the structure of streets over other streets, with kerbs of height `kerb` (m): a slab, railings, and piers.
pub(super) fn draw_deck(part: &mut Part, deck: &StreetDeck, kerb: f64) -> Result<()> {
    let points = &deck.surface.points;
    for corners in &deck.surface.triangles {
        let [a, b, c] = corners.map(|corner| points[corner as usize] - DVec3::Z * DECK);
        face(part, &[a, c, b])?;
    }
    for ([a, b], has_railing) in &deck.sides {
        let (low, top) = (-DVec3::Z * DECK, DVec3::Z * kerb);
        // The deck is on the right, so the face is seen from the left.
        face(part, &[*b + low, *a + low, *a + top, *b + top])?;
        if *has_railing {
            let inward = -(*b - *a).truncate().normalize_or_zero().perp() * PARAPET[1];
            parapet(part, &[*b, *a], inward, kerb)?;
        }
    }
    for (at, way) in &deck.piers {
        let [thick, wide] = [PIER[0] / 2.0, PIER[0]];
        block(part, *at, *way, [thick, wide], [-FOOT.min(at.z), at.z - DECK])?;
    }
    Ok(())
}

/// Returns the bridges that may have a side on the border (m) of a part of a street.
pub(super) fn spans_beside<'a>(border: &[DVec3], spans: &'a [StreetSpan]) -> Vec<&'a StreetSpan> {
    let around = |places: &mut dyn Iterator<Item = DVec2>| {
        places.fold([DVec2::INFINITY, DVec2::NEG_INFINITY], |[low, high], at| [low.min(at), high.max(at)])
    };
    let [low, high] = around(&mut border.iter().map(|at| at.truncate()));
    let is_near = |span: &&StreetSpan| {
        let [least, most] = around(&mut span.sides.iter().flatten().map(|at| at.truncate()));
        (least - ON_SIDE).cmple(high).all() && low.cmple(most + ON_SIDE).all()
    };
    spans.iter().filter(is_near).collect()
}

/// Returns the parts of a street's edge (m) that are not the side of a bridge.
pub(super) fn beside_spans(edge: [DVec3; 2], spans: &[&StreetSpan]) -> SmallVec<[[DVec3; 2]; 2]> {
    let [a, b] = edge;
    let mut parts = SmallVec::from_elem(edge, 1);
    for span in spans {
        for side in &span.sides {
            let (first, last) = (side[0].truncate(), side[side.len() - 1].truncate());
            let aside = |at: DVec3| span.way.perp_dot(at.truncate() - first).abs();
            if aside(a) > ON_SIDE || aside(b) > ON_SIDE {
                continue;
            }
            let along = |at: DVec3| span.way.dot(at.truncate() - first);
            let end = span.way.dot(last - first);
            let (from, to) = (along(a), along(b));
            if (from <= 0.0 && to <= 0.0) || (from >= end && to >= end) {
                continue;
            }
            // Orders the ends in the direction of the edge.
            let [near, far] = if from < to { [0.0, end] } else { [end, 0.0] };
            let at = |along: f64| a.lerp(b, (along - from) / (to - from));
            parts.clear();
            parts.extend(((near - from) * (to - from) > 0.0).then(|| [a, at(near)]));
            parts.extend(((to - far) * (to - from) > 0.0).then(|| [at(far), b]));
        }
    }
    parts
}

/// Draws a wall along an edge. Its other side is offset by `inward` (m), to the left of the edge's direction.
fn parapet(part: &mut Part, edge: &[DVec3], inward: DVec2, kerb: f64) -> Result<()> {
    let inward = inward.extend(0.0);
    let raised = |at: DVec3, up: f64| at + DVec3::Z * (kerb + up);
    for pair in edge.windows(2) {
        let [a, b] = [pair[0], pair[1]];
        let [c, d] = [b + inward, a + inward];
        face(part, &[raised(a, 0.0), raised(b, 0.0), raised(b, PARAPET[0]), raised(a, PARAPET[0])])?;
        face(part, &[raised(c, 0.0), raised(d, 0.0), raised(d, PARAPET[0]), raised(c, PARAPET[0])])?;
        face(part, &[a, b, c, d].map(|at| raised(at, PARAPET[0])))?;
    }
    let (first, last) = (edge[0], edge[edge.len() - 1]);
    for [a, b] in [[first + inward, first], [last, last + inward]] {
        face(part, &[raised(a, 0.0), raised(b, 0.0), raised(b, PARAPET[0]), raised(a, PARAPET[0])])?;
    }
    Ok(())
}

/// Draws a block around a centre, with half its sizes (m) along and across a direction, between two heights (m).
fn block(part: &mut Part, middle: DVec3, way: DVec2, half: [f64; 2], [low, high]: [f64; 2]) -> Result<()> {
    if high <= low || half[1] <= 0.0 {
        return Ok(());
    }
    let (along, aside) = (way * half[0], way.perp() * half[1]);
    let middle = middle.truncate();
    let ring =
        [middle - along - aside, middle + along - aside, middle + along + aside, middle - along + aside];
    let at = |height: f64| ring.map(|corner| corner.extend(height));
    let (bottom, top) = (at(low), at(high));
    for index in 0..4 {
        let next = (index + 1) % 4;
        face(part, &[bottom[index], bottom[next], top[next], top[index]])?;
    }
    face(part, &top)?;
    face(part, &[bottom[0], bottom[3], bottom[2], bottom[1]])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_edge_has_no_part_beside_a_bridge() {
        let at = |x: f64, y: f64| DVec3::new(x, y, x / 10.0);
        let side = |y: f64| vec![at(20.0, y), at(30.0, y), at(60.0, y)];
        let sides = [side(-5.0), side(5.0)];
        let span = StreetSpan { piece: 0, way: DVec2::X, sides, shores: Vec::new(), piers: Vec::new() };
        let parts = |a: DVec3, b: DVec3| {
            let parts = beside_spans([a, b], &[&span]);
            parts.iter().map(|part| part.map(|at| (at * 1000.0).round() / 1000.0)).collect::<Vec<_>>()
        };
        let whole = [at(0.0, 5.0), at(100.0, 5.0)];
        assert_eq!(parts(whole[0], whole[1]), [[whole[0], at(20.0, 5.0)], [at(60.0, 5.0), whole[1]]]);
        assert_eq!(parts(whole[1], whole[0]), [[whole[1], at(60.0, 5.0)], [at(20.0, 5.0), whole[0]]]);
        assert_eq!(parts(at(40.0, -5.0), at(100.0, -5.0)), [[at(60.0, -5.0), at(100.0, -5.0)]]);
        assert!(parts(at(20.0, 5.0), at(60.0, 5.0)).is_empty());
        let others =
            [[at(0.0, 5.0), at(20.0, 5.0)], [at(0.0, 4.0), at(100.0, 4.0)], [at(30.0, 5.0), at(30.0, 50.0)]];
        assert!(others.into_iter().all(|[a, b]| parts(a, b) == [[a, b]]));
        let beside = |border: &[DVec3]| spans_beside(border, std::slice::from_ref(&span)).len();
        assert_eq!((beside(&whole), beside(&[at(0.0, 5.1), at(100.0, 9.0)])), (1, 0));
    }
}
