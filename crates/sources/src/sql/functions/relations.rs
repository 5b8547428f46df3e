//! Relations between two geometries: predicates and distances.

use std::f64::consts::TAU;

use burgeon_spatial::Geometry;
use geo::Intersects;

use super::call::{FunctionCall, FunctionResult};
use super::parts::place;
use super::spatial_function::{PAIR, SpatialFunction, function};

/// Implements a predicate of two geometries that is false if their boxes do not intersect.
macro_rules! meeting {
    ($method:ident) => {
        |call| {
            if !boxes_meet(call)? {
                return Ok(FunctionResult::Boolean(false));
            }
            Ok(FunctionResult::Boolean(
                call.geometry(0)?.prepared_geometry().$method(call.geometry(1)?.prepared_geometry()),
            ))
        }
    };
}

/// Relations between two geometries.
pub(super) const RELATIONS: &[SpatialFunction] = &[
    function("ST_Intersects", (2, 2), PAIR, "boolean", "True if the geometries share a point.", |call| {
        if !boxes_meet(call)? {
            return Ok(FunctionResult::Boolean(false));
        }
        let (a, b) = (call.geometry(0)?, call.geometry(1)?);
        Ok(FunctionResult::Boolean(
            !a.geometry.is_empty() && !b.geometry.is_empty() && a.flat().intersects(b.flat()),
        ))
    }),
    function("ST_Disjoint", (2, 2), PAIR, "boolean", "True if the geometries share no point.", |call| {
        Ok(FunctionResult::Boolean(
            !boxes_meet(call)? || call.geometry(0)?.geometry.disjoint(&call.geometry(1)?.geometry),
        ))
    }),
    function(
        "ST_DWithin",
        (3, 3),
        "(geometry, geometry, distance)",
        "boolean",
        "True if the distance between the geometries is at most `distance`.",
        |call| {
            let most = call.number(2)?;
            if let (Some(a), Some(b)) = (call.bounds(0)?, call.bounds(1)?)
                && box_distance(a, b) > most + 1e-9 * (1.0 + most.abs())
            {
                return Ok(FunctionResult::Boolean(false));
            }
            let distance = call.geometry(0)?.geometry.distance(&call.geometry(1)?.geometry);
            Ok(FunctionResult::Boolean(distance.is_some_and(|distance| distance <= most)))
        },
    ),
    function(
        "ST_Contains",
        (2, 2),
        PAIR,
        "boolean",
        "True if the first contains the second, and the second is not only on its boundary.",
        meeting!(contains),
    ),
    function(
        "ST_Within",
        (2, 2),
        PAIR,
        "boolean",
        "True if the second contains the first, and the first is not only on its boundary.",
        meeting!(within),
    ),
    function(
        "ST_Covers",
        (2, 2),
        PAIR,
        "boolean",
        "True if no point of the second is outside the first.",
        meeting!(covers),
    ),
    function(
        "ST_CoveredBy",
        (2, 2),
        PAIR,
        "boolean",
        "True if no point of the first is outside the second.",
        meeting!(covered_by),
    ),
    function(
        "ST_Touches",
        (2, 2),
        PAIR,
        "boolean",
        "True if the geometries share only boundary points.",
        meeting!(touches),
    ),
    function(
        "ST_Crosses",
        (2, 2),
        PAIR,
        "boolean",
        "True if they share some, but not all, interior points, of a lower dimension.",
        meeting!(crosses),
    ),
    function(
        "ST_Overlaps",
        (2, 2),
        PAIR,
        "boolean",
        "True if they share some, but not all, points, of their own dimension.",
        meeting!(overlaps),
    ),
    function(
        "ST_Equals",
        (2, 2),
        PAIR,
        "boolean",
        "True if the geometries are the same set of points.",
        |call| {
            Ok(FunctionResult::Boolean(
                call.geometry(0)?.prepared_geometry().equals(call.geometry(1)?.prepared_geometry()),
            ))
        },
    ),
    function(
        "ST_Relate",
        (2, 3),
        "(geometry, geometry [, pattern])",
        "text or boolean",
        "The DE-9IM matrix of interiors, boundaries and exteriors, as nine characters; or true if it matches a pattern such as `F***1****`.",
        |call| {
            let relation =
                call.geometry(0)?.prepared_geometry().relate(call.geometry(1)?.prepared_geometry());
            if call.len() == 2 {
                return Ok(FunctionResult::Text(relation.text().to_owned()));
            }
            relation.matches(call.text(2)?).map(FunctionResult::Boolean).map_err(|error| error.into_message())
        },
    ),
    function(
        "geometry_overlaps",
        (2, 2),
        PAIR,
        "boolean",
        "True if the bounding boxes intersect: `a && b`.",
        |call| Ok(FunctionResult::Boolean(boxes_meet(call)?)),
    ),
    function(
        "geometry_same",
        (2, 2),
        PAIR,
        "boolean",
        "True if they have the same points in the same order: `a = b`.",
        |call| Ok(FunctionResult::Boolean(call.geometry(0)?.geometry == call.geometry(1)?.geometry)),
    ),
    function(
        "ST_Distance",
        (2, 2),
        PAIR,
        "number",
        "The distance between the geometries; same as `a <-> b`.",
        |call| Ok(call.geometry(0)?.geometry.distance(&call.geometry(1)?.geometry).into()),
    ),
    function(
        "ST_Azimuth",
        (2, 2),
        "(point, point)",
        "number",
        "The direction from the first to the second, clockwise from north (radians).",
        |call| {
            let (Some(a), Some(b)) = (place(call, 0)?, place(call, 1)?) else {
                return Ok(FunctionResult::Nothing);
            };
            let way = b - a;
            Ok(if way.x == 0.0 && way.y == 0.0 {
                FunctionResult::Nothing
            } else {
                FunctionResult::Number(way.x.atan2(way.y).rem_euclid(TAU))
            })
        },
    ),
    function(
        "ST_ClosestPoint",
        (2, 2),
        PAIR,
        "geometry",
        "The point of the first that is nearest to the second.",
        |call| {
            let (a, b) = (call.geometry(0)?, call.geometry(1)?);
            Ok(a.geometry.nearest_points(&b.geometry).map_or(FunctionResult::Nothing, |[point, _]| {
                FunctionResult::Geometry(Geometry::point(point))
            }))
        },
    ),
    function(
        "ST_ShortestLine",
        (2, 2),
        PAIR,
        "geometry",
        "The shortest line from the first to the second.",
        |call| {
            let (a, b) = (call.geometry(0)?, call.geometry(1)?);
            let points = a.geometry.nearest_points(&b.geometry);
            Ok(points.map_or(FunctionResult::Nothing, |points| {
                FunctionResult::Geometry(Geometry::Line(points.to_vec()))
            }))
        },
    ),
];

/// Returns the distance between two boxes.
fn box_distance(a: [f64; 4], b: [f64; 4]) -> f64 {
    let axis = |axis: usize| (b[axis] - a[axis + 2]).max(a[axis] - b[axis + 2]).max(0.0);
    axis(0).hypot(axis(1))
}

fn boxes_meet(call: &FunctionCall<'_>) -> Result<bool, String> {
    let (a, b) = (call.bounds(0)?, call.bounds(1)?);
    Ok(a.zip(b).is_some_and(|(a, b)| a[0] <= b[2] && b[0] <= a[2] && a[1] <= b[3] && b[1] <= a[3]))
}
