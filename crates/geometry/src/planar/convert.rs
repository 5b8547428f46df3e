//! Conversion of plane shapes to and from `geo`, whose rings repeat their first point.

use geo::LineString;
use glam::DVec2;

use super::strings::{closed_string, geo_polygon, open, points, string};
use super::{Line, Point, Polygon, Ring, Rings};
use burgeon_base::error::{Error, Result};

/// Converts the rings of a `geo` polygon, unchanged.
impl From<&geo::Polygon> for Rings<DVec2> {
    fn from(polygon: &geo::Polygon) -> Self {
        std::iter::once(polygon.exterior()).chain(polygon.interiors()).map(open).collect()
    }
}

impl<P: Point> From<&Line<P>> for LineString {
    fn from(line: &Line<P>) -> Self {
        string(line)
    }
}

impl<P: Point> From<&Ring<P>> for LineString {
    fn from(ring: &Ring<P>) -> Self {
        closed_string(ring)
    }
}

impl<P: Point> From<&Polygon<P>> for geo::Polygon {
    fn from(shape: &Polygon<P>) -> Self {
        geo_polygon(shape)
    }
}

impl TryFrom<&LineString> for Line {
    type Error = Error;

    fn try_from(line: &LineString) -> Result<Self> {
        Self::new(points(line))
    }
}

impl TryFrom<&LineString> for Ring {
    type Error = Error;

    fn try_from(line: &LineString) -> Result<Self> {
        Self::new(open(line))
    }
}

/// Reverses rings with the wrong direction.
impl TryFrom<&geo::Polygon> for Polygon {
    type Error = Error;

    fn try_from(polygon: &geo::Polygon) -> Result<Self> {
        Self::turned(Rings::from(polygon))
    }
}
