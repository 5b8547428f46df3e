//! Chains of derived systems as lists of modules.

use mlua::{Function, Lua, MultiValue, Table, Value as LuaValue};

use crate::machine::convert::to_lua;
use crate::results::DerivedSystem;
use burgeon_base::Stop;
use burgeon_base::error::{Error, Result};
use burgeon_kit::Values;
use burgeon_rewriting::{CLOSE, Chain, END, Mark, ModuleKey, OPEN, Symbols};

/// Registry name of the function that makes a module from its symbol and its parameters.
pub(crate) const READ_MODULE: &str = "burgeon read_module";

/// Number of symbols between two checks for cancellation.
const STRETCH: usize = 4096;

/// A chain that scripts read as lists.
pub(crate) struct ReadableChain<'a> {
    pub chain: &'a Chain,
    pub symbols: &'a Symbols,
    pub values: &'a Values,
}

/// Returns chain number `number`, from 1, as a list of modules, in which each branch is a list.
pub(super) fn module_list(lua: &Lua, derived: &DerivedSystem, number: usize) -> mlua::Result<Table> {
    let DerivedSystem { chain, symbols, values, .. } = derived;
    let starts = chain.starts(&symbols.arities());
    let chains = starts.len() - 1;
    let (Some(begin), true) = (starts.get(number.wrapping_sub(1)), number <= chains) else {
        let text = format!("the derived system has no chain number {number}");
        let help = match chains {
            0 => "it has no chains",
            1 => "it has one chain: derived:chain()",
            _ => &format!("it has {chains} chains: derived:chain(1) to derived:chain({chains})"),
        };
        return Err(mlua::Error::external(Error::argument(text).help(help)));
    };
    ReadableChain { chain, symbols, values }.list(lua, *begin, &mut |_, _| Ok(()))
}

impl ReadableChain<'_> {
    /// Returns the chain that begins at `begin` as a list of modules, in which each branch is a list. Calls `note` with each
    /// module and its index in the chain.
    pub(crate) fn list(
        &self,
        lua: &Lua,
        begin: Mark,
        note: &mut dyn FnMut(&LuaValue, usize) -> mlua::Result<()>,
    ) -> mlua::Result<Table> {
        let arities = self.symbols.arities();
        let make: Function = lua.named_registry_value(READ_MODULE)?;
        let mut open: Vec<Table> = Vec::new();
        let mut list = lua.create_table()?;
        let mut param = begin.param;
        for (place, symbol) in self.chain.symbols[begin.module..].iter().enumerate() {
            if place.is_multiple_of(STRETCH) {
                Stop::check_current().map_err(mlua::Error::external)?;
            }
            match *symbol {
                OPEN => open.push(std::mem::replace(&mut list, lua.create_table()?)),
                CLOSE => {
                    let Some(outer) = open.pop() else { break };
                    outer.raw_push(std::mem::replace(&mut list, outer.clone()))?;
                }
                END => break,
                symbol => {
                    let params = &self.chain.params[param..][..usize::from(arities[usize::from(symbol)])];
                    param += params.len();
                    let made = self.module(lua, &make, (symbol, params))?;
                    note(&made, begin.module + place)?;
                    list.raw_push(made)?;
                }
            }
        }
        Ok(list)
    }

    /// Makes a module, without the omitted parameters at its end.
    fn module(&self, lua: &Lua, make: &Function, (symbol, params): (u16, &[f64])) -> mlua::Result<LuaValue> {
        let mut arguments = MultiValue::with_capacity(params.len() + 1);
        arguments.push_back(LuaValue::Number(f64::from(symbol)));
        for stored in params {
            arguments.push_back(to_lua(lua, &self.values.unpack(*stored), true)?);
        }
        while arguments.len() > 1 && matches!(arguments.back(), Some(LuaValue::Nil)) {
            arguments.pop_back();
        }
        make.call(arguments)
    }
}

/// The chain that a hook has read as a list. Its modules keep their random keys in the chain that the hook returns.
pub(crate) struct ReadChain {
    /// List of its modules.
    pub list: Table,
    /// Index in the chain of each module, by the module.
    places: Table,
    keys: Vec<ModuleKey>,
}

impl ReadChain {
    /// Reads the first chain.
    pub(crate) fn read(lua: &Lua, chain: &ReadableChain<'_>) -> mlua::Result<Self> {
        let places = lua.create_table()?;
        let list = chain.list(lua, Mark::default(), &mut |module, place| places.raw_set(module, place))?;
        Ok(Self { list, places, keys: chain.chain.keys.clone() })
    }

    /// Creates the chain of a hook that has read no modules.
    pub(crate) fn empty(lua: &Lua) -> mlua::Result<Self> {
        Ok(Self { list: lua.create_table()?, places: lua.create_table()?, keys: Vec::new() })
    }

    /// Returns the random key of a module, if the hook has read it and modules have keys.
    pub(crate) fn key_of(&self, module: &Table) -> Option<ModuleKey> {
        let place = self.places.raw_get::<Option<usize>>(module).ok()??;
        self.keys.get(place).copied()
    }
}

/// Returns the number of a chain that a script gives, 1 unless given.
pub(super) fn chain_number(value: &LuaValue) -> Result<usize> {
    match value {
        LuaValue::Nil => Ok(1),
        LuaValue::Integer(number) if *number > 0 => Ok(usize::try_from(*number).unwrap_or(usize::MAX)),
        _ => Err(Error::argument("derived:chain takes the number of a chain, from 1")
            .help("write derived:chain() for the first chain")),
    }
}
