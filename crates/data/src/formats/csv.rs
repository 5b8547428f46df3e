//! Reader of delimited text (`.csv`, `.tsv`) with a column of well-known text or with coordinate columns.
//!
//! Input: text whose first line contains the column names. Output: a [`FeatureTable`](crate::FeatureTable) with one
//! feature for each following line.
//!
//! Source: RFC 4180; delimiters and column names as programs write them.

use std::borrow::Cow;
use std::io::{BufRead, BufReader};

use crate::codepages::{CodePage, WESTERN};
use crate::content::{ContentReader, DataFile};
use crate::features::table::FeatureTable;
use crate::formats::typing::TextTypes;
use crate::layered_file::LayeredFile;
use crate::source_options::SourceOptions;
use burgeon_base::error::{Error, Result};
use burgeon_base::text::{listed, shown};
use burgeon_spatial::Crs;
use burgeon_spatial::Geometry;
use glam::DVec3;

/// Maximum length of a record (bytes).
const LONGEST: usize = 100_000_000;

/// Maximum number of columns.
const MOST_COLUMNS: usize = 10_000;

/// Names of geometry columns, in lower case.
const SHAPES: [&str; 9] =
    ["wkt", "geometry", "geom", "the_geom", "wkt_geom", "wkb_geometry", "shape", "geojson", "geo_shape"];

/// Names of coordinate columns, in pairs; the first pair found is used. The flag is true for longitude and latitude.
const PAIRS: [(&str, &str, bool); 15] = [
    ("lon", "lat", true),
    ("longitude", "latitude", true),
    ("long", "lat", true),
    ("lng", "lat", true),
    ("lon_wgs84", "lat_wgs84", true),
    ("x_wgs84", "y_wgs84", true),
    ("decimallongitude", "decimallatitude", true),
    ("stop_lon", "stop_lat", true),
    ("lon_deg", "lat_deg", true),
    ("easting", "northing", false),
    ("east", "north", false),
    ("x", "y", false),
    ("x_coord", "y_coord", false),
    ("coord_x", "coord_y", false),
    ("point_x", "point_y", false),
];

/// Names of height columns.
const HEIGHTS: [&str; 5] = ["z", "alt", "altitude", "elevation", "ele"];

/// Delimited text file.
pub(crate) struct CsvFile {
    file: DataFile,
    layer: String,
}

/// Columns that contain the position of a feature.
enum PlaceColumns {
    Shape(usize),
    Pair { x: usize, y: usize, z: Option<usize>, is_degrees: bool },
}

impl CsvFile {
    /// Returns true if the extension of a file is one of delimited text.
    pub(crate) fn is_named_so(file: &DataFile) -> bool {
        matches!(&*file.extension(), "csv" | "tsv" | "tab" | "psv")
    }

    pub(crate) fn open(file: DataFile) -> Self {
        let layer = file.stem().into_owned();
        Self { file, layer }
    }
}

impl LayeredFile for CsvFile {
    fn format(&self) -> &'static str {
        "CSV"
    }

    fn layers(&self) -> Vec<&str> {
        vec![&self.layer]
    }

    fn read(&self, layer: &str, wanted: &SourceOptions) -> Result<FeatureTable> {
        let name = &self.file.name;
        let mut records = CsvRecords::open(&self.file, wanted)?;
        let names = match records.next(wanted)? {
            Some(names) => unique(names),
            None => return Err(Error::data(format!("{name} is empty")).help("download it again")),
        };
        if names.len() > MOST_COLUMNS {
            return Err(
                Error::data(format!("{name} has {} columns", names.len())).help("check its delimiter")
            );
        }
        let place = place_columns(&names, name)?;
        let crs = match place {
            PlaceColumns::Pair { is_degrees: false, .. } => {
                Err(Error::data(format!("{name} has columns of coordinates without a coordinate system"))
                    .help("specify its EPSG code: source(file, { crs = 3067 })"))
            }
            _ => Crs::epsg(4326),
        };
        let mut table = FeatureTable::new(layer, name, crs, wanted);
        let id =
            names.iter().position(|name| name.eq_ignore_ascii_case("id")).map(|id| table.name(&names[id]));
        let mut types = TextTypes::default();
        let (mut short, mut srid) = (0, None);
        while let Some(fields) = records.next(wanted)? {
            if table.is_full() {
                break;
            }
            // An empty line is not a record.
            if fields.len() == 1 && fields[0].is_empty() {
                continue;
            }
            short += usize::from(fields.len() != names.len());
            let mut attributes = Vec::with_capacity(names.len());
            for (number, (name, value)) in names.iter().zip(&fields).enumerate() {
                let is_shape = matches!(place, PlaceColumns::Shape(shape) if shape == number);
                if !is_shape && !value.is_empty() {
                    attributes.push(types.attribute(&mut table, name, value));
                }
            }
            match parts(&place, &fields, records.comma_is_decimal, &mut srid, wanted) {
                Ok(parts) => table.push_identified(id, parts, attributes)?,
                Err(why) => {
                    wanted.budget.check()?;
                    let line = records.begin;
                    let error = Error::data(format!("line {line} of {name} {why}"));
                    table.refuse(line.to_string(), error.help("correct it, or remove it"))?;
                }
            }
        }
        if let (Some(code), None) = (srid, wanted.crs) {
            table.crs = Crs::epsg(code);
        }
        if short > 0 {
            let what = if short == 1 { "line has" } else { "lines have" };
            table.notes.push(format!(
                "{name}: {short} {what} a different number of fields from the first line, which has {}",
                names.len()
            ));
        }
        if records.guessed {
            table.notes.push(format!(
                "{name} is not UTF-8 and was read as Windows-1252 (Latin-1); if its texts look wrong, convert it: \
                 iconv -f ENCODING -t UTF-8 IN > OUT.csv"
            ));
        }
        types.finish(&mut table)?;
        Ok(table)
    }
}

/// Returns the geometry of a line, in parts. Fails with the reason.
fn parts(
    place: &PlaceColumns,
    fields: &[String],
    comma_is_decimal: bool,
    srid: &mut Option<u32>,
    wanted: &SourceOptions,
) -> std::result::Result<Vec<Geometry>, String> {
    let field = |number: usize| fields.get(number).map_or("", |text| text.trim());
    match place {
        PlaceColumns::Shape(number) => shape(field(*number), srid, wanted),
        PlaceColumns::Pair { x, y, z, .. } => {
            let number = |column: usize| {
                let text = field(column);
                let text =
                    if comma_is_decimal { Cow::Owned(text.replace(',', ".")) } else { Cow::Borrowed(text) };
                match text.parse::<f64>() {
                    Ok(number) => Ok(Some(number)),
                    Err(_) if text.is_empty() => Ok(None),
                    Err(_) => Err(format!("has \"{}\" instead of a coordinate", shown(&text))),
                }
            };
            let (x, y) = (number(*x)?, number(*y)?);
            let z = z.map(number).transpose().unwrap_or_default().flatten().unwrap_or_default();
            Ok(match (x, y) {
                (Some(x), Some(y)) => vec![Geometry::point(DVec3::new(x, y, z))],
                _ => Vec::new(),
            })
        }
    }
}

/// Returns the parts of a geometry in well-known text, hexadecimal well-known binary, or GeoJSON.
fn shape(
    text: &str,
    srid: &mut Option<u32>,
    wanted: &SourceOptions,
) -> std::result::Result<Vec<Geometry>, String> {
    if text.is_empty() || text.eq_ignore_ascii_case("null") {
        return Ok(Vec::new());
    }
    if text.starts_with('{') {
        return crate::geojson::geometry_of(text, wanted);
    }
    let is_binary =
        text.len().is_multiple_of(2) && text.len() >= 10 && text.bytes().all(|byte| byte.is_ascii_hexdigit());
    if is_binary {
        let digits = text.as_bytes().chunks_exact(2).filter_map(|pair| {
            let pair = std::str::from_utf8(pair).ok()?;
            u8::from_str_radix(pair, 16).ok()
        });
        let bytes: Vec<u8> = digits.collect();
        let near = burgeon_spatial::wkb::NEAR;
        return burgeon_spatial::wkb::read(&bytes, near, &wanted.budget).map(Geometry::into_parts);
    }
    let (code, text) = match text.split_once(';') {
        Some((code, rest)) if code.to_ascii_uppercase().starts_with("SRID=") => {
            (code[5..].trim().parse().ok(), rest)
        }
        _ => (None, text),
    };
    if code.is_some_and(|code| code != 0) {
        *srid = srid.or(code);
    }
    let read = Geometry::from_wkt_within(text, &wanted.budget).map(Geometry::into_parts);
    read.map_err(|error| format!("has a geometry that cannot be read: {}", error.message()))
}

/// Returns the columns that contain the positions of features. Fails with a remedy if there are none.
fn place_columns(names: &[String], file: &str) -> Result<PlaceColumns> {
    let plain: Vec<String> = names.iter().map(|name| name.trim().to_lowercase()).collect();
    let find = |wanted: &str| plain.iter().position(|name| name == wanted);
    if let Some(shape) = SHAPES.iter().find_map(|name| find(name)) {
        return Ok(PlaceColumns::Shape(shape));
    }
    let pair = PAIRS.iter().find_map(|(x, y, is_degrees)| Some((find(x)?, find(y)?, *is_degrees)));
    let (x, y, is_degrees) = pair.ok_or_else(|| {
        let columns = listed(names.iter().map(String::as_str));
        Error::data(format!("{file} has no columns of positions: it has {columns}")).help(
            "name them lon and lat, or x and y with crs, or write well-known text in a column named WKT",
        )
    })?;
    Ok(PlaceColumns::Pair { x, y, z: HEIGHTS.iter().find_map(|name| find(name)), is_degrees })
}

/// Makes column names unique.
fn unique(names: Vec<String>) -> Vec<String> {
    let mut known: Vec<String> = Vec::with_capacity(names.len());
    for (number, name) in names.into_iter().enumerate() {
        let name = match name.trim() {
            "" => format!("column_{}", number + 1).into(),
            name => Cow::Borrowed(name),
        };
        let mut unique = Cow::Borrowed(&*name);
        let mut count = 1;
        while known.iter().any(|known| *known == unique) && count < 1000 {
            count += 1;
            unique = format!("{name}_{count}").into();
        }
        known.push(unique.into_owned());
    }
    known
}

/// Records of a file, from the beginning.
struct CsvRecords {
    file: BufReader<ContentReader>,
    name: String,
    delimiter: u8,
    /// Set if numbers may have a decimal comma, because the delimiter is another character.
    comma_is_decimal: bool,
    /// First line of the last record, and the next line.
    begin: usize,
    line: usize,
    bytes: Vec<u8>,
    /// Set if the bytes were not UTF-8.
    guessed: bool,
}

impl CsvRecords {
    fn open(file: &DataFile, wanted: &SourceOptions) -> Result<Self> {
        let cannot =
            |error: std::io::Error| Error::file(&file.path, format!("cannot read {}: {error}", file.name));
        let reader = file.content.reader().map_err(cannot)?;
        let mut records = Self {
            file: BufReader::with_capacity(1 << 16, reader),
            name: file.name.clone(),
            delimiter: b',',
            comma_is_decimal: false,
            begin: 1,
            line: 1,
            bytes: Vec::new(),
            guessed: false,
        };
        wanted.budget.check()?;
        let head = records.file.fill_buf().map_err(cannot)?;
        if head.starts_with(b"\xff\xfe") || head.starts_with(b"\xfe\xff") {
            return Err(Error::data(format!("{} is UTF-16, which is not supported", file.name))
                .help("convert it: iconv -f UTF-16 -t UTF-8 IN > OUT.csv"));
        }
        if head.starts_with(b"\xef\xbb\xbf") {
            records.file.consume(3);
        }
        // Excel may declare the delimiter in the first line.
        let head = records.file.fill_buf().map_err(cannot)?;
        if head.starts_with(b"sep=") && head.len() > 5 {
            records.delimiter = head[4];
            let end = head.iter().position(|byte| *byte == b'\n').map_or(5, |end| end + 1);
            records.file.consume(end);
            records.line = 2;
        } else {
            records.delimiter = delimiter(head, &file.extension());
        }
        records.comma_is_decimal = records.delimiter != b',';
        Ok(records)
    }

    /// Returns the fields of the next record; `None` at the end.
    fn next(&mut self, wanted: &SourceOptions) -> Result<Option<Vec<String>>> {
        wanted.budget.tick()?;
        self.bytes.clear();
        self.begin = self.line;
        let mut quotes = QuoteState::default();
        loop {
            let before = self.bytes.len();
            let limit = LONGEST.min(wanted.budget.memory() / 8);
            let count = self.line(limit)?;
            self.line += 1;
            self.bytes[before..].iter().for_each(|byte| quotes.take(*byte, self.delimiter));
            if count == 0 && before == 0 {
                return Ok(None);
            }
            // A line break within quotes does not end the record.
            if !quotes.inside {
                break;
            }
            if count == 0 {
                return Err(Error::data(format!(
                    "{} cannot be read: a text in quotes begins in line {} and does not end",
                    self.name, self.begin
                ))
                .help("the file is cut short, or has a single quote (\") in a text"));
            }
        }
        let _held = wanted.budget.hold(self.bytes.len() * 4)?;
        let text = match std::str::from_utf8(&self.bytes) {
            Ok(text) => std::borrow::Cow::Borrowed(text),
            Err(_) => {
                self.guessed = true;
                match CodePage::of_number(WESTERN) {
                    Some(page) => page.decode(&self.bytes),
                    None => String::from_utf8_lossy(&self.bytes),
                }
            }
        };
        Ok(Some(fields(text.trim_end_matches(['\r', '\n']), char::from(self.delimiter))))
    }

    /// Reads up to the end of a line; returns the number of bytes read.
    fn line(&mut self, limit: usize) -> Result<usize> {
        let mut count = 0;
        loop {
            let cannot =
                |error: std::io::Error| Error::data(format!("{} cannot be read: {error}", self.name));
            let head = self.file.fill_buf().map_err(cannot)?;
            if head.is_empty() {
                return Ok(count);
            }
            let end = head.iter().position(|byte| *byte == b'\n').map(|end| end + 1);
            let taken = end.unwrap_or(head.len());
            if self.bytes.len() + taken > limit {
                return Err(Error::data(format!(
                    "{} cannot be read: line {} is too long",
                    self.name, self.begin
                ))
                .help("check that it is delimited text"));
            }
            self.bytes.extend(&head[..taken]);
            self.file.consume(taken);
            count += taken;
            if end.is_some() {
                return Ok(count);
            }
        }
    }
}

/// State of quotes in a record. Only a quote at the beginning of a field opens a quoted text.
#[derive(Default)]
struct QuoteState {
    inside: bool,
    /// Set if the field has begun, and if the last byte closed a quoted text.
    begun: bool,
    closed: bool,
}

impl QuoteState {
    fn take(&mut self, byte: u8, delimiter: u8) {
        let is_quote = byte == b'"';
        if self.inside {
            (self.inside, self.closed) = (!is_quote, is_quote);
        } else if is_quote && (!self.begun || self.closed) {
            (self.inside, self.begun, self.closed) = (true, true, false);
        } else {
            self.closed = false;
            self.begun = byte != delimiter && (self.begun || byte != b' ');
        }
    }
}

/// Returns the delimiter of a text: the candidate that occurs most often in the first line, outside quotes.
fn delimiter(head: &[u8], extension: &str) -> u8 {
    if matches!(extension, "tsv" | "tab") {
        return b'\t';
    }
    let line = head.split(|byte| *byte == b'\n').next().unwrap_or_default();
    let count = |delimiter: u8| {
        let mut inside = false;
        let counted = line.iter().filter(|byte| {
            inside ^= **byte == b'"';
            !inside && **byte == delimiter
        });
        counted.count()
    };
    // `max_by_key` returns the last maximum, so later candidates take precedence.
    [b'|', b'\t', b';', b','].into_iter().max_by_key(|delimiter| count(*delimiter)).unwrap_or(b',')
}

/// Splits a record into fields.
fn fields(text: &str, delimiter: char) -> Vec<String> {
    let mut fields = Vec::new();
    let mut rest = text;
    loop {
        let start = rest.trim_start_matches(' ');
        let mut field = String::new();
        if let Some(mut quoted) = start.strip_prefix('"') {
            loop {
                match quoted.split_once('"') {
                    Some((part, after)) => {
                        field.push_str(part);
                        // Two quotes in a quoted text stand for one.
                        match after.strip_prefix('"') {
                            Some(more) => {
                                field.push('"');
                                quoted = more;
                            }
                            None => {
                                quoted = after;
                                break;
                            }
                        }
                    }
                    None => {
                        field.push_str(quoted);
                        quoted = "";
                        break;
                    }
                }
            }
            match quoted.split_once(delimiter) {
                Some((extra, after)) => {
                    field.push_str(extra.trim_end());
                    fields.push(field);
                    rest = after;
                }
                None => {
                    field.push_str(quoted.trim_end());
                    fields.push(field);
                    return fields;
                }
            }
            continue;
        }
        match rest.split_once(delimiter) {
            Some((part, after)) => {
                fields.push(part.trim().to_owned());
                rest = after;
            }
            None => {
                fields.push(rest.trim().to_owned());
                return fields;
            }
        }
    }
}
