//! Tests of roofs: over random plans, each closes its walls into a solid with the expected volume.

use super::super::skeleton::samples::{FAMILIES, Random, mixed};
use super::super::skeleton::tests::plan;
use super::super::skeleton::{Pace, Skeleton};
use super::super::solid;
use super::shape::Profile;
use super::*;
use crate::planar::{Polygon, Ring, edges};
use burgeon_scene::Part;
use glam::{DVec2, DVec3};

pub(super) const HEIGHT: f64 = 3.0;
pub(super) const BENT: &[(f64, f64)] = &[(0.3, 0.1), (0.6, 0.7)];

/// Returns walls of 3 m over a floor, with `cover` on them.
pub(super) fn building(walls: &Polygon, cover: &RoofCover) -> Part {
    let mut part = Part::default();
    let mut add = |rings: &[Ring<DVec3>]| {
        let right = rings[0][1] - rings[0][0];
        fill(&mut part, rings, right, rings[0][0]).expect("a flat face");
    };
    add(&floor(walls, 0.0));
    for [a, b] in walls.edges() {
        let wall = vec![a.extend(0.0), b.extend(0.0), b.extend(HEIGHT), a.extend(HEIGHT)];
        add(&[Ring::new(wall).expect("a wall")]);
    }
    for patch in &cover.patches {
        add(&patch.rings);
    }
    part
}

/// Returns walls with this outline.
pub(super) fn around(corners: &[(f64, f64)]) -> Polygon {
    Polygon::new(vec![corners.iter().copied().map(DVec2::from).collect()]).expect("a polygon")
}

/// Returns the volume (m³) below the faces of a hip roof, by clipping them at the bends of the profile.
fn volume_below(walls: &Polygon, shape: &RoofShape) -> f64 {
    let paces = vec![Pace::default(); walls.size()];
    let skeleton = Skeleton::for_mesh(walls, &paces).expect("a skeleton");
    let profile = Profile::new(shape, skeleton.duration(), 0.0);
    let mut volume = 0.0;
    for face in &skeleton.faces {
        let corners: Vec<DVec3> =
            face.iter().map(|&peak| skeleton.peaks[peak].at.extend(skeleton.peaks[peak].time)).collect();
        for (index, pair) in profile.corners.windows(2).enumerate() {
            let above = clipped(&corners, pair[0].x, 1.0);
            let last = index + 2 == profile.corners.len();
            let band = if last { above } else { clipped(&above, pair[1].x, -1.0) };
            let slope = (pair[1].y - pair[0].y) / (pair[1].x - pair[0].x);
            for [b, c] in band.windows(2).skip(1).map(|pair| [pair[0], pair[1]]) {
                let a = band[0];
                let area = (b - a).truncate().perp_dot((c - a).truncate()) / 2.0;
                volume += area * (pair[0].y + slope * ((a.z + b.z + c.z) / 3.0 - pair[0].x));
            }
        }
    }
    volume
}

/// Returns the integral (m³) of the height over all upward faces, and their horizontal area (m²).
fn integral(cover: &RoofCover) -> (f64, f64) {
    let (mut volume, mut covered) = (0.0, 0.0);
    for patch in &cover.patches {
        let triangles = patch
            .rings
            .iter()
            .flat_map(|ring| (2..ring.len()).map(move |corner| [ring[0], ring[corner - 1], ring[corner]]));
        let parts = triangles.map(|[a, b, c]| {
            let area = (b - a).truncate().perp_dot((c - a).truncate()) / 2.0;
            (area * (a.z + b.z + c.z) / 3.0, area)
        });
        let (part, area) = parts.fold((0.0, 0.0), |sum, part| (sum.0 + part.0, sum.1 + part.1));
        if area > 0.0 {
            (volume, covered) = (volume + part, covered + area);
        }
    }
    (volume, covered)
}

/// Returns the part of a ring on one side of a level.
fn clipped(ring: &[DVec3], level: f64, side: f64) -> Vec<DVec3> {
    let mut kept = Vec::new();
    for [a, b] in edges(ring) {
        let [from, to] = [a, b].map(|point| side * (point.z - level));
        if from >= 0.0 {
            kept.push(a);
        }
        if (from < 0.0) != (to < 0.0) {
            kept.push(a.lerp(b, from / (from - to)));
        }
    }
    kept
}

/// Returns the maximum overhang (m) of the roof.
fn greatest(cover: &RoofCover) -> f64 {
    cover.overhangs.iter().copied().fold(0.0, f64::max)
}

fn in_row<'a>(walls: &'a Polygon, party: &'a [usize]) -> Support<'a> {
    Support { party, ..Support::new(walls, HEIGHT) }
}

fn shape(surface: RoofSurface, eaves: Eaves, overhang: f64, slab: f64) -> RoofShape {
    RoofShape { surface, rise: Rise::Slope(0.7), overhang, eaves, slab }
}

#[test]
fn roofs_of_every_shape_close_thousands_of_random_plans() {
    let border = Border { height: 0.5, width: 0.3 };
    let surfaces = [
        RoofSurface::Flat(None),
        RoofSurface::Flat(Some(border)),
        RoofSurface::Shed,
        RoofSurface::Sloped(Ends::Hips, &[]),
        RoofSurface::Sloped(Ends::Hips, BENT),
        RoofSurface::Sloped(Ends::Gables, &[]),
        RoofSurface::Sloped(Ends::Gables, BENT),
        RoofSurface::Sloped(Ends::DutchHips, &[]),
    ];
    let eaves = [(Eaves::Closed, 0.0), (Eaves::Slab, 0.2), (Eaves::Open, 0.15)];
    let mut random = Random(11);
    let (mut count, mut hipped, mut flush) = (0, 0, 0);
    for round in 0..6000 {
        let Some(walls) = plan(&mixed(round, &mut random)) else { continue };
        let (surface, overhang) = (surfaces[round % 8], [0.0, 0.3, 0.8][round / 8 % 3]);
        let (eaves, slab) = eaves[round / 24 % 3];
        let thin = matches!(surface, RoofSurface::Flat(_)) && overhang > 0.0;
        let shape = shape(surface, eaves, overhang, if thin { 0.15 } else { slab });
        let cover = shape.cover(&walls, HEIGHT).unwrap_or_else(|error| panic!("{round}: {error}"));
        let part = building(&walls, &cover);
        let check = solid::check([&part]);
        assert!(check.is_solid(), "{round}: {shape:?} {check:?} {walls:?}");
        let volume = solid::volume([&part]);
        let plain = walls.area() * HEIGHT;
        assert!(volume > plain - 1e-3, "{round}: {volume} m³ of {plain} m³");
        if greatest(&cover) == 0.0 {
            // The walls enclose the volume below the surface of the roof.
            let (below, covered) = integral(&cover);
            // Corners where faces meet at nearly one point may be off by a millimetre.
            let whole = walls.area();
            assert!((covered - whole).abs() < 1e-5 * whole.max(1.0), "{round}: {covered} of {whole} m²");
            assert!((volume - below).abs() < 1e-3 * below, "{round}: {volume} m³, not {below} m³");
            flush += 1;
        }
        if let (RoofSurface::Sloped(Ends::Hips, _), true) = (surface, greatest(&cover) == 0.0) {
            let expected = plain + volume_below(&walls, &RoofShape { overhang: 0.0, ..shape });
            assert!((volume - expected).abs() < 1e-3 * expected, "{round}: {volume} m³, not {expected} m³");
        }
        hipped += u32::from(cover.hipped);
        count += 1;
    }
    assert!(count > 5000 && flush > 1600, "{count}, {flush} without an overhang");
    assert!(hipped < 20, "{hipped}");
}

#[test]
fn hip_roofs_over_regular_plans_with_noise_are_closed_and_no_edge_has_four_faces() {
    for family in &FAMILIES {
        let mut random = Random(29);
        let plans: Vec<_> = (0..100).filter_map(|_| plan(&(family.make)(&mut random))).collect();
        assert!(plans.len() > 80, "{}", family.name);
        for walls in plans {
            let roof = shape(RoofSurface::Sloped(Ends::Hips, &[]), Eaves::Closed, 0.0, 0.0);
            let cover = roof.cover(&walls, HEIGHT).unwrap_or_else(|error| panic!("{}: {error}", family.name));
            let part = building(&walls, &cover);
            let check = solid::check([&part]);
            assert!(check.is_solid(), "{}: {check:?} {walls:?}", family.name);
            let key = |corner: u32| {
                (part.positions[corner as usize] + glam::Vec3::ZERO).to_array().map(f32::to_bits)
            };
            let mut uses = std::collections::BTreeMap::new();
            for triangle in part.triangles.iter() {
                for side in 0..3 {
                    let [a, b] = [triangle[side], triangle[(side + 1) % 3]].map(key);
                    *uses.entry([a.min(b), a.max(b)]).or_insert(0) += 1;
                }
            }
            assert!(uses.values().all(|uses| *uses == 2), "{}: {walls:?}", family.name);
        }
    }
}

#[test]
fn every_end_of_a_wing_has_a_gable_however_the_plan_is_turned() {
    type Corners = &'static [(f64, f64)];
    let plans: [(&str, usize, Corners); 6] = [
        ("rectangle", 2, &[(0., 0.), (12., 0.), (12., 7.), (0., 7.)]),
        ("skew", 2, &[(0., 0.), (12., 0.4), (12.6, 7.), (-0.3, 7.2)]),
        ("L", 2, &[(0., 0.), (12., 0.), (12., 5.), (5., 5.), (5., 12.), (0., 12.)]),
        ("T", 3, &[(0., 8.), (6., 8.), (6., 0.), (12., 0.), (12., 8.), (18., 8.), (18., 15.), (0., 15.)]),
        ("U", 2, &[(0., 0.), (18., 0.), (18., 12.), (13., 12.), (13., 5.), (5., 5.), (5., 12.), (0., 12.)]),
        (
            "cross",
            4,
            &[
                (5., 0.),
                (11., 0.),
                (11., 5.),
                (16., 5.),
                (16., 11.),
                (11., 11.),
                (11., 16.),
                (5., 16.),
                (5., 11.),
                (0., 11.),
                (0., 5.),
                (5., 5.),
            ],
        ),
    ];
    for (name, ends, corners) in plans {
        for step in 0..12 {
            let turn = DVec2::from_angle(0.31 * f64::from(step));
            let walls =
                Polygon::new(vec![corners.iter().map(|&corner| turn.rotate(DVec2::from(corner))).collect()]);
            let walls = walls.expect("a polygon");
            for eaves in [Eaves::Closed, Eaves::Open] {
                let shape = shape(RoofSurface::Sloped(Ends::Gables, &[]), eaves, 0.5, 0.1);
                let shape = if eaves == Eaves::Closed { RoofShape { slab: 0.0, ..shape } } else { shape };
                let cover = shape.cover(&walls, HEIGHT).expect("a roof");
                let gables = cover.patches.iter().filter(|patch| patch.kind == PatchKind::Gable).count();
                assert_eq!(
                    (gables, cover.hipped, greatest(&cover)),
                    (ends, false, 0.5),
                    "{name} {step} {eaves:?}"
                );
                let ridges =
                    lines(&cover.patches).iter().filter(|line| line.kind == RoofLineKind::Ridge).count();
                assert!(ridges >= ends.div_ceil(2), "{name}: {ridges} ridges");
            }
        }
    }
}

#[test]
fn open_eaves_of_a_gable_roof_have_the_volume_of_a_plate_beyond_the_walls() {
    let walls = around(&[(0., 0.), (10., 0.), (10., 6.), (0., 6.)]);
    let open = RoofShape {
        rise: Rise::Height(3.0),
        ..shape(RoofSurface::Sloped(Ends::Gables, &[]), Eaves::Open, 0.5, 0.2)
    };
    let cover = open.cover(&walls, HEIGHT).expect("a roof");
    // A slope of 1 over walls of 6 m is flatter beyond them, so the plate is 0.2 m high everywhere.
    let expected = 60.0 * HEIGHT + 10.0 * 6.0 * 3.0 / 2.0 + 11.0 * 7.0 * 0.2;
    let volume = solid::volume([&building(&walls, &cover)]);
    assert!((volume - expected).abs() < 1e-3, "{volume} m³, not {expected} m³");
}

#[test]
fn a_roof_of_one_slope_is_as_high_as_a_gable_roof_of_the_same_slope() {
    let walls = around(&[(0., 0.), (10., 0.), (10., 6.), (0., 6.)]);
    let highest = |surface| {
        let cover = shape(surface, Eaves::Closed, 0.0, 0.0).cover(&walls, 0.0).expect("a roof");
        cover.patches.iter().flat_map(|patch| &patch.rings).flatten().map(|point| point.z).fold(0.0, f64::max)
    };
    let [shed, gable] = [RoofSurface::Shed, RoofSurface::Sloped(Ends::Gables, &[])].map(highest);
    assert!((shed - gable).abs() < 1e-9 && (shed - 2.1).abs() < 1e-9, "{shed} m and {gable} m");
}

#[test]
fn a_house_in_a_row_has_gables_along_its_neighbours() {
    // Wider than deep, where a gable roof without neighbours has the same gables; and deeper than wide.
    for (width, depth) in [(10.0, 6.0), (6.0, 10.0)] {
        let walls = around(&[(0., 0.), (width, 0.), (width, depth), (0., depth)]);
        for surface in [
            RoofSurface::Sloped(Ends::Gables, &[]),
            RoofSurface::Sloped(Ends::Hips, &[]),
            RoofSurface::Sloped(Ends::Hips, &[(0.25, 0.7)]),
        ] {
            let roof = shape(surface, Eaves::Closed, 0.0, 0.0);
            let cover = roof.cover_on(&in_row(&walls, &[1, 3])).expect("a roof");
            let gables: std::collections::BTreeSet<usize> = cover
                .patches
                .iter()
                .filter(|patch| patch.kind == PatchKind::Gable)
                .map(|patch| patch.edge)
                .collect();
            assert_eq!(gables.into_iter().collect::<Vec<_>>(), [1, 3], "{width} m x {depth} m");
            assert!(solid::check([&building(&walls, &cover)]).is_solid(), "{width} m x {depth} m");
        }
    }
}

#[test]
fn a_gable_that_would_go_on_beyond_its_wall_is_left_out_alone() {
    let gables = |cover: &RoofCover| -> std::collections::BTreeSet<usize> {
        cover.patches.iter().filter(|patch| patch.kind == PatchKind::Gable).map(|patch| patch.edge).collect()
    };
    // Over the wall at the top left the slopes would meet beyond its end, because the wall next to it is
    // short.
    let corners = [(1.7, -5.5), (5.9, 0.8), (5.0, 1.4), (-1.6, 6.0), (-6.0, -0.4)];
    let walls = around(&corners);
    let roof = shape(RoofSurface::Sloped(Ends::Hips, &[]), Eaves::Closed, 0.0, 0.0);
    let cover = roof.cover_on(&in_row(&walls, &[2, 4])).expect("a roof");
    assert!(solid::check([&building(&walls, &cover)]).is_solid());
    assert_eq!(gables(&cover).into_iter().collect::<Vec<_>>(), [4]);
}

#[test]
fn a_roof_of_one_slope_juts_out_over_its_eaves_as_it_is_asked_to() {
    let walls = around(&[(0., 0.), (10., 0.), (10., 6.), (0., 6.)]);
    for (eaves, slab, overhang, wedge, lowest) in [
        // From the outline of the eaves up to 2 m over the longest edge, next to flush gables.
        (Eaves::Closed, 0.0, 0.5, 10.0 * 6.5 * 2.0 / 2.0, HEIGHT),
        (Eaves::Slab, 0.2, 0.5, 10.0 * 6.5 * (2.0 / 2.0 + 0.2), HEIGHT),
        // From the walls up to 2 m, with a plate on top that has an overhang everywhere.
        (Eaves::Open, 0.2, 0.5, 10.0 * 6.0 * 2.0 / 2.0 + 11.0 * 7.0 * 0.2, HEIGHT - 0.5 / 3.0),
        (Eaves::Slab, 0.2, 0.0, 10.0 * 6.0 * (2.0 / 2.0 + 0.2), HEIGHT),
    ] {
        let roof = RoofShape { rise: Rise::Height(2.0), ..shape(RoofSurface::Shed, eaves, overhang, slab) };
        let cover = roof.cover(&walls, HEIGHT).expect("a roof");
        let part = building(&walls, &cover);
        let check = solid::check([&part]);
        assert!(check.is_solid(), "{eaves:?}: {check:?}");
        let (volume, expected) = (solid::volume([&part]), 60.0 * HEIGHT + wedge);
        assert!((volume - expected).abs() < 1e-3, "{eaves:?}: {volume} m³, not {expected} m³");
        let beyond = cover.patches.iter().flat_map(|patch| &patch.rings).flatten().filter(|at| at.y > 6.01);
        let least = beyond.map(|at| at.z).fold(f64::INFINITY, f64::min);
        assert!(overhang == 0.0 || (least - lowest).abs() < 1e-6, "{eaves:?}: the eaves are at {least} m");
    }
}

#[test]
fn gables_along_neighbours_end_with_their_walls_and_close_random_plans() {
    let mut random = Random(5);
    let (mut count, mut gables) = (0, 0);
    for round in 0..2000 {
        let Some(walls) = plan(&mixed(round, &mut random)) else { continue };
        let ends: Vec<[DVec2; 2]> = walls.edges().collect();
        let party: Vec<usize> = (0..ends.len()).filter(|_| random.next() < 0.25).collect();
        let kind = [Ends::Hips, Ends::Gables][round / 2 % 2];
        let roof = shape(RoofSurface::Sloped(kind, &[]), Eaves::Closed, 0.0, 0.0);
        let cover = roof.cover_on(&in_row(&walls, &party));
        let cover = cover.unwrap_or_else(|error| panic!("{round}: {error}: {party:?} {walls:?}"));
        let part = building(&walls, &cover);
        let check = solid::check([&part]);
        assert!(check.is_solid(), "{round}: {party:?} {check:?} {walls:?}");
        let (below, covered) = integral(&cover);
        let (volume, whole) = (solid::volume([&part]), walls.area());
        // Short borders of the skeleton are omitted.
        let slack = 1e-3 * ends.iter().map(|[a, b]| a.distance(*b)).sum::<f64>();
        assert!((covered - whole).abs() < slack, "{round}: {covered} of {whole} m²");
        assert!((volume - below).abs() < 1e-3 * below, "{round}: {volume} m³, not {below} m³");
        for patch in cover.patches.iter().filter(|patch| patch.kind == PatchKind::Gable) {
            let [a, b] = ends[patch.edge];
            for at in patch.rings.iter().flatten() {
                let along = patch.along.dot(at.truncate() - a);
                assert!((-0.06..a.distance(b) + 0.06).contains(&along), "{round}: {party:?} {walls:?}");
            }
            gables += 1;
        }
        count += 1;
    }
    assert!(count > 1600 && gables > 2000, "{count}, {gables} gables");
}

#[test]
fn only_the_edges_of_a_narrow_recess_give_way() {
    let corners = [(0., 0.), (5., 0.), (5., 2.), (5.4, 2.), (5.4, 0.), (12., 0.), (12., 8.), (0., 8.)];
    let walls = around(&corners);
    for eaves in [Eaves::Closed, Eaves::Slab, Eaves::Open] {
        let cover = shape(RoofSurface::Sloped(Ends::Hips, &[]), eaves, 0.5, 0.1)
            .cover(&walls, HEIGHT)
            .expect("a roof");
        assert_eq!(cover.overhangs, [0.5, 0.18, 0.18, 0.18, 0.5, 0.5, 0.5, 0.5], "{eaves:?}");
        assert_eq!(cover.tight, [1, 2, 3]);
        assert!(solid::check([&building(&walls, &cover)]).is_solid(), "{eaves:?}");
    }
}
