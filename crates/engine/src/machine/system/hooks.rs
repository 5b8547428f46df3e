//! Hooks: functions of a script that run at the beginning and the end of a derivation, and of each step.

use mlua::{Function, Table, Value as LuaValue};

use super::SystemDeclaration;
use crate::machine::Machine;
use crate::machine::freeze::{ReachableFunction, reaches};
use burgeon_base::error::{Error, Result, SourcePlace};

/// Moment of a derivation at which a hook runs.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum HookMoment {
    /// Before the axiom is decomposed and interpreted.
    Start,
    /// Before the rules of a step are applied.
    BeforeStep,
    /// After a step and its interpretation.
    AfterStep,
    /// After the last step and its interpretation.
    End,
}

impl HookMoment {
    /// All moments, in the order of a derivation.
    pub(crate) const ALL: [Self; 4] = [Self::Start, Self::BeforeStep, Self::AfterStep, Self::End];

    /// Returns the name of the method that declares a hook.
    pub(crate) fn method(self) -> &'static str {
        match self {
            Self::Start => "at_start",
            Self::BeforeStep => "before_step",
            Self::AfterStep => "after_step",
            Self::End => "at_end",
        }
    }
}

/// Function of a hook, with the line that declares it.
pub(crate) type HookFunction = (Function, Option<SourcePlace>);

/// Hook of a system.
pub(crate) struct DeclaredHook {
    pub(crate) moment: HookMoment,
    pub(crate) run: HookFunction,
}

impl SystemDeclaration {
    /// Adds the hook that a script declares with `arguments`.
    pub(super) fn add_hook(
        &mut self,
        moment: HookMoment,
        arguments: Vec<LuaValue>,
        place: Option<SourcePlace>,
    ) -> Result<()> {
        let method = moment.method();
        let Ok([LuaValue::Function(function)]) = <[LuaValue; 1]>::try_from(arguments) else {
            return Err(Error::argument(format!("{method} takes one function"))
                .help(format!("write system:{method}(function(now) ... end)")));
        };
        let taken = function.info().num_params;
        if taken > 1 {
            return Err(Error::argument(format!("the hook has {taken} parameters, but it gets one"))
                .help(format!("write system:{method}(function(now) ... end)")));
        }
        self.hooks.push(DeclaredHook { moment, run: (function, place) });
        Ok(())
    }

    /// Returns the hooks of each moment that has some, in the order of declaration.
    pub(crate) fn hooks_by_moment(&self) -> Vec<(HookMoment, Vec<HookFunction>)> {
        let hooks_at = |moment| {
            let hooks = self.hooks.iter().filter(move |hook| hook.moment == moment);
            hooks.map(|hook| hook.run.clone()).collect::<Vec<HookFunction>>()
        };
        let all = HookMoment::ALL.into_iter().map(|moment| (moment, hooks_at(moment)));
        all.filter(|(_, hooks)| !hooks.is_empty()).collect()
    }

    /// Returns true if functions can depend on several chains at once.
    pub(crate) fn has_state_of_all_chains(&self) -> bool {
        !self.hooks.is_empty() || self.variables.is_some() || !self.environments.is_empty()
    }

    /// Returns true if an interpretation can assign variables of the system.
    pub(crate) fn interpretations_reach_variables(&self, machine: &Machine) -> Result<bool> {
        if self.variables.is_none() {
            return Ok(false);
        }
        let is_variables = |table: &Table| {
            let number = machine.prelude().variables_of.call::<Option<usize>>(table);
            number.is_ok_and(|number| number.is_some())
        };
        let functions = self.interpretations.iter().map(|known| known.function.clone());
        reaches(machine.lua(), functions.collect(), is_variables).map_err(|error| machine.translate(error))
    }

    /// Returns the hooks as functions whose reachable tables are frozen.
    pub(super) fn reachable_hooks(&self) -> impl Iterator<Item = ReachableFunction<'_>> {
        self.hooks.iter().map(|DeclaredHook { moment, run: (function, place) }| {
            ReachableFunction::of_rule(function, moment.method(), place.as_ref())
        })
    }
}
