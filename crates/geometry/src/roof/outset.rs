//! The outline of a roof: that of the walls, moved outwards over each edge as far as there is room.

use geo::line_intersection::line_intersection;
use glam::DVec2;

use crate::planar::{Polygon, Rings, coord, distance};

/// An outline, and how far (m) it is from the walls over each edge.
#[derive(Debug, Clone, Default)]
pub(super) struct Outset {
    pub polygon: Polygon,
    pub distances: Vec<f64>,
    /// How many times its distance an edge is away, at a chamfer that others would pass by.
    pub stretches: Vec<f64>,
}

/// What part is used of the room that there is before an edge of the outline vanishes, as in a narrow recess.
const KEPT: f64 = 0.9;
/// An edge that is shorter (m) is not let become shorter still.
const SHORT: f64 = 0.015;
/// Edges that meet at an angle with a smaller sine than this are in one line, or lie on each other.
const STRAIGHT: f64 = 0.02;
/// A corner goes no further from that of the walls than by so many times the distance of its edges.
const FURTHEST: f64 = 6.5;
/// What is left of one plus the cosine of the turn at a sharp tip, so that it does not go far.
const BLUNT: f64 = 0.05;
/// Edges of an outline are so far (m) apart, so that they can be told apart.
const APART: f64 = 0.01;
/// Distances below this (m) are none.
const LEAST: f64 = 0.01;
/// What is left (m) of a chamfer in a reflex corner, at most, where those beside it would pass it by.
const CHAMFER: f64 = 0.035;
/// No chamfer is further away than so many times its distance.
const MOST_STRETCHED: f64 = 2.0;
/// How often distances become smaller, before there are none.
const ROUNDS: usize = 200;

impl Outset {
    /// The rings with each edge moved outwards by the distance (m) that is `wanted`, or by less where there is no room:
    /// only the edges give way that would vanish or meet others, and those that go with them.
    ///
    /// Edges that meet in a reflex corner are as far out
    /// as one another, so that neither ends at the other's wall, unless one is a gable `apart`; so are edges in one line.
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
            let mut factors = shrunk(&corners, &distances);
            if factors.is_empty() {
                factors = crossing(&corners, &distances);
            }
            if factors.is_empty() {
                let Some(polygon) = moved(walls, &corners) else { break };
                return Self { polygon, distances, stretches };
            }
            // What comes near to a limit ever more slowly reaches it.
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

    /// The greatest distance (m).
    pub(super) fn most(&self) -> f64 {
        self.distances.iter().copied().fold(0.0, f64::max)
    }
}

/// A corner of the walls, with the number of the edge that begins there.
struct WallCorner {
    at: DVec2,
    moved: DVec2,
    /// The number of the edge before it, and of the corner where its edge ends.
    before: usize,
    next: usize,
    /// The directions of the edges before and after it.
    ways: [DVec2; 2],
    /// Whether both edges have one distance.
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

    /// Where it goes when the edges move outwards.
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

/// Gives edges that are tied the lesser of their distances.
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

/// How many times its distance each edge goes: once, but for chamfers in reflex corners that would vanish between those
/// beside them. These go on with what meets beyond them, so that it keeps its distance.
fn stretches(corners: &[WallCorner], distances: &[f64]) -> Vec<f64> {
    let length = |edge: usize| corners[edge].at.distance(corners[corners[edge].next].at);
    // How much shorter it becomes while those beside it move by 1 m, and how much longer while it does so itself.
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

/// The edges that take the room of one that vanishes or turns around, or of a corner that goes too far, each with the
/// part of its distance that there is room for.
fn shrunk(corners: &[WallCorner], distances: &[f64]) -> Vec<(usize, f64)> {
    let mut factors = Vec::new();
    for (edge, corner) in corners.iter().enumerate() {
        let pair = [corner.before, edge];
        let most = pair.iter().map(|&edge| distances[edge]).fold(0.0, f64::max);
        if corner.at.distance(corner.moved) > FURTHEST * most + 1e-9 {
            factors.extend(pair.map(|edge| (edge, 0.0)));
        }
        let end = &corners[corner.next];
        let old = end.at - corner.at;
        // What is short from the beginning may stay so, unless it is so short that a roof has slivers there.
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

/// The edges that meet others or almost do, each with the part of its distance that there is room for.
fn crossing(corners: &[WallCorner], distances: &[f64]) -> Vec<(usize, f64)> {
    let ends = |edge: usize| [corners[edge].moved, corners[corners[edge].next].moved];
    let left = |edge: usize| ends(edge)[0].x.min(ends(edge)[1].x);
    let mut order: Vec<usize> = (0..corners.len()).collect();
    // From left to right, so that each edge meets only those that begin before it ends.
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
            // Beside a short edge others are near to each other from the beginning.
            if !meet && gap_now() > gap / 4.0 {
                continue;
            }
            if both > 0.0 {
                let factor = (KEPT * gap / both).clamp(0.0, 0.75);
                factors.extend([(a, factor), (b, factor)]);
            } else {
                // Their neighbours have made them longer.
                let around = neighbours.into_iter().chain([corners[b].before, corners[b].next]);
                factors.extend(around.map(|edge| (edge, 0.5)));
            }
        }
    }
    factors
}

/// How far (m) two edges are from each other that do not meet.
fn gap([a, b]: [[DVec2; 2]; 2]) -> f64 {
    b.map(|at| distance(a, at)).into_iter().chain(a.map(|at| distance(b, at))).fold(f64::INFINITY, f64::min)
}

fn line(ends: [DVec2; 2]) -> geo::Line {
    let [start, end] = ends.map(coord);
    geo::Line::new(start, end)
}

/// The corners where they have moved, in rings of the same sizes as those of the walls, if these are a polygon.
fn moved(walls: &Polygon, corners: &[WallCorner]) -> Option<Polygon> {
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
