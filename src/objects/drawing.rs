//! What drawing objects share: surfaces, one mesh part for each, and showing them.

use glam::{DAffine3, DVec3};

use super::{Color, Parameter, Table, Value};
use crate::error::{Error, Result};
use crate::scene::{Instance, Material, Mesh, Part, Scene, Texture};

fields! {
    /// What `material { ... }` takes.
    pub struct Surface for "material" {
        /// Base colour, as "#rrggbb" or { red, green, blue } from 0 to 1.
        pub color: Color = Color([0.6, 0.6, 0.6, 1.0]),
        /// 0 for wood, stone and plaster, 1 for bare metal.
        pub metallic: f64 = 0.0,
        /// 0 like a mirror, 1 like chalk.
        pub roughness: f64 = 0.8,
        /// Light that the surface gives off itself, as a colour.
        pub emissive: Color = Color([0.0, 0.0, 0.0, 1.0]),
        /// An image file beside the script, PNG or JPEG.
        pub texture: Option<String> = None,
        /// Width and height (m) of one repetition of the image.
        pub texture_size: Vec<f64> = vec![1.0, 1.0],
        /// Whether both sides are seen, as with leaves.
        pub double_sided: bool = false,
        /// A name for people.
        pub name: String = String::new(),
    }
}

impl Parameter for Surface {
    fn luau() -> String {
        "Material".into()
    }

    fn from_value(value: Value) -> Result<Self, super::parameter::Expected> {
        match value {
            Value::Table(table) => Self::from_table(&table).map_err(|error| {
                super::parameter::Expected::new(format!("a material ({})", error.message()))
            }),
            Value::Nil => Ok(Self::default()),
            _ => Err(super::parameter::Expected::new("a table of a material's fields")),
        }
    }

    fn into_value(self) -> Value {
        Value::Table(std::sync::Arc::new(Table::default()))
    }
}

impl Surface {
    /// The material for the scene.
    pub fn material(&self) -> Result<Material> {
        for (name, factor) in [("metallic", self.metallic), ("roughness", self.roughness)] {
            if !(0.0..=1.0).contains(&factor) {
                return Err(Error::new(format!("material: {name} must be from 0 to 1, not {factor}")));
            }
        }
        let texture = match (&self.texture, self.texture_size.as_slice()) {
            (None, _) => None,
            (Some(path), [width, height]) if *width > 0.0 && *height > 0.0 => {
                Some(Texture { path: path.into(), size: [*width, *height] })
            }
            _ => {
                return Err(Error::new(
                    "material: texture_size must be { width, height } in metres, above 0",
                ));
            }
        };
        let [red, green, blue, _] = self.emissive.0;
        #[allow(clippy::cast_possible_truncation, reason = "materials are f32")]
        let narrow = |factor: f64| factor as f32;
        Ok(Material {
            name: self.name.clone(),
            base_color: self.color.0,
            metallic: narrow(self.metallic),
            roughness: narrow(self.roughness),
            emissive: [red, green, blue],
            texture,
            double_sided: self.double_sided,
        })
    }
}

/// The faces that an object has drawn, by material.
#[derive(Debug, Clone, Default)]
pub struct Drawing {
    materials: Vec<Material>,
    parts: Vec<Part>,
    /// Emptied parts, whose memory is used again: fresh pages cost more than drawing.
    spare: Vec<Part>,
}

impl Drawing {
    /// Forgets all faces.
    pub fn clear(&mut self) {
        self.materials.clear();
        for mut part in self.parts.drain(..).rev() {
            part.clear();
            self.spare.push(part);
        }
    }

    /// The number of the part with this material.
    pub fn material(&mut self, material: &Material) -> usize {
        if let Some(index) = self.materials.iter().position(|known| known == material) {
            return index;
        }
        self.materials.push(material.clone());
        let spare = self.spare.pop().unwrap_or_default();
        self.parts.push(Part { material: self.materials.len() - 1, ..spare });
        self.materials.len() - 1
    }

    /// The material of the part with this number.
    pub fn material_of(&self, index: usize) -> Material {
        self.materials.get(index).cloned().unwrap_or_default()
    }

    /// The part with this number, as [`Drawing::material`] gave it.
    #[inline]
    pub fn part(&mut self, index: usize) -> &mut Part {
        &mut self.parts[index]
    }

    /// The parts, in the order of the first use of their materials.
    pub fn parts(&self) -> &[Part] {
        &self.parts
    }

    /// The number of triangles.
    pub fn triangles(&self) -> usize {
        self.parts.iter().map(|part| part.triangles.len()).sum()
    }

    /// Adds the drawing to `scene` as one mesh at `origin` (m), unless it is empty.
    pub fn show(self, scene: &mut Scene, origin: DVec3, name: &str, feature: Option<&str>) {
        let mut mesh = Mesh { name: name.to_owned(), parts: Vec::new() };
        for part in self.parts.into_iter().filter(|part| !part.triangles.is_empty()) {
            let material = scene.material(&self.materials[part.material]);
            mesh.parts.push(Part { material, ..part });
        }
        if mesh.parts.is_empty() {
            return;
        }
        scene.meshes.push(mesh);
        scene.instances.push(Instance {
            mesh: scene.meshes.len() - 1,
            transform: DAffine3::from_translation(origin),
            name: name.to_owned(),
            feature: feature.map(str::to_owned),
        });
    }
}
