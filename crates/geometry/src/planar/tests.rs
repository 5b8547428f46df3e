//! Tests of plane shapes: invariants hold for any input, and conversions to `geo` and back are exact.

use geo::LineString;
use glam::{DVec2, DVec3};
use proptest::prelude::*;

use super::*;

/// Returns points on few coordinates, so that repeated points, collinear points and self-crossing rings are
/// frequent.
fn points() -> impl Strategy<Value = Vec<DVec3>> {
    let number = prop::sample::select(vec![-2.0, 0.0, 0.1, 1.0, 1e6]);
    let height = prop::sample::select(vec![0.0, 0.0, 3.0, f64::NAN]);
    let point =
        (number.clone(), number, prop::sample::select(vec![0.0, 1.0]), prop::bool::weighted(0.02), height);
    let point = point.prop_map(|(x, y, z, wild, height)| DVec3::new(x, y, if wild { height } else { z }));
    prop::collection::vec(point, 0..9)
}

fn flat(points: &[DVec3]) -> Vec<DVec2> {
    points.iter().map(|point| point.truncate()).collect()
}

fn is_line(points: &[impl Point]) -> bool {
    let finite = points.iter().all(|point| point.is_finite());
    points.len() >= 2 && finite && points.windows(2).all(|pair| pair[0] != pair[1])
}

fn is_ring(points: &[impl Point]) -> bool {
    points.len() >= 3 && is_line(points) && points.first() != points.last()
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 1000, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn lines_and_rings_are_made_of_what_keeps_their_promises_and_of_nothing_else(points in points()) {
        prop_assert_eq!(Line::new(points.clone()).is_ok(), is_line(&points));
        prop_assert_eq!(Ring::new(points.clone()).is_ok(), is_ring(&points));
        prop_assert_eq!(Ring::new(flat(&points)).is_ok(), is_ring(&flat(&points)));
        if let Some(line) = Line::without_repeats(points.clone()) {
            prop_assert!(is_line(&line));
        }
        if let Some(ring) = Ring::without_repeats(points.clone()) {
            prop_assert!(is_ring(&ring) && is_line(&ring.around()));
            prop_assert_eq!(ring.around().len(), ring.len() + 1);
            let sum = ring.area() + ring.clone().reversed().area();
            prop_assert!(sum.abs() <= 1e-12 * ring.length().powi(2));
            prop_assert_eq!(ring.clone().turned().reversed()[ring.len() - 1], ring[0]);
            prop_assert_eq!(ring.edges().count(), ring.len());
        }
    }

    #[test]
    fn polygons_turn_as_they_are_to_and_what_is_refused_says_how_to_mend_it(
        rings in prop::collection::vec(points(), 0..4),
    ) {
        for made in [Polygon::new(rings.clone()), Polygon::turned(rings.clone())] {
            match made {
                Ok(polygon) => {
                    for (index, ring) in polygon.iter().enumerate() {
                        prop_assert!(is_ring(ring) && is_ring(&flat(ring)));
                        let is_outer = index == 0;
                        prop_assert!(ring.area() != 0.0 && ring.is_counter_clockwise() == is_outer);
                    }
                    prop_assert_eq!(Rings::from(&polygon).len(), rings.len());
                    prop_assert_eq!(Polygon::new(&polygon).ok(), Some(polygon.clone()));
                    prop_assert_eq!(polygon.size(), polygon.edges().count());
                    prop_assert_eq!(polygon.flat().area(), polygon.area());
                    let below = polygon.from_below();
                    prop_assert!(below.first().is_none_or(|outer| !outer.is_counter_clockwise()));
                }
                Err(error) => prop_assert!(error.remedy().is_some(), "{error}"),
            }
        }
    }

    #[test]
    fn shapes_come_back_from_geo_as_they_were(rings in prop::collection::vec(points(), 1..4)) {
        for points in &rings {
            if let Ok(line) = Line::new(flat(points)) {
                prop_assert_eq!(Line::try_from(&LineString::from(&line)).ok(), Some(line));
            }
            if let Ok(ring) = Ring::new(flat(points)) {
                let there = LineString::from(&ring);
                prop_assert!(there.is_closed());
                prop_assert_eq!(Ring::try_from(&there).ok(), Some(ring));
            }
        }
        let rings: Rings<DVec2> = rings.iter().map(|points| flat(points)).collect();
        if let Ok(polygon) = Polygon::turned(rings) {
            let there = geo::Polygon::from(&polygon);
            prop_assert_eq!(Rings::from(&there), Rings::from(&polygon));
            prop_assert_eq!(Polygon::try_from(&there).ok(), Some(polygon));
        }
    }

    #[test]
    fn a_hull_is_convex_and_holds_all_of_its_points(points in points()) {
        let points = flat(&points);
        let Some(hull) = hull(points.iter().copied()) else { return Ok(()) };
        prop_assert!(hull.is_counter_clockwise());
        for [a, b] in hull.edges() {
            prop_assert!(points.iter().all(|&point| orientation(a, b, point) != geo::Orientation::Clockwise));
        }
        prop_assert!(hull.iter().all(|corner| points.contains(corner) && hull[0].x <= corner.x));
    }

    #[test]
    fn a_place_is_inside_a_ring_where_it_is_inside_its_triangles(
        at in (-50i32..50, -50i32..50), corners in prop::collection::vec(2.0..40.0f64, 3..12),
    ) {
        // A star-shaped polygon: each corner is visible from the origin.
        let angle = |index: usize| std::f64::consts::TAU * index as f64 / corners.len() as f64;
        let place = |(index, far): (usize, &f64)| DVec2::from_angle(angle(index)) * *far;
        let star = Polygon::new(vec![corners.iter().enumerate().map(place).collect()]).expect("a star");
        let at = DVec2::new(f64::from(at.0) + 0.5, f64::from(at.1) + 0.25);
        let sides = star.edges().map(|[a, b]| {
            [(b - a).perp_dot(at - a), a.perp_dot(at), -b.perp_dot(at)].iter().all(|side| *side > 0.0)
        });
        prop_assert_eq!(star.contains(at), sides.clone().any(|inside| inside));
        prop_assert_eq!(star[0].clone().reversed().contains(at), star.contains(at));
    }
}

#[test]
fn what_breaks_a_promise_is_named_with_what_to_do() {
    let ring = |points: &[(f64, f64)]| points.iter().copied().map(DVec2::from).collect::<Vec<_>>();
    let square = [(0., 0.), (4., 0.), (4., 4.), (0., 4.)];
    let refused = |rings: &[&[(f64, f64)]]| {
        let rings: Rings<DVec2> = rings.iter().map(|points| ring(points)).collect();
        Polygon::new(rings).expect_err("no polygon").to_string()
    };
    insta::assert_snapshot!(Line::new(ring(&[(1., 2.)])).expect_err("a point"), @r"
    the line has too few points: 1
      help: give at least 2 distinct points
    ");
    insta::assert_snapshot!(Ring::new(ring(&square[..2])).expect_err("a line"), @r"
    the ring has too few points: 2
      help: give at least 3 points that differ
    ");
    insta::assert_snapshot!(Ring::new(ring(&[(0., 0.), (4., 0.), (4., 0.), (0., 4.)])).expect_err("repeated"), @r"
    point 3 of the ring repeats point 2, (4, 0)
      help: remove one of them
    ");
    insta::assert_snapshot!(refused(&[&[(0., 0.), (4., 0.), (f64::NAN, 1.)]]), @r"
    point 3 of the outer ring is (NaN, 1)
      help: give finite coordinates in metres
    ");
    insta::assert_snapshot!(refused(&[&[(0., 0.), (4., 0.), (4., 4.), (0., 0.)]]), @r"
    the last point of the outer ring, 4, repeats point 1, (0, 0)
      help: remove it: a ring closes automatically
    ");
    insta::assert_snapshot!(refused(&[&square, &[(1., 1.), (2., 1.), (2., 2.)]]), @r"
    hole 1 of the polygon is counter-clockwise
      help: an outer ring is counter-clockwise, and a hole is clockwise: reverse it
    ");
    insta::assert_snapshot!(refused(&[&[(0., 0.), (1., 1.), (2., 2.)]]), @r"
    the outer ring of the polygon has no area
      help: move a point off the line of the others
    ");
    let upright = [(0., 0.), (4., 0.), (4., 3.), (0., 3.)].map(|(x, z)| DVec3::new(x, 0.0, z));
    assert!(Ring::new(upright.to_vec()).is_ok());
    insta::assert_snapshot!(Polygon::new(vec![upright.to_vec()]).expect_err("a wall"), @r"
    points 2 and 3 of the outer ring of the polygon are both at (4, 0)
      help: remove one: they are equal as seen from above
    ");
    let high = [DVec3::ZERO, DVec3::X.with_z(f64::INFINITY), DVec3::Y];
    insta::assert_snapshot!(Ring::new(high.to_vec()).expect_err("no height"), @r"
    point 2 of the ring is (1, 0) with a height that is not a number
      help: give finite coordinates in metres
    ");
}

#[test]
fn what_rounding_left_of_an_area_is_none() {
    // A bow tie whose halves have the same size, with coordinates in tenths, whose sums are not exact.
    let tie = [(1.0, -2.0), (-2.0, 0.1), (-2.0, 1.0), (0.1, -2.0)].map(DVec2::from);
    for start in 0..4 {
        for is_reversed in [false, true] {
            let mut points = tie.to_vec();
            points.rotate_left(start);
            if is_reversed {
                points.reverse();
            }
            for made in [Polygon::new(Rings(vec![points.clone()])), Polygon::turned(Rings(vec![points]))] {
                let error = made.expect_err("no area");
                assert_eq!(error.message(), "the outer ring of the polygon has no area");
            }
        }
    }
}
