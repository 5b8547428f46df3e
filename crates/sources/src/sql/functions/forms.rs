//! Functions that create geometries, and functions that convert them to other formats.

use burgeon_spatial::{Crs, Geometry, Rings, wkb};
use glam::DVec3;

use super::call::{FunctionCall, FunctionResult};
use super::parts::check_geometry;
use super::spatial_function::{ONE, SpatialFunction, function};

/// Functions for creating and converting geometries.
pub(super) const FORMS: &[SpatialFunction] = &[
    function("ST_MakePoint", (2, 3), "(east, north [, up])", "geometry", "A point.", point),
    function("ST_Point", (2, 3), "(east, north [, srid])", "geometry", "A point.", |call| {
        place_in_system(call, 2, Geometry::point(DVec3::new(call.number(0)?, call.number(1)?, 0.0)))
    }),
    function(
        "ST_MakeLine",
        (2, 2),
        "(geometry, geometry)",
        "geometry",
        "A line along the points of both geometries.",
        |call| {
            let (a, b) = (call.geometry(0)?, call.geometry(1)?);
            let points: Vec<DVec3> = a.geometry.points().chain(b.geometry.points()).copied().collect();
            Ok(Geometry::line(points).map_or(FunctionResult::Nothing, FunctionResult::Geometry))
        },
    ),
    function("ST_MakePolygon", (1, 1), "(line)", "geometry", "The polygon inside a closed line.", |call| {
        let parsed = call.geometry(0)?;
        let Geometry::Line(points) = &parsed.geometry else { return Err("it takes a line".into()) };
        if points.first() != points.last() {
            return Err("the line must end where it begins".into());
        }
        Geometry::polygon(vec![points.clone()])
            .map(FunctionResult::Geometry)
            .ok_or_else(|| "the line needs at least three points".into())
    }),
    function(
        "ST_MakeEnvelope",
        (4, 5),
        "(west, south, east, north [, srid])",
        "geometry",
        "A rectangle.",
        |call| {
            let [west, south, east, north] =
                [call.number(0)?, call.number(1)?, call.number(2)?, call.number(3)?];
            let corners = [[west, south], [west, north], [east, north], [east, south]];
            let ring = corners.into_iter().map(|[x, y]| DVec3::new(x, y, 0.0)).collect();
            place_in_system(call, 4, Geometry::Polygon(Rings(vec![ring])))
        },
    ),
    function(
        "ST_GeomFromText",
        (1, 2),
        "(text [, srid])",
        "geometry",
        "The geometry of well-known text.",
        |call| {
            let read = Geometry::from_wkt_within(call.text(0)?, &call.budget());
            place_in_system(call, 1, read.map_err(|error| error.into_message())?)
        },
    ),
    function(
        "ST_GeomFromWKB",
        (1, 2),
        "(bytes [, srid])",
        "geometry",
        "The geometry of well-known binary.",
        |call| {
            let geometry = wkb::read(call.bytes(0)?, 0.01, &call.budget())
                .map_err(|why| format!("well-known binary {why}"))?;
            place_in_system(call, 1, geometry)
        },
    ),
    function(
        "ST_SetSRID",
        (2, 2),
        "(geometry, srid)",
        "geometry",
        "The same coordinates in another reference system.",
        |call| place_in_system(call, 1, call.copy_geometry(0)?),
    ),
    function(
        "ST_SRID",
        (1, 1),
        ONE,
        "number",
        "The EPSG code of the reference system; 0 if it has none.",
        |call| {
            call.geometry(0)?;
            let own = call.state().frame.as_ref().and_then(|frame| frame.epsg).map_or(0, u32::from);
            Ok(FunctionResult::Count(call.foreign(0).unwrap_or(own) as usize))
        },
    ),
    function(
        "ST_Transform",
        (2, 2),
        "(geometry, srid)",
        "geometry",
        "The geometry in the coordinates of another reference system, by its EPSG code.",
        |call| {
            let (geometry, from) = (call.geometry(0)?, call.foreign(0));
            let Some(frame) = &call.state().frame else {
                return Err("the tables have no reference system".into());
            };
            let to = code(call, 1)?;
            let made = crate::sql::place::transform(&geometry.geometry, from, to, frame);
            made.map(|made| FunctionResult::Placed(made, to)).map_err(|error| error.into_message())
        },
    ),
    function(
        "ST_AsText",
        (1, 2),
        "(geometry [, digits])",
        "text",
        "The well-known text, with at most `digits` decimals, 15 unless given.",
        |call| {
            Ok(FunctionResult::Text(super::text::well_known(&call.geometry(0)?.geometry, digits(call, 15)?)))
        },
    ),
    function(
        "ST_AsGeoJSON",
        (1, 2),
        "(geometry [, digits])",
        "text",
        "The GeoJSON, with at most `digits` decimals, 9 unless given.",
        |call| {
            let own = call.state().frame.as_ref().and_then(|frame| frame.epsg).map_or(0, u32::from);
            let code = call.foreign(0).unwrap_or(own);
            Ok(FunctionResult::Text(super::text::geojson(
                &call.geometry(0)?.geometry,
                digits(call, 9)?,
                code,
            )))
        },
    ),
    function(
        "GeometryType",
        (1, 1),
        ONE,
        "text",
        "The type of the geometry in capital letters, such as `POLYGON`.",
        |call| Ok(FunctionResult::Text(call.geometry(0)?.geometry.kind().wkt().to_owned())),
    ),
    function("ST_AsBinary", (1, 1), ONE, "bytes", "The well-known binary.", |call| {
        Ok(FunctionResult::Bytes(call.geometry(0)?.geometry.to_wkb()))
    }),
];

fn point(call: &FunctionCall<'_>) -> Result<FunctionResult, String> {
    check_geometry(Geometry::point(DVec3::new(call.number(0)?, call.number(1)?, call.number_or(2, 0.0)?)))
}

/// Returns a geometry in the reference system of argument `index`, if there is such an argument.
fn place_in_system(
    call: &FunctionCall<'_>,
    index: usize,
    geometry: Geometry,
) -> Result<FunctionResult, String> {
    geometry.check().map_err(|error| error.into_message())?;
    let own = if index < call.len() { code(call, index)? } else { call.foreign(0) };
    Ok(FunctionResult::Placed(geometry, own))
}

/// Reads an EPSG code. Returns `None` if it is the run's or 0, or if the run has no projection.
fn code(call: &FunctionCall<'_>, index: usize) -> Result<Option<u32>, String> {
    let number = call.number(index)?;
    if number.fract() != 0.0 || !(0.0..1e6).contains(&number) {
        return Err(format!("argument {} must be a code of EPSG's, not {number}", index + 1));
    }
    let Some(frame) = &call.state().frame else { return Ok(None) };
    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "the range is checked")]
    let code = number as u32;
    if code == 0 || frame.epsg.is_some_and(|own| u32::from(own) == code) {
        return Ok(None);
    }
    Crs::epsg(code).map_err(|error| error.into_message())?;
    Ok(Some(code))
}

/// Returns the number of digits after the point in the second argument, or `other`.
fn digits(call: &FunctionCall<'_>, other: i32) -> Result<i32, String> {
    let number = call.number_or(1, f64::from(other))?;
    #[allow(clippy::cast_possible_truncation, reason = "it is small then")]
    Ok(number.clamp(0.0, 40.0) as i32)
}
