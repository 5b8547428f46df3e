//! Tests of generalised cylinders, surfaces and joints that a turtle draws.

use std::sync::Arc;

use burgeon_geometry::solid::{area, check, volume};
use burgeon_kit::{
    AxisScale, Color, Draw as _, Object, Rewind as _, Table, TableKey, TableOf, Value, Vector, Warn as _,
};
use burgeon_scene::Part;
use glam::DVec3;

use super::Turtle;
use super::options::TurtleOptions;
use crate::{CurveObject, CurveOptions, SplineSurfaceOptions, SurfaceObject};

fn turtle() -> Turtle {
    Turtle::new(Default::default()).expect("a turtle")
}

fn drawn(turtle: &Turtle) -> Vec<&Part> {
    turtle.drawing().parts().iter().filter(|part| !part.triangles.is_empty()).collect()
}

fn square(closed: bool) -> Arc<CurveObject> {
    let points = [(1.0, 1.0), (-1.0, 1.0), (-1.0, -1.0), (1.0, -1.0)];
    let points = points.iter().map(|(x, y)| Vector(DVec3::new(*x, *y, 0.0))).collect();
    Arc::new(CurveObject::new(CurveOptions { points, kind: "linear".into(), closed }).expect("a curve"))
}

#[test]
fn steps_within_a_cylinder_are_one_closed_surface() {
    let mut turtle = turtle();
    turtle.width(0.4).expect("a width");
    turtle.begin_cylinder(None).expect("a beginning");
    for _ in 0..6 {
        turtle.forward(Some(0.5)).expect("a step");
        turtle.turn(Some(20.0));
    }
    assert!(drawn(&turtle).is_empty(), "it is drawn at its end");
    turtle.end_cylinder().expect("an end");
    assert!(check(drawn(&turtle)).is_solid());
    // A tube through the corners is a little longer than their chords of 3 m.
    let expected = 3.0 * 0.04 * 4.0 * 0.5f64.sqrt();
    assert!((volume(drawn(&turtle)) / expected - 1.0).abs() < 0.02, "{} {expected}", volume(drawn(&turtle)));
    turtle.end().expect("the end of the pass");
    assert_eq!(
        turtle.end_cylinder().expect_err("none is open").remedy(),
        Some("begin it with begin_cylinder()")
    );
}

#[test]
fn an_elasticity_without_a_value_adds_the_increment_and_warns_if_that_is_zero() {
    let options = TurtleOptions { simple_increment: 0.25, ..Default::default() };
    for (options, warnings) in [(options, 0), (Default::default(), 1)] {
        let mut turtle = Turtle::new(options).expect("a turtle");
        turtle.simple_elasticity(Some(0.5));
        turtle.simple_elasticity(None);
        assert_eq!(turtle.state.simple.elasticity, if warnings == 0 { 0.75 } else { 0.5 });
        assert_eq!(turtle.take_warnings().len(), warnings);
    }
}

#[test]
fn a_direction_without_length_warns_unless_the_elasticity_is_zero() {
    for (direction, elasticity, warnings) in
        [(DVec3::ZERO, 0.2, 4), (DVec3::ZERO, 0.0, 0), (DVec3::Z, 0.2, 0)]
    {
        let (mut turtle, direction) = (turtle(), burgeon_kit::Vector(direction));
        turtle.tropism(direction, elasticity);
        turtle.simple_tropism(direction, elasticity);
        turtle.add_tropism(direction, elasticity, None).expect("few tropisms");
        turtle.add_torque(direction, elasticity).expect("few torques");
        assert_eq!(turtle.take_warnings().len(), warnings, "{direction:?}");
    }
}

#[test]
fn a_branch_has_a_cylinder_of_its_own_and_its_end_completes_it() {
    let mut turtle = turtle();
    turtle.begin_cylinder(None).expect("a trunk");
    turtle.forward(Some(1.0)).expect("a step");
    turtle.push();
    turtle.turn(Some(90.0));
    turtle.begin_cylinder(None).expect("a branch");
    turtle.forward(Some(1.0)).expect("a step");
    let error = turtle.begin_cylinder(None).expect_err("one is open");
    assert!(error.to_string().contains("a cylinder is already open"));
    turtle.pop().expect("the end of the branch");
    let one = volume(drawn(&turtle));
    assert!(one > 0.0);
    turtle.forward(Some(1.0)).expect("a step");
    turtle.end().expect("the end of the pass");
    assert!(check(drawn(&turtle)).is_solid());
    assert!((volume(drawn(&turtle)) - 3.0 * one).abs() < 1e-6, "the trunk is straight and 2 m long");
}

#[test]
fn a_contour_is_scaled_by_half_of_the_width_and_oriented_like_a_placed_model() {
    let mut turtle = turtle();
    turtle.contour(Some(square(true))).expect("a contour");
    turtle.width(0.5).expect("a width");
    turtle.begin_cylinder(None).expect("a beginning");
    turtle.forward(Some(2.0)).expect("a step");
    turtle.end_cylinder().expect("an end");
    assert!((volume(drawn(&turtle)) - 0.5).abs() < 1e-6);
    let corner = |at: &glam::Vec3| at.distance(glam::Vec3::new(0.25, 0.25, 2.0)) < 1e-6;
    assert!(drawn(&turtle)[0].positions.iter().any(corner));
    let error = turtle.contour(Some(square(false))).expect_err("an open curve");
    assert_eq!(error.message(), "turtle:contour: the contour is an open curve");
    assert_eq!(error.remedy(), Some("close it: curve({ ... }, { closed = true })"));
}

#[test]
fn a_surface_is_drawn_at_the_turtles_frame_and_visible_from_both_sides() {
    let row = |y: f64| vec![Vector(DVec3::new(0.0, y, 0.0)), Vector(DVec3::new(1.0, y, 0.0))];
    let options = SplineSurfaceOptions {
        points: vec![row(0.0), row(1.0)],
        kind: "b-spline".into(),
        ..Default::default()
    };
    let flat = Arc::new(SurfaceObject::new(options).expect("a surface"));
    let mut turtle = turtle();
    turtle.advance(Some(3.0));
    turtle.surface(Arc::clone(&flat), Some(AxisScale(DVec3::new(2.0, 3.0, 1.0)))).expect("a surface");
    turtle.surface(flat, None).expect("a surface");
    let parts = drawn(&turtle);
    assert_eq!((parts.len(), area(parts.iter().copied())), (1, 7.0));
    assert!(turtle.drawing().material_of(1).double_sided && !turtle.drawing().material_of(0).double_sided);
    assert!(parts[0].positions.iter().all(|at| at.z == 3.0));
    assert!(parts[0].positions.contains(&glam::Vec3::new(2.0, 3.0, 3.0)));
}

/// Returns the number of connected surfaces of `parts`.
fn bodies(parts: &[&Part]) -> usize {
    let mut known = std::collections::BTreeMap::new();
    let mut above: Vec<usize> = Vec::new();
    let top = |above: &[usize], mut at: usize| {
        while above[at] != at {
            at = above[at];
        }
        at
    };
    for part in parts {
        for triangle in &part.triangles {
            let corners = triangle.map(|corner| {
                let at = part.positions[corner as usize] + glam::Vec3::ZERO;
                *known.entry(at.to_array().map(f32::to_bits)).or_insert_with(|| {
                    above.push(above.len());
                    above.len() - 1
                })
            });
            let [a, b, c] = corners.map(|corner| top(&above, corner));
            above[b] = a;
            let c = top(&above, c);
            above[c] = a;
        }
    }
    (0..above.len()).filter(|&at| above[at] == at).count()
}

fn joined(joints: &str) -> Turtle {
    Turtle::new(TurtleOptions { joints: joints.into(), ..TurtleOptions::default() }).expect("a turtle")
}

/// Draws a trunk of two steps with a branch and a generalised cylinder in the middle, and a fork without a trunk at the
/// end.
fn draw_tree(turtle: &mut Turtle) {
    let step = |turtle: &mut Turtle| turtle.forward(Some(1.0)).expect("a step");
    step(turtle);
    turtle.push();
    turtle.turn(Some(60.0));
    step(turtle);
    step(turtle);
    turtle.pop().expect("the end of a branch");
    turtle.push();
    turtle.turn(Some(-70.0));
    turtle.width(0.06).expect("a width");
    turtle.begin_cylinder(None).expect("a beginning");
    step(turtle);
    turtle.pitch(Some(40.0));
    step(turtle);
    turtle.pop().expect("the end of a branch");
    step(turtle);
    for angle in [40.0, -40.0] {
        turtle.push();
        turtle.turn(Some(angle));
        step(turtle);
        turtle.pop().expect("the end of a branch");
    }
}

#[test]
fn with_smooth_joints_all_branches_and_cylinders_are_one_surface() {
    let [separate, smooth] = ["separate", "smooth"].map(|joints| {
        let mut turtle = joined(joints);
        draw_tree(&mut turtle);
        turtle.end().expect("the end of the pass");
        assert!(check(drawn(&turtle)).is_solid(), "{joints}");
        (bodies(&drawn(&turtle)), volume(drawn(&turtle)))
    });
    // The two tubes of the fork share corners, so they count as one body.
    assert_eq!((separate.0, smooth.0), (4, 1));
    let ratio = smooth.1 / separate.1;
    assert!((0.9..1.0).contains(&ratio), "they do not overlap: {ratio}");
}

#[test]
fn another_material_or_a_move_without_drawing_begins_another_surface() {
    for turn in [false, true] {
        let mut turtle = joined("smooth");
        turtle.forward(Some(1.0)).expect("a step");
        turtle.push();
        turtle.turn(Some(90.0));
        if turn {
            turtle.color(Color([1.0, 0.0, 0.0, 1.0]));
        } else {
            turtle.advance(Some(0.5));
        }
        turtle.forward(Some(1.0)).expect("a step");
        turtle.pop().expect("the end of a branch");
        turtle.forward(Some(1.0)).expect("a step");
        turtle.end().expect("the end of the pass");
        assert!(check(drawn(&turtle)).is_solid());
        assert_eq!((drawn(&turtle).len(), bodies(&drawn(&turtle))), (1 + usize::from(turn), 2));
    }
}

#[test]
fn branches_at_the_start_join_without_a_trunk_and_a_cylinder_must_end_before_another_begins() {
    let mut turtle = joined("smooth");
    for angle in [90.0, -30.0] {
        turtle.push();
        turtle.turn(Some(angle));
        turtle.begin_cylinder(None).expect("a beginning");
        turtle.forward(Some(1.0)).expect("a step");
        assert!(turtle.begin_cylinder(None).is_err(), "one is open");
        turtle.end_cylinder().expect("an end");
        assert!(turtle.end_cylinder().is_err(), "none is open");
        turtle.forward(Some(1.0)).expect("a step");
        turtle.pop().expect("the end of a branch");
    }
    turtle.end().expect("the end of the pass");
    assert_eq!(bodies(&drawn(&turtle)), 1);
    let error = Turtle::new(TurtleOptions { joints: "smoth".into(), ..TurtleOptions::default() });
    let error = error.err().expect("unknown");
    assert_eq!(error.message(), "turtle: unknown joints \"smoth\"");
    assert!(error.remedy().is_some_and(|remedy| remedy.contains("smooth")));
}

#[test]
fn a_turtle_that_returns_to_a_mark_draws_the_same_joints() {
    let bytes = |turtle: &Turtle| drawn(turtle).iter().map(|part| (*part).clone()).collect::<Vec<_>>();
    let mut turtle = joined("smooth");
    turtle.forward(Some(1.0)).expect("a step");
    let mark = turtle.mark();
    draw_tree(&mut turtle);
    turtle.end().expect("the end of the pass");
    let first = bytes(&turtle);
    assert!(turtle.rewind(&*mark));
    draw_tree(&mut turtle);
    turtle.end().expect("the end of the pass");
    assert!(first == bytes(&turtle) && !first.is_empty());
}

#[test]
fn a_line_ends_at_its_position_in_any_direction_and_is_a_solid() {
    for (x, y, z) in [(1.0, 0.0, 0.0), (0.0, 0.0, -2.0), (-0.3, 4.0, 1.5)] {
        let mut turtle = turtle();
        turtle.turn(Some(30.0));
        turtle.forward(Some(1.0)).expect("a step");
        let begin = turtle.position();
        let end = begin + DVec3::new(x, y, z);
        turtle.jump(Vector(begin));
        turtle.line_to(Vector(end)).expect("a line");
        assert!(turtle.position().abs_diff_eq(end, 1e-9), "{}", turtle.position());
        assert!(turtle.heading().abs_diff_eq((end - begin).normalize(), 1e-9), "{}", turtle.heading());
        turtle.end().expect("the end of the pass");
        assert!(check(drawn(&turtle)).is_solid());
        assert!(turtle.distance(Vector(begin.midpoint(end))) < 0.5);
    }
}

#[test]
fn a_torque_rolls_after_each_step_until_the_end_of_its_branch() {
    let mut turtle = turtle();
    turtle.face(Vector(DVec3::X)).expect("a direction");
    turtle.level();
    turtle.roll(Some(90.0));
    assert!(turtle.up().z.abs() < 1e-12);
    turtle.push();
    turtle.add_torque(Vector(DVec3::Z * 7.0), 0.2).expect("a torque");
    turtle.forward(Some(1.0)).expect("a step");
    assert!((turtle.up().z - 0.2_f64.sin()).abs() < 1e-12, "{}", turtle.up());
    turtle.advance(Some(1.0));
    turtle.forward(Some(1.0)).expect("a step");
    let second = 0.2 + 0.2 * 0.2_f64.cos();
    assert!((turtle.up().z - second.sin()).abs() < 1e-12, "moving without drawing has no effect");
    assert_eq!(turtle.heading(), DVec3::X);
    turtle.pop().expect("the end of a branch");
    turtle.forward(Some(1.0)).expect("a step");
    assert!(turtle.up().z.abs() < 1e-12);
    for _ in 0..100 {
        turtle.add_torque(Vector(DVec3::Z), 0.1).expect("at most a hundred");
    }
    let error = turtle.add_torque(Vector(DVec3::Z), 0.1).expect_err("too many");
    assert_eq!(error.message(), "a turtle has at most 100 torques");
}

#[test]
fn a_scale_holds_for_lengths_and_widths_until_the_end_of_its_branch() {
    let mut turtle = turtle();
    turtle.push();
    turtle.scale(0.5).expect("a scale");
    turtle.scale(0.5).expect("a scale");
    turtle.forward(Some(2.0)).expect("a step");
    assert_eq!(turtle.position(), DVec3::Z * 0.5);
    turtle.pop().expect("the end of a branch");
    let one = volume(drawn(&turtle));
    turtle.forward(Some(2.0)).expect("a step");
    turtle.end().expect("the end of the pass");
    assert!((volume(drawn(&turtle)) - 65.0 * one).abs() < 1e-6, "{one} {}", volume(drawn(&turtle)));
    for factor in [0.0, -1.0, f64::INFINITY] {
        let error = turtle.scale(factor).expect_err("not a scale").to_string();
        assert!(error.contains("turtle:scale") && error.contains("above 0"), "{error}");
    }
}

#[test]
fn a_cylinder_twists_with_the_turtle_if_it_is_asked_to() {
    let corner = |twist: bool, joints: &str| {
        let options = TurtleOptions { width: 2.0, joints: joints.into(), ..TurtleOptions::default() };
        let mut turtle = Turtle::new(options).expect("a turtle");
        turtle.contour(Some(square(true))).expect("a contour");
        let entries = vec![(TableKey::Name("twist".into()), Value::Boolean(twist))];
        let options = TableOf::from(Arc::new(Table { class: None, entries }));
        turtle.begin_cylinder(Some(options)).expect("a beginning");
        for _ in 0..3 {
            turtle.roll(Some(50.0));
            turtle.forward(Some(3.0)).expect("a step");
        }
        turtle.end_cylinder().expect("an end");
        turtle.end().expect("the end of the pass");
        let parts = drawn(&turtle);
        assert!(check(parts.clone()).is_solid() && (volume(parts.clone()) - 36.0).abs() < 1.0);
        let top = parts[0].positions.iter().filter(|at| (at.z - 9.0).abs() < 1e-5);
        let far = top.filter(|at| at.truncate().length() > 1.41);
        // Angle (degrees) of a corner, modulo a quarter turn.
        far.map(|at| (f64::from(at.y).atan2(f64::from(at.x)).to_degrees() - 45.0).rem_euclid(90.0)).next()
    };
    for joints in ["separate", "smooth"] {
        let still = corner(false, joints).expect("a corner");
        assert!(still.min(90.0 - still) < 1e-3, "{still} with {joints}");
        // Rolled by 150 degrees, which look like 60 or 30.
        let turned = corner(true, joints).expect("a corner");
        assert!((turned - 60.0).abs() < 1e-3 || (turned - 30.0).abs() < 1e-3, "{turned} with {joints}");
    }
}
