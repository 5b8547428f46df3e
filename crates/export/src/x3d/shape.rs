//! Shapes: the triangles of a material, and their appearance.

use std::fmt::Write;

use super::super::check::{shown_parts, triangles};
use super::super::color::{fraction, srgb};
use crate::xml::{escape_attribute, escape_list_item, identifier};
use burgeon_scene::{Material, Mesh, Part, Texture};
use glam::Vec3;

/// Materials of a scene as they are written.
pub(super) struct Looks<'a> {
    pub(super) materials: &'a [Material],
    /// For each material, the file name of its image.
    pub(super) images: Vec<Option<String>>,
}

/// Reference from a shape to its material.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum LookReference {
    /// Written here, without a name.
    Own,
    /// Written here, under its name.
    Defined,
    /// Written before.
    Used,
}

/// Writes the shapes of `mesh`, `mirrored` along x if set; `refer` returns the reference to each material.
pub(super) fn write(
    mesh: &Mesh,
    mirrored: bool,
    looks: &Looks<'_>,
    refer: impl Fn(usize) -> LookReference,
    out: &mut String,
) {
    for part in shown_parts(mesh) {
        out.push_str("<Shape>");
        looks.write(part.material, refer(part.material), out);
        let material = &looks.materials[part.material];
        let solid = if material.double_sided { " solid='false'" } else { "" };
        let _ = write!(out, "<IndexedTriangleSet{solid} index='");
        let turned = |[a, b, c]: [u32; 3]| if mirrored { [a, c, b] } else { [a, b, c] };
        numbers(triangles(part).flat_map(turned), out);
        out.push_str("'>");
        write_points(part, mirrored, material.texture.as_ref(), out);
        out.push_str("</IndexedTriangleSet></Shape>\n");
    }
}

fn write_points(part: &Part, mirrored: bool, texture: Option<&Texture>, out: &mut String) {
    let place = |at: Vec3| {
        let x = if mirrored { -at.x } else { at.x };
        (Vec3::new(x, at.z, -at.y) + 0.0).to_array()
    };
    out.push_str("<Coordinate point='");
    numbers(part.positions.iter().flat_map(|at| place(*at)), out);
    out.push_str("'/><Normal vector='");
    // Normals have a precision of four decimals.
    let round = |number: f32| (number * 1e4).round() / 1e4 + 0.0;
    numbers(part.normals.iter().flat_map(|normal| place(normal.vector()).map(round)), out);
    out.push_str("'/>");
    if let Some(Texture { size: [width, height], .. }) = texture {
        out.push_str("<TextureCoordinate point='");
        let place = |uv: &glam::Vec2| {
            [(f64::from(uv.x) / width) as f32 + 0.0, (f64::from(uv.y) / height) as f32 + 0.0]
        };
        numbers(part.uvs.iter().flat_map(place), out);
        out.push_str("'/>");
    }
}

/// Writes numbers separated by spaces, each as the shortest decimal that represents the same number.
pub(super) fn numbers<T: std::fmt::Display>(numbers: impl IntoIterator<Item = T>, out: &mut String) {
    for (index, number) in numbers.into_iter().enumerate() {
        let blank = if index == 0 { "" } else { " " };
        let _ = write!(out, "{blank}{number}");
    }
}

impl Looks<'_> {
    /// Writes material number `index`, or a reference to it.
    fn write(&self, index: usize, reference: LookReference, out: &mut String) {
        let material = &self.materials[index];
        let name = identifier("material", index, &material.name);
        match reference {
            LookReference::Used => {
                let _ = write!(out, "<Appearance USE='{name}'/>");
                return;
            }
            LookReference::Defined => {
                let _ = write!(out, "<Appearance DEF='{name}'>");
            }
            LookReference::Own => out.push_str("<Appearance>"),
        }
        let [r, g, b, opacity] = material.base_color.map(fraction);
        let (metallic, roughness) = (fraction(material.metallic), fraction(material.roughness));
        // As in OBJ: 4 % of the light for dielectrics, and the exponent of Blinn and Phong, which X3D limits to 128. A
        // rough surface spreads its highlight until it disappears.
        let specular = [r, g, b].map(|color| (0.04 + (color - 0.04) * metallic) * (1.0 - roughness));
        let exponent = (2.0 / roughness.max(0.045).powi(4) - 2.0).clamp(0.0, 128.0);
        // Four decimals, because the schema does not allow exponents in colours.
        let color = |color: [f32; 3]| color.map(|it| format!("{:.4}", srgb(it))).join(" ");
        let _ = write!(
            out,
            "<Material diffuseColor='{}' specularColor='{}' shininess='{:.4}'",
            color([r, g, b]),
            specular.map(|it| format!("{it:.4}")).join(" "),
            exponent / 128.0
        );
        if material.emissive.iter().any(|light| fraction(*light) > 0.0) {
            let _ = write!(out, " emissiveColor='{}'", color(material.emissive));
        }
        if opacity < 1.0 {
            let _ = write!(out, " transparency='{:.4}'", 1.0 - opacity);
        }
        out.push_str("/>");
        if let Some(image) = &self.images[index] {
            let _ = write!(out, "<ImageTexture url='{}'/>", escape_list_item(image));
        }
        out.push_str("</Appearance>");
    }
}

/// Writes the feature as a node that unaware programs ignore.
pub(super) fn write_feature(feature: &str, out: &mut String) {
    let _ = write!(out, "<MetadataString name='feature' value='{}'/>", escape_list_item(feature));
}

/// Escapes `name` as a title.
pub(super) fn title(name: &str) -> String {
    escape_attribute(name)
}
