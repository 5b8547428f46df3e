//! Chains between two events, for functions that run there.

use std::sync::{Arc, OnceLock};

use crate::chain::{Chain, Symbol};
use crate::event_chain::EventChain;
use crate::plan::StepPlan;
use burgeon_base::error::{Error, Result};

/// Chains between two events. They are copied only if they are read, because a copy costs more than an event.
#[derive(Debug, Clone)]
pub struct ChainsBetween {
    shared: Arc<SharedChains>,
    plan: Arc<StepPlan>,
    time: f64,
}

/// Chains, and a copy of them once a function has read it.
#[derive(Debug)]
struct SharedChains {
    chains: Vec<EventChain>,
    whole: OnceLock<Arc<Chain>>,
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
        let shared = Arc::new(SharedChains { chains, whole: OnceLock::new() });
        Self { shared, plan: Arc::clone(plan), time }
    }

    /// Returns the time of the last event, the latest of all chains.
    pub fn time(&self) -> f64 {
        self.time
    }

    /// Returns the symbols of the chains, in parts.
    pub fn symbols(&self) -> impl Iterator<Item = &[Symbol]> {
        let segments = self.shared.chains.iter().flat_map(|chain| &chain.pieces().segments);
        segments.map(|segment| &*segment.chain.symbols)
    }

    /// Returns a copy of the chains, one after the other. It is made once, also for clones.
    pub fn whole(&self) -> &Arc<Chain> {
        self.shared.whole.get_or_init(|| Arc::new(join_event_chains(&self.shared.chains, &self.plan)))
    }

    /// Returns the chains. Fails if a function has kept a clone.
    pub(crate) fn into_chains(self) -> Result<Vec<EventChain>> {
        Arc::try_unwrap(self.shared)
            .map(|shared| shared.chains)
            .map_err(|_| Error::internal("the chains between two events are in use"))
    }
}

/// Returns all chains, one after the other, with marks.
pub(crate) fn join_event_chains(chains: &[EventChain], plan: &StepPlan) -> Chain {
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
