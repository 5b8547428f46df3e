//! Hooks between steps, and what they change: groups of rules and variables.

use std::sync::Arc;

use super::state::DerivationState;
use crate::machine::{HookFunction, HookMoment, HookView};
use crate::results::VariableValues;
use burgeon_base::error::{Error, Limit, Result};
use burgeon_rewriting::{Chain, KeyPart, NO_RULE, Phase, PhaseOutcome};

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
            may_replace: plan.steps.chains == 1
                && matches!(moment, HookMoment::Start | HookMoment::BeforeStep),
            read: None,
        };
        let key = state.derivation.key.at_place(number).substream(KeyPart::Text(moment.method().as_bytes()));
        let view = machine.run_hooks(hooks, moment.method(), view, key)?;
        state.use_group(view.group);
        state.take_variables();
        let made = match Arc::ptr_eq(&view.chain, &chain) {
            true => chain,
            false => state.replace_chain(&chain, Arc::unwrap_or_clone(view.chain), number)?,
        };
        Ok(PhaseOutcome { is_last: view.is_last, ..PhaseOutcome::next(made) })
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
