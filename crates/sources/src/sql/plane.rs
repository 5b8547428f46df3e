//! Conversion of geometries to the types of `geo`, for relations between two geometries.

use burgeon_spatial::{Geometry, Rings};
use geo::{Coord, LineString, MultiLineString, MultiPoint, MultiPolygon, Point, Polygon};
use glam::DVec3;

/// Converts a geometry to `geo`'s types, without z. Empty geometries keep their type, except an empty point.
pub(crate) fn flat(geometry: &Geometry) -> geo::Geometry<f64> {
    match geometry {
        Geometry::Point(None) => MultiPoint(Vec::new()).into(),
        Geometry::Point(Some(at)) => point(at).into(),
        Geometry::Line(points) => line(points).into(),
        Geometry::Polygon(rings) => polygon(rings).into(),
        Geometry::MultiPoint(points) => MultiPoint(points.iter().map(point).collect()).into(),
        Geometry::MultiLine(lines) => MultiLineString(lines.iter().map(|it| line(it)).collect()).into(),
        Geometry::MultiPolygon(polygons) => MultiPolygon(polygons.iter().map(polygon).collect()).into(),
        Geometry::Collection(members) => {
            geo::Geometry::GeometryCollection(members.iter().map(flat).collect::<Vec<_>>().into())
        }
    }
}

fn coord(at: &DVec3) -> Coord<f64> {
    Coord { x: at.x, y: at.y }
}

fn point(at: &DVec3) -> Point<f64> {
    Point(coord(at))
}

fn line(points: &[DVec3]) -> LineString<f64> {
    LineString(points.iter().map(coord).collect())
}

fn polygon(rings: &Rings) -> Polygon<f64> {
    // `Polygon::new` closes the rings.
    let mut rings = rings.iter().map(|ring| line(ring));
    Polygon::new(rings.next().unwrap_or_else(|| LineString(Vec::new())), rings.collect())
}
