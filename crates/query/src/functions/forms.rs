//! Where geometries come from, and the forms in which they go out.

use burgeon_geometry::Rings;
use burgeon_spatial::{Geometry, wkb};
use glam::DVec3;

use super::parts::sound;
use super::table::{ONE, function};
use super::{FunctionCall, FunctionResult, SpatialFunction};

/// Where geometries come from, and what is read of them.
pub(super) const FORMS: &[SpatialFunction] = &[
    function("ST_MakePoint", (2, 3), "(east, north [, up])", "geometry", "A point.", point),
    function("ST_Point", (2, 3), "(east, north [, srid])", "geometry", "A point.", |call| {
        sound(Geometry::point(DVec3::new(call.number(0)?, call.number(1)?, 0.0)))
    }),
    function(
        "ST_MakeLine",
        (2, 2),
        "(geometry, geometry)",
        "geometry",
        "A line along the points of both.",
        |call| {
            let (a, b) = (call.geometry(0)?, call.geometry(1)?);
            let points: Vec<DVec3> = a.geometry.points().chain(b.geometry.points()).copied().collect();
            Ok(Geometry::line(points).map_or(FunctionResult::Nothing, FunctionResult::Geometry))
        },
    ),
    function("ST_MakePolygon", (1, 1), "(line)", "geometry", "The area that a closed line bounds.", |call| {
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
            let ring = [[west, south], [west, north], [east, north], [east, south]]
                .map(|[x, y]| DVec3::new(x, y, 0.0));
            sound(Geometry::Polygon(Rings(vec![ring.to_vec()])))
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
            read.map(FunctionResult::Geometry).map_err(|error| error.message().to_owned())
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
            sound(geometry)
        },
    ),
    function(
        "ST_SetSRID",
        (2, 2),
        "(geometry, srid)",
        "geometry",
        "The same: all tables share one coordinate system here.",
        |call| Ok(FunctionResult::Geometry(call.geometry(0)?.geometry.clone())),
    ),
    function("ST_AsText", (1, 1), ONE, "text", "Its well-known text.", |call| {
        Ok(FunctionResult::Text(call.geometry(0)?.geometry.to_wkt()))
    }),
    function("ST_AsBinary", (1, 1), ONE, "bytes", "Its well-known binary.", |call| {
        Ok(FunctionResult::Bytes(call.geometry(0)?.geometry.to_wkb()))
    }),
];

fn point(call: &FunctionCall<'_>) -> Result<FunctionResult, String> {
    sound(Geometry::point(DVec3::new(call.number(0)?, call.number(1)?, call.number_or(2, 0.0)?)))
}
