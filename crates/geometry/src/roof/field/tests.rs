//! Tests of roofs over cells: over random plans with holes, each closes its walls into a solid with the expected volume.

use glam::DVec2;

use super::super::fill::FilledPolygon;
use super::super::tests::{HEIGHT, around, building};
use super::super::{Eaves, Rise, RoofCover, RoofShape, RoofSurface};
use super::{FieldRoof, RidgeAxis};
use crate::planar::{Polygon, contains};
use crate::skeleton::samples::{Random, mixed};
use crate::skeleton::tests::plan;
use crate::solid;

const BENDS: &[(f64, f64)] = &[(0.36, 0.64)];

const FORMS: [FieldRoof; 15] = [
    FieldRoof::Gable(&[]),
    FieldRoof::Gable(BENDS),
    FieldRoof::Shed,
    FieldRoof::Saltbox,
    FieldRoof::Round,
    FieldRoof::Butterfly,
    FieldRoof::Clerestory,
    FieldRoof::Sawtooth { slope: 0.7 },
    FieldRoof::CrossGable,
    FieldRoof::SideHip,
    FieldRoof::SideHalfHip,
    FieldRoof::Gablet,
    FieldRoof::Pyramid,
    FieldRoof::Dome,
    FieldRoof::Onion,
];

fn roof(form: FieldRoof, axis: RidgeAxis, overhang: f64) -> RoofShape {
    let surface = RoofSurface::Field(form, axis);
    let slab = if overhang > 0.0 { 0.15 } else { 0.0 };
    RoofShape { surface, rise: Rise::Height(4.0), overhang, eaves: Eaves::Open, slab }
}

/// Returns the volume (m³) of a roof over the walls.
fn volume(walls: &Polygon, roof: &RoofShape) -> f64 {
    let cover = roof.cover(walls, HEIGHT).expect("a roof");
    let part = building(walls, &cover);
    let check = solid::check([&part]);
    assert!(check.is_solid(), "{roof:?}: {check:?}");
    solid::volume([&part]) - walls.area() * HEIGHT
}

fn highest(cover: &RoofCover) -> f64 {
    cover.patches.iter().flat_map(|patch| &patch.rings).flatten().map(|at| at.z).fold(0.0, f64::max)
}

/// Returns a plan with a square hole, if there is room in the middle.
fn with_hole(walls: Polygon) -> Polygon {
    let parts = walls.inset(1.0);
    let Some(ring) = parts.first().and_then(|part| part.outer()) else { return walls };
    let [low, high] = ring.bounds();
    let middle = low.midpoint(high);
    let hole: Vec<DVec2> =
        [(-0.6, -0.5), (-0.5, 0.6), (0.7, 0.5), (0.5, -0.6)].map(|at| middle + DVec2::from(at)).to_vec();
    if walls.holes().is_empty() && hole.iter().all(|at| contains(ring, *at)) {
        let rings: Vec<Vec<DVec2>> = vec![walls.outer().expect("a ring").to_vec(), hole];
        return Polygon::new(rings).expect("a polygon");
    }
    walls
}

#[test]
fn every_form_closes_random_plans_with_holes_below_its_height() {
    let mut random = Random(23);
    let (mut count, mut holes) = (0, 0);
    for round in 0..1800 {
        let Some(walls) = plan(&mixed(round, &mut random)) else { continue };
        let walls = if round % 2 == 0 { with_hole(walls) } else { walls };
        holes += usize::from(!walls.holes().is_empty());
        let axis = match round / 15 % 3 {
            0 => RidgeAxis::Along,
            1 => RidgeAxis::Across,
            _ => RidgeAxis::Facing { down: DVec2::from_angle(round as f64), snap: 0.1 },
        };
        let form = FORMS[round % 15];
        let shape = roof(form, axis, [0.0, 0.4][round / 45 % 2]);
        let cover = shape.cover(&walls, HEIGHT).unwrap_or_else(|error| panic!("{round}: {error}"));
        let part = building(&walls, &cover);
        let check = solid::check([&part]);
        assert!(check.is_solid(), "{round}: {shape:?} {check:?} {walls:?}");
        let above = solid::volume([&part]) - walls.area() * HEIGHT;
        if shape.overhang == 0.0 {
            let most = walls.hull().expect("a hull").area() * 4.0 * 1.2;
            assert!(above > -1e-3 && above < most, "{round}: {form:?} {above} m³, at most {most} m³");
        }
        // Slopes that rise continue to rise beyond the walls.
        let top = highest(&cover) - HEIGHT;
        assert!(shape.overhang > 0.0 || top < 4.0 + 1e-9, "{round}: {form:?} is {top} m high");
        count += 1;
    }
    assert!(count > 1500 && holes > 200, "{count}, {holes} with holes");
}

#[test]
fn roofs_of_a_box_have_their_known_volumes_and_heights() {
    let walls = around(&[(0., 0.), (12., 0.), (12., 8.), (0., 8.)]);
    let (box_volume, facing) = (12.0 * 8.0 * 4.0, RidgeAxis::Facing { down: DVec2::X, snap: 0.0 });
    let arc = {
        let radius: f64 = 4.0;
        // Twelve chords of a half circle.
        let angle = std::f64::consts::PI / 12.0;
        12.0 * (radius * radius * angle.sin() / 2.0) * 12.0
    };
    for (form, axis, share) in [
        (FieldRoof::Gable(&[]), RidgeAxis::Along, 0.5),
        (FieldRoof::Gable(&[]), RidgeAxis::Across, 0.5),
        (FieldRoof::Gable(BENDS), RidgeAxis::Along, 0.36 * 0.32 + 0.64 * 0.82),
        (FieldRoof::Shed, facing, 0.5),
        (FieldRoof::Saltbox, RidgeAxis::Along, 0.5),
        (FieldRoof::Butterfly, RidgeAxis::Along, 0.5),
        (FieldRoof::Clerestory, RidgeAxis::Along, 0.5 * 0.35 + 0.5 * 0.65),
        (FieldRoof::Sawtooth { slope: 1.0 }, RidgeAxis::Along, 0.5),
        (FieldRoof::Pyramid, RidgeAxis::Along, 1.0 / 3.0),
        (FieldRoof::Round, RidgeAxis::Along, arc / box_volume),
        // A gable roof over 12 m, less half a pyramid of a 4 m deep end.
        (FieldRoof::SideHip, facing, 0.5 - (4.0 * 8.0 * 4.0 / 6.0) / box_volume),
        (FieldRoof::CrossGable, RidgeAxis::Along, 2.0 / 3.0),
    ] {
        let shape = roof(form, axis, 0.0);
        let (found, expected) = (volume(&walls, &shape), share * box_volume);
        // The valley of a butterfly and the feet of teeth are 1 cm above the walls.
        assert!((found - expected).abs() < 0.5, "{form:?}: {found} m³, not {expected} m³");
        let top = highest(&shape.cover(&walls, HEIGHT).expect("a roof"));
        assert!((top - HEIGHT - 4.0).abs() < 1e-9, "{form:?} is {top} m high");
    }
}

#[test]
fn a_cone_and_a_dome_have_the_volumes_of_their_facets() {
    let sides: u32 = 64;
    let corner = |side: u32| {
        let angle = std::f64::consts::TAU * f64::from(side) / f64::from(sides);
        (5.0 * angle.cos(), 5.0 * angle.sin())
    };
    let corners: Vec<(f64, f64)> = (0..sides).map(corner).collect();
    let walls = around(&corners);
    let cone = volume(&walls, &roof(FieldRoof::Pyramid, RidgeAxis::Along, 0.0));
    assert!((cone - walls.area() * 4.0 / 3.0).abs() < 1e-2, "{cone} m³");
    let dome = volume(&walls, &roof(FieldRoof::Dome, RidgeAxis::Along, 0.0));
    let smooth = walls.area() * 4.0 * 2.0 / 3.0;
    assert!(dome < smooth && dome > 0.97 * smooth, "{dome} m³ of {smooth} m³");
}

#[test]
fn a_plate_over_a_gable_has_its_thickness_everywhere() {
    let walls = around(&[(0., 0.), (12., 0.), (12., 8.), (0., 8.)]);
    let shape = RoofShape { rise: Rise::Height(2.0), ..roof(FieldRoof::Gable(&[]), RidgeAxis::Along, 0.5) };
    let expected = 12.0 * 8.0 + 13.0 * 9.0 * 0.15;
    let found = volume(&walls, &shape);
    assert!((found - expected).abs() < 1e-2, "{found} m³, not {expected} m³");
}

#[test]
fn an_apex_sees_its_outline_or_says_that_it_begins_at_the_hull() {
    let corner = around(&[(0., 0.), (12., 0.), (12., 5.), (5., 5.), (5., 12.), (0., 12.)]);
    let pyramid = roof(FieldRoof::Pyramid, RidgeAxis::Along, 0.0);
    assert_eq!(pyramid.cover(&corner, HEIGHT).expect("a roof").remark, None);
    let steps =
        around(&[(0., 0.), (18., 0.), (18., 12.), (13., 12.), (13., 5.), (5., 5.), (5., 12.), (0., 12.)]);
    let cover = pyramid.cover(&steps, HEIGHT).expect("a roof");
    assert!(cover.remark.is_some_and(|remark| remark.contains("hull")));
    assert!(solid::check([&building(&steps, &cover)]).is_solid());
}

#[test]
fn plates_at_an_upright_step_neither_overlap_nor_share_an_edge_with_four_faces() {
    let walls = around(&[(0., 0.), (12., 0.), (12., 8.), (0., 8.)]);
    for form in [FieldRoof::Clerestory, FieldRoof::Sawtooth { slope: 1.0 }] {
        let cover = roof(form, RidgeAxis::Along, 0.5).cover(&walls, HEIGHT).expect("a roof");
        let part = building(&walls, &cover);
        assert!(solid::check([&part]).is_solid(), "{form:?}");
        let clashes = solid::clashes([&part], 1e-3);
        assert!(clashes.is_empty(), "{form:?}: {clashes:?}");
    }
}

/// Returns true if all patches can be divided into triangles that look outwards.
fn has_sound_patches(cover: &RoofCover) -> bool {
    cover.patches.iter().all(|patch| {
        let Some(origin) = patch.rings.first().and_then(|ring| ring.first()) else { return false };
        let flat = FilledPolygon::new(&patch.rings, patch.along.extend(0.0), *origin);
        let Ok(flat) = flat else { return false };
        flat.triangles.iter().all(|triangle| flat.width(*triangle) > 0.0)
    })
}

#[test]
fn teeth_that_end_beside_a_corner_of_the_walls_have_no_folded_faces() {
    let u: [(f64, f64); 8] = [
        (29.94387001151846, 4.249722652140264),
        (48.63123140320815, 11.856400548585796),
        (47.20416165068798, 15.362289526605386),
        (35.248774520736546, 10.495857229465111),
        (31.565242716462265, 19.545207150857458),
        (28.059353738442677, 18.118137398337282),
        (31.742885542716955, 9.068787476944937),
        (28.516800258998288, 7.755611630159853),
    ];
    let down = DVec2::new(-0.6689965127864353, -0.7432655419697518);
    let axis = RidgeAxis::Facing { down, snap: 0.008726646259971648 };
    let surface = RoofSurface::Field(FieldRoof::Sawtooth { slope: 2.1445069205095586 }, axis);
    let low = RoofShape { surface, rise: Rise::Height(2.0), overhang: 0.0, eaves: Eaves::Closed, slab: 0.0 };
    let court: [Vec<(f64, f64)>; 2] = [
        vec![
            (48.810106532085896, 26.295106682295838),
            (69.3610588542109, 26.295106682295838),
            (69.3610588542109, 40.19357525057117),
            (48.810106532085896, 40.19357525057117),
        ],
        vec![
            (55.66042397279423, 30.927929538387616),
            (55.66042397279423, 32.629479886194),
            (57.36197432060061, 32.629479886194),
            (57.36197432060061, 30.927929538387616),
        ],
    ];
    let down = DVec2::new(-0.8968878834539652, 0.44225798411500333);
    let axis = RidgeAxis::Facing { down, snap: 0.008726646259971648 };
    let surface = RoofSurface::Field(FieldRoof::Sawtooth { slope: 0.7002075382097097 }, axis);
    let rise = Rise::Slope(0.7002075382097097);
    let wide = RoofShape { surface, rise, overhang: 0.8, eaves: Eaves::Open, slab: 0.15 };
    for (rings, roof) in [(vec![u.to_vec()], low), (court.to_vec(), wide)] {
        let rings: Vec<Vec<DVec2>> =
            rings.into_iter().map(|ring| ring.into_iter().map(DVec2::from).collect()).collect();
        // Coordinates along the longest edge, and as they are.
        let [from, to] = [rings[0][0], rings[0][1]];
        for along in [DVec2::X, (to - from).normalize()] {
            let turned = |at: &DVec2| DVec2::new(along.dot(*at), along.perp_dot(*at));
            let low = rings[0].iter().map(turned).fold(DVec2::MAX, DVec2::min);
            let moved = rings.iter().map(|ring| ring.iter().map(|at| turned(at) - low).collect());
            let walls = Polygon::new(moved.collect::<Vec<Vec<DVec2>>>()).expect("a plan");
            let cover = roof.cover(&walls, 0.0).expect("a roof");
            assert!(has_sound_patches(&cover), "{roof:?} {along}");
        }
    }
}
