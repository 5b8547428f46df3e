//! Corners of junctions: the intersection of the edges of two adjacent streets, and the length that the corner takes
//! from each.

use std::f64::consts::{PI, TAU};

use glam::DVec2;

/// Maximum deviation (radians) from a straight angle at which streets of one width are mitred.
const MITRED: f64 = 0.35;
/// Maximum deviation (radians) from a straight angle at which streets of different widths taper.
const TAPER: f64 = 0.6;
/// Tolerance (m): widths with a smaller difference are equal.
pub(crate) const EVEN: f64 = 1e-6;
/// Minimum length (m) that streets of different widths extend into a corner, so that their ends do not run through its
/// centre.
const LEAST: f64 = 0.5;
/// Length (m) of a taper per metre of difference in half width.
pub(crate) const TAPER_LENGTH: f64 = 2.0;
/// Maximum distance (m) between an arc and its chords.
pub(crate) const DEVIATION: f64 = 0.05;

/// Street as it leaves a junction.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Arm {
    /// Direction (unit vector).
    pub(crate) way: DVec2,
    /// Half width (m), to the outer edges of the sidewalks.
    pub(crate) half: f64,
    /// Sidewalk width (m).
    pub(crate) walk: f64,
}

impl Arm {
    /// Returns the distance (m) of a line from the centreline.
    pub(crate) fn aside(self, line: StreetLine) -> f64 {
        match line {
            StreetLine::Kerb => self.half - self.walk,
            StreetLine::Edge => self.half,
        }
    }
}

/// Lines along both sides of a street; the sidewalk is between them.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum StreetLine {
    /// Line between the carriageway and the sidewalk.
    Kerb,
    /// Line between the sidewalk and the block.
    Edge,
}

/// Both lines.
pub(crate) const LINES: [StreetLine; 2] = [StreetLine::Edge, StreetLine::Kerb];

/// Corner of a junction between two adjacent streets; the second is the next one counter-clockwise.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Corner {
    pub(crate) arms: [Arm; 2],
    /// Angle (radians) from the first street to the second.
    pub(crate) angle: f64,
    pub(crate) shape: CornerShape,
    /// Length (m) that the corner takes along each street.
    pub(crate) reaches: [f64; 2],
}

#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum CornerShape {
    /// Arcs of these radii (m).
    Round { edge: f64, kerb: f64 },
    /// Intersection of the edges.
    Sharp,
    /// Outside of a bend: arcs around the junction, so no point is farther from it than the edges.
    Bend,
    /// Side of a bend where the width changes: parabolas that touch the lines of both streets.
    Curve,
    /// Straight transition from one width to the other.
    Taper,
    /// Closed end of a street: a circle of this radius (m) at the outer edges.
    Around(f64),
}

impl Corner {
    /// Computes the corner between two arms; `radius` (m) is the kerb radius at the outer edges of the sidewalks.
    ///
    /// Method: the edges meet at (next + half cos) / sin of the angle; a circle touches them at its cotangent beyond
    /// that point.
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
            // Kerbs turn in the same direction as edges, so the sidewalk is never narrower than the smaller of the two.
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

    /// Computes the closed end of a street: a circle of `radius` (m), at least half of the street's width.
    pub(crate) fn around(arm: Arm, radius: f64) -> Self {
        let radius = radius.max(arm.half);
        let reach = (radius * radius - arm.half * arm.half).sqrt();
        Self { arms: [arm; 2], angle: TAU, shape: CornerShape::Around(radius), reaches: [reach; 2] }
    }

    /// Returns true if the corner is a single point.
    pub(crate) fn is_sharp(&self) -> bool {
        matches!(self.shape, CornerShape::Sharp)
    }

    /// Returns true if the corner is a straight transition between widths.
    pub(crate) fn is_taper(&self) -> bool {
        matches!(self.shape, CornerShape::Taper)
    }

    /// Returns true if the corner is the outside of a bend between different widths.
    pub(crate) fn is_uneven_bend(&self) -> bool {
        matches!(self.shape, CornerShape::Bend) && apart(self.arms) >= EVEN
    }

    /// Returns the corner with its taper shortened by `less` (m) along both streets, down to the minimum length.
    pub(crate) fn shorten(mut self, less: [f64; 2]) -> Self {
        if self.is_taper() {
            let least = clear(self.arms, (self.angle - PI).abs()) + LEAST;
            self.reaches = [0, 1].map(|side| (self.reaches[side] - less[side]).max(least));
        }
        self
    }

    /// Returns the points (m) of a line around the corner, from the first arm to the second, relative to the junction.
    /// Both lines have the same number of points.
    pub(crate) fn points(&self, line: StreetLine) -> Vec<DVec2> {
        let [first, second] = self.arms;
        let [a, b] = self.arms.map(|arm| arm.aside(line));
        match self.shape {
            CornerShape::Round { edge, kerb } => {
                let radius = if line == StreetLine::Edge { edge } else { kerb };
                let along = meeting(self.angle, a, b) + radius / (self.angle / 2.0).tan();
                let center = left_of(first, along, a + radius);
                let swept = PI - self.angle;
                let from = (-first.way.perp()).to_angle();
                arc(center, radius, from, -swept, pieces(swept, edge + first.half.min(second.half)))
            }
            CornerShape::Sharp => vec![left_of(first, meeting(self.angle, a, b), a)],
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
            CornerShape::Taper => {
                vec![left_of(first, self.reaches[0], a), left_of(second, self.reaches[1], -b)]
            }
            CornerShape::Around(radius) => {
                // Both circles are cut off by the same line.
                let reach = self.reaches[0];
                let (from, to) = (left_of(first, reach, a), left_of(first, reach, -a));
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

/// Returns the distance (m) from a bend within which the ends of both streets could touch.
fn clear(arms: [Arm; 2], bend: f64) -> f64 {
    arms[0].half.max(arms[1].half) * (bend / 2.0).tan()
}

/// Returns the number of chords for an arc that sweeps `swept` (radians) at a radius (m).
pub(crate) fn pieces(swept: f64, radius: f64) -> u32 {
    let step = 2.0 * (1.0 - (DEVIATION / radius.max(0.5)).min(0.9)).acos();
    chords(swept.abs() / step)
}

/// Rounds up to a number of chords, from 1 to 256.
pub(crate) fn chords(least: f64) -> u32 {
    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "at most some hundreds")]
    let count = least.ceil().clamp(1.0, 256.0) as u32;
    count
}

/// Returns the point at a distance (m) along a street that leaves a junction and a distance (m) to the left of its
/// centreline.
pub(crate) fn left_of(arm: Arm, along: f64, aside: f64) -> DVec2 {
    arm.way * along + arm.way.perp() * aside
}

/// Returns the largest difference (m) between the two streets in the distance of a line from the centreline.
pub(crate) fn apart(arms: [Arm; 2]) -> f64 {
    LINES.map(|line| arms.map(|arm| arm.aside(line))).iter().map(|[a, b]| (a - b).abs()).fold(0.0, f64::max)
}

/// Returns the points of an arc, one more than the number of chords.
fn arc(center: DVec2, radius: f64, from: f64, swept: f64, chords: u32) -> Vec<DVec2> {
    let at =
        |index: u32| center + DVec2::from_angle(from + swept * f64::from(index) / f64::from(chords)) * radius;
    (0..=chords).map(at).collect()
}

/// Returns the distance (m) along the first of two streets at which its edge meets the edge of the second.
pub(crate) fn meeting(angle: f64, half: f64, next: f64) -> f64 {
    if (half - next).abs() < EVEN {
        // This also covers streets that are straight ahead of each other, whose edges are collinear.
        return half / (angle / 2.0).tan();
    }
    let (sin, cos) = angle.sin_cos();
    (next + half * cos) / sin
}

/// Returns the counter-clockwise angle from one direction to another (radians, from 0 up to a full turn).
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
