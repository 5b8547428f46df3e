//! Tests of extruders: solids have the volumes of their formulas.

use super::options::ExtruderOptions;
use super::*;
use burgeon_base::error::Result;
use burgeon_geometry::solid;
use burgeon_kit::Object;
use burgeon_kit::Vector;
use glam::DVec3;

/// Draws with an extruder, checks that the result is a closed solid, and returns its volume (m³).
fn volume(options: ExtruderOptions, draw: impl FnOnce(&mut Extruder) -> Result<()>) -> f64 {
    let mut extruder = Extruder::new(options).expect("the options are valid");
    extruder.begin();
    draw(&mut extruder).expect("it can be drawn");
    extruder.end().expect("it can be closed");
    let check = solid::check(extruder.drawing.parts());
    assert!(check.is_solid(), "{check:?}");
    solid::volume(extruder.drawing.parts())
}

/// Returns the area of a regular polygon with radius 1.
fn regular(sides: f64) -> f64 {
    sides / 2.0 * (std::f64::consts::TAU / sides).sin()
}

fn near(volume: f64, expected: f64) {
    assert!((volume - expected).abs() < 1e-5 * expected, "{volume} m³, expected {expected} m³");
}

#[test]
fn a_prism_a_frustum_and_a_pyramid_have_their_volumes() {
    let six = || ExtruderOptions { sides: 6, ..ExtruderOptions::default() };
    near(
        volume(six(), |it| {
            it.scale(2.0, None);
            it.extrude(3.0)
        }),
        regular(6.0) * 4.0 * 3.0,
    );
    near(
        volume(six(), |it| {
            it.scale(2.0, None);
            it.taper(1.0, None);
            it.extrude(3.0)
        }),
        regular(6.0) * 3.0 / 3.0 * (4.0 + 2.0 + 1.0),
    );
    near(
        volume(six(), |it| {
            it.taper(0.0, None);
            it.extrude(3.0)
        }),
        regular(6.0),
    );
}

#[test]
fn a_hole_is_taken_from_the_volume() {
    let ring = |half: f64| {
        let points = [(-half, -half), (half, -half), (half, half), (-half, half)];
        points.map(|(x, y)| Vector(DVec3::new(x, y, 0.0))).to_vec()
    };
    near(
        volume(ExtruderOptions::default(), |it| {
            it.polygon(ring(1.0).into(), Some(vec![ring(0.5).into()]))?;
            it.extrude(2.0)
        }),
        (4.0 - 1.0) * 2.0,
    );
}

#[test]
fn a_bent_segment_follows_pappus() {
    // The solid is a quarter of a torus: the area times the length of the centreline, minus the loss due to chords.
    let bent = volume(ExtruderOptions { sides: 24, along: 200, ..ExtruderOptions::default() }, |it| {
        it.bend(90.0, None);
        it.extrude(6.0)
    });
    let expected = regular(24.0) * 6.0;
    assert!((bent - expected).abs() < 1e-4 * expected, "{bent} m³, expected about {expected} m³");
}

#[test]
fn segments_that_continue_one_another_are_one_solid() {
    near(
        volume(ExtruderOptions { sides: 4, smooth: false, ..ExtruderOptions::default() }, |it| {
            it.extrude(1.0)?;
            it.extrude(2.0)?;
            it.roll(10.0);
            it.extrude(1.0)
        }),
        regular(4.0) * 4.0,
    );
}

/// Returns the number of connected pieces that an extruder draws, and their volume (m³), after checking that each is a
/// closed solid.
fn pieces(options: ExtruderOptions, draw: impl FnOnce(&mut Extruder) -> Result<()>) -> (usize, f64) {
    let mut extruder = Extruder::new(options).expect("the options are valid");
    extruder.begin();
    draw(&mut extruder).expect("it can be drawn");
    extruder.end().expect("it can be closed");
    let check = solid::check(extruder.drawing.parts());
    assert!(check.is_solid(), "{check:?}");
    let mut of_place = std::collections::HashMap::new();
    let mut piece_of: Vec<usize> = Vec::new();
    for part in extruder.drawing.parts() {
        for triangle in part.triangles.iter() {
            let corners = triangle.map(|corner| {
                let place = part.positions[corner as usize].to_array().map(f32::to_bits);
                *of_place.entry(place).or_insert_with(|| {
                    piece_of.push(piece_of.len());
                    piece_of.len() - 1
                })
            });
            let [first, others @ ..] = corners.map(|corner| piece_of[corner]);
            for other in others {
                piece_of.iter_mut().filter(|piece| **piece == other).for_each(|piece| *piece = first);
            }
        }
    }
    piece_of.sort_unstable();
    piece_of.dedup();
    (piece_of.len(), solid::volume(extruder.drawing.parts()))
}

#[test]
fn segments_across_turns_are_joined_by_mitres_into_one_solid() {
    for sides in [4, 5, 12] {
        let options = || ExtruderOptions { sides, ..ExtruderOptions::default() };
        // A mitre takes from one side of the axis what it adds on the other.
        let (count, polyline) = pieces(options(), |it| {
            it.scale(0.2, None);
            for angle in [30.0, -75.0, 90.0, 10.0, -40.0, 115.0, -20.0, 60.0, 5.0] {
                it.extrude(2.0)?;
                it.turn(angle);
                it.pitch(-angle / 20.0);
            }
            Ok(())
        });
        assert_eq!(count, 1);
        assert!((polyline - regular(f64::from(sides)) * 0.04 * 18.0).abs() < 0.02, "{polyline}");
        let (count, helix) = pieces(options(), |it| {
            it.scale(0.05, None);
            for _ in 0..120 {
                it.extrude(0.3)?;
                it.turn(12.0);
                it.pitch(3.0);
            }
            Ok(())
        });
        assert_eq!(count, 1);
        assert!((helix - regular(f64::from(sides)) * 0.0025 * 36.0).abs() < 1e-3, "{helix}");
    }
}

#[test]
fn turns_that_have_no_mitre_begin_a_new_solid() {
    let pieces_of = |draw: fn(&mut Extruder)| {
        pieces(ExtruderOptions { sides: 5, ..ExtruderOptions::default() }, |it| {
            it.scale(0.2, None);
            it.extrude(1.0)?;
            draw(it);
            it.extrude(1.0)
        })
        .0
    };
    assert_eq!(pieces_of(|it| it.turn(90.0)), 1);
    // Too sharp, only a roll, more roll than bend, another place, another scale and a segment too short for the mitre.
    assert_eq!(pieces_of(|it| it.turn(150.0)), 2);
    assert_eq!(pieces_of(|it| it.roll(20.0)), 2);
    let rolls = |it: &mut Extruder| {
        it.roll(40.0);
        it.turn(10.0);
    };
    assert_eq!(pieces_of(rolls), 2);
    let moves = |it: &mut Extruder| {
        it.turn(90.0);
        it.advance(0.5);
    };
    assert_eq!(pieces_of(moves), 2);
    let scales = |it: &mut Extruder| {
        it.turn(90.0);
        it.scale(0.5, None);
    };
    assert_eq!(pieces_of(scales), 2);
    let is_short = |it: &mut Extruder| {
        it.turn(90.0);
        it.extrude(0.1).expect("it can be drawn");
        it.turn(90.0);
    };
    assert_eq!(pieces_of(is_short), 3);
}

#[test]
fn a_missing_cap_is_counted_as_open_edges() {
    let mut extruder =
        Extruder::new(ExtruderOptions { sides: 5, ..ExtruderOptions::default() }).expect("valid options");
    extruder.begin();
    extruder.caps(true, Some(false));
    extruder.extrude(1.0).expect("it can be drawn");
    extruder.end().expect("it can be closed");
    assert_eq!(extruder.open_edges(), 5);
}

#[test]
fn every_method_and_field_is_documented() {
    for kind in crate::registry().kinds() {
        for method in &kind.methods {
            assert!(method.doc.trim().ends_with('.'), "{}:{}", kind.name, method.name);
        }
        for field in &kind.fields {
            assert!(field.doc.trim().len() > 8, "{}.{}", kind.name, field.name);
        }
    }
}
