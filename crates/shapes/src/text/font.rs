//! Fonts.

use std::borrow::Cow;
use std::panic::{AssertUnwindSafe, catch_unwind};

use burgeon_base::error::{Error, Limit, Result};
use burgeon_geometry::Rings;
use burgeon_geometry::overlay::{Fill, PolygonArea, fill};
use glam::DVec2;
use ttf_parser::gpos::{PairAdjustment, PositioningSubtable};
use ttf_parser::{Face, GlyphId, Tag};

use super::charstring_work::check_charstring;
use super::curves::OutlineRings;
use super::glyph_parts::check_parts;

/// Maximum number of tables of the distances of pairs.
const MOST_TABLES: usize = 1000;

/// A font: outlines and widths of letters, from a TrueType or OpenType file.
///
/// ```
/// use burgeon_shapes::Font;
///
/// assert!(Font::default().has('ß') && !Font::default().has('漢'));
/// assert!(Font::read(b"no font".to_vec()).is_err());
/// ```
#[derive(Debug, Clone)]
pub struct Font {
    content: Cow<'static, [u8]>,
}

impl Default for Font {
    /// Returns Noto Sans, which has Latin, Greek and Cyrillic letters.
    fn default() -> Self {
        Self { content: Cow::Borrowed(ttf_noto_sans::REGULAR) }
    }
}

impl Font {
    /// Reads the content of a font file: its first font. Fails if it is not a font with outlines.
    pub fn read(content: Vec<u8>) -> Result<Self> {
        let font = Self { content: Cow::Owned(content) };
        let face = font.face()?;
        let tables = face.tables();
        if tables.glyf.is_none() && tables.cff.is_none() {
            return Err(
                Error::data("the font has no outlines").help("use a font with outlines, not one of pixels")
            );
        }
        if tables.cmap.is_none() {
            return Err(Error::data("the font does not say which letters it has")
                .help("use a complete font file, not a part of one"));
        }
        Ok(font)
    }

    /// Returns true if the font has a letter.
    pub fn has(&self, letter: char) -> bool {
        self.face().is_ok_and(|face| face.glyph_index(letter).is_some())
    }

    /// Returns the memory (bytes).
    pub fn memory(&self) -> usize {
        self.content.len()
    }

    /// Returns the parsed tables.
    fn face(&self) -> Result<Face<'_>> {
        Face::parse(&self.content, 0).map_err(|cause| {
            Error::data(format!("the content is not a font: {cause}")).help("use a .ttf or .otf file")
        })
    }

    /// Returns the font with the measures for a height of capital letters (m), and a tolerance of curves (m).
    pub(super) fn at_size(&self, size: f64, tolerance: f64) -> Result<SizedFont<'_>> {
        let face = self.face()?;
        let capital = f64::from(face.capital_height().unwrap_or(0));
        let drawn = || {
            let glyph = face.glyph_index('H').filter(|glyph| check_work(&face, *glyph).is_ok())?;
            let bounds = face.glyph_bounding_box(glyph)?;
            Some(f64::from(bounds.y_max))
        };
        let capital = if capital > 0.0 { capital } else { drawn().unwrap_or(0.0) };
        let capital = if capital > 0.0 { capital } else { 0.7 * f64::from(face.units_per_em()) };
        let scale = size / capital;
        let line = f64::from(face.ascender()) - f64::from(face.descender()) + f64::from(face.line_gap());
        let line = if line > 0.0 { line } else { 1.7 * capital };
        Ok(SizedFont { pairs: pair_tables(&face), face, scale, line: line * scale, tolerance })
    }
}

/// A font at a size.
pub(super) struct SizedFont<'a> {
    face: Face<'a>,
    pairs: Vec<PairAdjustment<'a>>,
    /// Length (m) of a unit of the font.
    scale: f64,
    /// Distance (m) between lines.
    pub line: f64,
    /// Maximum distance (m) between a curve and its lines.
    tolerance: f64,
}

impl SizedFont<'_> {
    /// Returns the number of a letter's glyph; `None` if the font lacks the letter.
    pub(super) fn glyph(&self, letter: char) -> Option<GlyphId> {
        self.face.glyph_index(letter)
    }

    /// Returns the distance (m) to the next letter.
    pub(super) fn advance(&self, glyph: GlyphId) -> f64 {
        f64::from(self.face.glyph_hor_advance(glyph).unwrap_or(0)) * self.scale
    }

    /// Returns the distance (m) that the font adds between two letters.
    ///
    /// The position table takes precedence over the older table "kern".
    pub(super) fn pair(&self, left: GlyphId, right: GlyphId) -> f64 {
        for pairs in &self.pairs {
            let found = match pairs {
                PairAdjustment::Format1 { coverage, sets } => {
                    coverage.get(left).and_then(|set| sets.get(set)?.get(right))
                }
                PairAdjustment::Format2 { coverage, classes, matrix } => {
                    coverage.get(left).and_then(|_| matrix.get((classes.0.get(left), classes.1.get(right))))
                }
            };
            if let Some((first, _)) = found {
                return f64::from(first.x_advance) * self.scale;
            }
        }
        if !self.pairs.is_empty() {
            return 0.0;
        }
        let Some(table) = self.face.tables().kern else { return 0.0 };
        let horizontal = table.subtables.into_iter().filter(|part| part.horizontal && !part.variable);
        let sum: f64 = horizontal.filter_map(|part| part.glyphs_kerning(left, right)).map(f64::from).sum();
        sum * self.scale
    }

    /// Returns the area of a letter (m), from its place on the line; empty for a space.
    ///
    /// Outlines that cross or overlap are united.
    pub(super) fn area(&self, glyph: GlyphId) -> Result<PolygonArea> {
        check_work(&self.face, glyph)?;
        let mut outline = OutlineRings::new(self.tolerance / self.scale);
        // A damaged font can have letters without end, which the outline unwinds.
        let drawn = catch_unwind(AssertUnwindSafe(|| {
            self.face.outline_glyph(glyph, &mut outline);
        }));
        if drawn.is_err() {
            return Err(Error::limit(Limit::Size, "a letter of the font has too many points")
                .help("use another font, or a larger tolerance"));
        }
        let scaled = |ring: Vec<DVec2>| ring.into_iter().map(|at| at * self.scale).collect();
        let rings: Vec<Vec<DVec2>> = outline.rings.into_iter().map(scaled).collect();
        if rings.is_empty() {
            return Ok(Vec::new());
        }
        fill(&[Rings(rings)], Fill::NonZero)
    }
}

/// Fails if the outline of a letter takes too long.
fn check_work(face: &Face<'_>, glyph: GlyphId) -> Result<()> {
    check_parts(face, glyph)?;
    check_charstring(face, glyph)
}

/// Returns the tables of the distances of pairs that the font's feature "kern" uses.
fn pair_tables<'a>(face: &Face<'a>) -> Vec<PairAdjustment<'a>> {
    let Some(table) = face.tables().gpos else { return Vec::new() };
    let mut lookups: Vec<u16> = table
        .features
        .into_iter()
        .filter(|feature| feature.tag == Tag::from_bytes(b"kern"))
        .flat_map(|feature| feature.lookup_indices.into_iter())
        .collect();
    lookups.sort_unstable();
    lookups.dedup();
    let mut pairs = Vec::new();
    for lookup in lookups.into_iter().filter_map(|number| table.lookups.get(number)) {
        for part in lookup.subtables.into_iter::<PositioningSubtable<'_>>().take(MOST_TABLES) {
            if pairs.len() >= MOST_TABLES {
                return pairs;
            }
            if let PositioningSubtable::Pair(pair) = part {
                pairs.push(pair);
            }
        }
    }
    pairs
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn broken_fonts_are_errors() {
        let whole = ttf_noto_sans::REGULAR;
        assert!(Font::read(whole.to_vec()).is_ok());
        for length in [0, 4, 11, 100, 400] {
            assert!(Font::read(whole[..length].to_vec()).is_err(), "{length}");
        }
    }

    #[test]
    fn damaged_outlines_do_not_panic() {
        let mut content = ttf_noto_sans::REGULAR.to_vec();
        // Every 97th byte behind the directory of tables is another one.
        content.iter_mut().skip(400).step_by(97).for_each(|byte| *byte = byte.wrapping_mul(31) ^ 0x5a);
        let Ok(font) = Font::read(content) else { return };
        let sized = font.at_size(1.0, 0.01).expect("measures");
        for letter in ' '..'~' {
            if let Some(glyph) = sized.glyph(letter) {
                let _ = sized.area(glyph);
            }
        }
    }

    #[test]
    fn a_and_v_are_closer_than_their_widths() {
        let font = Font::default();
        let sized = font.at_size(1.0, 0.01).expect("measures");
        let [a, v, h] = ['A', 'V', 'H'].map(|letter| sized.glyph(letter).expect("a letter"));
        assert!(sized.pair(a, v) < -0.02, "{}", sized.pair(a, v));
        assert_eq!(sized.pair(h, h), 0.0);
    }
}
