//! Faces that a script gives by their corners, drawn in a frame.

use burgeon_base::error::{Error, Result};
use burgeon_geometry::{Frame, face};
use burgeon_kit::Vector;
use burgeon_scene::Part;
use glam::DVec3;

/// Draws `faces`, each the numbers of its corners among `points` (m), counter-clockwise seen from outside.
///
/// The points are in the axes of `frame`, as models are placed. Fails where a face has fewer than three corners, or names a
/// point that there is not, and then draws nothing.
pub(crate) fn draw_mesh(
    (kind, part): (&str, &mut Part),
    frame: &Frame,
    points: &[Vector],
    faces: &[Vec<u32>],
) -> Result<()> {
    let transform = frame.transform();
    let placed: Vec<DVec3> = points.iter().map(|point| transform.transform_point3(point.0)).collect();
    let mut corners = Vec::with_capacity(faces.len());
    for (number, face) in (1..).zip(faces) {
        if face.len() < 3 {
            return Err(Error::argument(format!("{kind}:mesh: face {number} has {} corners", face.len()))
                .help("a face has three corners or more, such as { 1, 2, 3 }"));
        }
        let found: Option<Vec<DVec3>> =
            face.iter().map(|corner| placed.get((*corner as usize).checked_sub(1)?).copied()).collect();
        corners.push(found.ok_or_else(|| {
            let count = placed.len();
            Error::argument(format!(
                "{kind}:mesh: face {number} names a point that is not one of 1 to {count}"
            ))
            .help("points are numbered from 1 on, in the order in which they are given")
        })?);
    }
    corners.iter().try_for_each(|corners| face(part, corners))
}
