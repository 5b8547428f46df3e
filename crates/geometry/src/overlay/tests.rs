use std::sync::Arc;

use burgeon_base::error::Error;
use burgeon_base::stop::Stop;
use glam::DVec2;
use proptest::prelude::*;

use super::predicates::crossing;
use super::*;
use crate::planar::{Rings, is_counter_clockwise, twice_area};

fn ring(places: &[(f64, f64)]) -> Vec<DVec2> {
    places.iter().copied().map(DVec2::from).collect()
}

fn area(made: &PolygonArea) -> f64 {
    made.iter().flat_map(|rings| rings.iter()).map(|ring| twice_area(ring.iter().copied()) / 2.0).sum()
}

#[test]
fn a_hole_that_touches_the_outer_ring_stays_a_hole_and_two_touches_divide_it() {
    let outer = ring(&[(0.0, 0.0), (8.0, 0.0), (8.0, 4.0), (0.0, 4.0)]);
    let once = ring(&[(4.0, 0.0), (3.0, 2.0), (5.0, 2.0)]);
    let twice = ring(&[(4.0, 0.0), (3.0, 2.0), (4.0, 4.0), (5.0, 2.0)]);
    let made = fill(&[Rings(vec![outer.clone(), once])], Fill::NonZero).unwrap();
    assert_eq!((made.len(), made[0].len(), area(&made)), (1, 2, 30.0));
    let made = fill(&[Rings(vec![outer, twice])], Fill::EvenOdd).unwrap();
    assert_eq!((made.len(), made[0].len(), made[1].len(), area(&made)), (2, 1, 1, 28.0));
}

#[test]
fn places_that_were_given_stay_as_they_are() {
    let one = Rings(vec![ring(&[(0.1, 0.2), (7.3, 0.7), (6.9, 5.1)])]);
    let two = Rings(vec![ring(&[(20.3, 0.1), (27.3, 0.7), (26.9, 5.1)])]);
    assert_eq!(unite(vec![one.clone(), two.clone()]).unwrap(), [one, two]);
}

#[test]
fn a_corner_on_a_wall_but_for_rounding_is_on_it() {
    let [a, b] = [DVec2::new(450_000.3, 6_800_000.1), DVec2::new(450_011.7, 6_800_007.9)];
    let at = |part: f64| a + (b - a) * part;
    let out = (b - a).perp() * 0.5;
    let house = Rings(vec![vec![a, b, b + out, a + out]]);
    let next = Rings(vec![vec![at(0.3), at(0.3) - out, at(0.7) - out, at(0.7)]]);
    let made = unite(vec![house, next]).unwrap();
    assert_eq!((made.len(), made[0].len()), (1, 1));
}

#[test]
fn work_ends_where_its_run_is_stopped() {
    let many: Vec<Rings<DVec2>> = (0..300)
        .map(|index| {
            let turned = |corner: i32| DVec2::from_angle(f64::from(corner) + f64::from(index) * 1e-8) * 10.0;
            Rings(vec![(0..6).map(turned).collect()])
        })
        .collect();
    assert_eq!(unite(many.clone()).unwrap().len(), 1);
    let stop = Arc::new(Stop::default());
    let _work = stop.at_work();
    stop.stop(Error::cancellation("enough"));
    assert_eq!(unite(many).unwrap_err().message(), "enough");
}

/// Returns true if edges of rings cross.
fn is_tangled(made: &PolygonArea) -> bool {
    let edges: Vec<[DVec2; 2]> =
        made.iter().flat_map(|rings| rings.iter()).flat_map(|ring| crate::planar::edges(ring)).collect();
    let pairs = edges
        .iter()
        .enumerate()
        .flat_map(|(number, one)| edges[number + 1..].iter().map(move |two| (*one, *two)));
    pairs.into_iter().any(|(one, two)| crossing(one, two).is_some())
}

fn rings() -> impl Strategy<Value = Vec<Vec<DVec2>>> {
    let number = || prop_oneof![(0..9i32).prop_map(f64::from), 0.0..8.0f64];
    let place = (number(), number()).prop_map(|(x, y)| DVec2::new(x, y));
    prop::collection::vec(prop::collection::vec(place, 3..9), 1..5)
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 300, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn any_rings_make_areas_that_add_up(
        one in rings(),
        two in rings(),
        far in prop::sample::select(vec![0.0, 6.8e6]),
        thin in prop::sample::select(vec![1.0, 1e-7]),
    ) {
        let moved = |rings: Vec<Vec<DVec2>>| -> PolygonArea {
            let place = |at: DVec2| DVec2::new(far + at.x, far * 0.07 + at.y * thin);
            rings.into_iter().map(|ring| Rings(vec![ring.into_iter().map(place).collect()])).collect()
        };
        let (one, two) = (moved(one), moved(two));
        let made = |keep: fn([bool; 2]) -> bool| overlay(&one, &two, keep).unwrap();
        let all = [made(|[a, b]| a && b), made(|[a, b]| a || b), made(|[a, b]| a && !b), made(|[a, b]| a != b)];
        let [both, either, first, single] = all.each_ref().map(area);
        let near = |a: f64, b: f64| (a - b).abs() <= 1e-12 * (8.0 + far);
        prop_assert!(near(both + single, either), "{both} {single} {either}");
        prop_assert!(near(area(&made(|[a, _]| a)), first + both));
        for area in &all {
            prop_assert!(!is_tangled(area));
            for rings in area {
                prop_assert!(is_counter_clockwise(&rings[0]));
                prop_assert!(rings[1..].iter().all(|hole| !is_counter_clockwise(hole)));
            }
        }
    }
}
