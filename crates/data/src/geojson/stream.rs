//! Reads large GeoJSON a part at a time, so that the text need not be held.
//!
//! What is not as it should be ends this at once: the file is then read whole, and what is wrong is told of its text.

use std::io::{self, Read};
use std::path::Path;

use serde_json::Deserializer;
use serde_json::value::RawValue;

use super::reader::{FeatureReader, RECORD, is_sequence};
use crate::{FeatureTable, SourceOptions};
use burgeon_base::budget::{Budget, MemoryReservation};
use burgeon_base::error::{Error, Result};

/// How much of a file (bytes) is looked at, unless a single feature is larger.
pub(crate) const WINDOW: usize = 4 << 20;

/// Reads all of `file`, which messages call `name`, through a window of so many bytes. None where [`read`](super::read) has to
/// tell what is wrong with it.
pub(crate) fn stream(
    file: impl Read,
    path: &Path,
    name: &str,
    wanted: &SourceOptions,
    window: usize,
) -> Result<Option<FeatureTable>> {
    let before = wanted.budget.taken();
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

/// Why a file is not read on.
enum Halt {
    /// It is not what it should be.
    Irregular,
    /// Reading has to end.
    Failed(Error),
}

impl From<Error> for Halt {
    fn from(error: Error) -> Self {
        Self::Failed(error)
    }
}

impl From<io::Error> for Halt {
    fn from(_: io::Error) -> Self {
        // It comes again when the file is read whole.
        Self::Irregular
    }
}

/// The part of a file that is being read.
struct TextWindow<'b, R> {
    file: R,
    budget: &'b Budget,
    /// The memory of `bytes`.
    held: Option<MemoryReservation<'b>>,
    bytes: Vec<u8>,
    /// Where what has not been read begins.
    start: usize,
    size: usize,
    ended: bool,
}

impl<'b, R: Read> TextWindow<'b, R> {
    fn new(file: R, size: usize, budget: &'b Budget) -> Self {
        // No shorter than a byte order mark.
        Self { file, budget, held: None, bytes: Vec::new(), start: 0, size: size.max(3), ended: false }
    }

    fn rest(&self) -> &[u8] {
        &self.bytes[self.start..]
    }

    /// Reads on behind what has not been read; false if there is no more.
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

    /// The next byte that is no blank.
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

    /// Reads `byte`, if it comes next.
    fn take_if(&mut self, byte: u8) -> Result<bool, Halt> {
        let comes = self.peek()? == Some(byte);
        self.start += usize::from(comes);
        Ok(comes)
    }

    /// Reads `byte`, which has to come next.
    fn expect(&mut self, byte: u8) -> Result<(), Halt> {
        if self.take_if(byte)? { Ok(()) } else { Err(Halt::Irregular) }
    }

    /// The text of the next value.
    fn value(&mut self) -> Result<&str, Halt> {
        self.peek()?;
        let length = loop {
            let mut values = Deserializer::from_slice(self.rest()).into_iter::<&RawValue>();
            match values.next() {
                // A number that ends with the window may go on behind it.
                Some(Ok(_)) if self.ended || values.byte_offset() < self.rest().len() => {
                    break values.byte_offset();
                }
                // To the parser a number that is cut off is none.
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

/// Whether a number may end with `byte` where it is cut off.
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
                true => return Ok(self.alone(head)?),
                false => self.member(head)?,
            }
            first = false;
        }
    }

    /// Reads an object, whose features are added at once; what else it says is put into `object`.
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
