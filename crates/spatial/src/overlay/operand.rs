//! Operands of set operations: the areas, lines and points of a geometry, without duplicates.

use burgeon_base::budget::Budget;
use burgeon_geometry::overlay::{Fill, LayerWay, WayKind, fill, ring_ways, unite};
use burgeon_geometry::planar::is_flat;
use burgeon_geometry::planar::twice_area;
use geo::{BoundingRect, MultiPolygon};
use glam::DVec2;

use super::convert::{area_of, polygons_of};
use crate::Geometry;
use crate::plane::{Plane, collect_lines, collect_points};
use crate::ways::multi_polygon_flaw;

/// One of the two operands of an operation.
pub(crate) struct Operand {
    pub(crate) areas: MultiPolygon,
    pub(crate) lines: Vec<Vec<DVec2>>,
    pub(crate) points: Vec<DVec2>,
    /// Set if the areas have exactly the input corners, because no area had to be computed.
    pub(crate) are_given: bool,
}

impl Operand {
    pub(crate) fn new(plane: Plane, geometry: &Geometry) -> Self {
        let mut made = Self::undissolved(plane, geometry);
        made.are_given = are_disjoint(&made.areas);
        if !made.are_given {
            made.areas = united(&made.areas);
        }
        made
    }

    /// Creates the operand of a set operation, in global coordinates. The rings of a single polygon may cross
    /// each other.
    pub(super) fn for_overlay(geometry: &Geometry) -> Self {
        let mut made = Self::undissolved(Plane::absolute(), geometry);
        if made.areas.0.len() > 1 {
            made.areas = dissolved(made.areas);
        }
        made
    }

    fn undissolved(plane: Plane, geometry: &Geometry) -> Self {
        let (mut lines, mut points) = (Vec::new(), Vec::new());
        if geometry.is_sound() {
            collect_lines(geometry, &mut |line| {
                let line: Vec<DVec2> = line.iter().map(|point| plane.flat(*point)).collect();
                match line.first() {
                    // A line without length becomes a point.
                    Some(first) if line.iter().all(|place| place == first) => points.push(*first),
                    Some(_) => lines.push(line),
                    None => {}
                }
            });
            collect_points(geometry, &mut |point| points.push(plane.flat(point)));
        }
        let (areas, thin) = with_width(plane.polygons(geometry));
        lines.extend(thin.iter().map(|ring| ring.0.iter().map(|at| DVec2::new(at.x, at.y)).collect()));
        Self { areas, lines, points, are_given: false }
    }

    /// Returns the lines, rings and points, in this order, with all points as one way.
    pub(super) fn ways(&self, layer: usize) -> Vec<LayerWay> {
        let line = |places: &Vec<DVec2>| LayerWay { layer, kind: WayKind::Line, places: places.clone() };
        let mut ways: Vec<LayerWay> = self.lines.iter().map(line).collect();
        ways.extend(ring_ways(&area_of(&self.areas), layer));
        ways.push(LayerWay { layer, kind: WayKind::Points, places: self.points.clone() });
        ways
    }

    pub(super) fn is_of_areas(&self) -> bool {
        self.lines.is_empty() && self.points.is_empty()
    }
}

/// Area (m²) below which rings are tested for an interior.
const NARROW: f64 = 1e-9;

/// Separates areas with an interior from the rings of collapsed areas, which become lines.
pub(crate) fn with_width(areas: MultiPolygon) -> (MultiPolygon, Vec<geo::LineString>) {
    let (thin, wide): (Vec<_>, Vec<_>) = areas.into_iter().partition(|area| {
        twice_area(area.exterior().coords().copied()).abs() < NARROW
            && filled(&MultiPolygon(vec![area.clone()]), Fill::NonZero).0.is_empty()
    });
    (MultiPolygon(wide), thin.into_iter().map(|area| area.into_inner().0).collect())
}

/// Returns areas whose rings neither cross nor overlap: unchanged if possible, otherwise the union of all
/// areas.
pub(crate) fn dissolved(areas: MultiPolygon) -> MultiPolygon {
    if are_disjoint(&areas) { areas } else { united(&areas) }
}

/// Returns true if the rings of areas neither cross nor overlap.
fn are_disjoint(areas: &MultiPolygon) -> bool {
    // Collapsed rings are not accepted.
    let has_width = |ring: &geo::LineString| !is_flat(ring.0.iter().map(|at| DVec2::new(at.x, at.y)));
    let are_wide = |it: &geo::Polygon| has_width(it.exterior()) && it.interiors().iter().all(has_width);
    areas.iter().all(are_wide) && matches!(multi_polygon_flaw(areas, &Budget::default()), Ok(None))
}

/// Minimum extent (m) of an operand: products of smaller coordinates underflow.
pub(crate) const LEAST_EXTENT: f64 = 1e-15;

fn has_extent(areas: &MultiPolygon) -> bool {
    areas.bounding_rect().is_some_and(|around| around.width().max(around.height()) >= LEAST_EXTENT)
}

/// Computes the union of polygons; empty if the work of this thread is cancelled.
fn united(areas: &MultiPolygon) -> MultiPolygon {
    if !has_extent(areas) {
        return MultiPolygon::new(Vec::new());
    }
    polygons_of(&unite(area_of(areas)).unwrap_or_default())
}

/// Computes the area that rings enclose by a fill rule; empty if the work of this thread is cancelled.
pub(crate) fn filled(areas: &MultiPolygon, rule: Fill) -> MultiPolygon {
    if !has_extent(areas) {
        return MultiPolygon::new(Vec::new());
    }
    polygons_of(&fill(&area_of(areas), rule).unwrap_or_default())
}
