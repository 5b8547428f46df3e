//! A file of changes of the ground, on its way from the script's folder to a terrain.

use std::sync::Arc;

use crate::error::Error;
use crate::objects::parameter::object;
use crate::objects::{Expected, Kind, Object, Parameter, Table, Value};

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
    pub const KIND: Kind = Kind {
        name: "edits",
        doc: "Changes of the ground that a file keeps.",
        fields: &[],
        first: None,
        methods: &[],
        construct: |_: &Table| {
            Err(Error::argument("edits come from a file").help("write edits(\"ground.json\")"))
        },
    };
}

impl Parameter for EditFile {
    fn luau() -> String {
        "Edits".into()
    }

    fn from_value(value: Value) -> Result<Self, Expected> {
        object(value, "edits that were kept: edits(\"ground.json\")").map(|file: Arc<Self>| (*file).clone())
    }

    fn into_value(self) -> Value {
        Value::Object(Arc::new(self))
    }
}

impl Object for EditFile {
    fn kind(&self) -> &'static Kind {
        const { &Self::KIND }
    }

    fn boxed(&self) -> Box<dyn Object> {
        Box::new(self.clone())
    }
}
