//! Helpers for the parts of geometries.

use burgeon_spatial::{Geometry, union_all};
use glam::DVec3;

use super::call::{FunctionCall, FunctionResult};

/// Returns the position of a point argument, or `None` if it is empty. Fails for other geometries.
pub(super) fn place(call: &FunctionCall<'_>, index: usize) -> Result<Option<DVec3>, String> {
    match &call.geometry(index)?.geometry {
        Geometry::Point(place) => Ok(*place),
        other => Err(format!("argument {} must be a point, not a {}", index + 1, other.kind().name())),
    }
}

/// Returns the members of a geometry, or the geometry itself if it is a single one.
pub(super) fn members(geometry: Geometry) -> Vec<Geometry> {
    match geometry {
        Geometry::MultiPoint(points) => points.into_iter().map(Geometry::point).collect(),
        Geometry::MultiLine(lines) => lines.into_iter().map(Geometry::Line).collect(),
        Geometry::MultiPolygon(polygons) => polygons.into_iter().map(Geometry::Polygon).collect(),
        Geometry::Collection(members) => members,
        single => vec![single],
    }
}

/// Returns the number of members of a geometry; 1 for a single geometry.
pub(super) fn count_members(geometry: &Geometry) -> usize {
    match geometry {
        Geometry::MultiPoint(points) => points.len(),
        Geometry::MultiLine(lines) => lines.len(),
        Geometry::MultiPolygon(polygons) => polygons.len(),
        Geometry::Collection(members) => members.len(),
        _ => 1,
    }
}

/// Combines geometries: single ones of one type to a multi-geometry, others to a collection.
pub(super) fn collect(geometries: Vec<Geometry>) -> Geometry {
    let same = geometries.windows(2).all(|pair| pair[0].kind() == pair[1].kind());
    let single = |geometry: &Geometry| {
        matches!(geometry, Geometry::Point(Some(_)) | Geometry::Line(_) | Geometry::Polygon(_))
    };
    if !same || !geometries.iter().all(single) {
        return Geometry::Collection(geometries);
    }
    let (mut points, mut lines, mut polygons) = (Vec::new(), Vec::new(), Vec::new());
    for geometry in geometries {
        match geometry {
            Geometry::Point(point) => points.extend(point),
            Geometry::Line(line) => lines.push(line),
            Geometry::Polygon(polygon) => polygons.push(polygon),
            _ => {}
        }
    }
    if !points.is_empty() {
        Geometry::MultiPoint(points)
    } else if !lines.is_empty() {
        Geometry::MultiLine(lines)
    } else {
        Geometry::MultiPolygon(polygons)
    }
}

/// Combines single geometries, or returns the geometry itself if there is only one.
pub(super) fn collect_single(mut geometries: Vec<Geometry>) -> Geometry {
    match geometries.len() {
        1 => geometries.swap_remove(0),
        _ => collect(geometries),
    }
}

/// Returns the union of geometries. Fails with the reason.
#[allow(clippy::unnecessary_wraps, reason = "what is made of many may come to fail")]
pub(super) fn unite(geometries: &[Geometry]) -> Result<Geometry, String> {
    Ok(union_all(geometries))
}

/// Returns a ring as a closed line.
pub(super) fn closed_line(ring: &[DVec3]) -> Geometry {
    Geometry::Line(ring.iter().chain(ring.first()).copied().collect())
}

pub(super) fn check_geometry(geometry: Geometry) -> Result<FunctionResult, String> {
    geometry.check().map_err(|error| error.into_message())?;
    Ok(FunctionResult::Geometry(geometry))
}
