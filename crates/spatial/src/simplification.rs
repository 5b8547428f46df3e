//! Simplification of the lines and rings of geometries, each alone.

use burgeon_geometry::Rings;
use burgeon_geometry::planar::{self, foot};
use glam::DVec3;

use super::Geometry;

impl Geometry {
    /// Simplifies each line and ring alone, as `ST_Simplify` of PostGIS: no removed point is farther than `distance` (m)
    /// from the result. Rings with fewer than three points are removed, and rings may cross afterwards;
    /// [`simplify`](Self::simplify) repairs them.
    ///
    /// ```
    /// use burgeon_spatial::Geometry;
    ///
    /// let street = Geometry::from_wkt("LINESTRING (0 0, 5 0.1, 10 0, 10 10)")?;
    /// assert_eq!(street.simplify_separately(0.5).to_wkt(), Geometry::from_wkt("LINESTRING (0 0, 10 0, 10 10)")?.to_wkt());
    /// # Ok::<(), burgeon_base::error::Error>(())
    /// ```
    #[must_use]
    pub fn simplify_separately(&self, distance: f64) -> Self {
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
        match self {
            Geometry::Line(points) => Geometry::Line(line(points)),
            Geometry::MultiLine(lines) => {
                Geometry::MultiLine(lines.iter().map(|points| line(points)).collect())
            }
            Geometry::Polygon(polygon) => Geometry::Polygon(rings(polygon)),
            Geometry::MultiPolygon(polygons) => {
                Geometry::MultiPolygon(polygons.iter().map(rings).filter(|rings| !rings.is_empty()).collect())
            }
            Geometry::Collection(members) => Geometry::Collection(
                members.iter().map(|member| member.simplify_separately(distance)).collect(),
            ),
            other => other.clone(),
        }
    }
}

/// Returns the horizontal distance of a point from the line between two others.
fn line_distance(point: DVec3, way: [DVec3; 2]) -> f64 {
    let part = foot(way, point.truncate());
    let [from, to] = way.map(DVec3::truncate);
    (point.truncate() - from).distance((to - from) * part)
}
