//! What pages say.

use serde::Deserialize;
use serde_json::Value;

use super::Event;
use burgeon_base::error::Error;

/// What a page says.
#[derive(Debug, Clone, Deserialize)]
#[serde(tag = "type", rename_all = "lowercase", deny_unknown_fields)]
pub enum PageCommand {
    /// Sets parameters, by name; nothing puts the default back.
    Set {
        /// Comes back if they are refused.
        id: Option<u64>,
        /// Values as text; numbers and switches may come as they are.
        params: serde_json::Map<String, Value>,
    },
    /// Puts all defaults back.
    Reset {},
    /// Sets the seed.
    Seed {
        /// A whole number from 0, as text.
        seed: Value,
    },
    /// Derives at most so many steps, or to the end.
    Steps {
        /// The limit.
        steps: Option<usize>,
    },
    /// Stops the run, and takes its values, seed and limit back to those of the model that is shown.
    Cancel {},
    /// Opens a line in the editor.
    Open {
        /// A file of the script, as errors name it.
        file: String,
        /// The line, from 1.
        line: Option<usize>,
    },
    /// Which module made a triangle, by glTF's indices.
    Pick(PickCommand),
    /// What a line of a script made.
    Highlight {
        /// Comes back with the answer.
        id: u64,
        /// The file.
        file: String,
        /// The line, from 1.
        line: usize,
    },
    /// A part of a chain.
    Chain {
        /// Comes back with the answer.
        id: u64,
        /// The system's place in the script, from 0.
        system: usize,
        /// The chain.
        chain: usize,
        /// The module in the middle.
        module: usize,
    },
    /// Saves, loads or deletes a preset.
    Preset {
        /// `save`, `load` or `delete`.
        action: String,
        /// The preset's name.
        name: String,
        /// Whether one of that name may be saved over.
        #[serde(default)]
        replace: bool,
    },
    /// Asks for small pictures of other values.
    Variations {
        /// Comes back with the answers.
        id: u64,
        /// Other seeds.
        seeds: Option<Vec<String>>,
        /// A parameter.
        param: Option<String>,
        /// Other values of the parameter.
        values: Option<Vec<String>>,
    },
}

/// A triangle of the model, by glTF's indices.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PickCommand {
    /// Comes back with the answer.
    pub id: u64,
    /// The mesh.
    pub mesh: usize,
    /// The primitive of the mesh.
    pub primitive: usize,
    /// The triangle of the primitive.
    pub triangle: usize,
    /// The instance of the node, if it has several.
    pub instance: Option<usize>,
    /// The node.
    pub node: Option<usize>,
}

/// Reads a page's message. Fails with what is to be told to the page.
pub fn read(text: &str) -> Result<PageCommand, Box<Event>> {
    let refuse = |id: Option<u64>, error: Error| Err(Box::new(Event::refused(id, &error)));
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
