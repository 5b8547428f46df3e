//! Paths of sweeps: stations, and segments with stations on lines and arcs.

use std::f64::consts::TAU;

use glam::{DQuat, DVec2};

use crate::cross_section::section::Section;
use crate::frame::Frame;
use burgeon_base::error::{Error, Limit, Result};

/// Maximum number of steps of a segment.
const MOST_STEPS: usize = 1_000_000;

/// A position on the path of a sweep, with the scale and twist of the cross-section.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Station {
    /// Frame of the cross-section, which is normal to the heading, with x to the right and y opposite to
    /// `up`.
    pub frame: Frame,
    /// Scale factors of the cross-section's x and y; negative factors mirror it.
    pub scale: DVec2,
    /// Rotation of the cross-section about the heading (radians), in the direction of [`Frame::roll`].
    pub twist: f64,
    /// Marks a sharp edge around the cross-section, even if the surface is smooth along the path.
    pub sharp: bool,
}

impl Station {
    /// Creates a station with uniform scale and without twist.
    pub fn new(frame: Frame, scale: f64) -> Self {
        Self { frame, scale: DVec2::splat(scale), twist: 0.0, sharp: false }
    }
}

/// A segment of a path: a straight line or a circular arc, along which scale and twist change linearly.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Segment {
    /// Length of the centreline (m); negative lengths go backwards.
    pub length: f64,
    /// Angle (radians) between the headings at both ends; the radius is `length` / `bend`.
    pub bend: f64,
    /// Direction of the bend (radians): 0 is left, a quarter turn is down, opposite to the frame's `up`.
    pub toward: f64,
    /// Rotation of the cross-section about the heading (radians) between both ends, in the direction of
    /// [`Frame::roll`].
    pub twist: f64,
    /// Scale factors of the cross-section's x and y at the start.
    pub from: DVec2,
    /// Scale factors of the cross-section's x and y at the end.
    pub to: DVec2,
    /// Number of steps that the segment is divided into.
    pub steps: usize,
    /// Marks a sharp edge around the cross-section at the start.
    pub sharp: bool,
}

impl Default for Segment {
    /// Returns a straight segment of 1 m in one step.
    fn default() -> Self {
        let (from, to) = (DVec2::ONE, DVec2::ONE);
        Self { length: 1.0, bend: 0.0, toward: 0.0, twist: 0.0, from, to, steps: 1, sharp: false }
    }
}

impl Segment {
    /// Returns the segment bent with a curvature (1/m), the reciprocal of the radius.
    #[must_use]
    pub fn curved(mut self, curvature: f64) -> Self {
        self.bend = self.length * curvature;
        self
    }

    /// Returns the number of steps, at least 1, for which bend and twist per step are at most `angle`
    /// (radians).
    pub fn steps_for(&self, angle: f64) -> usize {
        let steps = (self.bend.abs().max(self.twist.abs()) / angle).ceil();
        if steps.is_finite() { (steps as usize).max(1) } else { 1 }
    }

    /// Adds `steps` + 1 stations from `start` on to `stations`, and returns the frame at the end.
    ///
    /// The returned frame includes the twist, so a segment that begins there continues this segment exactly.
    /// The stations lie on the arc, and their headings are tangent to it. Fails if a value is not finite, if
    /// there are no steps or too many, or if a step bends or twists by half a turn or more, because the
    /// surface would intersect itself.
    ///
    /// ```
    /// use burgeon_geometry::{Frame, Segment};
    /// use glam::DVec3;
    /// use std::f64::consts::{FRAC_PI_2, TAU};
    ///
    /// // A quarter of a circle with a radius of 2 m.
    /// let arc = Segment { length: TAU / 2.0, steps: 8, ..Segment::default() }.curved(1.0 / 2.0);
    /// assert_eq!(arc.bend, FRAC_PI_2);
    /// let mut stations = Vec::new();
    /// let end = arc.stations(Frame::default(), &mut stations)?;
    /// assert_eq!(stations.len(), 9);
    /// assert!(end.position.abs_diff_eq(DVec3::new(-2.0, 0.0, 2.0), 1e-12));
    /// # Ok::<(), burgeon_base::error::Error>(())
    /// ```
    pub fn stations(&self, start: Frame, stations: &mut impl Extend<Station>) -> Result<Frame> {
        self.refuse_impossible()?;
        stations.extend((0..=self.steps).map(|step| {
            let fraction = step as f64 / self.steps as f64;
            Station {
                frame: self.frame(start, fraction),
                scale: self.from.lerp(self.to, fraction),
                twist: self.twist * fraction,
                sharp: self.sharp && step == 0,
            }
        }));
        let mut end = self.frame(start, 1.0);
        end.roll(self.twist);
        end.orthonormalize();
        Ok(end)
    }

    /// Returns the radius (m) of the bend; infinite without a bend.
    pub fn radius(&self) -> f64 {
        if self.bend == 0.0 { f64::INFINITY } else { (self.length / self.bend).abs() }
    }

    /// Returns the greatest distance (m) of a point of `section` from the path towards the centre of the bend, at the
    /// `stations` of this segment; 0 without a bend. If it is above the [`radius`](Self::radius), the sweep crosses itself.
    ///
    /// ```
    /// use burgeon_geometry::{Frame, Section, Segment};
    ///
    /// let section = Section::rectangle(2.0, 0.5)?;
    /// let arc = Segment { steps: 4, ..Segment::default() }.curved(1.25);
    /// let mut stations = Vec::new();
    /// arc.stations(Frame::default(), &mut stations)?;
    /// assert!((arc.inner_reach(&section, &stations) - 1.0).abs() < 1e-12);
    /// assert_eq!(arc.radius(), 0.8);
    /// # Ok::<(), burgeon_base::error::Error>(())
    /// ```
    pub fn inner_reach(&self, section: &Section, stations: &[Station]) -> f64 {
        let Some(start) = stations.first().filter(|_| self.bend != 0.0).map(|station| station.frame) else {
            return 0.0;
        };
        let (sin, cos) = self.toward.sin_cos();
        let axis =
            start.heading.cross(start.left * cos - start.up * sin) * (self.length / self.bend).signum();
        let reach = |station: &Station| {
            let mut frame = station.frame;
            let inward = axis.cross(frame.heading);
            frame.roll(station.twist);
            let inward = DVec2::new(-frame.left.dot(inward), -frame.up.dot(inward)) * station.scale;
            section.points().map(|point| point.dot(inward)).fold(0.0, f64::max)
        };
        stations.iter().map(reach).fold(0.0, f64::max)
    }

    /// Returns the frame without twist at a `fraction` of the length.
    fn frame(&self, start: Frame, fraction: f64) -> Frame {
        let angle = self.bend * fraction;
        if angle == 0.0 {
            return Frame { position: start.position + start.heading * (self.length * fraction), ..start };
        }
        let (sin, cos) = self.toward.sin_cos();
        let direction = start.left * cos - start.up * sin;
        // The chord of an arc is at half of its angle, and shorter than the arc by the factor sin(x) / x.
        let half = angle / 2.0;
        let shortening = if half.abs() < 1e-8 { 1.0 } else { half.sin() / half };
        let chord = start.heading * half.cos() + direction * half.sin();
        let mut frame = start;
        frame.position += chord * (self.length * fraction * shortening);
        frame.rotate(DQuat::from_axis_angle(start.heading.cross(direction), angle));
        frame
    }

    fn refuse_impossible(&self) -> Result<()> {
        let values = [
            ("length", self.length),
            ("bend", self.bend),
            ("direction of the bend", self.toward),
            ("twist", self.twist),
            ("scale of x at the start", self.from.x),
            ("scale of y at the start", self.from.y),
            ("scale of x at the end", self.to.x),
            ("scale of y at the end", self.to.y),
        ];
        if let Some((name, value)) = values.into_iter().find(|(_, value)| !value.is_finite()) {
            return Err(Error::argument(format!("the segment's {name} must be finite, not {value}"))
                .help("give a finite number"));
        }
        if self.steps == 0 {
            return Err(Error::argument("the segment has no steps").help("give at least 1 step"));
        }
        if self.steps > MOST_STEPS {
            return Err(Error::limit(Limit::Size, format!("a segment of {} steps is too fine", self.steps))
                .help(format!("give at most {MOST_STEPS} steps")));
        }
        for (name, angle) in [("bends", self.bend), ("twists", self.twist)] {
            let (step, whole) = (angle.abs() / self.steps as f64, angle.abs().to_degrees());
            if step >= TAU / 2.0 {
                let steps = (angle.abs() / (TAU / 2.0)) as usize + 1;
                let message = format!("the segment {name} by {whole:.1} degrees in {} steps", self.steps);
                return Err(Error::geometry(message)
                    .help(format!("give at least {steps} steps, preferably many more")));
            }
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::FRAC_PI_2;

    use glam::DVec3;

    use super::*;

    fn close(a: DVec3, b: DVec3) -> bool {
        (a - b).length() < 1e-12
    }

    #[test]
    fn a_quarter_arc_ends_where_the_circle_does() {
        let arc = Segment { length: FRAC_PI_2 * 2.0, bend: FRAC_PI_2, steps: 9, ..Segment::default() };
        let start = Frame::default();
        let mut stations = Vec::new();
        let end = arc.stations(start, &mut stations).expect("an arc");
        assert_eq!(stations.len(), 10);
        let centre = start.position + start.left * 2.0;
        assert!(stations.iter().all(|s| (s.frame.position.distance(centre) - 2.0).abs() < 1e-12));
        assert!(stations.iter().all(|s| s.frame.heading.dot(s.frame.position - centre).abs() < 1e-12));
        assert!(close(end.position, centre + start.heading * 2.0) && close(end.heading, start.left));
        assert!(close(end.up, start.up));
    }

    #[test]
    fn the_inner_reach_is_that_of_the_side_at_the_centre_of_the_bend() {
        // 1 m to the right, 3 m to the left, and 2 m to both sides in the direction of the section's y.
        let ring = [(1.0, -2.0), (1.0, 2.0), (-3.0, 2.0), (-3.0, -2.0)].map(DVec2::from).to_vec();
        let section = Section::polygon(&crate::planar::Rings(vec![ring])).expect("a section");
        let reach = |segment: Segment| {
            let mut stations = Vec::new();
            segment.stations(Frame::default(), &mut stations).expect("an arc");
            segment.inner_reach(&section, &stations)
        };
        let arc = Segment { bend: 0.5, steps: 3, ..Segment::default() };
        let near = |reach: f64, expected: f64| assert!((reach - expected).abs() < 1e-9, "{reach}");
        near(reach(arc), 3.0);
        near(reach(Segment { bend: -0.5, ..arc }), 1.0);
        near(reach(Segment { length: -1.0, ..arc }), 1.0);
        near(reach(Segment { toward: FRAC_PI_2, ..arc }), 2.0);
        near(reach(Segment { toward: 2.0 * FRAC_PI_2, ..arc }), 1.0);
        near(reach(Segment { to: DVec2::new(2.0, 1.0), ..arc }), 6.0);
        near(reach(Segment { twist: FRAC_PI_2, bend: -0.5, steps: 1, ..arc }), 2.0);
        near(reach(Segment { bend: 0.0, ..arc }), 0.0);
    }

    #[test]
    fn a_bend_towards_a_quarter_turn_pitches_down() {
        let arc = Segment { bend: 0.3, toward: FRAC_PI_2, ..Segment::default() }.curved(0.3);
        let end = arc.stations(Frame::default(), &mut Vec::new()).expect("an arc");
        let mut pitched = Frame::default();
        pitched.pitch(0.3);
        assert!(close(end.heading, pitched.heading) && close(end.up, pitched.up));
    }

    #[test]
    fn two_halves_of_a_twisted_arc_make_the_whole() {
        let straight = Segment { length: 3.0, twist: 1.0, ..Segment::default() };
        let mut halves = Frame::default();
        let half = Segment { length: 1.5, twist: 0.5, ..straight };
        for _ in 0..2 {
            halves = half.stations(halves, &mut Vec::new()).expect("a half");
        }
        let whole = straight.stations(Frame::default(), &mut Vec::new()).expect("a whole");
        assert!(close(halves.position, whole.position) && close(halves.left, whole.left));
    }

    #[test]
    fn an_impossible_segment_is_refused() {
        let refuse = |segment: Segment| {
            segment.stations(Frame::default(), &mut Vec::new()).expect_err("refused").to_string()
        };
        insta::assert_snapshot!(refuse(Segment { twist: f64::NAN, ..Segment::default() }), @r"
        the segment's twist must be finite, not NaN
          help: give a finite number
        ");
        insta::assert_snapshot!(refuse(Segment { steps: usize::MAX, ..Segment::default() }), @r"
        a segment of 18446744073709551615 steps is too fine
          help: give at most 1000000 steps
        ");
        insta::assert_snapshot!(refuse(Segment { steps: 0, ..Segment::default() }), @r"
        the segment has no steps
          help: give at least 1 step
        ");
        insta::assert_snapshot!(refuse(Segment { bend: 7.0, steps: 2, ..Segment::default() }), @r"
        the segment bends by 401.1 degrees in 2 steps
          help: give at least 3 steps, preferably many more
        ");
    }
}
