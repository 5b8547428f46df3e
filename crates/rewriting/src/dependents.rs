//! Modules of which each depends on others of the same step, for a call that rewrites many of them.

use crate::chain::END;
use crate::dependent_rules::DependentRules;
use crate::grammar::Grammar;
use crate::step_number::StepNumber;
use burgeon_base::ModuleKey;

/// Modules whose rules are chosen and applied in one call, because each can depend on the successor of a module before it.
///
/// Each module has a neighbour: the module that contexts in the new chain see. The call tries rules whose other contexts match,
/// and applies the first whose context in the new chain is the neighbour and whose guard holds. The result is the neighbour of
/// later modules, or the neighbour of the module itself if contexts see no module of the result.
#[derive(Debug)]
pub struct DependentModules<'a> {
    /// Grammar with the rules.
    pub grammar: &'a Grammar,
    /// Contexts of the rules in the new chain.
    pub rules: &'a DependentRules,
    /// For each module: the index of its neighbour in `neighbours`, the index of the module itself in `neighbours`, and the
    /// number of trials up to its last.
    pub modules: &'a [[u32; 3]],
    /// Rules to try, in order: number of the rule, and index of its first argument.
    pub trials: &'a [[u32; 2]],
    /// Arguments of all trials. Those of contexts in the new chain are not yet set.
    pub arguments: &'a [f64],
    /// Symbol and index of the first value of each neighbour. The first is [`NO_NEIGHBOUR`](Self::NO_NEIGHBOUR); modules are
    /// as before the step, or [`SKIPPED`](Self::SKIPPED).
    pub neighbours: &'a [[u32; 2]],
    /// Parameters of neighbours.
    pub values: &'a [f64],
    /// Chain of each module; empty if there is only one chain.
    pub chains: &'a [u32],
    /// Random key of each module; empty if no rule uses random numbers.
    pub keys: &'a [ModuleKey],
    /// Index of each module in the chain; empty unless [`StepPlan::notes_places`](crate::StepPlan::notes_places) is set.
    pub places: &'a [u32],
    /// Number of the step that is running.
    pub step: &'a StepNumber,
}

impl DependentModules<'_> {
    /// Neighbour of a module without neighbour.
    pub const NO_NEIGHBOUR: [u32; 2] = [END as u32, 0];
    /// Symbol of a module that contexts skip: if it is kept, its neighbour is that of the module.
    pub const SKIPPED: u32 = u32::MAX;
}
