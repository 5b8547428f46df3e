//! A geometry as its areas, lines and points, with nothing of them twice.

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

/// One of the two that an operation takes.
pub(crate) struct Operand {
    pub(crate) areas: MultiPolygon,
    pub(crate) lines: Vec<Vec<DVec2>>,
    pub(crate) points: Vec<DVec2>,
    /// Whether the areas are those that were given, corner by corner: none had to be computed.
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

    /// The operand of a set operation, in absolute coordinates. Of a single polygon the rings may cross each other.
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
                    // A line without length is its place.
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

    /// Its lines, rings and points, in this order; points are one way.
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

/// Below this (m²) it is looked at whether a ring goes around anything.
const NARROW: f64 = 1e-9;

/// Those areas that have a width, and the rings of those that go back the way they came, which are lines.
pub(crate) fn with_width(areas: MultiPolygon) -> (MultiPolygon, Vec<geo::LineString>) {
    let (thin, wide): (Vec<_>, Vec<_>) = areas.into_iter().partition(|area| {
        twice_area(area.exterior().coords().copied()).abs() < NARROW
            && filled(&MultiPolygon(vec![area.clone()]), Fill::NonZero).0.is_empty()
    });
    (MultiPolygon(wide), thin.into_iter().map(|area| area.into_inner().0).collect())
}

/// Areas whose rings neither cross nor overlap: as they are if that holds already, else all that the rings go around.
pub(crate) fn dissolved(areas: MultiPolygon) -> MultiPolygon {
    if are_disjoint(&areas) { areas } else { united(&areas) }
}

/// Whether the rings of areas neither cross nor overlap.
fn are_disjoint(areas: &MultiPolygon) -> bool {
    // A ring that goes back the way it came is not asked after.
    let has_width = |ring: &geo::LineString| !is_flat(ring.0.iter().map(|at| DVec2::new(at.x, at.y)));
    let are_wide = |it: &geo::Polygon| has_width(it.exterior()) && it.interiors().iter().all(has_width);
    areas.iter().all(are_wide) && matches!(multi_polygon_flaw(areas, &Budget::default()), Ok(None))
}

/// Below this (m) an extent is none: products of such coordinates are too small for numbers to hold them.
pub(crate) const LEAST_EXTENT: f64 = 1e-15;

fn has_extent(areas: &MultiPolygon) -> bool {
    areas.bounding_rect().is_some_and(|around| around.width().max(around.height()) >= LEAST_EXTENT)
}

/// The union of polygons; nothing once the work of this thread is to stop.
fn united(areas: &MultiPolygon) -> MultiPolygon {
    if !has_extent(areas) {
        return MultiPolygon::new(Vec::new());
    }
    polygons_of(&unite(area_of(areas)).unwrap_or_default())
}

/// The area that rings enclose, by a rule; nothing once the work of this thread is to stop.
pub(crate) fn filled(areas: &MultiPolygon, rule: Fill) -> MultiPolygon {
    if !has_extent(areas) {
        return MultiPolygon::new(Vec::new());
    }
    polygons_of(&fill(&area_of(areas), rule).unwrap_or_default())
}
