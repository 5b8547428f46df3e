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
        write_material(index, material, texture, out)?;
    }
    writeln!(out, "    }}")
}

fn write_material(
    index: usize,
    material: &Material,
    texture: Option<(&str, bool)>,
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
    writeln!(out, "            token outputs:surface\n        }}")?;
    if let Some((name, _)) = texture {
        let marks = if name.contains('@') { "@@@" } else { "@" };
        let color = tuple(&[r, g, b, opacity]);
        writeln!(out, "        def Shader \"Image\"\n        {{")?;
        writeln!(out, "            uniform token info:id = \"UsdUVTexture\"")?;
        writeln!(out, "            asset inputs:file = {marks}./{name}{marks}")?;
        writeln!(out, "            float4 inputs:scale = {color}")?;
        writeln!(out, "            token inputs:sourceColorSpace = \"sRGB\"")?;
        writeln!(out, "            float2 inputs:st.connect = <{path}/Coordinates.outputs:result>")?;
        writeln!(
            out,
            "            token inputs:wrapS = \"repeat\"\n            token inputs:wrapT = \"repeat\""
        )?;
        writeln!(out, "            float outputs:a\n            float3 outputs:rgb\n        }}")?;
        writeln!(out, "        def Shader \"Coordinates\"\n        {{")?;
        writeln!(out, "            uniform token info:id = \"UsdPrimvarReader_float2\"")?;
        writeln!(
            out,
            "            string inputs:varname = \"st\"\n            float2 outputs:result\n        }}"
        )?;
    }
    writeln!(out, "    }}")
}
