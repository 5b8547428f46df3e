//! Parts of composite letters.

use burgeon_base::Stop;
use burgeon_base::error::{Error, Limit, Result};
use ttf_parser::head::IndexToLocationFormat;
use ttf_parser::{Face, GlyphId, Tag};

/// Maximum number of parts of a letter, with the parts of parts.
const MOST_PARTS: usize = 1000;
/// Number of bytes before the parts of a composite letter: the number of its rings, and its bounds.
const HEADER: usize = 10;

/// Fails if a letter of a TrueType font has more parts than any letter needs: a part that contains itself, or parts of parts
/// that double many times. Their outlines would take too long, even if they are empty.
pub(super) fn check_parts(face: &Face<'_>, glyph: GlyphId) -> Result<()> {
    let Some(outlines) = OutlineTables::of(face) else { return Ok(()) };
    let (mut pending, mut count) = (vec![glyph], 0);
    while let Some(glyph) = pending.pop() {
        Stop::check_current()?;
        count += outlines.add_parts(glyph, &mut pending);
        if count > MOST_PARTS {
            let message = format!("letter {} of the font has more than {MOST_PARTS} parts", glyph.0);
            return Err(Error::limit(Limit::Size, message).help("use another font: this one is damaged"));
        }
    }
    Ok(())
}

/// Tables of the outlines of a TrueType font.
struct OutlineTables<'a> {
    /// Table "loca": the position of each outline.
    positions: &'a [u8],
    /// Table "glyf": outlines.
    outlines: &'a [u8],
    /// Set if positions have four bytes, not two.
    is_long: bool,
}

impl<'a> OutlineTables<'a> {
    /// Returns the tables; `None` if the font has other outlines.
    fn of(face: &Face<'a>) -> Option<Self> {
        let table = |name: &[u8; 4]| face.raw_face().table(Tag::from_bytes(name));
        let is_long = face.tables().head.index_to_location_format == IndexToLocationFormat::Long;
        Some(Self { positions: table(b"loca")?, outlines: table(b"glyf")?, is_long })
    }

    /// Returns the content of a letter's outline; empty for a space.
    fn outline(&self, glyph: GlyphId) -> Option<&'a [u8]> {
        let position = |number: usize| -> Option<usize> {
            if self.is_long {
                let bytes = self.positions.get(4 * number..4 * number + 4)?;
                usize::try_from(u32::from_be_bytes(bytes.try_into().ok()?)).ok()
            } else {
                number_at(self.positions, 2 * number).map(|half| 2 * usize::from(half))
            }
        };
        let number = usize::from(glyph.0);
        self.outlines.get(position(number)?..position(number + 1)?)
    }

    /// Adds the parts of a composite letter to `parts`, up to the maximum; returns their number.
    fn add_parts(&self, glyph: GlyphId, parts: &mut Vec<GlyphId>) -> usize {
        let Some(outline) = self.outline(glyph) else { return 0 };
        // A composite letter has a negative number of rings.
        if number_at(outline, 0).is_none_or(|rings| rings < 0x8000) {
            return 0;
        }
        let (mut at, mut count) = (HEADER, 0);
        while let (Some(flags), Some(part)) = (number_at(outline, at), number_at(outline, at + 2)) {
            parts.push(GlyphId(part));
            count += 1;
            let has = |flag: u16| flags & flag != 0;
            let offset = if has(0x01) { 4 } else { 2 };
            let scale = match (has(0x08), has(0x40), has(0x80)) {
                (true, ..) => 2,
                (_, true, _) => 4,
                (.., true) => 8,
                _ => 0,
            };
            at += 4 + offset + scale;
            if !has(0x20) || count > MOST_PARTS {
                break;
            }
        }
        count
    }
}

/// Returns the 16-bit number at a position; `None` beyond the end.
fn number_at(content: &[u8], at: usize) -> Option<u16> {
    Some(u16::from_be_bytes(content.get(at..at + 2)?.try_into().ok()?))
}

#[cfg(test)]
mod tests {
    use std::time::Instant;

    use super::super::Font;

    /// Returns the position and the length (bytes) of a table of a font file.
    fn table(content: &[u8], name: &[u8; 4]) -> (usize, usize) {
        let record = content[12..].chunks_exact(16).find(|record| record.starts_with(name)).expect("a table");
        let number = |at: usize| u32::from_be_bytes(record[at..at + 4].try_into().expect("4 bytes")) as usize;
        (number(8), number(12))
    }

    /// Returns the shipped font with composite letters 1 to `depth`, of two parts each: those that `next` gives for the letter.
    /// All letters of the text refer to the first one.
    fn font_of_parts(depth: u16, next: impl Fn(u16) -> u16) -> Vec<u8> {
        let mut content = ttf_noto_sans::REGULAR.to_vec();
        let (head, _) = table(&content, b"head");
        let (loca, length) = table(&content, b"loca");
        let (glyf, _) = table(&content, b"glyf");
        content[head + 51] = 1;
        // Every letter is one of two parts; the last one is empty.
        let size = 22;
        for letter in 0..(length / 4).min(usize::from(depth) + 1) {
            let at = u32::try_from(letter * size).expect("small");
            content[loca + 4 * letter..loca + 4 * letter + 4].copy_from_slice(&at.to_be_bytes());
        }
        let end = u32::try_from(usize::from(depth) * size).expect("small").to_be_bytes();
        for letter in usize::from(depth)..length / 4 {
            content[loca + 4 * letter..loca + 4 * letter + 4].copy_from_slice(&end);
        }
        for letter in 0..depth {
            let mut outline = vec![0xff, 0xff, 0, 0, 0, 0, 0, 0, 0, 0];
            for flags in [0x20u16, 0] {
                outline.extend(flags.to_be_bytes());
                outline.extend(next(letter).to_be_bytes());
                outline.extend([0, 0]);
            }
            let at = glyf + usize::from(letter) * size;
            content[at..at + size].copy_from_slice(&outline);
        }
        content
    }

    #[test]
    fn letters_of_parts_that_double_or_contain_themselves_are_refused_at_once() {
        let begin = Instant::now();
        for content in [font_of_parts(30, |letter| letter + 1), font_of_parts(30, |letter| letter)] {
            let font = Font::read(content).expect("a font");
            let sized = font.at_size(1.0, 0.01).expect("measures");
            let error = sized.area(ttf_parser::GlyphId(0)).expect_err("a damaged letter");
            assert!(error.to_string().contains("more than 1000 parts"), "{error}");
        }
        // A few levels are possible.
        let font = Font::read(font_of_parts(5, |letter| letter + 1)).expect("a font");
        let sized = font.at_size(1.0, 0.01).expect("measures");
        assert!(sized.area(ttf_parser::GlyphId(0)).expect("an empty letter").is_empty());
        assert!(begin.elapsed().as_secs() < 2);
    }

    #[test]
    fn fonts_with_other_bytes_neither_panic_nor_take_long() {
        let whole = ttf_noto_sans::REGULAR;
        let mut random = burgeon_base::random::Stream::new(5);
        let tables: Vec<(usize, usize)> = [b"head", b"maxp", b"cmap", b"loca", b"glyf", b"hhea", b"hmtx"]
            .map(|name| table(whole, name))
            .into();
        let mut read = 0;
        for round in 0..2000 {
            let mut content = whole.to_vec();
            for _ in 0..=random.below(40) {
                // The directory, or the beginning of a table.
                let (from, length) =
                    if round % 3 == 0 { (0, 400) } else { tables[random.below(tables.len())] };
                let at = from + random.below(length.clamp(1, 4000));
                content[at] = u8::try_from(random.below(256)).expect("a byte");
            }
            if round % 7 == 0 {
                content.truncate(random.below(whole.len()));
            }
            let begin = Instant::now();
            let Ok(font) = Font::read(content) else { continue };
            read += 1;
            let Ok(sized) = font.at_size(1.0, 0.01) else { continue };
            for letter in ['H', 'ä', '%', 'g', 'Ω'] {
                let Some(glyph) = sized.glyph(letter) else { continue };
                let _ = sized.area(glyph);
                let _ = sized.pair(glyph, glyph);
            }
            assert!(begin.elapsed().as_secs() < 2, "{round}");
        }
        assert!(read > 500, "{read}");
    }
}
