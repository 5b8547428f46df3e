//! Settings of the steps of a derivation.

use std::sync::Arc;

use crate::failed_chains::FailedChains;
use crate::grammar::Grammar;

/// Settings of all steps of a derivation.
#[derive(Debug)]
pub struct StepPlan {
    /// Rules.
    pub grammar: Grammar,
    /// Skipped chains, if chains can be skipped.
    pub failed: Option<Arc<FailedChains>>,
    /// Number of chains.
    pub chains: usize,
    /// Number of symbols that a thread processes at a time.
    pub batch: usize,
    /// Maximum number of symbols of a chain.
    pub limit: usize,
    /// Set if [`StepOutcome::applied`](crate::StepOutcome::applied) is required.
    pub traced: bool,
    /// Set if rules receive the positions of their modules.
    pub notes_places: bool,
}
