//! Shapes of texts.

use burgeon_base::error::{Error, Result};
use burgeon_base::{MemoryOwner, Stop};
use burgeon_geometry::Rings;
use glam::{DMat3, DVec2, DVec3};
use rustc_hash::FxHashMap;
use ttf_parser::GlyphId;

use super::Font;
use super::layout::{MISSING, TextLayout, place_letters};
use crate::Shape;
use crate::mesh::PolygonMeshBuilder;
use crate::style::{FaceStyle, SharedStyle};

/// Thickness (m) of the lines of a missing letter's box, for letters of 1 m.
const FRAME: f64 = 0.08;

/// Differences between a text and its shape.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct TextRemarks {
    /// Letters that the font lacks, each once. Boxes stand for them.
    pub missing: Vec<char>,
    /// Set if letters belong to a script that joins or reorders them, such as Arabic.
    pub is_unshaped: bool,
}

impl Shape {
    /// Returns the letters of a text as faces that look upwards: x along the line, the first line on the x axis.
    ///
    /// Faces have the tags "text.1", "text.2" and so on, by their letter, without spaces. Fails if a measure is not above 0,
    /// and if no letter has an outline.
    ///
    /// ```
    /// use burgeon_shapes::{Font, Shape, TextAlign, TextLayout};
    ///
    /// let layout = TextLayout { size: 1.0, align: TextAlign::Left, spacing: 0.0, line_height: None, tolerance: 0.002 };
    /// let (text, remarks) = Shape::text("HI", &Font::default(), &layout)?;
    /// assert!(remarks.missing.is_empty());
    /// assert_eq!((text.body.faces(), text.scope().size.y), (2, 1.0));
    /// # Ok::<(), burgeon_base::Error>(())
    /// ```
    pub fn text(text: &str, font: &Font, layout: &TextLayout) -> Result<(Self, TextRemarks)> {
        let lengths = [
            ("size", Some(layout.size)),
            ("line_height", layout.line_height),
            ("tolerance", Some(layout.tolerance)),
        ];
        for (name, length) in lengths {
            if let Some(length) = length.filter(|length| !(*length > 0.0 && *length < 1e7)) {
                return Err(Error::argument(format!("{name} is {length} m"))
                    .help("use a length above 0 and below 1e7 m"));
            }
        }
        if layout.spacing.is_nan() || layout.spacing.abs() >= 1e7 {
            return Err(
                Error::argument(format!("spacing is {} m", layout.spacing)).help("use a length below 1e7 m")
            );
        }
        MemoryOwner::ensure_room(text.len().saturating_mul(size_of::<super::layout::PlacedLetter>()))?;
        let sized = font.at_size(layout.size, layout.tolerance)?;
        let (letters, missing) = place_letters(text, &sized, layout);
        let mut known: FxHashMap<GlyphId, Vec<Rings<DVec2>>> = FxHashMap::default();
        let mut builder = PolygonMeshBuilder::default();
        let (mut room, mut number) = (0, 0);
        for letter in &letters {
            Stop::check_current()?;
            let area = match letter.glyph {
                Some(glyph) => match known.get(&glyph) {
                    Some(area) => area,
                    None => known.entry(glyph).or_insert(sized.area(glyph)?),
                },
                None => &missing_box(layout.size),
            };
            if area.is_empty() {
                continue;
            }
            number += 1;
            let points: usize = area.iter().flat_map(|rings| rings.iter()).map(Vec::len).sum();
            room += points * (2 * size_of::<DVec3>() + size_of::<[u64; 8]>());
            MemoryOwner::ensure_room(room)?;
            let tag: SharedStyle = FaceStyle::with_tag(&None, &format!("text.{number}").into());
            for rings in area {
                let place = |at: &DVec2| DVec3::new(at.x + letter.x, at.y + letter.y, 0.0);
                let rings: Vec<Vec<DVec3>> =
                    rings.iter().map(|ring| ring.iter().map(place).collect()).collect();
                builder.face(rings.iter().map(Vec::as_slice), &tag);
            }
        }
        let mesh = builder.build();
        if mesh.faces.is_empty() {
            let message =
                if letters.is_empty() { "the text has no letters" } else { "no letter has an outline" };
            return Err(Error::argument(message)
                .help("give a text with a letter, and ask before: if name ~= \"\" then"));
        }
        let is_unshaped = text.chars().any(needs_shaping);
        Ok((Self::of_mesh(mesh, DMat3::IDENTITY), TextRemarks { missing, is_unshaped }))
    }
}

/// Returns the frame that stands for a letter that the font lacks.
fn missing_box(size: f64) -> Vec<Rings<DVec2>> {
    let gap = (MISSING[1] - MISSING[0]) / 2.0;
    let corners = |inset: f64| -> Vec<DVec2> {
        let (low, high) = (DVec2::new(gap + inset, inset), DVec2::new(gap + MISSING[0] - inset, 1.0 - inset));
        [low, DVec2::new(high.x, low.y), high, DVec2::new(low.x, high.y)].map(|at| at * size).to_vec()
    };
    let mut hole = corners(FRAME);
    hole.reverse();
    vec![Rings(vec![corners(0.0), hole])]
}

/// Returns true for letters of scripts that join letters, reorder them or run from right to left.
fn needs_shaping(letter: char) -> bool {
    matches!(u32::from(letter),
        0x0590..=0x08ff | 0x0900..=0x0dff | 0x0e00..=0x109f | 0x1780..=0x18af | 0xfb1d..=0xfdff | 0xfe70..=0xfefe)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::text::TextAlign;

    fn layout() -> TextLayout {
        TextLayout { size: 1.0, align: TextAlign::Left, spacing: 0.0, line_height: None, tolerance: 0.002 }
    }

    fn text(text: &str, layout: &TextLayout) -> (Shape, TextRemarks) {
        Shape::text(text, &Font::default(), layout).expect("a text")
    }

    #[test]
    fn every_letter_of_the_font_is_a_solid_when_it_is_extruded() {
        let mut count = 0;
        for letter in ('!'..='~').chain('¡'..='ž').chain('Α'..='ώ').chain('Ѐ'..='џ') {
            if !Font::default().has(letter) {
                continue;
            }
            let Ok((face, _)) = Shape::text(&letter.to_string(), &Font::default(), &layout()) else {
                continue;
            };
            let solid = face.extrude(0.5, None).expect("a solid");
            assert!(solid.is_closed(), "{letter}");
            assert!((solid.volume() - 0.5 * face.area()).abs() < 1e-9, "{letter}");
            count += 1;
        }
        assert!(count > 400, "{count}");
    }

    #[test]
    fn letters_with_counters_have_holes() {
        let holes = |letter: &str| {
            text(letter, &layout()).0.mesh().faces.iter().map(|face| face.rings.len() - 1).sum()
        };
        let counts: Vec<usize> = ["H", "O", "B", "8", "%", "i"].into_iter().map(holes).collect();
        assert_eq!(counts, [0, 1, 2, 2, 2, 0]);
        assert_eq!(text("i", &layout()).0.body.faces(), 2);
    }

    #[test]
    fn a_text_has_the_size_of_its_capitals_and_is_aligned() {
        for (align, middle) in [(TextAlign::Left, 0.5), (TextAlign::Center, 0.0), (TextAlign::Right, -0.5)] {
            let (shape, _) = text("HOUSE", &TextLayout { size: 2.0, align, ..layout() });
            assert!((shape.scope().size.y - 2.0).abs() < 0.1, "{}", shape.scope().size.y);
            let center = shape.scope().center().x / shape.scope().size.x;
            assert!((center - middle).abs() < 0.05, "{align:?} {center}");
        }
        let wide = text("HOUSE", &TextLayout { spacing: 0.5, ..layout() }).0.scope().size.x;
        assert!((wide - text("HOUSE", &layout()).0.scope().size.x - 2.0).abs() < 1e-9);
        let tall = text("H\nH", &TextLayout { line_height: Some(3.0), ..layout() }).0.scope().size.y;
        assert!((tall - 4.0).abs() < 1e-9, "{tall}");
    }

    #[test]
    fn a_missing_letter_is_a_box_and_is_named_once() {
        let (shape, remarks) = text("a漢漢b", &layout());
        assert_eq!((remarks.missing, remarks.is_unshaped, shape.body.faces()), (vec!['漢'], false, 4));
        assert!(text("אב", &layout()).1.is_unshaped);
        for empty in ["", " \n\t "] {
            assert!(Shape::text(empty, &Font::default(), &layout()).is_err());
        }
    }

    #[test]
    fn faces_are_tagged_by_their_letter() {
        let (shape, _) = text("a ij", &layout());
        let tags: Vec<String> = shape
            .styles()
            .iter()
            .flatten()
            .flat_map(|style| style.tags.iter().map(ToString::to_string))
            .collect();
        assert_eq!(tags, ["text.1", "text.2", "text.2", "text.3", "text.3"]);
    }
}
