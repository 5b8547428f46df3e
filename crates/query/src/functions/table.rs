//! The functions, in the order of the book's page.

use std::f64::consts::TAU;

use burgeon_geometry::Rings;
use burgeon_spatial::{BufferCap, BufferJoin, BufferOptions, Geometry, union_all, wkb};
use geo::{Intersects, LineLocatePoint};
use glam::DVec3;

use super::{FunctionCall, FunctionResult};

/// A function that statements may call.
#[derive(Debug)]
pub struct SpatialFunction {
    /// Its name; letters may be small or large.
    pub name: &'static str,
    /// What it takes.
    pub takes: &'static str,
    /// What it gives.
    pub gives: &'static str,
    /// What it does.
    pub doc: &'static str,
    /// The least number of arguments.
    pub(crate) least: u8,
    /// The greatest.
    pub(crate) most: u8,
    pub(crate) run: fn(&FunctionCall<'_>) -> Result<FunctionResult, String>,
}

impl std::fmt::Debug for FunctionCall<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str("FunctionCall")
    }
}

type FunctionBody = fn(&FunctionCall<'_>) -> Result<FunctionResult, String>;

const fn function(
    name: &'static str,
    (least, most): (u8, u8),
    takes: &'static str,
    gives: &'static str,
    doc: &'static str,
    run: FunctionBody,
) -> SpatialFunction {
    SpatialFunction { name, takes, gives, doc, least, most, run }
}

const PAIR: &str = "(geometry, geometry)";
const ONE: &str = "(geometry)";

/// A predicate of two geometries that fails where their boxes do not meet.
macro_rules! meeting {
    ($method:ident) => {
        |call| {
            if !boxes_meet(call)? {
                return Ok(FunctionResult::Boolean(false));
            }
            Ok(FunctionResult::Boolean(call.geometry(0)?.prepared().$method(call.geometry(1)?.prepared())))
        }
    };
}

/// A geometry made of one.
macro_rules! made {
    ($method:ident) => {
        |call| Ok(FunctionResult::Geometry(call.geometry(0)?.geometry.$method()))
    };
}

/// A geometry made of two.
macro_rules! made_of_two {
    ($method:ident) => {
        |call| Ok(FunctionResult::Geometry(call.geometry(0)?.geometry.$method(&call.geometry(1)?.geometry)))
    };
}

/// One of the four bounds.
macro_rules! bound {
    ($index:literal) => {
        |call| Ok(call.bounds(0)?.map(|bounds| bounds[$index]).into())
    };
}

/// All functions of geometries.
pub static FUNCTIONS: &[SpatialFunction] = &[
    // What is asked of two.
    function("ST_Intersects", (2, 2), PAIR, "boolean", "Whether they share a point.", |call| {
        if !boxes_meet(call)? {
            return Ok(FunctionResult::Boolean(false));
        }
        let (a, b) = (call.geometry(0)?, call.geometry(1)?);
        Ok(FunctionResult::Boolean(
            !a.geometry.is_empty() && !b.geometry.is_empty() && a.flat().intersects(b.flat()),
        ))
    }),
    function("ST_Disjoint", (2, 2), PAIR, "boolean", "Whether they share no point.", |call| {
        Ok(FunctionResult::Boolean(
            !boxes_meet(call)? || call.geometry(0)?.geometry.disjoint(&call.geometry(1)?.geometry),
        ))
    }),
    function(
        "ST_DWithin",
        (3, 3),
        "(geometry, geometry, distance)",
        "boolean",
        "Whether they are at most so far from each other.",
        |call| {
            let most = call.number(2)?;
            if let (Some(a), Some(b)) = (call.bounds(0)?, call.bounds(1)?)
                && apart(a, b) > most + 1e-9 * (1.0 + most.abs())
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
        "Whether the second lies in the first, and not on its border alone.",
        meeting!(contains),
    ),
    function(
        "ST_Within",
        (2, 2),
        PAIR,
        "boolean",
        "Whether the first lies in the second, and not on its border alone.",
        meeting!(within),
    ),
    function(
        "ST_Covers",
        (2, 2),
        PAIR,
        "boolean",
        "Whether no point of the second lies outside the first.",
        meeting!(covers),
    ),
    function(
        "ST_CoveredBy",
        (2, 2),
        PAIR,
        "boolean",
        "Whether no point of the first lies outside the second.",
        meeting!(covered_by),
    ),
    function(
        "ST_Touches",
        (2, 2),
        PAIR,
        "boolean",
        "Whether they share points of their borders alone.",
        meeting!(touches),
    ),
    function(
        "ST_Crosses",
        (2, 2),
        PAIR,
        "boolean",
        "Whether they share some, but not all, inner points, and those are of a lower dimension.",
        meeting!(crosses),
    ),
    function(
        "ST_Overlaps",
        (2, 2),
        PAIR,
        "boolean",
        "Whether they share some, but not all, points, of their own dimension.",
        meeting!(overlaps),
    ),
    function("ST_Equals", (2, 2), PAIR, "boolean", "Whether they are the same set of points.", |call| {
        Ok(FunctionResult::Boolean(call.geometry(0)?.prepared().equals(call.geometry(1)?.prepared())))
    }),
    function(
        "ST_Relate",
        (2, 3),
        "(geometry, geometry [, pattern])",
        "text or boolean",
        "How insides, borders and outsides meet, as nine letters (DE-9IM); or whether that fits a pattern such as `F***1****`.",
        |call| {
            let relation = call.geometry(0)?.prepared().relate(call.geometry(1)?.prepared());
            if call.len() == 2 {
                return Ok(FunctionResult::Text(relation.text().to_owned()));
            }
            relation
                .matches(call.text(2)?)
                .map(FunctionResult::Boolean)
                .map_err(|error| error.message().to_owned())
        },
    ),
    function("geometry_overlaps", (2, 2), PAIR, "boolean", "Whether their boxes meet: `a && b`.", |call| {
        Ok(FunctionResult::Boolean(boxes_meet(call)?))
    }),
    function(
        "ST_Distance",
        (2, 2),
        PAIR,
        "number",
        "How far they are from each other; `a <-> b` is the same.",
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
        "The line from the first to the second where they are nearest.",
        |call| {
            let (a, b) = (call.geometry(0)?, call.geometry(1)?);
            let points = a.geometry.nearest_points(&b.geometry);
            Ok(points.map_or(FunctionResult::Nothing, |points| {
                FunctionResult::Geometry(Geometry::Line(points.to_vec()))
            }))
        },
    ),
    // What is measured.
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
    // What is made of others.
    function(
        "ST_Buffer",
        (2, 3),
        "(geometry, distance [, options])",
        "geometry",
        "All that is at most so far away. Options are PostGIS's: the segments of a quarter of a circle, or a text such as `'endcap=flat join=mitre quad_segs=8'`.",
        |call| {
            let options = if call.len() == 3 { buffer_options(call)? } else { BufferOptions::default() };
            let made = call.geometry(0)?.geometry.buffer(call.number(1)?, &options);
            made.map(FunctionResult::Geometry).map_err(|error| error.message().to_owned())
        },
    ),
    function(
        "ST_OffsetCurve",
        (2, 3),
        "(line, distance [, options])",
        "geometry",
        "The line beside a line: to its left, or to its right where the distance is negative. Options are those of ST_Buffer.",
        |call| {
            let options = if call.len() == 3 { buffer_options(call)? } else { BufferOptions::default() };
            let (line, distance) = (call.geometry(0)?, call.number(1)?);
            if line.geometry.is_empty() || line.geometry.dimension() != 1 {
                return Err(call.wrong_geometry(0, "a line"));
            }
            let made = line.geometry.offset(distance, &options);
            made.map(FunctionResult::Geometry).map_err(|error| error.message().to_owned())
        },
    ),
    function("ST_Intersection", (2, 2), PAIR, "geometry", "What both have.", made_of_two!(intersection)),
    function(
        "ST_Union",
        (2, 2),
        PAIR,
        "geometry",
        "What either has; with one argument, what any of a group has.",
        made_of_two!(union),
    ),
    function(
        "ST_Difference",
        (2, 2),
        PAIR,
        "geometry",
        "What the first has and the second has not.",
        made_of_two!(difference),
    ),
    function(
        "ST_SymDifference",
        (2, 2),
        PAIR,
        "geometry",
        "What one of them has alone.",
        made_of_two!(sym_difference),
    ),
    function("ST_UnaryUnion", (1, 1), ONE, "geometry", "The union of its parts.", made!(dissolved)),
    function(
        "ST_Collect",
        (2, 2),
        PAIR,
        "geometry",
        "Both beside each other; with one argument, all of a group.",
        |call| {
            Ok(FunctionResult::Geometry(collected(vec![
                call.geometry(0)?.geometry.clone(),
                call.geometry(1)?.geometry.clone(),
            ])))
        },
    ),
    function("ST_Centroid", (1, 1), ONE, "geometry", "Its centre of mass.", made!(centroid)),
    function(
        "ST_PointOnSurface",
        (1, 1),
        ONE,
        "geometry",
        "A point that lies in it.",
        made!(point_on_surface),
    ),
    function("ST_Envelope", (1, 1), ONE, "geometry", "The box around it.", made!(envelope)),
    function(
        "ST_OrientedEnvelope",
        (1, 1),
        ONE,
        "geometry",
        "The smallest rectangle around it, turned as it must be.",
        made!(oriented_envelope),
    ),
    function(
        "ST_ConvexHull",
        (1, 1),
        ONE,
        "geometry",
        "The smallest convex area around it.",
        made!(convex_hull),
    ),
    function("ST_Boundary", (1, 1), ONE, "geometry", "The rings of polygons, the ends of lines.", |call| {
        Ok(FunctionResult::Geometry(boundary(&call.geometry(0)?.geometry)))
    }),
    function(
        "ST_ExteriorRing",
        (1, 1),
        "(polygon)",
        "geometry",
        "The outer ring of a polygon, as a line; NULL of all else.",
        |call| {
            Ok(match &call.geometry(0)?.geometry {
                Geometry::Polygon(rings) => rings
                    .first()
                    .map_or(FunctionResult::Nothing, |ring| FunctionResult::Geometry(closed(ring))),
                _ => FunctionResult::Nothing,
            })
        },
    ),
    function(
        "ST_InteriorRingN",
        (2, 2),
        "(polygon, number)",
        "geometry",
        "A hole of a polygon, as a line; they are counted from 1.",
        |call| {
            let number = nth(call, 1)?;
            Ok(match &call.geometry(0)?.geometry {
                Geometry::Polygon(rings) => number
                    .filter(|number| *number > 0)
                    .and_then(|number| rings.get(number))
                    .map_or(FunctionResult::Nothing, |ring| FunctionResult::Geometry(closed(ring))),
                _ => FunctionResult::Nothing,
            })
        },
    ),
    function(
        "ST_GeometryN",
        (2, 2),
        "(geometry, number)",
        "geometry",
        "A geometry of a collection; they are counted from 1.",
        |call| {
            let number = nth(call, 1)?.and_then(|number| number.checked_sub(1));
            let found =
                number.and_then(|number| members(&call.geometry(0).ok()?.geometry).into_iter().nth(number));
            Ok(found.map_or(FunctionResult::Nothing, FunctionResult::Geometry))
        },
    ),
    function(
        "ST_PointN",
        (2, 2),
        "(line, number)",
        "geometry",
        "A point of a line; they are counted from 1, and from -1 backwards.",
        |call| {
            let number = call.number(1)?;
            let Geometry::Line(points) = &call.geometry(0)?.geometry else {
                return Ok(FunctionResult::Nothing);
            };
            #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "it saturates")]
            let index = if number < 0.0 {
                points.len().checked_sub(-number as usize)
            } else {
                (number as usize).checked_sub(1)
            };
            Ok(index
                .and_then(|index| points.get(index))
                .map_or(FunctionResult::Nothing, |at| FunctionResult::Geometry(Geometry::point(*at))))
        },
    ),
    function(
        "ST_StartPoint",
        (1, 1),
        "(line)",
        "geometry",
        "The first point of a line; NULL of all else.",
        |call| Ok(end(&call.geometry(0)?.geometry, true)),
    ),
    function(
        "ST_EndPoint",
        (1, 1),
        "(line)",
        "geometry",
        "The last point of a line; NULL of all else.",
        |call| Ok(end(&call.geometry(0)?.geometry, false)),
    ),
    function(
        "ST_LineInterpolatePoint",
        (2, 2),
        "(line, part)",
        "geometry",
        "The point at a part of a line's length, 0 to 1.",
        |call| {
            let part = call.number(1)?;
            if !(0.0..=1.0).contains(&part) {
                return Err(format!("the part must be from 0 to 1, not {part}"));
            }
            let parsed = call.geometry(0)?;
            let Geometry::Line(points) = &parsed.geometry else { return Err("it takes a line".into()) };
            Ok(along(points, part)
                .map_or(FunctionResult::Nothing, |at| FunctionResult::Geometry(Geometry::point(at))))
        },
    ),
    function(
        "ST_LineLocatePoint",
        (2, 2),
        "(line, point)",
        "number",
        "At which part of a line's length, 0 to 1, it is nearest to a point.",
        |call| {
            let line = call.geometry(0)?;
            let (geo::Geometry::LineString(line), Some(at)) = (line.flat(), place(call, 1)?) else {
                return Err("it takes a line and a point".into());
            };
            Ok(line.line_locate_point(&geo::Point::new(at.x, at.y)).into())
        },
    ),
    function(
        "ST_LineSubstring",
        (3, 3),
        "(line, part, part)",
        "geometry",
        "What lies between two parts of a line's length, 0 to 1.",
        |call| {
            let (from, to) = (call.number(1)?, call.number(2)?);
            if !(0.0..=1.0).contains(&from) || !(from..=1.0).contains(&to) {
                return Err(format!(
                    "the parts must be from 0 to 1, the first before the second, not {from} and {to}"
                ));
            }
            let parsed = call.geometry(0)?;
            let Geometry::Line(points) = &parsed.geometry else { return Err("it takes a line".into()) };
            Ok(substring(points, from, to))
        },
    ),
    function(
        "ST_MakeValid",
        (1, 1),
        ONE,
        "geometry",
        "The valid geometry that is most like it; itself if it is valid.",
        made!(make_valid),
    ),
    function(
        "ST_Simplify",
        (2, 2),
        "(geometry, distance)",
        "geometry",
        "The same with fewer points; none that is left out was farther than this from what stays.",
        |call| {
            Ok(FunctionResult::Geometry(super::simple::simplified(
                &call.geometry(0)?.geometry,
                call.number(1)?,
            )))
        },
    ),
    function(
        "ST_Reverse",
        (1, 1),
        ONE,
        "geometry",
        "The same, with its points the other way round.",
        |call| {
            let mut geometry = call.geometry(0)?.geometry.clone();
            reverse(&mut geometry);
            Ok(FunctionResult::Geometry(geometry))
        },
    ),
    function(
        "ST_Translate",
        (3, 4),
        "(geometry, east, north [, up])",
        "geometry",
        "The same, moved.",
        |call| {
            let by = DVec3::new(call.number(1)?, call.number(2)?, call.number_or(3, 0.0)?);
            let mut geometry = call.geometry(0)?.geometry.clone();
            geometry.points_mut().for_each(|point| *point += by);
            sound(geometry)
        },
    ),
    function("ST_Force2D", (1, 1), ONE, "geometry", "The same without heights.", |call| {
        let mut geometry = call.geometry(0)?.geometry.clone();
        geometry.points_mut().for_each(|point| point.z = 0.0);
        Ok(FunctionResult::Geometry(geometry))
    }),
    function("ST_Multi", (1, 1), ONE, "geometry", "The same as a multi form.", |call| {
        Ok(FunctionResult::Geometry(match call.geometry(0)?.geometry.clone() {
            Geometry::Point(point) => Geometry::MultiPoint(point.into_iter().collect()),
            Geometry::Line(line) => {
                Geometry::MultiLine(Some(line).into_iter().filter(|line| !line.is_empty()).collect())
            }
            Geometry::Polygon(rings) => {
                Geometry::MultiPolygon(Some(rings).into_iter().filter(|rings| !rings.is_empty()).collect())
            }
            other => other,
        }))
    }),
    // Where geometries come from, and what is read of them.
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

fn sound(geometry: Geometry) -> Result<FunctionResult, String> {
    geometry.check().map_err(|error| error.message().to_owned())?;
    Ok(FunctionResult::Geometry(geometry))
}

/// How far two boxes are from each other.
fn apart(a: [f64; 4], b: [f64; 4]) -> f64 {
    let axis = |axis: usize| (b[axis] - a[axis + 2]).max(a[axis] - b[axis + 2]).max(0.0);
    axis(0).hypot(axis(1))
}

fn boxes_meet(call: &FunctionCall<'_>) -> Result<bool, String> {
    let (a, b) = (call.bounds(0)?, call.bounds(1)?);
    Ok(a.zip(b).is_some_and(|(a, b)| a[0] <= b[2] && b[0] <= a[2] && a[1] <= b[3] && b[1] <= a[3]))
}

/// The place of a point; nothing of an empty one. Fails for all else.
fn place(call: &FunctionCall<'_>, index: usize) -> Result<Option<DVec3>, String> {
    match &call.geometry(index)?.geometry {
        Geometry::Point(place) => Ok(*place),
        other => Err(format!("argument {} must be a point, not a {}", index + 1, other.kind().name())),
    }
}

/// The least and the greatest height, if there are heights.
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

/// Its own geometries; itself if it is a single one.
fn members(geometry: &Geometry) -> Vec<Geometry> {
    match geometry {
        Geometry::MultiPoint(points) => points.iter().map(|at| Geometry::point(*at)).collect(),
        Geometry::MultiLine(lines) => lines.iter().cloned().map(Geometry::Line).collect(),
        Geometry::MultiPolygon(polygons) => polygons.iter().cloned().map(Geometry::Polygon).collect(),
        Geometry::Collection(members) => members.clone(),
        single => vec![single.clone()],
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

/// Geometries beside each other: single ones of one kind as a multi form, others as a collection.
pub(super) fn collected(geometries: Vec<Geometry>) -> Geometry {
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

/// The union of geometries. Fails with the reason.
#[allow(clippy::unnecessary_wraps, reason = "what is made of many may come to fail")]
pub(super) fn united(geometries: &[Geometry]) -> Result<Geometry, String> {
    Ok(union_all(geometries))
}

/// A ring as a line.
fn closed(ring: &[DVec3]) -> Geometry {
    Geometry::Line(ring.iter().chain(ring.first()).copied().collect())
}

fn boundary(geometry: &Geometry) -> Geometry {
    let rings = |rings: &Rings| rings.iter().map(|ring| closed(ring)).collect::<Vec<_>>();
    match geometry {
        Geometry::Point(_) | Geometry::MultiPoint(_) => Geometry::default(),
        Geometry::Polygon(polygon) => Geometry::gathered(rings(polygon)),
        Geometry::MultiPolygon(polygons) => collected(polygons.iter().flat_map(rings).collect()),
        Geometry::Line(line) => ends(std::slice::from_ref(line)),
        Geometry::MultiLine(lines) => ends(lines),
        Geometry::Collection(members) => Geometry::gathered(members.iter().map(boundary).collect()),
    }
}

/// The ends that an odd number of lines have.
fn ends(lines: &[Vec<DVec3>]) -> Geometry {
    let mut ends: Vec<DVec3> = Vec::new();
    for end in lines.iter().flat_map(|line| line.first().into_iter().chain(line.last())) {
        match ends.iter().position(|known| known.truncate() == end.truncate()) {
            Some(index) => drop(ends.swap_remove(index)),
            None => ends.push(*end),
        }
    }
    ends.sort_by(|a, b| a.x.total_cmp(&b.x).then(a.y.total_cmp(&b.y)));
    Geometry::MultiPoint(ends)
}

fn end(geometry: &Geometry, first: bool) -> FunctionResult {
    let Geometry::Line(points) = geometry else { return FunctionResult::Nothing };
    let found = if first { points.first() } else { points.last() };
    found.map_or(FunctionResult::Nothing, |at| FunctionResult::Geometry(Geometry::point(*at)))
}

/// A number that counts from 1, or 0; nothing of a negative one.
fn nth(call: &FunctionCall<'_>, index: usize) -> Result<Option<usize>, String> {
    let number = call.number(index)?;
    #[allow(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "it is not negative, and saturates"
    )]
    Ok((number >= 0.0).then_some(number as usize))
}

/// The point at a part of a line's length, as seen from above.
fn along(points: &[DVec3], part: f64) -> Option<DVec3> {
    let steps =
        || points.windows(2).map(|pair| (pair[0], pair[1], pair[0].truncate().distance(pair[1].truncate())));
    let mut left = part * steps().map(|step| step.2).sum::<f64>();
    for (from, to, length) in steps() {
        if left <= length && length > 0.0 {
            return Some(from.lerp(to, left / length));
        }
        left -= length;
    }
    points.last().copied()
}

fn substring(points: &[DVec3], from: f64, to: f64) -> FunctionResult {
    let total: f64 = points.windows(2).map(|pair| pair[0].truncate().distance(pair[1].truncate())).sum();
    let (Some(first), Some(last)) = (along(points, from), along(points, to)) else {
        return FunctionResult::Nothing;
    };
    if from == to {
        return FunctionResult::Geometry(Geometry::point(first));
    }
    let mut at = 0.0;
    let mut kept = vec![first];
    for pair in points.windows(2) {
        at += pair[0].truncate().distance(pair[1].truncate());
        if at > from * total && at < to * total {
            kept.push(pair[1]);
        }
    }
    kept.push(last);
    kept.dedup();
    Geometry::line(kept)
        .map_or_else(|| FunctionResult::Geometry(Geometry::point(first)), FunctionResult::Geometry)
}

fn reverse(geometry: &mut Geometry) {
    match geometry {
        Geometry::Point(_) => {}
        Geometry::Line(points) | Geometry::MultiPoint(points) => points.reverse(),
        Geometry::Polygon(rings) => rings.0.iter_mut().for_each(|ring| ring.reverse()),
        Geometry::MultiLine(lines) => lines.iter_mut().for_each(|line| line.reverse()),
        Geometry::MultiPolygon(polygons) => {
            polygons.iter_mut().flat_map(|rings| &mut rings.0).for_each(|ring| ring.reverse())
        }
        Geometry::Collection(members) => members.iter_mut().for_each(reverse),
    }
}

/// The options of a buffer, as PostGIS has them.
fn buffer_options(call: &FunctionCall<'_>) -> Result<BufferOptions, String> {
    let mut options = BufferOptions::default();
    let segments = |number: f64| {
        #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "the range is checked")]
        (1.0..=1000.0)
            .contains(&number)
            .then_some(number as u32)
            .ok_or_else(|| format!("a quarter of a circle has 1 to 1000 segments, not {number}"))
    };
    let Ok(text) = call.text(2) else {
        options.quadrant_segments = segments(call.number(2)?)?;
        return Ok(options);
    };
    for word in text.split_whitespace() {
        let (name, value) = word.split_once('=').unwrap_or((word, ""));
        match (name, value) {
            ("quad_segs", value) => options.quadrant_segments = segments(value.parse().unwrap_or(f64::NAN))?,
            ("endcap", "round") => options.cap = BufferCap::Round,
            ("endcap", "flat" | "butt") => options.cap = BufferCap::Flat,
            ("endcap", "square") => options.cap = BufferCap::Square,
            ("join", "round") => options.join = BufferJoin::Round,
            ("join", "mitre" | "miter") => options.join = BufferJoin::Mitre,
            ("join", "bevel") => options.join = BufferJoin::Bevel,
            ("mitre_limit" | "miter_limit", "5" | "5.0") | ("side", "both") => {}
            _ => {
                return Err(format!(
                    "there is no option {word:?}; there are quad_segs=8, endcap=round|flat|square, join=round|mitre|bevel"
                ));
            }
        }
    }
    Ok(options)
}
