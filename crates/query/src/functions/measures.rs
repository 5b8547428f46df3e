//! Functions that measure and describe geometries.

use burgeon_geometry::Rings;
use burgeon_spatial::Geometry;
use glam::DVec3;

use super::call::{FunctionCall, FunctionResult};
use super::parts::{members, place};
use super::spatial_function::{ONE, SpatialFunction, function};

/// Returns one of the four bounds.
macro_rules! bound {
    ($index:literal) => {
        |call| Ok(call.bounds(0)?.map(|bounds| bounds[$index]).into())
    };
}

/// Functions that measure and describe geometries.
pub(super) const MEASURES: &[SpatialFunction] = &[
    function("ST_Area", (1, 1), ONE, "number", "The area of polygons; 0 of all else.", |call| {
        Ok(FunctionResult::Number(call.geometry(0)?.geometry.area()))
    }),
    function("ST_Length", (1, 1), ONE, "number", "The length of lines; 0 of all else.", |call| {
        Ok(FunctionResult::Number(call.geometry(0)?.geometry.length()))
    }),
    function(
        "ST_Perimeter",
        (1, 1),
        ONE,
        "number",
        "The length of the borders of polygons; 0 of all else.",
        |call| Ok(FunctionResult::Number(call.geometry(0)?.geometry.perimeter())),
    ),
    function("ST_X", (1, 1), "(point)", "number", "How far east a point is.", |call| {
        Ok(place(call, 0)?.map(|at| at.x).into())
    }),
    function("ST_Y", (1, 1), "(point)", "number", "How far north a point is.", |call| {
        Ok(place(call, 0)?.map(|at| at.y).into())
    }),
    function("ST_Z", (1, 1), "(point)", "number", "How high a point is; NULL if it has no height.", |call| {
        Ok(place(call, 0)?.map(|at| at.z).filter(|z| *z != 0.0).into())
    }),
    function("ST_XMin", (1, 1), ONE, "number", "The least coordinate east.", bound!(0)),
    function("ST_YMin", (1, 1), ONE, "number", "The least coordinate north.", bound!(1)),
    function("ST_XMax", (1, 1), ONE, "number", "The greatest coordinate east.", bound!(2)),
    function("ST_YMax", (1, 1), ONE, "number", "The greatest coordinate north.", bound!(3)),
    function("ST_ZMin", (1, 1), ONE, "number", "The least height; NULL if it has no heights.", |call| {
        Ok(heights(call)?.map(|heights| heights[0]).into())
    }),
    function("ST_ZMax", (1, 1), ONE, "number", "The greatest height; NULL if it has no heights.", |call| {
        Ok(heights(call)?.map(|heights| heights[1]).into())
    }),
    function("ST_MinX", (1, 1), ONE, "number", "As ST_XMin, by its name in GeoPackages.", bound!(0)),
    function("ST_MinY", (1, 1), ONE, "number", "As ST_YMin, by its name in GeoPackages.", bound!(1)),
    function("ST_MaxX", (1, 1), ONE, "number", "As ST_XMax, by its name in GeoPackages.", bound!(2)),
    function("ST_MaxY", (1, 1), ONE, "number", "As ST_YMax, by its name in GeoPackages.", bound!(3)),
    function(
        "ST_NPoints",
        (1, 1),
        ONE,
        "number",
        "How many points it has; those of a ring count its end, too.",
        |call| Ok(FunctionResult::Count(count_points(&call.geometry(0)?.geometry))),
    ),
    function(
        "ST_NumPoints",
        (1, 1),
        "(line)",
        "number",
        "How many points a line has; NULL of all else.",
        |call| {
            Ok(match &call.geometry(0)?.geometry {
                Geometry::Line(points) => FunctionResult::Count(points.len()),
                _ => FunctionResult::Nothing,
            })
        },
    ),
    function(
        "ST_NumGeometries",
        (1, 1),
        ONE,
        "number",
        "How many geometries a collection has; 1 of a single one.",
        |call| {
            let geometry = &call.geometry(0)?.geometry;
            Ok(FunctionResult::Count(match geometry {
                Geometry::MultiPoint(_)
                | Geometry::MultiLine(_)
                | Geometry::MultiPolygon(_)
                | Geometry::Collection(_) => members(geometry).len(),
                single => usize::from(!single.is_empty()),
            }))
        },
    ),
    function(
        "ST_NumInteriorRings",
        (1, 1),
        "(polygon)",
        "number",
        "How many holes a polygon has; NULL of all else.",
        |call| {
            Ok(match &call.geometry(0)?.geometry {
                Geometry::Polygon(rings) => FunctionResult::Count(rings.len().saturating_sub(1)),
                _ => FunctionResult::Nothing,
            })
        },
    ),
    function("ST_Dimension", (1, 1), ONE, "number", "0 of points, 1 of lines, 2 of polygons.", |call| {
        Ok(FunctionResult::Count(call.geometry(0)?.geometry.dimension()))
    }),
    function("ST_GeometryType", (1, 1), ONE, "text", "Its kind, such as `ST_Polygon`.", |call| {
        Ok(FunctionResult::Text(kind(&call.geometry(0)?.geometry).to_owned()))
    }),
    function(
        "ST_IsValid",
        (1, 1),
        ONE,
        "boolean",
        "Whether its rings neither cross nor overlap, and holes lie inside.",
        |call| Ok(FunctionResult::Boolean(call.geometry(0)?.geometry.is_valid())),
    ),
    function("ST_IsEmpty", (1, 1), ONE, "boolean", "Whether it has no points.", |call| {
        Ok(FunctionResult::Boolean(call.geometry(0)?.geometry.is_empty()))
    }),
    function(
        "ST_IsClosed",
        (1, 1),
        ONE,
        "boolean",
        "Whether a line ends where it begins; true of points and polygons.",
        |call| {
            let closed = |line: &[DVec3]| line.first() == line.last();
            Ok(FunctionResult::Boolean(match &call.geometry(0)?.geometry {
                Geometry::Line(line) => !line.is_empty() && closed(line),
                Geometry::MultiLine(lines) => !lines.is_empty() && lines.iter().all(|line| closed(line)),
                other => !other.is_empty(),
            }))
        },
    ),
];

/// Returns the minimum and the maximum height, if there are heights.
fn heights(call: &FunctionCall<'_>) -> Result<Option<[f64; 2]>, String> {
    let parsed = call.geometry(0)?;
    let all = || parsed.geometry.points().map(|point| point.z);
    Ok(parsed
        .geometry
        .has_heights()
        .then(|| [all().fold(f64::INFINITY, f64::min), all().fold(f64::NEG_INFINITY, f64::max)]))
}

fn count_points(geometry: &Geometry) -> usize {
    let rings = |rings: &Rings| rings.iter().map(|ring| ring.len() + 1).sum::<usize>();
    match geometry {
        Geometry::Polygon(polygon) => rings(polygon),
        Geometry::MultiPolygon(polygons) => polygons.iter().map(rings).sum(),
        Geometry::Collection(members) => members.iter().map(count_points).sum(),
        other => other.points().count(),
    }
}

fn kind(geometry: &Geometry) -> &'static str {
    match geometry {
        Geometry::Point(_) => "ST_Point",
        Geometry::Line(_) => "ST_LineString",
        Geometry::Polygon(_) => "ST_Polygon",
        Geometry::MultiPoint(_) => "ST_MultiPoint",
        Geometry::MultiLine(_) => "ST_MultiLineString",
        Geometry::MultiPolygon(_) => "ST_MultiPolygon",
        Geometry::Collection(_) => "ST_GeometryCollection",
    }
}
