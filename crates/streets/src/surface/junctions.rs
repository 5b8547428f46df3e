//! Carriageways of junctions: the areas between the ends of their streets.

use glam::DVec2;

use super::parts::StreetSurface;
use crate::plan::corner::StreetLine;
use crate::plan::network::JunctionId;
use crate::shape::profile::StreetProfiles;
use crate::shape::shapes::{StreetShapes, without_repeats};
use burgeon_geometry::planar::edges;
use burgeon_geometry::{Polygon, Rings};

/// Returns the line around a junction (m), counter-clockwise.
pub(super) fn outline(shapes: &StreetShapes<'_>, junction: JunctionId, line: StreetLine) -> Vec<DVec2> {
    let mut outline = Vec::new();
    for (index, arm) in shapes.junction(junction).arms.iter().enumerate() {
        let half = arm.arm.aside(line);
        outline.extend([-half, half].map(|aside| shapes.end(junction, arm.piece, aside)));
        let [edge, kerb] = shapes.corner(junction, index);
        outline.extend(if line == StreetLine::Edge { edge } else { kerb });
    }
    without_repeats(&mut outline, |a, b| a == b);
    outline
}

/// Returns the surface between the ends of the streets at a junction.
pub(super) fn junction_surface(
    shapes: &StreetShapes<'_>,
    profiles: &StreetProfiles,
    junction: JunctionId,
) -> Option<StreetSurface> {
    let shape = shapes.junction(junction);
    if shape.arms.is_empty() || shape.is_mitred {
        return None;
    }
    let outline = outline(shapes, junction, StreetLine::Kerb);
    let middle = match &shape.arms[..] {
        // The end of a street is a semicircle, whose centre is on its edge.
        [arm] => shapes.network.at(junction) - arm.arm.way * (arm.arm.aside(StreetLine::Kerb) / 4.0),
        _ => shapes.network.at(junction),
    };
    let height = profiles.junction(junction);
    let is_around = edges(&outline).all(|[a, b]| (a - middle).perp_dot(b - middle) > 0.0);
    let divided = if is_around { None } else { triangulate(&outline) };
    let (points, triangles) = divided.unwrap_or_else(|| fan(middle, outline));
    let points = points.into_iter().map(|at| at.extend(height)).collect();
    let depths = shape.arms.iter().map(|arm| shapes.network.attributes(arm.piece).depth);
    Some(StreetSurface { points, triangles, piece: None, depth: depths.min().unwrap_or_default() })
}

/// Points (m) and triangles, counter-clockwise.
type PlaneTriangles = (Vec<DVec2>, Vec<[u32; 3]>);

/// Returns the triangles between a point (m) and the outline around it.
fn fan(middle: DVec2, outline: Vec<DVec2>) -> PlaneTriangles {
    #[allow(clippy::cast_possible_truncation, reason = "some dozens of points")]
    let count = outline.len() as u32;
    let triangles = (0..count).map(|index| [0, 1 + index, 1 + (index + 1) % count]).collect();
    (std::iter::once(middle).chain(outline).collect(), triangles)
}

/// Triangulates an outline (m); `None` if it intersects itself.
fn triangulate(outline: &[DVec2]) -> Option<PlaneTriangles> {
    let polygon = Polygon::new(Rings(vec![outline.to_vec()])).ok()?;
    #[allow(clippy::cast_possible_truncation, reason = "some dozens of points")]
    let triangles = polygon.triangles().ok()?.into_iter().map(|corners| corners.map(|corner| corner as u32));
    Some((polygon.points().collect(), triangles.collect()))
}
