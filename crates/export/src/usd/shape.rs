//! Meshes, each once, with a prim for each material.

use super::material;
use super::text::{quote, tuple, write_list, write_vertex_list};
use crate::check::{SceneCheck, shown_parts, triangles};
use crate::xml::identifier;
use burgeon_scene::{Mesh, Part};
use glam::Vec3;
use std::io::{self, Write};

/// Returns the path of mesh number `index`.
pub(super) fn prim_path(index: usize, mesh: &Mesh) -> String {
    format!("/Meshes/{}", identifier("mesh", index, &mesh.name))
}

/// Writes mesh number `index`.
pub(super) fn write(
    checked: &SceneCheck<'_>,
    index: usize,
    mesh: &Mesh,
    out: &mut impl Write,
) -> io::Result<()> {
    writeln!(out, "    def Xform \"{}\" (", identifier("mesh", index, &mesh.name))?;
    if !mesh.name.is_empty() {
        writeln!(out, "        displayName = {}", quote(&mesh.name))?;
    }
    writeln!(out, "    )\n    {{")?;
    for (number, part) in shown_parts(mesh).enumerate() {
        write_part(checked, number, part, out)?;
    }
    writeln!(out, "    }}")
}

fn write_part(checked: &SceneCheck<'_>, number: usize, part: &Part, out: &mut impl Write) -> io::Result<()> {
    let material = &checked.scene.materials[part.material];
    writeln!(out, "    def Mesh \"part_{number}\" (\n        prepend apiSchemas = [\"MaterialBindingAPI\"]")?;
    writeln!(out, "    )\n    {{\n        uniform token subdivisionScheme = \"none\"")?;
    if material.double_sided {
        writeln!(out, "        uniform bool doubleSided = 1")?;
    }
    let path = material::prim_path(part.material, material);
    writeln!(out, "        rel material:binding = <{path}>")?;
    let first = part.positions.first().copied().unwrap_or_default();
    let (low, high) =
        part.positions.iter().fold((first, first), |(low, high), at| (low.min(*at), high.max(*at)));
    write_list(out, "float3[] extent", [low, high].iter().map(vector))?;
    write_list(out, "int[] faceVertexCounts", triangles(part).map(|_| 3))?;
    write_list(out, "int[] faceVertexIndices", triangles(part).flatten())?;
    write_list(out, "point3f[] points", part.positions.iter().map(vector))?;
    let normals = part.normals.iter().map(|normal| {
        let normal = normal.vector();
        vector(&if normal.is_finite() { normal } else { Vec3::Z })
    });
    write_vertex_list(out, "normal3f[] normals", normals)?;
    if let Some([width, height]) = material.image_size() {
        let coordinates = part
            .uvs
            .iter()
            .map(|uv| tuple(&[(f64::from(uv.x) / width) as f32, (f64::from(uv.y) / height) as f32]));
        write_vertex_list(out, "texCoord2f[] primvars:st", coordinates)?;
    }
    writeln!(out, "    }}")
}

fn vector(vector: &Vec3) -> String {
    tuple(&vector.to_array())
}
