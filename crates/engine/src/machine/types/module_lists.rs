//! Chains of derived systems as lists of modules.

use mlua::{Function, Lua, MultiValue, Table, Value as LuaValue};

use crate::machine::convert::to_lua;
use crate::results::DerivedSystem;
use burgeon_base::Stop;
use burgeon_base::error::{Error, Result};
use burgeon_rewriting::{CLOSE, END, OPEN};

/// Registry name of the function that makes a module from its symbol and its parameters.
pub(crate) const READ_MODULE: &str = "burgeon read_module";

/// Number of symbols between two checks for cancellation.
const STRETCH: usize = 4096;

/// Returns chain number `number`, from 1, as a list of modules, in which each branch is a list.
pub(super) fn module_list(lua: &Lua, derived: &DerivedSystem, number: usize) -> mlua::Result<Table> {
    let arities = derived.symbols.arities();
    let starts = derived.chain.starts(&arities);
    let chains = starts.len() - 1;
    let (Some(begin), true) = (starts.get(number.wrapping_sub(1)), number <= chains) else {
        let text = format!("the derived system has no chain number {number}");
        return Err(mlua::Error::external(Error::argument(text).help(match chains {
            0 => "it has no chains".to_owned(),
            1 => "it has one chain: derived:chain()".to_owned(),
            _ => format!("it has {chains} chains: derived:chain(1) to derived:chain({chains})"),
        })));
    };
    let make: Function = lua.named_registry_value(READ_MODULE)?;
    let mut open: Vec<Table> = Vec::new();
    let mut list = lua.create_table()?;
    let mut param = begin.param;
    for (place, symbol) in derived.chain.symbols[begin.module..].iter().enumerate() {
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
                let params = &derived.chain.params[param..][..usize::from(arities[usize::from(symbol)])];
                param += params.len();
                list.raw_push(module(lua, derived, &make, (symbol, params))?)?;
            }
        }
    }
    Ok(list)
}

/// Makes a module, without the omitted parameters at its end.
fn module(
    lua: &Lua,
    derived: &DerivedSystem,
    make: &Function,
    (symbol, params): (u16, &[f64]),
) -> mlua::Result<LuaValue> {
    let mut arguments = MultiValue::with_capacity(params.len() + 1);
    arguments.push_back(LuaValue::Number(f64::from(symbol)));
    for stored in params {
        arguments.push_back(to_lua(lua, &derived.values.unpack(*stored), true)?);
    }
    while arguments.len() > 1 && matches!(arguments.back(), Some(LuaValue::Nil)) {
        arguments.pop_back();
    }
    make.call(arguments)
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
