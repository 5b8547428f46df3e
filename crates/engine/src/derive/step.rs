//! Derivation steps in the leading machine, with the help of the other machines.

use std::sync::Arc;

use super::functions::LuaRules;
use super::plan::DerivationPlan;
use super::threads::{LeadingMachine, ThreadJob};
use crate::machine::{Machine, SystemFunctions};
use burgeon_base::error::Result;
use burgeon_rewriting::{
    Chain, EventSeries, EventsOutcome, Helpers, SeriesOutcome, StepOutcome, StepSeries, StepWork, Stepper,
};

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

/// Performs step `number` on `chain` with the functions `declared` of the leading machine.
pub(super) fn step(
    leader: LeadingMachine<'_>,
    plan: &Arc<DerivationPlan>,
    stepper: &mut Stepper,
    declared: &SystemFunctions,
    chain: &Arc<Chain>,
    number: usize,
) -> Result<StepOutcome> {
    let machine = leader.machine;
    enter(machine, plan)?;
    let rules = LuaRules { machine, declared, bounded: plan.bounded };
    let helpers = MachineHelpers { leader, plan };
    stepper.step(&rules, &helpers, &machine.session.stop, chain, number)
}

/// Performs several steps on `chain` with the functions `declared` of the leading machine.
pub(super) fn perform(
    machine: &Machine,
    plan: &Arc<DerivationPlan>,
    stepper: &mut Stepper,
    declared: &SystemFunctions,
    chain: &Chain,
    series: &mut StepSeries<'_>,
) -> Result<SeriesOutcome> {
    enter(machine, plan)?;
    let rules = LuaRules { machine, declared, bounded: plan.bounded };
    stepper.perform(&rules, &machine.session.stop, chain, series)
}

/// Performs events on `chain` with the functions `declared` of the leading machine.
pub(super) fn perform_events(
    machine: &Machine,
    plan: &Arc<DerivationPlan>,
    stepper: &mut Stepper,
    declared: &SystemFunctions,
    chain: &Arc<Chain>,
    series: &mut EventSeries<'_>,
) -> Result<EventsOutcome> {
    enter(machine, plan)?;
    let rules = LuaRules { machine, declared, bounded: plan.bounded };
    stepper.perform_events(&rules, &machine.session.stop, chain, series)
}

/// Prepares the leading machine for calls of the functions of a system.
pub(super) fn enter(machine: &Machine, plan: &DerivationPlan) -> Result<()> {
    machine.enter(plan.system)?;
    machine.refresh();
    plan.show_objects(machine);
    machine.current.located.replace(plan.places());
    machine.current.skips_passes.set(plan.skips_passes);
    Ok(())
}
