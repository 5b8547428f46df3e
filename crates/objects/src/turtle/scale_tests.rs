//! Tests of turtles that draw at another scale.

use burgeon_base::error::Result;
use burgeon_kit::{Draw as _, Object, Rescale as _, Vector};
use glam::{DVec3, Vec3};
use proptest::prelude::*;

use super::Turtle;
use super::options::TurtleOptions;

/// Call of a turtle with a length, an angle or a factor.
type Action = (u8, f64);

fn act(turtle: &mut Turtle, depth: &mut usize, (kind, value): Action) -> Result<()> {
    match kind {
        0..=3 => turtle.forward(Some(value)),
        4 => turtle.forward(None),
        5 => turtle.width(value / 3.0),
        6 => {
            turtle.advance(Some(value));
            Ok(())
        }
        7 => {
            turtle.turn(Some(value * 40.0));
            Ok(())
        }
        8 => {
            turtle.pitch(Some(value * 50.0));
            Ok(())
        }
        9 => turtle.sphere(value),
        10 => {
            *depth += 1;
            turtle.push();
            Ok(())
        }
        11 if *depth > 0 => {
            *depth -= 1;
            turtle.pop()
        }
        12 => turtle.rescale(value),
        13 => {
            turtle.begin_polygon();
            for _ in 0..3 {
                turtle.point()?;
                turtle.advance(Some(value));
                turtle.turn(Some(100.0));
            }
            turtle.end_polygon()
        }
        _ => Ok(()),
    }
}

/// Returns the vertices and normals that a turtle draws at this scale.
fn drawn(joints: &str, scale: f64, actions: &[Action]) -> Result<Vec<(Vec3, Vec3)>> {
    let mut turtle =
        Turtle::new(TurtleOptions { joints: joints.to_owned(), step: 0.7, ..Default::default() })?;
    turtle.begin();
    turtle.rescale(scale)?;
    let mut depth = 0;
    for action in actions {
        act(&mut turtle, &mut depth, *action)?;
    }
    for _ in 0..depth {
        turtle.pop()?;
    }
    turtle.end()?;
    let parts = turtle.drawing().parts().iter();
    let part = |part: &burgeon_scene::Part| -> Vec<(Vec3, Vec3)> {
        part.positions.iter().copied().zip(part.normals.iter().map(|normal| normal.vector())).collect()
    };
    Ok(parts.flat_map(part).collect())
}

proptest! {
    #[test]
    fn a_scaled_turtle_draws_the_same_shapes_smaller(
        actions in prop::collection::vec((0_u8..14, 0.3_f64..2.0), 1..40),
        is_smooth in any::<bool>(),
        power in -2_i32..=2,
    ) {
        // Powers of two keep the same thresholds of shapes.
        let scale = 2.0_f64.powi(power);
        let joints = if is_smooth { "smooth" } else { "separate" };
        let whole = drawn(joints, 1.0, &actions).expect("a drawing");
        let scaled = drawn(joints, scale, &actions).expect("a drawing");
        prop_assert_eq!(whole.len(), scaled.len());
        for ((position, normal), (other, other_normal)) in whole.into_iter().zip(scaled) {
            let expected = position * scale as f32;
            prop_assert!(expected.abs_diff_eq(other, 1e-4 * (1.0 + expected.length())), "{} {}", expected, other);
            prop_assert!(normal.abs_diff_eq(other_normal, 1e-3), "{} {}", normal, other_normal);
        }
    }
}

#[test]
fn a_branch_restores_the_scale_and_positions_are_not_scaled() {
    let mut turtle = Turtle::new(TurtleOptions::default()).expect("a turtle");
    turtle.begin();
    turtle.push();
    turtle.rescale(0.5).expect("a scale");
    turtle.rescale(0.5).expect("a scale");
    turtle.jump(Vector(DVec3::new(0.0, 0.0, 2.0)));
    turtle.forward(Some(4.0)).expect("a step");
    assert_eq!(turtle.position(), DVec3::new(0.0, 0.0, 3.0));
    turtle.pop().expect("the end of the branch");
    turtle.forward(Some(4.0)).expect("a step");
    assert_eq!(turtle.position(), DVec3::new(0.0, 0.0, 4.0));
}

#[test]
fn a_scale_that_is_not_above_0_is_refused() {
    let mut turtle = Turtle::new(TurtleOptions::default()).expect("a turtle");
    for factor in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        assert!(turtle.rescale(factor).is_err(), "{factor}");
    }
    turtle.rescale(1e-300).expect("a scale");
    let error = turtle.rescale(1e-300).expect_err("the scale would be 0");
    assert_eq!(error.remedy(), Some("use 0.5 for half of the size"));
}
