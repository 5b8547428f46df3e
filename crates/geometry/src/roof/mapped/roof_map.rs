//! Lines of a roof as maps have them, and the reasons for which some cannot be used.

use std::fmt;

use glam::{DVec2, DVec3};

/// Lines of the surface of a roof, in the coordinates of the plan.
///
/// The third coordinate of a point is its height (m) above the eaves, or 0: the height of the roof for ridges and apexes; for
/// other edges, the height follows from the lines and the outline that they meet.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct RoofMap {
    /// Ridges.
    pub ridges: Vec<Vec<DVec3>>,
    /// Other edges of the surface, such as hips and valleys.
    pub edges: Vec<Vec<DVec3>>,
    /// Highest points.
    pub apexes: Vec<DVec3>,
}

/// Type of a line of a [`RoofMap`].
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum MapLineKind {
    /// A ridge.
    Ridge,
    /// Another edge.
    Edge,
    /// An apex.
    Apex,
}

impl fmt::Display for MapLineKind {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str(match self {
            Self::Ridge => "ridge",
            Self::Edge => "edge",
            Self::Apex => "apex",
        })
    }
}

/// Reason for which a line is not used as it is given.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum MapProblem {
    /// Fewer than two different points.
    Empty,
    /// A part outside the plan.
    Outside,
    /// A crossing with an earlier line.
    Crossing,
    /// A height below the eaves.
    BelowEaves,
    /// An edge without a height, as it meets neither another line nor the outline.
    NoHeight,
    /// A height (m) that differs from that of an earlier line (m) at the same place.
    OtherHeight(f64, f64),
}

/// A line that is not used, or not as it is given.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct UnusedLine {
    /// Type of the line.
    pub kind: MapLineKind,
    /// Number of the line among those of its type, from 1.
    pub number: usize,
    /// Place of the problem (m), in the coordinates of the plan.
    pub at: DVec2,
    /// Reason.
    pub problem: MapProblem,
}

impl UnusedLine {
    /// Returns the description of the problem, with its place after moving it by `offset` (m).
    pub fn text(&self, offset: DVec2) -> String {
        let Self { kind, number, problem, .. } = self;
        let at = self.at + offset;
        let at = format!("({:.2}, {:.2})", at.x, at.y);
        match problem {
            MapProblem::Empty => {
                format!("{kind} {number} has fewer than two different points and is left out")
            }
            MapProblem::Outside => format!("{kind} {number} leaves the plan at {at} and is left out"),
            MapProblem::Crossing => format!("{kind} {number} crosses another line at {at} and is left out"),
            MapProblem::BelowEaves => format!("{kind} {number} is below the eaves at {at} and is left out"),
            MapProblem::NoHeight => {
                format!("{kind} {number} at {at} has no height, as it meets no other line, and is left out")
            }
            MapProblem::OtherHeight(own, other) => {
                format!(
                    "{kind} {number} has the height {own:.2} m at {at}, where another line has {other:.2} m, which is used"
                )
            }
        }
    }

    /// Returns the remedy.
    pub fn help(&self) -> &'static str {
        match self.problem {
            MapProblem::Empty => "give at least two points",
            MapProblem::Outside => "end the line at the outline of the plan",
            MapProblem::Crossing => "give both lines a point where they cross",
            MapProblem::BelowEaves => "give heights above the eaves (m), or none",
            MapProblem::NoHeight => "join the edge to a ridge or to the outline, or give its points a height",
            MapProblem::OtherHeight(..) => "give one height to each point",
        }
    }
}
