//! Fields of the turtle's constructor.

use burgeon_base::error::Result;
use burgeon_kit::{Color, Vector, fields};
use glam::DVec3;

use crate::curves::choice::variant;

/// Fields of `turtle { ... }`.
#[fields("turtle")]
pub struct TurtleOptions {
    /// Default length of a step (m).
    #[default(1.0)]
    pub step: f64,
    /// Default angle of a turn (degrees).
    #[default(90.0)]
    pub angle: f64,
    /// Diameter of branches (m).
    #[default(0.1)]
    pub width: f64,
    /// Number of faces around branches.
    #[default(8)]
    pub sides: u32,
    /// Joints of branches: "separate", so that each branch is a closed tube that begins inside its parent; or "smooth", so that
    /// all branches of one material are one closed surface, which the end of the chain draws.
    #[default("separate".into())]
    pub joints: String,
    /// Colour of the surfaces.
    #[default(Color([0.22, 0.13, 0.07, 1.0]))]
    pub color: Color,
    /// Roughness: 0 like a mirror, 1 like chalk.
    #[default(0.85)]
    pub roughness: f64,
    /// Metalness: 0 for wood, stone and plaster, 1 for bare metal.
    #[default(0.0)]
    pub metallic: f64,
    /// Colours for `paint`, numbered from 1.
    pub palette: Vec<Color>,
    /// Start position (m).
    #[default(Vector(DVec3::ZERO))]
    pub position: Vector,
    /// Initial heading.
    #[default(Vector(DVec3::Z))]
    pub heading: Vector,
    /// Direction towards which the heading bends with each step drawn.
    #[default(Vector(DVec3::NEG_Z))]
    pub tropism: Vector,
    /// Strength of the bending, from 0; 0.2 is strong.
    #[default(0.0)]
    pub elasticity: f64,
    /// Direction of the simple tropism of cpfg and lpfg.
    #[default(Vector(DVec3::Z))]
    pub simple_tropism: Vector,
    /// Strength of the simple tropism.
    #[default(0.0)]
    pub simple_elasticity: f64,
    /// Strength that `simple_elasticity` adds without a value, as `_` does in cpfg.
    #[default(0.0)]
    pub simple_increment: f64,
}

impl TurtleOptions {
    /// Returns true if branches are one surface; fails if `joints` is unknown.
    pub(super) fn joins(&self) -> Result<bool> {
        variant("turtle", "joints", &self.joints, &[("separate", false), ("smooth", true)])
    }
}
