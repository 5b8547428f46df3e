//! State of a derivation.

use std::cell::RefCell;
use std::sync::Arc;

use super::checkpoints::CheckpointWriter;
use super::hooks::EarlyHooks;
use super::interpret::{PassMemory, PassOutcome};
use super::plan::Derivation;
use super::rewriter::SystemRewriter;
use super::threads::LeadingMachine;
use crate::declare::TraceRequest;
use crate::machine::HookMoment;
use crate::results::{RowFeatures, Step, Times};
use burgeon_base::warning::Warning;
use burgeon_kit::{Object, Rewind};
use burgeon_rewriting::{CLOSE, Chain, OPEN, Stepper, Use};

/// State of a derivation, shared by its phases.
pub(super) struct DerivationState<'a> {
    pub(super) leader: LeadingMachine<'a>,
    pub(super) derivation: &'a Derivation,
    pub(super) rewriter: SystemRewriter<'a>,
    pub(super) stepper: Stepper,
    /// Executor of the decomposition rules, if there are any.
    pub(super) decomposer: Option<Stepper>,
    /// Chain before the current step; its memory is reused once nothing reads it.
    pub(super) previous: Option<Arc<Chain>>,
    pub(super) times: Times,
    pub(super) interpretations: Vec<Use>,
    /// Warnings of objects before the first pass.
    pub(super) first: Vec<Warning>,
    /// Warnings of objects since the first pass.
    pub(super) later: Vec<Warning>,
    pub(super) steps: Vec<Step>,
    /// Features of the modules, if they are recorded.
    pub(super) features: Option<RefCell<RowFeatures>>,
    /// Number of states of the chain that were published.
    pub(super) published: u32,
    /// Memory of the last pass, from which the next continues.
    pub(super) memory: PassMemory,
    /// Result of the last pass.
    pub(super) pass: PassOutcome,
    /// Set if a decomposition has read the number of the step.
    pub(super) decomposition_reads_step: bool,
    /// Number of the group of rules in use; `None` for the rules without a group.
    pub(super) group: Option<usize>,
    /// Set if a variable has changed since the step began.
    pub(super) variables_changed: bool,
    /// Hooks that have run before their phases, during a series of events.
    pub(super) early_hooks: Option<EarlyHooks>,
    /// Set if a hook has requested that the step that begins is the last.
    pub(super) is_last_step: bool,
    /// Set if branches were cut at the beginning of the step.
    pub(super) has_cut: bool,
    /// Set if branches were cut in any step.
    pub(super) has_ever_cut: bool,
    /// Writer of checkpoints, if later runs can continue from them.
    pub(super) checkpoints: Option<CheckpointWriter>,
}

impl DerivationState<'_> {
    /// Returns true if hooks run in each step.
    pub(super) fn has_step_hooks(&self) -> bool {
        let is_of_step =
            |moment: &HookMoment| matches!(moment, HookMoment::BeforeStep | HookMoment::AfterStep);
        self.derivation.hooks.iter().any(|(moment, _)| is_of_step(moment))
    }

    /// Returns true if a step that changes nothing ends the derivation although rules ran. A step that could repeat forever
    /// without a difference does not count. A function that reads the number of the step can make a difference in a later
    /// step.
    pub(super) fn ends_unchanged(&self) -> bool {
        self.derivation.draws_afresh && !self.derivation.plan.steps.grammar.draws_random()
    }

    /// Returns true if nothing observes the chains between the steps, so that several steps can run in one phase.
    pub(super) fn performs_series(&self) -> bool {
        self.performs_events_together()
            && !self.has_step_hooks()
            && !self.leader.machine.session.observes_steps()
    }

    /// Returns true if at most hooks need the chains between events, so that several events can occur in one phase. Text that
    /// their functions print is in order in any case.
    pub(super) fn performs_events_together(&self) -> bool {
        let Derivation { plan, last_only, .. } = self.derivation;
        (*last_only || plan.objects.is_none())
            && self.decomposer.is_none()
            && self.features.is_none()
            && !(self.has_step_hooks() && plan.environments.is_some())
            && !self.leader.machine.session.asks_for_chains()
    }

    /// Returns the time of the last event, the latest of all chains; 0 without events.
    pub(super) fn time(&self) -> f64 {
        self.stepper.event_times().iter().fold(0.0, |latest, time| latest.max(*time))
    }

    /// Returns true if a pass draws what the pass before has drawn, as far as the chain is the same.
    pub(super) fn repeats_passes(&self) -> bool {
        let Derivation { plan, last_only, draws_afresh, .. } = self.derivation;
        // A type that extends another has a state of its own, which does not return to a mark.
        let rewinds =
            |object: &dyn Object| Ok(object.base().is_none() && object.kind().has_capability::<dyn Rewind>());
        !last_only
            && *draws_afresh
            && plan.steps.chains == 1
            && !plan.steps.traced
            && !plan.profiled
            && plan.interpretations.grammar.is_none()
            && plan.variables().is_none()
            && plan.environments.is_none()
            && !plan.has_events()
            && !self.leader.machine.session.observes_steps()
            && plan.objects.as_ref().is_some_and(|objects| objects.read(0, rewinds).unwrap_or(false))
    }

    /// Returns true if rules ask only for places, so that passes over parts of the chain answer them between the steps of a
    /// series.
    pub(super) fn follows_places(&self) -> bool {
        let Derivation { plan, asks_places_only, .. } = self.derivation;
        let interpretations = &plan.interpretations;
        // Their random numbers can have the key of the chain's end, which a part does not have.
        let has_ends = interpretations.begin != u16::MAX
            || [OPEN, CLOSE].iter().any(|symbol| interpretations.by_symbol[usize::from(*symbol)] != u16::MAX);
        *asks_places_only
            && self.memory.is_complete()
            && self.repeats_passes()
            && self.decomposer.is_none()
            && self.features.is_none()
            && !self.has_step_hooks()
            && !self.leader.machine.session.may_stop()
            && !(has_ends && plan.steps.grammar.draws_random())
    }

    /// Returns a copy of the chain for the lineage, if its modules will be inspected; otherwise an empty
    /// chain.
    pub(super) fn traced_chain(&self, chain: &Chain) -> Chain {
        match self.derivation.traced {
            Some(TraceRequest { chain: Some(_), .. }) => chain.clone(),
            _ => Chain::default(),
        }
    }

    /// Records a step on `chain` for features and the lineage. `applied` has the rule and the number of successors of each symbol.
    pub(super) fn record(&mut self, chain: &Chain, applied: Vec<(u16, u32)>, number: usize) {
        if let Some(features) = &self.features {
            features.borrow_mut().step(&applied);
        }
        if self.derivation.traced.is_some() {
            let before = self.traced_chain(chain);
            let asked = self.leader.machine.session.rows.take_noted();
            self.steps.push(Step { number, chain: before, applied, answers: Vec::new(), asked });
        }
    }

    /// Returns the work of each rule in all phases.
    pub(super) fn uses(&self) -> Vec<Use> {
        let mut uses = self.stepper.uses().to_vec();
        if let Some(decomposer) = &self.decomposer {
            uses.iter_mut().zip(decomposer.uses()).for_each(|(sum, more)| *sum += *more);
        }
        uses
    }

    /// Publishes the current chain to queries.
    pub(super) fn publish(&mut self, chain: &Arc<Chain>) {
        let (machine, plan) = (self.leader.machine, &self.derivation.plan);
        self.published += 1;
        let symbols = plan.steps.grammar.symbols();
        let view = machine.current.chains_derived.borrow();
        let view = view.with_current(plan.system, symbols, chain, self.failed(), self.published);
        machine.session.show_chains(view);
    }

    /// Returns the indices of the chains with faulty data.
    pub(super) fn failed(&self) -> Vec<usize> {
        self.derivation.plan.objects.as_ref().map(|objects| objects.failed().list()).unwrap_or_default()
    }
}
