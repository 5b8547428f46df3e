//! Tropisms and torques: directions towards which the heading bends, and the up vector rolls, with each step.

use burgeon_geometry::Frame;
use glam::{DQuat, DVec3};

use super::state::TurtleState;
use burgeon_base::error::{Error, Limit, Result};

/// Maximum number of tropisms of a turtle.
const MOST_TROPISMS: usize = 100;

/// Maximum number of torques of a turtle.
const MOST_TORQUES: usize = 100;

/// Maximum angle of a bend or a roll (radians), as in cpfg.
const LARGEST: f64 = 1.0;

/// Tropism that bends the heading until it makes an angle with a direction.
#[derive(Debug, Clone, Copy)]
pub(super) struct Tropism {
    /// Direction of length 1, or zero.
    pub direction: DVec3,
    pub elasticity: f64,
    /// Preferred angle between the heading and the direction (radians).
    pub angle: f64,
}

impl Tropism {
    /// Returns the direction in which this tropism pulls the heading of `frame`, of the length of its elasticity.
    ///
    /// It lies in the plane of the heading and the direction, at the preferred angle. If the heading is parallel to the direction,
    /// the heading turns about the left.
    fn pull(&self, frame: &Frame) -> DVec3 {
        let across = frame.heading - self.direction * self.direction.dot(frame.heading);
        let across =
            across.try_normalize().unwrap_or_else(|| frame.left.cross(self.direction).normalize_or_zero());
        let (sin, cos) = self.angle.sin_cos();
        (self.direction * cos + across * sin) * self.elasticity
    }
}

/// Sum of the torques of a turtle. The up vector rolls towards its direction.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct TorqueSum {
    /// Sum of the directions, each of the length of its elasticity.
    pull: DVec3,
    count: usize,
}

impl TorqueSum {
    /// Rolls `frame` by min(|U x D|, 1) radians about its heading, where U is the up vector, and D the part of the sum that is
    /// perpendicular to the heading. An up vector that points away from D keeps its direction.
    fn roll(&self, frame: &mut Frame) {
        // The up vector, the left and D are in one plane, so |U x D| is the part of D along the left.
        let angle = self.pull.dot(frame.left);
        if angle.abs() > 1e-9 {
            frame.roll(angle.clamp(-LARGEST, LARGEST));
        }
    }
}

/// The simple tropism of cpfg and lpfg, which tilts the heading after each step.
#[derive(Debug, Clone, Copy)]
pub(super) struct SimpleTropism {
    /// Direction of length 1, or zero.
    direction: DVec3,
    pub elasticity: f64,
}

impl SimpleTropism {
    pub(super) fn new(direction: DVec3, elasticity: f64) -> Self {
        Self { direction: direction.normalize_or_zero(), elasticity }
    }

    /// Tilts the heading of `frame` towards the up vector by asin(e T . U), then towards the left by asin(e T . L). An angle is at
    /// most 90 degrees.
    ///
    /// Method: cpfg, *interpret.c*, function `bend`; lpfg, *turtle.cpp*.
    fn tilt(&self, frame: &mut Frame) {
        let angle = |towards: DVec3| {
            // cpfg has no heading anymore if the sine is above 1.
            let sin = (self.elasticity * self.direction.dot(towards)).clamp(-1.0, 1.0);
            (sin, (1.0 - sin * sin).sqrt())
        };
        let (sin, cos) = angle(frame.up);
        frame.pitch_by((-sin, cos));
        frame.turn_by(angle(frame.left));
    }
}

impl TurtleState {
    /// Adds a tropism to the others, whose preferred angle is `angle` (degrees).
    pub(super) fn add_tropism(&mut self, direction: DVec3, elasticity: f64, angle: f64) -> Result<()> {
        if self.more_tropisms.len() == MOST_TROPISMS {
            return Err(Error::limit(Limit::Size, format!("a turtle has at most {MOST_TROPISMS} tropisms"))
                .help("add them once, at the beginning of a branch or of the chain"));
        }
        let direction = direction.normalize_or_zero();
        self.more_tropisms.push(Tropism { direction, elasticity, angle: angle.to_radians() });
        Ok(())
    }

    /// Adds a torque to the others.
    pub(super) fn add_torque(&mut self, direction: DVec3, elasticity: f64) -> Result<()> {
        if self.torques.count == MOST_TORQUES {
            return Err(Error::limit(Limit::Size, format!("a turtle has at most {MOST_TORQUES} torques"))
                .help("add them once, at the beginning of a branch or of the chain"));
        }
        self.torques.pull += direction.normalize_or_zero() * elasticity;
        self.torques.count += 1;
        Ok(())
    }

    /// Bends the heading by the simple tropism after a step, drawn or not.
    #[inline]
    pub(super) fn apply_simple_tropism(&mut self) {
        if self.simple.elasticity != 0.0 {
            self.simple.tilt(&mut self.frame);
        }
    }

    /// Bends the heading after a step that was drawn, then rolls by the torques.
    ///
    /// cpfg bends by the simple tropism after a step, and by the others before the next one.
    pub(super) fn bend(&mut self) {
        self.apply_simple_tropism();
        if !self.more_tropisms.is_empty() {
            let main = Tropism { direction: self.tropism, elasticity: self.elasticity, angle: 0.0 };
            bend_together(&mut self.frame, self.more_tropisms.iter().copied().chain([main]));
        } else if self.elasticity != 0.0 {
            bend_towards(&mut self.frame, self.tropism, self.elasticity);
        }
        if self.torques.count > 0 {
            self.torques.roll(&mut self.frame);
        }
    }
}

/// Bends the heading as in *The Algorithmic Beauty of Plants*, section 2.1: by elasticity times |H x T|.
fn bend_towards(frame: &mut Frame, direction: DVec3, elasticity: f64) {
    let axis = frame.heading.cross(direction);
    let torque = axis.length();
    if torque > 1e-9 {
        frame.rotate(DQuat::from_axis_angle(axis / torque, elasticity * torque));
    }
}

/// Bends the heading of `frame` as several tropisms pull it together: about H x V by |H x V|, where V is the sum of their
/// pulls.
fn bend_together(frame: &mut Frame, tropisms: impl Iterator<Item = Tropism>) {
    let pull: DVec3 = tropisms.map(|tropism| tropism.pull(frame)).sum();
    let axis = frame.heading.cross(pull);
    let torque = axis.length();
    if torque > 1e-9 {
        frame.rotate(DQuat::from_axis_angle(axis / torque, torque.min(LARGEST)));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn tropism(direction: DVec3, elasticity: f64, angle: f64) -> Tropism {
        Tropism { direction, elasticity, angle: angle.to_radians() }
    }

    fn frame(heading: DVec3) -> Frame {
        let mut frame = Frame::default();
        frame.face(heading);
        frame
    }

    #[test]
    fn a_heading_converges_to_the_preferred_angle() {
        for angle in [0.0, 30.0, 90.0, 120.0] {
            for heading in [DVec3::Z, DVec3::X, DVec3::new(0.3, -0.2, -0.9).normalize()] {
                let mut frame = frame(heading);
                (0..200)
                    .for_each(|_| bend_together(&mut frame, std::iter::once(tropism(DVec3::Z, 0.2, angle))));
                let found = frame.heading.angle_between(DVec3::Z).to_degrees();
                assert!((found - angle).abs() < 1e-3, "{found} instead of {angle} from {heading}");
            }
        }
    }

    #[test]
    fn the_simple_tropism_tilts_towards_the_up_vector_and_then_towards_the_left_as_in_cpfg() {
        // H = x, L = z and U = -y. With T = (0, -0.6, 0.8), the sines are e T.U = 0.3 and e T.L = 0.4.
        let mut turned = frame(DVec3::X);
        assert!(turned.left.abs_diff_eq(DVec3::Z, 1e-12) && turned.up.abs_diff_eq(DVec3::NEG_Y, 1e-12));
        SimpleTropism::new(DVec3::new(0.0, -3.0, 4.0), 0.5).tilt(&mut turned);
        let expected = DVec3::new((0.91_f64 * 0.84).sqrt(), -0.3 * 0.84_f64.sqrt(), 0.4);
        assert!(turned.heading.abs_diff_eq(expected, 1e-12), "{} instead of {expected}", turned.heading);
        assert!(turned.heading.cross(turned.left).abs_diff_eq(turned.up, 1e-12));
        // A second tilt, with T = z: the sine is 0.5 cos(30 degrees), and no angle of 0.5 radians as in ABOP.
        let mut turned = frame(DVec3::X);
        let simple = SimpleTropism::new(DVec3::Z, 0.5);
        (0..2).for_each(|_| simple.tilt(&mut turned));
        let expected = 30.0_f64.to_radians() + (0.5 * 0.75_f64.sqrt()).asin();
        assert!((turned.heading.z - expected.sin()).abs() < 1e-12, "{}", turned.heading);
    }

    #[test]
    fn a_simple_tropism_above_one_tilts_by_at_most_90_degrees() {
        let mut turned = frame(DVec3::X);
        SimpleTropism::new(DVec3::Z, 7.0).tilt(&mut turned);
        assert!(turned.heading.abs_diff_eq(DVec3::Z, 1e-12), "{}", turned.heading);
    }

    fn torque(pull: DVec3) -> TorqueSum {
        TorqueSum { pull, count: 1 }
    }

    #[test]
    fn a_torque_rolls_by_its_strength_and_the_sine_of_the_angle_to_its_direction() {
        // The heading is x, and the up vector z is rolled away from the direction by the angle.
        for (angle, strength, expected) in
            [(90.0_f64, 0.2, 0.2), (30.0, 0.4, 0.2), (150.0, 0.4, 0.2), (-90.0, 0.3, -0.3), (60.0, 50.0, 1.0)]
        {
            let mut frame = frame(DVec3::X);
            frame.level();
            assert!(frame.up.abs_diff_eq(DVec3::Z, 1e-12));
            let direction = DVec3::new(0.0, angle.to_radians().sin(), angle.to_radians().cos());
            torque(direction * strength).roll(&mut frame);
            let rolled = f64::atan2(frame.up.y, frame.up.z);
            assert!((rolled - expected).abs() < 1e-12, "{rolled} instead of {expected} at {angle}");
            assert!(frame.heading == DVec3::X && frame.left.cross(frame.up).abs_diff_eq(DVec3::X, 1e-12));
        }
    }

    #[test]
    fn the_up_vector_converges_to_the_projection_of_the_direction_of_a_torque() {
        let heading = DVec3::new(0.6, 0.0, 0.8);
        let mut frame = frame(heading);
        frame.roll(2.0);
        (0..400).for_each(|_| torque(DVec3::Z * 0.1).roll(&mut frame));
        let projection = (DVec3::Z - heading * heading.z).normalize();
        // A torque of less than 1e-9 does not roll, and that of the projection is 0.06.
        assert!(frame.up.abs_diff_eq(projection, 1e-9 / 0.06), "{} instead of {projection}", frame.up);
    }

    #[test]
    fn a_torque_along_the_heading_or_against_the_up_vector_has_no_effect() {
        let mut frame = frame(DVec3::X);
        let before = frame;
        torque(DVec3::X).roll(&mut frame);
        torque(-frame.up).roll(&mut frame);
        assert_eq!(frame, before);
    }

    #[test]
    fn equal_tropisms_balance_between_their_directions() {
        let mut frame = frame(DVec3::new(0.1, 0.0, 1.0).normalize());
        let both = [tropism(DVec3::X, 0.2, 0.0), tropism(DVec3::Y, 0.2, 0.0)];
        (0..200).for_each(|_| bend_together(&mut frame, both.into_iter()));
        assert!((frame.heading - DVec3::new(1.0, 1.0, 0.0).normalize()).length() < 1e-6, "{}", frame.heading);
    }

    #[test]
    fn a_strong_tropism_bends_by_at_most_one_radian() {
        let mut frame = frame(DVec3::X);
        bend_together(&mut frame, std::iter::once(tropism(DVec3::Z, 50.0, 0.0)));
        assert!((frame.heading.angle_between(DVec3::X) - 1.0).abs() < 1e-9);
    }
}
