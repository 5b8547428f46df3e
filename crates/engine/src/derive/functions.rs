//! How the functions of rules are run over batches of modules.
//!
//! Matching, drawing and splicing know them by the trait [`RuleFunctions`] alone, so that there can be another way to run
//! them than in a virtual machine.

use std::cell::Ref;

use super::group::RuleGroup;
use crate::machine::{Machine, ReturnShape, SystemFunctions, read_column, write_column};
use burgeon_base::error::{Error, Result};
use burgeon_kit::rules::ModuleKey;

/// The applications of one rule that its function is run for at once.
pub(super) struct Applications<'a> {
    /// The rule's number.
    pub rule: u16,
    /// How many there are.
    pub count: usize,
    /// The arguments of all of them, one application after the other.
    pub arguments: &'a [f64],
    /// The chain of each; empty where there is only one chain.
    pub chains: &'a [u32],
    /// The random key of each; empty where nothing draws.
    pub keys: &'a [ModuleKey],
    /// The place of each in the chain of the step; empty where it is not noted what they ask.
    pub places: &'a [u32],
    /// Whether the choice among weighted rules has taken the first number of each stream.
    pub weighted: bool,
}

/// A function that has failed.
pub(super) struct Failure {
    /// The application that it failed in.
    pub at: usize,
    /// Why.
    pub error: Error,
}

impl From<Error> for Failure {
    fn from(error: Error) -> Self {
        Self { at: 0, error }
    }
}

/// Runs the functions of a system's rules, in one thread.
pub(super) trait RuleFunctions {
    /// Runs the successor of a rule; `made` takes the modules.
    fn apply(&self, applications: &Applications<'_>, made: &mut RuleGroup) -> Result<(), Failure>;

    /// Asks the guard of a rule; `holds` takes a number for each application, 0 where it does not hold.
    fn ask(&self, applications: &Applications<'_>, holds: &mut Vec<u32>) -> Result<(), Failure>;

    /// The modules of returns that are always the same, by number.
    fn shapes(&self) -> Ref<'_, [ReturnShape]>;
}

/// The functions of a script in a virtual machine.
pub(super) struct LuaFunctions<'a> {
    pub machine: &'a Machine,
    pub declared: &'a SystemFunctions,
}

impl LuaFunctions<'_> {
    /// Hands the machine what its functions are to be run for.
    fn prepare(&self, applications: &Applications<'_>) -> Result<()> {
        let current = &self.machine.current;
        if !applications.places.is_empty() {
            current.places.replace(applications.places.to_vec());
        }
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

    /// Draws the first numbers of every application's stream before they are asked for.
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

    /// Where a function failed, and why.
    fn failure(&self, error: mlua::Error) -> Failure {
        let prelude = self.machine.prelude();
        let at = self.machine.failed_at().map_or(0, |(at, ..)| at);
        // A machine that cannot even end the batch is thrown away with the run.
        let _ = prelude.finish.call::<()>(());
        Failure { at, error: self.machine.translate(error) }
    }
}

impl RuleFunctions for LuaFunctions<'_> {
    fn apply(&self, applications: &Applications<'_>, made: &mut RuleGroup) -> Result<(), Failure> {
        let lua = |error: mlua::Error| self.machine.translate(error);
        let (prelude, current) = (self.machine.prelude(), &self.machine.current);
        self.prepare(applications)?;
        let counts = prelude.counts(applications.count * 4).map_err(lua)?;
        if made.draws > 0 {
            self.prepare_random(applications.count, made.draws)?;
        }
        current.drawn.set(0);
        let driver = &self.declared.drivers[usize::from(applications.rule)];
        let (modules, bytes): (usize, usize) =
            self.machine.call(driver, applications.count).map_err(|error| self.failure(error))?;
        made.draws = made.draws.max(current.drawn.get());
        let (symbols, params, order, items) = prelude.outputs().map_err(lua)?;
        read_column(symbols, modules, &mut made.symbols)?;
        read_column(params, bytes / 8, &mut made.params)?;
        read_column(counts, applications.count, &mut made.ends)?;
        read_column(order, items, &mut made.order)?;
        made.rewind();
        Ok(())
    }

    fn ask(&self, applications: &Applications<'_>, holds: &mut Vec<u32>) -> Result<(), Failure> {
        self.prepare(applications)?;
        let counts = self.machine.prelude().counts(applications.count * 4);
        let counts = counts.map_err(|error| self.machine.translate(error))?;
        let Some(guard) = &self.declared.guards[usize::from(applications.rule)] else { return Ok(()) };
        let asked = self.machine.call::<()>(guard, applications.count).map_err(|error| self.failure(error));
        // What was told before the failure counts.
        read_column(counts, applications.count, holds)?;
        asked
    }

    fn shapes(&self) -> Ref<'_, [ReturnShape]> {
        Ref::map(self.machine.current.shapes.borrow(), Vec::as_slice)
    }
}
