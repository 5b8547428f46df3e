//! Shapes of the plane to and from those of `geo`, whose rings are closed by their first point again.

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

/// The line through points, as they are.
fn string<P: Point>(points: &[P]) -> LineString {
    points.iter().map(|point| coord(point.flat())).collect()
}

fn points(line: &LineString) -> Vec<DVec2> {
    line.coords().map(|at| at.flat()).collect()
}

/// The points of a closed line but the last.
pub(super) fn open(line: &LineString) -> Vec<DVec2> {
    let mut points = points(line);
    if line.is_closed() {
        points.pop();
    }
    points
}

/// The polygon of `geo` inside the first of rings and outside the others, whichever way they run.
pub(crate) fn geo_polygon<P: Point>(rings: &[impl AsRef<[P]>]) -> geo::Polygon {
    let mut lines = rings.iter().map(|ring| string(ring.as_ref()));
    let outer = lines.next().unwrap_or_else(|| LineString::new(Vec::new()));
    geo::Polygon::new(outer, lines.collect())
}

/// The rings of a polygon of `geo`, as they are.
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

/// Rings are turned the way that they are to run.
impl TryFrom<&geo::Polygon> for Polygon {
    type Error = Error;

    fn try_from(polygon: &geo::Polygon) -> Result<Self> {
        Self::turned(Rings::from(polygon))
    }
}
