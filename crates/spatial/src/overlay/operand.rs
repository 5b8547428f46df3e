//! A geometry as its areas, lines and points, with nothing of them twice.

use burgeon_base::budget::Budget;
use burgeon_geometry::planar::twice_area;
use geo::bool_ops::FillRule;
use geo::{BooleanOps, BoundingRect, MultiPolygon};
use glam::DVec2;

use super::areas::{FILL, corners, snap, untangled};
use super::arrangement::{Way, WayOrigin};
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
        let are_given = are_disjoint(&areas);
        Self { areas: if are_given { areas } else { filled(&areas, FILL) }, lines, points, are_given }
    }

    /// Its lines and rings.
    pub(super) fn ways(&self, second: bool) -> Vec<Way> {
        let origin = |ring| WayOrigin { second, ring };
        let lines = self.lines.iter().map(|line| Way { origin: origin(false), places: line.clone() });
        let rings = self.areas.iter().flat_map(|it| std::iter::once(it.exterior()).chain(it.interiors()));
        let rings = rings.map(|ring| {
            let places = ring.0.iter().map(|at| DVec2::new(at.x, at.y)).collect();
            Way { origin: origin(true), places }
        });
        lines.chain(rings).collect()
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
            && filled(&MultiPolygon(vec![area.clone()]), FILL).0.is_empty()
    });
    (MultiPolygon(wide), thin.into_iter().map(|area| area.into_inner().0).collect())
}

/// Areas whose rings neither cross nor overlap: as they are if that holds already, else all that the rings go around.
pub(crate) fn dissolved(areas: MultiPolygon) -> MultiPolygon {
    if are_disjoint(&areas) { areas } else { filled(&areas, FILL) }
}

/// Whether the rings of areas neither cross nor overlap.
fn are_disjoint(areas: &MultiPolygon) -> bool {
    // A ring that goes back the way it came is not asked after.
    let has_width = |ring: &geo::LineString| twice_area(ring.coords().copied()) != 0.0;
    let are_wide = |it: &geo::Polygon| has_width(it.exterior()) && it.interiors().iter().all(has_width);
    areas.iter().all(are_wide) && matches!(multi_polygon_flaw(areas, &Budget::default()), Ok(None))
}

/// Below this (m) an extent is none: what numbers can hold that is far less still, i_overlay has no grid for.
pub(crate) const LEAST_EXTENT: f64 = 1e-15;

/// What rings go around, by a rule.
pub(crate) fn filled(areas: &MultiPolygon, rule: FillRule) -> MultiPolygon {
    if areas.bounding_rect().is_none_or(|around| around.width().max(around.height()) < LEAST_EXTENT) {
        return MultiPolygon::new(Vec::new());
    }
    let mut made = areas.union_with_fill_rule(&MultiPolygon::new(Vec::new()), rule);
    snap(&mut made, corners(areas));
    untangled(made)
}
