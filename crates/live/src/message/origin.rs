//! What made a triangle, and what a line made, as pages are told it.

use serde::Serialize;

/// The module that made a triangle.
#[derive(Debug, Clone, Serialize)]
pub struct PickMessage {
    /// The question's id.
    pub id: u64,
    /// Whether it is known.
    pub found: bool,
    /// The module that drew the triangle, or placed it if nobody knows who drew it.
    #[serde(flatten)]
    pub made: Option<OriginMessage>,
    /// The module that placed the model to which the triangle belongs.
    pub placed: Option<OriginMessage>,
    /// The instance as it was asked about.
    pub instance: Option<usize>,
}

/// A module that made something.
#[derive(Debug, Clone, Serialize)]
pub struct OriginMessage {
    /// The system's place in the script, from 0.
    pub system: usize,
    /// The chain.
    pub chain: usize,
    /// The id of the chain's feature.
    pub feature: Option<String>,
    /// The module.
    pub module: ModuleMessage,
    /// The rule that interprets it, unless the standard library does.
    pub interpretation: Option<RulePlace>,
    /// The modules that led to it, from the axiom on.
    pub path: Vec<StepMessage>,
    /// The chain around it.
    pub chain_text: AroundMessage,
    /// What it has drawn.
    pub ranges: Vec<Range>,
}

/// A module.
#[derive(Debug, Clone, Serialize)]
pub struct ModuleMessage {
    /// The whole.
    pub text: String,
    /// Its symbol.
    pub symbol: String,
    /// Its parameters.
    pub params: Vec<NamedValue>,
    /// Its place in the chain, brackets counted.
    pub index: usize,
}

/// A parameter of a module.
#[derive(Debug, Clone, Serialize)]
pub struct NamedValue {
    /// Its name.
    pub name: String,
    /// Its value as text.
    pub value: String,
}

/// A rule and its place.
#[derive(Debug, Clone, Serialize)]
pub struct RulePlace {
    /// Its pattern.
    pub text: String,
    /// The file that has it; none if it is the engine's own.
    pub file: String,
    /// Its line.
    pub line: usize,
}

/// A module on the way from the axiom to another.
#[derive(Debug, Clone, Serialize)]
pub struct StepMessage {
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
    /// The query or the fragmentation whose place it took, with values and the number of rows; none where a rule made it.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub answer: Option<String>,
    /// What its rules asked of data as it was made, with values and the number of rows.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub asked: Vec<String>,
}

/// A piece of a chain as text.
#[derive(Debug, Clone, Serialize)]
pub struct AroundMessage {
    /// What is before.
    pub before: String,
    /// The module in the middle.
    pub at: String,
    /// What is after.
    pub after: String,
}

/// What a line of a script has made.
#[derive(Debug, Clone, Serialize)]
pub struct HighlightMessage {
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
