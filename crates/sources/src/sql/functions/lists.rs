//! Functions that return several rows, as lists for `rarray`: the parts of geometries, and series of numbers.

use std::rc::Rc;
use std::sync::Arc;

use burgeon_spatial::{Geometry, Rings};
use glam::DVec3;
use rusqlite::Connection;
use rusqlite::functions::{Context, FunctionFlags};
use rusqlite::types::{Value, ValueRef};

use super::call::{KeyList, keys, run_list};
use super::parts::members;
use super::state::ConnectionState;

/// Functions of PostGIS, and their names in rewritten statements.
pub(crate) const NAMES: [(&str, &str); 6] = [
    ("st_dump", "burgeon_dump"),
    ("st_dumppoints", "burgeon_dump_points"),
    ("st_dumprings", "burgeon_dump_rings"),
    ("st_dumpsegments", "burgeon_dump_segments"),
    ("st_subdivide", "burgeon_subdivide"),
    ("generate_series", "burgeon_series"),
];

/// Maximum number of parts of a geometry, and of numbers of a series.
const MOST: usize = 10_000_000;

/// Collects the single geometries of a geometry, in order.
fn singles(geometry: &Geometry, found: &mut Vec<Geometry>) {
    match geometry {
        Geometry::Collection(_)
        | Geometry::MultiPoint(_)
        | Geometry::MultiLine(_)
        | Geometry::MultiPolygon(_) => members(geometry).iter().for_each(|member| singles(member, found)),
        single if single.is_empty() => {}
        single => found.push(single.clone()),
    }
}

fn parts(geometry: &Geometry, each: impl Fn(&Geometry, &mut Vec<Geometry>)) -> Vec<Geometry> {
    let (mut all, mut found) = (Vec::new(), Vec::new());
    singles(geometry, &mut all);
    all.iter().for_each(|single| each(single, &mut found));
    found
}

/// Returns the rings of polygons as closed lines, and lines unchanged.
fn lines(geometry: &Geometry) -> Vec<Vec<DVec3>> {
    let ring = |ring: &Vec<DVec3>| ring.iter().chain(ring.first()).copied().collect();
    match geometry {
        Geometry::Point(point) => vec![point.iter().copied().collect()],
        Geometry::Line(points) => vec![points.clone()],
        Geometry::Polygon(rings) => rings.iter().map(ring).collect(),
        _ => Vec::new(),
    }
}

/// Divides a geometry into parts with at most `most` points, by halving its box as PostGIS does.
fn subdivide(
    geometry: &Geometry,
    most: usize,
    depth: usize,
    found: &mut Vec<Geometry>,
) -> Result<(), String> {
    if let Geometry::Collection(_) = geometry {
        return members(geometry).iter().try_for_each(|member| subdivide(member, most, depth, found));
    }
    let count: usize = parts(geometry, |single, found| found.push(single.clone()))
        .iter()
        .flat_map(lines)
        .map(|line| line.len())
        .sum();
    let Some([low, high]) = geometry.bounds().filter(|_| count > 0) else { return Ok(()) };
    if count <= most || depth > 50 || found.len() > MOST {
        found.push(geometry.clone());
        return Ok(());
    }
    if let Geometry::Point(_) | Geometry::MultiPoint(_) = geometry {
        let points: Vec<DVec3> = geometry.points().copied().collect();
        points.chunks(most).for_each(|chunk| found.push(Geometry::MultiPoint(chunk.to_vec())));
        return Ok(());
    }
    let size = high - low;
    let along_x = size.x > size.y;
    let middle = (low + high) / 2.0;
    // Geometry on the common border of the halves belongs to both.
    for upper in [false, true] {
        let (mut from, mut to) = (low, high);
        let bound = if upper { &mut from } else { &mut to };
        if along_x {
            bound.x = middle.x
        } else {
            bound.y = middle.y
        }
        let corners = [[from.x, from.y], [to.x, from.y], [to.x, to.y], [from.x, to.y]];
        let ring = corners.map(|[x, y]| DVec3::new(x, y, 0.0)).to_vec();
        let part = geometry.intersection(&Geometry::Polygon(Rings(vec![ring])));
        let wanted = geometry.dimension();
        let kept = parts(&part, |single, found| {
            if single.dimension() == wanted {
                found.push(single.clone());
            }
        });
        if !kept.is_empty() {
            subdivide(&super::parts::collect_single(kept), most, depth + 1, found)?;
        }
    }
    Ok(())
}

fn number(context: &Context<'_>, index: usize) -> Result<f64, String> {
    match context.get_raw(index) {
        #[allow(clippy::cast_precision_loss, reason = "far more than any list has")]
        ValueRef::Integer(number) => Ok(number as f64),
        ValueRef::Real(number) => Ok(number),
        other => Err(super::texts::wrong_argument(index, "a number", other)),
    }
}

fn series(context: &Context<'_>) -> Result<KeyList, String> {
    if (0..context.len()).any(|index| matches!(context.get_raw(index), ValueRef::Null)) {
        return Ok(keys(&[]));
    }
    let (from, to) = (number(context, 0)?, number(context, 1)?);
    let step = if context.len() > 2 { number(context, 2)? } else { 1.0 };
    if step == 0.0 {
        return Err("step size cannot equal zero".into());
    }
    let whole = (0..context.len()).all(|index| matches!(context.get_raw(index), ValueRef::Integer(_)));
    let count = ((to - from) / step + 1e-12).floor();
    if !count.is_finite() || count >= 1e7 {
        return Err(format!("a series has at most {MOST} numbers"));
    }
    let mut values = Vec::new();
    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "the range is checked")]
    let count = if count < 0.0 { 0 } else { count as u32 + 1 };
    for index in 0..count {
        let number = from + f64::from(index) * step;
        #[allow(clippy::cast_possible_truncation, reason = "it is a whole number")]
        values.push(if whole { Value::Integer(number as i64) } else { Value::Real(number) });
    }
    Ok(KeyList(Rc::new(values)))
}

/// Registers the functions with a connection.
pub(super) fn register(connection: &Connection, state: &Arc<ConnectionState>) -> rusqlite::Result<()> {
    type Parts = fn(&Geometry) -> Vec<Geometry>;
    let flags = FunctionFlags::SQLITE_UTF8 | FunctionFlags::SQLITE_DETERMINISTIC;
    let functions: [(&str, &str, Parts); 4] = [
        ("ST_Dump", "burgeon_dump", |geometry| parts(geometry, |single, found| found.push(single.clone()))),
        ("ST_DumpPoints", "burgeon_dump_points", |geometry| {
            parts(geometry, |single, found| {
                found.extend(lines(single).into_iter().flatten().map(Geometry::point));
            })
        }),
        ("ST_DumpRings", "burgeon_dump_rings", |geometry| {
            parts(geometry, |single, found| {
                if let Geometry::Polygon(rings) = single {
                    found.extend(rings.iter().map(|ring| Geometry::Polygon(Rings(vec![ring.clone()]))));
                }
            })
        }),
        ("ST_DumpSegments", "burgeon_dump_segments", |geometry| {
            parts(geometry, |single, found| {
                for line in lines(single) {
                    found.extend(line.windows(2).map(|pair| Geometry::Line(pair.to_vec())));
                }
            })
        }),
    ];
    for (name, own, run) in functions {
        let state = Arc::clone(state);
        connection.create_scalar_function(own, 1, flags, move |context| {
            run_list(context, &state, name, |geometry, _| Ok(run(&geometry.geometry)))
        })?;
    }
    for count in 1..=2 {
        let state = Arc::clone(state);
        connection.create_scalar_function("burgeon_subdivide", count, flags, move |context| {
            run_list(context, &state, "ST_Subdivide", |geometry, context| {
                let most = if context.len() > 1 { number(context, 1)? } else { 256.0 };
                if most < 5.0 {
                    return Err(format!("a part has at least 5 points, not {most}"));
                }
                let mut found = Vec::new();
                #[allow(
                    clippy::cast_possible_truncation,
                    clippy::cast_sign_loss,
                    reason = "it is positive, and saturates"
                )]
                subdivide(&geometry.geometry, most as usize, 0, &mut found)?;
                Ok(found)
            })
        })?;
    }
    for count in 2..=3 {
        connection.create_scalar_function("burgeon_series", count, flags, |context| {
            series(context)
                .map_err(|why| rusqlite::Error::UserFunctionError(format!("generate_series: {why}").into()))
        })?;
    }
    Ok(())
}
