//! The state with which a turtle draws.

use std::sync::Arc;

use burgeon_geometry::{Curve, Frame, Strand};
use burgeon_kit::{Drawing, Rescale};
use glam::{DAffine3, DVec3};

use super::Turtle;
use super::cylinder::OpenCylinder;
use super::joined::BranchPlace;
use super::options::TurtleOptions;
use super::tropism::{SimpleTropism, TorqueSum, Tropism};
use crate::surface::plain_material;
use burgeon_base::error::{Error, Result};

/// Frame, width, material and open shapes of a turtle, which a branch restores.
#[derive(Clone)]
pub(super) struct TurtleState {
    pub(super) frame: Frame,
    /// Diameter of branches (m), scaled.
    pub(super) width: f64,
    /// Factor of lengths and widths.
    pub(super) scale: f64,
    /// Part of the drawing, which has the material.
    pub(super) part: usize,
    pub(super) tropism: DVec3,
    pub(super) elasticity: f64,
    /// Tropisms in addition to that one.
    pub(super) more_tropisms: Vec<Tropism>,
    pub(super) torques: TorqueSum,
    pub(super) simple: SimpleTropism,
    /// Branch that is being drawn.
    pub(super) strand: Option<Branch>,
    /// Contour of generalised cylinders; a circle if there is none.
    pub(super) contour: Option<Arc<Curve>>,
    /// Generalised cylinder that is being drawn.
    pub(super) cylinder: Option<Box<OpenCylinder>>,
    /// Place among the branches that the end draws as one surface.
    pub(super) joined: BranchPlace,
}

/// A strand, the part that it is drawn into, and the module that drew its last segment.
#[derive(Clone)]
pub(super) struct Branch {
    pub(super) part: usize,
    pub(super) strand: Strand,
    pub(super) maker: u32,
}

impl TurtleState {
    /// Creates the state at the start of a pass.
    pub(super) fn begin(options: &TurtleOptions, drawing: &mut Drawing) -> Self {
        let mut frame = Frame::default();
        frame.face(options.heading.0);
        let material = plain_material(options.color, options.roughness, options.metallic);
        Self {
            frame,
            width: options.width,
            scale: 1.0,
            part: drawing.material(&material),
            tropism: options.tropism.0.normalize_or_zero(),
            elasticity: options.elasticity,
            more_tropisms: Vec::new(),
            torques: TorqueSum::default(),
            simple: SimpleTropism::new(options.simple_tropism.0, options.simple_elasticity),
            strand: None,
            contour: None,
            cylinder: None,
            joined: BranchPlace::default(),
        }
    }

    /// Multiplies the lengths and widths from now on by `factor`.
    pub(super) fn rescale(&mut self, factor: f64) -> Result<()> {
        let scale = self.scale * factor;
        if !(factor > 0.0 && scale > 0.0 && scale.is_finite()) {
            let error = Error::argument(format!("the scale must be above 0 and finite, not {factor}"));
            return Err(error.help("use 0.5 for half of the size"));
        }
        (self.scale, self.width) = (scale, self.width * factor);
        Ok(())
    }

    /// Returns the transform from the coordinates of scaled shapes at the turtle.
    pub(super) fn transform(&self) -> DAffine3 {
        let transform = self.frame.transform();
        match self.scale == 1.0 {
            // A product would change the signs of zeros.
            true => transform,
            false => transform * DAffine3::from_scale(DVec3::splat(self.scale)),
        }
    }
}

impl Rescale for Turtle {
    fn rescale(&mut self, factor: f64) -> Result<()> {
        self.state.rescale(factor)
    }
}
