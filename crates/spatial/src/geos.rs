//! Comparison with GEOS: `tests/geos/cases.json`, written by `tests/geos/cases.py`, which records the version
//! of GEOS.
//!
//! Relations, predicates and counts are equal in all cases. Areas and lengths agree to 1e-9. Buffers agree to
//! 1 %, because GEOS simplifies their input.

use glam::DVec3;
use serde_json::Value;

use crate::{BufferCap, BufferJoin, BufferOptions, Geometry};

const NEAR: f64 = 1e-9;

fn cases() -> Value {
    serde_json::from_str(include_str!("../tests/geos/cases.json")).expect("the cases")
}

fn read(text: &Value) -> Geometry {
    Geometry::from_wkt(text.as_str().expect("a text")).expect("a geometry")
}

fn numbers(list: &Value) -> Vec<f64> {
    list.as_array().expect("a list").iter().map(|it| it.as_f64().expect("a number")).collect()
}

/// Returns the area, the length of lines, the number of single points, and the centroid.
fn measures(geometry: &Geometry) -> Vec<f64> {
    let points = geometry.parts().iter().filter(|part| part.dimension() == 0).count();
    let centre = geometry.centroid();
    let centre = centre.points().flat_map(|at| [at.x, at.y]);
    [geometry.area(), geometry.length(), points as f64].into_iter().chain(centre).collect()
}

/// Differences of more than `near`, with their location.
struct Differences(Vec<String>);

impl Differences {
    fn hold(&mut self, what: &str, found: &[f64], expected: &[f64], near: f64) {
        let same = found.len() == expected.len()
            && found.iter().zip(expected).all(|(a, b)| (a - b).abs() <= near * (1.0 + b.abs().min(1e3)));
        if !same {
            self.0.push(format!("{what}: {found:?}, not {expected:?}"));
        }
    }

    fn same<T: PartialEq + std::fmt::Debug>(&mut self, what: &str, found: &T, expected: &T) {
        if found != expected {
            self.0.push(format!("{what}: {found:?}, not {expected:?}"));
        }
    }

    fn end(self) {
        let (count, all) = (self.0.len(), self.0.join("\n"));
        assert_eq!(count, 0, "{all}");
    }
}

fn point(x: f64, y: f64) -> Geometry {
    Geometry::Point(Some(DVec3::new(x, y, 0.0)))
}

#[test]
fn one_geometry_is_what_geos_says_of_it() {
    let cases = cases();
    let mut wrong = Differences(Vec::new());
    let ones = cases["ones"].as_array().expect("cases");
    assert!(ones.len() > 100);
    for case in ones {
        let geometry = read(&case["wkt"]);
        let name = |what: &str| format!("{what} of {}", geometry.to_short_wkt(100));
        wrong.same(&name("valid"), &geometry.is_valid(), &case["valid"].as_bool().expect("valid"));
        if case["valid"] == false {
            let made = geometry.make_valid();
            assert!(made.is_valid(), "{made}");
            wrong.hold(
                &name("made valid"),
                &[made.area()],
                &[case["made_valid"].as_f64().unwrap_or(0.0)],
                NEAR,
            );
            continue;
        }
        wrong.hold(&name("measures"), &measures(&geometry), &numbers(&case["measures"]), 1e-8);
        wrong.hold(
            &name("perimeter"),
            &[geometry.perimeter()],
            &[case["perimeter"].as_f64().unwrap_or(0.0)],
            1e-9,
        );
        if geometry.is_empty() {
            continue;
        }
        let [low, high] = geometry.bounds().expect("not empty");
        wrong.hold(&name("bounds"), &[low.x, low.y, high.x, high.y], &numbers(&case["bounds"]), 0.0);
        wrong.hold(&name("hull"), &measures(&geometry.convex_hull()), &numbers(&case["hull"]), 1e-8);
        wrong.hold(
            &name("oriented"),
            &[geometry.oriented_envelope().area()],
            &[case["oriented"].as_f64().unwrap_or(0.0)],
            1e-6,
        );
        let on_surface = geometry.point_on_surface();
        // The midpoint of a line is off the line by its rounding error.
        let is_there = match geometry.dimension() {
            1 => geometry.distance(&on_surface).is_some_and(|far| far < 1e-9),
            _ => geometry.covers(&on_surface),
        };
        assert!(is_there, "{}", name("point"));
        if !case["boundary"].is_null() {
            let boundary = geometry.boundary();
            wrong.hold(&name("boundary"), &measures(&boundary), &numbers(&case["boundary"]), 1e-8);
        }
        wrong.same(
            &name("points"),
            &(geometry.num_points() as u64),
            &case["points"].as_u64().expect("a count"),
        );
        for buffer in case["buffers"].as_array().expect("buffers") {
            let join = match buffer[1].as_str() {
                Some("mitre") => BufferJoin::Mitre,
                Some("bevel") => BufferJoin::Bevel,
                _ => BufferJoin::Round,
            };
            let cap = match buffer[2].as_str() {
                Some("flat") => BufferCap::Flat,
                Some("square") => BufferCap::Square,
                _ => BufferCap::Round,
            };
            let options = BufferOptions { join, cap, ..BufferOptions::default() };
            let made = geometry.buffer(buffer[0].as_f64().expect("a distance"), &options).expect("a buffer");
            let what = name(&format!("buffer {buffer}"));
            wrong.hold(&what, &[made.area()], &[buffer[3].as_f64().unwrap_or(0.0)], 0.01);
        }
        let simple = measures(&geometry.simplify(0.6));
        wrong.hold(&name("simplified"), &simple[..3], &numbers(&case["simplified"])[..3], NEAR);
        for at in case["interpolated"].as_array().into_iter().flatten().map(numbers) {
            let found = geometry.line_interpolate(at[0]).expect("a line");
            wrong.hold(&name("interpolated"), &measures(&found)[3..], &at[1..], 1e-9);
        }
        if let Some(length) = case["substring"].as_f64() {
            let found = geometry.line_substring(0.2, 0.7).expect("a line").length();
            wrong.hold(&name("substring"), &[found], &[length], 1e-8);
        }
        for at in case["located"].as_array().into_iter().flatten().map(numbers) {
            let found = geometry.line_locate(&point(low.x + at[0], low.y + at[1])).expect("a line");
            wrong.hold(&name("located"), &[found.expect("a part")], &[at[2]], 1e-9);
        }
        for side in case["offsets"].as_array().into_iter().flatten().map(numbers) {
            let found = geometry.offset(side[0], &BufferOptions::default()).expect("a line");
            wrong.hold(&name(&format!("offset {}", side[0])), &[found.length()], &[side[1]], 0.01);
        }
    }
    wrong.end();
}

#[test]
fn two_geometries_are_to_each_other_as_geos_says() {
    let cases = cases();
    let mut wrong = Differences(Vec::new());
    let twos = cases["twos"].as_array().expect("cases");
    assert!(twos.len() > 400);
    for case in twos {
        let (a, b) = (read(&case["a"]), read(&case["b"]));
        let name = |what: &str| format!("{what} of {a} and {b}");
        wrong.same(&name("relate"), &a.relate(&b).text(), &case["relate"].as_str().expect("a text"));
        let found: Vec<&str> = [
            ("intersects", a.intersects(&b)),
            ("contains", a.contains(&b)),
            ("within", a.within(&b)),
            ("touches", a.touches(&b)),
            ("crosses", a.crosses(&b)),
            ("overlaps", a.overlaps(&b)),
            ("covers", a.covers(&b)),
            ("equals", a.equals(&b)),
            ("disjoint", a.disjoint(&b)),
        ]
        .into_iter()
        .filter_map(|(name, holds)| holds.then_some(name))
        .collect();
        let expected: Vec<&str> =
            case["is"].as_array().into_iter().flatten().filter_map(Value::as_str).collect();
        wrong.same(&name("predicates"), &found, &expected);
        let distance = |far: Option<f64>| far.into_iter().collect::<Vec<_>>();
        wrong.hold(&name("distance"), &distance(a.distance(&b)), &distance(case["distance"].as_f64()), 1e-9);
        for (what, made) in [
            ("intersection", a.intersection(&b)),
            ("union", a.union(&b)),
            ("difference", a.difference(&b)),
            ("symmetric_difference", a.sym_difference(&b)),
        ] {
            wrong.hold(&name(what), &measures(&made), &numbers(&case[what]), NEAR);
        }
    }
    wrong.end();
}
