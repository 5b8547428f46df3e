//! Phases that interpret the chain.

use std::sync::Arc;
use std::time::Instant;

use super::interpret::InterpretationPass;
use super::state::DerivationState;
use burgeon_base::error::Result;
use burgeon_rewriting::{Chain, Phase, PhaseOutcome};

/// Expands self-expanding objects before the first pass.
pub(super) struct ExpandObjects;

impl Phase<DerivationState<'_>> for ExpandObjects {
    fn run(&self, state: &mut DerivationState<'_>, chain: Arc<Chain>, _: usize) -> Result<PhaseOutcome> {
        state.derivation.plan.expand(&state.rewriter, &mut state.first)?;
        Ok(PhaseOutcome::next(chain))
    }
}

/// Runs an interpretation pass over the chain.
pub(super) struct Interpret;

impl Phase<DerivationState<'_>> for Interpret {
    fn run(&self, state: &mut DerivationState<'_>, chain: Arc<Chain>, step: usize) -> Result<PhaseOutcome> {
        let begin = Instant::now();
        let plan = &state.derivation.plan;
        if state.derivation.draws_afresh {
            // The drawings of earlier passes are discarded.
            state.later.clear();
        }
        state.later.retain(|warning| !warning.is_of_pass());
        let failed = state.failed().len();
        let memory = state.repeats_passes().then_some(&mut state.memory);
        let uses = &mut state.interpretations;
        // If only the last pass runs, the chain stays the same from `step` to the last step.
        let last_only = state.derivation.last_only && plan.bounded;
        let number = if last_only { state.derivation.limit } else { step };
        state.pass = InterpretationPass::pass(
            state.leader,
            plan,
            &chain,
            (step, number, state.stepper.event_times()),
            uses,
            &mut state.later,
            memory,
        )?;
        plan.expand(&state.rewriter, &mut state.later)?;
        if state.failed().len() > failed {
            state.publish(&chain);
        }
        state.take_variables();
        state.times.interpretation += begin.elapsed();
        Ok(PhaseOutcome { is_last: state.pass.is_last, ..PhaseOutcome::next(chain) })
    }
}
