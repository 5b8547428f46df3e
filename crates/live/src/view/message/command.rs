//! Messages from pages.

use serde::Deserialize;
use serde_json::Value;

use super::Event;
use burgeon_base::error::Error;

/// Message from a page.
#[derive(Debug, Clone, Deserialize)]
#[serde(tag = "type", rename_all = "lowercase", deny_unknown_fields)]
pub enum PageCommand {
    /// Sets parameters by name; null restores the default.
    Set {
        /// Id to return if the values are rejected.
        id: Option<u64>,
        /// Values as strings; numbers, booleans and lists of points are also accepted.
        params: serde_json::Map<String, Value>,
    },
    /// Restores all defaults.
    Reset {},
    /// Sets the seed.
    Seed {
        /// Seed as a string: an integer from 0.
        seed: Value,
    },
    /// Limits the derivation to a number of steps, or removes the limit.
    Steps {
        /// Maximum number of steps; `None` for no limit.
        steps: Option<usize>,
    },
    /// Cancels the run, and restores the values, seed and limit of the model that is shown.
    Cancel {},
    /// Opens a line in the editor.
    Open {
        /// File of the script, as errors name it.
        file: String,
        /// Line, from 1.
        line: Option<usize>,
    },
    /// Reads a file of the script for the page's editor.
    Read {
        /// Id to return with the answer.
        id: u64,
        /// File of the script.
        file: String,
    },
    /// Writes a file of the script.
    Write {
        /// Id to return with the answer.
        id: u64,
        /// File of the script.
        file: String,
        /// New content.
        text: String,
        /// Hash of the content that the page knows. A file with other content is not overwritten.
        hash: String,
    },
    /// Queries the module that made a triangle, by glTF's indices.
    Pick(PickCommand),
    /// Queries the modules and triangles that a line of a script made.
    Highlight {
        /// Id to return with the answer.
        id: u64,
        /// File of the script.
        file: String,
        /// Line, from 1.
        line: usize,
    },
    /// Queries the place of a camera of the script, or of a view that is fitted to the model.
    Camera {
        /// Id to return with the answer.
        id: u64,
        /// Name of a camera of the script.
        name: Option<String>,
        /// View without a name: `plan` or `eye`.
        view: Option<String>,
        /// Azimuth from north, clockwise (degrees), of the view `eye`.
        azimuth: Option<f64>,
        /// Ratio of the page's width to its height.
        aspect: f64,
    },
    /// Queries the chains of a model whose feature or number matches a search.
    Parts {
        /// Id to return with the answer.
        id: u64,
        /// Words, all of which the id of a feature contains; empty for all chains.
        search: String,
    },
    /// Queries the triangles of a system, of one of its chains, or of the modules of a symbol.
    Part {
        /// Id to return with the answer.
        id: u64,
        /// Index of the system in the script, from 0.
        system: usize,
        /// Index of a chain.
        chain: Option<usize>,
        /// Symbol of the modules.
        symbol: Option<String>,
    },
    /// Queries a part of a chain.
    Chain {
        /// Id to return with the answer.
        id: u64,
        /// Index of the system in the script, from 0.
        system: usize,
        /// Index of the chain.
        chain: usize,
        /// Index of the module in the centre.
        module: usize,
    },
    /// Saves, loads or deletes a preset.
    Preset {
        /// `save`, `load` or `delete`.
        action: String,
        /// Name of the preset.
        name: String,
        /// Set if an existing preset of that name may be overwritten.
        #[serde(default)]
        replace: bool,
    },
    /// Queries the outline of a drawn function, curve or surface with other points.
    Outline {
        /// Id to return with the answer.
        id: u64,
        /// Name of the parameter.
        param: String,
        /// Control points.
        points: Value,
    },
    /// Saves the points of a drawn function, curve or surface in the file next to the script.
    Store {
        /// Id to return with the answer.
        id: u64,
        /// Name of the parameter.
        param: String,
        /// Control points.
        points: Value,
    },
    /// Requests small renders with other values.
    Variations {
        /// Id to return with the answers.
        id: u64,
        /// Seeds to vary.
        seeds: Option<Vec<String>>,
        /// Parameter to vary.
        param: Option<String>,
        /// Values of the parameter.
        values: Option<Vec<String>>,
    },
}

/// Triangle of the model, by glTF's indices.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PickCommand {
    /// Id to return with the answer.
    pub id: u64,
    /// Index of the mesh.
    pub mesh: usize,
    /// Index of the primitive in the mesh.
    pub primitive: usize,
    /// Index of the triangle in the primitive.
    pub triangle: usize,
    /// Instance of the node, if the node has several.
    pub instance: Option<usize>,
    /// Index of the node.
    pub node: Option<usize>,
}

/// Parses a page's message. Fails with the event to send to the page.
///
/// ```
/// use burgeon_live::message::{Event, PageCommand, read};
///
/// let command = read(r#"{ "type": "steps", "steps": 4 }"#).expect("a command");
/// assert!(matches!(command, PageCommand::Steps { steps: Some(4) }));
/// let event = read(r#"{ "type": "dance", "id": 3 }"#).expect_err("there is no such command");
/// assert!(matches!(*event, Event::Refused { id: Some(3), .. }));
/// ```
pub fn read(text: &str) -> Result<PageCommand, Box<Event>> {
    let refuse = |id: Option<u64>, error: Error| Err(Box::new(Event::rejection(id, &error)));
    let value: Value = match serde_json::from_str(text) {
        Ok(value @ Value::Object(_)) => value,
        Ok(_) => return refuse(None, Error::argument("a message is a JSON object with a type")),
        Err(error) => return refuse(None, Error::syntax(format!("a message is a JSON object: {error}"))),
    };
    let id = value.get("id").and_then(Value::as_u64);
    match serde_json::from_value(value) {
        Ok(ask) => Ok(ask),
        Err(error) => refuse(id, Error::argument(format!("cannot read this message: {error}"))),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn messages_of_pages_are_read_or_refused_with_their_id() {
        assert!(matches!(read(r#"{"type":"set","params":{"a":"1","b":null}}"#), Ok(PageCommand::Set { .. })));
        assert!(matches!(read(r#"{"type":"steps","steps":null}"#), Ok(PageCommand::Steps { steps: None })));
        assert!(matches!(
            read(r#"{"type":"pick","id":1,"mesh":0,"primitive":0,"triangle":3,"instance":null,"node":0}"#),
            Ok(PageCommand::Pick(_))
        ));
        let wrong = [
            "",
            "7",
            "[]",
            "null",
            "{}",
            r#"{"type":7}"#,
            r#"{"type":"fly"}"#,
            r#"{"type":"set"}"#,
            r#"{"type":"steps","steps":-1}"#,
            r#"{"type":"open","file":1}"#,
            "\u{0}",
            r#"{"type":"set","params":[]}"#,
        ];
        for text in wrong {
            let refused = read(text).unwrap_err();
            assert!(matches!(*refused, Event::Refused { id: None, .. }), "{text}");
        }
        let Event::Refused { id, text, code } = *read(r#"{"type":"pick","id":9}"#).unwrap_err() else {
            panic!()
        };
        assert_eq!((id, code), (Some(9), "argument"));
        assert!(text.contains("mesh"), "{text}");
        assert!(read(&"[".repeat(100_000)).is_err());
    }
}
