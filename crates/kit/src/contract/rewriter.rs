//! Application of a system's rules for an object that expands automatically.

use std::sync::Arc;

use crate::Values;
use burgeon_base::error::{Result, SourcePlace};
use burgeon_macros::{methods, object};
use burgeon_rewriting::{Chain, Grammar};

/// A system whose rules an object applies.
///
/// The script passes it to the object.
#[object("system", given)]
#[derive(Debug)]
pub struct System {
    /// Index of the system in the script.
    pub index: usize,
}

#[methods("system")]
impl System {}

/// Rules of a system with the data to apply them for an object.
pub struct RuleSet {
    /// Rules of the system.
    pub grammar: Grammar,
    /// Parameters of its modules that are not numbers.
    pub values: Arc<Values>,
    /// Source location of the system's declaration.
    pub place: Option<SourcePlace>,
    /// Set if the system has its own object.
    pub has_object: bool,
    /// Number of symbols per unit of work of a thread; chains are marked accordingly.
    pub batch: usize,
}

/// Result of a rewriting step.
pub struct RewriteOutcome {
    /// The new chain.
    pub chain: Chain,
    /// Applied rule for each symbol of the previous chain, or [`NO_RULE`](burgeon_rewriting::NO_RULE), and the number
    /// of symbols that replace it.
    pub applied: Vec<(u16, u32)>,
}

/// Access to the rules of a script's systems.
pub trait Rewriter {
    /// Returns the rules of system `index` of the script.
    fn rules(&self, index: usize) -> Result<Arc<RuleSet>>;

    /// Returns the axiom of system `index`.
    fn axiom(&self, index: usize) -> Result<Chain>;

    /// Applies the rules of system `index` once to a marked `chain`; `step` is the number of the step, from 1, for its
    /// functions and for messages.
    fn rewrite(&self, index: usize, chain: Chain, step: usize) -> Result<RewriteOutcome>;

    /// Takes back a chain that is no longer needed, to reuse its memory.
    fn reuse(&self, index: usize, chain: Chain);

    /// Fails if the run is cancelled.
    fn check(&self) -> Result<()>;
}
