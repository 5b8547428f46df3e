//! Roofs over faces of shapes.

use burgeon_base::error::Result;
use burgeon_kit::fields;
use glam::DVec2;

use super::object::{ShapeObject, warn};
use crate::roofs::{Roof, RoofLines, RoofPoints, roof_map, roof_shape};

/// Options of `shape:roof { ... }`.
#[fields("shape:roof")]
pub struct ShapeRoofOptions {
    /// Roof type, as of `footprint:roof`.
    #[default("hip".into())]
    pub kind: String,
    /// Height of the highest ridge above the face (m). If omitted, it follows from `slope`.
    pub height: Option<f64>,
    /// Slope (degrees) from the eaves to the highest ridge, if no height is given; 35 if there are no `levels` either.
    pub slope: Option<f64>,
    /// Number of storeys in the roof, of 3 m each, for its height if neither height nor slope is given, and for the bend of a
    /// mansard or gambrel roof.
    pub levels: Option<f64>,
    /// Overhang beyond the face (m).
    #[default(0.0)]
    pub overhang: f64,
    /// Ridges, as of `footprint:roof`, with heights (m) above the face.
    pub ridges: RoofLines,
    /// Other edges of the surface, such as hips and valleys, as of `footprint:roof`.
    pub edges: RoofLines,
    /// Highest points, as of `footprint:roof`.
    pub apexes: RoofPoints,
}

impl ShapeObject {
    /// Returns the roof over a face, and warns of its differences from the request.
    pub(super) fn build_roof(&self, options: ShapeRoofOptions) -> Result<Self> {
        let ShapeRoofOptions { kind, height, slope, levels, overhang, ridges, edges, apexes } = options;
        let roof = Roof { kind, height, slope, levels, overhang, ridges, edges, apexes, ..Roof::default() };
        let shape = roof_shape(&roof).map_err(|error| error.about("shape:roof"))?;
        let map = roof_map(&roof, DVec2::ZERO).map_err(|error| error.about("shape:roof"))?;
        let made = self.shape.roof(&shape, map.as_ref()).map_err(|error| error.about("shape:roof"))?;
        for remark in made.remarks {
            let text = format!("the {} roof differs: {remark}", roof.kind);
            warn("roof", &text, "use a plan that suits the kind");
        }
        for line in made.unused {
            warn("roof", &line.text(DVec2::ZERO), line.help());
        }
        Ok(self.with_shape(made.shape))
    }
}
