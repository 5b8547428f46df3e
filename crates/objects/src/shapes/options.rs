//! Tables of options of shapes.

use burgeon_kit::fields;

/// Options of `shape:roof { ... }`.
#[fields("shape:roof")]
pub struct ShapeRoofOptions {
    /// Roof type, as of `footprint:roof`.
    #[default("hip".into())]
    pub kind: String,
    /// Height of the highest ridge above the face (m). If omitted, it follows from `slope`.
    pub height: Option<f64>,
    /// Slope (degrees) from the eaves to the highest ridge, if no height is given.
    #[default(35.0)]
    pub slope: f64,
    /// Overhang beyond the face (m).
    #[default(0.0)]
    pub overhang: f64,
}

/// Options of `shape:scatter`.
#[fields("shape:scatter")]
pub struct ScatterOptions {
    /// Seed of the positions, such as random().
    #[default(0.0)]
    pub seed: f64,
    /// Place of the positions: "faces", "volume", the inside of a solid, or "scope", the box around the shape.
    #[default("faces".into())]
    pub within: String,
}
