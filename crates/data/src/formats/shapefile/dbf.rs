//! Attributes of a `.dbf` file, row by row.

use std::borrow::Cow;
use std::io::{BufReader, Read};

use crate::codepages::{CodePage, WESTERN};
use crate::content::ContentReader;
use crate::features::table::FeatureTable;
use burgeon_base::error::{Error, Result};
use burgeon_base::text::shown;
use burgeon_kit::Attribute;

/// Column.
struct DbfColumn {
    /// Index of the attribute.
    name: usize,
    kind: u8,
    /// Range of its bytes in a row.
    place: std::ops::Range<usize>,
}

/// Rows of a file, from the beginning.
pub(super) struct DbfReader {
    file: BufReader<ContentReader>,
    columns: Vec<DbfColumn>,
    encoding: TextEncoding,
    row: Vec<u8>,
    /// Number of remaining rows.
    left: u32,
    /// Number of values that are invalid numbers or dates, and an example.
    pub(super) unread: Option<(usize, String)>,
    /// Set if texts were decoded with an assumed code page.
    pub(super) guessed: bool,
    /// Names of columns that are skipped because their values are in another file.
    pub(super) left_out: Vec<String>,
}

/// Text encoding.
#[derive(Clone, Copy)]
pub(super) enum TextEncoding {
    Utf8,
    Page(&'static CodePage),
    /// UTF-8 where the text is valid UTF-8, otherwise Windows-1252.
    Unknown,
}

impl TextEncoding {
    /// Returns the encoding named in a `.cpg` file, or otherwise by the number `mark` in the `.dbf` file. Fails with
    /// its name if it is not supported.
    pub(super) fn of_name(cpg: Option<&str>, mark: u8) -> std::result::Result<Self, Cow<'_, str>> {
        let number = match cpg.map(str::trim).filter(|name| !name.is_empty()) {
            Some(name) => match page_of_name(name) {
                Some(65001) => return Ok(Self::Utf8),
                Some(number) => number,
                None => return Err(name.into()),
            },
            None => match page_of_mark(mark) {
                Some(number) => number,
                None => return Ok(Self::Unknown),
            },
        };
        CodePage::of_number(number).map(Self::Page).ok_or_else(|| match cpg {
            Some(name) => name.trim().into(),
            None => format!("code page {number}").into(),
        })
    }

    /// Decodes bytes; the flag is true if the code page was assumed.
    fn decode<'b>(self, bytes: &'b [u8]) -> (Cow<'b, str>, bool) {
        match (self, std::str::from_utf8(bytes)) {
            (Self::Utf8 | Self::Unknown, Ok(text)) => (Cow::Borrowed(text), false),
            (Self::Page(page), _) => (page.decode(bytes), false),
            // A text of fixed length may end within a character.
            (Self::Utf8, Err(_)) => (String::from_utf8_lossy(bytes), false),
            (Self::Unknown, Err(_)) => match CodePage::of_number(WESTERN) {
                Some(page) => (page.decode(bytes), true),
                None => (String::from_utf8_lossy(bytes), true),
            },
        }
    }
}

/// Returns the number of the code page with a name such as `UTF-8`, `ISO-8859-15`, `CP1252` or `ANSI 1252`.
fn page_of_name(name: &str) -> Option<u32> {
    let lower = name.to_ascii_lowercase();
    let plain: String = lower.chars().filter(char::is_ascii_alphanumeric).collect();
    if plain.starts_with("utf8") {
        return Some(65001);
    }
    if let Some(part) = plain.split_once("8859").map(|(_, part)| part) {
        return part.parse::<u32>().ok().filter(|part| (1..=16).contains(part)).map(|part| 28_590 + part);
    }
    match plain.as_str() {
        "latin1" | "ascii" | "usascii" => return Some(28_591),
        "koi8r" => return Some(20_866),
        _ => {}
    }
    let digits = plain.trim_start_matches(|letter: char| !letter.is_ascii_digit());
    let number = digits.parse().ok()?;
    match plain.strip_prefix("ldid") {
        Some(mark) => page_of_mark(mark.parse().ok()?),
        None if number == 88591 => Some(28_591),
        None => Some(number),
    }
}

/// Returns the number of the code page for the 30th byte of a `.dbf` file.
#[rustfmt::skip]
fn page_of_mark(mark: u8) -> Option<u32> {
    Some(match mark {
        0x01 | 0x09 | 0x0b | 0x0d | 0x0f | 0x11 | 0x15 | 0x18 | 0x19 | 0x1b => 437,
        0x02 | 0x0a | 0x0e | 0x10 | 0x12 | 0x14 | 0x16 | 0x1a | 0x1d | 0x25 | 0x37 => 850,
        0x03 | 0x58 | 0x59 => 1252,
        0x08 | 0x17 | 0x66 => 865,
        0x13 | 0x7b => 932,
        0x1c | 0x6c => 863,
        0x1f | 0x22 | 0x23 | 0x40 | 0x64 | 0x87 => 852,
        0x24 => 860,
        0x26 | 0x65 => 866,
        0x4d | 0x7a => 936,
        0x4e | 0x79 => 949,
        0x4f | 0x78 => 950,
        0x50 | 0x7c => 874,
        0x67 => 861,
        0x6a | 0x86 => 737,
        0x6b | 0x88 => 857,
        0xc8 => 1250,
        0xc9 => 1251,
        0xca => 1254,
        0xcb => 1253,
        0xcc => 1257,
        _ => return None,
    })
}

/// Row; `None` if it is marked as deleted.
pub(super) type DbfRow = Option<Vec<(usize, Attribute)>>;

impl DbfReader {
    /// Reads the header; its columns become attributes of `table`. `name` is used in messages.
    pub(super) fn open(
        file: ContentReader,
        name: &str,
        cpg: Option<&str>,
        table: &mut FeatureTable,
    ) -> Result<Self> {
        let damaged = |why: &str| {
            Error::data(format!("{name} cannot be read: {why}"))
                .help("the file is damaged or cut short; download it again")
        };
        let mut file = BufReader::with_capacity(1 << 16, file);
        let mut head = [0; 32];
        file.read_exact(&mut head).map_err(|_| damaged("its header is cut short"))?;
        let left = u32::from_le_bytes([head[4], head[5], head[6], head[7]]);
        let [header, size] = [8, 10].map(|at| usize::from(u16::from_le_bytes([head[at], head[at + 1]])));
        let encoding = TextEncoding::of_name(cpg, head[29]).map_err(|named| {
            Error::data(format!("{name} has texts in {}, which is not supported", shown(&named)))
                .help("convert it: ogr2ogr -lco ENCODING=UTF-8 OUT.shp IN.shp, or to a GeoPackage: ogr2ogr out.gpkg IN.shp")
        })?;
        let mut rest = vec![0; header.saturating_sub(32)];
        file.read_exact(&mut rest).map_err(|_| damaged("its header is cut short"))?;
        let mut found = Self {
            file,
            columns: Vec::new(),
            encoding,
            row: Vec::new(),
            left,
            unread: None,
            guessed: false,
            left_out: Vec::new(),
        };
        let mut at = 1;
        for field in rest.chunks_exact(32).take_while(|field| field[0] != 0x0d) {
            let title = field[..11].split(|byte| *byte == 0).next().unwrap_or_default();
            let (title, guessed) = encoding.decode(title.trim_ascii());
            found.guessed |= guessed;
            // Some programs store the upper byte of the length of long texts here.
            let upper = if field[11] == b'C' { usize::from(field[17]) << 8 } else { 0 };
            let place = at..at + usize::from(field[16]) + upper;
            at = place.end;
            if place.end > size {
                return Err(damaged("its columns are together longer than its rows"));
            }
            if matches!(field[11], b'M' | b'G' | b'P') {
                found.left_out.push(title.into_owned());
                continue;
            }
            let mut unique = Cow::Borrowed(&*title);
            let mut count = 1;
            while table.names.iter().any(|known| *known == unique) {
                count += 1;
                unique = format!("{title}_{count}").into();
            }
            let name = table.name(&unique);
            found.columns.push(DbfColumn { name, kind: field[11], place });
        }
        if size == 0 && found.left > 0 {
            return Err(damaged("its rows have no bytes"));
        }
        found.row = vec![0; size];
        Ok(found)
    }

    /// Returns the next row; `None` at the end, or if the file is truncated.
    pub(super) fn next(&mut self, table: &mut FeatureTable) -> Option<DbfRow> {
        if self.left == 0 || self.file.read_exact(&mut self.row).is_err() {
            return None;
        }
        self.left -= 1;
        if self.row[0] == b'*' {
            return Some(None);
        }
        let mut attributes = Vec::with_capacity(self.columns.len());
        for column in &self.columns {
            let bytes = &self.row[column.place.clone()];
            match value(column.kind, bytes) {
                DbfValue::Missing => {}
                DbfValue::Number(number) => attributes.push((column.name, Attribute::Number(number))),
                DbfValue::Boolean(value) => attributes.push((column.name, Attribute::Boolean(value))),
                DbfValue::Text(bytes) => {
                    let (text, guessed) = self.encoding.decode(bytes);
                    self.guessed |= guessed;
                    if !text.is_empty() {
                        attributes.push((column.name, table.text(&text)));
                    }
                }
                DbfValue::Date(text) => attributes.push((column.name, table.text(&text))),
                DbfValue::Unread => {
                    let example = || {
                        let text = String::from_utf8_lossy(bytes.trim_ascii()).into_owned();
                        format!("{} = \"{}\"", shown(&table.names[column.name]), shown(&text))
                    };
                    self.unread.get_or_insert_with(|| (0, example())).0 += 1;
                }
            }
        }
        Some(Some(attributes))
    }
}

/// Value in a row.
enum DbfValue<'b> {
    Missing,
    Number(f64),
    Boolean(bool),
    Text(&'b [u8]),
    Date(String),
    Unread,
}

fn value(kind: u8, bytes: &[u8]) -> DbfValue<'_> {
    let finite = |number: f64| if number.is_finite() { DbfValue::Number(number) } else { DbfValue::Missing };
    let text = bytes.split(|byte| *byte == 0).next().unwrap_or_default().trim_ascii();
    match (kind, bytes.len()) {
        (b'I' | b'+', 4) => {
            let number: [u8; 4] = bytes.try_into().unwrap_or_default();
            DbfValue::Number(i32::from_le_bytes(number).into())
        }
        (b'B' | b'O', 8) => finite(f64::from_le_bytes(bytes.try_into().unwrap_or_default())),
        #[allow(clippy::cast_precision_loss, reason = "an amount of money in ten-thousandths")]
        (b'Y', 8) => DbfValue::Number(i64::from_le_bytes(bytes.try_into().unwrap_or_default()) as f64 / 1e4),
        (b'T' | b'@', 8) => DbfValue::Missing,
        (b'N' | b'F' | b'I' | b'B' | b'O' | b'Y', _) => {
            if text.is_empty() || text.iter().all(|byte| *byte == b'*') {
                return DbfValue::Missing;
            }
            let number = std::str::from_utf8(text).ok().and_then(|text| text.replace(',', ".").parse().ok());
            number.map_or(DbfValue::Unread, finite)
        }
        (b'L', _) => match text.first() {
            Some(b'T' | b't' | b'Y' | b'y' | b'1') => DbfValue::Boolean(true),
            Some(b'F' | b'f' | b'N' | b'n' | b'0') => DbfValue::Boolean(false),
            _ => DbfValue::Missing,
        },
        (b'D', _) => match text {
            [] => DbfValue::Missing,
            text if text.iter().all(|byte| *byte == b'0') => DbfValue::Missing,
            text if text.len() == 8 && text.iter().all(u8::is_ascii_digit) => {
                let text = String::from_utf8_lossy(text);
                DbfValue::Date(format!("{}-{}-{}", &text[..4], &text[4..6], &text[6..]))
            }
            _ => DbfValue::Unread,
        },
        _ => DbfValue::Text(text.trim_ascii_end()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn encodings_are_named_in_many_ways() {
        for (name, number) in [
            ("UTF-8", 65001),
            ("utf8\r\n", 65001),
            ("ISO-8859-1", 28591),
            ("ISO88591", 28591),
            ("8859_15", 28605),
            ("CP1252", 1252),
            ("windows-1250", 1250),
            ("ANSI 1251", 1251),
            ("OEM 850", 850),
            ("850", 850),
            ("LDID/87", 1252),
            ("KOI8-R", 20866),
            ("88591", 28591),
        ] {
            let known = page_of_name(name.trim());
            // Mark 87 stands for the code page of the machine, which is unknown.
            if name == "LDID/87" {
                assert_eq!(known, None)
            } else {
                assert_eq!(known, Some(number), "{name}")
            }
        }
        assert_eq!(page_of_name("Big5").and_then(CodePage::of_number).map(|page| page.number), None);
        assert!(
            TextEncoding::of_name(Some("Shift_JIS"), 0).is_err()
                && TextEncoding::of_name(None, 0x13).is_err()
        );
    }
}
