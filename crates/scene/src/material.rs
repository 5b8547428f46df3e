//! How surfaces look, as physically based materials.

use std::path::PathBuf;
use std::sync::Arc;

/// A metallic-roughness material. Colours are linear, 0 to 1.
#[derive(Debug, Clone, PartialEq)]
pub struct Material {
    /// A name for people; may be empty.
    pub name: String,
    /// Red, green, blue and opacity.
    pub base_color: [f32; 4],
    /// 0 for wood, stone and plaster, 1 for bare metal.
    pub metallic: f32,
    /// 0 like a mirror, 1 like chalk.
    pub roughness: f32,
    /// Light that the surface gives off itself.
    pub emissive: [f32; 3],
    /// An image that multiplies the base colour.
    pub texture: Option<Texture>,
    /// Whether both sides are seen, as with leaves.
    pub double_sided: bool,
}

/// An image laid over a surface at its real size.
#[derive(Debug, Clone, PartialEq)]
pub struct Texture {
    /// A PNG or JPEG file; the name of the image if it has no file of its own.
    pub path: PathBuf,
    /// Width and height (m) of one repetition.
    pub size: [f64; 2],
    /// What the file would hold, if the image came inside another one.
    pub content: Option<Arc<[u8]>>,
}

impl Default for Material {
    /// Light grey, dull, one-sided.
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
