//! Simplification of rings, measured against the input ring.

use glam::DVec2;

use crate::planar::{self, Point, distance};

/// Returns the indices of the points of `ring` to keep, in order.
///
/// Every dropped point is within `tolerance` (m) of the edge that replaces it, and every point of that edge
/// is as close to the input ring.
///
/// Returns fewer than three indices if the ring is nowhere wider than `tolerance`. Each point is compared
/// with the input ring and never with an earlier result, so dense rings do not drift.
///
/// Method: D. Douglas and T. Peucker, "Algorithms for the reduction of the number of points required to
/// represent a digitized line or its caricature", 1973, on the two chains between the point farthest from the
/// centre and the point farthest from that point.
pub(super) fn corners<P: Point>(ring: &[P], tolerance: f64) -> Vec<usize> {
    let count = ring.len();
    if count < 3 {
        return (0..count).collect();
    }
    let at = |place: usize| ring[place % count].flat();
    let bounds = (1..count).fold([at(0); 2], |[low, high], place| [low.min(at(place)), high.max(at(place))]);
    let farthest = |from: DVec2| {
        let far = |place: usize| (at(place).distance_squared(from), place);
        (0..count).map(far).reduce(|best, next| if next.0 > best.0 { next } else { best })
    };
    let Some((_, first)) = farthest(bounds[0].midpoint(bounds[1])) else { return Vec::new() };
    let Some((_, second)) = farthest(at(first)) else { return Vec::new() };
    let mut kept = Vec::new();
    for (from, to) in [(first, second), (second, first)] {
        let steps = (to + count - from) % count;
        let line: Vec<DVec2> = (0..=steps).map(|step| at(from + step)).collect();
        let stays = planar::kept(&line, tolerance, |point, way| distance(way, point));
        kept.extend((0..steps).filter(|step| stays[*step]).map(|step| (from + step) % count));
    }
    // The two ends of the chains may be collinear with their neighbours.
    for end in [first, second] {
        let Some(index) = kept.iter().position(|place| *place == end).filter(|_| kept.len() > 3) else {
            continue;
        };
        let beside = |by: usize| kept[(index + kept.len() + by - 1) % kept.len()];
        let (before, after) = (beside(0), beside(2));
        let way = [at(before), at(after)];
        let between = (after + count - before) % count;
        if (1..between).all(|step| distance(way, at(before + step)) <= tolerance) {
            kept.remove(index);
        }
    }
    kept.sort_unstable();
    kept
}

#[cfg(test)]
mod tests {
    use std::f64::consts::TAU;

    use rustc_hash::FxHashMap;

    use super::*;
    use crate::skeleton::samples::Random;
    use crate::{Plan, Rings};

    const TOLERANCE: f64 = 2e-3;

    /// Returns `count`, multiplied by the environment variable `BURGEON_CASES` if it is set.
    fn cases(count: usize) -> usize {
        count * std::env::var("BURGEON_CASES").ok().and_then(|times| times.parse().ok()).unwrap_or(1)
    }

    /// Returns the maximum distance (m) of points along `ring` from the edges of `other`; infinite beyond 1
    /// m.
    #[allow(clippy::cast_possible_truncation, reason = "places of a plan")]
    fn off(ring: &[DVec2], other: &[DVec2]) -> f64 {
        let cell = |at: DVec2| [at.x.floor() as i64, at.y.floor() as i64];
        let mut cells: FxHashMap<[i64; 2], Vec<[DVec2; 2]>> = FxHashMap::default();
        for edge in planar::edges(other) {
            let [from, to] = [cell(edge[0].min(edge[1]) - 0.1), cell(edge[0].max(edge[1]) + 0.1)];
            for (x, y) in (from[0]..=to[0]).flat_map(|x| (from[1]..=to[1]).map(move |y| (x, y))) {
                cells.entry([x, y]).or_default().push(edge);
            }
        }
        let nearest = |at: DVec2| {
            let near = cells.get(&cell(at)).into_iter().flatten();
            near.map(|edge| distance(*edge, at)).fold(f64::INFINITY, f64::min)
        };
        planar::edges(ring)
            .flat_map(|[a, b]| [a, a.lerp(b, 0.5), a.lerp(b, 0.25)])
            .map(nearest)
            .fold(0.0, f64::max)
    }

    fn around(count: usize, place: impl Fn(f64) -> DVec2) -> Vec<DVec2> {
        (0..count).map(|index| place(index as f64 / count as f64)).collect()
    }

    /// Divides the edges of a ring into steps of at most `step` (m), and moves each new point by up to
    /// `noise` (m).
    fn dense(ring: &[DVec2], step: f64, noise: f64, random: &mut Random) -> Vec<DVec2> {
        let mut points = Vec::new();
        for [a, b] in planar::edges(ring) {
            let count = (a.distance(b) / step).ceil().max(1.0) as usize;
            for index in 0..count {
                let angle = TAU * random.next();
                let by = if index == 0 { 0.0 } else { noise * random.next() };
                points.push(a.lerp(b, index as f64 / count as f64) + DVec2::from_angle(angle) * by);
            }
        }
        points
    }

    /// Returns dense rings of a shape chosen by `round`.
    fn samples(round: usize, random: &mut Random) -> Vec<Vec<DVec2>> {
        let mut between = |from: f64, to: f64| from + (to - from) * random.next();
        let turn = DVec2::from_angle(between(0.0, TAU));
        let far = DVec2::new(between(-1e4, 1e4), between(-1e4, 1e4));
        let count = between(200.0, 9000.0) as usize;
        let radius = between(3.0, 40.0);
        let lobes = between(2.0, 9.0).floor();
        let noise = between(0.0, 1.5e-3);
        let step = between(0.003, 0.08);
        let rings = match round % 6 {
            0 => vec![around(count, |part| DVec2::from_angle(part * TAU) * radius)],
            1 => vec![around(count, |part| {
                DVec2::from_angle(part * TAU) * radius * (1.0 + 0.2 * (lobes * part * TAU).sin())
            })],
            2 => {
                // A spiral wall: out on one side and back on the other.
                let turns = lobes / 2.0;
                let at = |part: f64, aside: f64| {
                    DVec2::from_angle(part * turns * TAU) * (3.0 + part * turns * 4.0 + aside)
                };
                let mut ring = around(count / 2, |part| at(part, 1.0));
                ring.extend(around(count / 2, |part| at(1.0 - part, 0.0)));
                vec![ring]
            }
            3 => {
                let outer = [(0., 0.), (20., 0.), (20., 14.), (9., 14.), (9., 8.), (0., 8.)].map(DVec2::from);
                vec![dense(&outer, step.max(0.02), noise, random)]
            }
            4 => {
                let outer = around(count, |part| DVec2::from_angle(part * TAU) * radius);
                let inner = around(count / 2, |part| DVec2::from_angle(-part * TAU) * radius * 0.6);
                vec![outer, inner]
            }
            _ => {
                let outer = [(0., 0.), (30., 0.), (30., 18.), (0., 18.)].map(DVec2::from);
                let inner = [(8., 5.), (8., 12.), (21., 12.), (21., 5.)].map(DVec2::from);
                vec![dense(&outer, 0.02, noise, random), dense(&inner, 0.02, noise, random)]
            }
        };
        rings.into_iter().map(|ring| ring.into_iter().map(|at| turn.rotate(at) + far).collect()).collect()
    }

    #[test]
    fn dense_outlines_stay_within_the_tolerance_of_what_was_given() {
        let mut random = Random(11);
        let (mut count, mut worst, mut kept, mut given) = (0, 0f64, 0, 0);
        let cases = cases(180);
        for round in 0..cases {
            let rings = samples(round, &mut random);
            let raised: Rings =
                rings.iter().map(|ring| ring.iter().map(|at| at.extend(0.0)).collect()).collect();
            let plan = Plan::new(&raised).unwrap_or_else(|error| panic!("{round}: {error}"));
            assert_eq!(plan.repairs().0, [""; 0], "{round}: {}", plan.repairs().1);
            let flat = plan.flat();
            assert_eq!(flat.len(), rings.len());
            for (ring, found) in rings.iter().zip(&flat) {
                let far = off(ring, found).max(off(found, ring));
                worst = worst.max(far);
                assert!(far <= TOLERANCE + 1e-9, "{round}: {far} m off, {} of {}", found.len(), ring.len());
                let [area, size] = [planar::twice_area(ring.iter().copied()) / 2.0, found.area()];
                assert!(
                    (area.abs() - size.abs()).abs() <= TOLERANCE * found.length(),
                    "{round}: {area} {size}"
                );
                (kept, given) = (kept + found.len(), given + ring.len());
            }
            count += 1;
        }
        assert_eq!(count, cases);
        assert!(kept * 4 < given && worst > 1e-3, "{kept} of {given}, {worst} m");
    }

    #[test]
    fn noise_above_the_tolerance_moves_outlines_by_a_centimetre_at_most() {
        let mut random = Random(5);
        for round in 0..60 {
            let outer = [(0., 0.), (20., 0.), (20., 14.), (9., 14.), (9., 8.), (0., 8.)].map(DVec2::from);
            let noise = [3e-3, 6e-3, 9e-3][round % 3];
            let ring = dense(&outer, [0.012, 0.03][round % 2], noise, &mut random);
            let raised = Rings(vec![ring.iter().map(|at| at.extend(0.0)).collect()]);
            let plan = Plan::new(&raised).unwrap_or_else(|error| panic!("{round}: {error}"));
            if !plan.repairs().0.is_empty() {
                continue;
            }
            let flat = plan.flat();
            let far = off(&ring, &flat[0]).max(off(&flat[0], &ring));
            assert!(far <= 0.012, "{round}: {far} m");
        }
    }

    #[test]
    fn points_on_straight_walls_are_dropped_wherever_the_ring_begins() {
        let wall = [(0., 0.), (5., 0.0), (10., 0.), (10., 3.), (10., 6.), (4., 6.001), (0., 6.), (0., 3.)];
        let wall = wall.map(DVec2::from);
        for first in 0..wall.len() {
            let mut ring = wall.to_vec();
            ring.rotate_left(first);
            let mut kept: Vec<usize> =
                corners(&ring, TOLERANCE).into_iter().map(|place| (place + first) % wall.len()).collect();
            kept.sort_unstable();
            assert_eq!(kept, [0, 2, 4, 6], "{first}");
        }
        assert!(corners(&wall[..3], TOLERANCE).len() < 3);
    }
}
