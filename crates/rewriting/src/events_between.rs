//! Chains between two events, for functions that run there.

use std::sync::Arc;

use crate::chain::Chain;
use crate::event_chain::EventChain;
use crate::plan::StepPlan;
use burgeon_base::error::{Error, Result};

/// Chains between two events. They are copied only if they are read, because a copy costs more than an event.
#[derive(Debug, Clone)]
pub struct ChainsBetween {
    chains: Arc<Vec<EventChain>>,
    plan: Arc<StepPlan>,
    time: f64,
}

/// Continuation of events after the functions between two of them.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum EventsNext {
    /// The next event follows. Guards and propensities give the same results as before for the same modules.
    Continue,
    /// The next event follows, and all guards and propensities are computed again.
    Recompute,
    /// The series ends before the next event.
    End,
}

impl ChainsBetween {
    /// Shares `chains`, which [`into_chains`](Self::into_chains) returns, at these `times`.
    pub(crate) fn new(chains: Vec<EventChain>, times: &[f64], plan: &Arc<StepPlan>) -> Self {
        let time = times.iter().fold(0.0, |latest, time| f64::max(latest, *time));
        Self { chains: Arc::new(chains), plan: Arc::clone(plan), time }
    }

    /// Returns the time of the last event, the latest of all chains.
    pub fn time(&self) -> f64 {
        self.time
    }

    /// Returns a copy of the chains, one after the other.
    pub fn whole(&self) -> Chain {
        joined(&self.chains, &self.plan)
    }

    /// Returns the chains. Fails if a function has kept a clone.
    pub(crate) fn into_chains(self) -> Result<Vec<EventChain>> {
        Arc::try_unwrap(self.chains).map_err(|_| Error::internal("the chains between two events are in use"))
    }
}

/// Returns all chains, one after the other, with marks.
pub(crate) fn joined(chains: &[EventChain], plan: &StepPlan) -> Chain {
    let mut joined = Chain::default();
    joined.symbols.reserve_exact(chains.iter().map(|chain| chain.pieces().symbols).sum());
    for segment in chains.iter().flat_map(|chain| &chain.pieces().segments) {
        joined.symbols.extend_from_slice(&segment.chain.symbols);
        joined.params.extend_from_slice(&segment.chain.params);
        joined.keys.extend_from_slice(&segment.chain.keys);
    }
    joined.mark(plan.batch, plan.grammar.arities());
    joined
}
