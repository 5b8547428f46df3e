//! Reader of GeoJSON, feature by feature.

use crate::content::stem;
use std::borrow::Cow;
use std::path::Path;
use std::sync::Arc;

use super::document::{DocumentHeader, read_document};
use super::geometry;
use super::parser::{LARGE, parser_message};
use crate::codepages::{GuessedText, guess};
use crate::features::table::FeatureTable;
use crate::source_options::SourceOptions;
use burgeon_base::error::{Error, Result};
use burgeon_base::text::shown;
use burgeon_kit::Attribute;
use burgeon_spatial::Crs;
use serde::Deserialize;
use serde_json::value::RawValue;
use serde_json::{Map, Value};

/// Maximum file size (bytes).
pub(crate) const LARGEST: u64 = 500_000_000;

/// Separator before each text of a sequence.
pub(super) const RECORD: char = '\u{1e}';

#[derive(Deserialize)]
struct RawFeature<'a> {
    #[serde(borrow)]
    id: Option<&'a RawValue>,
    #[serde(borrow)]
    properties: Option<&'a RawValue>,
    #[serde(borrow)]
    geometry: Option<&'a RawValue>,
}

/// Returns true if the extension of a file is one of document sequences.
pub(super) fn is_sequence(path: &Path) -> bool {
    let extension = path.extension().unwrap_or_default().to_string_lossy().to_ascii_lowercase();
    crate::SEQUENCES.contains(&&*extension)
}

/// Reads a whole file, called `name` in messages.
pub(crate) fn read(bytes: &[u8], path: &Path, name: &str, wanted: &SourceOptions) -> Result<FeatureTable> {
    let bytes = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
    // Text in another encoding is converted, with up to three bytes for each byte.
    let _held =
        std::str::from_utf8(bytes).is_err().then(|| wanted.budget.hold(bytes.len() * 3)).transpose()?;
    let (text, encoding) = match guess(bytes) {
        Some(GuessedText::Utf8(text)) if !bytes.iter().take(1000).any(|byte| *byte == 0) => {
            (Cow::Borrowed(text), None)
        }
        Some(GuessedText::Other(text, encoding)) => (Cow::Owned(text), Some(encoding)),
        _ => {
            return Err(Error::data(format!("{name} is a binary file of unknown format"))
                .help(format!("{}; convert it: ogr2ogr out.gpkg FILE", crate::foreign::FORMATS)));
        }
    };
    let text = &*text;
    let mut reader = FeatureReader::new(path, name, wanted);
    if let Some(encoding) = encoding {
        reader.table.notes.push(format!(
            "{name} is not UTF-8, which GeoJSON requires, and was read as {encoding}; if its texts look wrong, convert it: iconv -f ENCODING -t UTF-8 IN > OUT.geojson"
        ));
    }
    if text.trim_start().starts_with(RECORD) {
        reader.records(text)?;
    } else {
        reader.documents(text, is_sequence(path))?;
    }
    Ok(reader.table)
}

/// State of the reader.
pub(super) struct FeatureReader<'a> {
    table: FeatureTable,
    name: &'a str,
    wanted: &'a SourceOptions,
    /// Number of features so far.
    records: usize,
    /// Error that must end the reading, because the parser cannot pass it on.
    pub(super) failure: Option<Error>,
}

impl<'a> FeatureReader<'a> {
    /// Creates a reader of the file at `path`, called `name` in messages.
    pub(super) fn new(path: &Path, name: &'a str, wanted: &'a SourceOptions) -> Self {
        let table = FeatureTable::new(&stem(path, name), name, Crs::epsg(4326), wanted);
        Self { table, name, wanted, records: 0, failure: None }
    }

    /// Returns the table of features.
    pub(super) fn into_table(self) -> FeatureTable {
        self.table
    }

    /// Reads the texts of a sequence with separators.
    fn records(&mut self, text: &str) -> Result<()> {
        let mut line = 1;
        for record in text.split(RECORD) {
            if !record.trim().is_empty() {
                match self.text(record) {
                    Ok((head, rest)) if rest.trim().is_empty() => self.member(head)?,
                    Ok(_) => self.refuse_line(line, "contains more than one text between separators")?,
                    Err(why) => self.refuse_text(line, &why)?,
                }
            }
            line += lines(record);
        }
        Ok(())
    }

    /// Reads one document, or several consecutive documents.
    fn documents(&mut self, text: &str, is_sequence: bool) -> Result<()> {
        let (mut rest, mut line, mut first) = (text, 1, !is_sequence);
        loop {
            let blank = rest.len() - rest.trim_start().len();
            line += lines(&rest[..blank]);
            rest = &rest[blank..];
            if rest.is_empty() && !first {
                return Ok(());
            }
            match self.text(rest) {
                // Only a single document may name the layer.
                Ok((head, after)) if first && after.trim().is_empty() => return self.take_whole(head),
                Ok((head, after)) => {
                    self.member(head)?;
                    line += lines(&rest[..rest.len() - after.len()]);
                    rest = after;
                }
                Err(error) if first => return Err(not_json(self.name, text, &error)),
                Err(error) => {
                    self.refuse_text(line, &error)?;
                    rest = rest.find('\n').map_or("", |end| &rest[end..]);
                }
            }
            first = false;
        }
    }

    /// Reads one text, and adds the features of its collection; returns its other members and the rest of the text.
    pub(super) fn text<'t>(
        &mut self,
        text: &'t str,
    ) -> Result<(DocumentHeader<'t>, &'t str), serde_json::Error> {
        let mut take = |feature: &str| match self.raw_feature(feature) {
            Ok(()) => true,
            Err(error) => {
                self.failure = Some(error);
                false
            }
        };
        read_document(&mut take, text)
    }

    /// Processes a document that is the whole file.
    pub(super) fn take_whole(&mut self, head: DocumentHeader<'_>) -> Result<()> {
        self.stop()?;
        self.table.crs = system(head.crs.as_ref());
        if let Some(title) = head.name.as_ref().and_then(Value::as_str).filter(|title| !title.is_empty()) {
            self.table.layer = title.to_owned();
        }
        self.take(head, true)
    }

    /// Processes a text of a sequence, which may specify the coordinate system of all.
    pub(super) fn member(&mut self, head: DocumentHeader<'_>) -> Result<()> {
        self.stop()?;
        if head.crs.is_some() {
            self.table.crs = system(head.crs.as_ref());
        }
        self.take(head, false)
    }

    /// Adds the content of a text: a feature or a geometry; the features of a collection were already added.
    fn take(&mut self, head: DocumentHeader<'_>, alone: bool) -> Result<()> {
        let name = self.name;
        let kind = head.kind.as_ref().and_then(Value::as_str).unwrap_or_default();
        let error = match kind {
            "FeatureCollection" if head.features => return Ok(()),
            "FeatureCollection" => {
                Error::data(format!("{name} is not GeoJSON: its FeatureCollection has no features"))
                    .help("it needs \"features\": [ ... ]")
            }
            "Feature" if !head.features => {
                let DocumentHeader { id, properties, geometry, .. } = head;
                return self.feature(&RawFeature { id, properties, geometry });
            }
            kind if geometry::is_known(kind) && !head.features => {
                let parts = geometry::of_members(kind, head.coordinates, head.geometries, self.wanted);
                let number = self.number();
                let bounds = head.coordinates.or(head.geometries).and_then(|text| self.bounds(text));
                return self.add((number, None), parts, Vec::new(), bounds);
            }
            "Topology" => Error::data(format!("{name} is TopoJSON, not GeoJSON"))
                .help("convert it: ogr2ogr out.geojson FILE"),
            _ => Error::data(format!("{name} is JSON, but not GeoJSON"))
                .help("it needs \"type\": \"FeatureCollection\" and \"features\": [ ... ]"),
        };
        if alone {
            return Err(error);
        }
        let number = self.number();
        self.refuse(number.to_string(), "is JSON, but neither a feature nor a geometry")
    }

    /// Returns the error that must end the reading, if any.
    fn stop(&mut self) -> Result<()> {
        self.failure.take().map_or_else(|| self.wanted.budget.check(), Err)
    }

    /// Returns the number of the next feature, from 1.
    fn number(&mut self) -> usize {
        self.records += 1;
        self.records
    }

    /// Reads the text of one feature in a list.
    pub(super) fn raw_feature(&mut self, text: &str) -> Result<()> {
        self.wanted.budget.tick()?;
        // A later member may still specify the coordinate system.
        if self.table.is_full() {
            return Ok(());
        }
        match serde_json::from_str::<RawFeature<'_>>(text) {
            Ok(feature) => self.feature(&feature),
            Err(error) => {
                let number = self.number();
                self.refuse(number.to_string(), &format!("is not a feature: {}", parser_message(&error)))
            }
        }
    }

    fn feature(&mut self, feature: &RawFeature<'_>) -> Result<()> {
        let number = self.number();
        let own = feature.id.and_then(id_of);
        let length = feature.properties.map_or(0, |properties| properties.get().len());
        // A value needs up to 40 bytes, and its text at least 2.
        let _held =
            (length > LARGE).then(|| self.wanted.budget.hold(length.saturating_mul(20))).transpose()?;
        let properties =
            feature.properties.map(|text| serde_json::from_str::<Map<String, Value>>(text.get()));
        let properties = match properties.transpose() {
            Ok(properties) => properties.unwrap_or_default(),
            Err(error) => {
                let id = own.unwrap_or_else(|| number.to_string());
                return self
                    .refuse(id, &format!("has properties that cannot be read: {}", parser_message(&error)));
            }
        };
        let id = own.or_else(|| properties.get("id").and_then(id_text));
        let mut attributes = Vec::new();
        for (key, value) in properties {
            let number = self.table.name(&key);
            let value = match value {
                Value::String(text) => Some(self.table.text(&text)),
                value => attribute(value),
            };
            attributes.extend(value.map(|value| (number, value)));
        }
        let parts = feature.geometry.map_or(Ok(Vec::new()), |text| geometry::read(text, self.wanted));
        let is_left_out = parts.as_ref().map_or(true, Vec::is_empty);
        let bounds = feature.geometry.filter(|_| is_left_out).and_then(|text| self.bounds(text));
        self.add((number, id), parts, attributes, bounds)
    }

    /// Returns the bounds of the points found in the text of a geometry that cannot be read.
    fn bounds(&self, text: &RawValue) -> Option<[f64; 4]> {
        let _held = self.wanted.budget.hold(text.get().len().saturating_mul(20)).ok()?;
        let value: Value = serde_json::from_str(text.get()).ok()?;
        let mut bounds: Option<[f64; 4]> = None;
        let mut rest = vec![&value];
        while let Some(value) = rest.pop() {
            match value {
                Value::Object(fields) => rest.extend(fields.values()),
                Value::Array(items) => {
                    match (items.first().and_then(Value::as_f64), items.get(1).and_then(Value::as_f64)) {
                        (Some(x), Some(y)) => {
                            let [west, south, east, north] = bounds.get_or_insert([x, y, x, y]);
                            (*west, *south, *east, *north) =
                                (west.min(x), south.min(y), east.max(x), north.max(y));
                        }
                        _ => rest.extend(items),
                    }
                }
                _ => {}
            }
        }
        bounds
    }

    /// Adds the feature with a number and an optional id, or refuses it with the reason. `bounds` are the bounds of the
    /// points of a feature without a valid geometry.
    fn add(
        &mut self,
        (number, id): (usize, Option<String>),
        parts: Result<Vec<crate::Geometry>, String>,
        attributes: Vec<(usize, Attribute)>,
        bounds: Option<[f64; 4]>,
    ) -> Result<()> {
        match (parts, id) {
            (Ok(parts), id) if parts.is_empty() => {
                self.wanted.budget.tick()?;
                let id = id.unwrap_or_else(|| number.to_string());
                self.table.add_empty_record(&id, &attributes, bounds);
                Ok(())
            }
            (Ok(parts), Some(id)) => self.table.push(&id, parts, attributes),
            (Ok(parts), None) => self.table.push_unnamed(parts, attributes),
            (Err(why), id) => {
                // The error may be an exceeded time limit instead of an invalid geometry.
                self.wanted.budget.check()?;
                self.refuse_at(id.unwrap_or_else(|| number.to_string()), &why, bounds)
            }
        }
    }

    fn refuse(&mut self, id: String, why: &str) -> Result<()> {
        self.refuse_at(id, why, None)
    }

    fn refuse_at(&mut self, id: String, why: &str, bounds: Option<[f64; 4]>) -> Result<()> {
        let error = Error::data(format!("feature {} of {} {why}", shown(&id), self.name))
            .help("supported types are points, lines, polygons, multi-geometries and collections of these");
        self.table.refuse_at(id, error, bounds)
    }

    /// Refuses a text of a sequence that is not JSON, unless the reading must end.
    fn refuse_text(&mut self, line: usize, error: &serde_json::Error) -> Result<()> {
        self.stop()?;
        self.refuse_line(line, &format!("is not JSON: {}", parser_message(error)))
    }

    fn refuse_line(&mut self, line: usize, why: &str) -> Result<()> {
        let number = self.number();
        let error = Error::data(format!("line {line} of {} {why}", self.name))
            .help("a sequence has one feature per line, or a separator (RS) before each");
        self.table.refuse(number.to_string(), error)
    }
}

/// Counts the line breaks in `text`.
fn lines(text: &str) -> usize {
    text.bytes().filter(|byte| *byte == b'\n').count()
}

/// Returns the error for text that cannot be parsed, with line and column.
fn not_json(name: &str, text: &str, error: &serde_json::Error) -> Error {
    let at = format!("line {}, column {}", error.line(), error.column());
    if error.is_eof() {
        let why = if text.trim_ascii().is_empty() { "it is empty" } else { "the file is cut short" };
        return Error::data(format!("{name} is not GeoJSON: it ends at {at}, but more should follow"))
            .help(format!("{why}; download it again"));
    }
    Error::data(format!("{name} is not GeoJSON: {} ({at})", parser_message(error)))
        .help("GeoJSON is described in RFC 7946")
}

/// Returns the coordinate system that a `crs` member names; WGS 84 without one.
fn system(crs: Option<&Value>) -> Result<Crs> {
    let Some(crs) = crs.filter(|crs| !crs.is_null()) else { return Crs::epsg(4326) };
    let name = crs.pointer("/properties/name").and_then(Value::as_str).unwrap_or_default();
    let code = name.rsplit(':').next().and_then(|code| code.parse().ok());
    match code {
        _ if name.ends_with(":CRS84") => Crs::epsg(4326),
        Some(code) if name.to_ascii_uppercase().contains("EPSG") => Crs::epsg(code),
        _ => {
            let crs = crs.to_string();
            let crs = shown(&crs);
            Err(Error::data(format!("unknown coordinate system {crs} in GeoJSON's crs member"))
                .help("specify it: source(file, { crs = 4326 })"))
        }
    }
}

/// Returns the id in a text; `None` if it is not a valid id.
fn id_of(text: &RawValue) -> Option<String> {
    id_text(&serde_json::from_str(text.get()).ok()?)
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
        nested => Some(Attribute::Nested(Arc::new(nested))),
    }
}
