//! Reader of FlatGeobuf features.

use crate::content::stem;
use std::fs::File;
use std::io::{BufReader, Read, Seek, SeekFrom};
use std::path::Path;
use std::sync::Arc;

use super::buffer::{BufferDamage, BufferTable};
use super::geometry;
use super::header::{Column, LayerHeader, columns};
use super::index::{BoxEntry, Levels};
use crate::features::table::FeatureTable;
use crate::source_options::SourceOptions;
use burgeon_base::error::{Error, Result};
use burgeon_kit::Attribute;
use burgeon_spatial::Geometry;

/// First bytes of a file; the fourth byte is the version.
const MAGIC: &[u8] = b"fgb\x03fgb";

/// Maximum header size (bytes).
const LARGEST_HEADER: u64 = 64 << 20;

/// Relative tolerance for positions outside their declared bounds.
const ROUNDING: f64 = 1e-12;

/// Open FlatGeobuf file.
pub struct FlatGeobuf {
    file: File,
    name: String,
    layer: String,
    header: LayerHeader,
    levels: Option<Levels>,
    /// Offsets of the index and of the features, and the end of the file (bytes).
    index: u64,
    features: u64,
    end: u64,
}

impl FlatGeobuf {
    /// Returns true if a file that begins with `head` is a FlatGeobuf of any version.
    pub(crate) fn is_one(head: &[u8]) -> bool {
        head.starts_with(b"fgb") && head.get(4..7) == Some(b"fgb")
    }

    pub(crate) fn open(mut file: File, path: &Path, name: &str, wanted: &SourceOptions) -> Result<Self> {
        let damage_error = |why: &str| damage_error(name, why);
        let cannot = |error: std::io::Error| damage_error(&error.to_string());
        let end = file.seek(SeekFrom::End(0)).map_err(cannot)?;
        file.rewind().map_err(cannot)?;
        let mut head = [0; 12];
        file.read_exact(&mut head).map_err(cannot)?;
        if !head.starts_with(MAGIC) {
            return Err(Error::data(format!("{name} is a FlatGeobuf of unsupported version {}", head[3]))
                .help("re-export it: ogr2ogr out.fgb FILE"));
        }
        let (_, size) = head.split_at(8);
        let size = u64::from(u32::from_le_bytes([size[0], size[1], size[2], size[3]]));
        if size > LARGEST_HEADER || size > end - 12 {
            return Err(damage_error(&format!("it has a header of {size} bytes")));
        }
        let _held = wanted.budget.hold(usize::try_from(size).unwrap_or(usize::MAX) * 4)?;
        let mut bytes = vec![0; usize::try_from(size).unwrap_or_default()];
        file.read_exact(&mut bytes).map_err(cannot)?;
        let header = LayerHeader::read(&bytes).map_err(|why| damage_error(&format!("its header {why}")))?;
        let index = 12 + size;
        let levels = Levels::new(header.count, header.fan);
        let taken = match (&levels, header.fan > 0 && header.count > 0) {
            (Some(levels), _) => levels.size(),
            (None, wrong) => (!wrong).then_some(0),
        };
        let features = taken.and_then(|taken| index.checked_add(taken)).filter(|features| *features <= end);
        let Some(features) = features else {
            return Err(damage_error(&format!("it is too short for an index of {} features", header.count)));
        };
        let layer =
            if header.name.is_empty() { stem(path, name) } else { header.name.as_str().into() }.into_owned();
        Ok(Self { file, name: name.to_owned(), layer, header, levels, index, features, end })
    }

    pub(crate) fn layers(&self) -> Vec<&str> {
        vec![&self.layer]
    }

    pub(crate) fn read(&self, wanted: &SourceOptions) -> Result<FeatureTable> {
        let crs = self.header.crs.clone();
        let mut table = FeatureTable::new(&self.layer, &self.name, crs, wanted);
        table.names = self.header.columns.iter().map(|column| column.name.clone()).collect();
        match (&self.levels, wanted.within) {
            (Some(levels), Some(_)) => {
                let damage_error = |why: &str| damage_error(&self.name, why);
                let touch = |bounds| table.concerns(Some(bounds));
                let place = (self.index, self.header.fan);
                let found = levels.search(&self.file, place, touch, (&wanted.budget, &damage_error))?;
                let mut reader = self.reader(self.features);
                for (number, to) in found {
                    let at = self.features.checked_add(to).filter(|at| *at < self.end);
                    let at = at.ok_or_else(|| damage_error("its index refers to data after its end"))?;
                    reader.seek_relative_to(at)?;
                    self.feature(&mut reader, (number, None), &mut table, wanted)?;
                    if table.is_full() {
                        break;
                    }
                }
            }
            _ => self.all(&mut table, wanted)?,
        }
        Ok(table)
    }

    /// Reads all features in order.
    fn all(&self, table: &mut FeatureTable, wanted: &SourceOptions) -> Result<()> {
        let mut reader = self.reader(self.features);
        let leaves = self.levels.as_ref().map(|levels| self.index + levels.leaves() * super::index::ENTRY);
        let mut leaves = leaves.map(|at| self.reader(at));
        let mut number = 0;
        while reader.at < self.end && !table.is_full() {
            let entry = match &mut leaves {
                Some(leaves) if number < self.header.count => {
                    let entry = BoxEntry::read(&mut leaves.file);
                    let entry = entry.map_err(|error| damage_error(&self.name, &error.to_string()))?;
                    if self.features.checked_add(entry.to) != Some(reader.at) {
                        return Err(damage_error(
                            &self.name,
                            "its index refers to an invalid feature position",
                        ));
                    }
                    Some(entry)
                }
                _ => None,
            };
            self.feature(&mut reader, (number, entry), table, wanted)?;
            number += 1;
        }
        let count = self.header.count;
        if count > 0 && number != count && !table.is_full() {
            let has = format!("it has {number} features, but declares {count}");
            return Err(damage_error(&self.name, &has));
        }
        Ok(())
    }

    fn reader(&self, at: u64) -> FgbReader<'_> {
        let file = BufReader::with_capacity(1 << 16, FilePosition { file: &self.file, at });
        FgbReader { file, at, name: &self.name, bytes: Vec::new() }
    }

    /// Reads the feature at the reader's position, with its index and, if known, its box in the spatial index.
    fn feature(
        &self,
        reader: &mut FgbReader<'_>,
        (number, entry): (u64, Option<BoxEntry>),
        table: &mut FeatureTable,
        wanted: &SourceOptions,
    ) -> Result<()> {
        wanted.budget.tick()?;
        let bytes = reader.next(self.end, wanted)?;
        let own = (number + 1).to_string();
        let bounds = entry.as_ref().map(|entry| entry.bounds);
        let parts = self.parts(bytes, entry, wanted);
        let attributes = self.attributes(bytes, table);
        let (parts, (attributes, key)) = match (parts, attributes) {
            (Ok(parts), Ok(attributes)) => (parts, attributes),
            (Err(why), _) => return self.refuse(table, (own, bounds), &why, wanted),
            (_, Err(why)) => {
                let why = format!("has attributes that cannot be read: it {why}");
                return self.refuse(table, (own, bounds), &why, wanted);
            }
        };
        match key {
            Some(key) => table.push(&key, parts, attributes),
            None => table.push_unnamed(parts, attributes),
        }
    }

    fn refuse(
        &self,
        table: &mut FeatureTable,
        (id, bounds): (String, Option<[f64; 4]>),
        why: &str,
        wanted: &SourceOptions,
    ) -> Result<()> {
        // The error may be an exceeded time limit instead of an invalid feature.
        wanted.budget.check()?;
        let error = Error::data(format!("feature {id} of {} {why}", self.name))
            .help("the file is damaged, or its content is not supported; re-export it: ogr2ogr -nlt CONVERT_TO_LINEAR out.fgb FILE");
        table.refuse_at(id, error, bounds)
    }

    /// Returns the parts of a feature's geometry.
    fn parts(
        &self,
        bytes: &[u8],
        entry: Option<BoxEntry>,
        wanted: &SourceOptions,
    ) -> std::result::Result<Vec<Geometry>, String> {
        let broken = |why: BufferDamage| format!("cannot be read: it {why}");
        let mut parts = Vec::new();
        if let Some(table) = BufferTable::root(bytes).and_then(|feature| feature.table(0)).map_err(broken)? {
            geometry::read(&table, self.header.kind, &wanted.budget, 0, &mut parts)?;
        }
        for bounds in entry.map(|entry| entry.bounds).into_iter().chain(self.header.bounds) {
            if let Some(place) =
                parts.iter().flat_map(Geometry::points).find(|place| !lies([place.x, place.y], bounds))
            {
                return Err(format!("is at {}, {}, which differs from the file's index", place.x, place.y));
            }
        }
        Ok(parts)
    }

    /// Returns the attributes of a feature, and its key, if any.
    fn attributes(
        &self,
        bytes: &[u8],
        table: &mut FeatureTable,
    ) -> std::result::Result<PropertyList, BufferDamage> {
        let feature = BufferTable::root(bytes)?;
        let own = columns(&feature, 2)?;
        let known = if own.is_empty() { &self.header.columns } else { &own };
        let mut values = PropertyBytes(feature.list(1, 1)?);
        let (mut attributes, mut key) = (Vec::new(), None);
        while !values.0.is_empty() {
            let number = usize::from(u16::from_le_bytes(values.take()?));
            let column = known.get(number).ok_or("has a value of an unknown column")?;
            let Some(value) = values.value(column, table)? else { continue };
            if column.is_key || (key.is_none() && column.name.eq_ignore_ascii_case("id")) {
                key = Some(value.text()).filter(|key| !key.is_empty());
            }
            let number = if own.is_empty() { number } else { table.name(&column.name) };
            attributes.push((number, value));
        }
        Ok((attributes, key))
    }
}

/// Attributes, and the key among them.
type PropertyList = (Vec<(usize, Attribute)>, Option<String>);

/// Returns the error for damaged bytes.
fn damage_error(name: &str, why: &str) -> Error {
    Error::data(format!("{name} cannot be read: {why}"))
        .help("the file is damaged or cut short; download it again")
}

/// Returns true if a position is within bounds; also for NaN, which is reported elsewhere.
fn lies([x, y]: [f64; 2], [west, south, east, north]: [f64; 4]) -> bool {
    let slack = |low: f64, high: f64| (low.abs().max(high.abs())) * ROUNDING;
    let (across, along) = (slack(west, east), slack(south, north));
    !(x < west - across || x > east + across || y < south - along || y > north + along)
}

/// Position in a file that is shared with other readers.
struct FilePosition<'a> {
    file: &'a File,
    at: u64,
}

impl Read for FilePosition<'_> {
    fn read(&mut self, into: &mut [u8]) -> std::io::Result<usize> {
        let mut file = self.file;
        file.seek(SeekFrom::Start(self.at))?;
        let count = file.read(into)?;
        self.at += count as u64;
        Ok(count)
    }
}

impl Seek for FilePosition<'_> {
    fn seek(&mut self, to: SeekFrom) -> std::io::Result<u64> {
        let at = match to {
            SeekFrom::Start(at) => Some(at),
            SeekFrom::Current(by) => self.at.checked_add_signed(by),
            SeekFrom::End(by) => self.file.metadata()?.len().checked_add_signed(by),
        };
        self.at = at.ok_or(std::io::ErrorKind::InvalidInput)?;
        Ok(self.at)
    }
}

/// Reader at a position in the file.
struct FgbReader<'a> {
    file: BufReader<FilePosition<'a>>,
    at: u64,
    name: &'a str,
    bytes: Vec<u8>,
}

impl FgbReader<'_> {
    /// Moves to another position.
    fn seek_relative_to(&mut self, at: u64) -> Result<()> {
        let offset = at.cast_signed() - self.at.cast_signed();
        self.file.seek_relative(offset).map_err(|error| damage_error(self.name, &error.to_string()))?;
        self.at = at;
        Ok(())
    }

    /// Returns the bytes of the next feature, which must end before `end`.
    fn next(&mut self, end: u64, wanted: &SourceOptions) -> Result<&[u8]> {
        let ends = |_| damage_error(self.name, &format!("the feature at byte {} is cut short", self.at));
        let mut length = [0; 4];
        self.file.read_exact(&mut length).map_err(ends)?;
        let length = u32::from_le_bytes(length);
        let after = self.at + 4 + u64::from(length);
        if after > end {
            return Err(damage_error(self.name, &format!("the feature at byte {} is cut short", self.at)));
        }
        let length = length as usize;
        let _held = wanted.budget.hold(length)?;
        self.bytes.resize(length, 0);
        self.file.read_exact(&mut self.bytes).map_err(|_| damage_error(self.name, "it is cut short"))?;
        self.at = after;
        Ok(&self.bytes)
    }
}

/// Consecutive property values.
struct PropertyBytes<'a>(&'a [u8]);

impl<'a> PropertyBytes<'a> {
    fn take<const N: usize>(&mut self) -> std::result::Result<[u8; N], BufferDamage> {
        let (taken, rest) = self.0.split_first_chunk().ok_or("ends too early")?;
        self.0 = rest;
        Ok(*taken)
    }

    fn bytes(&mut self) -> std::result::Result<&'a [u8], BufferDamage> {
        let length = u32::from_le_bytes(self.take()?) as usize;
        let (taken, rest) = self.0.split_at_checked(length).ok_or("ends too early")?;
        self.0 = rest;
        Ok(taken)
    }

    /// Returns the next value; `None` if scripts cannot use it.
    #[allow(clippy::cast_precision_loss, reason = "Lua's own numbers are f64")]
    fn value(
        &mut self,
        column: &Column,
        table: &mut FeatureTable,
    ) -> std::result::Result<Option<Attribute>, BufferDamage> {
        let number = match column.kind {
            0 => i8::from_le_bytes(self.take()?).into(),
            1 => u8::from_le_bytes(self.take()?).into(),
            2 => return self.take().map(|[value]: [u8; 1]| Some(Attribute::Boolean(value != 0))),
            3 => i16::from_le_bytes(self.take()?).into(),
            4 => u16::from_le_bytes(self.take()?).into(),
            5 => i32::from_le_bytes(self.take()?).into(),
            6 => u32::from_le_bytes(self.take()?).into(),
            7 => i64::from_le_bytes(self.take()?) as f64,
            8 => u64::from_le_bytes(self.take()?) as f64,
            9 => f32::from_le_bytes(self.take()?).into(),
            10 => f64::from_le_bytes(self.take()?),
            12 => {
                let bytes = self.bytes()?;
                return Ok(Some(match serde_json::from_slice(bytes) {
                    Ok(value @ (serde_json::Value::Array(_) | serde_json::Value::Object(_))) => {
                        Attribute::Nested(Arc::new(value))
                    }
                    _ => table.text(&String::from_utf8_lossy(bytes)),
                }));
            }
            11 | 13 => {
                let text = String::from_utf8_lossy(self.bytes()?);
                return Ok(Some(table.text(&text)));
            }
            14 => return self.bytes().map(|_| None),
            _ => return Err("has a column of unknown type"),
        };
        Ok(number.is_finite().then_some(Attribute::Number(number)))
    }
}
