//! Selection of features by geometry type, by box and by number.

use glam::{DVec2, DVec3};
use robust::{Coord, orient2d};

use burgeon_spatial::{Geometry, GeometryKind};

/// Selection of the features to keep.
#[derive(Debug)]
pub(crate) struct FeatureSelection {
    /// Type of the geometries to keep.
    pub(crate) kind: Option<GeometryKind>,
    /// West, south, east and north of a box that features must touch, in the coordinates of the file.
    pub(crate) within: Option<[f64; 4]>,
    /// Maximum number of features to keep.
    pub(crate) limit: Option<usize>,
    /// Types of geometries that occurred, by number, kept or not.
    pub(crate) seen: [bool; 3],
}

impl FeatureSelection {
    /// Returns true if a geometry has the requested type and touches the requested box. Records its type.
    pub(crate) fn keeps(&mut self, geometry: &Geometry) -> bool {
        if let Some(seen) = self.seen.get_mut(geometry.kind() as usize) {
            *seen = true;
        }
        self.kind.is_none_or(|kind| kind == geometry.kind())
            && self.within.is_none_or(|within| SelectionBox::new(within).touches(geometry))
    }

    /// Returns true if a geometry with these bounds may touch the requested box, if any; also if the bounds are unknown.
    pub(crate) fn may_touch(&self, bounds: Option<[f64; 4]>) -> bool {
        let (Some(within), Some(bounds)) = (self.within, bounds) else { return true };
        SelectionBox::new(within).meets(&SelectionBox::new(bounds))
    }
}

/// Closed rectangle.
struct SelectionBox {
    low: DVec2,
    high: DVec2,
}

impl SelectionBox {
    fn new([west, south, east, north]: [f64; 4]) -> Self {
        Self { low: DVec2::new(west, south), high: DVec2::new(east, north) }
    }

    fn meets(&self, other: &Self) -> bool {
        self.low.cmple(other.high).all() && other.low.cmple(self.high).all()
    }

    fn contains(&self, point: DVec2) -> bool {
        self.low.cmple(point).all() && point.cmple(self.high).all()
    }

    /// Returns true if a geometry has a point in common with the box. A geometry with a coordinate that is not finite
    /// touches the box if its bounds do; it is refused with its reason later.
    fn touches(&self, geometry: &Geometry) -> bool {
        let mut bounds = Self { low: DVec2::INFINITY, high: DVec2::NEG_INFINITY };
        let mut is_finite = true;
        for point in geometry.points() {
            let point = point.truncate();
            (bounds.low, bounds.high) = (bounds.low.min(point), bounds.high.max(point));
            is_finite &= point.is_finite();
        }
        if !self.meets(&bounds) {
            return false;
        }
        !is_finite || self.contains(bounds.low) && self.contains(bounds.high) || self.cuts(geometry)
    }

    /// Returns true if a geometry with finite coordinates has a point in common with the box.
    fn cuts(&self, geometry: &Geometry) -> bool {
        match geometry {
            Geometry::Point(point) => point.is_some_and(|point| self.contains(point.truncate())),
            Geometry::Line(line) => self.cuts_line(line),
            Geometry::Polygon(rings) => self.cuts_area(&rings.0),
            Geometry::MultiPoint(points) => points.iter().any(|point| self.contains(point.truncate())),
            Geometry::MultiLine(lines) => lines.iter().any(|line| self.cuts_line(line)),
            Geometry::MultiPolygon(areas) => areas.iter().any(|rings| self.cuts_area(&rings.0)),
            Geometry::Collection(members) => members.iter().any(|member| self.cuts(member)),
        }
    }

    fn cuts_line(&self, line: &[DVec3]) -> bool {
        line.windows(2).any(|pair| self.cuts_segment(pair[0].truncate(), pair[1].truncate()))
    }

    /// Returns true if the box has a point in common with an area: with a ring, or else with the interior.
    fn cuts_area(&self, rings: &[Vec<DVec3>]) -> bool {
        let edges = || rings.iter().flat_map(|ring| ring_edges(ring));
        if edges().any(|[from, to]| self.cuts_segment(from, to)) {
            return true;
        }
        // No ring meets the box, so all of its points are inside, or all are outside or in holes.
        let crossings = edges().filter(|[from, to]| is_left_crossing(self.low, *from, *to)).count();
        crossings % 2 == 1
    }

    /// Returns true if the box has a point in common with a segment.
    ///
    /// Method: separating axes, of which the two of the box are compared exactly, and that of the segment by robust
    /// predicates.
    fn cuts_segment(&self, from: DVec2, to: DVec2) -> bool {
        if !self.meets(&Self { low: from.min(to), high: from.max(to) }) {
            return false;
        }
        let [low, high] = [self.low, self.high];
        let corners = [low, DVec2::new(high.x, low.y), high, DVec2::new(low.x, high.y)];
        let sides = corners.map(|corner| side(from, to, corner));
        !sides.iter().all(|side| *side > 0.0) && !sides.iter().all(|side| *side < 0.0)
    }
}

/// Returns the edges of a ring that does not repeat its first point.
fn ring_edges(ring: &[DVec3]) -> impl Iterator<Item = [DVec2; 2]> {
    let next = ring.iter().cycle().skip(1);
    ring.iter().zip(next).map(|(from, to)| [from.truncate(), to.truncate()])
}

/// Returns true if the ray from `place` to the east crosses the edge, of which `place` is no point.
fn is_left_crossing(place: DVec2, from: DVec2, to: DVec2) -> bool {
    let up = [from.y > place.y, to.y > place.y];
    up[0] != up[1] && (side(from, to, place) > 0.0) == up[1]
}

/// Returns a positive number if `place` is to the left of the line, a negative one if it is to the right, 0 if it is on
/// it.
fn side(from: DVec2, to: DVec2, place: DVec2) -> f64 {
    let coord = |point: DVec2| Coord { x: point.x, y: point.y };
    orient2d(coord(from), coord(to), coord(place))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn touches(text: &str, within: [f64; 4]) -> bool {
        SelectionBox::new(within).touches(&Geometry::from_wkt(text).unwrap())
    }

    #[test]
    fn a_geometry_around_a_box_does_not_touch_it() {
        let diagonal = "LINESTRING (0 0, 10 10)";
        assert!(!touches(diagonal, [6.0, 0.0, 10.0, 4.0]));
        assert!(!touches("LINESTRING (0 0, 10 0, 10 10)", [1.0, 1.0, 9.0, 9.0]));
        // One unit in the last place away from the corner.
        assert!(!touches(diagonal, [6.0f64.next_up(), 0.0, 10.0, 6.0]));
        let ring = "POLYGON ((0 0, 10 0, 10 10, 0 10, 0 0), (2 2, 8 2, 8 8, 2 8, 2 2))";
        assert!(!touches(ring, [3.0, 3.0, 7.0, 7.0]));
        let bent = "POLYGON ((0 0, 10 0, 10 10, 9 10, 9 1, 0 1, 0 0))";
        assert!(!touches(bent, [1.0, 2.0, 8.0, 9.0]));
        assert!(!touches("MULTIPOINT ((0 0), (10 10))", [4.0, 4.0, 6.0, 6.0]));
    }

    #[test]
    fn the_boundary_and_the_inside_touch() {
        let diagonal = "LINESTRING (0 0, 10 10)";
        assert!(touches(diagonal, [6.0, 0.0, 10.0, 6.0]) && touches(diagonal, [4.0, 4.0, 5.0, 5.0]));
        assert!(touches(diagonal, [3.0, 3.0, 3.0, 3.0]) && !touches(diagonal, [3.0, 4.0, 3.0, 4.0]));
        let ring = "POLYGON ((0 0, 10 0, 10 10, 0 10, 0 0), (2 2, 8 2, 8 8, 2 8, 2 2))";
        assert!(touches(ring, [3.0, 3.0, 8.0, 7.0]) && touches(ring, [0.5, 0.5, 1.5, 1.5]));
        assert!(touches(ring, [-5.0, -5.0, 15.0, 15.0]) && touches(ring, [10.0, 10.0, 11.0, 11.0]));
        assert!(touches("POINT (1 2)", [1.0, 2.0, 3.0, 4.0]));
        assert!(touches("MULTIPOINT ((0 0), (10 10))", [9.0, 9.0, 11.0, 11.0]));
        let far = "POLYGON ((385400 6671500, 385420 6671500, 385420 6671520, 385400 6671500))";
        assert!(touches(far, [385_405.0, 6_671_505.0, 385_405.0, 6_671_505.0]));
        assert!(!touches(far, [385_405.0, 6_671_505.1, 385_405.0, 6_671_505.2]));
    }
}
