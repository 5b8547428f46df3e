//! Origins of triangles and results of lines, as sent to pages.

use serde::Serialize;

/// Module that made a triangle.
#[derive(Debug, Clone, Serialize)]
pub struct PickMessage {
    /// Id of the query.
    pub id: u64,
    /// Set if the module was found.
    pub found: bool,
    /// Module that drew the triangle, or the module that placed it if the former is unknown.
    #[serde(flatten)]
    pub made: Option<OriginMessage>,
    /// Module that placed the model to which the triangle belongs.
    pub placed: Option<OriginMessage>,
    /// Instance as given in the query.
    pub instance: Option<usize>,
}

/// Module that made something, with its history.
#[derive(Debug, Clone, Serialize)]
pub struct OriginMessage {
    /// Index of the system in the script, from 0.
    pub system: usize,
    /// Index of the chain.
    pub chain: usize,
    /// Id of the chain's feature.
    pub feature: Option<String>,
    /// Module as text and in parts.
    pub module: ModuleMessage,
    /// Rule that interprets the module, unless the standard library does.
    pub interpretation: Option<RulePlace>,
    /// Predecessors of the module, from the axiom on.
    pub path: Vec<StepMessage>,
    /// Part of the chain around the module.
    pub chain_text: AroundMessage,
    /// Triangles that the module has drawn.
    pub ranges: Vec<Range>,
}

/// Module as text.
#[derive(Debug, Clone, Serialize)]
pub struct ModuleMessage {
    /// Symbol and parameters.
    pub text: String,
    /// Symbol of the module.
    pub symbol: String,
    /// Parameters of the module.
    pub params: Vec<NamedValue>,
    /// Index in the chain, counting brackets.
    pub index: usize,
}

/// Parameter of a module.
#[derive(Debug, Clone, Serialize)]
pub struct NamedValue {
    /// Name of the parameter.
    pub name: String,
    /// Value as text.
    pub value: String,
}

/// Rule and its location.
#[derive(Debug, Clone, Serialize)]
pub struct RulePlace {
    /// Pattern of the rule.
    pub text: String,
    /// File of the rule; empty for built-in rules of the engine.
    pub file: String,
    /// Line of the rule.
    pub line: usize,
}

/// Module on the path from the axiom to another module.
#[derive(Debug, Clone, Serialize)]
pub struct StepMessage {
    /// Derivation step that made the module; 0 for the axiom.
    pub step: usize,
    /// Module as text.
    pub module: String,
    /// Rule that made the module; `None` for the axiom.
    pub rule: Option<String>,
    /// File of the rule or the axiom.
    pub file: String,
    /// Line of the rule or the axiom.
    pub line: usize,
    /// Index among the modules of the same rule application, from 0.
    pub ordinal: usize,
    /// Query or fragmentation that the module replaced, with values and the number of rows; `None` if a rule made the
    /// module.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub answer: Option<String>,
    /// Queries that its rules ran when the module was made, with values and the number of rows.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub asked: Vec<String>,
}

/// Part of a chain as text.
#[derive(Debug, Clone, Serialize)]
pub struct AroundMessage {
    /// Text before the module.
    pub before: String,
    /// Module in the centre.
    pub at: String,
    /// Text after the module.
    pub after: String,
}

/// Result of a line of a script.
#[derive(Debug, Clone, Serialize)]
pub struct HighlightMessage {
    /// Id of the query.
    pub id: u64,
    /// File as given in the query.
    pub file: String,
    /// Line as given in the query.
    pub line: usize,
    /// Rules at the line.
    pub what: String,
    /// Number of modules that descend from applications of these rules.
    pub modules: usize,
    /// Triangles that these modules have drawn.
    pub ranges: Vec<Range>,
}

/// Range of triangles of a primitive of the document.
#[derive(Debug, Clone, Serialize)]
pub struct Range {
    /// Index of the mesh.
    pub mesh: usize,
    /// Index of the primitive in the mesh.
    pub primitive: usize,
    /// First triangle.
    pub from: usize,
    /// Number of triangles.
    pub count: usize,
    /// Node, if the range is limited to one node.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub node: Option<usize>,
    /// Instances of the node, if the range is limited to these.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub instances: Option<Vec<usize>>,
}
