//! Control points of generalised cylinders.

use std::sync::Arc;

use glam::DVec3;

use crate::curves::curve::Curve;

/// A control point of a generalised cylinder.
#[derive(Debug, Clone)]
pub struct CylinderPoint {
    /// Position on the axis (m).
    pub position: DVec3,
    /// Radius (m), by which the contour is scaled.
    pub radius: f64,
    /// Closed curve in the plane z = 0; a circle with radius 1 if there is none.
    pub contour: Option<Arc<Curve>>,
    /// Direction of the contour's x. Between points that have one, the surface twists by at most half a turn.
    pub side: Option<DVec3>,
}
