//! The options of roofs.

use super::detail::RoofDetail;
use super::direction::CompassDirection;
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
    /// Height of the highest ridge above the eaves (m). If omitted, it follows from `slope`.
    pub height: Option<f64>,
    /// Slope (degrees) from the eaves to the highest ridge, if no height is given.
    #[default(35.0)]
    pub slope: f64,
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
