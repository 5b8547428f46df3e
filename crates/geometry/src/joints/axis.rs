//! Axes that form a tree.

use glam::DVec3;

use crate::limits::MOST;
use crate::sweeps::control_point::CylinderPoint;
use burgeon_base::error::{Error, Result};

/// An axis of a tree of tubes.
#[derive(Debug, Clone, Default)]
pub struct JointAxis {
    /// Control points, the first at the point of the parent.
    pub points: Vec<CylinderPoint>,
    /// Direction of the outline's x at the start.
    pub side: DVec3,
    /// Point of an earlier axis at which the axis begins.
    pub parent: Option<AxisPoint>,
    /// Set for a smooth curve through the points, as in a generalised cylinder. Otherwise segments are straight, with a
    /// mitre at each bend.
    pub smooth: bool,
}

/// A control point of an axis.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub struct AxisPoint {
    /// Index of the axis.
    pub axis: usize,
    /// Index of the point on the axis.
    pub point: usize,
}

/// Result of [`joined_tubes`](crate::joined_tubes).
#[derive(Debug, Clone, Default, PartialEq)]
pub struct JoinedTubes {
    /// Runs of the added triangles: the control point to which they lead, and their number.
    pub runs: Vec<(AxisPoint, usize)>,
    /// Number of joints.
    pub joints: usize,
    /// Control points at which an axis does not fit into the joint, so that its part there is another closed body.
    pub separate: Vec<AxisPoint>,
}

impl JoinedTubes {
    /// Attributes `count` more triangles to a control point.
    pub(super) fn add_run(&mut self, to: AxisPoint, count: usize) {
        match self.runs.last_mut() {
            Some((last, sum)) if *last == to => *sum += count,
            _ if count == 0 => {}
            _ => self.runs.push((to, count)),
        }
    }
}

/// The points of an axis without those at the position of their predecessor.
pub(super) struct AxisPoints {
    pub(super) points: Vec<CylinderPoint>,
    /// Index among `points` of each given point.
    pub(super) kept: Vec<usize>,
    /// Index of the last given point of each of `points`.
    pub(super) given: Vec<usize>,
}

impl AxisPoints {
    /// Checks and copies `points`; fails if a number is not finite.
    pub(super) fn new(points: &[CylinderPoint]) -> Result<Self> {
        let mut all = Self { points: Vec::with_capacity(points.len()), kept: Vec::new(), given: Vec::new() };
        for (index, point) in points.iter().enumerate() {
            let CylinderPoint { position, radius, .. } = point;
            let radius = radius.abs();
            if !position.is_finite() || position.abs().max_element() > MOST || !(0.0..=MOST).contains(&radius)
            {
                let DVec3 { x, y, z } = position;
                let message = format!("a branch has a point at ({x}, {y}, {z}) with a radius of {radius}");
                return Err(Error::geometry(message)
                    .help("give a position and a radius in metres, within 1e9 of the origin"));
            }
            let point = CylinderPoint { radius, ..point.clone() };
            // The last of several points at one position counts, as the width of a branch does.
            match all.points.last_mut() {
                Some(last) if last.position.distance(*position) <= rounding(*position) => {
                    *last = CylinderPoint { position: last.position, ..point };
                    all.given[all.points.len() - 1] = index;
                }
                _ => {
                    all.points.push(point);
                    all.given.push(index);
                }
            }
            all.kept.push(all.points.len() - 1);
        }
        Ok(all)
    }

    /// Returns true if the axis has a length and a radius.
    pub(super) fn is_drawn(&self) -> bool {
        self.points.len() > 1 && self.points.iter().any(|point| point.radius > 0.0)
    }
}

/// Returns a length (m) of a few times the export precision at `position`.
#[inline]
pub(super) fn rounding(position: DVec3) -> f64 {
    1e-6 + position.abs().max_element() * 5e-7
}
