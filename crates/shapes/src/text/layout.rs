//! Places of letters on lines.

use ttf_parser::GlyphId;
use unicode_normalization::UnicodeNormalization;

use super::font::SizedFont;

/// Places of the lines of a text along x.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum TextAlign {
    /// Lines begin at x = 0.
    #[default]
    Left,
    /// The middle of each line is at x = 0.
    Center,
    /// Lines end at x = 0.
    Right,
}

/// Measures of a text.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TextLayout {
    /// Height (m) of capital letters.
    pub size: f64,
    /// Places of the lines.
    pub align: TextAlign,
    /// Distance (m) added between letters.
    pub spacing: f64,
    /// Distance (m) between lines; that of the font if `None`.
    pub line_height: Option<f64>,
    /// Maximum distance (m) between a curve and its lines.
    pub tolerance: f64,
}

/// A letter, or a box in its place, on the plane of the text.
pub(super) struct PlacedLetter {
    /// Outline; `None` for a box.
    pub glyph: Option<GlyphId>,
    /// Position (m) on the line.
    pub x: f64,
    /// Height (m) of the line.
    pub y: f64,
}

/// Width (m) of the box of a missing letter, for letters of 1 m, and the distance to the next letter.
pub(super) const MISSING: [f64; 2] = [0.6, 0.8];

/// Places the letters of a text, and returns those that the font lacks, each once.
pub(super) fn place_letters(
    text: &str,
    font: &SizedFont<'_>,
    layout: &TextLayout,
) -> (Vec<PlacedLetter>, Vec<char>) {
    let (mut letters, mut missing): (Vec<PlacedLetter>, Vec<char>) = (Vec::new(), Vec::new());
    let line_height = layout.line_height.unwrap_or(font.line);
    let mut y = 0.0;
    for line in text.lines() {
        let first = letters.len();
        let (mut x, mut last): (f64, Option<GlyphId>) = (0.0, None);
        let mut end = 0.0;
        for letter in line.nfc() {
            let letter = if letter == '\t' { ' ' } else { letter };
            let glyph = font.glyph(letter);
            if glyph.is_none() && letter.is_whitespace() {
                x += 0.3 * layout.size + layout.spacing;
                last = None;
                continue;
            }
            // Characters that control the line have no outline.
            if letter.is_control() || matches!(letter, '\u{200b}'..='\u{200f}' | '\u{feff}') {
                continue;
            }
            if let (Some(left), Some(right)) = (last, glyph) {
                x += font.pair(left, right);
            }
            if glyph.is_none() && !missing.contains(&letter) {
                missing.push(letter);
            }
            letters.push(PlacedLetter { glyph, x, y });
            x += glyph.map_or(MISSING[1] * layout.size, |glyph| font.advance(glyph));
            end = x;
            x += layout.spacing;
            last = glyph;
        }
        let shift = match layout.align {
            TextAlign::Left => 0.0,
            TextAlign::Center => -end / 2.0,
            TextAlign::Right => -end,
        };
        letters[first..].iter_mut().for_each(|letter| letter.x += shift);
        y -= line_height;
    }
    (letters, missing)
}
