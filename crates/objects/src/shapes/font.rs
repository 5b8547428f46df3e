//! Fonts of files.

use std::sync::Arc;

use burgeon_base::error::{Error, Result};
use burgeon_kit::{Expectation, LoadRequest, LoadedObject, Loader, Parameter, Table, Value, methods, object};
use burgeon_shapes::Font;

/// A font of a TrueType or OpenType file, for the function text.
///
/// A font is immutable; copies share it.
#[object("font", loader = LOADER)]
#[derive(Debug)]
pub struct FontObject {
    pub(super) font: Arc<Font>,
}

#[methods("font")]
impl FontObject {}

const LOADER: Loader = Loader {
    what: "font",
    example: "font(\"sign.ttf\")",
    example_with_fields: "font(\"sign.ttf\")",
    several: &[],
    load,
};

fn load(file: &mut LoadRequest<'_>, _: &Table) -> Result<LoadedObject> {
    let content = file.read("specify a .ttf or .otf file")?;
    let font = Font::read(content).map_err(|error| {
        let text = format!("cannot read {}: {}", file.name, error.message());
        Error::file(file.path, text).help(error.remedy().unwrap_or("use a .ttf or .otf file").to_owned())
    })?;
    let memory = font.memory();
    Ok(LoadedObject { object: Arc::new(FontObject { font: Arc::new(font) }), memory, warnings: Vec::new() })
}

impl Parameter for FontObject {
    fn luau() -> String {
        "Font".into()
    }

    fn from_value(value: Value) -> Result<Self, Expectation> {
        object(value, "a font, loaded once before: font(\"sign.ttf\")").map(Arc::unwrap_or_clone)
    }

    fn into_value(self) -> Value {
        Value::Object(Arc::new(self))
    }
}
