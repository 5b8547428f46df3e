//! A file of changes of the ground, on its way from the script's folder to a terrain.

use std::sync::{Arc, LazyLock};

use burgeon_base::error::{Error, Result};
use burgeon_kit::{Expectation, Kind, Object, Parameter, Table, Value};
use burgeon_kit::{LoadRequest, LoadedObject, Loader, object};

/// The text of a file that keeps changes of the ground.
#[derive(Debug, Clone)]
pub struct EditFile {
    /// What the script calls it.
    pub name: String,
    /// What it holds.
    pub text: Arc<str>,
}

impl EditFile {
    /// The type, as scripts see it.
    pub fn kind() -> &'static Arc<Kind> {
        static KIND: LazyLock<Arc<Kind>> = LazyLock::new(|| {
            let loader = Loader {
                what: "file of edits",
                example: "edits(\"ground.json\")",
                example_with_fields: "edits(\"ground.json\")",
                load,
            };
            Arc::new(
                Kind::new("edits", "Changes of the ground that a file keeps.").loaded(Vec::new(), loader),
            )
        });
        &KIND
    }
}

fn load(file: &mut LoadRequest<'_>, _: &Table) -> Result<LoadedObject> {
    let name = file.name;
    let text = String::from_utf8(file.read("name a .json file")?)
        .map_err(|_| Error::data(format!("{name} is not text, so it holds no edits of a terrain")))?;
    let memory = text.len();
    let object = Arc::new(EditFile { name: name.to_owned(), text: text.into() });
    Ok(LoadedObject { object, memory, warnings: Vec::new() })
}

impl Parameter for EditFile {
    fn luau() -> String {
        "Edits".into()
    }

    fn from_value(value: Value) -> Result<Self, Expectation> {
        object(value, "edits that were kept: edits(\"ground.json\")").map(|file: Arc<Self>| (*file).clone())
    }

    fn into_value(self) -> Value {
        Value::Object(Arc::new(self))
    }
}

impl Object for EditFile {
    fn kind(&self) -> &Arc<Kind> {
        Self::kind()
    }

    fn boxed(&self) -> Box<dyn Object> {
        Box::new(self.clone())
    }
}
