//! The corners of junctions: where the edges of two neighbouring streets meet, and how much of each that takes.

use std::f64::consts::{PI, TAU};

use glam::DVec2;

/// Up to this angle (radians) from a straight one, streets of one width are mitred.
const MITRED: f64 = 0.35;
/// Within this angle (radians) of a straight one, streets of different widths taper.
const TAPER: f64 = 0.6;
/// Widths that differ by less (m) are one.
pub(crate) const EVEN: f64 = 1e-6;
/// How far (m) streets of different widths reach into a corner at least, so that their ends are no line through its middle.
const LEAST: f64 = 0.5;
/// How long (m) a street tapers for each metre of a difference in half of its width.
pub(crate) const TAPER_LENGTH: f64 = 2.0;
/// How far (m) an arc may lie from its chords.
pub(crate) const DEVIATION: f64 = 0.05;

/// A street as it leaves a junction.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Arm {
    /// The direction, of length 1.
    pub(crate) way: DVec2,
    /// Half of its width (m) to the outer edges of its sidewalks.
    pub(crate) half: f64,
    /// Width (m) of its sidewalks.
    pub(crate) walk: f64,
}

impl Arm {
    /// How far (m) one of its lines lies from its middle.
    pub(crate) fn aside(self, line: StreetLine) -> f64 {
        match line {
            StreetLine::Kerb => self.half - self.walk,
            StreetLine::Edge => self.half,
        }
    }
}

/// The lines along both sides of a street, between which its sidewalks lie.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum StreetLine {
    /// Between the carriageway and the sidewalk.
    Kerb,
    /// Between the sidewalk and the block.
    Edge,
}

/// Both of them.
pub(crate) const LINES: [StreetLine; 2] = [StreetLine::Edge, StreetLine::Kerb];

/// What a junction has between two neighbours among its streets, of which the second is the next one counter-clockwise.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Corner {
    pub(crate) arms: [Arm; 2],
    /// The angle (radians) from the first to the second.
    pub(crate) angle: f64,
    pub(crate) shape: CornerShape,
    /// How far (m) along the two it reaches.
    pub(crate) reaches: [f64; 2],
}

#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum CornerShape {
    /// The two lines turn with these radii (m).
    Round { edge: f64, kerb: f64 },
    /// The edges meet.
    Sharp,
    /// The outside of a bend: by circles around the junction, so that nothing is farther from it than the edges are.
    Bend,
    /// A side of a bend where the width changes: by parabolas that touch the lines of both streets.
    Curve,
    /// Straight from one width to the other.
    Taper,
    /// Around the end of a street: by a circle of this radius (m) at the outer edges.
    Around(f64),
}

impl Corner {
    /// The corner between two arms; `radius` (m) is that of kerbs, at the outer edges of the sidewalks.
    ///
    /// Method: the edges meet at (next + half cos) / sin of the angle; a circle touches them its cotangent farther on.
    pub(crate) fn new(arms: [Arm; 2], radius: f64) -> Self {
        let angle = turn(arms[0].way, arms[1].way);
        let lines = LINES.map(|line| arms.map(|arm| arm.aside(line)));
        let apart = apart(arms);
        let is_even = apart < EVEN;
        let bend = (angle - PI).abs();
        if !is_even && bend < TAPER {
            let length = (apart * TAPER_LENGTH).max(clear(arms, bend) + LEAST);
            return Self { arms, angle, shape: CornerShape::Taper, reaches: [length; 2] };
        }
        if angle < PI && !(is_even && bend < MITRED) {
            // Kerbs turn the same way as edges do, so what lies between them is nowhere less than the lesser sidewalk.
            let kerb = radius + arms[0].walk.min(arms[1].walk);
            let mut reaches = [if is_even { 0.0 } else { LEAST }; 2];
            for ([a, b], radius) in lines.into_iter().zip([radius, kerb]) {
                let more = radius / (angle / 2.0).tan();
                let both = [meeting(angle, a, b) + more, meeting(angle, b, a) + more];
                reaches = [reaches[0].max(both[0]), reaches[1].max(both[1])];
            }
            return Self { arms, angle, shape: CornerShape::Round { edge: radius, kerb }, reaches };
        }
        let mut reaches = [if is_even { 0.0 } else { LEAST }; 2];
        if bend >= MITRED {
            return Self { arms, angle, shape: CornerShape::Bend, reaches };
        }
        for [a, b] in lines {
            reaches = [reaches[0].max(meeting(angle, a, b)), reaches[1].max(meeting(angle, b, a))];
        }
        Self { arms, angle, shape: CornerShape::Sharp, reaches }
    }

    /// What a street ends with: by a circle of a `radius` (m), which is no less than half of its width.
    pub(crate) fn around(arm: Arm, radius: f64) -> Self {
        let radius = radius.max(arm.half);
        let reach = (radius * radius - arm.half * arm.half).sqrt();
        Self { arms: [arm; 2], angle: TAU, shape: CornerShape::Around(radius), reaches: [reach; 2] }
    }

    /// Whether it is a single point.
    pub(crate) fn is_sharp(&self) -> bool {
        matches!(self.shape, CornerShape::Sharp)
    }

    /// Whether it goes straight from one width to another.
    pub(crate) fn is_taper(&self) -> bool {
        matches!(self.shape, CornerShape::Taper)
    }

    /// Whether it goes around the outside of a bend from one width to another.
    pub(crate) fn is_uneven_bend(&self) -> bool {
        matches!(self.shape, CornerShape::Bend) && apart(self.arms) >= EVEN
    }

    /// The same with a taper that is so much shorter (m) along its two streets, as far as that goes.
    pub(crate) fn shortened(mut self, less: [f64; 2]) -> Self {
        if self.is_taper() {
            let least = clear(self.arms, (self.angle - PI).abs()) + LEAST;
            self.reaches = [0, 1].map(|side| (self.reaches[side] - less[side]).max(least));
        }
        self
    }

    /// The points (m) of a line around it, from the first arm to the second, as seen from the junction. There are as many
    /// for both lines.
    pub(crate) fn points(&self, line: StreetLine) -> Vec<DVec2> {
        let [first, second] = self.arms;
        let [a, b] = self.arms.map(|arm| arm.aside(line));
        match self.shape {
            CornerShape::Round { edge, kerb } => {
                let radius = if line == StreetLine::Edge { edge } else { kerb };
                let along = meeting(self.angle, a, b) + radius / (self.angle / 2.0).tan();
                let center = left(first, along, a + radius);
                let swept = PI - self.angle;
                let from = (-first.way.perp()).to_angle();
                arc(center, radius, from, -swept, pieces(swept, edge + first.half.min(second.half)))
            }
            CornerShape::Sharp => vec![left(first, meeting(self.angle, a, b), a)],
            CornerShape::Bend => {
                let (from, swept) = (first.way.perp().to_angle(), self.angle - PI);
                let chords = pieces(swept, first.half.max(second.half));
                let at = |index: u32| {
                    let part = f64::from(index) / f64::from(chords);
                    DVec2::from_angle(from + swept * part) * (a + (b - a) * part)
                };
                (0..=chords).map(at).collect()
            }
            CornerShape::Curve => {
                self.curve().into_iter().map(|pair| pair[usize::from(line == StreetLine::Kerb)]).collect()
            }
            CornerShape::Taper => vec![left(first, self.reaches[0], a), left(second, self.reaches[1], -b)],
            CornerShape::Around(radius) => {
                // The two circles are cut off by the same line.
                let reach = self.reaches[0];
                let (from, to) = (left(first, reach, a), left(first, reach, -a));
                let is_circle = radius > first.half + EVEN;
                let round = if is_circle { radius - (first.half - a) } else { a };
                let start = from.to_angle();
                let mut points = arc(
                    DVec2::ZERO,
                    round,
                    start,
                    (to.to_angle() - start).rem_euclid(TAU),
                    pieces(TAU, radius),
                );
                let last = points.len() - 1;
                (points[0], points[last]) = (from, to);
                points
            }
        }
    }
}

/// How far (m) from a bend the ends of two streets could touch.
fn clear(arms: [Arm; 2], bend: f64) -> f64 {
    arms[0].half.max(arms[1].half) * (bend / 2.0).tan()
}

/// How many chords an arc of a radius (m) is drawn with.
pub(crate) fn pieces(swept: f64, radius: f64) -> u32 {
    let step = 2.0 * (1.0 - (DEVIATION / radius.max(0.5)).min(0.9)).acos();
    chords(swept.abs() / step)
}

/// The least whole number of chords.
pub(crate) fn chords(least: f64) -> u32 {
    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "at most some hundreds")]
    let count = least.ceil().clamp(1.0, 256.0) as u32;
    count
}

/// A place so far (m) along a street that leaves a junction, and so far to the left of its middle.
pub(crate) fn left(arm: Arm, along: f64, aside: f64) -> DVec2 {
    arm.way * along + arm.way.perp() * aside
}

/// By how much (m) the lines of two streets are farther from the middle of one than from that of the other.
pub(crate) fn apart(arms: [Arm; 2]) -> f64 {
    LINES.map(|line| arms.map(|arm| arm.aside(line))).iter().map(|[a, b]| (a - b).abs()).fold(0.0, f64::max)
}

/// The points of an arc, one more than it has chords.
fn arc(center: DVec2, radius: f64, from: f64, swept: f64, chords: u32) -> Vec<DVec2> {
    let at =
        |index: u32| center + DVec2::from_angle(from + swept * f64::from(index) / f64::from(chords)) * radius;
    (0..=chords).map(at).collect()
}

/// How far (m) along the first of two streets its edge meets that of the second.
pub(crate) fn meeting(angle: f64, half: f64, next: f64) -> f64 {
    if (half - next).abs() < EVEN {
        // Also where they lie straight ahead of one another, and the edges are one line.
        return half / (angle / 2.0).tan();
    }
    let (sin, cos) = angle.sin_cos();
    (next + half * cos) / sin
}

/// The angle (radians, from 0 up to a whole turn) that leads counter-clockwise from one direction to another.
pub(crate) fn turn(from: DVec2, to: DVec2) -> f64 {
    let angle = from.perp_dot(to).atan2(from.dot(to));
    if angle < 0.0 { angle + TAU } else { angle }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn arm(degrees: f64, half: f64) -> Arm {
        Arm { way: DVec2::from_angle(degrees.to_radians()), half, walk: 0.0 }
    }

    #[test]
    fn sharp_corners_take_more() {
        let reach = |degrees: f64| Corner::new([arm(0.0, 7.0), arm(degrees, 7.0)], 4.0).reaches[0];
        for (degrees, expected) in [(90.0, 11.0), (60.0, 19.05), (45.0, 26.56), (30.0, 41.05)] {
            assert!((reach(degrees) - expected).abs() < 0.01, "{degrees}: {}", reach(degrees));
        }
        assert!(reach(180.0) < 1e-9 && reach(250.0) == 0.0);
    }

    #[test]
    fn corners_lead_from_edge_to_edge() {
        let sizes = [(3.0, 0.5), (3.0, 1.9), (6.0, 2.0), (9.0, 1.0), (9.0, 6.0)];
        for first in sizes {
            for second in sizes {
                for degrees in (30..=330).step_by(5) {
                    let arms = [(20.0, first), (20.0 + f64::from(degrees), second)];
                    let arms = arms.map(|(at, (half, walk))| Arm { walk, ..arm(at, half) });
                    let corner = Corner::new(arms, 4.0);
                    let count = corner.points(StreetLine::Edge).len();
                    for line in [StreetLine::Kerb, StreetLine::Edge] {
                        let points = corner.points(line);
                        assert_eq!(points.len(), count);
                        for (arm, end, side) in [(0, points[0], 1.0), (1, points[count - 1], -1.0)] {
                            let aside = arms[arm].way.perp_dot(end) * side;
                            let expected = arms[arm].aside(line);
                            assert!(
                                (aside - expected).abs() < 0.02,
                                "{degrees} {first:?} {second:?}: {aside}, not {expected}"
                            );
                            assert!(arms[arm].way.dot(end) <= corner.reaches[arm] + 1e-9);
                        }
                    }
                }
            }
        }
    }

    #[test]
    fn the_outside_of_a_bend_is_no_farther_from_it_than_the_edges() {
        for degrees in (205..=330).step_by(5) {
            let corner = Corner::new([arm(0.0, 6.0), arm(f64::from(degrees), 6.0)], 4.0);
            let points = corner.points(StreetLine::Edge);
            assert!(points.len() > 2);
            assert!(points.iter().all(|at| (at.length() - 6.0).abs() < 1e-9), "{degrees}: {points:?}");
        }
    }

    #[test]
    fn a_street_ends_with_a_circle() {
        for radius in [0.0, 8.0] {
            let corner = Corner::around(Arm { walk: 2.0, ..arm(0.0, 5.0) }, radius);
            for (line, aside) in [(StreetLine::Edge, 5.0), (StreetLine::Kerb, 3.0)] {
                let points = corner.points(line);
                assert_eq!(points[0], DVec2::new(corner.reaches[0], aside));
                assert!(points.iter().any(|at| at.x < -2.9), "it goes around the end");
            }
        }
    }
}
