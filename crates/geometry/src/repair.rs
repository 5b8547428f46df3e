//! Makes a plan of rings that cross or touch, from the area that they enclose.
//!
//! Method: set operations around the middle of the rings. Where the area that they enclose still touches itself, a notch as
//! wide as a hand is cut out there.

use glam::{DVec2, DVec3};
use rstar::primitives::{GeomWithData, Line};
use rstar::{AABB, PointDistance, RTree};

use super::outline::{OutlineOptions, is_ring, numbered_rings};
use super::overlay::{Area, Fill, fill, overlay, unite};
use super::planar::{Polygon, Rings, edges, foot, twice_area};
use super::ring::MOST;
use super::section::SectionPoint;
use burgeon_base::error::Result;

/// Half of the width (m) of the notch where a plan touches itself.
const NOTCH: f64 = 0.05;
/// The least area (m²) that matters.
const LEAST: f64 = 0.01;
/// How often notches are cut.
const ROUNDS: usize = 4;
/// How far (m) from an edge that was given what stands for it lies.
const ALONG: f64 = 0.02;

/// How often the edges of rings may meet, other than at their ends, for each of them, and in all where they are few.
const MEETINGS: usize = 8;
const FEW_MEETINGS: usize = 10_000;

/// What is said of a ring that crosses itself.
const LOOPS: &str = "loops of the outer ring left out";

/// Rings that became a plan.
pub(super) struct PlanRepair {
    pub polygon: Polygon<DVec3>,
    /// For each edge of all rings, the edges that were given and that it stands for.
    pub given: Vec<Vec<usize>>,
    /// What was done.
    pub notes: Vec<&'static str>,
}

/// The greatest part of what the first ring encloses without the others; `None` if nothing is left that is a plan, or
/// if the rings meet so often that they are none.
pub(super) fn repair(given: &Rings, manner: &OutlineOptions) -> Option<PlanRepair> {
    let known = |point: &DVec3| point.is_finite() && point.truncate().abs().max_element() <= MOST;
    if !given.iter().flatten().all(known) {
        return None;
    }
    let mut points = given.first()?.iter().map(|point| point.truncate());
    let first = points.next()?;
    let [low, high] = points.fold([first; 2], |[low, high], point| [low.min(point), high.max(point)]);
    let middle = low.midpoint(high);
    let local: Rings<DVec2> =
        given.iter().map(|ring| ring.iter().map(|point| point.truncate() - middle).collect()).collect();
    if meets_too_often(&local) {
        return None;
    }
    let mut notes = Vec::new();
    let mut area = enclosed(&local, &mut notes).ok()?;
    for _ in 0..ROUNDS {
        let whole = greatest(area, &mut notes)?;
        let rings = rings_of(&whole, manner);
        if let Some(clean) = cleaned(&rings, manner) {
            let done = finish(&clean, &local, given, middle);
            // What touches itself but for rounding may do so again where it was given.
            if let Some((polygon, given)) = done
                && cleaned(&Rings::from(&polygon.flat()), manner).is_some()
            {
                if notes.is_empty() {
                    notes.push("edges that cross or touch untangled");
                }
                return Some(PlanRepair { polygon, given, notes });
            }
        }
        let notches = notches(&rings);
        if notches.is_empty() {
            return None;
        }
        area = overlay(&[whole], &notches, |[inside, notch]| inside && !notch).ok()?;
        note(&mut notes, "a notch cut where it touches itself");
    }
    None
}

/// Whether the edges of rings meet more often than those of any outline that is meant: so often that what they enclose
/// would be many times as much as was given.
///
/// Edges are looked at from one side to the other, and not beyond the meetings that are allowed.
fn meets_too_often(rings: &Rings<DVec2>) -> bool {
    let mut edges: Vec<[DVec2; 2]> = rings.iter().flat_map(|ring| edges(ring)).collect();
    let length = edges.iter().fold(DVec2::ZERO, |sum, [a, b]| sum + (*b - *a).abs());
    if length.x > length.y {
        // Along the axis on which they cover each other less.
        edges.iter_mut().flatten().for_each(|point| *point = DVec2::new(point.y, point.x));
    }
    let low = |[a, b]: &[DVec2; 2]| a.min(*b);
    let high = |[a, b]: &[DVec2; 2]| a.max(*b);
    edges.sort_by(|a, b| low(a).x.total_cmp(&low(b).x));
    let mut left = FEW_MEETINGS.max(MEETINGS * edges.len());
    for (index, a) in edges.iter().enumerate() {
        for b in edges[index + 1..].iter().take_while(|b| low(b).x <= high(a).x) {
            if low(a).y > high(b).y || low(b).y > high(a).y {
                continue;
            }
            let side = |[from, to]: &[DVec2; 2], at: DVec2| (*to - *from).perp_dot(at - *from);
            let apart = |one: f64, two: f64| (one > 0.0 && two > 0.0) || (one < 0.0 && two < 0.0);
            let joined = b.iter().any(|end| a.contains(end));
            if joined || apart(side(a, b[0]), side(a, b[1])) || apart(side(b, a[0]), side(b, a[1])) {
                continue;
            }
            if left == 0 {
                return true;
            }
            left -= 1;
        }
    }
    false
}

/// The points of sound rings that are needed; `None` if the rings meet.
fn cleaned(rings: &Rings<DVec2>, manner: &OutlineOptions) -> Option<Polygon> {
    let sharp: Vec<Vec<SectionPoint>> =
        rings.iter().map(|ring| ring.iter().copied().map(SectionPoint::sharp).collect()).collect();
    let (outer, holes) = sharp.split_first()?;
    let clean = numbered_rings(outer, holes, manner).ok()?;
    let places = clean.iter().map(|ring| ring.iter().map(|point| point.point.at).collect());
    Polygon::new(places.collect::<Rings<DVec2>>()).ok()
}

fn note(notes: &mut Vec<&'static str>, what: &'static str) {
    if !notes.contains(&what) {
        notes.push(what);
    }
}

/// The area that the first ring encloses without the areas that the others enclose. Fails if the work of this thread is to
/// stop.
fn enclosed(rings: &Rings<DVec2>, notes: &mut Vec<&'static str>) -> Result<Area> {
    let whole = |ring: &Vec<DVec2>| fill(&[Rings(vec![ring.clone()])], Fill::NonZero);
    let Some((outer, holes)) = rings.split_first() else { return Ok(Area::new()) };
    let outer = whole(outer)?;
    if outer.len() > 1 {
        note(notes, LOOPS);
    }
    let mut cut = Area::new();
    for hole in holes {
        let hole = whole(hole)?;
        let size = size(&hole);
        if size <= 0.0 {
            note(notes, "a hole without area left out");
        } else if self::size(&overlay(&outer, &hole, |is_in| is_in == [true; 2])?) <= 1e-6 * size {
            note(notes, "a hole outside the outer ring left out");
        } else {
            cut.extend(hole);
        }
    }
    if cut.is_empty() {
        return Ok(outer);
    }
    let count = cut.len();
    let together = unite(cut)?;
    if together.len() < count {
        note(notes, "holes that touch merged");
    }
    let rest = overlay(&outer, &together, |[inside, hole]| inside && !hole)?;
    if rest.iter().map(|part| part.len() - 1).sum::<usize>() < together.len() {
        note(notes, "a hole at the outer ring cut out");
    }
    Ok(rest)
}

/// The size of an area (m²).
fn size(area: &[Rings<DVec2>]) -> f64 {
    area.iter().flat_map(|rings| rings.iter()).map(|ring| twice_area(ring.iter().copied()) / 2.0).sum()
}

/// The greatest of several areas.
fn greatest(areas: Area, notes: &mut Vec<&'static str>) -> Option<Rings<DVec2>> {
    let sized: Vec<(f64, Rings<DVec2>)> = areas
        .into_iter()
        .map(|part| (size(std::slice::from_ref(&part)), part))
        .filter(|(size, _)| *size > LEAST)
        .collect();
    if sized.len() > 1 && !notes.contains(&LOOPS) {
        note(notes, "the greatest part kept");
    }
    // Of equal ones the first.
    let greatest = sized.into_iter().reduce(|best, next| if next.0 > best.0 { next } else { best });
    greatest.map(|(_, part)| part)
}

/// The rings of a polygon, without holes that are none.
fn rings_of(polygon: &Rings<DVec2>, manner: &OutlineOptions) -> Rings<DVec2> {
    let is_sound = |ring: &Vec<DVec2>| {
        let sharp: Vec<SectionPoint> = ring.iter().copied().map(SectionPoint::sharp).collect();
        is_ring(&sharp, manner)
    };
    let rings = polygon.iter().enumerate();
    rings.filter(|(number, ring)| *number == 0 || is_sound(ring)).map(|(_, ring)| ring.clone()).collect()
}

type IndexedEdge = GeomWithData<Line<[f64; 2]>, usize>;

/// The edges of rings that have a length, by place, each with its number over all rings.
fn edge_tree(rings: &Rings<DVec2>) -> RTree<IndexedEdge> {
    let ends = rings.iter().flat_map(|ring| edges(ring));
    let lines = ends.enumerate().filter(|(_, [from, to])| from.distance_squared(*to) > 0.0);
    RTree::bulk_load(
        lines
            .map(|(number, [from, to])| GeomWithData::new(Line::new(from.to_array(), to.to_array()), number))
            .collect(),
    )
}

/// Squares around the points that lie on an edge which does not begin or end there.
fn notches(rings: &Rings<DVec2>) -> Area {
    let tree = edge_tree(rings);
    for near in [1e-6, 0.012] {
        let mut found = Vec::new();
        let mut number = 0;
        for ring in &**rings {
            for index in 0..ring.len() {
                let own = [number + index, number + (index + ring.len() - 1) % ring.len()];
                let at = ring[index];
                let around = AABB::from_corners((at - near).to_array(), (at + near).to_array());
                let touches = tree.locate_in_envelope_intersecting(&around).any(|edge| {
                    !own.contains(&edge.data) && edge.geom().distance_2(&at.to_array()) <= near * near
                });
                if touches {
                    let corners = [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)];
                    let corners = corners.map(|(x, y)| at + DVec2::new(x, y) * NOTCH);
                    found.push(Rings(vec![corners.to_vec()]));
                }
            }
            number += ring.len();
        }
        if !found.is_empty() {
            return found;
        }
    }
    Area::new()
}

/// The polygon with the heights of the ground, and for each edge those that were given; `None` if it is none there.
fn finish(
    clean: &Polygon,
    local: &Rings<DVec2>,
    rings: &Rings,
    middle: DVec2,
) -> Option<(Polygon<DVec3>, Vec<Vec<usize>>)> {
    let tree = edge_tree(local);
    let ends: Vec<[DVec3; 2]> = rings.iter().flat_map(|ring| edges(ring)).collect();
    let on_ground = |at: DVec2| {
        let Some(edge) = tree.nearest_neighbor(&at.to_array()) else { return at.extend(0.0) };
        let [from, to] = ends[edge.data];
        // What comes of a point that was given is that point.
        for given in [from, to] {
            if (given.truncate() - middle).distance(at) < 1e-4 {
                return given - middle.extend(0.0);
            }
        }
        let part = foot([from, to].map(|end| end.truncate() - middle), at);
        at.extend(from.z + (to.z - from.z) * part)
    };
    let mut given = Vec::new();
    for ring in clean {
        for [a, b] in ring.edges() {
            let low = (a.min(b) - ALONG).to_array();
            let around = AABB::from_corners(low, (a.max(b) + ALONG).to_array());
            let along = (b - a).normalize_or_zero();
            let mut stands_for: Vec<usize> = tree
                .locate_in_envelope_intersecting(&around)
                .filter(|edge| {
                    let [from, to] = [edge.geom().from, edge.geom().to].map(DVec2::from);
                    let beside = |point: DVec2| along.perp_dot(point - a).abs() <= ALONG;
                    let [one, two] = [from, to].map(|point| along.dot(point - a));
                    let shared = one.max(two).min(a.distance(b)) - one.min(two).max(0.0);
                    beside(from) && beside(to) && shared > ALONG
                })
                .map(|edge| edge.data)
                .collect();
            if stands_for.is_empty() {
                let nearest = tree.nearest_neighbor(&a.midpoint(b).to_array());
                stands_for.extend(nearest.map(|edge| edge.data));
            }
            stands_for.sort_unstable();
            given.push(stands_for);
        }
    }
    let rings = clean.iter().map(|ring| ring.iter().map(|at| on_ground(*at) + middle.extend(0.0)).collect());
    Some((Polygon::new(rings.collect::<Rings>()).ok()?, given))
}

#[cfg(test)]
mod tests {
    use glam::{DVec2, DVec3};
    use proptest::prelude::*;

    use super::super::{Plan, Rings};

    fn ring(points: &[[f64; 2]]) -> Vec<DVec3> {
        points.iter().map(|point| DVec3::new(point[0], point[1], 0.0)).collect()
    }

    fn made(rings: &[&[[f64; 2]]]) -> Plan {
        Plan::new(&rings.iter().map(|points| ring(points)).collect()).unwrap()
    }

    /// Whether a plan is one: nothing is left to be repaired, and areas and directions are right.
    fn assert_valid(plan: &Plan) {
        let again = Plan::new(&Rings::from(plan.polygon())).unwrap();
        assert_eq!(again.repairs().0, [""; 0]);
        assert!(plan.polygon().area() > 0.0 && plan.given_edges().len() == plan.polygon().size());
        assert!(plan.given_edges().iter().flatten().all(|&edge| edge < plan.given()));
        assert!(plan.polygon().points().all(|point| point.is_finite()));
    }

    const SQUARE: [[f64; 2]; 4] = [[0.0, 0.0], [10.0, 0.0], [10.0, 10.0], [0.0, 10.0]];

    #[test]
    fn of_an_hourglass_the_greater_half_is_kept_with_its_edges() {
        let plan = made(&[&[[0.0, 0.0], [6.0, 6.0], [0.0, 6.0], [2.0, 0.0]]]);
        assert_valid(&plan);
        assert!(plan.repairs().0.contains(&"loops of the outer ring left out"), "{:?}", plan.repairs());
        // The lower triangle has 2 m along y = 0, the upper one 6 m along y = 6: they meet at y = 1.5.
        assert!((plan.polygon().area() - 13.5).abs() < 1e-6, "{}", plan.polygon().area());
        let mut given: Vec<Vec<usize>> =
            plan.given_edges().into_iter().map(smallvec::SmallVec::into_vec).collect();
        given.sort();
        assert_eq!(given, [vec![0], vec![1], vec![2]]);
    }

    #[test]
    fn holes_outside_are_dropped_and_those_that_overlap_are_merged() {
        let hole = |x: f64, y: f64| [[x, y], [x + 2.0, y], [x + 2.0, y + 2.0], [x, y + 2.0]];
        let outside = made(&[&SQUARE, &hole(20.0, 1.0)]);
        assert_eq!(outside.repairs().0, ["a hole outside the outer ring left out"]);
        assert_eq!((outside.polygon().area(), outside.polygon().size()), (100.0, 4));
        let merged = made(&[&SQUARE, &hole(2.0, 2.0), &hole(3.0, 3.0)]);
        assert_eq!(merged.repairs().0, ["holes that touch merged"]);
        assert!((merged.polygon().area() - 93.0).abs() < 1e-6 && merged.polygon().len() == 2);
        let beside = made(&[&SQUARE, &hole(2.0, 2.0), &hole(4.0, 2.0)]);
        assert!((beside.polygon().area() - 92.0).abs() < 1e-6 && beside.polygon().len() == 2);
        let across = made(&[&SQUARE, &hole(-1.0, 2.0)]);
        assert_eq!(across.repairs().0, ["a hole at the outer ring cut out"]);
        assert!((across.polygon().area() - 98.0).abs() < 1e-6 && across.polygon().len() == 1);
        [outside, merged, beside, across].iter().for_each(assert_valid);
    }

    #[test]
    fn where_a_plan_touches_itself_at_a_point_a_notch_is_cut() {
        let tip = made(&[&SQUARE, &[[0.0, 5.0], [3.0, 4.0], [3.0, 6.0]]]);
        assert_valid(&tip);
        assert!(
            (tip.polygon().area() - 97.0).abs() < 0.02 && tip.polygon().len() == 1,
            "{}",
            tip.polygon().area()
        );
        let corners =
            made(&[&SQUARE, &[[2.0, 2.0], [4.0, 4.0], [2.0, 4.0]], &[[4.0, 4.0], [6.0, 4.0], [6.0, 6.0]]]);
        assert_valid(&corners);
        assert!(
            (corners.polygon().area() - 96.0).abs() < 0.03 && corners.polygon().len() == 2,
            "{}",
            corners.polygon().area()
        );
    }

    #[test]
    fn heights_of_the_ground_are_kept_and_found_between() {
        let points = [[0.0, 0.0, 1.0], [6.0, 6.0, 7.0], [0.0, 6.0, 3.0], [2.0, 0.0, 1.0]];
        let plan = Plan::new(&Rings(vec![points.map(DVec3::from).to_vec()])).unwrap();
        let at = |x: f64, y: f64| {
            let near = |point: &&DVec3| point.truncate().distance(DVec2::new(x, y)) < 1e-3;
            plan.polygon()[0].iter().find(near).map(|point| point.z)
        };
        assert_eq!((at(6.0, 6.0), at(0.0, 6.0)), (Some(7.0), Some(3.0)));
        assert!((at(1.5, 1.5).unwrap() - 2.5).abs() < 1e-6 || (at(1.5, 1.5).unwrap() - 1.5).abs() < 1e-6);
    }

    #[test]
    fn what_encloses_nothing_is_refused() {
        let refused = |rings: &[&[[f64; 2]]]| {
            Plan::new(&rings.iter().map(|points| ring(points)).collect()).unwrap_err()
        };
        assert!(refused(&[&[[0.0, 0.0], [5.0, 5.0]]]).message().contains("2 distinct points"));
        assert!(refused(&[&[[0.0, 0.0], [4.0, 0.0], [8.0, 0.0]]]).message().contains("no area"));
        let all = [[-1.0, -1.0], [11.0, -1.0], [11.0, 11.0], [-1.0, 11.0]];
        assert!(refused(&[&SQUARE, &all]).message().contains("hole 1"));
    }

    #[test]
    fn a_plan_that_a_hole_divides_but_for_rounding_is_divided() {
        let plan =
            made(&[&[[-0.14, 0.29], [0.28, 0.26], [0.0, 0.0]], &[[0.14, 0.27], [0.1, 0.0], [-0.11, -0.23]]]);
        assert_valid(&plan);
        assert_eq!(plan.repairs().0, ["a hole at the outer ring cut out", "the greatest part kept"]);
    }

    #[test]
    fn scribbles_take_no_longer_than_outlines() {
        let around = |count: usize, place: &dyn Fn(f64) -> DVec2| -> Vec<DVec3> {
            (0..count).map(|at| place(at as f64).extend(0.0)).collect()
        };
        let mut shapes: Vec<Vec<DVec3>> = Vec::new();
        for count in [300, 3001, 10_000] {
            let size = count as f64;
            // A star of which each edge crosses nearly all others, random places, a comb that lies on itself, circles
            // that go around again and again, and a flower of many small loops.
            shapes.push(around(count, &|at| {
                DVec2::from_angle(at * std::f64::consts::PI * (1.0 + 1.0 / size)) * 20.0
            }));
            shapes.push(around(count, &|at| {
                DVec2::new((at * 78.233).sin() * 50.0, (at * 12.9898).cos() * 50.0)
            }));
            shapes.push(around(count, &|at| DVec2::new(at % 2.0 * 30.0, (at * 0.25).floor() % 3.0)));
            shapes.push(around(count, &|at| DVec2::from_angle(at * 0.1) * 30.0));
            shapes.push(around(count, &|at| {
                let turn = at / size * std::f64::consts::TAU;
                DVec2::from_angle(turn) * 200.0 + DVec2::from_angle(turn * size / 12.0) * 2.0
            }));
        }
        let mut made = 0;
        for shape in &shapes {
            let begin = std::time::Instant::now();
            let plan = Plan::new(&Rings(vec![shape.clone()]));
            assert!(begin.elapsed().as_secs_f64() < 10.0, "{} points: {:?}", shape.len(), begin.elapsed());
            if let Ok(plan) = plan {
                assert_valid(&plan);
                made += 1;
            }
        }
        assert!(made > 0 && made < shapes.len(), "{made}");
    }

    proptest! {
        #![proptest_config(ProptestConfig { failure_persistence: None, cases: 400, ..ProptestConfig::default() })]

        #[test]
        fn random_rings_give_a_valid_plan_or_an_error(
            rings in prop::collection::vec(prop::collection::vec((-30i32..30, -30i32..30), 0..14), 1..4),
            scale in prop::sample::select(vec![0.01, 0.5, 1.0, 1e3]),
            far in prop::sample::select(vec![0.0, 6.6e6]),
        ) {
            let point = |&(x, y): &(i32, i32)| {
                DVec3::new(f64::from(x) * scale + far, f64::from(y) * scale, f64::from(x + y))
            };
            let rings: Rings =
                rings.iter().map(|ring| ring.iter().map(point).collect()).collect();
            if let Ok(plan) = Plan::new(&rings) {
                let again = Plan::new(&plan.polygon().into());
                prop_assert!(again.as_ref().is_ok_and(|again| again.repairs().0.is_empty()), "{again:?}");
                prop_assert!(plan.polygon().area() > 0.0);
                prop_assert!(plan.given_edges().iter().flatten().all(|&edge| edge < plan.given()));
            }
        }
    }
}
