//! Functions that measure and describe geometries.

use burgeon_spatial::{Geometry, Rings};
use glam::DVec3;

use super::call::{FunctionCall, FunctionResult};
use super::parts::{count_members, place};
use super::spatial_function::{ONE, SpatialFunction, function};

/// Returns one of the four bounds.
macro_rules! bound {
    ($index:literal) => {
        |call| Ok(call.bounds(0)?.map(|bounds| bounds[$index]).into())
    };
}

/// Functions that measure and describe geometries.
pub(super) const MEASURES: &[SpatialFunction] = &[
    function("ST_Area", (1, 1), ONE, "number", "The area of polygons; 0 for other geometries.", |call| {
        Ok(FunctionResult::Number(call.geometry(0)?.geometry.area()))
    }),
    function("ST_Length", (1, 1), ONE, "number", "The length of lines; 0 for other geometries.", |call| {
        Ok(FunctionResult::Number(call.geometry(0)?.geometry.length()))
    }),
    function(
        "ST_Perimeter",
        (1, 1),
        ONE,
        "number",
        "The length of the boundaries of polygons; 0 for other geometries.",
        |call| Ok(FunctionResult::Number(call.geometry(0)?.geometry.perimeter())),
    ),
    function("ST_X", (1, 1), "(point)", "number", "The x coordinate (east).", |call| {
        Ok(place(call, 0)?.map(|at| at.x).into())
    }),
    function("ST_Y", (1, 1), "(point)", "number", "The y coordinate (north).", |call| {
        Ok(place(call, 0)?.map(|at| at.y).into())
    }),
    function("ST_Z", (1, 1), "(point)", "number", "The height; NULL if the point has no height.", |call| {
        Ok(place(call, 0)?.map(|at| at.z).filter(|z| *z != 0.0).into())
    }),
    function("ST_XMin", (1, 1), ONE, "number", "The minimum x coordinate (east).", bound!(0)),
    function("ST_YMin", (1, 1), ONE, "number", "The minimum y coordinate (north).", bound!(1)),
    function("ST_XMax", (1, 1), ONE, "number", "The maximum x coordinate (east).", bound!(2)),
    function("ST_YMax", (1, 1), ONE, "number", "The maximum y coordinate (north).", bound!(3)),
    function("ST_ZMin", (1, 1), ONE, "number", "The minimum height; NULL if there are no heights.", |call| {
        Ok(heights(call)?.map(|heights| heights[0]).into())
    }),
    function("ST_ZMax", (1, 1), ONE, "number", "The maximum height; NULL if there are no heights.", |call| {
        Ok(heights(call)?.map(|heights| heights[1]).into())
    }),
    function("ST_MinX", (1, 1), ONE, "number", "Same as ST_XMin, by its name in GeoPackages.", bound!(0)),
    function("ST_MinY", (1, 1), ONE, "number", "Same as ST_YMin, by its name in GeoPackages.", bound!(1)),
    function("ST_MaxX", (1, 1), ONE, "number", "Same as ST_XMax, by its name in GeoPackages.", bound!(2)),
    function("ST_MaxY", (1, 1), ONE, "number", "Same as ST_YMax, by its name in GeoPackages.", bound!(3)),
    function(
        "ST_NPoints",
        (1, 1),
        ONE,
        "number",
        "The number of points; the end of a ring counts too.",
        |call| Ok(FunctionResult::Count(count_points(&call.geometry(0)?.geometry))),
    ),
    function(
        "ST_NumPoints",
        (1, 1),
        "(line)",
        "number",
        "The number of points of a line; NULL for other geometries.",
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
        "The number of geometries of a collection; 1 for a single geometry.",
        |call| {
            let geometry = &call.geometry(0)?.geometry;
            Ok(FunctionResult::Count(match geometry {
                Geometry::MultiPoint(_)
                | Geometry::MultiLine(_)
                | Geometry::MultiPolygon(_)
                | Geometry::Collection(_) => count_members(geometry),
                single => usize::from(!single.is_empty()),
            }))
        },
    ),
    function(
        "ST_NumInteriorRings",
        (1, 1),
        "(polygon)",
        "number",
        "The number of holes of a polygon; NULL for other geometries.",
        |call| {
            Ok(match &call.geometry(0)?.geometry {
                Geometry::Polygon(rings) => FunctionResult::Count(rings.len().saturating_sub(1)),
                _ => FunctionResult::Nothing,
            })
        },
    ),
    function("ST_Dimension", (1, 1), ONE, "number", "0 for points, 1 for lines, 2 for polygons.", |call| {
        Ok(FunctionResult::Count(call.geometry(0)?.geometry.dimension()))
    }),
    function(
        "ST_GeometryType",
        (1, 1),
        ONE,
        "text",
        "The type of the geometry, such as `ST_Polygon`.",
        |call| Ok(FunctionResult::Text(kind(&call.geometry(0)?.geometry).to_owned())),
    ),
    function(
        "ST_IsValid",
        (1, 1),
        ONE,
        "boolean",
        "True if rings neither cross nor overlap, and holes are inside.",
        |call| Ok(FunctionResult::Boolean(call.geometry(0)?.geometry.is_valid())),
    ),
    function("ST_IsEmpty", (1, 1), ONE, "boolean", "True if the geometry has no points.", |call| {
        Ok(FunctionResult::Boolean(call.geometry(0)?.geometry.is_empty()))
    }),
    function(
        "ST_IsClosed",
        (1, 1),
        ONE,
        "boolean",
        "True if a line ends at its start; also true for points and polygons.",
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
