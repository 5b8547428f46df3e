//! Streaming XML reader with limits.

use std::cell::Cell;
use std::io::{BufRead, BufReader, Read};
use std::rc::Rc;
use std::sync::Arc;

use quick_xml::Reader;
use quick_xml::escape::resolve_predefined_entity;
use quick_xml::events::{BytesStart, Event};

use crate::content::{Content, ContentReader};
use burgeon_base::budget::Budget;
use burgeon_base::error::{Error, Result};
use burgeon_base::text::shown;

/// Maximum nesting depth of elements.
const DEEPEST: usize = 100;

/// Maximum length of a text, comment or tag (bytes).
const LONGEST: usize = 100_000_000;

/// Event in a file.
pub(in crate::formats) enum XmlPiece {
    /// Start of an element.
    Start(Element),
    /// End of the current element.
    End,
    /// End of the file.
    Eof,
}

/// Start of an element.
pub(in crate::formats) struct Element {
    /// Local name, without the prefix.
    pub(in crate::formats) name: String,
    attributes: Vec<(String, String)>,
}

impl Element {
    /// Returns the attribute with the local name `name`.
    pub(in crate::formats) fn attribute(&self, name: &str) -> Option<&str> {
        self.attributes.iter().find(|(known, _)| known == name).map(|(_, value)| value.as_str())
    }
}

/// File that is read from the beginning to the end.
pub(in crate::formats) struct Xml {
    reader: Reader<BoundedReader<BufReader<XmlText>>>,
    buffer: Vec<u8>,
    /// Text since the last start or end of an element.
    text: String,
    /// Number of open elements.
    pub(in crate::formats) depth: usize,
    name: String,
    budget: Arc<Budget>,
    unread: Rc<Cell<usize>>,
}

impl Xml {
    /// Creates a reader at the beginning of a file's `content`.
    pub(in crate::formats) fn new(content: &Content, name: &str, budget: &Arc<Budget>) -> Result<Self> {
        let cannot = |error: std::io::Error| damage_error(name, &error.to_string());
        let head = content.head(256).map_err(cannot)?;
        let file = content.reader().map_err(cannot)?;
        let unread = Rc::new(Cell::new(0));
        let longest = LONGEST.min(budget.memory() / 4);
        let text = XmlText { file, is_latin: is_latin(&head, name)?, held: Vec::new() };
        let bounded = BoundedReader {
            inner: BufReader::with_capacity(1 << 16, text),
            unread: Rc::clone(&unread),
            longest,
        };
        let mut reader = Reader::from_reader(bounded);
        reader.config_mut().expand_empty_elements = true;
        let (name, budget) = (name.to_owned(), Arc::clone(budget));
        Ok(Self { reader, buffer: Vec::new(), text: String::new(), depth: 0, name, budget, unread })
    }

    /// Returns the next element within the one that began at `depth`; `None` at its end.
    pub(in crate::formats) fn next_child(&mut self, depth: usize) -> Result<Option<Element>> {
        loop {
            match self.next()? {
                XmlPiece::Start(element) => return Ok(Some(element)),
                XmlPiece::End if self.depth >= depth => {}
                XmlPiece::End | XmlPiece::Eof => return Ok(None),
            }
        }
    }

    /// Returns the text since the last start or end of an element.
    pub(in crate::formats) fn text(&self) -> &str {
        self.text.trim()
    }

    /// Returns the next start or end. The text in [`Xml::text`] is reset at each call.
    pub(in crate::formats) fn next(&mut self) -> Result<XmlPiece> {
        self.text.clear();
        loop {
            self.budget.tick()?;
            self.buffer.clear();
            self.unread.set(0);
            let event = self.reader.read_event_into(&mut self.buffer);
            let event = event
                .map_err(|error| wrong(&self.name, &error.to_string(), self.reader.buffer_position()))?;
            match event {
                Event::Start(start) => {
                    let element = element(&start).map_err(|why| damage_error(&self.name, &why))?;
                    self.depth += 1;
                    if self.depth > DEEPEST {
                        return Err(damage_error(
                            &self.name,
                            &format!("its elements are nested more than {DEEPEST} deep"),
                        ));
                    }
                    return Ok(XmlPiece::Start(element));
                }
                Event::End(_) => {
                    self.depth = self.depth.saturating_sub(1);
                    return Ok(XmlPiece::End);
                }
                Event::Eof if self.depth > 0 => {
                    return Err(damage_error(&self.name, "it ends within an element"));
                }
                Event::Eof => return Ok(XmlPiece::Eof),
                Event::Text(text) => self.text.push_str(&text.into_inner()),
                Event::CData(text) => self.text.push_str(&text.into_inner()),
                Event::GeneralRef(reference) => {
                    let letter = reference.resolve_char_ref().ok().flatten();
                    let name = reference.into_inner();
                    match (letter, resolve_predefined_entity(&name)) {
                        (Some(letter), _) => self.text.push(letter),
                        (None, Some(text)) => self.text.push_str(text),
                        (None, None) => {
                            let why = format!("it uses the unknown entity {}", shown(&name));
                            return Err(damage_error(&self.name, &why));
                        }
                    }
                }
                Event::DocType(kind) if kind.contains("<!ENTITY") => {
                    return Err(damage_error(
                        &self.name,
                        "it declares its own entities, which are not supported",
                    ));
                }
                Event::DocType(_) | Event::Comment(_) | Event::PI(_) | Event::Decl(_) | Event::Empty(_) => {}
            }
            if self.text.len() > LONGEST.min(self.budget.memory() / 4) {
                return Err(damage_error(&self.name, "it has a text that is too long"));
            }
        }
    }

    /// Reads to the end of the current element; returns its text, without the text of nested elements.
    pub(in crate::formats) fn inner_text(&mut self) -> Result<String> {
        let depth = self.depth;
        let mut all = String::new();
        loop {
            let is_own = self.depth == depth;
            let piece = self.next()?;
            if is_own {
                all.push_str(&self.text);
            }
            if self.depth < depth || matches!(piece, XmlPiece::Eof) {
                return Ok(all.trim().to_owned());
            }
            if all.len() > LONGEST.min(self.budget.memory() / 4) {
                return Err(damage_error(&self.name, "it has a text that is too long"));
            }
        }
    }

    /// Skips the rest of the elements deeper than `depth`.
    pub(in crate::formats) fn leave(&mut self, depth: usize) -> Result<()> {
        while self.depth > depth {
            if matches!(self.next()?, XmlPiece::Eof) {
                break;
            }
        }
        Ok(())
    }
}

/// Returns the name and the attributes of an element.
fn element(start: &BytesStart<'_>) -> std::result::Result<Element, String> {
    let name = start.local_name().as_ref().to_owned();
    let mut attributes = Vec::new();
    for attribute in start.attributes() {
        let attribute =
            attribute.map_err(|error| format!("an attribute of {} is damaged: {error}", shown(&name)))?;
        let value = attribute.normalized_value(quick_xml::XmlVersion::Implicit1_0);
        let value = value.map_err(|error| format!("an attribute of {} is damaged: {error}", shown(&name)))?;
        attributes.push((attribute.key.local_name().as_ref().to_owned(), value.into_owned()));
    }
    Ok(Element { name, attributes })
}

fn damage_error(name: &str, why: &str) -> Error {
    Error::data(format!("{name} cannot be read: {why}"))
        .help("the file is damaged or cut short; download it again")
}

fn wrong(name: &str, why: &str, at: u64) -> Error {
    damage_error(name, &format!("at byte {at}: {}", shown(why)))
}

/// Returns true if a file declares a Latin encoding with one byte per character; fails for encodings other than these
/// and UTF-8.
fn is_latin(head: &[u8], name: &str) -> Result<bool> {
    let head = String::from_utf8_lossy(head);
    let declared = head.split_once("?>").map_or("", |(declared, _)| declared);
    let encoding = declared.split_once("encoding=").map_or("", |(_, rest)| rest);
    let encoding: String =
        encoding.trim_start_matches(['"', '\'']).chars().take_while(|c| !matches!(c, '"' | '\'')).collect();
    match encoding.to_ascii_lowercase().as_str() {
        "" | "utf-8" | "utf8" | "us-ascii" | "ascii" => Ok(false),
        "iso-8859-1" | "iso-8859-15" | "latin1" | "windows-1252" | "cp1252" => Ok(true),
        other => {
            Err(Error::data(format!("{name} has the encoding {}, which is not supported", shown(other)))
                .help("convert it: iconv -f ENCODING -t UTF-8 IN > OUT.gml, and correct its first line"))
        }
    }
}

/// File as UTF-8.
struct XmlText {
    file: ContentReader,
    is_latin: bool,
    /// Bytes that did not fit into the last buffer.
    held: Vec<u8>,
}

impl Read for XmlText {
    fn read(&mut self, into: &mut [u8]) -> std::io::Result<usize> {
        if !self.is_latin {
            return self.file.read(into);
        }
        if self.held.is_empty() {
            let mut bytes = vec![0; (into.len() / 2).max(1)];
            let count = self.file.read(&mut bytes)?;
            let text: String = bytes[..count].iter().copied().map(char::from).collect();
            self.held = text.into_bytes();
        }
        let count = self.held.len().min(into.len());
        into[..count].copy_from_slice(&self.held[..count]);
        self.held.drain(..count);
        Ok(count)
    }
}

/// Reader that limits the number of bytes per event.
struct BoundedReader<R> {
    inner: R,
    unread: Rc<Cell<usize>>,
    longest: usize,
}

impl<R: Read> Read for BoundedReader<R> {
    fn read(&mut self, into: &mut [u8]) -> std::io::Result<usize> {
        self.inner.read(into)
    }
}

impl<R: BufRead> BufRead for BoundedReader<R> {
    fn fill_buf(&mut self) -> std::io::Result<&[u8]> {
        if self.unread.get() > self.longest {
            return Err(std::io::Error::other("a tag, a text or a comment is too long"));
        }
        self.inner.fill_buf()
    }

    fn consume(&mut self, count: usize) {
        self.unread.set(self.unread.get() + count);
        self.inner.consume(count);
    }
}

/// Returns the local name of the root element of an XML file that begins with `head`; empty if the root begins later.
/// Returns `None` if the file is not XML.
pub(super) fn root_name(head: &[u8]) -> Option<String> {
    let text = String::from_utf8_lossy(head.strip_prefix(b"\xef\xbb\xbf").unwrap_or(head));
    let mut rest = text.trim_start();
    if !rest.starts_with('<') {
        return None;
    }
    loop {
        let behind = |end: &str| rest.split_once(end).map_or("", |(_, behind)| behind).trim_start();
        rest = match rest {
            _ if rest.starts_with("<?") => behind("?>"),
            _ if rest.starts_with("<!--") => behind("-->"),
            _ if rest.starts_with("<!") => behind(">"),
            _ => break,
        };
    }
    let name = rest.trim_start_matches('<');
    let end = name
        .find(|letter: char| !(letter.is_alphanumeric() || ":_.-".contains(letter)))
        .unwrap_or(name.len());
    Some(name[..end].rsplit(':').next().unwrap_or_default().to_owned())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_outermost_element_is_found_behind_declarations_and_comments() {
        let of = |text: &str| root_name(text.as_bytes());
        assert_eq!(of("<?xml version='1.0'?>\n<!-- a <b> -->\n<kml:kml xmlns='x'>").as_deref(), Some("kml"));
        assert_eq!(of("\u{feff}<gpx>").as_deref(), Some("gpx"));
        assert_eq!(of("<!DOCTYPE osm><osm version='0.6'/>").as_deref(), Some("osm"));
        assert_eq!((of("{}"), of("<!-- a").as_deref()), (None, Some("")));
    }
}
