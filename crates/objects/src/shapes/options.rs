//! Tables of options of shapes.

use burgeon_kit::fields;

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
