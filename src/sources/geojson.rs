//! Reads GeoJSON.
//!
//! Source: RFC 7946; the `crs` member is that of the GeoJSON of 2008, which programs still write.

use std::fmt;
use std::path::Path;
use std::sync::Arc;

use rustc_hash::FxHashMap;
use serde::Deserialize;
use serde::de::{Deserializer, SeqAccess, Visitor};
use serde_json::{Map, Value};

use super::{Attribute, Crs, Geometry, Table};
use crate::error::{Error, Result};

/// The largest file (bytes) that is read; it takes about five times as much memory.
pub(super) const LARGEST: u64 = 500_000_000;

#[derive(Deserialize)]
struct Document {
    r#type: Option<Value>,
    features: Option<Vec<RawFeature>>,
    crs: Option<Value>,
    name: Option<Value>,
    // A document may be a single feature or a geometry.
    #[serde(flatten)]
    rest: Map<String, Value>,
}

#[derive(Deserialize)]
struct RawFeature {
    id: Option<Value>,
    properties: Option<Map<String, Value>>,
    geometry: Option<RawGeometry>,
}

#[derive(Deserialize)]
struct RawGeometry {
    r#type: String,
    #[serde(default)]
    coordinates: Coordinates,
}

/// Numbers in lists in lists.
enum Coordinates {
    Number(f64),
    List(Vec<Coordinates>),
}

impl Default for Coordinates {
    fn default() -> Self {
        Self::List(Vec::new())
    }
}

impl<'de> Deserialize<'de> for Coordinates {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> std::result::Result<Self, D::Error> {
        struct Numbers;
        impl<'de> Visitor<'de> for Numbers {
            type Value = Coordinates;

            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("coordinates: numbers in lists")
            }

            fn visit_f64<E>(self, value: f64) -> std::result::Result<Coordinates, E> {
                Ok(Coordinates::Number(value))
            }

            #[allow(clippy::cast_precision_loss, reason = "coordinates are far below 2^53")]
            fn visit_i64<E>(self, value: i64) -> std::result::Result<Coordinates, E> {
                Ok(Coordinates::Number(value as f64))
            }

            #[allow(clippy::cast_precision_loss, reason = "coordinates are far below 2^53")]
            fn visit_u64<E>(self, value: u64) -> std::result::Result<Coordinates, E> {
                Ok(Coordinates::Number(value as f64))
            }

            // Some programs write null where a feature has no place; it is refused alone, not with its file.
            fn visit_unit<E>(self) -> std::result::Result<Coordinates, E> {
                Ok(Coordinates::default())
            }

            fn visit_seq<A: SeqAccess<'de>>(self, mut list: A) -> std::result::Result<Coordinates, A::Error> {
                let mut items = Vec::new();
                while let Some(item) = list.next_element()? {
                    items.push(item);
                }
                Ok(Coordinates::List(items))
            }
        }
        deserializer.deserialize_any(Numbers)
    }
}

/// Reads all of a file, which messages call `name`.
pub(super) fn read(bytes: &[u8], path: &Path, name: &str) -> Result<Table> {
    let bytes = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
    let binary = bytes.iter().take(1000).any(|byte| *byte == 0) || std::str::from_utf8(bytes).is_err();
    if binary {
        return Err(Error::new(format!("{name} is a binary file, neither GeoJSON nor a GeoPackage"))
            .help("convert it: ogr2ogr out.gpkg FILE"));
    }
    let document: Document = serde_json::from_slice(bytes).map_err(|error| not_json(name, bytes, &error))?;
    let (features, crs, title) = take_apart(document, name)?;
    let layer = match title {
        Some(title) if !title.is_empty() => title,
        _ => path.file_stem().map_or_else(|| name.to_owned(), |stem| stem.to_string_lossy().into_owned()),
    };
    let mut table = Table::new(&layer, name, system(crs.as_ref()));
    let mut names: FxHashMap<String, usize> = FxHashMap::default();
    for (index, feature) in features.into_iter().enumerate() {
        let id = feature
            .id
            .as_ref()
            .and_then(id_text)
            .or_else(|| feature.properties.as_ref()?.get("id").and_then(id_text))
            .unwrap_or_else(|| (index + 1).to_string());
        let mut parts = Vec::new();
        let read = feature.geometry.as_ref().map_or(Ok(()), |geometry| geometry.read(&mut parts));
        if let Err(why) = read {
            let error = Error::new(format!("feature {id} of {name} {why}"))
                .help("points, lines and polygons are read, single or as multi-geometries");
            table.refused.push((id, error.of_data()));
            continue;
        }
        let mut attributes = Vec::new();
        for (key, value) in feature.properties.unwrap_or_default() {
            let count = names.len();
            let number = *names.entry(key).or_insert_with_key(|key| {
                table.names.push(key.clone());
                count
            });
            if let Some(value) = attribute(value) {
                attributes.push((number, value));
            }
        }
        table.push(&id, parts, attributes);
    }
    Ok(table)
}

type Parts = (Vec<RawFeature>, Option<Value>, Option<String>);

/// The features of a document, whatever it is.
fn take_apart(document: Document, name: &str) -> Result<Parts> {
    let Document { r#type: kind, features, crs, name: title, mut rest } = document;
    let kind = kind.as_ref().and_then(Value::as_str).unwrap_or_default().to_owned();
    let title = title.and_then(|title| title.as_str().map(str::to_owned));
    let wrong = |error: serde_json::Error| Error::new(format!("{name} is not GeoJSON: {error}"));
    let features = match (kind.as_str(), features) {
        ("FeatureCollection", Some(features)) => features,
        ("FeatureCollection", None) => {
            return Err(Error::new(format!("{name} is not GeoJSON: its FeatureCollection has no features"))
                .help("it needs \"features\": [ ... ]"));
        }
        ("Feature", _) => vec![serde_json::from_value(Value::Object(rest)).map_err(wrong)?],
        (
            "Point" | "LineString" | "Polygon" | "MultiPoint" | "MultiLineString" | "MultiPolygon"
            | "GeometryCollection",
            _,
        ) => {
            rest.insert("type".into(), kind.into());
            let geometry = serde_json::from_value(Value::Object(rest)).map_err(wrong)?;
            vec![RawFeature { id: None, properties: None, geometry: Some(geometry) }]
        }
        ("Topology", _) => {
            return Err(Error::new(format!("{name} is TopoJSON, not GeoJSON"))
                .help("convert it: ogr2ogr out.geojson FILE"));
        }
        _ => {
            return Err(Error::new(format!("{name} is JSON, but not GeoJSON"))
                .help("it needs \"type\": \"FeatureCollection\" and \"features\": [ ... ]"));
        }
    };
    Ok((features, crs, title))
}

/// The error for text that cannot be read, with line and column.
fn not_json(name: &str, bytes: &[u8], error: &serde_json::Error) -> Error {
    let text = error.to_string();
    let why = text.rsplit_once(" at line ").map_or(text.as_str(), |(why, _)| why);
    let why = why.replace("struct Document", "an object").replace("struct RawFeature", "a feature");
    let why = why.replace("struct RawGeometry", "a geometry");
    let at = format!("line {}, column {}", error.line(), error.column());
    if error.is_eof() {
        let text = if bytes.trim_ascii().is_empty() { "it is empty" } else { "the file is cut short" };
        return Error::new(format!("{name} is not GeoJSON: it ends at {at}, where more should follow"))
            .help(format!("{text}; get it again"));
    }
    Error::new(format!("{name} is not GeoJSON: {why} ({at})")).help("GeoJSON is described in RFC 7946")
}

/// The coordinate system that a `crs` member names; WGS 84 without one.
fn system(crs: Option<&Value>) -> Result<Crs> {
    let Some(crs) = crs else { return Crs::epsg(4326) };
    let name = crs.pointer("/properties/name").and_then(Value::as_str).unwrap_or_default();
    let code = name.rsplit(':').next().and_then(|code| code.parse().ok());
    match code {
        _ if name.ends_with(":CRS84") => Crs::epsg(4326),
        Some(code) if name.to_ascii_uppercase().contains("EPSG") => Crs::epsg(code),
        _ => Err(Error::new(format!("the coordinate system {crs} of GeoJSON's crs member is not known"))
            .help("name it: source(file, { crs = 4326 })")),
    }
}

fn id_text(value: &Value) -> Option<String> {
    match value {
        Value::String(text) if !text.is_empty() => Some(text.clone()),
        Value::Number(number) => Some(match number.as_f64() {
            Some(value) if value.fract() == 0.0 && number.as_i64().is_none() && number.as_u64().is_none() => {
                value.to_string()
            }
            _ => number.to_string(),
        }),
        _ => None,
    }
}

fn attribute(value: Value) -> Option<Attribute> {
    match value {
        Value::Null => None,
        Value::Bool(value) => Some(Attribute::Boolean(value)),
        Value::Number(number) => Some(Attribute::Number(number.as_f64()?)),
        Value::String(text) => Some(Attribute::Text(text.into())),
        nested => Some(Attribute::Nested(Arc::new(nested))),
    }
}

impl RawGeometry {
    fn read(&self, parts: &mut Vec<Geometry>) -> std::result::Result<(), String> {
        let Coordinates::List(list) = &self.coordinates else {
            return Err("has coordinates that are no list".into());
        };
        if list.is_empty() && self.r#type != "GeometryCollection" {
            return Ok(());
        }
        match self.r#type.as_str() {
            "Point" => parts.push(Geometry::Point(self.coordinates.point()?)),
            "MultiPoint" => {
                for point in list {
                    parts.push(Geometry::Point(point.point()?));
                }
            }
            "LineString" => parts.extend(Geometry::line(self.coordinates.points()?)),
            "MultiLineString" => {
                for line in list {
                    parts.extend(Geometry::line(line.points()?));
                }
            }
            "Polygon" => parts.extend(Geometry::polygon(self.coordinates.rings()?)),
            "MultiPolygon" => {
                for polygon in list {
                    parts.extend(Geometry::polygon(polygon.rings()?));
                }
            }
            "GeometryCollection" => return Err("is a geometry collection".into()),
            other => return Err(format!("has a geometry of type {other:?}, which is not known")),
        }
        Ok(())
    }
}

impl Coordinates {
    fn list(&self) -> std::result::Result<&[Self], String> {
        match self {
            Self::List(list) => Ok(list),
            Self::Number(_) => Err("has a number in its coordinates where a list should be".into()),
        }
    }

    fn point(&self) -> std::result::Result<[f64; 3], String> {
        let mut point = [0.0; 3];
        let list = self.list()?;
        if list.len() < 2 {
            return Err("has a point of fewer than two numbers".into());
        }
        for (to, item) in point.iter_mut().zip(list) {
            match item {
                Self::Number(value) => *to = *value,
                Self::List(_) => return Err("has a list in its coordinates where a number should be".into()),
            }
        }
        Ok(point)
    }

    fn points(&self) -> std::result::Result<Vec<[f64; 3]>, String> {
        self.list()?.iter().map(Self::point).collect()
    }

    fn rings(&self) -> std::result::Result<Vec<Vec<[f64; 3]>>, String> {
        self.list()?.iter().map(Self::points).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn table(text: &str) -> Table {
        read(text.as_bytes(), Path::new("a.geojson"), "a.geojson").unwrap()
    }

    #[test]
    fn ids_come_from_the_feature_its_properties_or_its_place() {
        let feature = |inner: &str| {
            format!(r#"{{"type":"Feature",{inner},"geometry":{{"type":"Point","coordinates":[1,2]}}}}"#)
        };
        let features = [
            feature(r#""id":7,"properties":{"id":"b"}"#),
            feature(r#""properties":{"id":"b"}"#),
            feature(r#""properties":null"#),
            feature(r#""id":7.0,"properties":{}"#),
        ];
        let text = format!(r#"{{"type":"FeatureCollection","features":[{}]}}"#, features.join(","));
        let table = table(&text);
        let ids: Vec<&str> = table.features.iter().map(|feature| feature.id.as_str()).collect();
        assert_eq!(ids, ["7", "b", "3", "7.2"]);
        assert_eq!((table.layer.as_str(), table.crs.unwrap().code), ("a", Some(4326)));
    }

    #[test]
    fn a_feature_or_a_geometry_alone_is_a_layer() {
        let polygon = r#"{"type":"MultiPolygon","coordinates":[[[[0,0],[1,0],[1,1],[0,0]]],[[[5,5,2],[6,5,2],[6,6,2],[5,5,2]]],[]]}"#;
        assert_eq!(table(polygon).features.len(), 2);
        let feature =
            format!(r#"{{"type":"Feature","properties":{{"a":1,"b":null,"c":[1]}},"geometry":{polygon}}}"#);
        let table = table(&feature);
        assert_eq!((table.features.len(), table.names.len(), table.features[1].attributes.len()), (2, 3, 2));
        assert!(table.features[1].geometry.points().all(|point| point[2] == 2.0));
    }

    #[test]
    fn features_without_geometry_are_counted() {
        let text = r#"{"type":"FeatureCollection","features":[
            {"type":"Feature","properties":{},"geometry":null},
            {"type":"Feature","properties":{},"geometry":{"type":"Polygon","coordinates":[]}},
            {"type":"Feature","properties":{},"geometry":{"type":"Polygon","coordinates":[[[0,0],[1,1],[0,0]]]}}]}"#;
        assert_eq!((table(text).empty, table(text).features.len()), (3, 0));
    }
}
