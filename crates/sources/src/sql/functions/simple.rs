//! Simplification of geometries.

use burgeon_geometry::Rings;
use burgeon_geometry::planar::{self, foot};
use burgeon_spatial::Geometry;
use glam::DVec3;

/// Simplifies a geometry: no removed point is farther than `distance` from the result. Rings with fewer than three
/// points are removed.
pub(super) fn simplify(geometry: &Geometry, distance: f64) -> Geometry {
    let line = |points: &[DVec3]| planar::simplified(points, distance, line_distance);
    let rings = |rings: &Rings| {
        let kept = rings.iter().enumerate().map(|(index, ring)| {
            let closed: Vec<DVec3> = ring.iter().chain(ring.first()).copied().collect();
            let mut kept = line(&closed);
            kept.pop();
            (index, kept)
        });
        let kept: Vec<(usize, Vec<DVec3>)> = kept.filter(|(_, ring)| ring.len() >= 3).collect();
        // Without its outer ring, a polygon is empty.
        match kept.first() {
            Some((0, _)) => Rings(kept.into_iter().map(|(_, ring)| ring).collect()),
            _ => Rings(Vec::new()),
        }
    };
    match geometry {
        Geometry::Line(points) => Geometry::Line(line(points)),
        Geometry::MultiLine(lines) => Geometry::MultiLine(lines.iter().map(|points| line(points)).collect()),
        Geometry::Polygon(polygon) => Geometry::Polygon(rings(polygon)),
        Geometry::MultiPolygon(polygons) => {
            Geometry::MultiPolygon(polygons.iter().map(rings).filter(|rings| !rings.is_empty()).collect())
        }
        Geometry::Collection(members) => {
            Geometry::Collection(members.iter().map(|member| simplify(member, distance)).collect())
        }
        other => other.clone(),
    }
}

/// Returns the horizontal distance of a point from the line between two others.
fn line_distance(point: DVec3, way: [DVec3; 2]) -> f64 {
    let part = foot(way, point.truncate());
    let [from, to] = way.map(DVec3::truncate);
    (point.truncate() - from).distance((to - from) * part)
}
