//! Generalised cylinders that a turtle draws.

use std::sync::Arc;

use burgeon_base::error::{Error, Result};
use burgeon_geometry::{Curve, CylinderPoint, Frame, generalized_cylinder};
use burgeon_kit::{Drawing, fields};
use glam::DVec3;

/// Options of `turtle:begin_cylinder`.
#[fields("turtle:begin_cylinder")]
pub struct CylinderOptions {
    /// Twist the surface: at each control point, the x direction of the contour points to the right of the turtle.
    #[default(false)]
    pub twist: bool,
}

/// A generalised cylinder that is not complete.
#[derive(Clone)]
pub(super) struct OpenCylinder {
    part: usize,
    /// Module that began it.
    maker: u32,
    side: DVec3,
    /// Set if the surface twists with the turtle.
    twists: bool,
    points: Vec<CylinderPoint>,
}

impl OpenCylinder {
    /// Begins a cylinder in the part of `drawing` at the index `part`, with its first point at `frame`.
    pub(super) fn begin(drawing: &Drawing, part: usize, frame: &Frame, twists: bool) -> Self {
        // The x direction of a frame is to its right.
        Self { part, maker: drawing.maker(), side: -frame.left, twists, points: Vec::new() }
    }

    /// Adds a control point at `frame` with a diameter (m).
    pub(super) fn add(&mut self, frame: &Frame, width: f64, contour: Option<&Arc<Curve>>) {
        self.points.push(CylinderPoint {
            position: frame.position,
            radius: width / 2.0,
            contour: contour.cloned(),
            side: self.twists.then_some(-frame.left),
        });
    }

    /// Draws the cylinder with at least this number of `sides`.
    pub(super) fn draw(self, drawing: &mut Drawing, sides: u32) -> Result<()> {
        let Self { part, maker, side, points, .. } = self;
        drawing.draw_for(maker, part, |part| generalized_cylinder(part, points, side, sides as usize))
    }
}

/// Returns the error for a cylinder that begins within another.
#[cold]
pub(super) fn already_open() -> Error {
    Error::script("turtle:begin_cylinder: a cylinder is already open")
        .help("end it with end_cylinder(), or begin the other in a branch")
}

/// Returns the error for the end of a cylinder that has not begun.
#[cold]
pub(super) fn not_open() -> Error {
    Error::script("turtle:end_cylinder: no cylinder is open").help("begin it with begin_cylinder()")
}
