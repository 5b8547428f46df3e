//! Physically based materials.

use std::path::PathBuf;
use std::sync::Arc;

/// Metallic-roughness material. Colours are linear, 0 to 1.
#[derive(Debug, Clone, PartialEq)]
pub struct Material {
    /// Display name; may be empty.
    pub name: String,
    /// Red, green, blue and opacity.
    pub base_color: [f32; 4],
    /// Metallic fraction: 0 for wood, stone and plaster, 1 for bare metal.
    pub metallic: f32,
    /// Roughness: 0 for a mirror, 1 for chalk.
    pub roughness: f32,
    /// Light that the surface emits.
    pub emissive: [f32; 3],
    /// Image that multiplies the base colour.
    pub texture: Option<Texture>,
    /// Set if both sides are visible, as with leaves.
    pub double_sided: bool,
}

/// Image on a surface at its real size.
#[derive(Debug, Clone, PartialEq)]
pub struct Texture {
    /// Path of a PNG or JPEG file, or the name of an image without a file.
    pub path: PathBuf,
    /// Width and height (m) of one repetition.
    pub size: [f64; 2],
    /// Content of the file, if the image was embedded in another file.
    pub content: Option<Arc<[u8]>>,
}

impl Default for Material {
    /// Returns a light grey, matt, one-sided material.
    fn default() -> Self {
        Self {
            name: String::new(),
            base_color: [0.6, 0.6, 0.6, 1.0],
            metallic: 0.0,
            roughness: 0.8,
            emissive: [0.0; 3],
            texture: None,
            double_sided: false,
        }
    }
}
