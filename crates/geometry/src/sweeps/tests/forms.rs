//! Sweeps of shapes with known volumes and areas.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use crate::solid::{area, check, volume};
use crate::{
    Frame, Lengthwise, Rings, Section, SectionPoint, Segment, Station, SweepOptions, SweepResult, sweep,
};
use burgeon_scene::{Normal, Part};
use glam::{DVec2, DVec3, Vec3};

const FLAT: SweepOptions = SweepOptions {
    around: false,
    along: false,
    start_cap: true,
    end_cap: true,
    closed: false,
    back: true,
    v: 0.0,
    lengthwise: Lengthwise::Surface,
};

/// Returns stations above each other: height (m), scale of x and y, twist.
pub(super) fn tower(levels: &[(f64, f64, f64, f64)]) -> Vec<Station> {
    let station = |&(height, x, y, twist): &(f64, f64, f64, f64)| {
        let mut frame = Frame::default();
        frame.forward(height);
        Station { frame, scale: DVec2::new(x, y), twist, sharp: false }
    };
    levels.iter().map(station).collect()
}

pub(super) fn swept(section: &Section, stations: &[Station], options: &SweepOptions) -> (Part, SweepResult) {
    let mut part = Part::default();
    let swept = sweep(&mut part, section, stations, options).expect("a sweep that works");
    (part, swept)
}

pub(super) fn solid(section: &Section, stations: &[Station]) -> Part {
    let (part, swept) = swept(section, stations, &SweepOptions::default());
    let found = check([&part]);
    assert!(found.is_solid() && swept.open.is_empty(), "{found:?}");
    part
}

/// Returns the minimum cosine between a triangle's own normal and those of its corners.
pub(super) fn least_cosine(part: &Part) -> f64 {
    let mut least = 1.0f64;
    for triangle in &part.triangles {
        let [a, b, c] = triangle.map(|corner| part.positions[corner as usize].as_dvec3());
        let face = (b - a).cross(c - a).normalize();
        for corner in triangle {
            let normal = part.normals[corner as usize].vector().as_dvec3();
            assert!((normal.length() - 1.0).abs() < 1e-5, "{normal}");
            least = least.min(face.dot(normal));
        }
    }
    least
}

/// Returns the area (m²) of the triangles on the texture; mirrored triangles count negative.
pub(super) fn texture_area(part: &Part) -> f64 {
    let corner = |corner: u32| part.uvs[corner as usize].as_dvec2();
    let area = |[a, b, c]: [u32; 3]| (corner(b) - corner(a)).perp_dot(corner(c) - corner(a)) / 2.0;
    part.triangles.iter().map(area).sum()
}

pub(super) fn near(value: f64, expected: f64, relative: f64) -> bool {
    (value - expected).abs() <= expected.abs() * relative
}

fn frame_section() -> Section {
    let square =
        |half: f64| [(-1., -1.), (1., -1.), (1., 1.), (-1., 1.)].map(|(x, y)| DVec2::new(x, y) * half);
    Section::polygon(&Rings(vec![square(1.0).to_vec(), square(0.5).to_vec()])).expect("a frame")
}

#[test]
fn a_prism_with_a_hole_has_its_volume_and_area() {
    let part = solid(&frame_section(), &tower(&[(0., 2., 3., 0.), (5., 2., 3., 0.)]));
    assert!(near(volume([&part]), 3.0 * 6.0 * 5.0, 1e-6));
    assert!(near(area([&part]), 2.0 * 18.0 + 20.0 * 5.0 + 10.0 * 5.0, 1e-6));
}

#[test]
fn pyramids_and_frusta_follow_their_formulas() {
    for sides in [3, 4, 7, 24] {
        let section = Section::regular(sides).expect("a polygon");
        let base = section.area();
        let pyramid = solid(&section, &tower(&[(0., 2., 2., 0.), (3., 0., 0., 0.)]));
        assert!(near(volume([&pyramid]), base * 4.0 * 3.0 / 3.0, 1e-6));
        assert_eq!(pyramid.triangles.len(), sides + sides - 2);
        let hanging = solid(&section, &tower(&[(0., 0., 0., 0.), (3., 2., 2., 0.)]));
        assert!(near(volume([&hanging]), base * 4.0, 1e-6));
        let frustum = solid(&section, &tower(&[(0., 2., 2., 0.), (3., 1., 1., 0.)]));
        assert!(near(volume([&frustum]), base * (4.0 + 2.0 + 1.0), 1e-6));
    }
}

#[test]
fn a_roof_squeezed_to_a_ridge_is_closed_for_any_outline() {
    let star = Section::star(5, 0.5).expect("a star");
    for section in [Section::rectangle(2.0, 2.0).expect("a square"), frame_section(), star] {
        solid(&section, &tower(&[(0., 2., 2., 0.3), (3., 0., 2., 0.3)]));
        solid(&section, &tower(&[(0., 2., 2., 0.), (3., 2., 0., 0.), (4., 2., 1., 0.)]));
    }
    let square = Section::rectangle(2.0, 2.0).expect("a square");
    let roof = solid(&square, &tower(&[(0., 1., 3., 0.), (3., 0., 3., 0.)]));
    assert!(near(volume([&roof]), 2.0 * 6.0 * 3.0 / 2.0, 1e-6));
    let wedge = solid(&square, &tower(&[(0., 1., 0., 0.), (3., 0., 1., 0.)]));
    assert!(near(volume([&wedge]), 2.0 * 2.0 * 3.0 / 6.0, 1e-6));
}

#[test]
fn a_torus_comes_close_to_pappus_as_the_square_of_the_resolution() {
    let error = |steps: usize| {
        let section = Section::regular(steps).expect("a circle");
        let mut stations = Vec::new();
        let arc = Segment { length: TAU * 3.0, bend: TAU, steps, ..Segment::default() };
        arc.stations(Frame::default(), &mut stations).expect("a circle");
        let options = SweepOptions { closed: true, ..SweepOptions::default() };
        let (part, _) = swept(&section, &stations, &options);
        let found = check([&part]);
        assert!(found.is_solid(), "{found:?}");
        assert!(least_cosine(&part) > 1.0 - 40.0 / (steps * steps) as f64);
        1.0 - volume([&part]) / (PI * TAU * 3.0)
    };
    for steps in [16, 64, 256] {
        let (error, bound) = (error(steps), 2.0 * PI * PI / (steps * steps) as f64);
        assert!(error > 0.2 * bound && error < bound, "{steps} steps: {error}");
    }
}

#[test]
fn a_torus_whose_hole_has_closed_is_solid_where_its_faces_shrink_to_points() {
    let mut stations = Vec::new();
    let arc = Segment { length: TAU, bend: TAU, toward: 0.4, steps: 24, ..Segment::default() };
    arc.stations(Frame::default(), &mut stations).expect("a circle");
    let section = Section::regular(24).expect("a circle");
    for turn in [0.4, -0.4] {
        // The section's first point, or the opposite point, coincides with the centre of the torus.
        stations.iter_mut().for_each(|station| station.twist = turn);
        let (part, _) = swept(&section, &stations, &SweepOptions { closed: true, ..SweepOptions::default() });
        let found = check([&part]);
        assert!(found.is_solid(), "{turn}: {found:?}");
    }
}

#[test]
fn a_section_too_small_to_be_told_from_a_point_is_a_tip() {
    let section = Section::star(7, 0.3).expect("a star");
    for scale in [1e-9, 1e-7, 9e-7, 2e-6] {
        let part = solid(&section, &tower(&[(0., 1., 1., 0.), (1.3, scale, scale, 0.), (2., 1., 1., 0.)]));
        assert!(near(volume([&part]), section.area() * 2.0 / 3.0, 1e-4));
        let ended = solid(&section, &tower(&[(0., 1., 1., 0.), (1.3, scale, scale, 0.)]));
        assert!(near(volume([&ended]), section.area() * 1.3 / 3.0, 1e-4), "{scale}");
        let tip = solid(&section, &tower(&[(0., 1., 1., 0.), (1.3, 0., 0., 0.)]));
        assert_eq!(ended == tip, scale < 1e-6, "{scale}");
    }
}

#[test]
fn a_part_of_a_torus_with_caps_follows_pappus() {
    let section = Section::regular(128).expect("a circle");
    let mut stations = Vec::new();
    let arc = Segment { length: 4.0, bend: 1.0, toward: 2.0, twist: 0.7, steps: 64, ..Segment::default() };
    arc.stations(Frame::default(), &mut stations).expect("an arc");
    assert!(near(volume([&solid(&section, &stations)]), PI * 4.0, 1e-3));
}

#[test]
fn a_twisted_prism_has_nearly_the_volume_of_a_straight_one() {
    let section = Section::rectangle(2.0, 1.0).expect("a rectangle").resampled(24).expect("a finer one");
    let twisted = Segment { length: 5.0, twist: FRAC_PI_2, steps: 48, ..Segment::default() };
    let mut stations = Vec::new();
    twisted.stations(Frame::default(), &mut stations).expect("a twist");
    let volume = volume([&solid(&section, &stations)]);
    assert!(near(volume, 10.0, 2e-3), "{volume}");
}

#[test]
fn mirrored_and_backward_sweeps_face_outwards_and_do_not_mirror_the_texture() {
    let section = frame_section();
    let mut checked = 0;
    for (height, x, y) in
        [(4., 1., 1.), (4., -1., 1.), (4., 1., -1.), (4., -1., -1.), (-4., 1., 1.), (-4., 1., -1.)]
    {
        for options in [FLAT, SweepOptions::default()] {
            let (part, _) = swept(&section, &tower(&[(0., x, y, 0.1), (height, x, y, 0.1)]), &options);
            assert!(check([&part]).is_solid());
            assert!(near(volume([&part]), 12.0, 1e-6));
            assert!(least_cosine(&part) > 0.9999);
            assert!(near(texture_area(&part), area([&part]), 1e-5));
            checked += 1;
        }
    }
    assert_eq!(checked, 12);
}

#[test]
fn an_annular_step_is_closed_and_flat() {
    let part = solid(
        &Section::regular(6).expect("a hexagon"),
        &tower(&[
            (0., 3., 3., 0.),
            (1., 3., 3., 0.),
            (1., 2., 2., 0.),
            (2., 2., 2., 0.),
            (2., 4., 4., 0.),
            (3., 4., 4., 0.),
        ]),
    );
    let hexagon = 1.5 * 3f64.sqrt();
    assert!(near(volume([&part]), hexagon * (9.0 + 4.0 + 16.0), 1e-6));
    let upwards =
        part.positions.iter().zip(&part.normals).filter(|(p, n)| p.z == 1.0 && n.vector().z > 0.999).count();
    assert!(upwards >= 12, "{upwards}");
}

#[test]
fn stations_that_repeat_add_nothing() {
    let section = Section::regular(5).expect("a pentagon");
    let once = solid(&section, &tower(&[(0., 1., 1., 0.), (2., 1., 1., 0.)]));
    let twice =
        solid(&section, &tower(&[(0., 1., 1., 0.), (0., 1., 1., 0.), (2., 1., 1., 0.), (2., 1., 1., 0.)]));
    assert_eq!(once, twice);
    let (part, swept) = swept(&section, &tower(&[(1., 1., 1., 0.); 3]), &SweepOptions::default());
    assert_eq!((part, swept), (Part::default(), SweepResult::default()));
}

#[test]
fn a_turn_on_the_spot_is_mitred_and_keeps_the_volume() {
    let section = Section::rectangle(1.0, 1.0).expect("a square");
    let mut frame = Frame::default();
    let mut stations = Vec::new();
    for turn in [0.9, -0.7, 0.0] {
        stations.push(Station::new(frame, 1.0));
        frame.forward(3.0);
        stations.push(Station::new(frame, 1.0));
        frame.turn(turn);
    }
    let part = solid(&section, &stations);
    // A mitre removes as much on the inner side as it adds on the outer side.
    assert!(near(volume([&part]), 9.0, 1e-6), "{}", volume([&part]));
    assert!(least_cosine(&swept(&section, &stations, &FLAT).0) > 0.9999);
}

#[test]
fn a_closed_frame_around_a_square_is_mitred_at_all_four_corners() {
    let section = Section::rectangle(0.2, 0.4).expect("a moulding");
    let mut frame = Frame::default();
    let mut stations = Vec::new();
    for _ in 0..4 {
        stations.push(Station::new(frame, 1.0));
        frame.forward(2.0);
        stations.push(Station::new(frame, 1.0));
        frame.turn(FRAC_PI_2);
    }
    let (part, _) = swept(&section, &stations, &SweepOptions { closed: true, ..FLAT });
    assert!(check([&part]).is_solid());
    assert_eq!(part.triangles.len(), 4 * 4 * 2);
    assert!(near(volume([&part]), 8.0 * 0.08, 1e-6));
}

#[test]
fn textures_are_in_metres_and_run_on() {
    let section = Section::regular(32).expect("a circle");
    let options = SweepOptions { start_cap: false, end_cap: false, v: 7.0, ..SweepOptions::default() };
    let (part, ends) =
        swept(&section, &tower(&[(0., 2., 2., 0.), (1., 2., 2., 0.), (4., 2., 2., 0.)]), &options);
    assert!(near(texture_area(&part), section.perimeter() * 2.0 * 4.0, 1e-5));
    assert_eq!(ends.v, 11.0);
    let (low, high) = part.uvs.iter().fold((f32::MAX, f32::MIN), |(l, h), uv| (l.min(uv.x), h.max(uv.x)));
    assert!(low.abs() < 1e-5 && near(f64::from(high), section.perimeter() * 2.0, 1e-5));
    // Flat tapering faces are neither stretched nor sheared, up to the tip.
    let square = Section::regular(4).expect("a square").marked(false);
    for top in [1.0, 0.0] {
        let options = SweepOptions { lengthwise: Lengthwise::Surface, ..FLAT };
        let (part, _) = swept(&square, &tower(&[(0., 2., 2., 0.), (3., top, top, 0.)]), &options);
        for triangle in &part.triangles {
            for side in 0..3 {
                let [a, b] = [triangle[side] as usize, triangle[(side + 1) % 3] as usize];
                let (length, texture) =
                    (part.positions[a].distance(part.positions[b]), part.uvs[a].distance(part.uvs[b]));
                assert!((length - texture).abs() < 1e-5, "{length} {texture}");
            }
        }
    }
    // Around a cone the texture is cut into one wedge for each face.
    let options = SweepOptions { end_cap: false, start_cap: false, ..SweepOptions::default() };
    for levels in [[(0., 2., 2., 0.), (3., 0., 0., 0.)], [(0., 0., 0., 0.), (3., 2., 2., 0.)]] {
        let (cone, _) = swept(&section, &tower(&levels), &options);
        let widths = cone.triangles.iter().map(|triangle| triangle.map(|corner| cone.uvs[corner as usize].x));
        let width = |[a, b, c]: [f32; 3]| a.max(b).max(c) - a.min(b).min(c);
        assert!(widths.clone().count() == 32 && widths.map(width).all(|width| width < 0.4));
        assert!(near(texture_area(&cone), area([&cone]), 1e-5));
    }
    let axis = SweepOptions { lengthwise: Lengthwise::Axis, ..FLAT };
    assert_eq!(swept(&square, &tower(&[(0., 2., 2., 0.), (3., 1., 1., 0.5)]), &axis).1.v, 3.0);
}

#[test]
fn smooth_normals_follow_taper_and_bend() {
    let section = Section::regular(64).expect("a circle");
    let (cone, _) = swept(&section, &tower(&[(0., 2., 2., 0.), (1., 1., 1., 0.)]), &SweepOptions::default());
    let sides = cone.normals.iter().map(|normal| normal.vector()).filter(|normal| normal.z.abs() < 0.99);
    assert!(
        sides.clone().count() == 130
            && sides.clone().all(|n| (n.z - 0.5f32.sqrt()).abs() < Normal::PRECISION)
    );
    let (tip, _) = swept(&section, &tower(&[(0., 2., 2., 0.), (1., 0., 0., 0.)]), &SweepOptions::default());
    for triangle in
        tip.triangles.iter().filter(|t| t.iter().any(|&corner| tip.positions[corner as usize].z == 1.0))
    {
        let [a, b, c] = triangle.map(|corner| tip.positions[corner as usize]);
        let above =
            triangle.iter().find(|&&corner| tip.positions[corner as usize].z == 1.0).expect("the tip");
        assert!((b - a).cross(c - a).normalize().dot(tip.normals[*above as usize].vector()) > 0.999_999);
    }
    // On a torus every normal points away from the centre circle, also at both ends.
    let mut stations = Vec::new();
    let arc = Segment { length: 3.0, bend: 1.0, steps: 6, ..Segment::default() };
    arc.stations(Frame::default(), &mut stations).expect("an arc");
    let options = SweepOptions { start_cap: false, end_cap: false, ..SweepOptions::default() };
    let (torus, _) = swept(&section, &stations, &options);
    let centre = Frame::default().left * 3.0;
    for (position, normal) in torus.positions.iter().zip(&torus.normals) {
        let (position, up) = (position.as_dvec3() - centre, Frame::default().up);
        let middle = position.reject_from_normalized(up).normalize() * 3.0;
        assert!((position - middle).dot(normal.vector().as_dvec3()) > 0.99999);
    }
}

#[test]
fn flat_shading_gives_each_face_its_own_normal() {
    let section = Section::regular(12).expect("a circle");
    let (part, _) = swept(&section, &tower(&[(0., 2., 2., 0.), (1., 1., 1., 0.)]), &FLAT);
    assert!(least_cosine(&part) > 0.99999);
}

#[test]
fn open_edges_are_those_that_are_said_to_be_open() {
    let key = |edges: Vec<[Vec3; 2]>| {
        let mut keys: Vec<_> = edges
            .into_iter()
            .map(|edge| {
                let mut ends = edge.map(|point| point.to_array().map(f32::to_bits));
                ends.sort_unstable();
                ends
            })
            .collect();
        keys.sort_unstable();
        keys
    };
    let line = [(0., 0.), (1., 0.), (1., 1.), (2., 1.)].map(|(x, y)| SectionPoint::sharp(DVec2::new(x, y)));
    let ribbon = Section::open(&line).expect("a line");
    let stations = tower(&[(0., 1., 1., 0.), (2., 1., 1., 0.4), (3., 0.5, 0.5, 0.4)]);
    for (section, options, edges) in [
        (frame_section(), SweepOptions { start_cap: false, ..SweepOptions::default() }, 8),
        (frame_section(), SweepOptions { end_cap: false, ..FLAT }, 8),
        (ribbon.clone(), SweepOptions { back: false, ..SweepOptions::default() }, 3 + 3 + 2 + 2),
    ] {
        let (part, swept) = swept(&section, &stations, &options);
        let found = check([&part]);
        assert_eq!((found.open.len(), found.inconsistent.len()), (edges, 0));
        assert_eq!(key(found.open), key(swept.open));
    }
    let (both, _) = swept(&ribbon, &stations, &SweepOptions::default());
    let (front, _) = swept(&ribbon, &stations, &SweepOptions { back: false, ..SweepOptions::default() });
    assert!(near(area([&both]), 2.0 * area([&front]), 1e-9) && volume([&both]).abs() < 1e-6);
    assert!(least_cosine(&both) > 0.5);
}

#[test]
fn what_cannot_be_swept_is_refused_and_leaves_the_part_as_it_was() {
    let section = Section::rectangle(2.0, 1.0).expect("a rectangle");
    let refuse = |stations: &[Station]| {
        let mut part = solid(&section, &tower(&[(0., 1., 1., 0.), (1., 1., 1., 0.)]));
        let before = part.clone();
        let error = sweep(&mut part, &section, stations, &SweepOptions::default()).expect_err("refused");
        assert_eq!(part, before);
        error.to_string()
    };
    insta::assert_snapshot!(refuse(&tower(&[(0., 1., 1., 0.), (f64::NAN, 1., 1., 0.)])), @r"
    the position of station 2 is (NaN, NaN, NaN)
      help: give numbers up to 1e9
    ");
    insta::assert_snapshot!(refuse(&tower(&[(0., 1., f64::INFINITY, 0.)])), @r"
    the scale of station 1 is (1, inf)
      help: give numbers up to 1e9
    ");
    insta::assert_snapshot!(refuse(&tower(&[(0., 1., 1., f64::NAN)])), @r"
    the twist of station 1 is NaN
      help: give numbers up to 1e9
    ");
    insta::assert_snapshot!(refuse(&tower(&[(0., 1., 1., 0.), (1., -1., 1., 0.)])), @r"
    the scale changes its sign between stations 1 and 2
      help: put a station of scale 0 between them, or twist by 180 degrees instead of scaling by -1
    ");
    insta::assert_snapshot!(refuse(&tower(&[(0., 1., 1., 0.), (1., 1., 1., 0.), (1., 1., 1., 1.), (2., 1., 1., 1.)])), @r"
    the outlines at stations 2 and 3 are at the same position and cross
      help: increase the length between the stations, or end the run there and begin a new one
    ");
    let aside = [(1., 0.), (2., 0.), (2., 1.), (1., 1.)].map(|(x, y)| DVec2::new(x, y));
    let aside = Section::polygon(&Rings(vec![aside.to_vec()])).expect("a square");
    let grown = tower(&[(0., 1., 1., 0.), (1., 1., 1., 0.), (1., 1.5, 1.5, 0.), (2., 1.5, 1.5, 0.)]);
    let error = sweep(&mut Part::default(), &aside, &grown, &SweepOptions::default()).expect_err("refused");
    insta::assert_snapshot!(error, @r"
    between stations 2 and 3 the face after point 1 has no area
      help: increase the length between the stations, or centre the cross-section differently
    ");
    let mut back = Frame::default();
    back.forward(1.0);
    let there = Station::new(back, 1.0);
    back.turn(PI);
    insta::assert_snapshot!(refuse(&[tower(&[(0., 1., 1., 0.)])[0], there, Station::new(back, 1.0)]), @r"
    the path turns back on itself at station 2
      help: turn in several steps with a length between them, or begin a new run
    ");
}

#[test]
fn a_section_far_from_the_way_turns_with_it() {
    let square = [(9., 0.), (10., 0.), (10., 1.), (9., 1.)].map(|(x, y)| DVec2::new(x, y));
    let section = Section::polygon(&Rings(vec![square.to_vec()])).expect("a square");
    let mut stations = Vec::new();
    let screw = Segment { length: 200.0, twist: 3.0 * TAU, steps: 200, ..Segment::default() };
    screw.stations(Frame::default(), &mut stations).expect("a screw");
    let part = solid(&section, &stations);
    assert!(least_cosine(&part) > 0.99);
    let centre = part.positions.iter().map(|p| p.as_dvec3()).sum::<DVec3>() / part.positions.len() as f64;
    assert!((centre - DVec3::new(0.0, 0.0, 100.0)).length() < 0.5, "{centre}");
}
