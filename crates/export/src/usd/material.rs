//! Materials as `UsdPreviewSurface`, with an image where there is one.

use super::text::{quote, tuple};
use crate::check::SceneCheck;
use crate::color::fraction;
use crate::texture::Images;
use crate::xml::identifier;
use burgeon_scene::Material;
use std::io::{self, Write};

/// Returns the path of material number `index`.
pub(super) fn prim_path(index: usize, material: &Material) -> String {
    format!("/World/Materials/{}", identifier("material", index, &material.name))
}

/// Writes the shown materials; `names` are the files of the images.
pub(super) fn write(
    checked: &SceneCheck<'_>,
    images: &Images,
    names: &[String],
    out: &mut impl Write,
) -> io::Result<()> {
    writeln!(out, "    def Scope \"Materials\"\n    {{")?;
    let shown = checked.scene.materials.iter().enumerate().filter(|(index, _)| checked.materials[*index]);
    for (index, material) in shown {
        let image = images.of_material[index];
        let texture = image.map(|file| (names[file].as_str(), images.files[file].has_alpha));
        let normal = images.normals[index].map(|file| names[file].as_str());
        write_material(index, material, (texture, normal), out)?;
    }
    writeln!(out, "    }}")
}

fn write_material(
    index: usize,
    material: &Material,
    (texture, normal): (Option<(&str, bool)>, Option<&str>),
    out: &mut impl Write,
) -> io::Result<()> {
    let path = prim_path(index, material);
    writeln!(out, "    def Material \"{}\" (", identifier("material", index, &material.name))?;
    if !material.name.is_empty() {
        writeln!(out, "        displayName = {}", quote(&material.name))?;
    }
    writeln!(out, "    )\n    {{\n        token outputs:surface.connect = <{path}/Surface.outputs:surface>")?;
    writeln!(out, "        def Shader \"Surface\"\n        {{")?;
    writeln!(out, "            uniform token info:id = \"UsdPreviewSurface\"")?;
    let [r, g, b, opacity] = material.base_color.map(fraction);
    match texture {
        Some(_) => {
            writeln!(out, "            color3f inputs:diffuseColor.connect = <{path}/Image.outputs:rgb>")?;
        }
        None => writeln!(out, "            color3f inputs:diffuseColor = {}", tuple(&[r, g, b]))?,
    }
    match texture {
        Some((_, true)) => {
            writeln!(out, "            float inputs:opacity.connect = <{path}/Image.outputs:a>")?
        }
        _ => writeln!(out, "            float inputs:opacity = {opacity}")?,
    }
    let emissive = material.emissive.map(|light| if light.is_finite() { light.max(0.0) } else { 0.0 });
    writeln!(out, "            color3f inputs:emissiveColor = {}", tuple(&emissive))?;
    writeln!(out, "            float inputs:metallic = {}", fraction(material.metallic))?;
    writeln!(out, "            float inputs:roughness = {}", fraction(material.roughness))?;
    if normal.is_some() {
        writeln!(out, "            normal3f inputs:normal.connect = <{path}/Relief.outputs:rgb>")?;
    }
    writeln!(out, "            token outputs:surface\n        }}")?;
    if let Some((name, _)) = texture {
        let color = tuple(&[r, g, b, opacity]);
        write_image("Image", name, &[("scale", color)], "sRGB", &path, out)?;
    }
    if let Some((name, map)) = normal.zip(material.normal_map.as_ref()) {
        // Colours from 0 to 1 are directions from -1 to 1.
        let scale = tuple(&[2.0 * map.scale, 2.0 * map.scale, 2.0, 1.0]);
        let bias = tuple(&[-map.scale, -map.scale, -1.0, 0.0]);
        write_image("Relief", name, &[("scale", scale), ("bias", bias)], "raw", &path, out)?;
    }
    if texture.is_some() || normal.is_some() {
        writeln!(out, "        def Shader \"Coordinates\"\n        {{")?;
        writeln!(out, "            uniform token info:id = \"UsdPrimvarReader_float2\"")?;
        writeln!(
            out,
            "            string inputs:varname = \"st\"\n            float2 outputs:result\n        }}"
        )?;
    }
    writeln!(out, "    }}")
}

/// Writes the shader `shader` that reads the image `name`, with `factors` of its colours in the colour space `space`.
fn write_image(
    shader: &str,
    name: &str,
    factors: &[(&str, String)],
    space: &str,
    path: &str,
    out: &mut impl Write,
) -> io::Result<()> {
    let marks = if name.contains('@') { "@@@" } else { "@" };
    writeln!(out, "        def Shader \"{shader}\"\n        {{")?;
    writeln!(out, "            uniform token info:id = \"UsdUVTexture\"")?;
    writeln!(out, "            asset inputs:file = {marks}./{name}{marks}")?;
    for (factor, value) in factors {
        writeln!(out, "            float4 inputs:{factor} = {value}")?;
    }
    writeln!(out, "            token inputs:sourceColorSpace = \"{space}\"")?;
    writeln!(out, "            float2 inputs:st.connect = <{path}/Coordinates.outputs:result>")?;
    writeln!(
        out,
        "            token inputs:wrapS = \"repeat\"\n            token inputs:wrapT = \"repeat\""
    )?;
    writeln!(out, "            float outputs:a\n            float3 outputs:rgb\n        }}")
}
