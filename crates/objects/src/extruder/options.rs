//! The fields of extruders.

use burgeon_base::error::{Error, Result};
use burgeon_kit::{Color, Vector, fields};
use glam::DVec3;

/// Fields of `extruder { ... }`.
#[fields("extruder")]
pub struct ExtruderOptions {
    /// Number of sides of the cross-section, a regular polygon with radius 1.
    #[default(16)]
    pub sides: u32,
    /// Points of the cross-section, as { { x, y }, ... }, instead of `sides`.
    pub shape: Vec<Vector>,
    /// Smooth shading. Corners of the cross-section above 40 degrees stay sharp.
    #[default(true)]
    pub smooth: bool,
    /// Number of divisions of a segment. With 0, one division for every 10 degrees of bend or twist.
    #[default(0)]
    pub along: u32,
    /// Number of points around the cross-section. With 0, the points of its shape.
    #[default(0)]
    pub around: u32,
    /// Close the ends.
    #[default(true)]
    pub caps: bool,
    /// Colour of the surfaces.
    #[default(Color([0.62, 0.58, 0.52, 1.0]))]
    pub color: Color,
    /// Roughness: 0 like a mirror, 1 like chalk.
    #[default(0.7)]
    pub roughness: f64,
    /// Metalness: 0 for wood, stone and plaster, 1 for bare metal.
    #[default(0.0)]
    pub metallic: f64,
    /// Start position (m).
    #[default(Vector(DVec3::ZERO))]
    pub position: Vector,
    /// Initial direction of extrusion.
    #[default(Vector(DVec3::Z))]
    pub heading: Vector,
}

/// Fails unless the numbers of divisions are at most 4096.
pub(super) fn check_resolution(along: u32, around: u32) -> Result<()> {
    for (name, count) in [("along", along), ("around", around)] {
        if count > 4096 {
            return Err(Error::argument(format!("extruder: {name} must be at most 4096, not {count}")));
        }
    }
    Ok(())
}
