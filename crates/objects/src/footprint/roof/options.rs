//! The options of roofs.

use super::detail::RoofDetail;
use crate::MaterialOptions;
use burgeon_kit::{Color, fields};

/// Options of `footprint:roof { ... }`.
#[fields("footprint:roof")]
pub struct Roof {
    /// Roof type: "flat", "shed", "gable", "gambrel", "shed_gambrel", "hip", "mansard", "pagoda", "porch" or
    /// "dutch_hip".
    #[default("hip".into())]
    pub kind: String,
    /// Height of the highest ridge above the eaves (m). If omitted, it follows from `slope`.
    pub height: Option<f64>,
    /// Slope (degrees) from the eaves to the highest ridge, if no height is given.
    #[default(35.0)]
    pub slope: f64,
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
