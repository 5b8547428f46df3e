//! Reader of CityJSON, and of CityJSONSeq with one object per line.

use std::borrow::Cow;
use std::fmt;
use std::sync::Arc;

use rustc_hash::FxHashMap;
use serde::Deserialize;
use serde::de::{Deserializer, MapAccess, Visitor};
use serde_json::Value;
use serde_json::value::RawValue;

use super::boundaries::{CityGeometry, CityVertices, Transform, add_geometry};
use super::model::{CityRecord, CityValue};
use crate::content::DataFile;
use crate::features::table::FeatureTable;
use crate::formats::typing::TextTypes;
use crate::layered_file::LayeredFile;
use crate::source_options::SourceOptions;
use burgeon_base::budget::Budget;
use burgeon_base::error::{Error, Result};
use burgeon_base::text::shown;
use burgeon_kit::Attribute;
use burgeon_spatial::Crs;

/// Maximum file size (bytes).
const LARGEST: u64 = 1_000_000_000;

/// Number of first bytes that are searched for CityJSON keys.
const HEAD: usize = 1024;

/// Memory (bytes) needed while an object is read, per byte of its text.
const AROUND: usize = 8;

/// CityJSON file.
pub(crate) struct CityJson {
    file: DataFile,
    types: Vec<String>,
}

/// Document: the model, or an object of a sequence.
#[derive(Deserialize)]
struct CityJsonDocument<'a> {
    r#type: Option<String>,
    #[serde(default)]
    transform: Option<Transform>,
    #[serde(borrow, default)]
    metadata: Option<&'a RawValue>,
    #[serde(borrow, default, rename = "CityObjects")]
    objects: Option<ObjectList<'a>>,
    #[serde(default)]
    vertices: Vec<Vec<f64>>,
}

/// Objects by id, in file order.
struct ObjectList<'a>(Vec<(String, &'a RawValue)>);

impl<'de: 'a, 'a> Deserialize<'de> for ObjectList<'a> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> std::result::Result<Self, D::Error> {
        struct ListVisitor;

        impl<'de> Visitor<'de> for ListVisitor {
            type Value = ObjectList<'de>;

            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("an object")
            }

            fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> std::result::Result<Self::Value, A::Error> {
                let mut list = Vec::new();
                while let Some(entry) = map.next_entry::<String, &'de RawValue>()? {
                    list.push(entry);
                }
                Ok(ObjectList(list))
            }
        }
        deserializer.deserialize_map(ListVisitor)
    }
}

/// Object as stored in the file.
#[derive(Deserialize)]
struct RawObject<'a> {
    #[serde(default)]
    attributes: Option<serde_json::Map<String, Value>>,
    #[serde(borrow, default)]
    geometry: Vec<CityGeometry<'a>>,
    #[serde(default)]
    parents: Vec<String>,
    #[serde(default)]
    children: Vec<String>,
}

impl CityJson {
    /// Returns true if a file that begins with `head` is CityJSON.
    pub(crate) fn is_one(head: &[u8]) -> bool {
        let head = String::from_utf8_lossy(&head[..head.len().min(HEAD)]);
        let text = head.trim_start_matches('\u{feff}').trim_start();
        text.starts_with('{') && (text.contains("\"CityJSON") || text.contains("\"CityObjects\""))
    }

    pub(crate) fn open(file: DataFile, wanted: &SourceOptions) -> Result<Self> {
        let mut found = Self { file, types: Vec::new() };
        let mut types: Vec<String> = Vec::new();
        found.each(wanted, |document| {
            for (_, text) in document.objects.iter().flat_map(|list| &list.0) {
                wanted.budget.tick()?;
                let object: ObjectType = serde_json::from_str(text.get()).unwrap_or_default();
                let name = object.r#type.unwrap_or_default();
                if !name.is_empty() && !types.contains(&name) && types.len() < 1000 {
                    types.push(name);
                }
            }
            Ok(())
        })?;
        if types.is_empty() {
            return Err(Error::data(format!("{} is CityJSON without city objects", found.file.name))
                .help("it needs \"CityObjects\": { \"id\": { \"type\": \"Building\", ... } }"));
        }
        // Parts are read with their parent object; they can also be requested as a layer.
        types.sort_by_key(|name| name.ends_with("Part"));
        found.types = types;
        Ok(found)
    }

    /// Calls `each` with the model, or with the objects of a sequence one by one.
    fn each(
        &self,
        wanted: &SourceOptions,
        mut each: impl FnMut(CityJsonDocument<'_>) -> Result<()>,
    ) -> Result<()> {
        let bytes = self.file.bytes(LARGEST, &wanted.budget)?;
        let name = &self.file.name;
        let result = self.each_of(&bytes, wanted, &mut each);
        if let crate::content::Content::File(_) = self.file.content {
            wanted.budget.give(bytes.len());
        }
        result.map_err(|error| error.about(name))
    }

    fn each_of(
        &self,
        bytes: &[u8],
        wanted: &SourceOptions,
        each: &mut impl FnMut(CityJsonDocument<'_>) -> Result<()>,
    ) -> Result<()> {
        let name = &self.file.name;
        let text = std::str::from_utf8(bytes).map_err(|_| {
            Error::data(format!("{name} is not UTF-8, which CityJSON requires"))
                .help("convert it: iconv -f ENCODING -t UTF-8 IN > OUT.city.json")
        })?;
        let text = text.trim_start_matches('\u{feff}');
        // Vertices and boundaries are numbers, each of which needs more memory than its text.
        let mut documents = serde_json::Deserializer::from_str(text).into_iter::<&RawValue>();
        let mut transform: Option<Transform> = None;
        let mut first = true;
        loop {
            let before = documents.byte_offset();
            let Some(document) = documents.next() else { break };
            wanted.budget.check()?;
            let line = || text[..before].matches('\n').count() + 1;
            let broken = |error: &serde_json::Error| {
                let text = error.to_string();
                let why = if error.is_eof() { "it is cut short".into() } else { shown(&text) };
                Error::data(format!("{name} is not CityJSON: {why}, from line {} on", line()))
                    .help("CityJSON is described at https://www.cityjson.org/specs")
            };
            let document = document.map_err(|error| broken(&error))?;
            let _held = wanted.budget.hold(document.get().len().saturating_mul(AROUND))?;
            let mut read: CityJsonDocument<'_> =
                serde_json::from_str(document.get()).map_err(|error| broken(&error))?;
            let is_known = matches!(read.r#type.as_deref(), Some("CityJSON" | "CityJSONFeature"));
            if first && !is_known {
                return Err(Error::data(format!("{name} is JSON, but not CityJSON"))
                    .help("it needs \"type\": \"CityJSON\""));
            }
            first = false;
            // The first document of a sequence contains the transform for all.
            match &read.transform {
                Some(own) => transform = Some(own.clone()),
                None => read.transform.clone_from(&transform),
            }
            each(read)?;
        }
        Ok(())
    }
}

/// Type of an object.
#[derive(Deserialize, Default)]
struct ObjectType {
    r#type: Option<String>,
}

impl LayeredFile for CityJson {
    fn format(&self) -> &'static str {
        "CityJSON"
    }

    fn layers(&self) -> Vec<&str> {
        self.types.iter().map(String::as_str).collect()
    }

    fn read(&self, layer: &str, wanted: &SourceOptions) -> Result<FeatureTable> {
        let label = match self.types.len() {
            1 => Cow::Borrowed(self.file.name.as_str()),
            _ => format!("{}:{}", self.file.name, shown(layer)).into(),
        };
        let none = Error::data("the layer has no coordinate system")
            .help("specify its EPSG code: source(file, { crs = 3067 })");
        let mut table = FeatureTable::new(layer, &label, Err(none), wanted);
        let mut types = TextTypes::default();
        self.each(wanted, |document| read_document(document, layer, &mut table, &mut types, wanted))?;
        types.finish(&mut table)?;
        Ok(table)
    }
}

/// Adds the features of one type in a document.
fn read_document(
    document: CityJsonDocument<'_>,
    layer: &str,
    table: &mut FeatureTable,
    types: &mut TextTypes,
    wanted: &SourceOptions,
) -> Result<()> {
    let metadata: Option<Value> = document.metadata.and_then(|text| serde_json::from_str(text.get()).ok());
    if let Some(name) =
        metadata.as_ref().and_then(|metadata| metadata.get("referenceSystem")).and_then(Value::as_str)
    {
        table.crs = system_named(name);
    }
    let CityJsonDocument { objects, vertices, transform, .. } = document;
    let vertices = CityVertices { places: vertices, transform };
    let objects = objects.map(|list| list.0).unwrap_or_default();
    let places: FxHashMap<&str, &RawValue> = objects.iter().map(|(id, text)| (id.as_str(), *text)).collect();
    for (id, text) in &objects {
        wanted.budget.tick()?;
        if table.is_full() {
            return Ok(());
        }
        let of_type: ObjectType = serde_json::from_str(text.get()).unwrap_or_default();
        if of_type.r#type.as_deref() != Some(layer) {
            continue;
        }
        match object(id, text, &vertices, &places, &wanted.budget)? {
            Ok(object) => object.add_to(table, types, &wanted.budget)?,
            Err(why) => {
                let error = Error::data(format!("object {} of {} {why}", shown(id), table.shown));
                table.refuse(id.clone(), error.help("check the file with cjval or val3dity"))?;
            }
        }
    }
    Ok(())
}

/// Returns the coordinate system of a reference. Its coordinates are always in the order east, north, height.
fn system_named(name: &str) -> Result<Crs> {
    let code = name.rsplit(['/', ':']).next().and_then(|code| code.parse().ok());
    let code: u32 = code.ok_or_else(|| {
        Error::data(format!("unknown coordinate system \"{}\"", shown(name)))
            .help("specify its EPSG code: source(file, { crs = 3067 })")
    })?;
    Crs::epsg(code).or_else(|_| Crs::epsg(horizontal(code)))
}

/// Returns the horizontal part of a compound coordinate system that the registry does not contain.
fn horizontal(code: u32) -> u32 {
    match code {
        4979 | 9518 | 9707 => 4326,
        7415 => 28992,
        5554 => 25831,
        5555 => 25832,
        5556 => 25833,
        5971..=5976 => 25_831 + code - 5971,
        6697 => 6668,
        7405 => 27700,
        7409 | 7423 => 4258,
        8801..=8803 => 3812,
        code => code,
    }
}

/// Returns an object with its parts. Fails with the reason.
fn object(
    id: &str,
    text: &RawValue,
    vertices: &CityVertices,
    others: &FxHashMap<&str, &RawValue>,
    budget: &Budget,
) -> Result<std::result::Result<CityRecord, String>> {
    let mut made = match single(id, text, vertices, budget)? {
        Ok(made) => made,
        Err(why) => return Ok(Err(why)),
    };
    for child in &made.1 {
        let Some(text) = others.get(child.as_str()) else { continue };
        let of_type: ObjectType = serde_json::from_str(text.get()).unwrap_or_default();
        if !of_type.r#type.is_some_and(|name| name.ends_with("Part")) {
            continue;
        }
        match single(child, text, vertices, budget)? {
            Ok((part, _)) => made.0.parts.push(part),
            Err(why) => return Ok(Err(why)),
        }
    }
    Ok(Ok(made.0))
}

/// Object without its parts, and the ids of its children.
type SingleObject = (CityRecord, Vec<String>);

fn single(
    id: &str,
    text: &RawValue,
    vertices: &CityVertices,
    budget: &Budget,
) -> Result<std::result::Result<SingleObject, String>> {
    budget.tick()?;
    let raw: RawObject<'_> = match serde_json::from_str(text.get()) {
        Ok(raw) => raw,
        Err(error) => return Ok(Err(format!("cannot be read: {}", shown(&error.to_string())))),
    };
    let mut made = CityRecord { id: Some(id.to_owned()), ..CityRecord::default() };
    for (name, value) in raw.attributes.unwrap_or_default() {
        let value = match value {
            Value::Null => continue,
            Value::Bool(value) => Attribute::Boolean(value),
            Value::String(text) => Attribute::Text(text.into()),
            Value::Number(number) => match number.as_f64() {
                Some(number) => Attribute::Number(number),
                None => continue,
            },
            nested => Attribute::Nested(Arc::new(nested)),
        };
        made.values.push((name.into(), CityValue::Known(value)));
    }
    if let Some(parent) = raw.parents.first() {
        made.values.push(("parent".into(), CityValue::Known(Attribute::Text(parent.as_str().into()))));
    }
    for geometry in &raw.geometry {
        if let Err(why) = add_geometry(geometry, vertices, &mut made.shape, budget)? {
            return Ok(Err(why));
        }
    }
    Ok(Ok((made, raw.children)))
}
