//! Rule functions that run in a virtual machine.

use crate::machine::{Machine, SystemFunctions, read_column, write_column};
use burgeon_base::error::Result;
use burgeon_rewriting::{Applications, RuleFailure, Rules, ShowParameters, Successors};
use mlua::{FromLuaMulti, Function};

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
        let current = &self.machine.current;
        current.begin_step(applications.step.number(), self.bounded);
        current.set_times(applications.times);
        current.places.borrow_mut().clear();
        current.places.borrow_mut().extend_from_slice(applications.places);
        if !applications.chains.is_empty() {
            let mut chains = current.chains.borrow_mut();
            chains.clear();
            chains.extend_from_slice(applications.chains);
        }
        if !applications.keys.is_empty() {
            let mut keys = current.keys.borrow_mut();
            keys.clear();
            keys.extend_from_slice(applications.keys);
            current.used.set(usize::from(applications.weighted));
        }
        if applications.arguments.is_empty() {
            return Ok(());
        }
        let input = self.machine.prelude().input(applications.arguments.len() * 8);
        write_column(input.map_err(|error| self.machine.translate(error))?, applications.arguments)
    }

    /// Draws the first `draws` random numbers of each application's stream in advance.
    fn prepare_random(&self, count: usize, draws: usize) -> Result<()> {
        let current = &self.machine.current;
        let mut column = Vec::with_capacity(count * draws);
        for key in current.keys.borrow().iter() {
            let mut stream = key.stream();
            for _ in 0..current.used.get() {
                stream.uniform();
            }
            column.extend((0..draws).map(|_| stream.uniform()));
        }
        let buffer = self.machine.prelude().randoms(column.len() * 8, draws);
        write_column(buffer.map_err(|error| self.machine.translate(error))?, &column)
    }

    /// Calls a driver of a rule or guard for all applications.
    fn call<R: FromLuaMulti>(
        &self,
        driver: &Function,
        applications: &Applications<'_>,
    ) -> Result<R, RuleFailure> {
        let called = self.machine.call(driver, applications.count);
        if self.machine.current.has_read_step() {
            applications.step.note_read();
        }
        if self.machine.current.take_end() {
            applications.step.request_end();
        }
        called.map_err(|error| self.failure(error))
    }

    /// Returns the failure with the index of the application that failed.
    fn failure(&self, error: mlua::Error) -> RuleFailure {
        let prelude = self.machine.prelude();
        let at = self.machine.failed_at().map_or(0, |(at, ..)| at);
        // If ending the batch fails too, the machine is dropped with the run.
        let _ = prelude.finish.call::<()>(());
        RuleFailure { at, error: self.machine.translate(error) }
    }
}

impl Rules for LuaRules<'_> {
    fn apply(&self, applications: &Applications<'_>, made: &mut Successors) -> Result<(), RuleFailure> {
        let lua = |error: mlua::Error| self.machine.translate(error);
        let (prelude, current) = (self.machine.prelude(), &self.machine.current);
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
        let counts = counts.map_err(|error| self.machine.translate(error))?;
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
        let column = column.map_err(|error| self.machine.translate(error))?;
        let Some(propensity) = &self.declared.propensities[usize::from(applications.rule)] else {
            return Ok(());
        };
        let asked = self.call::<()>(propensity, applications);
        let done = asked.as_ref().map_or_else(|failure| failure.at, |()| applications.count);
        read_column(column, done, propensities)?;
        asked
    }

    fn parameters(&self) -> &dyn ShowParameters {
        &*self.machine.session.values
    }
}
