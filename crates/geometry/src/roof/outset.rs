//! Outline of a roof: the outline of the walls, moved outwards over each edge as far as space allows.

use geo::line_intersection::line_intersection;
use glam::DVec2;

use crate::planar::{Polygon, Rings, coord, distance};

/// An outline, with its distance (m) from the walls over each edge.
#[derive(Debug, Clone, Default)]
pub(super) struct Outset {
    pub polygon: Polygon,
    pub distances: Vec<f64>,
    /// Factor of each edge's distance; greater than 1 for chamfers that their neighbours would eliminate.
    pub stretches: Vec<f64>,
}

/// Fraction that is used of the available space before an edge of the outline vanishes, as in a narrow
/// recess.
const KEPT: f64 = 0.9;
/// Length (m) below which an edge must not become shorter.
const SHORT: f64 = 0.015;
/// Maximum sine of the angle between edges that count as parallel.
const STRAIGHT: f64 = 0.02;
/// Maximum distance of a corner from the corner of the walls, as a multiple of the distance of its edges.
const FURTHEST: f64 = 6.5;
/// Minimum value of one plus the cosine of the turn, which limits the length of sharp tips.
const BLUNT: f64 = 0.05;
/// Minimum distance (m) between edges of an outline.
const APART: f64 = 0.01;
/// Minimum distance (m) of an edge; smaller distances become 0.
const LEAST: f64 = 0.01;
/// Maximum remaining length (m) of a chamfer in a reflex corner that its neighbours would eliminate.
const CHAMFER: f64 = 0.035;
/// Maximum factor of a chamfer's distance.
const MOST_STRETCHED: f64 = 2.0;
/// Maximum number of reductions of the distances before all become 0.
const ROUNDS: usize = 200;

impl Outset {
    /// Moves each edge of the rings outwards by the distance (m) that is `wanted`, or by less if there is not
    /// enough space.
    ///
    /// Only edges that would vanish or meet others are reduced, with the edges tied to them.
    ///
    /// Edges that meet in a reflex corner have the same distance, so that neither ends at the other's wall,
    /// unless one of them is `apart` (a gable); collinear edges also have the same distance.
    pub(super) fn new(walls: &Polygon, wanted: Vec<f64>, apart: impl Fn(usize) -> bool) -> Self {
        let mut corners = WallCorner::all(walls, apart);
        let mut distances = wanted;
        for round in 0..ROUNDS {
            level(&corners, &mut distances);
            if distances.iter().all(|distance| *distance == 0.0) {
                break;
            }
            let stretches = stretches(&corners, &distances);
            let away: Vec<f64> =
                distances.iter().zip(&stretches).map(|(distance, by)| distance * by).collect();
            for (edge, corner) in corners.iter_mut().enumerate() {
                corner.moved = corner.place(&away, edge);
            }
            let mut factors = shrink(&corners, &distances);
            if factors.is_empty() {
                factors = crossing(&corners, &distances);
            }
            if factors.is_empty() {
                let Some(polygon) = move_walls(walls, &corners) else { break };
                return Self { polygon, distances, stretches };
            }
            // Distances that approach a limit ever more slowly are reduced faster.
            let most = if round < 8 { 1.0 } else { 0.75 };
            let before = distances.clone();
            for (edge, factor) in factors {
                let less = before[edge] * factor.min(most);
                let whole = (less * 100.0 + 1e-6).floor() / 100.0;
                distances[edge] = distances[edge].min(if whole < LEAST { 0.0 } else { whole });
            }
        }
        let count = corners.len();
        Self { polygon: walls.clone(), distances: vec![0.0; count], stretches: vec![1.0; count] }
    }

    /// Returns the maximum distance (m).
    pub(super) fn most(&self) -> f64 {
        self.distances.iter().copied().fold(0.0, f64::max)
    }
}

/// A corner of the walls; its index is that of the edge that begins there.
struct WallCorner {
    at: DVec2,
    moved: DVec2,
    /// Index of the previous edge, and of the corner at the end of this edge.
    before: usize,
    next: usize,
    /// Directions of the edges before and after the corner.
    ways: [DVec2; 2],
    /// Set if both edges must have the same distance.
    tied: bool,
}

impl WallCorner {
    fn all(walls: &Polygon, apart: impl Fn(usize) -> bool) -> Vec<Self> {
        let mut corners = Vec::with_capacity(walls.size());
        for ring in walls {
            let (first, count) = (corners.len(), ring.len());
            let way = |index: usize| (ring[(index + 1) % count] - ring[index % count]).normalize_or_zero();
            corners.extend((0..count).map(|index| {
                let ways = [way(index + count - 1), way(index)];
                let turn = ways[0].perp_dot(ways[1]);
                let (before, next) = (first + (index + count - 1) % count, first + (index + 1) % count);
                let tied = turn.abs() < STRAIGHT || (turn < 0.0 && !apart(before) && !apart(first + index));
                Self { at: ring[index], moved: ring[index], before, next, ways, tied }
            }));
        }
        corners
    }

    /// Returns the position of the corner after the edges move outwards.
    #[allow(clippy::float_cmp, reason = "equal distances are given as equal numbers")]
    fn place(&self, distances: &[f64], edge: usize) -> DVec2 {
        let ([a, b], [far, near]) = (self.ways, [distances[self.before], distances[edge]]);
        if far == near {
            self.at - (a + b).perp() * (near / (1.0 + a.dot(b)).max(BLUNT))
        } else {
            self.at + (a * near - b * far) / a.perp_dot(b)
        }
    }
}

/// Sets tied edges to the smaller of their distances.
#[allow(clippy::float_cmp, reason = "equal distances are given as equal numbers")]
fn level(corners: &[WallCorner], distances: &mut [f64]) {
    let mut changed = true;
    while changed {
        changed = false;
        let mut tie = |edge: usize| {
            let pair = [corners[edge].before, edge];
            let [a, b] = pair.map(|edge| distances[edge]);
            if corners[edge].tied && a != b {
                pair.into_iter().for_each(|edge| distances[edge] = a.min(b));
                changed = true;
            }
        };
        (0..corners.len()).for_each(&mut tie);
        (0..corners.len()).rev().for_each(&mut tie);
    }
}

/// Returns the factor of each edge's distance: 1, except for chamfers in reflex corners that would vanish
/// between their neighbours. These move farther, up to the point where their neighbours meet, so that the
/// corner keeps its distance.
fn stretches(corners: &[WallCorner], distances: &[f64]) -> Vec<f64> {
    let length = |edge: usize| corners[edge].at.distance(corners[corners[edge].next].at);
    // Loss of length while the neighbours move by 1 m, and gain of length while the edge itself does.
    let rates = |edge: usize| {
        let turns = [edge, corners[edge].next].map(|corner| {
            let [a, b] = corners[corner].ways;
            (a.perp_dot(b), a.dot(b))
        });
        let is_chamfer = corners[edge].tied
            && corners[corners[edge].next].tied
            && turns.iter().all(|&(sine, _)| sine <= -STRAIGHT);
        let sum =
            |of: fn(f64, f64) -> f64| turns.iter().map(|&(sine, cosine)| of(-sine, cosine)).sum::<f64>();
        is_chamfer.then(|| [sum(|sine, _| 1.0 / sine), sum(|sine, cosine| cosine / sine)])
    };
    let vanishes = |edge: usize| {
        let left = |[shorter, longer]: [f64; 2]| length(edge) - distances[edge] * (shorter - longer);
        rates(edge).filter(|rates| left(*rates) < length(edge).min(CHAMFER))
    };
    let stretch = |edge: usize| {
        let [shorter, longer] = vanishes(edge)?;
        let is_alone =
            [corners[edge].before, corners[edge].next].iter().all(|&beside| vanishes(beside).is_none());
        let lost = distances[edge] * shorter - length(edge) + length(edge).min(CHAMFER);
        let stretch = lost / (distances[edge] * longer);
        (is_alone && longer > 0.0 && stretch <= MOST_STRETCHED).then_some(stretch)
    };
    (0..corners.len()).map(|edge| stretch(edge).unwrap_or(1.0)).collect()
}

/// Returns the edges that take the space of a vanishing or reversed edge or of a corner that moves too far,
/// each with the feasible fraction of its distance.
fn shrink(corners: &[WallCorner], distances: &[f64]) -> Vec<(usize, f64)> {
    let mut factors = Vec::new();
    for (edge, corner) in corners.iter().enumerate() {
        let pair = [corner.before, edge];
        let most = pair.iter().map(|&edge| distances[edge]).fold(0.0, f64::max);
        if corner.at.distance(corner.moved) > FURTHEST * most + 1e-9 {
            factors.extend(pair.map(|edge| (edge, 0.0)));
        }
        let end = &corners[corner.next];
        let old = end.at - corner.at;
        // An edge that is short from the beginning may stay short, unless a roof would have slivers there.
        let least = if old.length() < SHORT { 1e-3 } else { 1e-3_f64.min(0.98 * old.length_squared()) };
        if old.dot(end.moved - corner.moved) > least {
            continue;
        }
        let (mut longer, mut shorter, mut guilty) = (0.0, 0.0, Vec::new());
        let mut add = |by: f64, edges: &[usize]| {
            if by < 0.0 {
                shorter -= by;
                guilty.extend_from_slice(edges);
            } else {
                longer += by;
            }
        };
        for (corner, other) in [(corner, corner.before), (end, corner.next)] {
            let [a, b] = corner.ways;
            let (sine, cosine) = (a.perp_dot(b), a.dot(b));
            if corner.tied {
                add(distances[edge] * sine / (1.0 + cosine).max(BLUNT), &[edge, other]);
            } else {
                add(distances[other] / sine, &[other]);
                add(-distances[edge] * cosine / sine, &[edge]);
            }
        }
        if guilty.is_empty() {
            guilty.extend([corner.before, edge, corner.next]);
        }
        let factor = ((KEPT * old.length() + longer) / shorter.max(1e-9)).min(0.95);
        factors.extend(guilty.into_iter().map(|edge| (edge, factor)));
    }
    factors
}

/// Returns the edges that meet others or nearly do, each with the feasible fraction of its distance.
fn crossing(corners: &[WallCorner], distances: &[f64]) -> Vec<(usize, f64)> {
    let ends = |edge: usize| [corners[edge].moved, corners[corners[edge].next].moved];
    let left = |edge: usize| ends(edge)[0].x.min(ends(edge)[1].x);
    let mut order: Vec<usize> = (0..corners.len()).collect();
    // Sweep from left to right: each edge is compared only with edges that begin before it ends.
    order.sort_by(|&a, &b| left(a).total_cmp(&left(b)));
    let mut factors = Vec::new();
    for (rank, &a) in order.iter().enumerate() {
        let ([from, to], neighbours) = (ends(a), [corners[a].before, corners[a].next]);
        let (low, high) = (from.min(to) - APART, from.max(to) + APART);
        for &b in order[rank + 1..].iter().take_while(|&&b| left(b) <= high.x) {
            let [c, d] = ends(b);
            if c.y.max(d.y) < low.y || c.y.min(d.y) > high.y || neighbours.contains(&b) {
                continue;
            }
            let both = distances[a] + distances[b];
            let meet = line_intersection(line([from, to]), line([c, d])).is_some();
            let gap_now = || gap([[from, to], [c, d]]);
            let facing = corners[a].ways[1].dot(corners[b].ways[1]) < -0.5;
            if !meet && (!facing || both == 0.0 || gap_now() > APART) {
                continue;
            }
            let gap = gap([a, b].map(|edge| [corners[edge].at, corners[corners[edge].next].at]));
            // Edges next to a short edge are close to each other from the beginning.
            if !meet && gap_now() > gap / 4.0 {
                continue;
            }
            if both > 0.0 {
                let factor = (KEPT * gap / both).clamp(0.0, 0.75);
                factors.extend([(a, factor), (b, factor)]);
            } else {
                // The neighbours of these edges have made them longer.
                let around = neighbours.into_iter().chain([corners[b].before, corners[b].next]);
                factors.extend(around.map(|edge| (edge, 0.5)));
            }
        }
    }
    factors
}

/// Returns the distance (m) between two edges that do not intersect.
fn gap([a, b]: [[DVec2; 2]; 2]) -> f64 {
    b.map(|at| distance(a, at)).into_iter().chain(a.map(|at| distance(b, at))).fold(f64::INFINITY, f64::min)
}

fn line(ends: [DVec2; 2]) -> geo::Line {
    let [start, end] = ends.map(coord);
    geo::Line::new(start, end)
}

/// Returns the moved corners as a polygon with the ring sizes of the walls; `None` if it is not valid.
fn move_walls(walls: &Polygon, corners: &[WallCorner]) -> Option<Polygon> {
    let mut rest = corners.iter().map(|corner| corner.moved);
    let rings = walls.iter().map(|ring| rest.by_ref().take(ring.len()).collect());
    Polygon::new(rings.collect::<Rings<DVec2>>()).ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_notch_that_is_all_but_filled_takes_the_overhang_of_its_own_edges_alone() {
        for width in [0.2, 0.05, 0.02, 0.016] {
            let notch = [(11.0, 12.0), (11.0, 9.0), (11.0 - width, 9.0), (11.0 - width, 12.0)];
            let ring: Vec<DVec2> = [&[(0.0, 0.0), (20.0, 0.0), (20.0, 12.0)], &notch[..], &[(0.0, 12.0)]]
                .concat()
                .into_iter()
                .map(DVec2::from)
                .collect();
            let walls = Polygon::new(vec![ring]).expect("a polygon");
            let outset = Outset::new(&walls, vec![0.4; 8], |_| false);
            for edge in [0, 1, 2, 6, 7] {
                assert_eq!(outset.distances[edge], 0.4, "edge {edge} of {width}: {:?}", outset.distances);
            }
        }
    }

    #[test]
    fn a_chamfer_in_a_reflex_corner_leaves_the_overhang_of_its_walls() {
        for length in [0.02, 0.05, 0.1, 0.3, 1.0] {
            let ring =
                [(0., 0.), (12., 0.), (12., 5.), (6. + length, 5.), (6., 5. + length), (6., 11.), (0., 11.)];
            let walls = Polygon::new(vec![ring.map(DVec2::from).to_vec()]).expect("a polygon");
            let outset = Outset::new(&walls, vec![0.5; 7], |_| false);
            assert_eq!(outset.distances, [0.5; 7], "{length}");
            let [from, to] = outset.polygon.edges().nth(3).expect("an edge");
            assert!(from.distance(to) > 0.015, "{length}: {from} {to}");
            assert!((from.y - 5.5).abs() < 1e-9 && (to.x - 6.5).abs() < 1e-9, "{length}: {from} {to}");
        }
    }
}
