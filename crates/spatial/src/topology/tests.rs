//! Tests of relations against the arrangement, which rounds: on a grid without rounding, and in cases with
//! rounding.

use glam::DVec3;
use proptest::prelude::*;

use crate::{Geometry, overlay};

fn corner() -> impl Strategy<Value = DVec3> {
    (0..6i32, 0..6i32).prop_map(|(x, y)| DVec3::new(f64::from(x), f64::from(y), 0.0))
}

fn is_on_grid(geometry: &Geometry) -> bool {
    geometry.is_valid() && geometry.points().all(|point| point.fract() == DVec3::ZERO)
}

/// Returns areas, lines and points on a small grid, so that geometries often meet.
fn geometry() -> impl Strategy<Value = Geometry> {
    let ring = || prop::collection::vec(corner(), 3..7);
    let polygon = move || ring().prop_filter_map("no polygon", |ring| Geometry::polygon(vec![ring]));
    let area = move || polygon().prop_filter("it is not valid", |it| it.is_valid());
    let line = || prop::collection::vec(corner(), 2..6);
    prop_oneof![
        6 => area(),
        2 => (area(), area()).prop_map(|(a, b)| a.difference(&b)).prop_filter("it is off the grid", is_on_grid),
        2 => (area(), area()).prop_map(|(a, b)| Geometry::Collection(vec![a, b])),
        1 => polygon(),
        4 => line().prop_map(Geometry::Line),
        2 => prop::collection::vec(line(), 1..4).prop_map(Geometry::MultiLine),
        1 => corner().prop_map(|at| Geometry::Point(Some(at))),
        1 => prop::collection::vec(corner(), 0..4).prop_map(Geometry::MultiPoint),
        1 => (area(), line()).prop_map(|(a, b)| Geometry::Collection(vec![a, Geometry::Line(b)])),
    ]
}

fn text(cells: [u8; 9]) -> String {
    String::from_utf8_lossy(&cells).into_owned()
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 4000, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn relations_are_those_of_all_pieces(a in geometry(), b in geometry()) {
        let relation = a.relate(&b);
        prop_assert_eq!(relation.text(), text(overlay::relate(&a, &b)), "{} and {}", a, b);
        let turned = b.relate(&a);
        let back: Vec<u8> = [0, 3, 6, 1, 4, 7, 2, 5, 8].iter().map(|at| turned.text().as_bytes()[*at]).collect();
        prop_assert_eq!(relation.text().as_bytes(), back);
    }
}

#[test]
fn edges_that_cross_where_a_geometry_touches_itself_have_what_is_there_beside_them() {
    // The first geometry touches itself in (3 3), and a side of the second runs along it there and then into
    // it.
    let first = "MULTIPOLYGON (((4 2, 2 1, 3 3, 0 0, 5 1, 4 2)), ((4 5, 1 5, 4 2, 4 5)))";
    let second = "MULTIPOLYGON (((2 1, 4 5, 4 2, 2 1)), ((0 0, 2 1, 1 1, 0 0)))";
    let [first, second] = [first, second].map(|text| Geometry::from_wkt(text).unwrap());
    assert_eq!(first.relate(&second).text(), "2121112F2");
}

#[test]
fn what_is_a_rounding_apart_is_apart() {
    // The corner of the second lies on a side of the first, or next to it by the smallest possible
    // difference.
    let first = Geometry::from_wkt(
        "POLYGON ((600000 6000000, 600010 6000000, 600010 6000010, 600000 6000010, 600000 6000000))",
    )
    .unwrap();
    for (x, expected) in [
        (600_010.0_f64, "FF2F01212"),
        (600_010.0_f64.next_down(), "212101212"),
        (600_010.0_f64.next_up(), "FF2FF1212"),
    ] {
        let second = Geometry::polygon(vec![vec![
            DVec3::new(x, 6_000_005.0, 0.0),
            DVec3::new(600_020.0, 6_000_000.0, 0.0),
            DVec3::new(600_020.0, 6_000_010.0, 0.0),
        ]])
        .unwrap();
        assert_eq!(first.relate(&second).text(), expected, "{x}");
        assert_eq!(first.overlaps(&second), expected.starts_with('2'));
        assert_eq!(first.touches(&second), expected == "FF2F01212");
    }
}
