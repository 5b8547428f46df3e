//! Derivation as a list of phases.

use std::sync::Arc;

use crate::chain::Chain;
use burgeon_base::error::Result;

/// A phase of a derivation: rewriting, or work before, between and after steps. `S` is the state of the derivation.
pub trait Phase<S> {
    /// Runs the phase on the chain after `step` steps, or in step number `step` if the phase belongs to a step.
    fn run(&self, state: &mut S, chain: Arc<Chain>, step: usize) -> Result<PhaseOutcome>;
}

/// Result of a phase.
#[derive(Debug)]
pub struct PhaseOutcome {
    /// Chain after the phase.
    pub chain: Arc<Chain>,
    /// Number of steps that the phase has performed in addition to the one that was requested.
    pub more_steps: usize,
    /// Set if nothing can change in later steps. The derivation then ends, and this step does not count.
    pub settled: bool,
    /// Set if this step is the last. Its other phases still run, and it counts.
    pub is_last: bool,
}

impl PhaseOutcome {
    /// Creates the result of a phase after which the derivation continues.
    pub fn next(chain: Arc<Chain>) -> Self {
        Self { chain, more_steps: 0, settled: false, is_last: false }
    }
}

/// Phases of a derivation, in the order in which they run.
#[allow(missing_debug_implementations, reason = "phases are code")]
pub struct Phases<'a, S> {
    /// Phases on the axiom.
    pub first: Vec<Box<dyn Phase<S> + 'a>>,
    /// Phases of each step.
    pub each: Vec<Box<dyn Phase<S> + 'a>>,
    /// Phases on the last chain.
    pub last: Vec<Box<dyn Phase<S> + 'a>>,
}

/// Result of a derivation.
#[derive(Debug)]
pub struct DerivedChain {
    /// Last chain.
    pub chain: Arc<Chain>,
    /// Number of steps.
    pub steps: usize,
}

/// Runs the phases of a derivation, from a chain after `begin` steps up to `end` steps, or until a phase of a step has
/// settled or has ended the derivation.
///
/// ```
/// use burgeon_base::Result;
/// use burgeon_rewriting::{Chain, Phase, PhaseOutcome, Phases, derive};
/// use std::sync::Arc;
///
/// /// Counts steps, and settles in the third.
/// struct Count;
/// impl Phase<usize> for Count {
///     fn run(&self, count: &mut usize, chain: Arc<Chain>, step: usize) -> Result<PhaseOutcome> {
///         *count += 1;
///         Ok(PhaseOutcome { settled: step == 3, ..PhaseOutcome::next(chain) })
///     }
/// }
///
/// let phases = Phases { first: vec![], each: vec![Box::new(Count)], last: vec![Box::new(Count)] };
/// let mut count = 0;
/// let derived = derive(&phases, &mut count, Arc::default(), 0, 10)?;
/// assert_eq!((derived.steps, count), (2, 4));
/// # Ok::<(), burgeon_base::Error>(())
/// ```
pub fn derive<S>(
    phases: &Phases<'_, S>,
    state: &mut S,
    mut chain: Arc<Chain>,
    begin: usize,
    end: usize,
) -> Result<DerivedChain> {
    let mut is_last = false;
    for phase in &phases.first {
        let outcome = phase.run(state, chain, begin)?;
        chain = outcome.chain;
        is_last |= outcome.is_last;
    }
    let mut steps = begin;
    'steps: while steps < end && !is_last {
        for phase in &phases.each {
            let outcome = phase.run(state, chain, steps + 1)?;
            chain = outcome.chain;
            steps += outcome.more_steps;
            is_last |= outcome.is_last;
            if outcome.settled {
                break 'steps;
            }
        }
        steps += 1;
    }
    for phase in &phases.last {
        chain = phase.run(state, chain, steps)?.chain;
    }
    Ok(DerivedChain { chain, steps })
}
