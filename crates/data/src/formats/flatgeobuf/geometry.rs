//! Geometries of FlatGeobuf.

use glam::DVec3;
use std::borrow::Cow;

use super::buffer::{BufferDamage, BufferTable};
use super::header::doubles;
use burgeon_base::budget::Budget;
use burgeon_spatial::DEEPEST;
use burgeon_spatial::Geometry;

/// Adds the parts of a geometry of type `kind`; if `kind` is 0, the geometry may contain its own type. Fails with the
/// reason.
pub(super) fn read(
    table: &BufferTable<'_>,
    kind: u8,
    budget: &Budget,
    depth: usize,
    parts: &mut Vec<Geometry>,
) -> Result<(), Cow<'static, str>> {
    budget.tick().map_err(|error| error.into_message())?;
    if depth > DEEPEST {
        return Err(format!("is nested more than {DEEPEST} deep").into());
    }
    let broken = |why: BufferDamage| format!("has a geometry that {why}");
    let kind = match (kind, table.field_bytes(6).map_err(broken)?) {
        (0, Some([own])) => own,
        (kind, _) => kind,
    };
    match kind {
        1 => parts.extend(
            points(table, budget)?.into_iter().filter(|place| !place.x.is_nan()).map(Geometry::point),
        ),
        4 => parts.extend(points(table, budget)?.into_iter().map(Geometry::point)),
        2 => parts.extend(Geometry::line(points(table, budget)?)),
        3 | 17 => parts.extend(Geometry::polygon(lists(table, budget)?)),
        5 => parts.extend(lists(table, budget)?.into_iter().filter_map(Geometry::line)),
        6 | 7 | 15 | 16 => {
            let inner = match kind {
                6 => 3,
                15 => 3,
                16 => 17,
                _ => 0,
            };
            for part in table.tables(7).map_err(broken)? {
                read(&part.map_err(broken)?, inner, budget, depth + 1, parts)?;
            }
        }
        8..=14 => return Err("is a curve, which is not supported".into()),
        kind => return Err(format!("has a geometry of unknown type {kind}").into()),
    }
    Ok(())
}

/// Returns the points of a geometry.
fn points(table: &BufferTable<'_>, budget: &Budget) -> Result<Vec<DVec3>, Cow<'static, str>> {
    let broken = |why: BufferDamage| format!("has a geometry that {why}");
    let (places, heights) = (table.list(1, 8).map_err(broken)?, table.list(2, 8).map_err(broken)?);
    if !places.len().is_multiple_of(16) || !(heights.is_empty() || heights.len() * 2 == places.len()) {
        return Err("has points with a missing coordinate".into());
    }
    budget.take(places.len() * 3 / 2).map_err(|error| error.into_message())?;
    let mut heights = doubles(heights);
    let points = places.as_chunks::<16>().0.iter().map(|place| {
        let mut place = doubles(place);
        let mut next = || place.next().unwrap_or_default();
        let (x, y, z) = (next(), next(), heights.next().unwrap_or_default());
        // Some programs write NaN for unknown heights.
        DVec3::new(x, y, if z.is_nan() { 0.0 } else { z })
    });
    Ok(points.collect())
}

/// Returns the lists of points into which a geometry is divided.
fn lists(table: &BufferTable<'_>, budget: &Budget) -> Result<Vec<Vec<DVec3>>, Cow<'static, str>> {
    let ends = table.list(0, 4).map_err(|why| format!("has a geometry that {why}"))?;
    let all = points(table, budget)?;
    if ends.is_empty() {
        return Ok(if all.is_empty() { Vec::new() } else { vec![all] });
    }
    let mut lists = Vec::with_capacity(ends.len() / 4);
    let mut begin = 0;
    for end in ends.as_chunks().0 {
        let end = u32::from_le_bytes(*end) as usize;
        let list = all.get(begin..end).ok_or("has parts with invalid ends")?;
        lists.push(list.to_vec());
        begin = end;
    }
    if begin < all.len() { Err("has points outside its parts".into()) } else { Ok(lists) }
}
