//! Points as line strings of `geo`.

use geo::{Coord, LineString};
use glam::DVec2;

use super::Point;
use super::measure::coord;

impl Point for Coord {
    fn flat(self) -> DVec2 {
        DVec2::new(self.x, self.y)
    }
}

/// Returns the line through points, unchanged.
pub(super) fn string<P: Point>(points: &[P]) -> LineString {
    points.iter().map(|point| coord(point.flat())).collect()
}

/// Returns the points of a line.
pub(super) fn points(line: &LineString) -> Vec<DVec2> {
    line.coords().map(|at| at.flat()).collect()
}

/// Returns the closed line around a ring of points.
pub(super) fn closed_string<P: Point>(ring: &[P]) -> LineString {
    let mut line = string(ring);
    line.close();
    line
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
