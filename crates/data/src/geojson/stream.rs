//! Reader of large GeoJSON files in parts, so the text is not kept in memory.
//!
//! At any irregularity, the streaming ends: the whole file is then read by [`read`](super::read), which reports errors
//! with positions in the text.

use std::io::{self, Read};
use std::path::Path;

use serde_json::Deserializer;
use serde_json::value::RawValue;

use super::reader::{FeatureReader, RECORD, is_sequence};
use crate::features::table::FeatureTable;
use crate::source_options::SourceOptions;
use burgeon_base::budget::{Budget, MemoryReservation};
use burgeon_base::error::{Error, Result};

/// Size of the window (bytes), unless a single feature is larger.
pub(crate) const WINDOW: usize = 4 << 20;

/// Reads all of `file`, called `name` in messages, through a window of `window` bytes. Returns `None` if
/// [`read`](super::read) must report what is wrong with the file.
pub(crate) fn stream(
    file: impl Read,
    path: &Path,
    name: &str,
    wanted: &SourceOptions,
    window: usize,
) -> Result<Option<FeatureTable>> {
    let before = wanted.budget.used_bytes();
    let mut reader = FeatureReader::new(path, name, wanted);
    match reader.stream(TextWindow::new(file, window, &wanted.budget), is_sequence(path)) {
        Ok(()) => Ok(Some(reader.into_table())),
        Err(Halt::Irregular) => {
            drop(reader);
            wanted.budget.settle(before, 0);
            Ok(None)
        }
        Err(Halt::Failed(error)) => Err(error),
    }
}

/// Reason why the reading of a file ends.
enum Halt {
    /// Irregularity in the file.
    Irregular,
    /// Error that must end the reading.
    Failed(Error),
}

impl From<Error> for Halt {
    fn from(error: Error) -> Self {
        Self::Failed(error)
    }
}

impl From<io::Error> for Halt {
    fn from(_: io::Error) -> Self {
        // The error occurs again when the whole file is read.
        Self::Irregular
    }
}

/// Window of a file.
struct TextWindow<'b, R> {
    file: R,
    budget: &'b Budget,
    /// Memory reserved for `bytes`.
    held: Option<MemoryReservation<'b>>,
    bytes: Vec<u8>,
    /// Offset of the first byte that was not yet read.
    start: usize,
    size: usize,
    ended: bool,
}

impl<'b, R: Read> TextWindow<'b, R> {
    fn new(file: R, size: usize, budget: &'b Budget) -> Self {
        // At least as long as a byte order mark.
        Self { file, budget, held: None, bytes: Vec::new(), start: 0, size: size.max(3), ended: false }
    }

    fn rest(&self) -> &[u8] {
        &self.bytes[self.start..]
    }

    /// Reads more bytes after those not yet consumed; returns false at the end of the file.
    fn fill(&mut self) -> Result<bool, Halt> {
        self.bytes.drain(..self.start);
        self.start = 0;
        let is_short = self.bytes.len() * 2 > self.size;
        if is_short {
            self.size *= 2;
        }
        if is_short || self.held.is_none() {
            self.held = None;
            self.held = Some(self.budget.hold(self.size)?);
        }
        let (before, room) = (self.bytes.len(), self.size - self.bytes.len());
        self.bytes.reserve_exact(room);
        (&mut self.file).take(room as u64).read_to_end(&mut self.bytes)?;
        self.ended = self.bytes.len() - before < room;
        Ok(self.bytes.len() > before)
    }

    /// Returns the next byte that is not white space.
    fn peek(&mut self) -> Result<Option<u8>, Halt> {
        loop {
            let blank = |byte: &u8| matches!(byte, b' ' | b'\t' | b'\n' | b'\r');
            match self.rest().iter().position(|byte| !blank(byte)) {
                Some(blanks) => {
                    self.start += blanks;
                    return Ok(self.rest().first().copied());
                }
                None => self.start = self.bytes.len(),
            }
            if self.ended || !self.fill()? {
                return Ok(None);
            }
        }
    }

    /// Consumes `byte` if it comes next.
    fn take_if(&mut self, byte: u8) -> Result<bool, Halt> {
        let comes = self.peek()? == Some(byte);
        self.start += usize::from(comes);
        Ok(comes)
    }

    /// Consumes `byte`, which must come next.
    fn expect(&mut self, byte: u8) -> Result<(), Halt> {
        if self.take_if(byte)? { Ok(()) } else { Err(Halt::Irregular) }
    }

    /// Returns the text of the next value.
    fn value(&mut self) -> Result<&str, Halt> {
        self.peek()?;
        let length = loop {
            let mut values = Deserializer::from_slice(self.rest()).into_iter::<&RawValue>();
            match values.next() {
                // A number at the end of the window may continue beyond it.
                Some(Ok(_)) if self.ended || values.byte_offset() < self.rest().len() => {
                    break values.byte_offset();
                }
                // The parser rejects a truncated number.
                Some(Err(error)) if !error.is_eof() && !self.rest().last().is_some_and(is_of_number) => {
                    return Err(Halt::Irregular);
                }
                _ if self.ended => return Err(Halt::Irregular),
                _ => drop(self.fill()?),
            }
        };
        let text = &self.bytes[self.start..self.start + length];
        self.start += length;
        std::str::from_utf8(text).map_err(|_| Halt::Irregular)
    }
}

/// Returns true if a truncated number may end with `byte`.
fn is_of_number(byte: &u8) -> bool {
    matches!(byte, b'-' | b'+' | b'.' | b'e' | b'E' | b'0'..=b'9')
}

impl FeatureReader<'_> {
    fn stream<R: Read>(&mut self, mut text: TextWindow<'_, R>, is_sequence: bool) -> Result<(), Halt> {
        text.fill()?;
        if text.rest().starts_with(b"\xef\xbb\xbf") {
            text.start = 3;
        }
        let has_records = text.peek()? == Some(RECORD as u8);
        let mut object = String::new();
        let mut first = !is_sequence && !has_records;
        loop {
            while has_records && text.take_if(RECORD as u8)? {}
            match text.peek()? {
                None if first => return Err(Halt::Irregular),
                None => return Ok(()),
                Some(_) => self.stream_object(&mut text, &mut object)?,
            }
            let next = text.peek()?;
            if has_records && next.is_some_and(|byte| byte != RECORD as u8) {
                return Err(Halt::Irregular);
            }
            let (head, _) = self.text(&object).map_err(|_| Halt::Irregular)?;
            match first && next.is_none() {
                true => return Ok(self.take_whole(head)?),
                false => self.member(head)?,
            }
            first = false;
        }
    }

    /// Reads an object, and adds the features of its collection; its other members are written to `object`.
    fn stream_object<R: Read>(
        &mut self,
        text: &mut TextWindow<'_, R>,
        object: &mut String,
    ) -> Result<(), Halt> {
        object.clear();
        text.expect(b'{')?;
        let mut between = "{";
        while text.peek()? != Some(b'}') {
            if between == "," {
                text.expect(b',')?;
            }
            object.push_str(between);
            between = ",";
            let key = text.value()?;
            object.push_str(key);
            object.push(':');
            let is_list = serde_json::from_str::<String>(key).map_err(|_| Halt::Irregular)? == "features";
            text.expect(b':')?;
            if is_list {
                self.stream_features(text)?;
                object.push_str("[]");
            } else {
                object.push_str(text.value()?);
            }
        }
        text.expect(b'}')?;
        if between == "{" {
            object.push('{');
        }
        object.push('}');
        Ok(())
    }

    fn stream_features<R: Read>(&mut self, text: &mut TextWindow<'_, R>) -> Result<(), Halt> {
        text.expect(b'[')?;
        if text.take_if(b']')? {
            return Ok(());
        }
        loop {
            self.raw_feature(text.value()?)?;
            if text.take_if(b']')? {
                return Ok(());
            }
            text.expect(b',')?;
        }
    }
}
