//! Joints between segments of an extruder.

use burgeon_geometry::{Frame, Segment};
use glam::DQuat;

use super::state::SolidRun;

/// Maximum angle (radians) between two segments that are joined. A mitre of a larger angle would be long and sharp.
const SHARPEST: f64 = 2.1;

/// Minimum angle (radians) of a mitre.
const LEAST: f64 = 1e-9;

/// Joint between the end of a solid and its next segment: none if the segment continues straight, otherwise a mitre.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Joint {
    /// Set if the segment begins in the frame in which the solid ends.
    pub is_straight: bool,
    /// Length (m) that a mitre takes of the segments on both sides.
    pub length: f64,
    /// Rotation of the segment's frame about its heading (radians) relative to the solid, after the bend.
    pub roll: f64,
}

impl Joint {
    /// Returns the joint between the end of `run` and `segment`, which begins in `frame`. Returns `None` if they are not
    /// joined: if they do not meet, if the frame rolls more than it bends, or if a segment is too short for a mitre.
    pub(super) fn between(run: &SolidRun, frame: Frame, segment: &Segment) -> Option<Self> {
        if run.end == frame {
            return Some(Self { is_straight: true, length: 0.0, roll: 0.0 });
        }
        let meets = run.end.position == frame.position;
        let angle = run.end.heading.angle_between(frame.heading);
        if !meets || !(LEAST..=SHARPEST).contains(&angle) || run.scale.min_element() <= 0.0 {
            return None;
        }
        let transported = DQuat::from_rotation_arc(run.end.heading, frame.heading) * run.end.left;
        let roll = frame.up.dot(transported).atan2(frame.left.dot(transported));
        let length = (run.section.reach() * run.scale).length() * (angle / 2.0).tan();
        let first = segment.length / segment.steps as f64;
        (roll.abs() <= angle && length < run.free && length < first).then_some(Self {
            is_straight: false,
            length,
            roll,
        })
    }
}
