//! Conversion of plane shapes to and from `geo`, whose rings repeat their first point.

use geo::{Coord, LineString};
use glam::DVec2;

use super::measure::coord;
use super::{Line, Point, Polygon, Ring, Rings};
use burgeon_base::error::{Error, Result};

impl Point for Coord {
    fn flat(self) -> DVec2 {
        DVec2::new(self.x, self.y)
    }
}

/// Returns the line through points, unchanged.
fn string<P: Point>(points: &[P]) -> LineString {
    points.iter().map(|point| coord(point.flat())).collect()
}

fn points(line: &LineString) -> Vec<DVec2> {
    line.coords().map(|at| at.flat()).collect()
}

/// Returns the points of a line, without the last point if it is closed.
pub(super) fn open(line: &LineString) -> Vec<DVec2> {
    let mut points = points(line);
    if line.is_closed() {
        points.pop();
    }
    points
}

/// Returns the `geo` polygon inside the first ring and outside the others, in any direction.
pub(crate) fn geo_polygon<P: Point>(rings: &[impl AsRef<[P]>]) -> geo::Polygon {
    let mut lines = rings.iter().map(|ring| string(ring.as_ref()));
    let outer = lines.next().unwrap_or_else(|| LineString::new(Vec::new()));
    geo::Polygon::new(outer, lines.collect())
}

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
        let mut line = string(ring);
        line.close();
        line
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
