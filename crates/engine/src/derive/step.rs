//! One derivation step in the leading machine, with the help of the other machines.

use std::sync::Arc;

use super::functions::LuaRules;
use super::plan::DerivationPlan;
use super::threads::{LeadingMachine, ThreadJob};
use crate::machine::SystemFunctions;
use burgeon_base::error::Result;
use burgeon_rewriting::{Chain, Helpers, StepOutcome, StepWork, Stepper};

/// Number of pieces of a chain from which rewriting takes longer than starting a helper.
const MANY: usize = 16;

/// Machines that take pieces of a step.
struct MachineHelpers<'a> {
    leader: LeadingMachine<'a>,
    plan: &'a Arc<DerivationPlan>,
}

impl Helpers for MachineHelpers<'_> {
    fn offer(&self, work: &Arc<StepWork>, pieces: usize) -> Result<()> {
        let LeadingMachine { machine, threads } = self.leader;
        threads.hand_out(machine, pieces, MANY, || ThreadJob::Rewrite {
            work: Arc::downgrade(work),
            plan: Arc::downgrade(self.plan),
        })
    }
}

/// Makes step `number` on `chain` with the functions `declared` of the leading machine.
pub(super) fn step(
    leader: LeadingMachine<'_>,
    plan: &Arc<DerivationPlan>,
    stepper: &mut Stepper,
    declared: &SystemFunctions,
    chain: &Arc<Chain>,
    number: usize,
) -> Result<StepOutcome> {
    let machine = leader.machine;
    machine.enter(plan.system)?;
    machine.refresh();
    machine.current.objects.replace(plan.objects.clone());
    machine.current.located.replace(plan.places());
    machine.current.skips_passes.set(plan.skips_passes);
    let rules = LuaRules { machine, declared, bounded: plan.bounded };
    let helpers = MachineHelpers { leader, plan };
    stepper.step(&rules, &helpers, &machine.session.stop, chain, number)
}
