//! Conversion of geometries to and from `geo`, relative to a local origin.

use burgeon_geometry::Rings;
use burgeon_geometry::planar::is_counter_clockwise;
use glam::{DVec2, DVec3};

use super::Geometry;

/// A local origin near the operands.
///
/// Coordinates of millions of metres have few fractional digits; their differences have all.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Plane {
    origin: DVec2,
}

impl Plane {
    /// Creates a common local origin for several geometries. Geometries near the global origin, relative to
    /// their size, keep it, because a local origin would not improve the accuracy.
    pub(crate) fn of(geometries: &[&Geometry]) -> Self {
        let bounds = geometries.iter().filter(|it| it.is_sound()).filter_map(|it| it.bounds());
        let around = bounds.reduce(|[a, b], [c, d]| [a.min(c), b.max(d)]);
        let Some([low, high]) = around else { return Self { origin: DVec2::ZERO } };
        let (size, middle) = ((high - low).max_element(), ((low + high) / 2.0).floor());
        // Each axis is tested separately, so that no difference is rounded.
        let far = middle.abs().cmpgt(DVec2::splat(8.0 * size.max(1.0)));
        Self { origin: DVec2::select(far, middle, DVec2::ZERO) }
    }

    /// Returns the plane with global coordinates.
    pub(crate) fn absolute() -> Self {
        Self { origin: DVec2::ZERO }
    }

    /// Converts a point to horizontal local coordinates.
    pub(crate) fn flat(self, point: DVec3) -> DVec2 {
        point.truncate() - self.origin
    }

    /// Converts local coordinates back to a point.
    pub(crate) fn back(self, place: DVec2) -> DVec3 {
        (place + self.origin).extend(0.0)
    }

    /// Converts a geometry to `geo`, without empty parts; empty if it is not sound.
    pub(crate) fn geo(self, geometry: &Geometry) -> geo::Geometry {
        if geometry.is_sound() { self.convert(geometry) } else { geo::MultiPoint::new(Vec::new()).into() }
    }

    fn convert(self, geometry: &Geometry) -> geo::Geometry {
        match geometry {
            Geometry::Point(Some(point)) => geo::Point(self.coord(*point)).into(),
            Geometry::Point(None) => geo::MultiPoint::new(Vec::new()).into(),
            Geometry::Line(points) if points.len() < 2 => geo::MultiLineString::new(Vec::new()).into(),
            Geometry::Line(points) => self.string(points).into(),
            Geometry::Polygon(rings) => {
                self.polygon(rings).map_or_else(|| geo::MultiPolygon::new(Vec::new()).into(), Into::into)
            }
            Geometry::MultiPoint(points) => {
                geo::MultiPoint::new(points.iter().map(|point| geo::Point(self.coord(*point))).collect())
                    .into()
            }
            Geometry::MultiLine(lines) => {
                let lines = lines.iter().filter(|line| line.len() > 1).map(|line| self.string(line));
                geo::MultiLineString::new(lines.collect()).into()
            }
            Geometry::MultiPolygon(polygons) => {
                geo::MultiPolygon::new(polygons.iter().filter_map(|rings| self.polygon(rings)).collect())
                    .into()
            }
            Geometry::Collection(members) => {
                let members = members.iter().filter(|member| !member.is_empty()).map(|it| self.convert(it));
                geo::Geometry::GeometryCollection(members.collect::<Vec<_>>().into())
            }
        }
    }

    pub(crate) fn coord(self, point: DVec3) -> geo::Coord {
        let place = self.flat(point);
        geo::Coord { x: place.x, y: place.y }
    }

    pub(crate) fn string(self, points: &[DVec3]) -> geo::LineString {
        points.iter().map(|point| self.coord(*point)).collect()
    }

    /// Converts a polygon with correctly oriented rings; `None` if it is empty.
    pub(crate) fn polygon(self, rings: &Rings) -> Option<geo::Polygon> {
        let turned = |ring: &Vec<DVec3>, is_outer: bool| -> geo::LineString {
            let mut turned = self.string(ring);
            let places: Vec<DVec2> = ring.iter().map(|point| self.flat(*point)).collect();
            if is_counter_clockwise(&places) != is_outer {
                turned.0.reverse();
            }
            turned
        };
        let mut rings = rings.iter();
        let outer = rings.next().filter(|outer| outer.len() > 2)?;
        let holes = rings.filter(|hole| hole.len() > 2).map(|hole| turned(hole, false));
        Some(geo::Polygon::new(turned(outer, true), holes.collect()))
    }

    /// Converts all polygons of a geometry.
    pub(crate) fn polygons(self, geometry: &Geometry) -> geo::MultiPolygon {
        let mut polygons = Vec::new();
        if geometry.is_sound() {
            collect_polygons(geometry, &mut |rings| polygons.extend(self.polygon(rings)));
        }
        geo::MultiPolygon::new(polygons)
    }

    /// Converts the rings of a `geo` polygon back.
    pub(crate) fn rings(self, polygon: &geo::Polygon) -> Rings {
        let open = |ring: &geo::LineString| -> Vec<DVec3> {
            let count = ring.0.len() - usize::from(ring.0.len() > 1 && ring.is_closed());
            ring.0[..count].iter().map(|at| self.back(DVec2::new(at.x, at.y))).collect()
        };
        let mut rings: Rings =
            std::iter::once(polygon.exterior()).chain(polygon.interiors()).map(open).collect();
        rings.turn();
        rings
    }
}

/// Calls `each` with the rings of every polygon of a geometry.
pub(crate) fn collect_polygons<'a>(geometry: &'a Geometry, each: &mut impl FnMut(&'a Rings)) {
    match geometry {
        Geometry::Polygon(rings) => each(rings),
        Geometry::MultiPolygon(polygons) => polygons.iter().for_each(each),
        Geometry::Collection(members) => members.iter().for_each(|member| collect_polygons(member, each)),
        _ => {}
    }
}

/// Calls `each` with the points of every line of a geometry.
pub(crate) fn collect_lines<'a>(geometry: &'a Geometry, each: &mut impl FnMut(&'a [DVec3])) {
    match geometry {
        Geometry::Line(points) => each(points),
        Geometry::MultiLine(lines) => lines.iter().for_each(|line| each(line)),
        Geometry::Collection(members) => members.iter().for_each(|member| collect_lines(member, each)),
        _ => {}
    }
}

/// Calls `each` with every point that is not part of a line or ring.
pub(crate) fn collect_points(geometry: &Geometry, each: &mut impl FnMut(DVec3)) {
    match geometry {
        Geometry::Point(Some(point)) => each(*point),
        Geometry::MultiPoint(points) => points.iter().copied().for_each(each),
        Geometry::Collection(members) => members.iter().for_each(|member| collect_points(member, each)),
        _ => {}
    }
}
