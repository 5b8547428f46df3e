//! Result of a run, as sent to pages.

use serde::Serialize;
use serde_json::Value;

use super::cause::Cause;
use burgeon_engine::script::{Control, Param, Setting};

/// Result of a run.
#[derive(Debug, Clone, Serialize)]
pub struct ModelMessage {
    /// Number of the run.
    pub run: u64,
    /// Cause of the run.
    pub cause: Cause,
    /// URL of the binary glTF file; `None` if the model is empty or too large.
    pub url: Option<String>,
    /// Size of the file (bytes).
    pub bytes: usize,
    /// Number of visible triangles, counted for each instance.
    pub triangles: usize,
    /// Number of placed meshes.
    pub instances: usize,
    /// Number of modules of all systems.
    pub modules: usize,
    /// Bounding box of the visible geometry (m, z up).
    pub bounds: Option<Bounds>,
    /// Number of steps of this model: the maximum over all systems.
    pub steps: usize,
    /// Number of steps without a limit, as far as known.
    pub last_step: usize,
    /// Step limit, if one is set.
    pub step_limit: Option<usize>,
    /// Seed of the run.
    pub seed: String,
    /// Preset with these values and this seed, if any.
    pub preset: Option<String>,
    /// Reason for an empty model, if it is empty.
    pub nothing: Option<String>,
    /// Parameters in the script's order, with the parameters of required files last.
    pub params: Vec<ParamMessage>,
    /// Cameras that the script declares, in its order.
    pub cameras: Vec<CameraMessage>,
    /// Systems in the order of their derivation.
    pub systems: Vec<SystemMessage>,
    /// Rules, with their costs.
    pub rules: Vec<RuleMessage>,
    /// Times of the stages of the run.
    pub times: TimesMessage,
    /// Files that determine the model.
    pub files: Vec<String>,
    /// Warnings, in the format of errors, each with its `kind` and the number of its occurrences, its `count`.
    pub warnings: Vec<Value>,
    /// Summaries of skipped and simplified features, each `{ message, help }`.
    pub notes: Vec<Value>,
}

/// Bounding box (m).
#[derive(Debug, Clone, Copy, Serialize)]
pub struct Bounds {
    /// Minimum corner.
    pub low: [f64; 3],
    /// Maximum corner.
    pub high: [f64; 3],
}

/// Camera that the script declares.
#[derive(Debug, Clone, Serialize)]
pub struct CameraMessage {
    /// Name.
    pub name: String,
    /// Kind of its view: `perspective`, `orthographic`, `plan` or `eye`.
    pub view: &'static str,
    /// File of the declaration; empty if unknown.
    pub file: String,
    /// Line of the declaration.
    pub line: usize,
}

/// Parameter with its control.
#[derive(Debug, Clone, Serialize)]
pub struct ParamMessage {
    /// Name by which the parameter is set.
    pub name: String,
    /// Package that declares the parameter; it is the prefix of the name.
    pub package: Option<String>,
    /// Value in this run: a number, a boolean, a string or a list of points.
    pub value: Value,
    /// Value without a request: that of the file of drawn curves, or the default of the script.
    pub default: Value,
    /// Default of the script, if the file of drawn curves has another value.
    pub script_default: Option<Value>,
    /// Default at the time when the value was set, if the script has changed it since.
    pub old_default: Option<Value>,
    /// Set if the value differs from the default.
    pub changed: bool,
    /// Control for the allowed values.
    pub control: ControlMessage,
    /// Heading that it shares with other parameters; may be empty.
    pub group: String,
    /// Unit; may be empty.
    pub unit: String,
    /// Description; may be empty.
    pub text: String,
}

/// Control for the allowed values of a parameter.
#[derive(Debug, Clone, Serialize)]
#[serde(tag = "type", rename_all = "lowercase")]
pub enum ControlMessage {
    /// Number within bounds, in steps from the lower bound.
    Number {
        /// Minimum value.
        min: Option<f64>,
        /// Maximum value.
        max: Option<f64>,
        /// Difference of neighbouring values.
        step: Option<f64>,
    },
    /// Boolean.
    Switch,
    /// Choice among values.
    Choice {
        /// Allowed values.
        choices: Vec<String>,
    },
    /// Colour as `#rrggbb`.
    Color,
    /// Free text.
    Text,
    /// Control points of a function, a curve or a surface.
    Points {
        /// Meaning of the coordinates: `function`, `plane` or `space`.
        space: &'static str,
        /// Relation of the points to the value, such as `linear`.
        kind: &'static str,
        /// Set if the last point is joined to the first.
        closed: bool,
        /// Number of points in a row of a surface.
        #[serde(skip_serializing_if = "Option::is_none")]
        columns: Option<usize>,
        /// Value as cubic Bezier pieces, each of four points x, y, z.
        pieces: Vec<[[f64; 3]; 4]>,
    },
}

/// Derived system.
#[derive(Debug, Clone, Serialize)]
pub struct SystemMessage {
    /// Index of the system in the script, from 0.
    pub system: usize,
    /// File and line that created the system.
    pub place: String,
    /// Number of chains.
    pub chains: usize,
    /// Number of modules in all chains.
    pub modules: usize,
    /// Number of derivation steps.
    pub steps: usize,
    /// Number of modules of each symbol.
    pub symbols: Vec<CountMessage>,
}

/// Number of modules of a symbol.
#[derive(Debug, Clone, Serialize)]
pub struct CountMessage {
    /// Name of the symbol.
    pub name: String,
    /// Number of modules.
    pub count: usize,
}

/// Rule and its cost.
#[derive(Debug, Clone, Serialize)]
pub struct RuleMessage {
    /// Pattern of the rule.
    pub text: String,
    /// `rule` or `interpretation`.
    pub kind: &'static str,
    /// File of the rule; empty for built-in rules of the engine.
    pub file: String,
    /// Line of the rule.
    pub line: usize,
    /// Number of applications.
    pub applied: usize,
    /// Number of modules and brackets that the rule made.
    pub made: usize,
    /// Time taken by the rule (ms).
    pub ms: f64,
}

/// Times of the stages of a run (ms).
#[derive(Debug, Clone, Copy, Serialize)]
pub struct TimesMessage {
    /// Time to start the Lua virtual machine and run the script.
    pub script: f64,
    /// Time to match and apply rules.
    pub rewriting: f64,
    /// Time of the interpretation.
    pub interpretation: f64,
    /// Time to build the scene.
    pub scene: f64,
    /// Time to encode the model.
    pub encode: f64,
    /// Time from the change of a file or the page's message to the encoded model.
    pub total: f64,
}

impl ParamMessage {
    /// Describes `param` with `value` for the page; `old_default` is the script's default at the time when the value
    /// was set.
    pub fn new(param: &Param, value: &Setting, old_default: Option<&Setting>) -> Self {
        Self {
            name: param.name.clone(),
            package: param.package.clone(),
            value: value.to_json(),
            default: param.base_value().to_json(),
            script_default: (param.default != *param.base_value()).then(|| param.default.to_json()),
            old_default: old_default.filter(|old| **old != param.default).map(Setting::to_json),
            changed: value != param.base_value(),
            control: match &param.control {
                Control::Number { min, max, step } => {
                    ControlMessage::Number { min: *min, max: *max, step: *step }
                }
                Control::Switch => ControlMessage::Switch,
                Control::Choice(choices) => ControlMessage::Choice { choices: choices.clone() },
                Control::Color => ControlMessage::Color,
                Control::Text => ControlMessage::Text,
                Control::Points(control) => ControlMessage::Points {
                    space: control.form().space.name(),
                    kind: control.form().kind,
                    closed: control.form().closed,
                    columns: control.form().columns,
                    pieces: match value {
                        Setting::Points(points) => control.pieces(points).unwrap_or_default(),
                        _ => Vec::new(),
                    },
                },
            },
            group: param.group.clone(),
            unit: param.unit.clone(),
            text: param.doc.clone(),
        }
    }
}
