//! The state with which a turtle draws.

use std::sync::Arc;

use burgeon_geometry::{Curve, Frame, Strand};
use burgeon_kit::Drawing;
use glam::DVec3;

use super::cylinder::OpenCylinder;
use super::joined::BranchPlace;
use super::options::TurtleOptions;
use super::tropism::Tropism;
use crate::surface::plain_material;

/// Frame, width, material and open shapes of a turtle, which a branch restores.
#[derive(Clone)]
pub(super) struct TurtleState {
    pub(super) frame: Frame,
    pub(super) width: f64,
    /// Part of the drawing, which has the material.
    pub(super) part: usize,
    pub(super) tropism: DVec3,
    pub(super) elasticity: f64,
    /// Tropisms in addition to that one.
    pub(super) more_tropisms: Vec<Tropism>,
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
            part: drawing.material(&material),
            tropism: options.tropism.0.normalize_or_zero(),
            elasticity: options.elasticity,
            more_tropisms: Vec::new(),
            strand: None,
            contour: None,
            cylinder: None,
            joined: BranchPlace::default(),
        }
    }
}
