//! Tests of generalised cylinders: closedness, volume, twist, contours and refusals.

use std::f64::consts::{PI, TAU};
use std::sync::Arc;

use glam::{DVec3, Vec3};
use proptest::prelude::*;

use crate::curves::curve::{Curve, CurveKind};
use crate::solid::{check, volume};
use crate::sweeps::control_point::CylinderPoint;
use crate::sweeps::cylinder::generalized_cylinder;
use burgeon_scene::Part;

fn point(position: DVec3, radius: f64) -> CylinderPoint {
    CylinderPoint { position, radius, contour: None, side: None }
}

fn cylinder(points: &[CylinderPoint], sides: usize) -> Part {
    let mut part = Part::default();
    generalized_cylinder(&mut part, points.to_vec(), DVec3::X, sides).expect("a cylinder");
    assert!(part.normals.iter().all(|normal| (normal.vector().length() - 1.0).abs() < 1e-4));
    assert!(part.uvs.iter().all(|uv| uv.is_finite()));
    part
}

/// Area (m²) of a regular polygon with radius 1.
fn polygon(sides: usize) -> f64 {
    sides as f64 / 2.0 * (TAU / sides as f64).sin()
}

fn contour(points: &[(f64, f64)], kind: CurveKind) -> Arc<Curve> {
    let points: Vec<DVec3> = points.iter().map(|(x, y)| DVec3::new(*x, *y, 0.0)).collect();
    Arc::new(Curve::new(&points, kind, true).expect("a contour"))
}

fn square(half: f64) -> Arc<Curve> {
    contour(&[(half, half), (-half, half), (-half, -half), (half, -half)], CurveKind::Linear)
}

fn looks_outwards(part: &Part) -> bool {
    part.triangles.iter().all(|triangle| {
        let [a, b, c] = triangle.map(|corner| part.positions[corner as usize]);
        let face = (b - a).cross(c - a);
        triangle.iter().all(|&corner| face.dot(part.normals[corner as usize].vector()) > 0.0)
    })
}

#[test]
fn a_straight_axis_gives_a_prism() {
    for sides in [3, 8, 24] {
        let part = cylinder(&[0.0, 1.0, 4.0].map(|z| point(DVec3::Z * z, 0.5)), sides);
        assert!(check([&part]).is_solid() && looks_outwards(&part));
        assert!((volume([&part]) - polygon(sides)).abs() < 1e-5);
        let far = part.uvs.iter().map(|uv| uv.y).fold(0.0, f32::max);
        assert!((far - 4.0).abs() < 1e-6, "v is the length along the axis");
    }
}

#[test]
fn a_radius_that_changes_has_the_volume_of_its_integral() {
    let profile = [(0.0, 0.2), (1.0, 0.5), (2.0, 0.3), (3.0, 0.0)];
    let part = cylinder(&profile.map(|(z, radius)| point(DVec3::Z * z, radius)), 24);
    assert!(check([&part]).is_solid() && looks_outwards(&part));
    let radius = crate::Ramp::new(&profile.map(Into::into), crate::RampKind::Monotone).expect("a radius");
    let steps = 3000;
    let slice = |i: i32| radius.at(3.0 * (f64::from(i) + 0.5) / f64::from(steps)).powi(2) * polygon(24);
    let expected = (0..steps).map(slice).sum::<f64>() * 3.0 / f64::from(steps);
    assert!((volume([&part]) - expected).abs() < 0.01 * expected, "{} {expected}", volume([&part]));
}

#[test]
fn around_a_circle_the_volume_is_that_of_a_torus_and_the_seam_does_not_twist() {
    let angle = |i: usize| 1.5 * PI * i as f64 / 24.0;
    let circle = (0..=24).map(|i| point(DVec3::new(2.0 * angle(i).cos(), 2.0 * angle(i).sin(), 0.0), 0.3));
    let mut part = Part::default();
    generalized_cylinder(&mut part, circle.collect(), DVec3::Z, 16).expect("a cylinder");
    assert!(check([&part]).is_solid() && looks_outwards(&part));
    let expected = polygon(16) * 0.09 * 2.0 * 1.5 * PI;
    assert!((volume([&part]) - expected).abs() < 0.01 * expected, "{} {expected}", volume([&part]));
    // The seam, where u is smallest, stays on top.
    let seam = part.positions.iter().zip(&part.uvs).filter(|(_, uv)| uv.x < -0.93);
    assert!(seam.clone().count() > 20 && seam.clone().all(|(at, _)| (at.z - 0.3).abs() < 1e-5));
}

#[test]
fn a_square_contour_keeps_its_corners_and_its_flat_faces() {
    let points = [0.0, 2.0].map(|z| CylinderPoint { contour: Some(square(1.0)), ..point(DVec3::Z * z, 0.5) });
    let part = cylinder(&points, 6);
    assert!(check([&part]).is_solid() && looks_outwards(&part));
    assert!((volume([&part]) - 2.0).abs() < 1e-6, "{}", volume([&part]));
    let is_axis = |normal: Vec3| normal.abs().max_element() > 0.9999;
    assert!(part.normals.iter().all(|normal| is_axis(normal.vector())));
    let clockwise = contour(&[(1.0, -1.0), (-1.0, -1.0), (-1.0, 1.0), (1.0, 1.0)], CurveKind::Linear);
    let points = points.map(|point| CylinderPoint { contour: Some(Arc::clone(&clockwise)), ..point });
    let part = cylinder(&points, 6);
    assert!(check([&part]).is_solid() && (volume([&part]) - 2.0).abs() < 1e-6);
}

#[test]
fn contours_blend_along_the_axis() {
    let large = CylinderPoint { contour: Some(square(1.0)), ..point(DVec3::ZERO, 1.0) };
    let small = CylinderPoint { contour: Some(square(0.5)), ..point(DVec3::Z * 3.0, 1.0) };
    let part = cylinder(&[large, small.clone()], 8);
    assert!(check([&part]).is_solid() && looks_outwards(&part));
    // The edge is 2 - s(z / 3) with s(t) = t² (3 - 2t): the integral of (2 - s)² is 4 - 4 / 2 + 13 / 35.
    let expected = 3.0 * (4.0 - 2.0 + 13.0 / 35.0);
    assert!((volume([&part]) - expected).abs() < 0.02 * expected, "{} {expected}", volume([&part]));
    let round = point(DVec3::Z * 6.0, 0.5);
    let part = cylinder(&[small, round], 16);
    assert!(check([&part]).is_solid());
    let top: Vec<f32> =
        part.positions.iter().filter(|at| at.z > 5.999).map(|at| at.truncate().length()).collect();
    assert!(top.len() > 16 && top.iter().all(|radius| (radius - 0.5).abs() < 1e-5));
}

#[test]
fn a_surface_twists_to_the_sides_of_its_points_and_is_smooth_between_them() {
    let turned = |degrees: f64| DVec3::new(degrees.to_radians().cos(), degrees.to_radians().sin(), 0.0);
    // From the second to the third point, the shorter way crosses 180 degrees.
    let points = [(0.0, 0.0), (1.0, 60.0), (3.0, 200.0)].map(|(z, degrees)| CylinderPoint {
        contour: Some(square(1.0)),
        side: Some(turned(degrees)),
        ..point(DVec3::Z * z, 0.5)
    });
    let part = cylinder(&points, 4);
    assert!(check([&part]).is_solid());
    assert!((volume([&part]) - 3.0).abs() < 0.05, "{}", volume([&part]));
    // Angles (degrees) of a corner at each height, modulo a quarter turn.
    let corner = |z: f64| {
        let is_corner = |at: &&Vec3| (f64::from(at.z) - z).abs() < 1e-6 && at.truncate().length() > 0.707;
        let at = part.positions.iter().filter(is_corner);
        let angles = at.map(|at| f64::from(at.y).atan2(f64::from(at.x)).to_degrees() - 45.0);
        angles.map(|angle| angle.rem_euclid(90.0)).collect::<Vec<_>>()
    };
    for (z, expected) in [(0.0, 0.0), (1.0, 60.0), (3.0, 20.0)] {
        let found = corner(z);
        let near = |angle: &f64| (angle - expected).abs().min(90.0 - (angle - expected).abs()) < 1e-3;
        assert!(found.len() >= 4 && found.iter().all(near), "{found:?} at {z}");
    }
    let untwisted = points.clone().map(|point| CylinderPoint { side: Some(DVec3::X), ..point });
    let straight = points.map(|point| CylinderPoint { side: None, ..point });
    assert_eq!(cylinder(&untwisted, 4), cylinder(&straight, 4));
}

#[test]
fn points_at_one_position_count_once_and_one_point_draws_nothing() {
    let part = cylinder(&[point(DVec3::ZERO, 1.0)], 8);
    assert_eq!(part, Part::default());
    assert_eq!(cylinder(&[point(DVec3::ZERO, 0.0), point(DVec3::Z, 0.0)], 8), Part::default());
    let twice =
        [(0.0, 0.1), (0.0, 0.5), (2.0, 0.5), (2.0, 0.5)].map(|(z, radius)| point(DVec3::Z * z, radius));
    let part = cylinder(&twice, 8);
    assert!(check([&part]).is_solid() && (volume([&part]) - 0.5 * polygon(8)).abs() < 1e-5);
}

#[test]
fn numbers_that_are_not_finite_and_contours_that_cross_are_refused() {
    let mut part = Part::default();
    let nan = [point(DVec3::ZERO, 0.1), point(DVec3::new(0.0, f64::NAN, 1.0), 0.1)];
    let error = generalized_cylinder(&mut part, nan.to_vec(), DVec3::X, 8).expect_err("refused");
    insta::assert_snapshot!(error.to_string(), @r"
    a cylinder has a point at (0, NaN, 1) with a radius of 0.1
      help: give a position and a radius in metres, within 1e9 of the origin
    ");
    assert_eq!(part, Part::default());
    let refuse = |curve: Arc<Curve>| crate::check_contour(&curve).expect_err("refused").to_string();
    let bow = contour(&[(1.0, 1.0), (-1.0, -1.0), (-1.0, 1.0), (1.0, -1.0)], CurveKind::Linear);
    assert!(refuse(bow).starts_with("the contour: "));
    let high = [DVec3::X, DVec3::Y, DVec3::ONE];
    let high = Arc::new(Curve::new(&high, CurveKind::Linear, true).expect("a curve"));
    insta::assert_snapshot!(refuse(high), @r"
    the contour leaves the plane z = 0
      help: give points { x, y }
    ");
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 100, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn every_cylinder_is_closed_and_oriented(
        steps in prop::collection::vec(
            (-1.0f64..1.0, -1.0f64..1.0, -1.0f64..1.0, prop_oneof![0.0f64..0.4, Just(0.0)], 0usize..3, 0.0f64..12.0),
            2..10,
        ),
        sides in 3usize..12,
        far in 0.0f64..100.0,
    ) {
        let star: Vec<_> = (0..10)
            .map(|i| (TAU * f64::from(i) / 10.0, if i % 2 == 0 { 1.0 } else { 0.5 }))
            .map(|(angle, radius)| (radius * angle.cos(), radius * angle.sin()))
            .collect();
        let contours = [None, Some(square(0.8)), Some(contour(&star, CurveKind::Through))];
        let mut position = DVec3::splat(far);
        let points: Vec<CylinderPoint> = steps
            .into_iter()
            .map(|(x, y, z, radius, number, angle)| {
                position += DVec3::new(x, y, z);
                let side = (angle < TAU).then(|| DVec3::new(angle.cos(), angle.sin(), y));
                CylinderPoint { contour: contours[number].clone(), side, ..point(position, radius) }
            })
            .collect();
        let found = check([&cylinder(&points, sides)]);
        prop_assert!(found.is_solid(), "{found:?}");
    }
}
