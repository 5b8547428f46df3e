//! Geometries as text: well-known text and GeoJSON, with exactly the output of PostGIS.

use std::fmt::Write as _;

use burgeon_spatial::{Geometry, Rings};
use glam::DVec3;

use super::decimals::coordinate_text;
use super::parts::count_members;

/// The format of the parts of geometries.
struct Form {
    /// Start and end of a list, separator of its members, and separator of a point's numbers.
    marks: [&'static str; 4],
    heights: bool,
    digits: i32,
}

impl Form {
    fn point(&self, at: &DVec3) -> String {
        let mut numbers = vec![coordinate_text(at.x, self.digits), coordinate_text(at.y, self.digits)];
        if self.heights {
            numbers.push(coordinate_text(at.z, self.digits));
        }
        numbers.join(self.marks[3])
    }

    fn list(&self, items: impl Iterator<Item = String>) -> String {
        let [begin, end, between, _] = self.marks;
        format!("{begin}{}{end}", items.collect::<Vec<_>>().join(between))
    }
}

/// Returns the well-known text of a geometry, with at most `digits` digits after the point.
pub(super) fn well_known(geometry: &Geometry, digits: i32) -> String {
    let form = Form { marks: ["(", ")", ",", " "], heights: geometry.has_heights(), digits };
    let mut text = String::new();
    write_text(geometry, &form, &mut text);
    text
}

fn write_text(geometry: &Geometry, form: &Form, text: &mut String) {
    text.push_str(geometry.kind().wkt());
    if form.heights {
        text.push_str(" Z ");
    }
    if geometry.is_empty() && count_members(geometry) == 0 || is_void(geometry) {
        text.push_str(if form.heights { "EMPTY" } else { " EMPTY" });
        return;
    }
    let line = |points: &[DVec3]| form.list(points.iter().map(|at| form.point(at)));
    let polygon = |rings: &Rings| form.list(rings.iter().map(|ring| line(&close_ring(ring))));
    text.push_str(&match geometry {
        Geometry::Point(point) => form.list(point.iter().map(|at| form.point(at))),
        Geometry::Line(points) => line(points),
        Geometry::Polygon(rings) => polygon(rings),
        Geometry::MultiPoint(points) => {
            form.list(points.iter().map(|at| form.list(std::iter::once(form.point(at)))))
        }
        Geometry::MultiLine(lines) => form.list(lines.iter().map(|points| line(points))),
        Geometry::MultiPolygon(polygons) => form.list(polygons.iter().map(polygon)),
        Geometry::Collection(members) => form.list(members.iter().map(|member| {
            let mut text = String::new();
            write_text(member, form, &mut text);
            text
        })),
    });
}

/// Reports whether a geometry is a single one without points.
fn is_void(geometry: &Geometry) -> bool {
    matches!(geometry, Geometry::Point(_) | Geometry::Line(_) | Geometry::Polygon(_)) && geometry.is_empty()
}

fn close_ring(ring: &[DVec3]) -> Vec<DVec3> {
    ring.iter().chain(ring.first()).copied().collect()
}

/// Returns the GeoJSON of a geometry in the reference system with a code, or 0 if there is none.
pub(super) fn geojson(geometry: &Geometry, digits: i32, code: u32) -> String {
    let form = Form { marks: ["[", "]", ",", ","], heights: geometry.has_heights(), digits };
    let mut text = String::new();
    write_json(geometry, &form, code, &mut text);
    text
}

fn write_json(geometry: &Geometry, form: &Form, code: u32, text: &mut String) {
    let name = geometry.kind().geojson();
    let _ = write!(text, "{{\"type\":\"{name}\",");
    // GeoJSON has longitude and latitude by default.
    if !matches!(code, 0 | 4326) {
        let _ = write!(text, "\"crs\":{{\"type\":\"name\",\"properties\":{{\"name\":\"EPSG:{code}\"}}}},");
    }
    let point = |at: &DVec3| form.list(std::iter::once(form.point(at)));
    let line = |points: &[DVec3]| form.list(points.iter().map(point));
    let polygon = |rings: &Rings| form.list(rings.iter().map(|ring| line(&close_ring(ring))));
    if let Geometry::Collection(members) = geometry {
        let member = |member: &Geometry| {
            let mut text = String::new();
            write_json(member, form, 0, &mut text);
            text
        };
        let _ = write!(text, "\"geometries\":{}}}", form.list(members.iter().map(member)));
        return;
    }
    let places = match geometry {
        Geometry::Point(place) => place.as_ref().map_or_else(|| "[]".into(), point),
        Geometry::Line(points) => line(points),
        Geometry::MultiPoint(points) => form.list(points.iter().map(point)),
        Geometry::Polygon(rings) => polygon(rings),
        Geometry::MultiLine(lines) => form.list(lines.iter().map(|points| line(points))),
        Geometry::MultiPolygon(polygons) => form.list(polygons.iter().map(polygon)),
        Geometry::Collection(_) => String::new(),
    };
    let _ = write!(text, "\"coordinates\":{places}}}");
}
