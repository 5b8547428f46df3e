//! Functions of a system for modules that depend on one another in a step, in one machine.

use std::cell::RefCell;

use mlua::{Function, Table};

use crate::machine::Machine;
use burgeon_rewriting::{DependentModules, Symbol};

/// Contexts that a driver serves: the direction, and the number of the set of symbols that they skip.
type DriverKey = (bool, usize);

/// Functions that choose and apply the rules of a system to modules that depend on one another.
#[derive(Default)]
pub(crate) struct DependentFunctions {
    /// Function that applies each rule to one module; empty if no rule has contexts in the new chain.
    appliers: Vec<Function>,
    /// Drivers that have been needed.
    drivers: RefCell<Vec<(DriverKey, Function)>>,
}

impl DependentFunctions {
    pub(super) fn new(appliers: Vec<Function>) -> Self {
        Self { appliers, drivers: RefCell::default() }
    }

    /// Returns the driver for `modules`.
    pub(crate) fn driver(&self, machine: &Machine, modules: &DependentModules<'_>) -> mlua::Result<Function> {
        let key = (modules.rules.is_backward(), modules.rules.ignored_set());
        let mut drivers = self.drivers.borrow_mut();
        let index = match drivers.iter().position(|(known, _)| *known == key) {
            Some(index) => index,
            None => {
                drivers.push((key, self.create_driver(machine, modules)?));
                drivers.len() - 1
            }
        };
        Ok(drivers[index].1.clone())
    }

    fn create_driver(&self, machine: &Machine, modules: &DependentModules<'_>) -> mlua::Result<Function> {
        let lua = machine.lua();
        let symbols = modules.grammar.arities().len();
        let [admitted, offsets, sizes] =
            [lua.create_table()?, lua.create_table()?, lua.create_table()?] as [Table; 3];
        for rule in 0..self.appliers.len() {
            let context = u16::try_from(rule).ok().and_then(|rule| modules.rules.context(rule));
            match context {
                Some(context) => admitted.raw_push(lua_set(machine, &context.admitted)?)?,
                None => admitted.raw_push(false)?,
            }
            offsets.raw_push(context.map_or(0, |context| 8 * context.first_argument))?;
            sizes.raw_push(context.map_or(0, |context| 8 * context.bound))?;
        }
        let is_ignored =
            |symbol: usize| Symbol::try_from(symbol).is_ok_and(|it| modules.rules.is_ignored(it));
        let ignored: Vec<bool> = (0..symbols).map(is_ignored).collect();
        machine.prelude().dependents.call((
            self.appliers.clone(),
            admitted,
            offsets,
            sizes,
            modules.rules.is_backward(),
            lua_set(machine, &ignored)?,
        ))
    }
}

/// Returns a table with `true` or `false` by symbol.
fn lua_set(machine: &Machine, symbols: &[bool]) -> mlua::Result<Table> {
    let set = machine.lua().create_table_with_capacity(symbols.len(), 0)?;
    for (symbol, is_in) in symbols.iter().enumerate().skip(1) {
        set.raw_set(symbol, *is_in)?;
    }
    Ok(set)
}
