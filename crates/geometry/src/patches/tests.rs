//! Tests of surfaces: known shapes, derivatives, mixtures, meshes and refusals.

use std::f64::consts::{FRAC_PI_2, PI};

use burgeon_scene::Part;
use glam::{DAffine3, DVec3};
use proptest::prelude::*;

use super::surface::{SplineSurface, SurfaceGrid, SurfaceKind};
use crate::solid::{area, check};

fn grid(rows: &[&[[f64; 3]]]) -> SurfaceGrid {
    let points = rows.iter().map(|row| row.iter().map(|at| DVec3::from_array(*at)).collect()).collect();
    SurfaceGrid { points, ..SurfaceGrid::default() }
}

/// Quarter of a cylinder around z, with radius 1 and height 2: exact with NURBS of degree 2.
fn quarter() -> SplineSurface {
    let ring = |z: f64| [[1.0, 0.0, z], [1.0, 1.0, z], [0.0, 1.0, z]];
    let weights = vec![1.0, 0.5f64.sqrt(), 1.0];
    let grid = SurfaceGrid { weights: Some(vec![weights; 2]), ..grid(&[&ring(0.0), &ring(2.0)]) };
    SplineSurface::new(SurfaceKind::Nurbs, grid).expect("a quarter")
}

/// Patches of `sizes` points over a plane with bumps.
fn bumps(kind: SurfaceKind, sizes: [usize; 2], height: f64) -> SplineSurface {
    let point = |i: usize, j: usize| {
        let [x, y] = [i as f64 / (sizes[0] - 1) as f64, j as f64 / (sizes[1] - 1) as f64];
        DVec3::new(x, y, height * ((7.0 * x).sin() + (5.0 * y).cos()))
    };
    let points = (0..sizes[1]).map(|j| (0..sizes[0]).map(|i| point(i, j)).collect()).collect();
    SplineSurface::new(kind, SurfaceGrid { points, ..SurfaceGrid::default() }).expect("a surface")
}

#[test]
fn a_quarter_of_a_cylinder_is_exact() {
    let quarter = quarter();
    for i in 0..=20 {
        for j in 0..=4 {
            let (u, v) = (f64::from(i) / 20.0, f64::from(j) / 4.0);
            let (at, normal) = (quarter.point(u, v), quarter.normal(u, v));
            assert!((at.truncate().length() - 1.0).abs() < 1e-12 && (at.z - 2.0 * v).abs() < 1e-12);
            assert!(normal.distance(at.truncate().extend(0.0)) < 1e-9, "it looks outwards");
        }
    }
    let mut part = Part::default();
    quarter.draw(&mut part, &DAffine3::IDENTITY, 64).expect("triangles");
    assert!((area([&part]) - FRAC_PI_2 * 2.0).abs() < 1e-3);
}

#[test]
fn a_bezier_patch_passes_its_corners_and_has_the_middle_of_its_definition() {
    let patch = bumps(SurfaceKind::Bezier, [4, 4], 1.0);
    let points: Vec<DVec3> = patch.points.clone();
    for (u, v, index) in [(0.0, 0.0, 0), (1.0, 0.0, 3), (0.0, 1.0, 12), (1.0, 1.0, 15)] {
        assert!(patch.point(u, v).distance(points[index]) < 1e-12);
    }
    let weights = [1.0, 3.0, 3.0, 1.0];
    let expected: DVec3 = (0..16).map(|i| points[i] * (weights[i % 4] * weights[i / 4] / 64.0)).sum();
    assert!(patch.point(0.5, 0.5).distance(expected) < 1e-12);
}

#[test]
fn joined_patches_have_no_gap_and_a_b_spline_has_no_edge() {
    for (kind, sizes) in [(SurfaceKind::Bezier, [7, 10]), (SurfaceKind::BSpline, [6, 9])] {
        let surface = bumps(kind, sizes, 0.5);
        for knot in surface.bases[0].breaks() {
            let (before, after) = (surface.point(knot - 1e-9, 0.3), surface.point(knot + 1e-9, 0.3));
            assert!(before.distance(after) < 1e-7);
            let turn = surface.normal(knot - 1e-9, 0.3).distance(surface.normal(knot + 1e-9, 0.3));
            assert!(kind == SurfaceKind::Bezier || turn < 1e-6);
        }
    }
}

#[test]
fn a_mixture_has_the_mixed_points() {
    let (young, mature) = (bumps(SurfaceKind::Bezier, [7, 4], 0.1), bumps(SurfaceKind::Bezier, [7, 4], 1.0));
    let other = bumps(SurfaceKind::BSpline, [5, 6], 1.0);
    for (with, slack) in [(&mature, 1e-12), (&other, 2e-3)] {
        let half = young.mix(with, 0.3).expect("a surface");
        for i in 0..=10 {
            let (u, v) = (f64::from(i) / 10.0, f64::from(i * i) / 100.0);
            let expected = young.point(u, v) * 0.7 + with.point(u, v) * 0.3;
            assert!(half.point(u, v).distance(expected) < slack, "{}", half.point(u, v).distance(expected));
        }
    }
    assert_eq!(young.mix(&mature, 0.0).expect("the first"), young);
    // A rational surface of constant points stays on the cylinder.
    let twice = quarter().mix(&quarter(), 0.5).expect("a quarter");
    assert!((twice.point(0.3, 0.5).truncate().length() - 1.0).abs() < 1e-12);
}

#[test]
fn a_leaf_that_ends_in_a_point_has_no_triangle_without_area_and_sound_normals() {
    let row = |y: f64, width: f64| {
        [[-width, y, 0.0], [-width / 3.0, y, 0.0], [width / 3.0, y, 0.0], [width, y, 0.0]]
    };
    let leaf = grid(&[&row(0.0, 0.0), &row(0.4, 0.5), &row(0.8, 0.4), &row(1.2, 0.0)]);
    let leaf = SplineSurface::new(SurfaceKind::Bezier, leaf).expect("a leaf");
    let mut part = Part::default();
    leaf.draw(&mut part, &DAffine3::IDENTITY, 8).expect("triangles");
    let found = check([&part]);
    assert!(found.zero_area == 0 && found.inconsistent.is_empty() && found.not_finite == 0);
    assert_eq!(part.triangles.len(), 8 * 8 * 2 - 2 * 8);
    assert!(part.normals.iter().all(|normal| normal.vector().z > 0.999));
    assert!(part.uvs.iter().all(|uv| (0.0..=1.0).contains(&uv.x) && (0.0..=1.0).contains(&uv.y)));
    let mut mirrored = Part::default();
    leaf.draw(&mut mirrored, &DAffine3::from_scale(DVec3::new(-1.0, 1.0, 1.0)), 8).expect("triangles");
    assert!(mirrored.normals.iter().all(|normal| normal.vector().z < -0.999));
}

#[test]
fn surfaces_that_do_not_fit_are_refused_with_a_remedy() {
    let refuse = |kind, grid| SplineSurface::new(kind, grid).expect_err("refused").to_string();
    let flat = |width: usize, height: usize| {
        let row: Vec<DVec3> = (0..width).map(|i| DVec3::X * i as f64).collect();
        SurfaceGrid { points: vec![row; height], ..SurfaceGrid::default() }
    };
    insta::assert_snapshot!(refuse(SurfaceKind::Bezier, SurfaceGrid::default()), @r"
    a surface needs at least 2 rows of 2 points, not 0 of 0
      help: give rows of points: points = { { vec(...), ... }, { vec(...), ... }, ... }
    ");
    insta::assert_snapshot!(refuse(SurfaceKind::Bezier, flat(4, 5)), @r"
    Bezier patches do not have 5 rows of 4 points
      help: a patch has 4 rows of 4 points, and each further patch 3 more rows or columns: 4, 7, 10
    ");
    let mut ragged = flat(4, 4);
    ragged.points[2].pop();
    insta::assert_snapshot!(refuse(SurfaceKind::Bezier, ragged), @r"
    row 3 has 3 points, but row 1 has 4
      help: give as many points in each row
    ");
    insta::assert_snapshot!(refuse(SurfaceKind::Nurbs, flat(4, 4)), @r#"
    NURBS need weights
      help: give weights, one number for each point, or write kind = "b-spline"
    "#);
    let weights = Some(vec![vec![1.0, 1.0, 0.0, 1.0]; 4]);
    insta::assert_snapshot!(refuse(SurfaceKind::Nurbs, SurfaceGrid { weights, ..flat(4, 4) }), @r"
    a weight is 0
      help: give weights above 0, up to 1e9
    ");
    let mut infinite = flat(4, 4);
    infinite.points[1][2].y = f64::NAN;
    insta::assert_snapshot!(refuse(SurfaceKind::BSpline, infinite), @r"
    point 3 of row 2 is not within 1e9 m of the origin
      help: give finite coordinates in metres
    ");
    let degree = SurfaceGrid { degree: Some(9), ..flat(12, 12) };
    assert!(refuse(SurfaceKind::BSpline, degree).contains("the degree must be from 1 to 7, not 9"));
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 100, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn derivatives_agree_with_differences(
        heights in prop::collection::vec(-1.0f64..1.0, 42),
        weights in prop::collection::vec(0.2f64..5.0, 42),
        degree in 1usize..6,
        u in 0.01f64..0.99,
        v in 0.01f64..0.99,
    ) {
        let at = |i: usize, j: usize| DVec3::new(i as f64, j as f64, heights[j * 7 + i]);
        let points = (0..6).map(|j| (0..7).map(|i| at(i, j)).collect()).collect();
        let weights = weights.chunks(7).map(<[f64]>::to_vec).collect();
        let grid =
            SurfaceGrid { points, weights: Some(weights), degree: Some(degree), ..SurfaceGrid::default() };
        let surface = SplineSurface::new(SurfaceKind::Nurbs, grid).expect("a surface");
        let h = 1e-6;
        let breaks = surface.bases.each_ref().map(|basis| basis.breaks());
        // Across a knot of degree 1, the difference is that of two patches.
        let near = |breaks: &[f64], t: f64| breaks.iter().any(|knot| (knot - t).abs() < 2.0 * h);
        prop_assume!(!near(&breaks[0], u) && !near(&breaks[1], v));
        let [_, along_u, along_v] = surface.derivatives(u, v);
        let by_u = (surface.point(u + h, v) - surface.point(u - h, v)) / (2.0 * h);
        let by_v = (surface.point(u, v + h) - surface.point(u, v - h)) / (2.0 * h);
        prop_assert!(along_u.distance(by_u) < 1e-5 * (1.0 + by_u.length()), "{along_u} {by_u}");
        prop_assert!(along_v.distance(by_v) < 1e-5 * (1.0 + by_v.length()), "{along_v} {by_v}");
        prop_assert!((surface.normal(u, v).length() - 1.0).abs() < 1e-9);
        prop_assert!(surface.normal(u, v).z > 0.0, "a surface over a plane looks up");
        prop_assert!(surface.point(u, v).z.abs() <= 1.0, "within the hull of its points");
    }
}

#[test]
fn pi_is_the_area_of_a_half_cylinder_of_two_quarters() {
    // Two quarters with a double knot between them: x² + y² = 1 over the half circle, height 1.
    let ring = |z: f64| [[1.0, 0.0, z], [1.0, 1.0, z], [0.0, 1.0, z], [-1.0, 1.0, z], [-1.0, 0.0, z]];
    let weights = vec![1.0, 0.5f64.sqrt(), 1.0, 0.5f64.sqrt(), 1.0];
    let half = SurfaceGrid {
        weights: Some(vec![weights; 2]),
        degree: Some(2),
        knots: [Some(vec![0.0, 0.0, 0.0, 1.0, 1.0, 2.0, 2.0, 2.0]), None],
        ..grid(&[&ring(0.0), &ring(1.0)])
    };
    let half = SplineSurface::new(SurfaceKind::Nurbs, half).expect("a half");
    let mut part = Part::default();
    half.draw(&mut part, &DAffine3::IDENTITY, 64).expect("triangles");
    assert!((area([&part]) - PI).abs() < 1e-3);
    assert!((0..=16).all(|i| (half.point(f64::from(i) / 16.0, 0.5).truncate().length() - 1.0).abs() < 1e-12));
}
