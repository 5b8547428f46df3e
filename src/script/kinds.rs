//! Types of objects as scripts see them: a constructor and a table of methods for each.

use std::sync::Arc;

use mlua::{Function, MultiValue, Table, Value as LuaValue};

use super::convert::to_field;
use super::handles::{ObjectHandle, methods_key};
use super::library::OF_FILES;
use super::machine::Machine;
use super::system::is_unread_geometry;
use crate::error::{Error, Result};
use crate::objects::{Call, Key, Kind, Table as ValueTable, Value};

/// Makes the constructor of a type of object and its table of methods.
pub(super) fn install_kind(machine: &Machine, globals: &Table, kind: &'static Kind) -> mlua::Result<()> {
    let lua = machine.lua();
    let methods = lua.create_table()?;
    for (index, method) in kind.methods.iter().enumerate() {
        let name = format!("{}:{}", kind.name, method.name);
        let function: Function = match &method.call {
            Call::Write { numbers: Some(_), .. } if method.arguments.len() <= 3 => {
                machine.prelude().recorder.call((index, name, method.arguments.len()))?
            }
            Call::Write { .. } => machine.prelude().direct.call((index, name, true))?,
            Call::Read(_) => machine.prelude().direct.call((index, name, false))?,
        };
        methods.raw_set(method.name, function)?;
    }
    let unknown = lua.create_table()?;
    unknown.raw_set(
        "__index",
        lua.create_function(move |_, (_, name): (LuaValue, String)| -> mlua::Result<()> {
            Err(mlua::Error::external(kind.unknown_method(&name)))
        })?,
    )?;
    methods.set_metatable(Some(unknown))?;
    lua.set_named_registry_value(&methods_key(kind.name), &methods)?;
    if OF_FILES.iter().any(|known| known.name == kind.name) {
        return Ok(());
    }
    let library = std::rc::Rc::clone(&machine.library);
    globals.raw_set(
        kind.name,
        lua.create_function(move |_, given: MultiValue| {
            let table = constructor_fields(kind, given).map_err(mlua::Error::external)?;
            // What one feature has in place of a number, another may have right.
            let mut object =
                (kind.construct)(&table).map_err(|error| mlua::Error::external(error.of_data()))?;
            for warning in object.take_warnings() {
                library.machine().map_err(mlua::Error::external)?.warn(warning);
            }
            Ok(ObjectHandle(Arc::from(object)))
        })?,
    )
}

/// The named fields that a constructor takes: a table, before which one of them may stand by itself.
fn constructor_fields(kind: &Kind, given: MultiValue) -> Result<Arc<ValueTable>> {
    let mut given = given.into_iter();
    let one = given.next().unwrap_or(LuaValue::Nil);
    let two = given.next().unwrap_or(LuaValue::Nil);
    let Some(first) = kind.first else { return named_fields(kind.name, one) };
    let alone = match (&one, &two) {
        (LuaValue::Nil, LuaValue::Nil) => true,
        (LuaValue::Table(table), LuaValue::Nil) if !is_unread_geometry(table) => {
            table.pairs::<LuaValue, LuaValue>().flatten().any(|(key, _)| {
                kind.fields.iter().any(|field| matches!(&key, LuaValue::String(key) if *key == field.name))
            })
        }
        _ => false,
    };
    if alone {
        return named_fields(kind.name, one);
    }
    let mut table = ValueTable::clone(&*named_fields(kind.name, two)?);
    if table.get(first).is_some() {
        return Err(Error::argument(format!("{} is given its {first} twice", kind.name)));
    }
    table.entries.push((Key::Name(first.into()), to_field(&one)?));
    Ok(Arc::new(table))
}

/// The one table of named fields that a constructor takes; nothing is an empty one.
pub(super) fn named_fields(what: &str, options: LuaValue) -> Result<Arc<ValueTable>> {
    match to_field(&options)? {
        Value::Nil => Ok(Arc::default()),
        Value::Table(table) => Ok(table),
        _ => Err(no_table(what, &options)),
    }
}

pub(super) fn no_table(what: &str, given: &LuaValue) -> Error {
    Error::argument(format!("{what} takes a table of named fields, not a {}", given.type_name()))
        .help(format!("write {what} {{ name = value }}"))
}
