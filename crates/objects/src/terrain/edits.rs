//! A file of terrain edits, loaded by a script and passed to a terrain.

use std::sync::Arc;

use burgeon_base::error::{Error, Result};
use burgeon_kit::{Expectation, Parameter, Table, Value};
use burgeon_kit::{LoadRequest, LoadedObject, Loader, methods, object};

/// Terrain edits stored in a file.
#[object("edits", loader = LOADER)]
#[derive(Debug)]
pub struct EditFile {
    /// Name in the script.
    pub name: String,
    /// Content of the file.
    pub text: Arc<str>,
}

#[methods("edits")]
impl EditFile {}

const LOADER: Loader = Loader {
    what: "edits file",
    example: "edits(\"ground.json\")",
    example_with_fields: "edits(\"ground.json\")",
    several: &[],
    load,
};

fn load(file: &mut LoadRequest<'_>, _: &Table) -> Result<LoadedObject> {
    let name = file.name;
    let text = String::from_utf8(file.read("specify a .json file")?)
        .map_err(|_| Error::data(format!("{name} is not text, so it contains no terrain edits")))?;
    let memory = text.len();
    let object = Arc::new(EditFile { name: name.to_owned(), text: text.into() });
    Ok(LoadedObject { object, memory, warnings: Vec::new() })
}

impl Parameter for EditFile {
    fn luau() -> String {
        "Edits".into()
    }

    fn from_value(value: Value) -> Result<Self, Expectation> {
        object(value, "stored edits: edits(\"ground.json\")").map(Arc::unwrap_or_clone)
    }

    fn into_value(self) -> Value {
        Value::Object(Arc::new(self))
    }
}
