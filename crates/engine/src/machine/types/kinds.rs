//! Object types in scripts: a constructor and a table of methods for each type.

use std::sync::{Arc, LazyLock};

use mlua::{Function, MultiValue, Table, Value as LuaValue};

use super::handles::{ObjectHandle, methods_key};
use crate::machine::convert::to_field;
use crate::machine::{Machine, compile};
use burgeon_base::error::{Error, Result};
use burgeon_kit::{
    Call, Construct, Deprecation, Environment, Kind, Loader, Table as ValueTable, TableKey, Value,
};

/// Installs the constructor and the method table of an object type.
pub(in crate::machine) fn install_kind(
    machine: &Machine,
    globals: &Table,
    kind: &Arc<Kind>,
) -> mlua::Result<()> {
    let methods = install_methods(machine, kind)?;
    let unknown = machine.lua().create_table()?;
    let of = Arc::clone(kind);
    unknown.raw_set(
        "__index",
        machine.lua().create_function(move |_, (_, name): (LuaValue, String)| -> mlua::Result<()> {
            Err(mlua::Error::external(of.unknown_method(&name)))
        })?,
    )?;
    methods.set_metatable(Some(unknown))?;
    match constructor(machine, kind)? {
        Some(constructor) => globals.raw_set(&*kind.name, constructor),
        None => Ok(()),
    }
}

/// Creates the table of the methods that run in Rust.
pub(in crate::machine) fn install_methods(machine: &Machine, kind: &Arc<Kind>) -> mlua::Result<Table> {
    let lua = machine.lua();
    let methods = lua.create_table()?;
    let is_environment = kind.has_capability::<dyn Environment>();
    for (index, method) in kind.methods.iter().enumerate() {
        let name = format!("{}:{}", kind.name, method.name);
        let function: Function = match &method.call {
            Call::Script { .. } => continue,
            Call::Write { numbers: Some(_), .. } if method.arguments.len() <= 3 && !is_environment => {
                machine.prelude().recorder.call((index, name, method.arguments.len(), &*kind.name))?
            }
            Call::Write { .. } | Call::Read(_) => machine.prelude().direct.call((
                index,
                name,
                method.call.changes(),
                &*kind.name,
                is_environment,
                method.arguments.len(),
            ))?,
        };
        let function = match kind.deprecation(&method.name) {
            None => function,
            Some(deprecation) => {
                telling(machine, &format!("{}:{}", kind.name, method.name), deprecation, function)?
            }
        };
        methods.raw_set(&*method.name, function)?;
    }
    lua.set_named_registry_value(&methods_key(&kind.name), &methods)?;
    Ok(methods)
}

/// Creates the constructor of a type, if scripts can make its objects.
pub(in crate::machine) fn constructor(machine: &Machine, kind: &Arc<Kind>) -> mlua::Result<Option<Function>> {
    let lua = machine.lua();
    let library = std::rc::Rc::clone(&machine.library);
    let (of, session) = (Arc::clone(kind), Arc::clone(&machine.session));
    let constructor = match &kind.construct {
        Construct::Given => return Ok(None),
        Construct::Fields(_) => {
            let kind = of;
            lua.create_function(move |lua, given: MultiValue| {
                let table = constructor_fields(&kind, given).map_err(mlua::Error::external)?;
                for deprecation in kind.deprecated.iter().filter(|known| table.get(&known.name).is_some()) {
                    let name = format!("{}.{}", kind.name, deprecation.name);
                    session.use_deprecated(&name, deprecation, Machine::place(lua).as_ref());
                }
                let table = session
                    .replace_former_names(&kind.name, &kind.fields, &table, Machine::place(lua).as_ref())
                    .map_err(mlua::Error::external)?;
                // A faulty value of one feature may be correct in another.
                let mut object = kind.make(&table).map_err(|error| mlua::Error::external(error.of_data()))?;
                for warning in object.take_warnings() {
                    library.machine().map_err(mlua::Error::external)?.warn_of_values(warning);
                }
                Ok(ObjectHandle(Arc::from(object)))
            })?
        }
        Construct::File(loader) => {
            let (kind, loader) = (of, loader.clone());
            lua.create_function(move |lua, (files, fields): (LuaValue, LuaValue)| {
                let load = || {
                    library.at_top_level(&kind.name)?;
                    let names = file_names(&kind, &loader, files)?;
                    let fields = match to_field(&fields)? {
                        Value::Nil => Arc::default(),
                        Value::Table(fields) => fields,
                        other => {
                            let (name, what) = (&kind.name, other.describe());
                            return Err(Error::argument(format!(
                                "{name} takes a table of options, not {what}"
                            ))
                            .help(format!("write {}", loader.example_with_fields)));
                        }
                    };
                    if kind.fields.is_empty() && !fields.entries.is_empty() {
                        return Err(Error::argument(format!("{} does not accept options", kind.name))
                            .help(format!("write {}", loader.example)));
                    }
                    let asker = Machine::asker(lua, &session);
                    let loaded =
                        session.data.object(&session, asker, (&kind.name, &loader), &names, &fields)?;
                    let machine = library.machine()?;
                    loaded.warnings.into_iter().for_each(|warning| machine.warn_of_values(warning));
                    Ok(ObjectHandle(loaded.object))
                };
                load().map_err(mlua::Error::external)
            })?
        }
    };
    machine.library.note_constructor(&constructor, kind);
    Ok(Some(constructor))
}

/// Returns the file names in the argument of a constructor: one, or a list of several.
fn file_names(kind: &Kind, loader: &Loader, files: LuaValue) -> Result<Vec<String>> {
    let list = match files {
        LuaValue::String(name) => return Ok(vec![name.to_string_lossy()]),
        LuaValue::Table(list) if !loader.several.is_empty() => list,
        _ => return Ok(vec![String::new()]),
    };
    let names = list.sequence_values::<LuaValue>().map(|name| match name {
        Ok(LuaValue::String(name)) => Some(name.to_string_lossy()),
        _ => None,
    });
    names.collect::<Option<Vec<_>>>().filter(|names| !names.is_empty()).ok_or_else(|| {
        Error::argument(format!("{} needs a file name, or a list of file names", kind.name))
            .help(format!("write {}", loader.example))
    })
}

/// Wraps `method` in a function that also reports the use of a deprecated name.
fn telling(
    machine: &Machine,
    name: &str,
    deprecation: &Deprecation,
    method: Function,
) -> mlua::Result<Function> {
    let (session, name, deprecation) = (Arc::clone(&machine.session), name.to_owned(), deprecation.clone());
    let tell = machine.lua().create_function(move |lua, ()| {
        session.use_deprecated(&name, &deprecation, Machine::place(lua).as_ref());
        Ok(())
    })?;
    static COMPILED: LazyLock<Vec<u8>> = LazyLock::new(|| {
        compile("local tell, method = ...\nreturn function(...)\n  tell()\n  return method(...)\nend")
    });
    let wrap = machine.load_compiled(&COMPILED).map_err(mlua::Error::external)?;
    wrap.call((tell, method))
}

/// Returns the named fields from the arguments of a constructor: a table, optionally preceded by the value of
/// the first field.
fn constructor_fields(kind: &Kind, given: MultiValue) -> Result<Arc<ValueTable>> {
    let mut given = given.into_iter();
    let one = given.next().unwrap_or(LuaValue::Nil);
    let two = given.next().unwrap_or(LuaValue::Nil);
    let Some(first) = kind.first.as_deref() else { return named_fields(&kind.name, one) };
    let alone = match (&one, &two) {
        (LuaValue::Nil, LuaValue::Nil) => true,
        (LuaValue::Table(table), LuaValue::Nil) => {
            table.pairs::<LuaValue, LuaValue>().flatten().any(|(key, _)| {
                matches!(&key, LuaValue::String(key) if kind.fields.iter().any(|it| it.is_called(&key.to_string_lossy())))
            })
        }
        _ => false,
    };
    if alone {
        return named_fields(&kind.name, one);
    }
    let mut table = ValueTable::clone(&*named_fields(&kind.name, two)?);
    if table.get(first).is_some() {
        return Err(Error::argument(format!("{}: `{first}` was set twice", kind.name)));
    }
    table.entries.push((TableKey::Name(first.into()), to_field(&one)?));
    Ok(Arc::new(table))
}

/// Converts an argument to a table of named fields; nil is an empty table.
pub(in crate::machine) fn named_fields(what: &str, options: LuaValue) -> Result<Arc<ValueTable>> {
    match to_field(&options)? {
        Value::Nil => Ok(Arc::default()),
        Value::Table(table) => Ok(table),
        _ => Err(no_table(what, &options)),
    }
}

pub(in crate::machine) fn no_table(what: &str, given: &LuaValue) -> Error {
    let value = to_field(given);
    let shown = match &value {
        Ok(Value::Object(object)) => object.kind().with_article(),
        Ok(Value::Number(number)) => format!("the number {number}"),
        _ => format!("a {}", given.type_name()),
    };
    let help = match (what.strip_prefix("param "), &value) {
        (Some(name), _) => format!("write param(\"{name}\", {{ default = 3 }})"),
        (None, Ok(Value::Object(object))) if what == "lsystem" => {
            format!("write lsystem({{ object = {}() }})", object.kind().name)
        }
        _ => format!("write {what}({{ name = value }})"),
    };
    Error::argument(format!("{what} takes a table of named fields, not {shown}")).help(help)
}
