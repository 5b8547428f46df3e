//! Variables of systems: hooks and interpretations assign them, and rules read them.

use std::rc::Rc;
use std::sync::Arc;

use mlua::{Lua, LuaString, Table, Value as LuaValue};

use super::Machine;
use super::convert::{to_lua, to_value, type_of};
use super::current::WorkState;
use super::library::Library;
use crate::results::VariableValues;
use burgeon_base::error::{Error, Result};
use burgeon_kit::{TableKey, Value};

/// Variables that a script has declared together, with their values at the beginning of a derivation.
pub(crate) struct VariableTable {
    names: Vec<Arc<str>>,
    initial: Vec<Value>,
}

impl Library {
    /// Returns the values of variables number `table` at the beginning of a derivation.
    pub(crate) fn initial_variables(&self, table: usize) -> Option<VariableValues> {
        self.variables
            .borrow()
            .get(table)
            .map(|declared| VariableValues::new(table, &declared.names, &declared.initial))
    }
}

impl Machine {
    /// Sets the variables that functions of the script read; `None` after a derivation.
    pub(crate) fn load_variables(&self, values: Option<&VariableValues>) -> Result<()> {
        let mut loaded = self.current.variables.borrow_mut();
        if let (Some(loaded), Some(values)) = (&*loaded, values)
            && loaded.is_same(values)
        {
            return Ok(());
        }
        let load = |number: usize, values: Option<&VariableValues>| {
            let table = values.map(|values| table_of(self.lua(), values)).transpose()?;
            self.prelude().load_variables.call::<()>((number, table))
        };
        let lua = |error: mlua::Error| self.translate(error);
        if let Some(earlier) = loaded.take() {
            load(earlier.table, None).map_err(lua)?;
        }
        if let Some(values) = values {
            load(values.table, Some(values)).map_err(lua)?;
            *loaded = Some(values.clone());
        }
        Ok(())
    }
}

/// Returns variables as a table of their values by name.
pub(crate) fn table_of(lua: &Lua, values: &VariableValues) -> mlua::Result<Table> {
    let table = lua.create_table()?;
    for (name, value) in values.names.iter().zip(&values.values) {
        table.raw_set(&**name, to_lua(lua, value, true)?)?;
    }
    Ok(table)
}

/// Adds the functions for variables of systems.
pub(super) fn add_variables(
    lua: &Lua,
    host: &Table,
    current: &Rc<WorkState>,
    library: &Rc<Library>,
) -> mlua::Result<()> {
    let owner = Rc::clone(library);
    host.set(
        "declare_variables",
        lua.create_function(move |_, initial: LuaValue| {
            declare(&owner, initial).map_err(mlua::Error::external)
        })?,
    )?;
    let state = Rc::clone(current);
    host.set(
        "set_variable",
        lua.create_function(move |lua, (table, name, value): (usize, LuaString, LuaValue)| {
            let value = to_value(&value, false).and_then(|value| assignable(&name.to_string_lossy(), value));
            let value = value.map_err(mlua::Error::external)?;
            let stored = to_lua(lua, &value, true)?;
            let mut variables = state.variables.borrow_mut();
            if let Some(variables) = variables.as_mut().filter(|variables| variables.table == table)
                && let Some(index) =
                    variables.names.iter().position(|known| *name.as_bytes() == *known.as_bytes())
            {
                variables.set(index, value);
            }
            Ok(stored)
        })?,
    )?;
    let owner = Rc::clone(library);
    host.set(
        "refuse_variable",
        lua.create_function(move |_, (table, name): (usize, LuaValue)| -> mlua::Result<()> {
            let name = name.to_string().unwrap_or_default();
            let variables = owner.variables.borrow();
            let names = variables.get(table).map(|variables| variables.names.as_slice()).unwrap_or_default();
            let names: Vec<&str> = names.iter().map(|name| &**name).collect();
            Err(mlua::Error::external(if names.iter().any(|known| *known == name) {
                let message = format!("the variable {name} is known only while its system is derived");
                Error::scope(message).help(
                    "pass the variables to the system: lsystem({ variables = ... }); after derive, read derived.variables",
                )
            } else {
                let known = names.iter().copied();
                Error::not_found("variable", &name, known, format!("unknown variable {name}"))
                    .help(format!("declare it with its first value; there are {}", names.join(", ")))
            }))
        })?,
    )
}

/// Declares variables with their first values, and returns their number.
fn declare(library: &Library, initial: LuaValue) -> Result<usize> {
    library.at_top_level("variables")?;
    let usage = "write variables({ time = 0, flowers = 0 })";
    let LuaValue::Table(initial) = initial else {
        let message = format!("variables takes a table of names and values, not a {}", type_of(&initial));
        return Err(Error::argument(message).help(usage));
    };
    let Value::Table(initial) = to_value(&LuaValue::Table(initial), false)? else {
        return Err(Error::argument("variables takes a table of names and values").help(usage));
    };
    let mut declared = VariableTable { names: Vec::new(), initial: Vec::new() };
    for (key, value) in &initial.entries {
        let TableKey::Name(name) = key else {
            return Err(Error::argument("a variable needs a name").help(usage));
        };
        declared.names.push(Arc::clone(name));
        declared.initial.push(assignable(name, value.clone())?);
    }
    let mut variables = library.variables.borrow_mut();
    variables.push(declared);
    Ok(variables.len() - 1)
}

/// Returns a value that a variable can have.
fn assignable(name: &str, value: Value) -> Result<Value> {
    match value {
        Value::Nil => Err(Error::argument(format!("the variable {name} cannot be nil"))
            .help("use false, or a value that means nothing in your model")),
        Value::Number(number) if number.is_nan() => {
            Err(Error::argument(format!("the variable {name} would not be a number"))
                .help("check the calculation, such as a division by 0"))
        }
        value => Ok(value),
    }
}
