//! Direction and extent of a ridge.

use glam::DVec2;

use crate::planar::{Polygon, Ring, edges};

/// Direction of a roof with one ridge.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum RidgeAxis {
    /// Ridge along the longer side of the smallest rectangle around the plan.
    Along,
    /// Ridge across the longer side.
    Across,
    /// Direction in which water runs.
    Facing {
        /// Horizontal direction, of length 1.
        down: DVec2,
        /// Maximum angle (radians) by which it is turned so that it is parallel or perpendicular to a wall.
        snap: f64,
    },
}

/// Coordinates of a plan along and across a ridge.
#[derive(Debug, Clone, Copy)]
pub(super) struct RidgeFrame {
    /// Middle of the plan's extent.
    pub middle: DVec2,
    /// Direction of the ridge.
    pub along: DVec2,
    /// Direction in which water runs, perpendicular to the ridge.
    pub down: DVec2,
    /// Half of the extent (m) along the ridge and across it.
    pub half: DVec2,
}

impl RidgeFrame {
    /// Creates the frame of a plan. The ridge is perpendicular to the direction of water, or parallel if `is_end` is set,
    /// as for a hip at one end of the ridge.
    pub(super) fn new(walls: &Polygon, axis: RidgeAxis, is_end: bool) -> Self {
        let longer = longer_side(walls);
        let along = match axis {
            RidgeAxis::Along => longer,
            RidgeAxis::Across => longer.perp(),
            RidgeAxis::Facing { down, snap } => {
                let down = snapped(walls, down, snap);
                if is_end { down } else { down.perp() }
            }
        };
        let down = -along.perp();
        let extent = |way: DVec2| {
            walls
                .points()
                .map(|at| way.dot(at))
                .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), at| (low.min(at), high.max(at)))
        };
        let [(left, right), (back, front)] = [along, down].map(extent);
        let middle = along * left.midpoint(right) + down * back.midpoint(front);
        let half = (DVec2::new(right - left, front - back) / 2.0).max(DVec2::splat(1e-6));
        Self { middle, along, down, half }
    }
}

/// Returns the direction of the longer side of the smallest rectangle around the plan.
fn longer_side(walls: &Polygon) -> DVec2 {
    let Some(hull) = walls.hull() else { return DVec2::X };
    let mut best = (f64::INFINITY, DVec2::X);
    for [a, b] in edges(&hull) {
        let way = (b - a).normalize_or(DVec2::X);
        let size = [way, way.perp()].map(|way| {
            let (low, high) = hull.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), at| {
                (low.min(way.dot(*at)), high.max(way.dot(*at)))
            });
            high - low
        });
        let area = size[0] * size[1];
        if area < best.0 * (1.0 - 1e-9) {
            best = (area, if size[0] >= size[1] - 1e-9 { way } else { way.perp() });
        }
    }
    best.1
}

/// Turns a direction by at most `snap` (radians) until it is parallel or perpendicular to an edge of the outline.
fn snapped(walls: &Polygon, way: DVec2, snap: f64) -> DVec2 {
    let mut best = (snap.sin() + 1e-9, 0.0, way);
    for [a, b] in walls.outer().into_iter().flat_map(Ring::edges) {
        let (side, length) = ((b - a).normalize_or_zero(), a.distance(b));
        for candidate in [side, side.perp(), -side, -side.perp()] {
            let off = candidate.perp_dot(way).abs();
            let is_better = off < best.0 - 1e-6 || (off < best.0 + 1e-6 && length > best.1 + 1e-6);
            if candidate.dot(way) > 0.0 && is_better {
                best = (off, length, candidate);
            }
        }
    }
    best.2
}
