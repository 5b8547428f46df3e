//! `material { ... }`: the appearance of a surface in scripts.

use burgeon_base::error::{Error, Result};
use burgeon_kit::{Color, Field, Parameter, Table, Value, fields};
use burgeon_scene::{DirtMap, Material, NormalMap, Texture};

/// Colour that an image is multiplied by if none is given.
const WHITE: Color = Color([1.0; 4]);

/// Colour of a surface with neither a colour nor a texture.
const GREY: Color = Color([0.6, 0.6, 0.6, 1.0]);

/// Maximum factor of the slopes of a normal map.
const MOST_RELIEF: f64 = 10.0;

/// Fields of `material { ... }`.
#[fields("material")]
pub struct MaterialOptions {
    /// Base colour, as "#rrggbb" or { red, green, blue } from 0 to 1. If omitted, white with a texture or a dirt map and grey
    /// without.
    pub color: Option<Color>,
    /// Metalness: 0 for wood, stone and plaster, 1 for bare metal.
    #[default(0.0)]
    pub metallic: f64,
    /// Roughness: 0 like a mirror, 1 like chalk.
    #[default(0.8)]
    pub roughness: f64,
    /// Colour of the light that the surface emits.
    #[default(Color([0.0, 0.0, 0.0, 1.0]))]
    pub emissive: Color,
    /// Image file next to the script, PNG or JPEG.
    pub texture: Option<String>,
    /// Width and height (m) of one repetition of the image.
    #[default(vec![1.0, 1.0])]
    pub texture_size: Vec<f64>,
    /// Normal map, which gives the surface a relief in the light: an image file as for `texture`, with the same size.
    /// Its colours are directions, as in glTF: red to the right, green upwards, blue outwards.
    pub normal: Option<String>,
    /// Factor of the slopes of the normal map, from 0 (flat) to 10.
    #[default(1.0)]
    pub normal_scale: f64,
    /// Dirt map, an image file that multiplies the colour on top of the texture: dirt, wear or painted shade.
    pub dirt: Option<String>,
    /// Width and height (m) of one repetition of the dirt map.
    #[default(vec![1.0, 1.0])]
    pub dirt_size: Vec<f64>,
    /// Set of texture coordinates of the dirt map, the name of a projection of a shape: face:project(8, 4, { set = "dirt" }). If
    /// omitted, the dirt map lies as the texture does, in its own size.
    #[default(String::new())]
    pub dirt_set: String,
    /// Visible from both sides, such as leaves.
    pub double_sided: bool,
    /// Display name.
    pub name: String,
}

impl Parameter for MaterialOptions {
    fn luau() -> String {
        "Material".into()
    }

    fn fields() -> Vec<Field> {
        Self::fields()
    }

    fn from_value(value: Value) -> Result<Self, burgeon_kit::Expectation> {
        match value {
            Value::Table(table) => Self::from_table(&table)
                .map_err(|error| burgeon_kit::Expectation::new(format!("a material ({})", error.message()))),
            Value::Nil => Ok(Self::default()),
            _ => Err(burgeon_kit::Expectation::new("a table of a material's fields")),
        }
    }

    fn into_value(self) -> Value {
        Value::Table(std::sync::Arc::new(Table::default()))
    }
}

impl MaterialOptions {
    /// Creates the material for the scene. Fails if a factor is out of range, if the texture size is invalid, or if
    /// there is a factor for a normal map but no map.
    ///
    /// ```
    /// use burgeon_kit::Color;
    /// use burgeon_objects::MaterialOptions;
    ///
    /// let brick = MaterialOptions { color: Some(Color::of_bytes([255, 0, 0, 255])), ..MaterialOptions::default() };
    /// assert_eq!(brick.material()?.base_color, [1.0, 0.0, 0.0, 1.0]);
    /// assert!(MaterialOptions { roughness: 2.0, ..brick }.material().is_err());
    /// # Ok::<(), burgeon_base::Error>(())
    /// ```
    pub fn material(&self) -> Result<Material> {
        for (name, factor) in [("metallic", self.metallic), ("roughness", self.roughness)] {
            if !(0.0..=1.0).contains(&factor) {
                return Err(Error::argument(format!("material: {name} must be from 0 to 1, not {factor}")));
            }
        }
        if !(0.0..=MOST_RELIEF).contains(&self.normal_scale) {
            let scale = self.normal_scale;
            let message = format!("material: normal_scale must be from 0 to {MOST_RELIEF}, not {scale}");
            return Err(Error::argument(message));
        }
        #[allow(clippy::float_cmp, reason = "the default is exact")]
        if self.normal.is_none() && self.normal_scale != 1.0 {
            return Err(Error::argument("material: normal_scale has no effect without a normal map")
                .help("give the image file of the normal map in normal"));
        }
        if self.dirt.is_none() && (!self.dirt_set.is_empty() || self.dirt_size != [1.0, 1.0]) {
            let name = if self.dirt_set.is_empty() { "dirt_size" } else { "dirt_set" };
            return Err(Error::argument(format!("material: {name} has no effect without a dirt map"))
                .help("give the image file of the dirt map in dirt"));
        }
        let has_texture = self.texture.is_some() || self.normal.is_some();
        let size = tile_size("texture_size", &self.texture_size, has_texture)?;
        let dirt_size = tile_size("dirt_size", &self.dirt_size, self.dirt.is_some())?;
        let image = |path: &String| Texture { path: path.into(), size, content: None };
        let texture = self.texture.as_ref().map(image);
        let dirt_map = self.dirt.as_ref().map(|path| DirtMap {
            image: Texture { path: path.into(), size: dirt_size, content: None },
            set: self.dirt_set.as_str().into(),
        });
        let [red, green, blue, _] = self.emissive.0;
        #[allow(clippy::cast_possible_truncation, reason = "materials are f32")]
        let narrow = |factor: f64| factor as f32;
        let scale = narrow(self.normal_scale);
        Ok(Material {
            name: self.name.clone(),
            base_color: self
                .color
                .unwrap_or(if texture.is_some() || dirt_map.is_some() { WHITE } else { GREY })
                .0,
            metallic: narrow(self.metallic),
            roughness: narrow(self.roughness),
            emissive: [red, green, blue],
            texture,
            normal_map: self.normal.as_ref().map(|path| NormalMap { image: image(path), scale }),
            dirt_map,
            double_sided: self.double_sided,
        })
    }
}

/// Returns the width and height (m) in the field `name`; one metre for images that are not `used`. Fails if one is not above 0.
fn tile_size(name: &str, size: &[f64], used: bool) -> Result<[f64; 2]> {
    match size {
        [width, height] if *width > 0.0 && *height > 0.0 => Ok([*width, *height]),
        _ if !used => Ok([1.0; 2]),
        _ => Err(Error::argument(format!("material: {name} must be {{ width, height }} in metres, above 0"))),
    }
}

/// Returns a material of one colour, with a roughness from 0 (mirror) to 1 (chalk) and a metalness from 0 (wood) to 1
/// (bare metal).
#[allow(clippy::cast_possible_truncation, reason = "materials are f32")]
pub(crate) fn plain_material(color: Color, roughness: f64, metallic: f64) -> Material {
    Material {
        base_color: color.0,
        roughness: roughness as f32,
        metallic: metallic as f32,
        ..Material::default()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_image_without_a_colour_is_shown_as_it_is() {
        let textured = MaterialOptions { texture: Some("brick.png".into()), ..MaterialOptions::default() };
        assert_eq!(textured.material().unwrap().base_color, [1.0; 4]);
        let tinted = MaterialOptions { color: Some(Color([0.5, 0.4, 0.3, 1.0])), ..textured };
        assert_eq!(tinted.material().unwrap().base_color, [0.5, 0.4, 0.3, 1.0]);
        assert_eq!(MaterialOptions::default().material().unwrap(), Material::default());
    }

    #[test]
    fn a_normal_map_has_the_size_of_the_texture_and_leaves_the_colour() {
        let size = vec![2.0, 1.0];
        let normal = Some("brick_normal.png".into());
        let relief = MaterialOptions { normal, texture_size: size, ..MaterialOptions::default() };
        let material = relief.material().unwrap();
        assert_eq!((material.image_size(), material.base_color), (Some([2.0, 1.0]), GREY.0));
        assert_eq!(material.normal_map.unwrap().scale, 1.0);
        assert!(MaterialOptions { texture_size: vec![0.0, 1.0], ..relief }.material().is_err());
    }

    #[test]
    fn a_dirt_map_has_a_size_of_its_own_and_leaves_that_of_the_texture() {
        let (texture, dirt) = (Some("brick.png".into()), Some("stain.png".into()));
        let sizes = (vec![2.0, 1.0], vec![6.0, 3.0]);
        let wall = MaterialOptions {
            texture,
            dirt,
            texture_size: sizes.0,
            dirt_size: sizes.1,
            ..MaterialOptions::default()
        };
        let material = wall.material().unwrap();
        assert_eq!(material.image_size(), Some([2.0, 1.0]));
        assert_eq!(material.dirt_map.unwrap().image.size, [6.0, 3.0]);
        let alone = MaterialOptions { dirt_set: "dirt".into(), ..MaterialOptions::default() };
        assert!(alone.material().unwrap_err().to_string().contains("no effect without a dirt map"));
    }
}
