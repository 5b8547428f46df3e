//! The triangles of a glTF file.

use glam::{Vec2, Vec3};
use gltf_json::mesh::{Mode, Primitive, Semantic};
use gltf_json::validation::Checked;
use gltf_json::{Accessor, Index, Root};

use super::bytes::Bytes;
use crate::scene::{Normal, Part};

/// The farthest (m) that a point may be from the model's origin.
const FARTHEST: f32 = 1e7;

/// The triangles of a primitive, z up; `None` if it has lines or points, or nothing.
///
/// `set` is the number of the texture coordinates that its material takes.
pub(super) fn part(
    root: &Root,
    bytes: &Bytes<'_>,
    primitive: &Primitive,
    set: u32,
) -> Result<Option<Part>, String> {
    let attribute = |wanted: Semantic| -> Option<Index<Accessor>> {
        primitive.attributes.get(&Checked::Valid(wanted)).copied()
    };
    let Some(positions) = attribute(Semantic::Positions) else { return Ok(None) };
    let positions: Vec<Vec3> =
        bytes.column::<3>(root, positions)?.into_iter().map(|point| z_up(Vec3::from(point))).collect();
    if let Some(point) = positions.iter().find(|point| !point.abs().cmple(Vec3::splat(FARTHEST)).all()) {
        return Err(format!("a point lies at {}, {}, {}", point.x, point.y, point.z));
    }
    let count = u32::try_from(positions.len()).map_err(|_| "it has more than 2^32 points")?;
    let corners = match primitive.indices {
        Some(indices) => bytes.indices(root, indices)?,
        None => (0..count).collect(),
    };
    if let Some(corner) = corners.iter().find(|corner| **corner >= count) {
        return Err(format!("a triangle has point {corner}, and there are {count}"));
    }
    let strip = |at: usize| {
        let (a, b, c) = (corners[at], corners[at + 1], corners[at + 2]);
        if at.is_multiple_of(2) { [a, b, c] } else { [b, a, c] }
    };
    let mut triangles: Vec<[u32; 3]> = match primitive.mode {
        Checked::Valid(Mode::Triangles) => {
            corners.chunks_exact(3).map(|corners| [corners[0], corners[1], corners[2]]).collect()
        }
        Checked::Valid(Mode::TriangleStrip) => (0..corners.len().saturating_sub(2)).map(strip).collect(),
        Checked::Valid(Mode::TriangleFan) => (1..corners.len().saturating_sub(1))
            .map(|at| [corners[0], corners[at], corners[at + 1]])
            .collect(),
        _ => return Ok(None),
    };
    // What has no area shows nothing, and has no normal.
    triangles.retain(|triangle| area_vector(&positions, *triangle).length_squared() > 0.0);
    if triangles.is_empty() {
        return Ok(None);
    }
    let mut part = Part { positions, triangles: triangles.into(), ..Part::default() };
    let uvs = match attribute(Semantic::TexCoords(set)) {
        Some(uvs) => Some(bytes.column::<2>(root, uvs)?),
        None => None,
    };
    let normals = match attribute(Semantic::Normals) {
        Some(normals) => Some(bytes.column::<3>(root, normals)?),
        None => None,
    };
    let same = |length: usize| length == part.positions.len();
    if !uvs.as_ref().is_none_or(|uvs| same(uvs.len())) || !normals.as_ref().is_none_or(|it| same(it.len())) {
        return Err("it has not as many normals or texture coordinates as points".into());
    }
    // v points up here, and down in a file.
    part.uvs = uvs.into_iter().flatten().map(|[u, v]| Vec2::new(u, 1.0 - v)).collect();
    if part.uvs.iter().any(|uv| !uv.abs().cmple(Vec2::splat(FARTHEST)).all()) {
        return Err("a texture coordinate is no number".into());
    }
    match normals {
        Some(normals) => take_normals(&mut part, &normals),
        None => flatten(&mut part),
    }
    if part.uvs.is_empty() {
        part.uvs = part
            .positions
            .iter()
            .zip(&part.normals)
            .map(|(at, normal)| along(*at, normal.vector()))
            .collect();
    }
    keep_used(&mut part);
    Ok(Some(part))
}

/// Drops the points that no triangle has: parts of a file may share one list of points.
fn keep_used(part: &mut Part) {
    let mut places = vec![u32::MAX; part.positions.len()];
    for corner in part.triangles.iter().flatten() {
        places[corner as usize] = 0;
    }
    let used: Vec<usize> = (0..places.len()).filter(|point| places[*point] == 0).collect();
    if used.len() == places.len() {
        return;
    }
    for (place, point) in (0u32..).zip(&used) {
        places[*point] = place;
    }
    part.positions = used.iter().map(|point| part.positions[*point]).collect();
    part.normals = used.iter().map(|point| part.normals[*point]).collect();
    part.uvs = used.iter().map(|point| part.uvs[*point]).collect();
    part.triangles = part.triangles.iter().map(|triangle| triangle.map(|it| places[it as usize])).collect();
}

fn z_up(vector: Vec3) -> Vec3 {
    Vec3::new(vector.x, -vector.z, vector.y)
}

/// A vector out of a triangle, as long as twice its area.
fn area_vector(positions: &[Vec3], triangle: [u32; 3]) -> Vec3 {
    let [a, b, c] = triangle.map(|corner| positions[corner as usize]);
    (b - a).cross(c - a)
}

/// Takes the normals of the file, or those of the faces around a point where the file's are none.
fn take_normals(part: &mut Part, normals: &[[f32; 3]]) {
    let mut around = vec![Vec3::ZERO; normals.len()];
    for triangle in &part.triangles {
        let vector = area_vector(&part.positions, triangle);
        for corner in triangle {
            around[corner as usize] += vector;
        }
    }
    let unit = |(normal, around): (&[f32; 3], Vec3)| {
        let normal = z_up(Vec3::from(*normal)).try_normalize();
        Normal::from(normal.or_else(|| around.try_normalize()).unwrap_or(Vec3::Z))
    };
    part.normals = normals.iter().zip(around).map(unit).collect();
}

/// Gives each triangle points of its own, with the normal of its face.
fn flatten(part: &mut Part) {
    let mut flat = Part { material: part.material, ..Part::default() };
    for triangle in &part.triangles {
        let normal = area_vector(&part.positions, triangle).try_normalize().unwrap_or(Vec3::Z);
        let Ok(first) = u32::try_from(flat.positions.len()) else { break };
        flat.triangles.push([first, first + 1, first + 2]);
        for corner in triangle.map(|corner| corner as usize) {
            flat.positions.push(part.positions[corner]);
            flat.normals.push(normal.into());
            flat.uvs.extend(part.uvs.get(corner));
        }
    }
    *part = flat;
}

/// Texture coordinates in metres, seen along the axis that a face looks along most.
fn along(at: Vec3, normal: Vec3) -> Vec2 {
    let size = normal.abs();
    if size.z >= size.x && size.z >= size.y {
        Vec2::new(at.x, at.y)
    } else if size.x >= size.y {
        Vec2::new(at.y, at.z)
    } else {
        Vec2::new(at.x, at.z)
    }
}
