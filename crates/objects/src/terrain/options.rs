//! The fields of terrains.

use glam::DVec3;

use super::edits::EditFile;
use super::looks::GroundCover;
use super::plants::Plants;
use super::rules::RuleLayers;
use super::sides::Underside;
use super::streets::StreetsOnGround;
use super::water::Water;
use crate::Elevation;
use burgeon_kit::{Color, Vector, fields};

/// Fields of `terrain { ... }`.
#[fields("terrain")]
pub struct TerrainOptions {
    /// Length (m) of the sides.
    #[default(1024.0)]
    pub size: f64,
    /// Number of divisions of the whole terrain. If omitted, only the focus is expanded.
    pub levels: Option<u32>,
    /// Rules that divide the cells: a rule table, a system, or a list of these by level.
    pub rules: RuleLayers,
    /// Symbol of the first cell. If omitted, the first symbol by name.
    pub start: Option<String>,
    /// Initial height (m) of the whole terrain.
    #[default(0.0)]
    pub height: f64,
    /// Initial factor (m) for the height changes of a rule table.
    #[default(100.0)]
    pub decay: f64,
    /// Smooth interpolation between cells and between measured samples. If false, each cell keeps its own height, and
    /// the ground is straight between samples.
    #[default(true)]
    pub smooth: bool,
    /// Mapping of heights (m): pairs { from, to }, with linear interpolation between them.
    pub remap: Vec<Vec<f64>>,
    /// Maximum distance (m) between the triangles and the surface. If omitted, a tenth of the smallest cell.
    pub error: Option<f64>,
    /// Centre of the square (m). Its z is added to all heights.
    #[default(Vector(DVec3::ZERO))]
    pub position: Vector,
    /// Measured heights, which the ground has at each sample; the rules add detail between samples:
    /// elevation("N43E007.hgt").
    pub elevation: Option<Elevation>,
    /// Stored terrain edits: edits("ground.json").
    pub edits: Option<EditFile>,
    /// Streets on the terrain: the ground is cut and filled to meet the edges of their sidewalks, with slopes next to
    /// them.
    pub under: Option<StreetsOnGround>,
    /// Visible; a hidden terrain can still be queried, and streets can use it.
    #[default(true)]
    pub visible: bool,
    /// Ground covers, from bottom to top.
    pub covers: Vec<GroundCover>,
    /// Height (m) of the underside, or "auto" for a height below the lowest ground. If given, the terrain is a closed solid
    /// with sides.
    pub base: Option<Underside>,
    /// Colour of the sides.
    #[default(Color([0.16, 0.12, 0.09, 1.0]))]
    pub sides: Color,
    /// Colour of the ground if there are no covers.
    #[default(Color([0.30, 0.28, 0.22, 1.0]))]
    pub color: Color,
    /// Standing water: its level (m), or a table of fields.
    pub water: Option<Water>,
    /// Plants on the terrain.
    pub plants: Vec<Plants>,
}
