//! Binary PLY: points in metres with normals and colours, without instances and textures.
//!
//! Format: Turk, "The PLY Polygon File Format", 1994.

use super::open_edges;
use super::placed::{PlacedMesh, check_size, written_triangles};
use crate::check::{SceneCheck, check};
use crate::color::fraction;
use crate::decompose::normal_matrix;
use crate::facts::Export;
use crate::files::Files;
use crate::texture::{ImageFile, Images};
use burgeon_base::error::{Error, Limit, Result};
use burgeon_base::srgb_byte;
use glam::{DVec3, Vec3};
use std::io::{self, Write};
use std::path::Path;

/// Bytes of a point and of a triangle.
const SIZES: [usize; 2] = [28, 13];

/// Maximum size (bytes).
const LIMIT: u64 = 4_000_000_000;

/// Writes a `.ply` file to `path`. Fails before it writes if the file would exceed 4 GB.
pub(crate) fn write(export: &Export<'_>, path: &Path, files: &mut Files) -> Result<()> {
    let checked = check(export.scene)?;
    let triangles = written_triangles(&checked);
    let points: usize = PlacedMesh::all(&checked)
        .map(|placed| placed.parts.iter().map(|part| part.positions.len()).sum::<usize>())
        .sum();
    check_size("a .ply file", (points * SIZES[0] + triangles * SIZES[1]) as u64, LIMIT, triangles)?;
    if u32::try_from(points).is_err() {
        return Err(Error::limit(Limit::Format, format!("a .ply file cannot have {points} points"))
            .help("write a .glb, which stores repeated models once"));
    }
    let colors = colors(&checked)?;
    let DVec3 { x, y, z } = checked.origin;
    let stop = files.stop();
    files.write(path, |out| {
        writeln!(out, "ply\nformat binary_little_endian 1.0\ncomment Burgeon {}", env!("CARGO_PKG_VERSION"))?;
        writeln!(out, "comment Metres, z up, counted from ({x}, {y}, {z})")?;
        if let Some(frame) = export.facts.frame {
            writeln!(out, "comment The origin is at {}", frame.world_place().to_string().replace('\n', " "))?;
        }
        writeln!(out, "element vertex {points}")?;
        for name in ["x", "y", "z", "nx", "ny", "nz"] {
            writeln!(out, "property float {name}")?;
        }
        for name in ["red", "green", "blue", "alpha"] {
            writeln!(out, "property uchar {name}")?;
        }
        writeln!(out, "element face {triangles}\nproperty list uchar uint vertex_indices\nend_header")?;
        for placed in PlacedMesh::all(&checked) {
            if stop.is_stopped() {
                return Ok(());
            }
            write_points(&placed, &colors, out)?;
        }
        let mut first = 0_u32;
        for placed in PlacedMesh::all(&checked) {
            for part in placed.parts {
                for corners in placed.triangles(part) {
                    let mut bytes = [3; 13];
                    for (place, corner) in bytes[1..].chunks_exact_mut(4).zip(corners) {
                        place.copy_from_slice(&(first + corner).to_le_bytes());
                    }
                    out.write_all(&bytes)?;
                }
                first += part.positions.len() as u32;
            }
        }
        Ok(())
    })?;
    let counts = open_edges::count(&checked);
    files.warn(open_edges::warning(&checked, &counts, path));
    Ok(())
}

/// Writes the points of all parts of an instance.
fn write_points(placed: &PlacedMesh<'_>, colors: &[[u8; 4]], out: &mut impl Write) -> io::Result<()> {
    let turned = normal_matrix(&placed.transform.matrix3);
    for part in placed.parts {
        for (position, normal) in part.positions.iter().zip(&part.normals) {
            let point = placed.transform.transform_point3(position.as_dvec3()).as_vec3();
            let normal = (turned * normal.vector().as_dvec3()).try_normalize().unwrap_or(DVec3::Z).as_vec3();
            let mut bytes = [0; 28];
            let numbers = [point, normal].into_iter().flat_map(|vector: Vec3| (vector + 0.0).to_array());
            for (place, number) in bytes.chunks_exact_mut(4).zip(numbers) {
                place.copy_from_slice(&number.to_le_bytes());
            }
            bytes[24..].copy_from_slice(&colors[part.material]);
            out.write_all(&bytes)?;
        }
    }
    Ok(())
}

/// Returns the colour of each material in sRGB with opacity, multiplied by the mean colour of its image.
pub(super) fn colors(checked: &SceneCheck<'_>) -> Result<Vec<[u8; 4]>> {
    let images = Images::load(checked)?;
    let means: Vec<_> = images.files.iter().map(ImageFile::mean_color).collect::<Result<_>>()?;
    let materials = checked.scene.materials.iter().zip(&images.of_material);
    let color = materials.map(|(material, image)| {
        let mean = image.map_or([1.0; 3], |image| means[image]);
        let light =
            |i: usize| srgb_byte(fraction(material.base_color[i]) * mean[i] + fraction(material.emissive[i]));
        [light(0), light(1), light(2), (fraction(material.base_color[3]) * 255.0).round() as u8]
    });
    Ok(color.collect())
}
