//! Positions on a grid of about one micrometre, with exact tests for the borders of lots.

use burgeon_geometry::planar::edges;
use glam::DVec2;

use crate::plan::grid::{FARTHEST, WholePlace, touch};

/// Number of grid steps per metre: 2^20.
const PER_METRE: f64 = 1_048_576.0;

/// Position on the grid. Its coordinates in metres are exact in 64-bit floating point.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub(crate) struct FinePlace {
    x: i64,
    y: i64,
}

impl FinePlace {
    /// Returns the grid position nearest to `place` (m); `None` if it is not finite or too far from the origin.
    pub(crate) fn nearest(place: DVec2) -> Option<Self> {
        let within = place.is_finite() && place.abs().max_element() <= FARTHEST + 10_000.0;
        #[allow(clippy::cast_possible_truncation, reason = "within 2^40 steps")]
        within.then(|| {
            let steps = (place * PER_METRE).round();
            Self { x: steps.x as i64, y: steps.y as i64 }
        })
    }

    /// Returns the exact coordinates (m).
    #[allow(clippy::cast_precision_loss, reason = "within 2^40 steps")]
    pub(crate) fn metres(self) -> DVec2 {
        DVec2::new(self.x as f64, self.y as f64) / PER_METRE
    }
}

impl WholePlace for FinePlace {
    fn steps(self) -> [i64; 2] {
        [self.x, self.y]
    }

    #[allow(clippy::cast_precision_loss, reason = "differences are within 2^41 steps")]
    fn side_of(self, a: Self, b: Self) -> i32 {
        let [ux, uy, vx, vy] = [b.x - a.x, b.y - a.y, self.x - a.x, self.y - a.y];
        let (left, right) = (ux as f64 * vy as f64, uy as f64 * vx as f64);
        let turn = left - right;
        // Each product is rounded once, and so is the difference.
        if turn.abs() > 4.0 * f64::EPSILON * (left.abs() + right.abs()) {
            return if turn > 0.0 { 1 } else { -1 };
        }
        let exact = i128::from(ux) * i128::from(vy) - i128::from(uy) * i128::from(vx);
        i32::from(exact > 0) - i32::from(exact < 0)
    }
}

/// Returns the side of the directed line from `a` to `b` on which a position is: 1 on the left, 0 on the line, -1 on
/// the right.
pub(crate) fn side(a: FinePlace, b: FinePlace, place: FinePlace) -> i32 {
    place.side_of(a, b)
}

/// Returns true if two edges share a point that is not an end of both.
pub(crate) fn meet([a, b]: [FinePlace; 2], [c, d]: [FinePlace; 2]) -> bool {
    let apart = |a: i64, b: i64, c: i64, d: i64| a.max(b) < c.min(d) || c.max(d) < a.min(b);
    if apart(a.x, b.x, c.x, d.x) || apart(a.y, b.y, c.y, d.y) {
        return false;
    }
    let shared = [(a, b, c, d), (a, b, d, c), (b, a, c, d), (b, a, d, c)];
    if let Some((end, p, _, q)) = shared.into_iter().find(|(end, _, other, _)| end == other) {
        return side(end, p, q) == 0 && (p.is_between(end, q) || q.is_between(end, p));
    }
    touch([a, b], [c, d])
}

/// Returns true if a position is inside a ring of either orientation; the result on the border is unspecified.
pub(crate) fn is_inside(ring: &[FinePlace], place: FinePlace) -> bool {
    let crossed = edges(ring).filter(|[a, b]| {
        let upwards = a.y <= place.y && place.y < b.y;
        let downwards = b.y <= place.y && place.y < a.y;
        (upwards && side(*a, *b, place) > 0) || (downwards && side(*a, *b, place) < 0)
    });
    crossed.count() % 2 == 1
}

/// Returns true if edges of the rings meet only at common ends, and only adjacent edges of a ring share an end.
pub(crate) fn are_simple(rings: &[Vec<FinePlace>]) -> bool {
    let mut all: Vec<[FinePlace; 2]> = Vec::new();
    let mut corners: Vec<FinePlace> = Vec::new();
    for ring in rings {
        if ring.len() < 3 {
            return false;
        }
        all.extend(edges(ring));
        corners.extend(ring);
    }
    corners.sort_unstable();
    if corners.windows(2).any(|pair| pair[0] == pair[1]) {
        return false;
    }
    are_apart(all)
}

/// Returns true if edges meet only at the ends of both.
///
/// Method: sweep from left to right; each edge is tested against the edges that begin before it ends.
pub(crate) fn are_apart(mut edges: Vec<[FinePlace; 2]>) -> bool {
    edges.sort_unstable_by_key(|[a, b]| a.x.min(b.x));
    edges.iter().enumerate().all(|(index, edge)| {
        let right = edge[0].x.max(edge[1].x);
        let beside = edges[index + 1..].iter().take_while(|other| other[0].x.min(other[1].x) <= right);
        beside.into_iter().all(|other| !meet(*edge, *other))
    })
}
