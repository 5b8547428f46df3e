//! The corners of junctions: where the edges of two neighbouring streets meet, and how much of each that takes.

use std::f64::consts::{PI, TAU};

use glam::DVec2;

/// Up to this angle (radians) from a straight one, streets of one width are mitred.
const MITRED: f64 = 0.35;
/// Within this angle (radians) of a straight one, streets of different widths taper.
const TAPER: f64 = 0.6;
/// Widths that differ by less (m) are one.
const EVEN: f64 = 1e-6;
/// How far (m) streets of different widths reach into a corner at least, so that their ends are no line through its middle.
const LEAST: f64 = 0.5;
/// How long (m) a street tapers for each metre of a difference in half of its width.
const TAPER_LENGTH: f64 = 2.0;
/// How far (m) an arc may lie from its chords.
const DEVIATION: f64 = 0.05;

/// A street as it leaves a junction.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Arm {
    /// The direction, of length 1.
    pub(crate) way: DVec2,
    /// Half of its width (m) to the outer edges of its sidewalks.
    pub(crate) half: f64,
}

/// What a junction has between two neighbours among its streets, of which the second is the next one counter-clockwise.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Corner {
    arms: [Arm; 2],
    /// The angle (radians) from the first to the second.
    angle: f64,
    shape: CornerShape,
    /// How far (m) along the two it reaches.
    pub(crate) reaches: [f64; 2],
}

#[derive(Debug, Clone, Copy, PartialEq)]
enum CornerShape {
    /// A kerb of this radius (m) at the outer edges.
    Round(f64),
    /// The edges meet.
    Sharp,
    /// From one width to the other.
    Taper(f64),
    /// Around the end of a street: by a circle of this radius (m) at the outer edges.
    Around(f64),
}

impl Corner {
    /// The corner between two arms; `radius` (m) is that of kerbs, at the outer edges of the sidewalks.
    ///
    /// Method: the edges meet at (next + half cos) / sin of the angle; a circle touches them its cotangent farther on.
    pub(crate) fn new(arms: [Arm; 2], radius: f64) -> Self {
        let angle = turn(arms[0].way, arms[1].way);
        let [a, b] = arms.map(|arm| arm.half);
        let is_even = (a - b).abs() < EVEN;
        if !is_even && (angle - PI).abs() < TAPER {
            let length = (a - b).abs() * TAPER_LENGTH;
            return Self { arms, angle, shape: CornerShape::Taper(length), reaches: [length; 2] };
        }
        let (shape, more) = if angle < PI && !(is_even && PI - angle < MITRED) {
            (CornerShape::Round(radius), radius / (angle / 2.0).tan())
        } else {
            (CornerShape::Sharp, 0.0)
        };
        // The farthest of the outer edges, and of any that lie inside of them: it changes evenly between.
        let least = a.min(b);
        let farthest = |a: f64, b: f64| meeting(angle, a, b).max(meeting(angle, a - least, b - least));
        let reaches = [farthest(a, b), farthest(b, a)]
            .map(|reach| (reach + more).max(if is_even { 0.0 } else { LEAST }));
        Self { arms, angle, shape, reaches }
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

    /// Its points (m) from the first arm to the second, as seen from the junction, `inside` (m) of the outer edges.
    /// There are as many for each `inside`.
    pub(crate) fn points(&self, inside: f64) -> Vec<DVec2> {
        let [first, second] = self.arms;
        let (a, b) = (first.half - inside, second.half - inside);
        let left = |arm: Arm, along: f64, half: f64| arm.way * along + arm.way.perp() * half;
        match self.shape {
            CornerShape::Round(radius) => {
                let along = meeting(self.angle, first.half, second.half) + radius / (self.angle / 2.0).tan();
                let center = left(first, along, first.half + radius);
                let swept = PI - self.angle;
                let from = (-first.way.perp()).to_angle();
                arc(
                    center,
                    radius + inside,
                    from,
                    -swept,
                    pieces(swept, radius + first.half.min(second.half)),
                )
            }
            CornerShape::Sharp => vec![left(first, meeting(self.angle, a, b), a)],
            CornerShape::Taper(length) => vec![left(first, length, a), left(second, length, -b)],
            CornerShape::Around(radius) => {
                // The two circles are cut off by the same line.
                let reach = self.reaches[0];
                let (from, to) = (left(first, reach, a), left(first, reach, -a));
                let is_circle = radius > first.half + EVEN;
                let round = if is_circle { radius - inside } else { a };
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

/// How many chords an arc of a radius (m) is drawn with.
fn pieces(swept: f64, radius: f64) -> u32 {
    let step = 2.0 * (1.0 - (DEVIATION / radius.max(0.5)).min(0.9)).acos();
    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "at most some hundreds")]
    let count = (swept.abs() / step).ceil().clamp(1.0, 256.0) as u32;
    count
}

/// The points of an arc, one more than it has chords.
fn arc(center: DVec2, radius: f64, from: f64, swept: f64, chords: u32) -> Vec<DVec2> {
    let at =
        |index: u32| center + DVec2::from_angle(from + swept * f64::from(index) / f64::from(chords)) * radius;
    (0..=chords).map(at).collect()
}

/// How far (m) along the first of two streets its edge meets that of the second.
fn meeting(angle: f64, half: f64, next: f64) -> f64 {
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
        Arm { way: DVec2::from_angle(degrees.to_radians()), half }
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
        for first in [3.0, 6.0, 9.0] {
            for second in [3.0, 6.0, 9.0] {
                for degrees in (30..=330).step_by(5) {
                    let arms = [arm(20.0, first), arm(20.0 + f64::from(degrees), second)];
                    let corner = Corner::new(arms, 4.0);
                    for inside in [0.0, 2.0] {
                        let points = corner.points(inside);
                        assert_eq!(points.len(), corner.points(0.0).len());
                        let (from, to) = (points[0], points[points.len() - 1]);
                        let aside = arms[0].way.perp_dot(from);
                        assert!(
                            (aside - (first - inside)).abs() < 0.02,
                            "{degrees} {first} {second}: {aside}"
                        );
                        let aside = arms[1].way.perp_dot(to);
                        assert!(
                            (aside + second - inside).abs() < 0.02,
                            "{degrees} {first} {second}: {aside}"
                        );
                        assert!(arms[0].way.dot(from) <= corner.reaches[0] + 1e-9);
                        assert!(arms[1].way.dot(to) <= corner.reaches[1] + 1e-9);
                    }
                }
            }
        }
    }

    #[test]
    fn a_street_ends_with_a_circle() {
        for radius in [0.0, 8.0] {
            let corner = Corner::around(arm(0.0, 5.0), radius);
            for inside in [0.0, 2.0] {
                let points = corner.points(inside);
                assert_eq!(points[0], DVec2::new(corner.reaches[0], 5.0 - inside));
                assert!(points.iter().any(|at| at.x < -2.9), "it goes around the end");
            }
        }
    }
}
