//! Functions that return several rows, as lists for `rarray`: the parts of geometries, and series of numbers.

use std::rc::Rc;

use burgeon_spatial::{Geometry, Rings};
use glam::DVec3;
use rusqlite::functions::Context;
use rusqlite::types::{Value, ValueRef};

use super::call::{KeyList, keys, run_list};
use super::parts::members;
use super::registry::FunctionRegistrar;

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
fn singles(geometry: Geometry, found: &mut Vec<Geometry>) {
    match geometry {
        Geometry::Collection(_)
        | Geometry::MultiPoint(_)
        | Geometry::MultiLine(_)
        | Geometry::MultiPolygon(_) => {
            members(geometry).into_iter().for_each(|member| singles(member, found));
        }
        single if single.is_empty() => {}
        single => found.push(single),
    }
}

fn parts(geometry: Geometry, each: impl Fn(Geometry, &mut Vec<Geometry>)) -> Vec<Geometry> {
    let (mut all, mut found) = (Vec::new(), Vec::new());
    singles(geometry, &mut all);
    all.into_iter().for_each(|single| each(single, &mut found));
    found
}

/// Returns the rings of polygons as closed lines, and lines unchanged.
fn lines(geometry: Geometry) -> Vec<Vec<DVec3>> {
    let ring = |ring: &Vec<DVec3>| ring.iter().chain(ring.first()).copied().collect();
    match geometry {
        Geometry::Point(point) => vec![point.into_iter().collect()],
        Geometry::Line(points) => vec![points],
        Geometry::Polygon(rings) => rings.iter().map(ring).collect(),
        _ => Vec::new(),
    }
}

/// Returns the number of points of a geometry, where the rings of polygons are closed lines.
fn count_points(geometry: &Geometry) -> usize {
    let area = |rings: &Rings| rings.iter().map(|ring| ring.len() + usize::from(!ring.is_empty())).sum();
    match geometry {
        Geometry::Polygon(rings) => area(rings),
        Geometry::MultiPolygon(polygons) => polygons.iter().map(area).sum(),
        Geometry::Collection(members) => members.iter().map(count_points).sum(),
        other => other.points().count(),
    }
}

/// Divides a geometry into parts with at most `most` points, by halving its box as PostGIS does.
fn subdivide(geometry: Geometry, most: usize, depth: usize, found: &mut Vec<Geometry>) -> Result<(), String> {
    if let Geometry::Collection(_) = geometry {
        return members(geometry).into_iter().try_for_each(|member| subdivide(member, most, depth, found));
    }
    let count = count_points(&geometry);
    let Some([low, high]) = geometry.bounds().filter(|_| count > 0) else { return Ok(()) };
    if count <= most || depth > 50 || found.len() > MOST {
        found.push(geometry);
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
        let ring = corners.into_iter().map(|[x, y]| DVec3::new(x, y, 0.0)).collect();
        let part = geometry.intersection(&Geometry::Polygon(Rings(vec![ring])));
        let wanted = geometry.dimension();
        let kept = parts(part, |single, found| {
            if single.dimension() == wanted {
                found.push(single);
            }
        });
        if !kept.is_empty() {
            subdivide(super::parts::collect_single(kept), most, depth + 1, found)?;
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
pub(super) fn register(functions: &FunctionRegistrar<'_>) -> rusqlite::Result<()> {
    type Parts = fn(Geometry) -> Vec<Geometry>;
    let dumps: [(&str, &str, Parts); 4] = [
        ("ST_Dump", "burgeon_dump", |geometry| parts(geometry, |single, found| found.push(single))),
        ("ST_DumpPoints", "burgeon_dump_points", |geometry| {
            parts(geometry, |single, found| {
                found.extend(lines(single).into_iter().flatten().map(Geometry::point));
            })
        }),
        ("ST_DumpRings", "burgeon_dump_rings", |geometry| {
            parts(geometry, |single, found| {
                if let Geometry::Polygon(rings) = single {
                    found.extend(rings.0.into_iter().map(|ring| Geometry::Polygon(Rings(vec![ring]))));
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
    for (name, own, run) in dumps {
        functions.register(own, 1, move |context, state| {
            run_list(context, state, name, |geometry, _| Ok(run(geometry)))
        })?;
    }
    for count in 1..=2 {
        functions.register("burgeon_subdivide", count, |context, state| {
            run_list(context, state, "ST_Subdivide", |geometry, context| {
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
                subdivide(geometry, most as usize, 0, &mut found)?;
                Ok(found)
            })
        })?;
    }
    for count in 2..=3 {
        functions.register("burgeon_series", count, |context, _| {
            series(context)
                .map_err(|why| rusqlite::Error::UserFunctionError(format!("generate_series: {why}").into()))
        })?;
    }
    Ok(())
}
