//! Single faces and spheres for drawing objects.

use geo::TriangulateEarcut;
use glam::{DVec2, DVec3};

use super::planar::geo_polygon;
use burgeon_base::error::{Error, Limit, Result};
use burgeon_scene::Part;

/// Adds a flat polygon with at least three `corners` (m); its normal follows the right-hand rule.
///
/// Corners that are not coplanar keep their positions; the polygon is triangulated in the plane of its mean
/// normal (Newell's method). Texture coordinates are metres within that plane. A polygon without area adds
/// nothing. Fails if a corner is not finite or fewer than three corners are distinct.
///
/// ```
/// use burgeon_geometry::{face, solid};
/// use burgeon_scene::Part;
/// use glam::{DVec3, Vec3};
///
/// let mut part = Part::default();
/// face(&mut part, &[(0.0, 0.0), (3.0, 0.0), (3.0, 2.0), (0.0, 2.0)].map(|(x, y)| DVec3::new(x, y, 1.0)))?;
/// assert_eq!((part.triangles.len(), solid::area([&part])), (2, 6.0));
/// assert!(part.normals[0].vector().abs_diff_eq(Vec3::Z, 1e-4));
/// # Ok::<(), burgeon_base::error::Error>(())
/// ```
pub fn face(part: &mut Part, corners: &[DVec3]) -> Result<()> {
    shaded_face(part, corners, CornerShading::default())
}

/// Normals and texture coordinates that override those of the face's plane, in the order of the corners.
#[derive(Debug, Clone, Copy, Default)]
pub struct CornerShading<'a> {
    /// Normal of each corner.
    pub normals: Option<&'a [DVec3]>,
    /// Texture coordinates of each corner (m).
    pub uvs: Option<&'a [DVec2]>,
}

/// Adds a face like [`face`], with explicit normals and texture coordinates.
pub fn shaded_face(part: &mut Part, corners: &[DVec3], shading: CornerShading<'_>) -> Result<()> {
    let mut points: Vec<DVec3> = Vec::with_capacity(corners.len());
    // Index of each kept point in `corners`.
    let mut numbers: Vec<usize> = Vec::with_capacity(corners.len());
    for (number, corner) in corners.iter().enumerate() {
        if !corner.is_finite() {
            return Err(Error::geometry("a corner of the polygon is not finite"));
        }
        if points.last().is_none_or(|last| last.distance_squared(*corner) > 1e-20) {
            points.push(*corner);
            numbers.push(number);
        }
    }
    if points.len() > 1 && points[0].distance_squared(points[points.len() - 1]) <= 1e-20 {
        points.pop();
    }
    if points.len() < 3 {
        return Err(Error::geometry(format!(
            "the polygon has {} distinct corners, but needs 3",
            points.len()
        ))
        .help("add corners with Point(), moving in between"));
    }
    let newell = (0..points.len())
        .map(|index| (points[index] - points[0]).cross(points[(index + 1) % points.len()] - points[0]))
        .fold(DVec3::ZERO, |sum, cross| sum + cross);
    let normal = newell.normalize_or_zero();
    if normal == DVec3::ZERO {
        return Ok(());
    }
    let right = normal.any_orthonormal_vector();
    let up = normal.cross(right);
    let flat: Vec<DVec2> = points
        .iter()
        .map(|point| DVec2::new((*point - points[0]).dot(right), (*point - points[0]).dot(up)))
        .collect();
    let raw = geo_polygon(std::slice::from_ref(&flat)).earcut_triangles_raw();
    let base = u32::try_from(part.positions.len())
        .map_err(|_| Error::limit(Limit::Size, "a mesh has too many vertices"))?;
    for ((point, flat), number) in points.iter().zip(&flat).zip(numbers) {
        let given = shading.normals.map_or(DVec3::ZERO, |normals| normals[number].normalize_or_zero());
        part.positions.push(point.as_vec3());
        part.normals.push(if given == DVec3::ZERO { normal } else { given }.into());
        part.uvs.push(shading.uvs.map_or(*flat, |uvs| uvs[number]).as_vec2());
    }
    // The ring is closed by repeating its first corner.
    let index = |vertex: usize| vertex % points.len();
    let vertices: Vec<usize> = raw.triangle_indices.iter().map(|vertex| index(*vertex)).collect();
    for corner in vertices.chunks_exact(3) {
        let [a, b, c] = [corner[0], corner[1], corner[2]];
        let turn = (flat[b] - flat[a]).perp_dot(flat[c] - flat[a]);
        if turn.abs() < 1e-18 || a == b || b == c || a == c {
            continue;
        }
        let [a, b, c] = if turn > 0.0 { [a, b, c] } else { [a, c, b] };
        #[allow(clippy::cast_possible_truncation, reason = "a polygon has fewer than 2^32 corners")]
        part.triangles.push([a as u32 + base, b as u32 + base, c as u32 + base]);
    }
    Ok(())
}

/// Adds a closed sphere with `radius` (m) and `sides` faces around its axis, at least 3.
///
/// ```
/// use burgeon_geometry::{solid, sphere};
/// use burgeon_scene::Part;
/// use glam::DVec3;
///
/// let mut ball = Part::default();
/// sphere(&mut ball, DVec3::ZERO, 1.0, 32)?;
/// assert!(solid::check([&ball]).is_solid());
/// // Slightly less than 4π/3, because the faces are inside the sphere.
/// assert!((4.0..4.19).contains(&solid::volume([&ball])));
/// # Ok::<(), burgeon_base::error::Error>(())
/// ```
pub fn sphere(part: &mut Part, center: DVec3, radius: f64, sides: u32) -> Result<()> {
    if !radius.is_finite() || radius < 0.0 {
        return Err(Error::geometry(format!("the radius of a ball must be 0 or more, and is {radius}")));
    }
    if radius == 0.0 {
        return Ok(());
    }
    let (sides, rows) = (sides.max(3), (sides / 2).max(2));
    let base = u32::try_from(part.positions.len())
        .map_err(|_| Error::limit(Limit::Size, "a mesh has too many vertices"))?;
    for row in 0..=rows {
        let (sin, cos) = (std::f64::consts::PI * f64::from(row) / f64::from(rows)).sin_cos();
        // Exact poles close the surface.
        let sin = if row == 0 || row == rows { 0.0 } else { sin };
        for side in 0..=sides {
            let angle = std::f64::consts::TAU * f64::from(side % sides) / f64::from(sides);
            let normal = DVec3::new(sin * angle.cos(), sin * angle.sin(), cos);
            part.positions.push((center + normal * radius).as_vec3());
            part.normals.push(normal.into());
            let (u, v) = (
                f64::from(side) / f64::from(sides) * std::f64::consts::TAU,
                1.0 - f64::from(row) / f64::from(rows),
            );
            part.uvs.push(DVec2::new(u * radius, v * std::f64::consts::PI * radius).as_vec2());
        }
    }
    let at = |row: u32, side: u32| base + row * (sides + 1) + side;
    for row in 0..rows {
        for side in 0..sides {
            if row > 0 {
                part.triangles.push([at(row, side), at(row + 1, side), at(row, side + 1)]);
            }
            if row + 1 < rows {
                part.triangles.push([at(row, side + 1), at(row + 1, side), at(row + 1, side + 1)]);
            }
        }
    }
    Ok(())
}
