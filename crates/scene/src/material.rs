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
    /// Normal map, of the same size as the texture.
    pub normal_map: Option<NormalMap>,
    /// Image over the texture, with a size and coordinates of its own.
    pub dirt_map: Option<DirtMap>,
    /// Set if both sides are visible, as with leaves.
    pub double_sided: bool,
}

/// Image of the relief of a surface, which changes its shading and not its shape.
#[derive(Debug, Clone, PartialEq)]
pub struct NormalMap {
    /// Image whose red, green and blue are the normal's part to the right, upwards and outwards, from -1 to 1.
    pub image: Texture,
    /// Factor of the slopes: 0 for a flat surface, 1 for those of the image.
    pub scale: f32,
}

/// Image that multiplies the colour of a surface on top of its texture, such as dirt, wear or painted shade.
#[derive(Debug, Clone, PartialEq)]
pub struct DirtMap {
    /// The image.
    pub image: Texture,
    /// Name of the set of texture coordinates; empty for those of the texture, at the size of the image.
    pub set: Arc<str>,
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

impl Material {
    /// Returns the images of the material: its texture, its normal map and its dirt map.
    pub fn images(&self) -> impl Iterator<Item = &Texture> {
        let relief = self.normal_map.as_ref().map(|map| &map.image);
        self.texture.iter().chain(relief).chain(self.dirt_map.as_ref().map(|map| &map.image))
    }

    /// Returns the width and height (m) of one repetition of the texture and the normal map, otherwise of the dirt map; `None` if
    /// the material has no image.
    ///
    /// ```
    /// use burgeon_scene::{Material, NormalMap, Texture};
    ///
    /// let image = Texture { path: "brick.png".into(), size: [2.0, 1.0], content: None };
    /// let brick = Material { normal_map: Some(NormalMap { image, scale: 1.0 }), ..Material::default() };
    /// assert_eq!(brick.image_size(), Some([2.0, 1.0]));
    /// assert_eq!(Material::default().image_size(), None);
    /// ```
    pub fn image_size(&self) -> Option<[f64; 2]> {
        self.images().next().map(|image| image.size)
    }
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
            normal_map: None,
            dirt_map: None,
            double_sided: false,
        }
    }
}
