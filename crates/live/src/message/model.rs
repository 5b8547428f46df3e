//! The result of a run as pages are told it.

use serde::Serialize;
use serde_json::Value;

use super::Cause;
use burgeon_engine::script::{Control, Param, Setting};

/// The result of a run.
#[derive(Debug, Clone, Serialize)]
pub struct ModelMessage {
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
    /// The preset whose values and seed these are, if there is one.
    pub preset: Option<String>,
    /// Why there is nothing to see, if so.
    pub nothing: Option<String>,
    /// The parameters in the script's order, those of files that it requires last.
    pub params: Vec<ParamMessage>,
    /// The systems in the order in which they were derived.
    pub systems: Vec<SystemMessage>,
    /// The rules, with what they cost.
    pub rules: Vec<RuleMessage>,
    /// Where the time went.
    pub times: TimesMessage,
    /// The files that decide what the model is.
    pub files: Vec<String>,
    /// What people should know of it: as errors are told, each with its `kind` and how often it was found, its `count`.
    pub warnings: Vec<Value>,
    /// What became of features that could not be built as asked, each `{ message, help }`.
    pub notes: Vec<Value>,
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
pub struct ParamMessage {
    /// Its name, by which it is set.
    pub name: String,
    /// The package that declares it, which its name begins with.
    pub package: Option<String>,
    /// Its value in this run: a number, a switch or text.
    pub value: Value,
    /// The script's own value.
    pub default: Value,
    /// The script's value when this one was set, if the script has changed it since.
    pub old_default: Option<Value>,
    /// Whether the value is not the script's.
    pub changed: bool,
    /// What values it may have.
    pub control: ControlMessage,
    /// The unit; may be empty.
    pub unit: String,
    /// What it does; may be empty.
    pub text: String,
}

/// What values a parameter may have.
#[derive(Debug, Clone, Serialize)]
#[serde(tag = "type", rename_all = "lowercase")]
pub enum ControlMessage {
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
pub struct SystemMessage {
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
    pub symbols: Vec<CountMessage>,
}

/// How many modules have a symbol.
#[derive(Debug, Clone, Serialize)]
pub struct CountMessage {
    /// The symbol.
    pub name: String,
    /// The number of modules.
    pub count: usize,
}

/// A rule and what it cost.
#[derive(Debug, Clone, Serialize)]
pub struct RuleMessage {
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

/// Where the time of a run went (ms).
#[derive(Debug, Clone, Copy, Serialize)]
pub struct TimesMessage {
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

impl ParamMessage {
    /// `param` as the page shows it; `old_default` is the script's value when this one was set.
    pub fn new(param: &Param, old_default: Option<&Setting>) -> Self {
        Self {
            name: param.name.clone(),
            package: param.package.clone(),
            value: json(&param.value),
            default: json(&param.default),
            old_default: old_default.filter(|old| **old != param.default).map(json),
            changed: param.value != param.default,
            control: match &param.control {
                Control::Number { min, max, step } => {
                    ControlMessage::Number { min: *min, max: *max, step: *step }
                }
                Control::Switch => ControlMessage::Switch,
                Control::Choice(choices) => ControlMessage::Choice { choices: choices.clone() },
                Control::Color => ControlMessage::Color,
                Control::Text => ControlMessage::Text,
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
