//! The materials of a glTF file.

use std::borrow::Cow;
use std::path::PathBuf;
use std::sync::Arc;

use gltf_json::material::AlphaMode;
use gltf_json::validation::Checked;
use gltf_json::{Index, Root};

use super::bytes::{Bytes, address};
use super::options::{ImportOptions, broken_file};
use burgeon_base::error::Result;
use burgeon_scene::image::ImageKind;
use burgeon_scene::{Material, NormalMap, Texture};

/// A material, and the number of the texture coordinates that it uses.
#[derive(Debug, Clone)]
pub(super) struct ImportMaterial {
    pub material: Material,
    pub set: u32,
    /// Set if the material is opaque regardless of the alpha of its colours.
    opaque: bool,
}

impl ImportMaterial {
    /// Returns the material multiplied by a vertex colour.
    pub(super) fn tinted(&self, tint: [f32; 4]) -> Material {
        let mut material = self.material.clone();
        let channels = if self.opaque { 3 } else { 4 };
        for (channel, factor) in material.base_color.iter_mut().zip(tint).take(channels) {
            *channel *= factor;
        }
        material
    }
}

/// Returns the default material of glTF for a primitive without a material.
pub(super) fn plain() -> ImportMaterial {
    let material = Material { base_color: [1.0; 4], metallic: 1.0, roughness: 1.0, ..Material::default() };
    ImportMaterial { material, set: 0, opaque: true }
}

/// Reads all materials of the file, in order.
pub(super) fn materials(
    root: &Root,
    bytes: &Bytes<'_>,
    wanted: &mut ImportOptions<'_>,
) -> Result<Vec<ImportMaterial>> {
    let mut images: Vec<Option<Arc<[u8]>>> = vec![None; root.images.len()];
    let mut looks = Vec::new();
    for described in &root.materials {
        let surface = &described.pbr_metallic_roughness;
        let mut look = ImportMaterial {
            material: Material {
                name: described.name.clone().unwrap_or_default(),
                base_color: surface.base_color_factor.0.map(part),
                metallic: part(surface.metallic_factor.0),
                roughness: part(surface.roughness_factor.0),
                emissive: light(described),
                texture: None,
                normal_map: None,
                dirt_map: None,
                double_sided: described.double_sided,
            },
            set: 0,
            opaque: described.alpha_mode == Checked::Valid(AlphaMode::Opaque),
        };
        if look.opaque {
            look.material.base_color[3] = 1.0;
        }
        if let Some(info) = &surface.base_color_texture {
            look.set = info.tex_coord;
            look.material.texture = Some(texture(root, bytes, info.index, &mut images, wanted)?);
        }
        // Surfaces have one set of texture coordinates.
        let normal = described.normal_texture.as_ref();
        if let Some(info) = normal.filter(|it| look.material.texture.is_none() || it.tex_coord == look.set) {
            look.set = info.tex_coord;
            let image = texture(root, bytes, info.index, &mut images, wanted)?;
            let scale = if info.scale.is_finite() { info.scale } else { 1.0 };
            look.material.normal_map = Some(NormalMap { image, scale });
        }
        looks.push(look);
    }
    Ok(looks)
}

/// Limits a number to the range from 0 to 1.
fn part(value: f32) -> f32 {
    if value.is_nan() { 0.0 } else { value.clamp(0.0, 1.0) }
}

/// Returns the emission of a material, multiplied by the strength in its extension.
fn light(described: &gltf_json::Material) -> [f32; 3] {
    let extension = described.extensions.as_ref();
    let extension = extension.and_then(|known| known.others.get("KHR_materials_emissive_strength"));
    let strength = extension.and_then(|known| known.get("emissiveStrength")?.as_f64()).unwrap_or(1.0);
    #[allow(clippy::cast_possible_truncation, reason = "light is f32")]
    let strength = strength as f32;
    described.emissive_factor.0.map(|value| {
        let light = value * strength;
        if light.is_finite() { light.max(0.0) } else { 0.0 }
    })
}

fn texture(
    root: &Root,
    bytes: &Bytes<'_>,
    index: Index<gltf_json::Texture>,
    images: &mut [Option<Arc<[u8]>>],
    wanted: &mut ImportOptions<'_>,
) -> Result<Texture> {
    let missing = || broken_file(wanted.name, format!("texture {} has no image", index.value()));
    let source = root.get(index).ok_or_else(missing)?.source;
    let image = root.get(source).ok_or_else(missing)?;
    let content = match images.get(source.value()).cloned().flatten() {
        Some(content) => content,
        None => {
            let read: Vec<u8> = match (&image.uri, image.buffer_view) {
                (Some(uri), _) => address(uri, wanted)?,
                (None, Some(view)) => {
                    let image = bytes.view(root, view).map_err(|why| broken_file(wanted.name, why))?.0;
                    wanted.budget.take(image.len())?;
                    image.to_vec()
                }
                (None, None) => return Err(missing()),
            };
            if ImageKind::of(&read).is_none() {
                return Err(broken_file(
                    wanted.name,
                    format!("image {} is neither PNG nor JPEG", source.value()),
                ));
            }
            let content: Arc<[u8]> = read.into();
            images[source.value()] = Some(Arc::clone(&content));
            content
        }
    };
    let stem = PathBuf::from(wanted.name).file_stem().unwrap_or_default().to_string_lossy().into_owned();
    let name = image.name.as_deref().filter(|name| !name.is_empty());
    let own = name.map_or_else(|| source.value().to_string().into(), Cow::Borrowed);
    // A repetition of an image corresponds to 1 unit of the file's texture coordinates.
    let path = PathBuf::from(format!("{stem}_{}", own.replace(['/', '\\'], "_")));
    Ok(Texture { path, size: [1.0, 1.0], content: Some(content) })
}
