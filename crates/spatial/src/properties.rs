//! Properties of all operations for arbitrary geometries.

use glam::DVec3;
use proptest::prelude::*;

use crate::{BufferCap, BufferOptions, Geometry, union_all};

/// Returns points on a small grid, so that geometries often touch, and some off the grid.
fn place() -> impl Strategy<Value = DVec3> {
    let number = || prop_oneof![8 => (0..8i32).prop_map(f64::from), 1 => 0.0..8.0f64];
    let height = prop::sample::select(vec![0.0, 0.0, 0.0, 2.5]);
    (number(), number(), height).prop_map(|(x, y, z)| DVec3::new(x, y, z))
}

/// Returns crossing rings with hundreds of intersections.
fn tangle() -> impl Strategy<Value = Geometry> {
    let place = (0.0..100.0f64, 0.0..100.0f64).prop_map(|(x, y)| DVec3::new(x, y, 0.0));
    let rings = prop::collection::vec(prop::collection::vec(place, 3..30), 1..5);
    rings.prop_map(|rings| Geometry::polygon(rings).unwrap_or(Geometry::empty(2)))
}

/// Returns a star-shaped ring around a point, which does not cross itself.
fn star() -> impl Strategy<Value = Vec<DVec3>> {
    (place(), prop::collection::vec(0.5..4.0f64, 3..9), any::<bool>()).prop_map(|(middle, far, whole)| {
        let count = far.len() as f64;
        let corner = |(index, far): (usize, &f64)| {
            let angle = std::f64::consts::TAU * index as f64 / count;
            let at = middle + DVec3::new(angle.cos(), angle.sin(), 0.0) * *far;
            // On the grid, corners lie on edges of other geometries; a star that rounding deforms is
            // discarded later.
            if whole { DVec3::new(at.x.round(), at.y.round(), at.z) } else { at }
        };
        far.iter().enumerate().map(corner).collect()
    })
}

fn polygon() -> impl Strategy<Value = Geometry> {
    star().prop_filter_map("no polygon", |mut ring| {
        ring.dedup_by(|a, b| a.truncate() == b.truncate());
        let polygon = Geometry::polygon(vec![ring])?;
        // Rounding to the grid may have caused self-intersections.
        (polygon.area() > 0.1 && (polygon.dissolved().area() - polygon.area()).abs() < 1e-9)
            .then_some(polygon)
    })
}

fn geometry() -> impl Strategy<Value = Geometry> {
    let leaf = prop_oneof![
        Just(Geometry::Point(None)),
        place().prop_map(|at| Geometry::Point(Some(at))),
        prop::collection::vec(place(), 2..6).prop_map(Geometry::Line),
        prop::collection::vec(place(), 0..4).prop_map(Geometry::MultiPoint),
        prop::collection::vec(prop::collection::vec(place(), 2..4), 0..3).prop_map(Geometry::MultiLine),
        polygon(),
        prop::collection::vec(place(), 3..7)
            .prop_map(|ring| Geometry::polygon(vec![ring]).unwrap_or(Geometry::empty(2))),
    ];
    leaf.prop_recursive(3, 12, 3, |inner| prop::collection::vec(inner, 0..3).prop_map(Geometry::Collection))
}

/// Returns true if a ring of an area has a spike, which runs outwards and back along the same line. Only the
/// intersection test takes spikes into account.
fn has_spike(geometry: &Geometry) -> bool {
    geometry.parts().iter().any(|part| {
        let whole = part.dissolved();
        part.dimension() == 2 && whole.dimension() == 2 && part.boundary().difference(&whole).length() > 1e-9
    })
}

/// Returns true if no area had to be computed, so that relations with the geometry are exact.
fn has_given_areas(geometry: &Geometry) -> bool {
    crate::overlay::Operand::new(crate::plane::Plane::of(&[geometry]), geometry).are_given
}

fn settings(cases: u32) -> ProptestConfig {
    ProptestConfig { cases, failure_persistence: None, ..ProptestConfig::default() }
}

proptest! {
    #![proptest_config(settings(600))]

    #[test]
    fn what_is_written_reads_back_the_same(geometry in geometry()) {
        prop_assert_eq!(Geometry::from_wkt(&geometry.to_wkt()).ok(), Some(geometry.clone()));
        prop_assert_eq!(Geometry::from_wkb(&geometry.to_wkb()).ok(), Some(geometry.clone()));
        prop_assert_eq!(Geometry::from_wkb(&geometry.to_ewkb(Some(3763))).ok(), Some(geometry.clone()));
        prop_assert_eq!(crate::wkb::srid(&geometry.to_ewkb(Some(3763))), Some(3763));
        let bytes = geometry.to_wkb();
        for end in 0..bytes.len() {
            prop_assert!(Geometry::from_wkb(&bytes[..end]).is_err());
        }
    }

    #[test]
    fn nothing_panics_on_any_two_geometries(a in geometry(), b in geometry(), distance in -3.0..3.0f64) {
        for made in [a.intersection(&b), a.union(&b), a.difference(&b), a.sym_difference(&b)] {
            prop_assert!(made.is_sound());
        }
        for made in [a.centroid(), a.point_on_surface(), a.convex_hull(), a.oriented_envelope(), a.envelope()] {
            prop_assert!(made.is_sound());
            prop_assert!(a.is_empty() == made.is_empty(), "{a}: {made}");
        }
        prop_assert!(a.buffer(distance, &BufferOptions::default()).is_ok_and(|made| made.is_sound()));
        prop_assert_eq!(a.distance(&b).is_none(), a.is_empty() || b.is_empty());
        let _ = a.relate(&b);
    }

    #[test]
    fn nothing_panics_on_what_is_tiny_or_huge(
        a in geometry(), b in geometry(), (exponent, other) in (-320..8i32, -320..8i32), distance in -320..8i32,
    ) {
        let scaled = |geometry: &Geometry, exponent: i32| {
            let mut geometry = geometry.clone();
            geometry.points_mut().for_each(|point| *point *= 10f64.powi(exponent));
            geometry
        };
        let (a, b) = (scaled(&a, exponent), scaled(&b, other));
        for made in [
            a.intersection(&b),
            a.union(&b),
            a.difference(&b),
            a.sym_difference(&b),
            a.centroid(),
            a.point_on_surface(),
            a.convex_hull(),
            a.oriented_envelope(),
            a.make_valid(),
            a.nearest_point(&b),
            a.simplify(10f64.powi(distance)),
        ] {
            prop_assert!(made.is_sound(), "{a} {b}: {made}");
        }
        for distance in [10f64.powi(distance), -10f64.powi(distance)] {
            prop_assert!(a.buffer(distance, &BufferOptions::default()).is_ok_and(|made| made.is_sound()));
        }
        let _ = (a.relate(&b), a.distance(&b), a.area(), a.length());
    }

    #[test]
    fn tiny_geometries_beside_ordinary_ones_never_panic(
        a in polygon(), b in geometry(), exponent in -175..-90i32,
    ) {
        let mut tiny = b.clone();
        tiny.points_mut().for_each(|point| *point *= 10f64.powi(exponent));
        for (one, other) in [(&a, &tiny), (&tiny, &a), (&tiny, &tiny)] {
            for found in
                [one.intersection(other), one.union(other), one.difference(other), one.sym_difference(other)]
            {
                prop_assert!(found.is_sound() && found.area().is_finite());
            }
            let _ = (one.relate(other), one.make_valid());
        }
        prop_assert!((a.union(&tiny).area() - a.make_valid().area()).abs() < 1e-6);
    }

    #[test]
    fn areas_add_up(a in polygon(), b in polygon()) {
        let (both, either) = (a.intersection(&b), a.union(&b));
        let near = |one: f64, two: f64| (one - two).abs() < 1e-6;
        prop_assert!(near(a.area() + b.area(), either.area() + both.area()));
        prop_assert!(near(a.difference(&b).area(), a.area() - both.area()));
        prop_assert!(near(a.sym_difference(&b).area(), either.area() - both.area()));
        prop_assert!(a.difference(&b).intersection(&b).area() < 1e-6);
        prop_assert!(near(union_all([&a, &b]).area(), either.area()));
        if !has_spike(&a) && !has_spike(&b) {
            prop_assert_eq!(a.intersects(&b), !both.is_empty() || a.touches(&b));
        }
    }

    #[test]
    fn a_greater_buffer_holds_a_lesser_one(a in geometry(), less in 0.1..2.0f64, more in 0.1..2.0f64) {
        let options = BufferOptions::default();
        let (one, two) = (a.buffer(less, &options)?, a.buffer(less + more, &options)?);
        prop_assert!(one.difference(&two).area() < 1e-6);
        prop_assert!(a.is_empty() || two.area() > one.area());
        prop_assert!(two.dimension() == 2);
    }

    #[test]
    fn a_strip_along_an_edge_is_what_a_line_through_its_middle_has(a in place(), b in place(), far in 0.1..3.0f64) {
        prop_assume!(a.truncate() != b.truncate());
        for cap in [BufferCap::Flat, BufferCap::Square] {
            let options = BufferOptions { cap, ..BufferOptions::default() };
            let strip = Geometry::Line(vec![a, b]).buffer(far, &options)?;
            let whole = Geometry::Line(vec![a, a.midpoint(b), b]).buffer(far, &options)?;
            prop_assert!(strip.sym_difference(&whole).area() < 1e-6, "{strip} {whole}");
            prop_assert!(strip.is_valid() && (strip.num_points(), strip.has_heights()) == (5, whole.has_heights()));
        }
    }

    #[test]
    fn predicates_say_what_the_relation_says(a in geometry(), b in geometry()) {
        prop_assume!(!has_spike(&a) && !has_spike(&b));
        let relation = a.relate(&b);
        let is = |pattern: &str| relation.matches(pattern).expect("a pattern");
        if has_given_areas(&a) && has_given_areas(&b) {
            prop_assert_eq!(a.intersects(&b), !is("FF*FF****"), "{} {} {}", a, b, relation.text());
        }
        prop_assert_eq!(a.disjoint(&b), !b.intersects(&a));
        prop_assert_eq!(a.contains(&b), b.within(&a));
        prop_assert_eq!(a.contains(&b), is("T*****FF*"));
        prop_assert!(!a.contains(&b) || a.covers(&b));
        prop_assert_eq!(a.touches(&b), b.touches(&a));
        prop_assert_eq!(a.overlaps(&b), b.overlaps(&a));
        prop_assert_eq!(a.crosses(&b), b.crosses(&a));
        prop_assert_eq!(a.equals(&b), b.equals(&a));
        prop_assert!(a.equals(&a));
        if let Some(distance) = a.distance(&b) {
            prop_assert_eq!(distance == 0.0, a.intersects(&b));
            prop_assert!((distance - b.distance(&a).unwrap_or(f64::NAN)).abs() < 1e-12);
        }
    }

    #[test]
    fn far_from_the_origin_all_is_as_it_is_near_to_it(a in polygon(), b in polygon()) {
        let moved = |geometry: &Geometry| {
            let mut moved = geometry.clone();
            moved.points_mut().for_each(|point| *point += DVec3::new(4_194_304.0, 8_388_608.0, 0.0));
            moved
        };
        let (far_a, far_b) = (moved(&a), moved(&b));
        prop_assert!((far_a.area() - a.area()).abs() < 1e-6);
        let both = [a.intersection(&b).area(), far_a.intersection(&far_b).area()];
        prop_assert!((both[0] - both[1]).abs() < 1e-5, "{both:?}");
    }
}

#[test]
fn what_nests_too_deep_is_refused() {
    let deep = |name: &str, count: usize| name.repeat(count) + "POINT (1 2)" + &")".repeat(count);
    assert!(Geometry::from_wkt(&deep("GEOMETRYCOLLECTION (", 32)).is_ok());
    for name in ["GEOMETRYCOLLECTION (", "geometrycollection(", "MULTISURFACE (", "COMPOUNDCURVE (", "("] {
        assert!(Geometry::from_wkt(&deep(name, 100_000)).is_err(), "{name}");
    }
    let mut bytes = Vec::new();
    for _ in 0..100_000 {
        bytes.extend([1, 7, 0, 0, 0, 1, 0, 0, 0]);
    }
    let error = Geometry::from_wkb(&bytes).expect_err("deep");
    assert_eq!(error.message(), "well-known binary is nested more than 32 deep");
}

#[test]
fn what_is_no_number_is_refused_and_counts_as_empty() {
    for text in ["POINT (nan 1)", "POINT (inf 1)", "LINESTRING (0 0, 1e300 1)", "POINT (1 2 3 4 5)"] {
        assert!(Geometry::from_wkt(text).is_err(), "{text}");
    }
    let wild = Geometry::Line(vec![DVec3::NAN, DVec3::ONE, DVec3::INFINITY]);
    let lawn = Geometry::from_wkt("POLYGON ((0 0, 9 0, 9 9, 0 9, 0 0))").expect("a polygon");
    assert!(wild.check().is_err() && wild.convex_hull().is_empty() && wild.oriented_envelope().is_empty());
    assert!(
        !wild.intersects(&lawn) && wild.distance(&lawn).is_none() && wild.relate(&lawn).text() == "FFFFFF212"
    );
    assert!(lawn.difference(&wild).equals(&lawn));
    assert!(lawn.buffer(f64::NAN, &BufferOptions::default()).is_err());
}

#[test]
fn every_form_of_well_known_text_is_read() {
    for (text, same) in [
        ("POINTZM(1 2 3 4)", "POINT Z (1 2 3)"),
        (" point m ( 1 2 3 ) ", "POINT (1 2)"),
        ("MULTIPOINT (1 2, 3 4)", "MULTIPOINT ((1 2), (3 4))"),
        ("MULTIPOINT ((1 2), EMPTY)", "MULTIPOINT ((1 2))"),
        ("SRID=25831;LINESTRING EMPTY", "LINESTRING EMPTY"),
        ("TRIANGLE ((0 0, 1 0, 0 1, 0 0))", "POLYGON ((0 0, 1 0, 0 1, 0 0))"),
        ("TIN (((0 0, 1 0, 0 1, 0 0)))", "MULTIPOLYGON (((0 0, 1 0, 0 1, 0 0)))"),
        ("COMPOUNDCURVE ((0 0, 1 0), (1 0, 2 2))", "LINESTRING (0 0, 1 0, 2 2)"),
        (
            "GEOMETRYCOLLECTION (POINT EMPTY, LINESTRING (0 0, 1e-9 1E2))",
            "GEOMETRYCOLLECTION (POINT EMPTY, LINESTRING (0 0, 1e-9 100))",
        ),
    ] {
        assert_eq!(Geometry::from_wkt(text).map(|it| it.to_wkt()).ok().as_deref(), Some(same), "{text}");
    }
    let disc = Geometry::from_wkt("CURVEPOLYGON (CIRCULARSTRING (0 0, 4 0, 0 0))").expect("a disc");
    assert!((disc.area() - 4.0 * std::f64::consts::PI).abs() < 0.1);
    for (text, why) in [
        ("", "expected a geometry type at character 1, found its end"),
        ("CIRCLE (1 2)", "expected a geometry type at character 1, found \"CIRCLE\""),
        (
            "LINESTRING (1 2)",
            "expected a second point in the line before this at character 17, found its end",
        ),
        (
            "POLYGON ((0 0, 1 1))",
            "expected a third point in the ring before this at character 21, found its end",
        ),
        ("POINT Z (1 2)", "expected a point of 3 numbers at character 13, found \")\""),
        ("POINT (1 2) x", "expected the end at character 13, found \"x\""),
        ("LINESTRING (1 2; 3 4)", "expected a number at character 16, found \";\""),
    ] {
        let error = Geometry::from_wkt(text).expect_err("no geometry");
        assert_eq!(error.message(), format!("invalid well-known text: {why}"), "{text}");
        assert!(error.remedy().is_some());
    }
}

#[test]
fn a_hole_that_meets_the_outer_ring_stays_however_often_areas_are_joined() {
    let a = Geometry::from_wkt("POLYGON ((5 0, 2 1, 1 1, 2 0, 5 0))").expect("a polygon");
    let b = Geometry::from_wkt("POLYGON ((5 1, 5 3, 3 2, 1 1, 4 1, 5 0, 5 1))").expect("a polygon");
    assert_eq!(
        [a.union(&b).area(), union_all([&a, &b]).area(), union_all([&union_all([&a, &b])]).area()],
        [6.5; 3]
    );
}

#[test]
fn a_ring_that_goes_back_the_way_it_came_is_a_line() {
    let ring = Geometry::from_wkt("POLYGON ((0 0, 0 2, 4 2, 0 2, 0 0))").expect("a polygon");
    let line = Geometry::from_wkt("LINESTRING (0 0, 0 2, 4 2)").expect("a line");
    let point = Geometry::from_wkt("POINT (4 2)").expect("a point");
    assert!(ring.intersects(&point) && ring.relate(&point).matches("0********").expect("a pattern"));
    let [of_ring, of_line] =
        [&ring, &line].map(|it| it.buffer(0.5, &BufferOptions::default()).expect("a buffer"));
    assert!(of_ring.sym_difference(&of_line).area() < 1e-6, "{of_ring}");
}

#[test]
fn the_centroid_of_a_ring_that_crosses_itself_is_within_its_bounds() {
    for text in [
        "POLYGON ((2 1.9169239968529606, 6 1, 0 4, 7 1, 1 4, 6 1, 2 1.9169239968529606))",
        "POLYGON ((4 5, 6 7, 4.140198189262057 3, 3 7, 1 5, 4 5))",
        "POLYGON ((7 7.307791081020515, 6 0, 1 7, 0 0, 1 1, 6 6, 7 7.307791081020515))",
    ] {
        let geometry = Geometry::from_wkt(text).expect("a polygon");
        let centroid = geometry.centroid();
        assert!(geometry.envelope().intersects(&centroid), "{text}: {centroid}");
    }
}

#[test]
fn where_a_line_goes_back_its_buffer_has_an_arc() {
    let options = BufferOptions::default();
    let [there, back] = ["LINESTRING (6 3, 6.1 2, 6 3, 0 0)", "LINESTRING (6.1 2, 6 3, 0 0)"]
        .map(|text| Geometry::from_wkt(text).expect("a line").buffer(1.5, &options).expect("a buffer"));
    assert!(there.sym_difference(&back).area() < 0.02, "{} {}", there.area(), back.area());
}

#[test]
fn a_buffer_that_reaches_too_far_is_refused() {
    let options = BufferOptions::default();
    let told = |place: f64, distance: f64| {
        let made = Geometry::point(DVec3::new(place, 0.0, 0.0)).buffer(distance, &options);
        made.expect_err("too far").message().to_owned()
    };
    assert_eq!(told(0.0, 2e9), "buffer takes a distance of at most 1e9, not 2000000000.0");
    assert_eq!(told(0.0, f64::INFINITY), "buffer takes a finite distance, not inf");
    assert!(told(9e8, 5e8).starts_with("buffer: a geometry has the point (1400000000, 0)"));
}

proptest! {
    #![proptest_config(settings(60))]

    #[test]
    fn what_is_made_of_rings_that_cross_themselves_is_valid(a in tangle(), b in tangle()) {
        let options = BufferOptions::default();
        for made in [
            a.make_valid(),
            a.union(&b),
            a.difference(&b),
            a.intersection(&b),
            a.sym_difference(&b),
            a.buffer(0.5, &options)?,
            a.buffer(-0.5, &options)?,
            a.boundary().buffer(0.2, &options)?,
        ] {
            prop_assert_eq!(made.validity_reason(), None, "{} {}", a, b);
        }
    }
}

#[test]
fn polygons_of_every_tiny_size_are_divided() {
    let points = [(3.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 6.967664743235536)];
    let (empty, ordinary) =
        (Geometry::Point(None), Geometry::from_wkt("POLYGON ((0 0, 2 0, 2 2, 0 0))").expect("a polygon"));
    for exponent in -330..0 {
        let ring = points.map(|(x, y)| DVec3::new(x, y, 0.0) * 10f64.powi(exponent));
        let tiny = Geometry::polygon(vec![ring.to_vec()]).unwrap_or(Geometry::empty(2));
        for other in [&empty, &ordinary, &tiny] {
            assert!(tiny.union(other).is_sound() && other.difference(&tiny).is_sound(), "{exponent}");
        }
    }
}
