//! Text as shapes, for scripts.

use std::sync::Arc;

use burgeon_base::error::{Error, Result};
use burgeon_base::text::listed;
use burgeon_base::warning::{Warning, WarningKind, defer_warning};
use burgeon_kit::{Parameter, Table, Value, fields};
use burgeon_shapes::{Font, Shape, TextAlign, TextLayout, TextRemarks};

use super::font::FontObject;
use super::object::ShapeObject;

/// Part of the size that is the maximum distance between curves and their lines, unless given.
const TOLERANCE: f64 = 0.002;

/// Options of `text(letters, { ... })`.
#[fields("text")]
pub(super) struct TextOptions {
    /// Height of capital letters (m).
    #[default(1.0)]
    pub size: f64,
    /// Font of a file; Noto Sans unless given.
    pub font: Option<FontObject>,
    /// Part of a line that is at x = 0: "left", "center" or "right".
    #[default("left".into())]
    pub align: String,
    /// Distance added between letters (m).
    #[default(0.0)]
    pub spacing: f64,
    /// Distance between lines (m); that of the font unless given.
    pub line_height: Option<f64>,
    /// Maximum distance of curves from their lines (m); a five hundredth of the size unless given.
    pub tolerance: Option<f64>,
}

/// Makes the shape of a text.
pub(super) fn text(given: &[Value]) -> Result<Value> {
    let (letters, options) = match given {
        [letters] => (letters, None),
        [letters, options] => (letters, Some(options)),
        _ => {
            return Err(Error::argument(format!("text takes 1 or 2 arguments, not {}", given.len()))
                .help("write text(\"Bakery\", { size = 0.4 })"));
        }
    };
    let words = String::read_value(letters).map_err(|error| error.refuse("text", "letters", letters))?;
    if let Some(place) = words.chars().position(|letter| letter == char::REPLACEMENT_CHARACTER) {
        let message =
            format!("text: character {} of the text is no letter: its bytes are not UTF-8", place + 1);
        return Err(Error::argument(message)
            .help("save the script or the data as UTF-8, and take parts of a text with utf8.offset"));
    }
    let options = match options {
        None => TextOptions::default(),
        Some(table) => {
            let read =
                Arc::<Table>::read_value(table).map_err(|error| error.refuse("text", "options", table))?;
            TextOptions::from_table(&read)?
        }
    };
    let align = match options.align.as_str() {
        "left" => TextAlign::Left,
        "center" => TextAlign::Center,
        "right" => TextAlign::Right,
        other => {
            return Err(Error::argument(format!("text: unknown alignment {other:?}"))
                .help("use \"left\", \"center\" or \"right\""));
        }
    };
    let layout = TextLayout {
        size: options.size,
        align,
        spacing: options.spacing,
        line_height: options.line_height,
        tolerance: options.tolerance.unwrap_or(options.size * TOLERANCE),
    };
    let font = options.font.map_or_else(|| Arc::new(Font::default()), |font| font.font);
    let (shape, remarks) = Shape::text(&words, &font, &layout).map_err(|error| error.about("text"))?;
    report(&remarks);
    Ok(Value::Object(Arc::new(ShapeObject::new(shape))))
}

/// Reports letters that differ from the text.
fn report(remarks: &TextRemarks) {
    let warn = |text: String, help: &str| {
        defer_warning(Warning::new(WarningKind::Doubtful, format!("text: {text}")).help(help));
    };
    if !remarks.missing.is_empty() {
        let letters: Vec<String> = remarks.missing.iter().map(|letter| format!("{letter:?}")).collect();
        let names = listed(letters.iter().map(String::as_str));
        warn(
            format!("the font lacks {names}, so boxes stand for them"),
            "use a font that has these letters: font(\"file.ttf\")",
        );
    }
    if remarks.is_unshaped {
        warn(
            "letters are placed from left to right without joining or reordering them".into(),
            "use letters of a script that needs neither, or import the text as a model",
        );
    }
}
