//! Hooks between steps, and what they change: groups of rules and variables.

use std::sync::Arc;

use super::plan::Derivation;
use super::state::DerivationState;
use super::step::enter;
use super::threads::LeadingMachine;
use crate::machine::{HookChain, HookFunction, HookMoment, HookView};
use crate::results::VariableValues;
use burgeon_base::error::{Error, Limit, Result};
use burgeon_rewriting::{Chain, ChainsBetween, EventsNext, KeyPart, NO_RULE, Phase, PhaseOutcome};

/// Runs the hooks for a moment.
pub(super) struct RunHooks(pub HookMoment, pub Vec<HookFunction>);

/// Hooks between two events that have run before their phases.
pub(super) struct EarlyHooks {
    /// Number of the step before which they have run.
    number: usize,
    /// Set if a hook after the step before has ended the derivation. Hooks before the step have not run then.
    ends: bool,
    /// State after the hooks before the step, unless its phase has taken it or there are none.
    view: Option<HookView>,
}

/// Hooks between events, and what they have changed.
pub(super) struct EventHooks<'a> {
    leader: LeadingMachine<'a>,
    derivation: &'a Derivation,
    /// Number of the group of rules in use.
    pub(super) group: Option<usize>,
    /// Hooks that have run before their phases, once the series has ended because of them.
    pub(super) early: Option<EarlyHooks>,
    /// Set if a variable has changed in the hooks that ran last.
    pub(super) has_changed_variables: bool,
}

impl Phase<DerivationState<'_>> for RunHooks {
    fn run(&self, state: &mut DerivationState<'_>, chain: Arc<Chain>, number: usize) -> Result<PhaseOutcome> {
        let Self(moment, hooks) = self;
        let (leader, derivation) = (state.leader, state.derivation);
        leader.machine.session.stop.check()?;
        if *moment == HookMoment::Start {
            state.publish(&chain);
        }
        let early = state.early_hooks.as_mut();
        let view = match (moment, early) {
            (HookMoment::AfterStep, Some(early)) if early.number == number + 1 => {
                return Ok(PhaseOutcome { is_last: early.ends, ..PhaseOutcome::next(chain) });
            }
            (HookMoment::BeforeStep, Some(early)) if early.number == number => early.view.take(),
            _ => None,
        };
        let mut view = match view {
            Some(view) => view,
            None => {
                let whole = HookChain::Whole(Arc::clone(&chain));
                call_hooks(
                    (leader, derivation),
                    (*moment, hooks),
                    whole,
                    (number, state.time()),
                    state.group,
                )?
            }
        };
        state.use_group(view.group);
        state.is_last_step |= view.is_last;
        state.variables_changed |= take_variables(leader, derivation);
        let made = match view.is_replaced {
            false => chain,
            true => state.replace_chain(&chain, Arc::unwrap_or_clone(view.chain.whole()), number)?,
        };
        Ok(PhaseOutcome { is_last: view.is_last, ..PhaseOutcome::next(made) })
    }
}

/// Calls the `hooks` of a `moment` of step `number` with the `chain` at this time. Returns the state with their requests.
fn call_hooks(
    (leader, derivation): (LeadingMachine<'_>, &Derivation),
    (moment, hooks): (HookMoment, &[HookFunction]),
    chain: HookChain,
    (number, time): (usize, f64),
    group: Option<usize>,
) -> Result<HookView> {
    let (machine, plan) = (leader.machine, &derivation.plan);
    machine.enter(plan.system)?;
    machine.refresh();
    machine.current.environments.replace(plan.environments.clone());
    let view = HookView {
        step: number,
        time,
        chain,
        symbols: Arc::clone(plan.steps.grammar.symbols()),
        groups: plan.groups.iter().map(|group| Arc::clone(&group.name)).collect(),
        group,
        is_replaced: false,
        is_last: false,
        may_replace: plan.steps.chains == 1 && matches!(moment, HookMoment::Start | HookMoment::BeforeStep),
        read: None,
    };
    let key = derivation.key.at_place(number).substream(KeyPart::Text(moment.method().as_bytes()));
    machine.run_hooks(hooks, moment.method(), view, key)
}

impl<'a> EventHooks<'a> {
    /// Creates the hooks of a derivation whose rules of group `group` are in use.
    pub(super) fn new(leader: LeadingMachine<'a>, derivation: &'a Derivation, group: Option<usize>) -> Self {
        Self { leader, derivation, group, early: None, has_changed_variables: false }
    }

    /// Runs the hooks after the step before step `number`, and those before it. The series ends if the hooks end the
    /// derivation, replace the chain or choose other rules.
    pub(super) fn run(&mut self, chains: &ChainsBetween, number: usize) -> Result<EventsNext> {
        let (leader, derivation, group) = (self.leader, self.derivation, self.group);
        let call = |moment: HookMoment, step: usize, group: Option<usize>| {
            let hooks = derivation.hooks.iter().find(|(other, _)| *other == moment);
            let chain = HookChain::Between(chains.clone());
            let at = (step, chains.time());
            hooks
                .map(|(_, hooks)| call_hooks((leader, derivation), (moment, hooks), chain, at, group))
                .transpose()
        };
        let after = call(HookMoment::AfterStep, number - 1, group)?;
        self.group = after.as_ref().map_or(group, |view| view.group);
        let ends = after.is_some_and(|view| view.is_last);
        let view = if ends { None } else { call(HookMoment::BeforeStep, number, self.group)? };
        self.has_changed_variables = take_variables(leader, derivation);
        let asks = view.as_ref().is_some_and(|view| view.is_last || view.is_replaced || view.group != group);
        if ends || asks || self.group != group {
            // The phase needs only a chain that has replaced the other, and the series takes its own back.
            let release = |view: HookView| match view.is_replaced {
                true => view,
                false => HookView { chain: HookChain::Whole(Arc::default()), ..view },
            };
            self.early = Some(EarlyHooks { number, ends, view: view.map(release) });
            return Ok(EventsNext::End);
        }
        enter(leader.machine, &derivation.plan)?;
        Ok(if self.has_changed_variables { EventsNext::Recompute } else { EventsNext::Continue })
    }
}

/// Publishes the variables that a hook or an interpretation has assigned. Returns true if one has changed.
fn take_variables(leader: LeadingMachine<'_>, derivation: &Derivation) -> bool {
    let plan = &derivation.plan;
    let variables = leader.machine.current.variables.borrow();
    match (&*variables, plan.variables()) {
        (Some(variables), Some(before)) if !variables.is_same(&before) => {
            plan.set_variables(variables.clone());
            true
        }
        _ => false,
    }
}

impl DerivationState<'_> {
    /// Uses the rules of the group with this number in the next steps; `None` for the rules without a group.
    pub(super) fn use_group(&mut self, group: Option<usize>) {
        if group == self.group {
            return;
        }
        self.group = group;
        let plan = &self.derivation.plan;
        let chosen = group.and_then(|number| plan.groups.get(number));
        self.stepper.set_plan(chosen.map_or(&plan.steps, |group| &group.steps));
        let decomposition = plan.decomposition.as_ref().map(|rules| &rules.steps);
        let decomposition = chosen.map_or(decomposition, |group| group.decomposition.as_ref());
        if let Some((decomposer, steps)) = self.decomposer.as_mut().zip(decomposition) {
            decomposer.set_plan(steps);
        }
    }

    /// Returns the chain that a hook has `made` in place of `chain`, for the phases that follow.
    fn replace_chain(&mut self, chain: &Chain, mut made: Chain, number: usize) -> Result<Arc<Chain>> {
        let plan = &self.derivation.plan;
        if made.symbols.len() > plan.steps.limit {
            let text = format!("the chain of a hook exceeds {} modules", plan.steps.limit);
            return Err(Error::limit(Limit::Modules, text).help("raise the limit: --module-limit N"));
        }
        made.mark(plan.steps.batch, plan.steps.grammar.arities());
        plan.set_places(None);
        // Modules have no origin among those before, so all belong to the first.
        let mut applied = vec![(NO_RULE, 0); chain.symbols.len()];
        if let Some(first) = applied.first_mut() {
            first.1 = u32::try_from(made.symbols.len()).unwrap_or(u32::MAX);
        }
        self.record(chain, applied, number);
        let made = Arc::new(made);
        self.publish(&made);
        Ok(made)
    }

    /// Publishes the variables that a hook or an interpretation has assigned.
    pub(super) fn take_variables(&mut self) {
        self.variables_changed |= take_variables(self.leader, self.derivation);
    }

    /// Sets the variables to earlier values, because the pass that has assigned them is not part of the derivation.
    pub(super) fn restore_variables(&mut self, variables: Option<Arc<VariableValues>>) -> Result<()> {
        let Some(variables) = variables else { return Ok(()) };
        self.leader.machine.load_variables(Some(&variables))?;
        self.derivation.plan.set_variables(Arc::unwrap_or_clone(variables));
        Ok(())
    }
}
