//! The parts of walls that neighbours cover. Only these parts are blind.
//!
//! Rule: a neighbour covers the part of a wall in front of it up to the top of its own walls, whatever its roof. If the
//! height of a neighbour is unknown before it is built, the neighbour covers the whole height.

use smallvec::{SmallVec, smallvec};

/// Minimum width (m) of a part of a wall. A narrower part takes the cover of its wider neighbour.
const NARROWEST: f64 = 0.6;
/// Fraction of a storey's height that is ignored: a storey covered up to this fraction counts as free, and a storey
/// free up to this fraction counts as covered.
const SLIGHT: f64 = 0.1;

/// A part of an edge that one neighbour covers.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Cover {
    /// Start and end (m) along the edge.
    pub part: [f64; 2],
    /// Height (m) of the top: infinite if unknown.
    pub top: f64,
}

/// A part of a wall with the same covered height along its whole width.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct WallSpan {
    /// Start and end (m) along the edge.
    pub part: [f64; 2],
    /// Covered height (m), from the bottom.
    pub covered: f64,
}

/// Divides an edge into parts, each with the height (m) of its highest cover, or minus infinity without a cover.
fn skyline(covers: &[Cover], length: f64) -> SmallVec<[Cover; 4]> {
    let mut ends: SmallVec<[f64; 8]> = smallvec![0.0, length];
    ends.extend(covers.iter().flat_map(|cover| cover.part).map(|at| at.clamp(0.0, length)));
    ends.sort_by(f64::total_cmp);
    ends.dedup();
    let mut line: SmallVec<[Cover; 4]> = SmallVec::new();
    for pair in ends.windows(2) {
        let middle = pair[0].midpoint(pair[1]);
        let over = covers.iter().filter(|cover| (cover.part[0]..cover.part[1]).contains(&middle));
        let top = over.map(|cover| cover.top).fold(f64::NEG_INFINITY, f64::max);
        match line.last_mut() {
            Some(last) if last.top.total_cmp(&top).is_eq() => last.part[1] = pair[1],
            _ => line.push(Cover { part: [pair[0], pair[1]], top }),
        }
    }
    line
}

/// Returns the fraction, 0 to 1, of a wall between two heights (m) that `covers` hide.
pub(super) fn hidden_fraction(covers: &[Cover], length: f64, [from, to]: [f64; 2]) -> f64 {
    let area =
        |cover: &Cover| (cover.part[1] - cover.part[0]) * ((cover.top - from) / (to - from)).clamp(0.0, 1.0);
    if length > 0.0 { skyline(covers, length).iter().map(area).sum::<f64>() / length } else { 0.0 }
}

/// Divides a wall between two heights (m) into parts of constant covered height, from left to right.
pub(super) fn spans(covers: &[Cover], length: f64, [from, to]: [f64; 2]) -> SmallVec<[WallSpan; 2]> {
    let height = to - from;
    let covered = |top: f64| {
        let part = ((top - from) / height).clamp(0.0, 1.0);
        if part <= SLIGHT {
            0.0
        } else if part >= 1.0 - SLIGHT {
            height
        } else {
            part * height
        }
    };
    let mut spans: SmallVec<[WallSpan; 2]> = SmallVec::new();
    for Cover { part, top } in skyline(covers, length) {
        add(&mut spans, WallSpan { part, covered: covered(top) });
    }
    while spans.len() > 1 {
        let width = |span: &WallSpan| span.part[1] - span.part[0];
        let narrowest = (0..spans.len()).min_by(|&a, &b| width(&spans[a]).total_cmp(&width(&spans[b])));
        let Some(narrow) = narrowest.filter(|&index| width(&spans[index]) < NARROWEST) else { break };
        let beside = [narrow.checked_sub(1), (narrow + 1 < spans.len()).then_some(narrow + 1)];
        let widest =
            beside.into_iter().flatten().max_by(|&a, &b| width(&spans[a]).total_cmp(&width(&spans[b])));
        let Some(widest) = widest else { break };
        spans[narrow].covered = spans[widest].covered;
        for span in std::mem::take(&mut spans) {
            add(&mut spans, span);
        }
    }
    spans
}

/// Adds a span, or extends the last span if the covered heights are equal.
#[allow(clippy::float_cmp, reason = "what is covered alike has equal numbers")]
fn add(spans: &mut SmallVec<[WallSpan; 2]>, span: WallSpan) {
    match spans.last_mut() {
        Some(last) if last.covered == span.covered => last.part[1] = span.part[1],
        _ => spans.push(span),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const INFINITE: f64 = f64::INFINITY;

    fn cover(from: f64, to: f64, top: f64) -> Cover {
        Cover { part: [from, to], top }
    }

    fn found(covers: &[Cover], heights: [f64; 2]) -> Vec<(f64, f64, f64)> {
        spans(covers, 20.0, heights).iter().map(|span| (span.part[0], span.part[1], span.covered)).collect()
    }

    #[test]
    fn a_wall_is_covered_where_neighbours_stand_and_as_high_as_they_are() {
        let covers = [cover(0.0, 8.0, 5.0), cover(6.0, 12.0, 9.0)];
        assert_eq!(found(&covers, [0.0, 3.0]), [(0.0, 12.0, 3.0), (12.0, 20.0, 0.0)]);
        assert_eq!(found(&covers, [6.0, 9.0]), [(0.0, 6.0, 0.0), (6.0, 12.0, 3.0), (12.0, 20.0, 0.0)]);
        assert_eq!(found(&covers, [0.0, 12.0]), [(0.0, 6.0, 5.0), (6.0, 12.0, 9.0), (12.0, 20.0, 0.0)]);
        assert_eq!(found(&covers, [9.0, 12.0]), [(0.0, 20.0, 0.0)]);
        assert_eq!(found(&[], [0.0, 3.0]), [(0.0, 20.0, 0.0)]);
        assert_eq!(found(&[cover(0.0, 20.0, INFINITE)], [9.0, 12.0]), [(0.0, 20.0, 3.0)]);
    }

    #[test]
    fn narrow_parts_are_as_the_wider_ones_beside_them() {
        let covers = [cover(0.0, 7.0, 9.0), cover(7.3, 19.8, 9.0)];
        assert_eq!(found(&covers, [0.0, 3.0]), [(0.0, 20.0, 3.0)]);
        assert_eq!(found(&[cover(0.0, 0.4, 9.0)], [0.0, 3.0]), [(0.0, 20.0, 0.0)]);
        // A storey that is covered except for a few centimetres counts as covered.
        assert_eq!(found(&[cover(0.0, 20.0, 5.9)], [3.0, 6.0]), [(0.0, 20.0, 3.0)]);
        assert_eq!(found(&[cover(0.0, 20.0, 3.1)], [3.0, 6.0]), [(0.0, 20.0, 0.0)]);
    }

    #[test]
    fn the_hidden_part_counts_length_and_height() {
        let near = |found: f64, wanted: f64| assert!((found - wanted).abs() < 1e-12, "{found} {wanted}");
        near(hidden_fraction(&[cover(0.0, 20.0, 5.0)], 20.0, [0.0, 12.0]), 5.0 / 12.0);
        near(hidden_fraction(&[cover(0.0, 10.0, INFINITE)], 20.0, [0.0, 12.0]), 0.5);
        near(
            hidden_fraction(&[cover(0.0, 10.0, 6.0), cover(5.0, 15.0, 3.0)], 20.0, [0.0, 12.0]),
            75.0 / 240.0,
        );
        near(hidden_fraction(&[cover(0.0, 20.0, -5.0)], 20.0, [0.0, 12.0]), 0.0);
    }
}
