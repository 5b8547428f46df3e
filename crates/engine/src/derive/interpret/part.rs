//! Pass over the part of a chain that can change the places which rules read.

use std::sync::Arc;

use super::{InterpretationPass, PassMemory};
use crate::derive::plan::DerivationPlan;
use crate::derive::threads::LeadingMachine;
use crate::results::Use;
use burgeon_base::error::Result;
use burgeon_rewriting::{Links, Mark, SeriesChain};

impl InterpretationPass {
    /// Interprets what rules of a series can ask for after `step` steps: the modules of `chain` from the first change on, up
    /// to the last module whose rules read places. Returns false if the next pass cannot continue this one.
    pub(crate) fn follow(
        LeadingMachine { machine, threads }: LeadingMachine<'_>,
        plan: &Arc<DerivationPlan>,
        chain: &SeriesChain<'_>,
        step: usize,
        uses: &mut [Use],
        memory: &mut PassMemory,
    ) -> Result<bool> {
        let first = memory.end();
        let end = chain.located_end();
        let (part, regions) = (chain.part(first, end), chain.regions(first.module, end));
        let pieces = vec![Mark::default(), part.end(0)];
        Self::enter(machine, plan)?;
        let last = Some(std::mem::take(memory));
        let part = (Arc::new(part), first, regions);
        let interpreting = Self::new(plan, part, pieces, (step, step, &[]), Links::default(), last);
        while interpreting.work(machine) {}
        let done = threads.reclaim(interpreting);
        // Warnings come from the pass over the last chain.
        let outcome = done.complete(uses, &mut Vec::new(), Some(memory))?;
        machine.current.located.replace(plan.places());
        Ok(memory.is_complete() && !outcome.is_last)
    }
}
