//! The fields of planets.

use crate::terrain::{GroundCover, RuleLayers, Water};
use burgeon_kit::{Color, Seed, Vector, fields};
use glam::DVec3;

/// Fields of `planet { ... }`.
#[fields("planet")]
pub struct PlanetOptions {
    /// Radius (m).
    #[default(6_371_000.0)]
    pub radius: f64,
    /// Rules that divide the six faces: a rule table, a system, or a list of these by level.
    pub rules: RuleLayers,
    /// Symbol of each face. If omitted, the first symbol by name.
    pub start: Option<String>,
    /// Initial height (m) of the whole surface.
    #[default(0.0)]
    pub height: f64,
    /// Initial factor (m) for the height changes of a rule table.
    #[default(4000.0)]
    pub decay: f64,
    /// Maximum number of divisions of a face near the eye.
    #[default(20)]
    pub levels: u32,
    /// Maximum distance of the eye for a division, in tile sizes. A tile is divided while the eye is closer.
    #[default(3.0)]
    pub closeness: f64,
    /// Smooth interpolation of the surface between cells. If false, each cell keeps its own height.
    #[default(true)]
    pub smooth: bool,
    /// Maximum distance between the triangles and the surface, in sizes of the local cells.
    #[default(0.05)]
    pub error: f64,
    /// Centre (m).
    #[default(Vector(DVec3::ZERO))]
    pub position: Vector,
    /// Direction of the north pole, which defines latitudes.
    #[default(Vector(DVec3::Z))]
    pub axis: Vector,
    /// Seed of the random numbers: a number or a string. If omitted, the run's seed.
    pub seed: Option<Seed>,
    /// Omit tiles below the horizon of the focus, and keep them coarse.
    pub horizon: bool,
    /// Ground covers, from bottom to top.
    pub covers: Vec<GroundCover>,
    /// Colour of the ground if there are no covers.
    #[default(Color([0.30, 0.28, 0.22, 1.0]))]
    pub color: Color,
    /// Seas: their level (m), or a table of fields.
    pub water: Option<Water>,
    /// Cover on the water, such as ice near the poles.
    pub ice: Option<GroundCover>,
}
