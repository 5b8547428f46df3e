//! Text as faces.
//!
//! Input: characters, and a font file's content. Output: faces with holes. Letters are placed one after the other, as their
//! widths and the font's pair distances say; letters of scripts that join or reorder them are not.

mod cff_table;
mod charstring_work;
mod curves;
mod font;
mod glyph_parts;
mod layout;
mod letters;

pub use font::Font;
pub use layout::{TextAlign, TextLayout};
pub use letters::TextRemarks;
