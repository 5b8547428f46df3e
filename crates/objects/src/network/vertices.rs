//! Vertices and upright faces in the parts of a drawing.

use glam::{DVec2, DVec3};

use burgeon_scene::{Normal, Part};

/// Draws an upright face of this height (m) above a line, visible from the right of the line's direction.
pub(super) fn upright(part: &mut Part, [a, b]: [DVec3; 2], height: f64) {
    let Some(out) = (a - b).truncate().try_normalize().map(DVec2::perp) else { return };
    if height <= 0.0 {
        return;
    }
    let first = next_vertex(part);
    for (at, up) in [(a, 0.0), (b, 0.0), (b, height), (a, height)] {
        part.positions.push((at + DVec3::Z * up).as_vec3());
        part.normals.push(Normal::from(out.extend(0.0)));
        part.uvs.push(DVec2::new(if at == a { 0.0 } else { a.distance(b) }, up).as_vec2());
    }
    part.triangles.extend([[0, 1, 2], [0, 2, 3]].map(|face| face.map(|corner| corner + first)));
}

fn next_vertex(part: &Part) -> u32 {
    u32::try_from(part.positions.len()).unwrap_or(u32::MAX)
}

/// Adds points with upward normals, raised by `lift` (m), and returns the number of the first point.
pub(super) fn add_points(part: &mut Part, points: &[DVec3], lift: f64) -> u32 {
    let first = next_vertex(part);
    for at in points {
        part.positions.push((*at + DVec3::Z * lift).as_vec3());
        part.normals.push(Normal::from(DVec3::Z));
        part.uvs.push(at.truncate().as_vec2());
    }
    first
}
