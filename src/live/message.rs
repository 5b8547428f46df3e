//! What server and page say to each other: JSON objects whose `type` is the name of the case.
//!
//! Everything that the server says goes to all pages, except answers with an `id`, which go to the page that
//! asked. Whole numbers of 64 bits travel as text. Times are in milliseconds, lengths in metres with z up; the
//! model itself is glTF, y up.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};
use serde_json::Value;

use crate::script::{Control, Param, Setting};

/// What the server says.
#[derive(Debug, Clone, Serialize)]
#[serde(tag = "type", rename_all = "lowercase")]
pub enum Say {
    /// First on every connection; the present state follows.
    Hello(Hello),
    /// The script does not exist (yet).
    Waiting {
        /// What is waited for.
        text: String,
    },
    /// A run has begun.
    Working {
        /// The run's number, from 1.
        run: u64,
        /// Why it runs.
        cause: Cause,
        /// The files that changed.
        files: Vec<String>,
    },
    /// How far a run has come, ten times a second.
    Progress {
        /// The run's number.
        run: u64,
        /// It in words.
        message: String,
        /// The last step that is done.
        step: usize,
        /// The greatest number of steps, if there is one.
        steps: Option<usize>,
        /// Modules in the chains.
        modules: usize,
    },
    /// A run has ended well; the page shows its model.
    Model(Box<Model>),
    /// A run has failed; the last model stays, stale.
    Error {
        /// The run's number.
        run: u64,
        /// Why it ran.
        cause: Cause,
        /// All problems as text.
        text: String,
        /// Each problem: `{ message, file, line, rule, module, step, help }`, absent where unknown.
        errors: Vec<Value>,
    },
    /// A run was stopped, by a page or by a newer run.
    Cancelled {
        /// The run's number.
        run: u64,
    },
    /// The module that made a triangle.
    Picked(Box<Picked>),
    /// What a line of a script has made.
    Highlighted(Box<Highlighted>),
    /// A part of a chain.
    Chain {
        /// The question's id.
        id: u64,
        /// The system's place in the script, from 0.
        system: usize,
        /// The chain.
        chain: usize,
        /// The module in the middle.
        module: usize,
        /// Modules and brackets of the chain.
        of: usize,
        /// The text.
        #[serde(flatten)]
        text: Around,
    },
    /// The names of the presets have changed.
    Presets {
        /// All names, in the order of their file.
        names: Vec<String>,
    },
    /// A small picture of other values.
    Variation {
        /// The question's id.
        id: u64,
        /// Its number, from 0.
        index: usize,
        /// How many there will be.
        of: usize,
        /// What it is, for people.
        label: String,
        /// Its seed.
        seed: String,
        /// All values.
        params: BTreeMap<String, Value>,
        /// Where the picture is; nowhere if the script failed.
        url: Option<String>,
        /// Why it failed.
        error: Option<String>,
    },
    /// A message that could not be done.
    Refused {
        /// The message's id, if it had one.
        id: Option<u64>,
        /// Why, and what can be done.
        text: String,
    },
}

/// Who the server is.
#[derive(Debug, Clone, Serialize)]
pub struct Hello {
    /// Burgeon's version.
    pub version: &'static str,
    /// The script's file name.
    pub script: String,
    /// The script as it was named on the command line.
    pub path: String,
    /// Whether `open` opens an editor.
    pub editor: bool,
    /// The extensions of the formats of `export/`.
    pub formats: Vec<&'static str>,
    /// The names of the presets.
    pub presets: Vec<String>,
}

/// Why a run was begun.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Cause {
    /// The server has started.
    Start,
    /// A file changed.
    Save,
    /// A parameter was set.
    Parameters,
    /// The seed was set.
    Seed,
    /// The limit of steps was set.
    Steps,
    /// A preset was loaded.
    Preset,
}

/// The result of a run.
#[derive(Debug, Clone, Serialize)]
pub struct Model {
    /// The run's number.
    pub run: u64,
    /// Why it ran.
    pub cause: Cause,
    /// Where the `.glb` file is; nowhere if there is nothing to show or too much.
    pub url: Option<String>,
    /// The file's size.
    pub bytes: usize,
    /// Triangles that are seen, instances counted each.
    pub triangles: usize,
    /// Placed meshes.
    pub instances: usize,
    /// Modules of all systems.
    pub modules: usize,
    /// The box around what is seen (m, z up).
    pub bounds: Option<Bounds>,
    /// Steps of this model: the most of any system.
    pub steps: usize,
    /// Steps of the model when they are not limited, as far as that is known.
    pub last_step: usize,
    /// The limit of steps, if one is set.
    pub step_limit: Option<usize>,
    /// The seed.
    pub seed: String,
    /// The parameters in the script's order.
    pub params: Vec<Knob>,
    /// The systems in the order in which they were derived.
    pub systems: Vec<System>,
    /// The rules, with what they cost.
    pub rules: Vec<Rule>,
    /// Where the time went.
    pub times: Times,
    /// The files that decide what the model is.
    pub files: Vec<String>,
}

/// A box (m).
#[derive(Debug, Clone, Copy, Serialize)]
pub struct Bounds {
    /// The lowest corner.
    pub low: [f64; 3],
    /// The highest corner.
    pub high: [f64; 3],
}

/// A parameter with its control.
#[derive(Debug, Clone, Serialize)]
pub struct Knob {
    /// Its name.
    pub name: String,
    /// Its value in this run: a number, a switch or text.
    pub value: Value,
    /// The script's own value.
    pub default: Value,
    /// The script's value when this one was set, if the script has changed it since.
    pub old_default: Option<Value>,
    /// Whether the value is not the script's.
    pub changed: bool,
    /// What values it may have.
    pub control: KnobControl,
    /// The unit; may be empty.
    pub unit: String,
    /// What it does; may be empty.
    pub text: String,
}

/// What values a parameter may have.
#[derive(Debug, Clone, Serialize)]
#[serde(tag = "type", rename_all = "lowercase")]
pub enum KnobControl {
    /// A number within bounds, on a grid of steps from the lower bound.
    Number {
        /// The least value.
        min: Option<f64>,
        /// The greatest value.
        max: Option<f64>,
        /// The distance of neighbouring values.
        step: Option<f64>,
    },
    /// On or off.
    Switch,
    /// One of these.
    Choice {
        /// The values.
        choices: Vec<String>,
    },
    /// A colour as `#rrggbb`.
    Color,
    /// Free text.
    Text,
}

/// A derived system.
#[derive(Debug, Clone, Serialize)]
pub struct System {
    /// Its place in the script, from 0.
    pub system: usize,
    /// The file and line that made it.
    pub place: String,
    /// The number of chains.
    pub chains: usize,
    /// Modules in all chains.
    pub modules: usize,
    /// Derivation steps.
    pub steps: usize,
    /// The number of modules of each symbol.
    pub symbols: Vec<Count>,
}

/// How many modules have a symbol.
#[derive(Debug, Clone, Serialize)]
pub struct Count {
    /// The symbol.
    pub name: String,
    /// The number of modules.
    pub count: usize,
}

/// A rule and what it cost.
#[derive(Debug, Clone, Serialize)]
pub struct Rule {
    /// Its pattern.
    pub text: String,
    /// `rule` or `interpretation`.
    pub kind: &'static str,
    /// The file that has it; none if it is the engine's own.
    pub file: String,
    /// Its line.
    pub line: usize,
    /// How often it was applied.
    pub applied: usize,
    /// The modules and brackets that it made.
    pub made: usize,
    /// The time that it took (ms).
    pub ms: f64,
}

/// The module that made a triangle.
#[derive(Debug, Clone, Serialize)]
pub struct Picked {
    /// The question's id.
    pub id: u64,
    /// Whether it is known.
    pub found: bool,
    /// The module that drew the triangle, or placed it if nobody knows who drew it.
    #[serde(flatten)]
    pub made: Option<Made>,
    /// The module that placed the model to which the triangle belongs.
    pub placed: Option<Made>,
    /// The instance as it was asked about.
    pub instance: Option<usize>,
}

/// A module that made something.
#[derive(Debug, Clone, Serialize)]
pub struct Made {
    /// The system's place in the script, from 0.
    pub system: usize,
    /// The chain.
    pub chain: usize,
    /// The id of the chain's feature.
    pub feature: Option<String>,
    /// The module.
    pub module: Module,
    /// The rule that interprets it, unless the standard library does.
    pub interpretation: Option<RuleAt>,
    /// The modules that led to it, from the axiom on.
    pub path: Vec<Step>,
    /// The chain around it.
    pub chain_text: Around,
    /// What it has drawn.
    pub ranges: Vec<Range>,
}

/// A module.
#[derive(Debug, Clone, Serialize)]
pub struct Module {
    /// The whole.
    pub text: String,
    /// Its symbol.
    pub symbol: String,
    /// Its parameters.
    pub params: Vec<Named>,
    /// Its place in the chain, brackets counted.
    pub index: usize,
}

/// A parameter of a module.
#[derive(Debug, Clone, Serialize)]
pub struct Named {
    /// Its name.
    pub name: String,
    /// Its value as text.
    pub value: String,
}

/// A rule and its place.
#[derive(Debug, Clone, Serialize)]
pub struct RuleAt {
    /// Its pattern.
    pub text: String,
    /// The file that has it; none if it is the engine's own.
    pub file: String,
    /// Its line.
    pub line: usize,
}

/// A module on the way from the axiom to another.
#[derive(Debug, Clone, Serialize)]
pub struct Step {
    /// The derivation step that made it; 0 for the axiom.
    pub step: usize,
    /// The module.
    pub module: String,
    /// The rule that made it; none for the axiom.
    pub rule: Option<String>,
    /// The file of the rule or the axiom.
    pub file: String,
    /// Its line.
    pub line: usize,
    /// Its number among the modules of the same application, from 0.
    pub ordinal: usize,
}

/// A piece of a chain as text.
#[derive(Debug, Clone, Serialize)]
pub struct Around {
    /// What is before.
    pub before: String,
    /// The module in the middle.
    pub at: String,
    /// What is after.
    pub after: String,
}

/// What a line of a script has made.
#[derive(Debug, Clone, Serialize)]
pub struct Highlighted {
    /// The question's id.
    pub id: u64,
    /// The file as it was asked about.
    pub file: String,
    /// The line as it was asked about.
    pub line: usize,
    /// The rules at the line.
    pub what: String,
    /// The number of modules that came of them.
    pub modules: usize,
    /// What these have drawn.
    pub ranges: Vec<Range>,
}

/// Triangles of a primitive of the document.
#[derive(Debug, Clone, Serialize)]
pub struct Range {
    /// The mesh.
    pub mesh: usize,
    /// The primitive of the mesh.
    pub primitive: usize,
    /// The first triangle.
    pub from: usize,
    /// How many.
    pub count: usize,
    /// The node, if only that one is meant.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub node: Option<usize>,
    /// The instances of the node, if only these are meant.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub instances: Option<Vec<usize>>,
}

/// Where the time of a run went (ms).
#[derive(Debug, Clone, Copy, Serialize)]
pub struct Times {
    /// Starting the machine and running the script.
    pub script: f64,
    /// Finding and applying rules.
    pub rewriting: f64,
    /// Interpretation.
    pub interpretation: f64,
    /// Building the scene.
    pub scene: f64,
    /// Writing the model's bytes.
    pub encode: f64,
    /// From the file's change or the page's message to the model's bytes being ready.
    pub total: f64,
}

/// What a page says.
#[derive(Debug, Clone, Deserialize)]
#[serde(tag = "type", rename_all = "lowercase", deny_unknown_fields)]
pub enum Ask {
    /// Sets parameters, by name; nothing puts the default back.
    Set {
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
    /// Stops the run.
    Cancel {},
    /// Opens a line in the editor.
    Open {
        /// A file of the script, as errors name it.
        file: String,
        /// The line, from 1.
        line: Option<usize>,
    },
    /// Which module made a triangle, by glTF's indices.
    Pick(Pick),
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
pub struct Pick {
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
pub fn read(text: &str) -> Result<Ask, Box<Say>> {
    let refuse = |id: Option<u64>, text: String| Err(Box::new(Say::Refused { id, text }));
    let value: Value = match serde_json::from_str(text) {
        Ok(value @ Value::Object(_)) => value,
        Ok(_) => return refuse(None, "a message is a JSON object with a type".into()),
        Err(error) => return refuse(None, format!("a message is a JSON object: {error}")),
    };
    let id = value.get("id").and_then(Value::as_u64);
    match serde_json::from_value(value) {
        Ok(ask) => Ok(ask),
        Err(error) => refuse(id, format!("cannot read this message: {error}")),
    }
}

impl Say {
    /// The message as it travels.
    pub fn to_text(&self) -> String {
        // Keys are text and numbers are finite or null, so this cannot fail.
        serde_json::to_string(self).unwrap_or_default()
    }
}

impl Knob {
    /// `param` as the page shows it; `old_default` is the script's value when this one was set.
    pub fn new(param: &Param, old_default: Option<&Setting>) -> Self {
        Self {
            name: param.name.clone(),
            value: json(&param.value),
            default: json(&param.default),
            old_default: old_default.filter(|old| **old != param.default).map(json),
            changed: param.value != param.default,
            control: match &param.control {
                Control::Number { min, max, step } => {
                    KnobControl::Number { min: *min, max: *max, step: *step }
                }
                Control::Switch => KnobControl::Switch,
                Control::Choice(choices) => KnobControl::Choice { choices: choices.clone() },
                Control::Color => KnobControl::Color,
                Control::Text => KnobControl::Text,
            },
            unit: param.unit.clone(),
            text: param.text.clone(),
        }
    }
}

/// A parameter's value for machines.
pub fn json(setting: &Setting) -> Value {
    match setting {
        Setting::Number(number) => (*number).into(),
        Setting::Boolean(value) => (*value).into(),
        Setting::Text(text) => text.as_str().into(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn messages_of_pages_are_read_or_refused_with_their_id() {
        assert!(matches!(read(r#"{"type":"set","params":{"a":"1","b":null}}"#), Ok(Ask::Set { .. })));
        assert!(matches!(read(r#"{"type":"steps","steps":null}"#), Ok(Ask::Steps { steps: None })));
        assert!(matches!(
            read(r#"{"type":"pick","id":1,"mesh":0,"primitive":0,"triangle":3,"instance":null,"node":0}"#),
            Ok(Ask::Pick(_))
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
            assert!(matches!(*refused, Say::Refused { id: None, .. }), "{text}");
        }
        let Say::Refused { id, text } = *read(r#"{"type":"pick","id":9}"#).unwrap_err() else { panic!() };
        assert_eq!(id, Some(9));
        assert!(text.contains("mesh"), "{text}");
        assert!(read(&"[".repeat(100_000)).is_err());
    }
}
