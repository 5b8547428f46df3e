//! The tables that a network returns to scripts, and warnings about its calls.

use std::sync::Arc;

use burgeon_base::error::{Error, Result};
use burgeon_base::warning::{Warning, WarningKind};
use burgeon_kit::{Parameter, Table, TableKey, Value, Vector};
use burgeon_streets::{
    DeadEndOptions, ExistingLoss, Fate, JunctionId, Measures, Refusal, StreetNetwork, StreetProspect,
};
use glam::DVec2;

/// Creates a table of named values, without entries that are nil.
fn named_table<const N: usize>(entries: [(&str, Value); N]) -> Value {
    let there = entries.into_iter().filter(|(_, value)| !matches!(value, Value::Nil));
    let entries = there.map(|(name, value)| (TableKey::Name(name.into()), value));
    Value::Table(Arc::new(Table { class: None, entries: entries.collect() }))
}

fn place(at: DVec2) -> Value {
    Vector(at.extend(0.0)).into_value()
}

fn number(junction: JunctionId) -> Value {
    Value::Number(f64::from(junction) + 1.0)
}

/// Returns the name of the outcome of a street, or of the reason for its refusal.
pub(super) fn fate(fate: Fate) -> &'static str {
    match fate {
        Fate::Refused(why) => why.name(),
        fate => fate.name(),
    }
}

/// Creates the table that describes the predicted outcome of a street.
pub(super) fn prospect(prospect: StreetProspect) -> Value {
    let junction = prospect.junction.map_or(Value::Nil, number);
    let outcome = Value::Text(fate(prospect.fate).into());
    named_table([
        ("outcome", outcome.clone()),
        // Former name of the outcome.
        ("fate", outcome),
        ("built", Value::Boolean(!matches!(prospect.fate, Fate::Refused(_)))),
        ("place", place(prospect.place)),
        ("junction", junction),
    ])
}

/// Creates the table of the measures, by name.
pub(super) fn measures(measures: &Measures) -> Value {
    let [dead_ends, three_way, four_way] = measures.shares;
    named_table(
        [
            ("length", measures.length),
            ("degree", measures.degree),
            ("dead_ends", dead_ends),
            ("three_way", three_way),
            ("four_way", four_way),
            ("circuity", measures.circuity),
            ("meshedness", measures.meshedness),
            ("orientation_order", measures.orientation_order),
            ("block", measures.block),
            ("block_spread", measures.block_spread),
            ("block_shape", measures.block_shape),
            ("segment", measures.segment),
            ("density", measures.density),
            ("largest", measures.largest),
            ("zigzags", measures.zigzags),
            ("stubs", measures.stubs),
            ("triangles", measures.triangles),
            ("knots", measures.knots),
        ]
        .map(|(name, value)| (name, Value::Number(value))),
    )
}

/// Creates the list of the missing parts of existing streets.
pub(super) fn omitted_streets(losses: &[ExistingLoss]) -> Value {
    let parts = losses.iter().map(|loss| {
        named_table([
            ("name", Value::Text(loss.name.as_str().into())),
            ("place", loss.at.map_or(Value::Nil, place)),
            ("length", Value::Number(loss.length)),
            ("reason", Value::Text(loss.why.name().into())),
        ])
    });
    parts.collect::<Vec<_>>().into_value()
}

/// Creates the list of the dead ends on the ground: their junctions, positions, headings to continue in, and the depths
/// of their streets.
pub(super) fn open_ends(network: &StreetNetwork) -> Value {
    let on_ground =
        |end: &JunctionId| network.arms(*end).iter().all(|(piece, _)| network.is_on_ground(*piece));
    let ends = network.dead_ends().filter(on_ground).map(|end| {
        let arms = network.arms(end);
        let (piece, way) = arms[0];
        named_table([
            ("junction", number(end)),
            ("place", place(network.at(end))),
            ("heading", Value::Number((-way).to_angle().to_degrees())),
            ("depth", Value::Number(f64::from(network.attributes(piece).depth))),
        ])
    });
    ends.collect::<Vec<_>>().into_value()
}

/// Creates the list of the junctions by number: their positions, the minimum depths of their streets, and the headings
/// of the streets.
pub(super) fn places(network: &StreetNetwork) -> Value {
    let places = (0..).zip(network.junctions()).map(|(id, junction)| {
        let arms = network.arms(id);
        let depth = arms.iter().map(|(piece, _)| network.attributes(*piece).depth).min();
        let headings: Vec<Value> =
            arms.iter().map(|(_, way)| Value::Number(way.to_angle().to_degrees())).collect();
        named_table([
            ("depth", Value::Number(f64::from(depth.unwrap_or(0)))),
            ("headings", headings.into_value()),
            ("place", place(junction.place())),
        ])
    });
    places.collect::<Vec<_>>().into_value()
}

/// Creates the table of the area on the left of the street that leaves a junction nearest to a direction, with its
/// corners.
pub(super) fn face(network: &StreetNetwork, junction: JunctionId, towards: DVec2) -> Value {
    let way = network.way_from(junction, towards);
    if way.is_empty() {
        return Value::Nil;
    }
    let corners = way.iter().map(|course| {
        let degree = network.junctions()[course.from as usize].degree();
        named_table([
            ("junction", number(course.from)),
            ("place", place(network.at(course.from))),
            ("degree", Value::Number(f64::from(u32::try_from(degree).unwrap_or(u32::MAX)))),
            ("depth", Value::Number(f64::from(network.attributes(course.piece).depth))),
        ])
    });
    let corners = corners.collect::<Vec<_>>().into_value();
    named_table([("area", Value::Number(network.area(&way))), ("corners", corners)])
}

/// Returns the warning about a street that did not reach its target. The positions are the start, the end and the
/// target of the street.
pub(super) fn misled_warning(fate: Fate, [from, end, to]: [DVec2; 3]) -> Option<Warning> {
    let metres = |place: DVec2| format!("{:.1}, {:.1}", place.x, place.y);
    let way = format!("from {} to {}", metres(from), metres(to));
    let (text, remedy) = match fate {
        Fate::Refused(why) => {
            let remedy = match why {
                Refusal::TooShort => "propose a longer street, or set a smaller `min_length`",
                Refusal::Angle => "choose another position, or set a smaller `min_angle`",
                Refusal::TooNear => "choose another position, or set a smaller `clearance`",
                Refusal::Corners => "choose another position, or set a smaller `corner`",
                Refusal::Obstacle => "go around the obstacle, or remove the obstacle",
                Refusal::Outside => {
                    "choose a position within the `limit` of the network and within 500 km of the origin"
                }
            };
            (format!("network:grow_to: no street {way}: {}", why.name()), remedy)
        }
        Fate::Shortened => {
            let end = metres(end);
            let text = format!("network:grow_to: the street {way} ends at {end}, before an obstacle");
            (text, "go around the obstacle, or remove the obstacle")
        }
        _ => return None,
    };
    Some(Warning::new(WarningKind::NoEffect, text).help(remedy))
}

/// Checks the options with which a script called `method` to join dead ends. Fails if they are out of range.
pub(super) fn dead_end_options(
    method: &str,
    radius: Option<f64>,
    detour: Option<f64>,
) -> Result<DeadEndOptions> {
    let usual = DeadEndOptions::default();
    let options =
        DeadEndOptions { radius: radius.unwrap_or(usual.radius), detour: detour.unwrap_or(usual.detour) };
    if !(0.0..=2000.0).contains(&options.radius) || !(1.0..=100.0).contains(&options.detour) {
        return Err(Error::argument(format!(
            "network:{method} needs a radius from 0 to 2000 and a detour from 1 to 100"
        )));
    }
    Ok(options)
}
