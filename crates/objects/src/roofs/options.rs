//! The options of roofs.

use super::detail::RoofDetail;
use super::direction::CompassDirection;
use super::lines::{RoofLines, RoofPoints};
use crate::MaterialOptions;
use burgeon_kit::{Color, fields};

/// Options of `footprint:roof { ... }`.
#[fields("footprint:roof")]
pub struct Roof {
    /// Roof type: "flat", "shed", "gable", "gambrel", "shed_gambrel", "bellcast", "saltbox", "clerestory", "sawtooth",
    /// "butterfly", "round", "cross_gable", "gablet", "hip", "dutch_hip", "side_hip", "side_dutch_hip", "mansard", "pagoda",
    /// "porch", "pyramid", "cone", "dome" or "onion".
    #[default("hip".into())]
    pub kind: String,
    /// Height of the highest ridge above the eaves (m). If omitted, it follows from `slope` or from `levels`.
    pub height: Option<f64>,
    /// Slope (degrees) from the eaves to the highest ridge, if no height is given; 35 if there are no `levels` either.
    pub slope: Option<f64>,
    /// Number of storeys in the roof, of 3 m each, for its height if neither height nor slope is given. From 2 storeys, the bend
    /// of a mansard or gambrel roof is at a floor.
    pub levels: Option<f64>,
    /// Ridges inside the plan: a list of lines, each a list of points (m) or a line geometry. If a ridge, an edge or an apex is
    /// given, they define the surface instead of the kind. The third coordinate of a point is its height (m) above the eaves; 0
    /// for that of the roof.
    pub ridges: RoofLines,
    /// Other edges of the surface, such as hips and valleys: a list of lines. Their heights follow from the ridges and the outline
    /// that they meet, unless their points have one.
    pub edges: RoofLines,
    /// Highest points of the surface: a list of points (m), with heights as those of ridges.
    pub apexes: RoofPoints,
    /// Direction in which water runs (degrees clockwise from north), or a point of the compass, "N" to "NNW". One ridge then
    /// crosses the whole plan. The direction is turned to the nearest wall within 45 degrees for a point of the compass, 10 for
    /// whole degrees and 0.5 for others.
    pub direction: Option<CompassDirection>,
    /// Orientation of the one ridge, instead of `direction`: "along" or "across" the longer side of the plan.
    pub orientation: Option<String>,
    /// Overhang beyond the outermost walls (m), where there is room.
    #[default(0.0)]
    pub overhang: f64,
    /// Eaves type: "closed", with a level underside; "slab", with upright faces along the outline too; or "open", a
    /// plate that follows the slope. The default is "slab" if `slab` is given, and "closed" otherwise.
    pub eaves: Option<String>,
    /// Height of the upright faces along the outline, and of the edge of a plate (m). If 0, it is 0.15 where one is
    /// needed.
    #[default(0.0)]
    pub slab: f64,
    /// Height of the border of a flat roof (m).
    #[default(0.0)]
    pub border: f64,
    /// Width of the border of a flat roof (m).
    #[default(0.3)]
    pub border_width: f64,
    /// Colour of the roof.
    pub color: Option<Color>,
    /// Material of the roof, instead of the colour.
    pub material: Option<MaterialOptions>,
    /// Material of gables. If omitted, the material of the walls below.
    pub gable: Option<MaterialOptions>,
    /// Material of slabs and borders. If omitted, the roof's material.
    pub trim: Option<MaterialOptions>,
    /// Material of undersides. If omitted, the material of slabs.
    pub underside: Option<MaterialOptions>,
    /// Gables on party walls that run away from the street, as in a row of houses.
    #[default(true)]
    pub party_gables: bool,
    /// Objects on the roof: a list of { model, on, every, ... }.
    pub details: Vec<RoofDetail>,
}
