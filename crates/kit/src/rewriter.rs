//! How an object that expands by itself has the rules of a system applied.

use std::sync::Arc;

use crate::Values;
use burgeon_base::error::{Result, SourcePlace};
use burgeon_macros::{methods, object};
use burgeon_rewriting::{Chain, Grammar};

/// A system whose rules an object applies.
///
/// The script handed it to the object.
#[object("system", given)]
#[derive(Debug)]
pub struct System {
    /// Its place among the systems of the script.
    pub index: usize,
}

#[methods("system")]
impl System {}

/// What is known of a system whose rules are applied for an object.
pub struct RuleSet {
    /// Its rules.
    pub grammar: Grammar,
    /// The parameters of its modules that are not numbers.
    pub values: Arc<Values>,
    /// Where it was made.
    pub place: Option<SourcePlace>,
    /// Whether it has an object of its own.
    pub has_object: bool,
    /// Symbols that a thread takes at a time: chains are marked so.
    pub batch: usize,
}

/// A chain after a step.
pub struct RewriteOutcome {
    /// The chain.
    pub chain: Chain,
    /// For each symbol of the chain before: the number of the rule that ran, or [`NO_RULE`](burgeon_rewriting::NO_RULE), and how many
    /// symbols came of it.
    pub applied: Vec<(u16, u32)>,
}

/// Applies the rules of a script's systems.
pub trait Rewriter {
    /// System `index` of the script.
    fn rules(&self, index: usize) -> Result<Arc<RuleSet>>;

    /// The first chain of system `index`.
    fn axiom(&self, index: usize) -> Result<Chain>;

    /// Applies the rules of system `index` once to a marked `chain`, in what is told as step `step`.
    fn rewrite(&self, index: usize, chain: Chain, step: usize) -> Result<RewriteOutcome>;

    /// Takes back a chain that is no longer needed, for its memory.
    fn reuse(&self, index: usize, chain: Chain);

    /// Fails once the run is to stop.
    fn check(&self) -> Result<()>;
}
