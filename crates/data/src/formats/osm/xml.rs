//! XML extracts, `.osm`: converted to the blocks of the binary format, so both are read by the same code.
//!
//! Source: OpenStreetMap wiki, "OSM XML", and "PBF Format" for the blocks.

use rustc_hash::FxHashMap;
use std::sync::Arc;

use crate::content::DataFile;
use crate::formats::xml::{Element, Xml, XmlPiece, root_name};
use burgeon_base::budget::Budget;
use burgeon_base::error::{Error, Result};
use burgeon_base::text::shown;

/// Maximum number of nodes, ways or relations in a block.
const OF_BLOCK: usize = 8000;

/// Returns true if a file that begins with `head` is an extract in XML.
pub(super) fn is_xml_extract(head: &[u8]) -> bool {
    root_name(head).as_deref() == Some("osm")
}

/// Converts an extract to blocks, counted in the memory budget.
pub(super) fn blocks(file: &DataFile, budget: &Arc<Budget>) -> Result<Vec<Vec<u8>>> {
    let mut xml = Xml::new(&file.content, &file.name, budget)?;
    match xml.next()? {
        XmlPiece::Start(root) if root.name == "osm" => {}
        _ => return Err(Error::data(format!("{} is not an OpenStreetMap extract", file.name))),
    }
    let mut blocks = Vec::new();
    let mut block = BlockWriter::default();
    loop {
        let element = match xml.next()? {
            XmlPiece::Start(element) => element,
            XmlPiece::End => continue,
            XmlPiece::Eof => break,
        };
        let Some(kind) = ThingKind::of_name(&element.name) else {
            xml.leave(xml.depth - 1)?;
            continue;
        };
        let is_gone =
            element.attribute("visible") == Some("false") || element.attribute("action") == Some("delete");
        if is_gone {
            xml.leave(xml.depth - 1)?;
            continue;
        }
        // A group contains elements of one type.
        if block.count == OF_BLOCK || (block.count > 0 && block.kind != kind) {
            budget.take(block.size())?;
            blocks.push(std::mem::take(&mut block).finish());
        }
        block.kind = kind;
        block.read(&mut xml, &element, &file.name)?;
    }
    if block.count > 0 {
        budget.take(block.size())?;
        blocks.push(block.finish());
    }
    Ok(blocks)
}

/// Type of an element.
#[derive(Clone, Copy, Default, PartialEq)]
enum ThingKind {
    #[default]
    Node,
    Way,
    Relation,
}

impl ThingKind {
    fn of_name(name: &str) -> Option<Self> {
        match name {
            "node" => Some(Self::Node),
            "way" => Some(Self::Way),
            "relation" => Some(Self::Relation),
            _ => None,
        }
    }
}

/// Block that is being written.
#[derive(Default)]
struct BlockWriter {
    kind: ThingKind,
    count: usize,
    /// Indices of the strings, and the encoded strings.
    numbers: FxHashMap<String, u64>,
    texts: Vec<u8>,
    /// Encoded ways and relations.
    group: Vec<u8>,
    nodes: DenseNodes,
}

/// Delta-encoded nodes.
#[derive(Default)]
struct DenseNodes {
    last: [i64; 3],
    ids: Vec<u8>,
    east: Vec<u8>,
    north: Vec<u8>,
    tags: Vec<u8>,
}

/// Returns the integer in an attribute of an element.
fn whole(element: &Element, name: &str, file: &str) -> Result<i64> {
    let text = element.attribute(name).unwrap_or_default();
    text.trim().parse().map_err(|_| {
        Error::data(format!("{file} cannot be read: a {} has the {name} \"{}\"", element.name, shown(text)))
            .help("the file is damaged; download it again")
    })
}

/// Returns the billionths of a degree in an attribute of an element.
fn degrees(element: &Element, name: &str, file: &str) -> Result<i64> {
    let text = element.attribute(name).unwrap_or_default().trim();
    exact(text).or_else(|| nearest(text)).ok_or_else(|| {
        Error::data(format!("{file} cannot be read: a node has the {name} \"{}\"", shown(text)))
            .help("the file is damaged; download it again")
    })
}

/// Returns the billionths of a decimal number if they are exact.
fn exact(text: &str) -> Option<i64> {
    let (sign, digits) = text.strip_prefix('-').map_or((1, text), |digits| (-1, digits));
    let (whole, part) = digits.split_once('.').unwrap_or((digits, ""));
    let is_plain = |text: &str| text.bytes().all(|byte| byte.is_ascii_digit());
    if part.len() > 9 || whole.is_empty() || whole.len() > 6 || !is_plain(whole) || !is_plain(part) {
        return None;
    }
    let number: i64 = format!("{whole}{part:0<9}").parse().ok()?;
    Some(sign * number)
}

#[allow(clippy::cast_possible_truncation, reason = "the range is checked")]
fn nearest(text: &str) -> Option<i64> {
    let degrees: f64 = text.parse().ok()?;
    (degrees.abs() <= 1e6).then(|| (degrees * 1e9).round() as i64)
}

#[allow(clippy::cast_possible_truncation, reason = "seven bits at a time")]
fn varint(bytes: &mut Vec<u8>, mut number: u64) {
    while number > 127 {
        bytes.push((number & 127) as u8 | 128);
        number >>= 7;
    }
    bytes.push(number as u8);
}

fn zigzag(number: i64) -> u64 {
    (number << 1 ^ number >> 63).cast_unsigned()
}

/// Appends a field that contains bytes.
fn field(bytes: &mut Vec<u8>, key: u64, content: &[u8]) {
    varint(bytes, key << 3 | 2);
    varint(bytes, content.len() as u64);
    bytes.extend(content);
}

/// Appends a field that contains a number.
fn number(bytes: &mut Vec<u8>, key: u64, number: u64) {
    varint(bytes, key << 3);
    varint(bytes, number);
}

impl BlockWriter {
    /// Reads a node, a way or a relation that has begun.
    fn read(&mut self, xml: &mut Xml, element: &Element, file: &str) -> Result<()> {
        self.count += 1;
        let id = whole(element, "id", file)?;
        let place = match self.kind {
            ThingKind::Node => [degrees(element, "lon", file)?, degrees(element, "lat", file)?],
            _ => [0; 2],
        };
        let (mut keys, mut values) = (Vec::new(), Vec::new());
        let (mut members, mut types, mut last) = (Vec::new(), Vec::new(), 0_i64);
        let depth = xml.depth;
        loop {
            match xml.next()? {
                XmlPiece::Start(inner) => match &*inner.name {
                    "tag" => {
                        let [key, value] =
                            ["k", "v"].map(|name| inner.attribute(name).unwrap_or_default().to_owned());
                        keys.push(self.text(key));
                        values.push(self.text(value));
                    }
                    "nd" | "member" => {
                        let member = whole(&inner, "ref", file)?;
                        varint(
                            &mut members,
                            zigzag(member.wrapping_sub(std::mem::replace(&mut last, member))),
                        );
                        let kind = inner.attribute("type").and_then(ThingKind::of_name);
                        varint(&mut types, kind.unwrap_or_default() as u64);
                    }
                    _ => {}
                },
                XmlPiece::End if xml.depth < depth => break,
                XmlPiece::End => {}
                XmlPiece::Eof => break,
            }
        }
        if self.kind == ThingKind::Node {
            self.nodes.add([id, place[0], place[1]], keys.into_iter().zip(values));
            return Ok(());
        }
        let mut thing = Vec::new();
        number(&mut thing, 1, id.cast_unsigned());
        for (key, numbers) in [(2, keys), (3, values)] {
            let mut packed = Vec::new();
            numbers.into_iter().for_each(|number| varint(&mut packed, number));
            field(&mut thing, key, &packed);
        }
        if self.kind == ThingKind::Way {
            field(&mut thing, 8, &members);
            field(&mut self.group, 3, &thing);
        } else {
            field(&mut thing, 9, &members);
            field(&mut thing, 10, &types);
            field(&mut self.group, 4, &thing);
        }
        Ok(())
    }

    /// Returns the index of a string. The first string of a block is empty, because 0 ends the tags of a node.
    fn text(&mut self, text: String) -> u64 {
        if self.texts.is_empty() {
            field(&mut self.texts, 1, &[]);
        }
        let next = self.numbers.len() as u64 + 1;
        match self.numbers.entry(text) {
            std::collections::hash_map::Entry::Occupied(known) => *known.get(),
            std::collections::hash_map::Entry::Vacant(place) => {
                field(&mut self.texts, 1, place.key().as_bytes());
                *place.insert(next)
            }
        }
    }

    /// Returns the approximate size of the block (bytes).
    fn size(&self) -> usize {
        let DenseNodes { ids, east, north, tags, .. } = &self.nodes;
        100 + self.texts.len() + self.group.len() + ids.len() + east.len() + north.len() + tags.len()
    }

    fn finish(mut self) -> Vec<u8> {
        if self.kind == ThingKind::Node {
            let DenseNodes { ids, east, north, tags, .. } = &self.nodes;
            let mut dense = Vec::new();
            for (key, content) in [(1, ids), (8, north), (9, east), (10, tags)] {
                field(&mut dense, key, content);
            }
            field(&mut self.group, 2, &dense);
        }
        let mut block = Vec::with_capacity(self.texts.len() + self.group.len() + 30);
        field(&mut block, 1, &self.texts);
        field(&mut block, 2, &self.group);
        // Positions are in billionths of a degree.
        number(&mut block, 17, 1);
        block
    }
}

impl DenseNodes {
    fn add(&mut self, place: [i64; 3], tags: impl Iterator<Item = (u64, u64)>) {
        let into = [&mut self.ids, &mut self.east, &mut self.north];
        for ((bytes, value), last) in into.into_iter().zip(place).zip(&mut self.last) {
            varint(bytes, zigzag(value.wrapping_sub(std::mem::replace(last, value))));
        }
        for (key, value) in tags {
            varint(&mut self.tags, key);
            varint(&mut self.tags, value);
        }
        varint(&mut self.tags, 0);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn places_are_read_to_the_last_digit() {
        assert_eq!(exact("24.9384100"), Some(24_938_410_000));
        assert_eq!(exact("-0.000000001"), Some(-1));
        assert_eq!(
            (exact("7"), exact("+7"), exact("1e2"), exact(""), exact("0.0000000001")),
            (Some(7_000_000_000), None, None, None, None)
        );
        assert_eq!(
            (nearest("1e2"), nearest("0.0000000004"), nearest("x")),
            (Some(100_000_000_000), Some(0), None)
        );
    }
}
