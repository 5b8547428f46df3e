//! Conversion of areas to and from other types.

use burgeon_geometry::Rings;
use burgeon_geometry::overlay::PolygonArea;
use geo::{Coord, LineString, MultiPolygon, Polygon};
use glam::DVec2;

use crate::Geometry;

/// Converts polygons of `geo` to an area.
pub(crate) fn area_of(polygons: &MultiPolygon) -> PolygonArea {
    polygons.iter().map(Rings::from).collect()
}

/// Converts an area to polygons of `geo`.
pub(super) fn polygons_of(area: &PolygonArea) -> MultiPolygon {
    let string = |ring: &Vec<DVec2>| {
        let mut line: LineString = ring.iter().map(|at| Coord { x: at.x, y: at.y }).collect();
        line.close();
        line
    };
    let polygon = |rings: &Rings<DVec2>| {
        let mut rings = rings.iter().map(string);
        let outer = rings.next().unwrap_or_else(|| LineString::new(Vec::new()));
        Polygon::new(outer, rings.collect())
    };
    MultiPolygon::new(area.iter().map(polygon).collect())
}

/// Returns the simplest geometry of an area.
pub(crate) fn geometry_of(area: &PolygonArea) -> Geometry {
    match &area[..] {
        [] => Geometry::empty(2),
        [only] => Geometry::Polygon(only.at_height(0.0)),
        many => Geometry::MultiPolygon(many.iter().map(|rings| rings.at_height(0.0)).collect()),
    }
}
