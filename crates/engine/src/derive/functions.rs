//! Rule functions that run in a virtual machine.

use crate::machine::{Machine, SystemFunctions, read_column, write_column, write_columns};
use burgeon_base::error::{Error, ErrorKind, Limit, Result};
use burgeon_rewriting::{
    Applications, DependentModules, ModuleKey, NO_RULE, RuleFailure, Rules, ShowParameters, StepNumber,
    Successors,
};
use mlua::{FromLuaMulti, Function};

/// Maximum number of random numbers that are drawn in advance for a batch.
const MOST_PREPARED: usize = 1 << 17;

/// Rule functions of a system in a virtual machine.
pub(super) struct LuaRules<'a> {
    pub machine: &'a Machine,
    pub declared: &'a SystemFunctions,
    /// Set if the number of steps is given.
    pub bounded: bool,
}

impl LuaRules<'_> {
    /// Passes arguments, places, chains and random keys of a batch of applications to the machine.
    fn prepare(&self, applications: &Applications<'_>) -> Result<()> {
        let Applications { places, chains, keys, weighted, step, times, .. } = *applications;
        self.prepare_modules([places, chains], keys, weighted, step);
        self.machine.current.set_times(times);
        if applications.arguments.is_empty() {
            return Ok(());
        }
        let input = self.machine.prelude().input(applications.arguments.len() * 8);
        write_column(input.map_err(|error| self.translate(error))?, applications.arguments)
    }

    /// Passes the places, chains and random keys of modules to the machine.
    fn prepare_modules(
        &self,
        [places, chains]: [&[u32]; 2],
        keys: &[ModuleKey],
        weighted: bool,
        step: &StepNumber,
    ) {
        self.machine.refresh();
        let current = &self.machine.current;
        current.begin_step(step.number(), self.bounded);
        current.places.borrow_mut().clear();
        current.places.borrow_mut().extend_from_slice(places);
        if !chains.is_empty() {
            let mut known = current.chains.borrow_mut();
            known.clear();
            known.extend_from_slice(chains);
        }
        if !keys.is_empty() {
            let mut known = current.keys.borrow_mut();
            known.clear();
            known.extend_from_slice(keys);
            current.used.set(usize::from(weighted));
        }
    }

    /// Draws the first `draws` random numbers of each application's stream in advance, or fewer if these would be too many
    /// for a buffer.
    fn prepare_random(&self, count: usize, draws: usize) -> Result<()> {
        let current = &self.machine.current;
        let draws = draws.min(MOST_PREPARED / count.max(1));
        let mut column = Vec::with_capacity(count * draws);
        for key in current.keys.borrow().iter() {
            let mut stream = key.stream();
            for _ in 0..current.used.get() {
                stream.uniform();
            }
            column.extend((0..draws).map(|_| stream.uniform()));
        }
        let buffer = self.machine.prelude().randoms(column.len() * 8, draws);
        write_column(buffer.map_err(|error| self.translate(error))?, &column)
    }

    /// Calls a driver of a rule or guard for all applications.
    fn call<R: FromLuaMulti>(
        &self,
        driver: &Function,
        applications: &Applications<'_>,
    ) -> Result<R, RuleFailure> {
        let called = self.machine.call(driver, applications.count);
        self.note_requests(applications.step);
        called.map_err(|error| self.failure(error))
    }

    /// Notes in `step` that functions have read its number, or requested that it is the last.
    fn note_requests(&self, step: &StepNumber) {
        if self.machine.current.has_read_step() {
            step.note_read();
        }
        if self.machine.current.take_end() {
            step.request_end();
        }
    }

    /// Passes the columns of modules that depend on one another to the machine. Returns the offsets (bytes) of neighbours and
    /// trials in the column of links, and the offset and the size of the values of neighbours in the column of arguments.
    fn prepare_dependents(&self, modules: &DependentModules<'_>) -> mlua::Result<[usize; 4]> {
        let prelude = self.machine.prelude();
        let [arguments, values] = [modules.arguments, modules.values].map(std::mem::size_of_val);
        write_columns(
            prelude.input(arguments + values)?,
            &[bytemuck::cast_slice(modules.arguments), bytemuck::cast_slice(modules.values)],
        )?;
        let links: [&[u8]; 3] = [
            bytemuck::cast_slice(modules.modules),
            bytemuck::cast_slice(modules.neighbours),
            bytemuck::cast_slice(modules.trials),
        ];
        let [of_modules, of_neighbours, of_trials] = links.map(<[u8]>::len);
        write_columns(prelude.links(of_modules + of_neighbours + of_trials)?, &links)?;
        Ok([of_modules, of_modules + of_neighbours, arguments, values])
    }

    /// Returns the error of a script for an error of Lua, without the line of `derive`: if memory runs out outside the functions of
    /// rules, the line of a rule tells more.
    fn translate(&self, error: mlua::Error) -> Error {
        let error = self.machine.translate(error);
        let is_memory = matches!(error.kind(), ErrorKind::Limit(Limit::Memory));
        match is_memory && error.place() == Machine::place(self.machine.lua()).as_ref() {
            true => error.without_place(),
            false => error,
        }
    }

    /// Returns the failure with the index of the application that failed.
    fn failure(&self, error: mlua::Error) -> RuleFailure {
        let prelude = self.machine.prelude();
        let at = self.machine.failed_at().map_or(0, |(at, ..)| at);
        // If ending the batch fails too, the machine is dropped with the run.
        let _ = prelude.finish.call::<()>(());
        RuleFailure { at, error: self.translate(error) }
    }
}

impl Rules for LuaRules<'_> {
    fn apply(&self, applications: &Applications<'_>, made: &mut Successors) -> Result<(), RuleFailure> {
        let lua = |error: mlua::Error| self.translate(error);
        let (prelude, current) = (self.machine.prelude(), &self.machine.current);
        let division = self.declared.divisions[usize::from(applications.rule)].as_ref();
        if division.is_some_and(|division| division.apply(self.machine, applications.arguments, made)) {
            return Ok(());
        }
        self.prepare(applications)?;
        let counts = prelude.counts(applications.count * 4).map_err(lua)?;
        if made.draws > 0 {
            self.prepare_random(applications.count, made.draws)?;
        }
        current.drawn.set(0);
        let driver = &self.declared.drivers[usize::from(applications.rule)];
        let (modules, bytes): (usize, usize) = self.call(driver, applications)?;
        made.draws = made.draws.max(current.drawn.get());
        let (symbols, params, order, items) = prelude.outputs().map_err(lua)?;
        read_column(symbols, modules, &mut made.symbols)?;
        read_column(params, bytes / 8, &mut made.params)?;
        read_column(counts, applications.count, &mut made.ends)?;
        read_column(order, items, &mut made.order)?;
        made.shapes.clone_from(&current.shapes.borrow());
        Ok(())
    }

    fn guard(&self, applications: &Applications<'_>, holds: &mut Vec<u32>) -> Result<(), RuleFailure> {
        self.prepare(applications)?;
        let counts = self.machine.prelude().counts(applications.count * 4);
        let counts = counts.map_err(|error| self.translate(error))?;
        let Some(guard) = &self.declared.guards[usize::from(applications.rule)] else { return Ok(()) };
        let asked = self.call::<()>(guard, applications);
        // Guard results before the failure remain valid.
        read_column(counts, applications.count, holds)?;
        asked
    }

    fn propensity(
        &self,
        applications: &Applications<'_>,
        propensities: &mut Vec<f64>,
    ) -> Result<(), RuleFailure> {
        self.prepare(applications)?;
        let column = self.machine.prelude().counts(applications.count * 8);
        let column = column.map_err(|error| self.translate(error))?;
        let Some(propensity) = &self.declared.propensities[usize::from(applications.rule)] else {
            return Ok(());
        };
        let asked = self.call::<()>(propensity, applications);
        let done = asked.as_ref().map_or_else(|failure| failure.at, |()| applications.count);
        read_column(column, done, propensities)?;
        asked
    }

    fn apply_dependents(
        &self,
        modules: &DependentModules<'_>,
        made: &mut Successors,
        chosen: &mut Vec<u32>,
    ) -> Result<(), RuleFailure> {
        let lua = |error: mlua::Error| self.translate(error);
        let (prelude, current) = (self.machine.prelude(), &self.machine.current);
        let count = modules.modules.len();
        let driver = self.declared.dependents.driver(self.machine, modules).map_err(lua)?;
        self.prepare_modules([modules.places, modules.chains], modules.keys, false, modules.step);
        current.set_times(&[]);
        let [neighbours, trials, values, size] = self.prepare_dependents(modules).map_err(lua)?;
        let counts = prelude.counts(count * 8).map_err(lua)?;
        if made.draws > 0 {
            self.prepare_random(count, made.draws)?;
        }
        current.drawn.set(0);
        let only = only_rule(modules);
        let called =
            self.machine.call(&driver, (count, neighbours, trials, values, size, only.map_or(-1, i64::from)));
        let (produced, bytes, is_only): (usize, usize, bool) = match called {
            Ok(produced) => produced,
            Err(error) => {
                // The modules are rewritten again, so requests of this call do not count.
                current.take_end();
                let rule = self.machine.failed_at().and_then(|(.., rule)| u32::try_from(rule).ok());
                chosen.clear();
                chosen.push(rule.unwrap_or(u32::from(NO_RULE)));
                return Err(self.failure(error));
            }
        };
        self.note_requests(modules.step);
        made.draws = made.draws.max(current.drawn.get());
        let (symbols, params, order, items) = prelude.outputs().map_err(lua)?;
        read_column(symbols, produced, &mut made.symbols)?;
        read_column(params, bytes / 8, &mut made.params)?;
        // The values of neighbours come first.
        made.params.drain(..size / 8);
        chosen.clear();
        match only.filter(|_| is_only) {
            Some(rule) => {
                read_column(counts, count, &mut made.ends)?;
                // Modules without a rule are marked by a number that no other module has.
                let rule_of = |end: &u32| if *end == u32::MAX { u32::from(NO_RULE) } else { rule };
                chosen.extend(made.ends.iter().map(rule_of));
            }
            None => {
                read_column(counts, 2 * count, &mut made.ends)?;
                chosen.extend(made.ends.drain(count..));
            }
        }
        read_column(order, items, &mut made.order)?;
        made.shapes.clone_from(&current.shapes.borrow());
        Ok(())
    }

    fn accepts_dependents(&self) -> bool {
        // Printed texts appear in the order of the calls, and queries find the arguments of the rule by its application.
        !self.machine.session.observes_steps()
    }

    fn parameters(&self) -> &dyn ShowParameters {
        &*self.machine.session.values
    }
}

/// Returns the number of the rule if all modules try only this one.
fn only_rule(modules: &DependentModules<'_>) -> Option<u32> {
    let [rule, _] = *modules.trials.first()?;
    let each = modules.modules.iter().zip(1..).all(|([_, _, end], number)| *end == number);
    (each && modules.trials.iter().all(|[other, _]| *other == rule)).then_some(rule)
}
