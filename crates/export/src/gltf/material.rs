//! Materials, textures and images.

use super::super::check::SceneCheck;
use super::super::color::fraction;
use super::super::texture::Images;
use super::body::{Body, BodyArray};
use super::coordinates::TexCoordRange;
use super::description::use_extension;
use super::quantize::{TEXTURE_TRANSFORM, TexCoordRanges};
use crate::uri;
use burgeon_scene::{Material, NormalMap};
use gltf_json as json;
use json::material::{AlphaMode, EmissiveFactor, PbrBaseColorFactor, PbrMetallicRoughness, StrengthFactor};
use json::texture::{Info, MagFilter, MinFilter, Sampler};
use json::validation::Checked::Valid;

/// Location of a document's images.
pub(super) enum Textures {
    /// In the body.
    Embedded,
    /// In files with these names next to the document.
    Beside(Vec<String>),
}

/// Adds the shown materials. Returns the index of each material of the scene.
pub(super) fn write<'a>(
    checked: &SceneCheck<'_>,
    images: &'a Images,
    textures: &Textures,
    ranges: &TexCoordRanges,
    root: &mut json::Root,
    body: &mut Body<'a>,
) -> Vec<Option<json::Index<json::Material>>> {
    let written = write_images(images, textures, root, body);
    let materials = checked.scene.materials.iter().enumerate();
    materials
        .map(|(i, material)| {
            let file = images.of_material[i];
            let [range, second] = ranges.of(i);
            let texture = file.map(|file| texture(written[file], range, root));
            let normal = images.normals[i].zip(material.normal_map.as_ref());
            let normal = normal.map(|(file, map)| normal_texture(written[file], map, range, root));
            let dirt = images.dirt[i].map(|file| dirt_texture(written[file], second, root));
            let has_alpha = file.is_some_and(|file| images.files[file].has_alpha);
            checked.materials[i].then(|| {
                let described = describe(material, (texture, normal, dirt), has_alpha, root);
                root.push(described)
            })
        })
        .collect()
}

/// Adds each image with a texture that repeats it.
fn write_images<'a>(
    images: &'a Images,
    textures: &Textures,
    root: &mut json::Root,
    body: &mut Body<'a>,
) -> Vec<json::Index<json::Texture>> {
    if images.files.is_empty() {
        return Vec::new();
    }
    let sampler = root.push(Sampler {
        mag_filter: Some(Valid(MagFilter::Linear)),
        min_filter: Some(Valid(MinFilter::LinearMipmapLinear)),
        ..Sampler::default()
    });
    let mut written = Vec::new();
    for (i, file) in images.files.iter().enumerate() {
        let (view, address) = match textures {
            Textures::Embedded => (Some(body.add(BodyArray::Bytes(&file.bytes))), None),
            Textures::Beside(names) => (None, Some(uri(&names[i]))),
        };
        let source = root.push(json::Image {
            buffer_view: view.map(json::Index::new),
            mime_type: view.map(|_| json::image::MimeType(file.media_type().into())),
            name: name(&file.stem()),
            uri: address,
            extensions: None,
            extras: None,
        });
        let texture =
            json::Texture { name: None, sampler: Some(sampler), source, extensions: None, extras: None };
        written.push(root.push(texture));
    }
    written
}

fn describe(
    material: &Material,
    (texture, normal, dirt): (
        Option<Info>,
        Option<json::material::NormalTexture>,
        Option<json::material::OcclusionTexture>,
    ),
    has_alpha: bool,
    root: &mut json::Root,
) -> json::Material {
    let base_color = material.base_color.map(fraction);
    let (emissive, strength) = emission(material.emissive);
    json::Material {
        name: name(&material.name),
        // Translucent materials are blended. Images with transparent pixels, such as leaves, are masked, which needs no
        // sorting.
        alpha_mode: Valid(match base_color[3] < 1.0 {
            true => AlphaMode::Blend,
            false if has_alpha => AlphaMode::Mask,
            false => AlphaMode::Opaque,
        }),
        double_sided: material.double_sided,
        pbr_metallic_roughness: PbrMetallicRoughness {
            base_color_factor: PbrBaseColorFactor(base_color),
            base_color_texture: texture,
            metallic_factor: StrengthFactor(fraction(material.metallic)),
            roughness_factor: StrengthFactor(fraction(material.roughness)),
            ..PbrMetallicRoughness::default()
        },
        normal_texture: normal,
        occlusion_texture: dirt,
        emissive_factor: EmissiveFactor(emissive),
        extensions: strength.map(|strength| {
            let extension = "KHR_materials_emissive_strength";
            use_extension(root, extension);
            let mut extensions = json::extensions::material::Material::default();
            extensions.others.insert(extension.into(), serde_json::json!({ "emissiveStrength": strength }));
            extensions
        }),
        ..json::Material::default()
    }
}

/// Returns a reference to a texture whose coordinates are fractions of `range`.
fn texture(index: json::Index<json::Texture>, range: Option<TexCoordRange>, root: &mut json::Root) -> Info {
    let extensions = transform(range, root).map(|others| json::extensions::texture::Info { others });
    Info { index, tex_coord: 0, extensions, extras: None }
}

/// Returns the reference to a normal map whose coordinates are fractions of `range`. It has no tangents: those of the
/// texture coordinates are meant, as the specification says.
fn normal_texture(
    index: json::Index<json::Texture>,
    map: &NormalMap,
    range: Option<TexCoordRange>,
    root: &mut json::Root,
) -> json::material::NormalTexture {
    let extensions =
        transform(range, root).map(|others| json::extensions::material::NormalTexture { others });
    let scale = if map.scale.is_finite() { map.scale } else { 1.0 };
    json::material::NormalTexture { index, scale, tex_coord: 0, extensions, extras: None }
}

/// Returns the reference to a dirt map with the second set of coordinates, which are fractions of `range`. glTF has one texture
/// that multiplies light in addition to that of the base colour: occlusion, by the red channel.
fn dirt_texture(
    index: json::Index<json::Texture>,
    range: Option<TexCoordRange>,
    root: &mut json::Root,
) -> json::material::OcclusionTexture {
    let extensions =
        transform(range, root).map(|others| json::extensions::material::OcclusionTexture { others });
    let strength = StrengthFactor(1.0);
    json::material::OcclusionTexture { strength, index, tex_coord: 1, extensions, extras: None }
}

/// Returns the extension that maps texture coordinates to `range`, if they are fractions of one.
fn transform(
    range: Option<TexCoordRange>,
    root: &mut json::Root,
) -> Option<serde_json::Map<String, serde_json::Value>> {
    let TexCoordRange { offset, scale } = range.filter(|range| !range.is_identity())?;
    use_extension(root, TEXTURE_TRANSFORM);
    let mut others = serde_json::Map::new();
    others.insert(TEXTURE_TRANSFORM.into(), serde_json::json!({ "offset": offset, "scale": scale }));
    Some(others)
}

/// Returns a display name, or `None` if it is empty.
fn name(name: &str) -> Option<String> {
    (!name.is_empty()).then(|| name.to_owned())
}

/// Splits emitted light into a colour of at most 1, and a strength if it exceeds 1.
fn emission(light: [f32; 3]) -> ([f32; 3], Option<f32>) {
    let light = light.map(|it| if it.is_finite() { it.max(0.0) } else { 0.0 });
    let strength = light.into_iter().fold(0.0, f32::max);
    if strength > 1.0 { (light.map(|it| (it / strength).min(1.0)), Some(strength)) } else { (light, None) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn light_above_one_becomes_a_colour_and_a_strength() {
        assert_eq!(emission([4.0, 2.0, 0.0]), ([1.0, 0.5, 0.0], Some(4.0)));
        assert_eq!(emission([0.5, 0.2, f32::NAN]), ([0.5, 0.2, 0.0], None));
    }
}
