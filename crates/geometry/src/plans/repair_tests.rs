//! Tests of repaired plans.

use glam::{DVec2, DVec3};
use proptest::prelude::*;

use crate::{Plan, Rings};

fn ring(points: &[[f64; 2]]) -> Vec<DVec3> {
    points.iter().map(|point| DVec3::new(point[0], point[1], 0.0)).collect()
}

fn made(rings: &[&[[f64; 2]]]) -> Plan {
    Plan::new(&rings.iter().map(|points| ring(points)).collect()).unwrap()
}

/// Asserts that a plan is valid: it needs no further repair, and its areas and directions are right.
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
    assert!(plan.repairs().0.contains(&"loops of the outer ring removed"), "{:?}", plan.repairs());
    // The lower triangle has 2 m along y = 0 and the upper triangle has 6 m along y = 6, so they meet at y =
    // 1.5.
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
    assert_eq!(outside.repairs().0, ["a hole outside the outer ring removed"]);
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
    let refused =
        |rings: &[&[[f64; 2]]]| Plan::new(&rings.iter().map(|points| ring(points)).collect()).unwrap_err();
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
    assert_eq!(plan.repairs().0, ["a hole at the outer ring cut out", "the largest part kept"]);
}

#[test]
fn scribbles_take_no_longer_than_outlines() {
    let around = |count: usize, place: &dyn Fn(f64) -> DVec2| -> Vec<DVec3> {
        (0..count).map(|at| place(at as f64).extend(0.0)).collect()
    };
    let mut shapes: Vec<Vec<DVec3>> = Vec::new();
    for count in [300, 3001, 10_000] {
        let size = count as f64;
        // A star in which each edge crosses nearly all others, random positions, a comb with overlapping
        // edges, circles that are traced repeatedly, and a flower of many small loops.
        shapes.push(around(count, &|at| {
            DVec2::from_angle(at * std::f64::consts::PI * (1.0 + 1.0 / size)) * 20.0
        }));
        shapes.push(around(count, &|at| DVec2::new((at * 78.233).sin() * 50.0, (at * 12.9898).cos() * 50.0)));
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
