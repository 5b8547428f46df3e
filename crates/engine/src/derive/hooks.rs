//! Hooks between steps, and what they change: groups of rules and variables.

use std::sync::Arc;

use super::state::DerivationState;
use crate::machine::{HookFunction, HookMoment, HookView};
use crate::results::VariableValues;
use burgeon_base::error::Result;
use burgeon_rewriting::{Chain, KeyPart, Phase, PhaseOutcome};

/// Runs the hooks for a moment.
pub(super) struct RunHooks(pub HookMoment, pub Vec<HookFunction>);

impl Phase<DerivationState<'_>> for RunHooks {
    fn run(&self, state: &mut DerivationState<'_>, chain: Arc<Chain>, number: usize) -> Result<PhaseOutcome> {
        let Self(moment, hooks) = self;
        let (machine, plan) = (state.leader.machine, &state.derivation.plan);
        machine.session.stop.check()?;
        if *moment == HookMoment::Start {
            state.publish(&chain);
        }
        machine.enter(plan.system)?;
        machine.refresh();
        machine.current.environments.replace(plan.environments.clone());
        let view = HookView {
            step: number,
            time: state.time(),
            chain: Arc::clone(&chain),
            symbols: Arc::clone(plan.steps.grammar.symbols()),
            groups: plan.groups.iter().map(|group| Arc::clone(&group.name)).collect(),
            group: state.group,
            is_last: false,
        };
        let key = state.derivation.key.at_place(number).substream(KeyPart::Text(moment.method().as_bytes()));
        let view = machine.run_hooks(hooks, moment.method(), view, key)?;
        state.use_group(view.group);
        state.take_variables();
        Ok(PhaseOutcome { is_last: view.is_last, ..PhaseOutcome::next(chain) })
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

    /// Publishes the variables that a hook or an interpretation has assigned.
    pub(super) fn take_variables(&mut self) {
        let plan = &self.derivation.plan;
        let variables = self.leader.machine.current.variables.borrow();
        if let (Some(variables), Some(before)) = (&*variables, plan.variables())
            && !variables.is_same(&before)
        {
            self.variables_changed = true;
            plan.set_variables(variables.clone());
        }
    }

    /// Sets the variables to earlier values, because the pass that has assigned them is not part of the derivation.
    pub(super) fn restore_variables(&mut self, variables: Option<Arc<VariableValues>>) -> Result<()> {
        let Some(variables) = variables else { return Ok(()) };
        self.leader.machine.load_variables(Some(&variables))?;
        self.derivation.plan.set_variables(Arc::unwrap_or_clone(variables));
        Ok(())
    }
}
