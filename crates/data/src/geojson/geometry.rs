//! GeoJSON geometries: coordinates are decoded directly to points according to the type.

use std::fmt;

use glam::DVec3;
use serde::Deserialize;
use serde::de::{DeserializeSeed, Deserializer, Error as _, IgnoredAny, MapAccess, SeqAccess, Visitor};
use serde_json::value::RawValue;

use super::parser::{LARGE, parser_message};
use crate::source_options::SourceOptions;
use burgeon_base::budget::Budget;
use burgeon_base::text::shown;
use burgeon_spatial::DEEPEST;
use burgeon_spatial::Geometry;

#[derive(Deserialize)]
struct RawGeometry<'a> {
    #[serde(borrow)]
    r#type: Option<&'a RawValue>,
    #[serde(borrow)]
    coordinates: Option<&'a RawValue>,
    #[serde(borrow)]
    geometries: Option<&'a RawValue>,
}

/// Defines the errors of a list visitor for other JSON values.
macro_rules! no_list {
    ($life:lifetime, $value:ty) => {
        fn visit_f64<E: serde::de::Error>(self, _: f64) -> Result<$value, E> {
            Err(E::custom("has a number instead of a list in its coordinates"))
        }

        fn visit_i64<E: serde::de::Error>(self, _: i64) -> Result<$value, E> {
            self.visit_f64(0.0)
        }

        fn visit_u64<E: serde::de::Error>(self, _: u64) -> Result<$value, E> {
            self.visit_f64(0.0)
        }

        fn visit_bool<E: serde::de::Error>(self, _: bool) -> Result<$value, E> {
            Err(E::custom("has a boolean instead of a list in its coordinates"))
        }

        fn visit_str<E: serde::de::Error>(self, _: &str) -> Result<$value, E> {
            Err(E::custom("has text instead of a list in its coordinates"))
        }

        fn visit_unit<E: serde::de::Error>(self) -> Result<$value, E> {
            Err(E::custom("has null instead of a list in its coordinates"))
        }

        fn visit_map<A: MapAccess<$life>>(self, _: A) -> Result<$value, A::Error> {
            Err(A::Error::custom("has an object instead of a list in its coordinates"))
        }
    };
}

/// Returns true if `kind` is a geometry type.
pub(super) fn is_known(kind: &str) -> bool {
    matches!(
        kind,
        "Point"
            | "LineString"
            | "Polygon"
            | "MultiPoint"
            | "MultiLineString"
            | "MultiPolygon"
            | "GeometryCollection"
    )
}

/// Returns the parts of the geometry in `text`. Fails with the reason.
pub(super) fn read(text: &RawValue, wanted: &SourceOptions) -> Result<Vec<Geometry>, String> {
    let mut parts = Vec::new();
    geometry(text, wanted, 0, &mut parts)?;
    Ok(parts)
}

/// Returns the parts of the geometry in a separate text. Fails with the reason.
#[cfg(feature = "data")]
pub(crate) fn geometry_of(text: &str, wanted: &SourceOptions) -> Result<Vec<Geometry>, String> {
    let text: &RawValue = serde_json::from_str(text)
        .map_err(|error| format!("has an invalid geometry: {}", parser_message(&error)))?;
    read(text, wanted)
}

/// Returns the parts of a geometry of the type `kind` with these members.
pub(super) fn of_members(
    kind: &str,
    coordinates: Option<&RawValue>,
    geometries: Option<&RawValue>,
    wanted: &SourceOptions,
) -> Result<Vec<Geometry>, String> {
    let mut parts = Vec::new();
    members(kind, coordinates, geometries, wanted, 0, &mut parts)?;
    Ok(parts)
}

fn geometry(
    text: &RawValue,
    wanted: &SourceOptions,
    depth: usize,
    parts: &mut Vec<Geometry>,
) -> Result<(), String> {
    let raw: RawGeometry<'_> = serde_json::from_str(text.get())
        .map_err(|error| format!("has an invalid geometry: {}", parser_message(&error)))?;
    let kind: String = raw
        .r#type
        .and_then(|kind| serde_json::from_str(kind.get()).ok())
        .ok_or("has a geometry without a type")?;
    members(&kind, raw.coordinates, raw.geometries, wanted, depth, parts)
}

fn members(
    kind: &str,
    coordinates: Option<&RawValue>,
    geometries: Option<&RawValue>,
    wanted: &SourceOptions,
    depth: usize,
    parts: &mut Vec<Geometry>,
) -> Result<(), String> {
    if kind == "GeometryCollection" {
        let Some(list) = geometries else { return Ok(()) };
        if depth >= DEEPEST {
            return Err(format!("has collections nested more than {DEEPEST} deep"));
        }
        let list: Vec<&RawValue> =
            serde_json::from_str(list.get()).map_err(|_| "has a collection that is not a list")?;
        return list
            .into_iter()
            .filter(|inner| inner.get() != "null")
            .try_for_each(|inner| geometry(inner, wanted, depth + 1, parts));
    }
    if !is_known(kind) {
        return Err(format!("has a geometry of unknown type \"{}\"", shown(kind)));
    }
    // Some programs write an empty list for a feature without a position.
    let Some(text) = coordinates.map(RawValue::get).filter(|text| !is_empty(text)) else { return Ok(()) };
    let budget = &*wanted.budget;
    // A point needs 24 bytes, and its text at least 6.
    let _held = (text.len() > LARGE)
        .then(|| budget.hold(text.len().saturating_mul(4)))
        .transpose()
        .map_err(|error| error.into_message())?;
    match kind {
        "Point" => parts.push(Geometry::point(read_as(text, PointSeed(budget))?)),
        "MultiPoint" => {
            parts.extend(read_as(text, ListOf(PointSeed(budget)))?.into_iter().map(Geometry::point))
        }
        "LineString" => parts.extend(Geometry::line(read_as(text, ListOf(PointSeed(budget)))?)),
        "MultiLineString" => {
            parts.extend(
                read_as(text, ListOf(ListOf(PointSeed(budget))))?.into_iter().filter_map(Geometry::line),
            );
        }
        "Polygon" => parts.extend(Geometry::polygon(read_as(text, ListOf(ListOf(PointSeed(budget))))?)),
        _ => {
            let polygons = read_as(text, ListOf(ListOf(ListOf(PointSeed(budget)))))?;
            parts.extend(polygons.into_iter().filter_map(Geometry::polygon));
        }
    }
    Ok(())
}

/// Returns true if a text is an empty list.
fn is_empty(text: &str) -> bool {
    text.strip_prefix('[')
        .and_then(|rest| rest.strip_suffix(']'))
        .is_some_and(|inside| inside.trim().is_empty())
}

fn read_as<'t, S: DeserializeSeed<'t>>(text: &'t str, seed: S) -> Result<S::Value, String> {
    let mut parser = serde_json::Deserializer::from_str(text);
    seed.deserialize(&mut parser).map_err(|error| {
        let why = parser_message(&error);
        if why.starts_with("has ") { why } else { format!("has coordinates that cannot be read: {why}") }
    })
}

/// Point.
#[derive(Clone, Copy)]
struct PointSeed<'b>(&'b Budget);

impl<'t> DeserializeSeed<'t> for PointSeed<'_> {
    type Value = DVec3;

    fn deserialize<D: Deserializer<'t>>(self, deserializer: D) -> Result<DVec3, D::Error> {
        self.0.tick().map_err(|error| D::Error::custom(error.message()))?;
        deserializer.deserialize_any(self)
    }
}

impl<'t> Visitor<'t> for PointSeed<'_> {
    type Value = DVec3;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a point")
    }

    fn visit_seq<A: SeqAccess<'t>>(self, mut list: A) -> Result<DVec3, A::Error> {
        let mut point = DVec3::ZERO;
        let mut count = 0;
        while count < 3
            && let Some(Number(number)) = list.next_element()?
        {
            point[count] = number;
            count += 1;
        }
        if count < 2 {
            return Err(A::Error::custom("has a point of fewer than two numbers"));
        }
        while list.next_element::<IgnoredAny>()?.is_some() {}
        Ok(point)
    }

    no_list!('t, DVec3);
}

/// Coordinate of a point.
struct Number(f64);

impl<'t> Deserialize<'t> for Number {
    fn deserialize<D: Deserializer<'t>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(NumberVisitor)
    }
}

struct NumberVisitor;

impl<'t> Visitor<'t> for NumberVisitor {
    type Value = Number;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a number")
    }

    fn visit_f64<E>(self, value: f64) -> Result<Number, E> {
        Ok(Number(value))
    }

    #[allow(clippy::cast_precision_loss, reason = "coordinates are far below 2^53")]
    fn visit_i64<E>(self, value: i64) -> Result<Number, E> {
        Ok(Number(value as f64))
    }

    #[allow(clippy::cast_precision_loss, reason = "coordinates are far below 2^53")]
    fn visit_u64<E>(self, value: u64) -> Result<Number, E> {
        Ok(Number(value as f64))
    }

    fn visit_bool<E: serde::de::Error>(self, _: bool) -> Result<Number, E> {
        Err(E::custom("has a boolean instead of a number in its coordinates"))
    }

    fn visit_str<E: serde::de::Error>(self, _: &str) -> Result<Number, E> {
        Err(E::custom("has text instead of a number in its coordinates"))
    }

    fn visit_unit<E: serde::de::Error>(self) -> Result<Number, E> {
        Err(E::custom("has null instead of a number in its coordinates"))
    }

    fn visit_seq<A: SeqAccess<'t>>(self, _: A) -> Result<Number, A::Error> {
        Err(A::Error::custom("has a list instead of a number in its coordinates"))
    }

    fn visit_map<A: MapAccess<'t>>(self, _: A) -> Result<Number, A::Error> {
        Err(A::Error::custom("has an object instead of a number in its coordinates"))
    }
}

/// List of items that `S` reads.
#[derive(Clone, Copy)]
struct ListOf<S>(S);

impl<'t, S: DeserializeSeed<'t> + Copy> DeserializeSeed<'t> for ListOf<S> {
    type Value = Vec<S::Value>;

    fn deserialize<D: Deserializer<'t>>(self, deserializer: D) -> Result<Self::Value, D::Error> {
        deserializer.deserialize_any(self)
    }
}

impl<'t, S: DeserializeSeed<'t> + Copy> Visitor<'t> for ListOf<S> {
    type Value = Vec<S::Value>;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a list")
    }

    fn visit_seq<A: SeqAccess<'t>>(self, mut list: A) -> Result<Self::Value, A::Error> {
        let mut items = Vec::new();
        while let Some(item) = list.next_element_seed(self.0)? {
            items.push(item);
        }
        Ok(items)
    }

    no_list!('t, Vec<S::Value>);
}
