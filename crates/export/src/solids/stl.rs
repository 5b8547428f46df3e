//! Binary STL, which slicers read: triangles in millimetres, without materials, names or instances.
//!
//! Format: 3D Systems, "StereoLithography Interface Specification", 1989.

use super::open_edges;
use super::placed::{PlacedMesh, check_size, millimetres, written_triangles};
use crate::check::check;
use crate::facts::Export;
use crate::files::Files;
use burgeon_base::error::Result;
use glam::{DVec3, Vec3};
use std::io::Write;
use std::path::Path;

/// Maximum size (bytes). Programs read the whole file into memory.
const LIMIT: u64 = 1_000_000_000;

/// Bytes of a triangle.
const TRIANGLE: usize = 50;

/// Writes an `.stl` file to `path`. Fails before it writes if the file would exceed 1 GB.
pub(crate) fn write(export: &Export<'_>, path: &Path, files: &mut Files) -> Result<()> {
    let checked = check(export.scene)?;
    let count = written_triangles(&checked);
    check_size("an .stl file", 84 + (count * TRIANGLE) as u64, LIMIT, count)?;
    let DVec3 { x, y, z } = checked.origin;
    // A text file begins with "solid", so a binary one must not.
    let mut header =
        format!("Burgeon {}, mm, z up, from ({x}, {y}, {z}) m", env!("CARGO_PKG_VERSION")).into_bytes();
    header.resize(80, b' ');
    let stop = files.stop();
    files.write(path, |out| {
        out.write_all(&header)?;
        out.write_all(&(count as u32).to_le_bytes())?;
        let mut points: Vec<Vec3> = Vec::new();
        let mut bytes = Vec::new();
        for placed in PlacedMesh::all(&checked) {
            if stop.is_stopped() {
                return Ok(());
            }
            for part in placed.parts {
                points.clear();
                let world = |point: &Vec3| {
                    millimetres(placed.transform.transform_point3(point.as_dvec3())).as_vec3() + 0.0
                };
                points.extend(part.positions.iter().map(world));
                for corners in placed.triangles(part) {
                    let [a, b, c] = corners.map(|corner| points[corner as usize]);
                    let normal = (b - a).cross(c - a).try_normalize().unwrap_or_default() + 0.0;
                    for number in [normal, a, b, c].iter().flat_map(|vector| vector.to_array()) {
                        bytes.extend_from_slice(&number.to_le_bytes());
                    }
                    bytes.extend_from_slice(&[0, 0]);
                    if bytes.len() > 1 << 16 {
                        out.write_all(&bytes)?;
                        bytes.clear();
                    }
                }
            }
        }
        out.write_all(&bytes)
    })?;
    let counts = open_edges::count(&checked);
    files.warn(open_edges::warning(&checked, &counts, path));
    Ok(())
}
