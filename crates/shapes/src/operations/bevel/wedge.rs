//! Prisms that are cut off along edges.

use burgeon_base::error::Result;
use glam::{DMat3, DVec2, DVec3};

use crate::{Scope, Shape};

/// Returns the prism that is cut off along an edge; `None` for a concave edge.
///
/// `normals` are those of the face that runs in the direction of the edge, and of the other one. With `segments` above 0, the prism
/// ends at an arc of as many segments, otherwise at a plane; both begin at `distance` (m) from the edge on the faces.
pub(super) fn wedge(
    edge: &Shape,
    normals: [DVec3; 2],
    distance: f64,
    segments: u32,
) -> Result<Option<Shape>> {
    let scope = &edge.scope();
    let along = scope.axes.x_axis;
    let [two, one] = normals;
    // At a convex edge, the other face goes down from the first one.
    if one.dot(two.cross(along)) > -1e-9 {
        return Ok(None);
    }
    let out = (one + two).normalize_or_zero();
    let away =
        |normal: DVec3, other: DVec3| -> DVec3 { (normal * normal.dot(other) - other).normalize_or_zero() };
    let (first, second) = (away(one, two), away(two, one));
    // Coordinates across the edge: to the right and outwards.
    let right = out.cross(along);
    let flat = |vector: DVec3| DVec2::new(vector.dot(right), vector.dot(out));
    let (a, b) = (flat(first * distance), flat(second * distance));
    let beyond = (a - b) * 0.2;
    let mut ring = vec![
        a + beyond,
        DVec2::Y * (2.0 * distance) + beyond,
        DVec2::Y * (2.0 * distance) - beyond,
        b - beyond,
    ];
    if segments > 0 {
        ring.push(b);
        // The centre of the arc lies on the normals through both ends.
        let half = first.angle_between(second) / 2.0;
        let (radius, center) = (distance * half.tan(), DVec2::NEG_Y * (distance / half.cos()));
        let (from, to) = ((b - center).to_angle(), (a - center).to_angle());
        let mut turn = to - from;
        turn -= std::f64::consts::TAU * (turn / std::f64::consts::TAU).round();
        for step in 1..segments {
            ring.push(
                center + DVec2::from_angle(from + turn * f64::from(step) / f64::from(segments)) * radius,
            );
        }
        ring.push(a);
    }
    let start = scope.origin - along * distance;
    let frame =
        Scope { origin: start, axes: DMat3::from_cols(right, out, right.cross(out)), size: DVec3::ZERO };
    let Ok(polygon) = burgeon_geometry::Polygon::turned(burgeon_geometry::Rings(vec![ring])) else {
        return Ok(None);
    };
    let face = Shape::of_polygon(&polygon, &frame, &None);
    let length = scope.size.x + 2.0 * distance;
    face.extrude(length, Some(along)).map(Some)
}
