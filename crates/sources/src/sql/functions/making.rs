//! Functions that derive geometries from others.

use burgeon_spatial::{BufferCap, BufferJoin, BufferOptions, Geometry, Rings};
use geo::LineLocatePoint;
use glam::DVec3;

use super::call::{FunctionCall, FunctionResult};
use super::parts::{check_geometry, closed_line, collect, members, place};
use super::spatial_function::{ONE, PAIR, SpatialFunction, function};

/// Calls a method of one geometry that returns a geometry.
macro_rules! made {
    ($method:ident) => {
        |call| Ok(FunctionResult::Geometry(call.geometry(0)?.geometry.$method()))
    };
}

/// Calls a method of two geometries that returns a geometry.
macro_rules! made_of_two {
    ($method:ident) => {
        |call| Ok(FunctionResult::Geometry(call.geometry(0)?.geometry.$method(&call.geometry(1)?.geometry)))
    };
}

/// Functions that derive geometries from others.
pub(super) const MAKERS: &[SpatialFunction] = &[
    function(
        "ST_Buffer",
        (2, 3),
        "(geometry, distance [, options])",
        "geometry",
        "The area within `distance` of the geometry. Options are PostGIS's: the number of segments of a quarter circle, or a string such as `'endcap=flat join=mitre quad_segs=8'`.",
        |call| {
            let options = if call.len() == 3 { buffer_options(call)? } else { BufferOptions::default() };
            let made = call.geometry(0)?.geometry.buffer(call.number(1)?, &options);
            made.map(FunctionResult::Geometry).map_err(|error| error.into_message())
        },
    ),
    function(
        "ST_OffsetCurve",
        (2, 3),
        "(line, distance [, options])",
        "geometry",
        "The parallel line to the left of a line, or to its right for a negative distance. Options are those of ST_Buffer.",
        |call| {
            let options = if call.len() == 3 { buffer_options(call)? } else { BufferOptions::default() };
            let (line, distance) = (call.geometry(0)?, call.number(1)?);
            if line.geometry.is_empty() || line.geometry.dimension() != 1 {
                return Err(call.wrong_geometry(0, "a line"));
            }
            let made = line.geometry.offset(distance, &options);
            made.map(FunctionResult::Geometry).map_err(|error| error.into_message())
        },
    ),
    function(
        "ST_Intersection",
        (2, 2),
        PAIR,
        "geometry",
        "The common part of both geometries.",
        made_of_two!(intersection),
    ),
    function(
        "ST_Union",
        (2, 2),
        PAIR,
        "geometry",
        "The union of both geometries; with one argument, the union of a group.",
        made_of_two!(union),
    ),
    function(
        "ST_Difference",
        (2, 2),
        PAIR,
        "geometry",
        "The first geometry minus the second.",
        made_of_two!(difference),
    ),
    function(
        "ST_SymDifference",
        (2, 2),
        PAIR,
        "geometry",
        "The parts that belong to only one of the geometries.",
        made_of_two!(sym_difference),
    ),
    function(
        "ST_UnaryUnion",
        (1, 1),
        ONE,
        "geometry",
        "The union of the parts of a geometry.",
        made!(dissolved),
    ),
    function(
        "ST_Collect",
        (2, 2),
        PAIR,
        "geometry",
        "A collection of both geometries; with one argument, of a group.",
        |call| Ok(FunctionResult::Geometry(collect(vec![call.copy_geometry(0)?, call.copy_geometry(1)?]))),
    ),
    function("ST_Centroid", (1, 1), ONE, "geometry", "The centre of mass.", made!(centroid)),
    function(
        "ST_PointOnSurface",
        (1, 1),
        ONE,
        "geometry",
        "A point inside the geometry.",
        made!(point_on_surface),
    ),
    function("ST_Envelope", (1, 1), ONE, "geometry", "The bounding box.", made!(envelope)),
    function(
        "ST_OrientedEnvelope",
        (1, 1),
        ONE,
        "geometry",
        "The smallest enclosing rectangle at any rotation.",
        made!(oriented_envelope),
    ),
    function("ST_ConvexHull", (1, 1), ONE, "geometry", "The convex hull.", made!(convex_hull)),
    function(
        "ST_Boundary",
        (1, 1),
        ONE,
        "geometry",
        "The rings of polygons, or the ends of lines.",
        |call| Ok(FunctionResult::Geometry(boundary(&call.geometry(0)?.geometry))),
    ),
    function(
        "ST_ExteriorRing",
        (1, 1),
        "(polygon)",
        "geometry",
        "The outer ring of a polygon, as a line; NULL for other geometries.",
        |call| {
            Ok(match &call.geometry(0)?.geometry {
                Geometry::Polygon(rings) => rings
                    .first()
                    .map_or(FunctionResult::Nothing, |ring| FunctionResult::Geometry(closed_line(ring))),
                _ => FunctionResult::Nothing,
            })
        },
    ),
    function(
        "ST_InteriorRingN",
        (2, 2),
        "(polygon, number)",
        "geometry",
        "A hole of a polygon, as a line; numbers count from 1.",
        |call| {
            let number = nth(call, 1)?;
            Ok(match &call.geometry(0)?.geometry {
                Geometry::Polygon(rings) => number
                    .filter(|number| *number > 0)
                    .and_then(|number| rings.get(number))
                    .map_or(FunctionResult::Nothing, |ring| FunctionResult::Geometry(closed_line(ring))),
                _ => FunctionResult::Nothing,
            })
        },
    ),
    function(
        "ST_GeometryN",
        (2, 2),
        "(geometry, number)",
        "geometry",
        "A geometry of a collection; numbers count from 1.",
        |call| {
            let number = nth(call, 1)?.and_then(|number| number.checked_sub(1));
            let found =
                number.and_then(|number| members(call.copy_geometry(0).ok()?).into_iter().nth(number));
            Ok(found.map_or(FunctionResult::Nothing, FunctionResult::Geometry))
        },
    ),
    function(
        "ST_PointN",
        (2, 2),
        "(line, number)",
        "geometry",
        "A point of a line; numbers count from 1, or from -1 backwards.",
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
        "The first point of a line; NULL for other geometries.",
        |call| Ok(end(&call.geometry(0)?.geometry, true)),
    ),
    function(
        "ST_EndPoint",
        (1, 1),
        "(line)",
        "geometry",
        "The last point of a line; NULL for other geometries.",
        |call| Ok(end(&call.geometry(0)?.geometry, false)),
    ),
    function(
        "ST_LineInterpolatePoint",
        (2, 2),
        "(line, part)",
        "geometry",
        "The point at a fraction of a line's length, 0 to 1.",
        |call| {
            let part = call.number(1)?;
            if !(0.0..=1.0).contains(&part) {
                return Err(format!("the part must be from 0 to 1, not {part}"));
            }
            let parsed = call.geometry(0)?;
            let Geometry::Line(points) = &parsed.geometry else { return Err("it takes a line".into()) };
            Ok(point_at(points, part)
                .map_or(FunctionResult::Nothing, |at| FunctionResult::Geometry(Geometry::point(at))))
        },
    ),
    function(
        "ST_LineLocatePoint",
        (2, 2),
        "(line, point)",
        "number",
        "The fraction of a line's length, 0 to 1, that is nearest to a point.",
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
        "The part of a line between two fractions of its length, 0 to 1.",
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
        "The most similar valid geometry; a valid geometry stays unchanged.",
        made!(make_valid),
    ),
    function(
        "ST_Simplify",
        (2, 2),
        "(geometry, distance)",
        "geometry",
        "The geometry with fewer points; removed points are at most `distance` from the result.",
        |call| Ok(FunctionResult::Geometry(call.geometry(0)?.geometry.simplify_separately(call.number(1)?))),
    ),
    function(
        "ST_Reverse",
        (1, 1),
        ONE,
        "geometry",
        "The geometry with its points in reverse order.",
        |call| {
            let mut geometry = call.copy_geometry(0)?;
            reverse(&mut geometry);
            Ok(FunctionResult::Geometry(geometry))
        },
    ),
    function(
        "ST_Translate",
        (3, 4),
        "(geometry, east, north [, up])",
        "geometry",
        "The translated geometry.",
        |call| {
            let by = DVec3::new(call.number(1)?, call.number(2)?, call.number_or(3, 0.0)?);
            let mut geometry = call.copy_geometry(0)?;
            geometry.points_mut().for_each(|point| *point += by);
            check_geometry(geometry)
        },
    ),
    function("ST_Force2D", (1, 1), ONE, "geometry", "The geometry without heights.", |call| {
        let mut geometry = call.copy_geometry(0)?;
        geometry.points_mut().for_each(|point| point.z = 0.0);
        Ok(FunctionResult::Geometry(geometry))
    }),
    function("ST_Multi", (1, 1), ONE, "geometry", "The geometry as a multi-geometry.", |call| {
        Ok(FunctionResult::Geometry(match call.copy_geometry(0)? {
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
];

fn boundary(geometry: &Geometry) -> Geometry {
    let rings = |rings: &Rings| rings.iter().map(|ring| closed_line(ring)).collect::<Vec<_>>();
    match geometry {
        Geometry::Point(_) | Geometry::MultiPoint(_) => Geometry::default(),
        Geometry::Polygon(polygon) => Geometry::gathered(rings(polygon)),
        Geometry::MultiPolygon(polygons) => collect(polygons.iter().flat_map(rings).collect()),
        Geometry::Line(line) => ends(std::slice::from_ref(line)),
        Geometry::MultiLine(lines) => ends(lines),
        Geometry::Collection(members) => Geometry::gathered(members.iter().map(boundary).collect()),
    }
}

/// Returns the ends that belong to an odd number of lines.
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

/// Returns a number that counts from 1, or 0, or `None` if it is negative.
fn nth(call: &FunctionCall<'_>, index: usize) -> Result<Option<usize>, String> {
    let number = call.number(index)?;
    #[allow(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "it is not negative, and saturates"
    )]
    Ok((number >= 0.0).then_some(number as usize))
}

/// Returns the point at a fraction of a line's horizontal length.
fn point_at(points: &[DVec3], part: f64) -> Option<DVec3> {
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
    let (Some(first), Some(last)) = (point_at(points, from), point_at(points, to)) else {
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

/// Reads the options of a buffer, in PostGIS's notation.
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
