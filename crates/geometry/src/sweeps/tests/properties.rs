//! Sweeps of random sections along random paths.

use std::f64::consts::{FRAC_PI_3, TAU};

use glam::DVec2;
use proptest::prelude::*;

use super::forms::{least_cosine, near, solid, swept, texture_area, tower};
use crate::solid::{area, check, volume};
use crate::{Frame, Section, SectionPoint, Segment, Station, SweepOptions};

/// Returns points around a centre at random angles and distances: an outline that does not intersect itself.
fn outline(low: f64, high: f64) -> impl Strategy<Value = Vec<SectionPoint>> {
    prop::collection::vec((0.5f64..1.0, low..high, any::<bool>()), 4..12).prop_map(|points| {
        // No gap is half a turn, so the centre is inside, and the outline can be scaled at one position.
        let whole: f64 = points.iter().map(|(gap, ..)| gap).sum();
        let mut angle = 0.0;
        let place = |(gap, radius, smooth): (f64, f64, bool)| {
            angle += gap / whole * TAU;
            SectionPoint { at: DVec2::from_angle(angle) * radius, smooth }
        };
        points.into_iter().map(place).collect()
    })
}

fn any_section() -> impl Strategy<Value = Section> {
    let hole = prop::option::of(outline(0.05, 0.12));
    (outline(0.8, 1.5), hole, 0usize..40).prop_filter_map("an outline that works", |(outer, hole, around)| {
        let section = Section::new(&std::iter::once(outer).chain(hole).collect()).ok()?;
        section.resampled(around).ok()
    })
}

/// Returns segments with bends and twists (radians) of up to `angle` per step; each tip is followed by a wide
/// foot.
fn any_segments(angle: f64, least: f64) -> impl Strategy<Value = Vec<Segment>> {
    let scale = prop_oneof![4 => least..1.5, 1 => Just(0.0)];
    let turns = (-angle..angle, 0.0..TAU, -angle..angle);
    let segment = (3.0f64..6.0, turns, (scale.clone(), scale), 1usize..5);
    prop::collection::vec(segment, 1..5).prop_map(|segments| {
        let mut from = DVec2::ONE;
        let mut make = |(length, (bend, toward, twist), (x, y), steps)| {
            let to = if x * y == 0.0 { DVec2::ZERO } else { DVec2::new(x, y) };
            let turns = f64::from(u32::try_from(steps).expect("few steps")).min(2.0);
            let (bend, twist, sharp) = (bend * turns, twist * turns, steps == 2);
            let segment = Segment { length, bend, toward, twist, from, to, steps, sharp };
            from = if to == DVec2::ZERO { DVec2::ONE } else { to };
            segment
        };
        segments.into_iter().map(&mut make).collect()
    })
}

fn stations_of(segments: &[Segment], mirror: bool) -> Vec<Station> {
    let mut frame = Frame::default();
    let mut stations = Vec::new();
    for segment in segments {
        frame = segment.stations(frame, &mut stations).expect("a segment");
    }
    if mirror {
        stations.iter_mut().for_each(|station| station.scale.x = -station.scale.x);
    }
    stations
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 400, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn every_sweep_is_solid(section in any_section(), segments in any_segments(0.7, 0.1), mirror in any::<bool>()) {
        let part = solid(&section, &stations_of(&segments, mirror));
        prop_assert!(volume([&part]) > 0.0);
        prop_assert!(part.uvs.iter().all(|uv| uv.is_finite()));
    }

    #[test]
    fn every_gentle_sweep_has_normals_that_look_outwards(
        // No normal can point out of both faces of a smooth spike.
        section in any_section().prop_map(|section| section.creased(FRAC_PI_3)),
        segments in any_segments(0.15, 0.5),
        (around, along, mirror) in any::<(bool, bool, bool)>(),
    ) {
        let options = SweepOptions { around, along, ..SweepOptions::default() };
        let (part, _) = swept(&section, &stations_of(&segments, mirror), &options);
        prop_assert!(check([&part]).is_solid());
        prop_assert!(least_cosine(&part) > 0.0, "{}", least_cosine(&part));
    }

    #[test]
    fn a_prism_over_any_section_has_the_section_s_area_times_its_length(section in any_section()) {
        let part = solid(&section, &tower(&[(0., 1., 1., 0.), (2., 1., 1., 0.)]));
        prop_assert!(near(volume([&part]), section.area() * 2.0, 1e-5));
        let sides = area([&part]) - 2.0 * section.area();
        prop_assert!(near(sides, section.perimeter() * 2.0, 1e-5));
        prop_assert!(near(texture_area(&part), area([&part]), 1e-4));
    }
}
