//! Rust functions for the prelude.

use std::rc::Rc;
use std::sync::Arc;

use mlua::{Buffer, Lua, LuaString, MultiValue, Table, Value as LuaValue, Variadic};

use super::current::WorkState;
use super::freeze::freeze_function;
use super::native;
use super::object_methods::{add_object_methods, values};
use crate::machine::convert::{to_lua, to_value};
use crate::machine::library::Library;
use crate::machine::types::{ObjectHandle, claim};
use crate::machine::write_column;
use burgeon_base::error::{Error, Limit, Result, SourcePlace};
use burgeon_kit::declare::as_ref;
use burgeon_kit::{Draw, ScriptObject, Value};
use burgeon_rewriting::{CLOSE, ColumnValue, DEEPEST, OPEN, Symbol, module_brief, module_text};

/// Phase of the prelude at the top level.
const TOP: u8 = 0;

/// Slot of a child object, method number, application, and arguments.
type HostCall = (Option<usize>, usize, usize, MultiValue);

pub(crate) fn functions(lua: &Lua, current: &Rc<WorkState>, library: &Rc<Library>) -> mlua::Result<Table> {
    let host = lua.create_table()?;
    host.set("deepest", DEEPEST)?;
    add_values(lua, &host, current, library)?;
    add_tables(lua, &host)?;
    add_applications(lua, &host, current)?;
    add_returned_modules(lua, &host, current, library)?;
    add_methods(lua, &host, current, library)?;
    add_script_objects(lua, &host, current, library)?;
    super::streams::add_streams(lua, &host, current)?;
    super::row_tables::add_queries(lua, &host, current, library)?;
    super::hooks::add_hooks(lua, &host, current)?;
    super::batch_loops::add_batch_loops(lua, &host)?;
    super::variables::add_variables(lua, &host, current, library)?;
    Ok(host)
}

/// Adds the functions that pack values into columns and unpack them.
fn add_values(lua: &Lua, host: &Table, current: &Rc<WorkState>, library: &Rc<Library>) -> mlua::Result<()> {
    let state = Rc::clone(current);
    host.set(
        "pack",
        lua.create_function(move |_, value: LuaValue| {
            let value = to_value(&value, true).map_err(mlua::Error::external)?;
            match ColumnValue::unpack(state.session.values.pack(value)) {
                ColumnValue::Handle(handle) => Ok(handle),
                _ => Err(mlua::Error::external(Error::argument("this value cannot be a parameter"))),
            }
        })?,
    )?;
    let state = Rc::clone(current);
    host.set(
        "unpack",
        lua.create_function(move |lua, handle: u32| {
            state.unpacked.set(state.unpacked.get() + 1);
            to_lua(lua, &state.session.values.get(handle).unwrap_or(Value::Nil), true)
        })?,
    )?;
    let (state, owner) = (Rc::clone(current), Rc::clone(library));
    host.set(
        "shape",
        lua.create_function(move |_, (number, symbols): (usize, Vec<u16>)| {
            state.add_shape(number, symbols, &owner.symbols.borrow().arities());
            Ok(())
        })?,
    )?;
    let (state, owner) = (Rc::clone(current), Rc::clone(library));
    host.set(
        "module_text",
        lua.create_function(move |_, module: Table| {
            let symbol: u16 = module.raw_get(1)?;
            let given: usize = module.raw_get(2)?;
            let mut params = Vec::new();
            for index in 0..given {
                let value = to_value(&module.raw_get::<LuaValue>(index + 3)?, false)
                    .map_err(mlua::Error::external)?;
                params.push(state.session.values.pack(value));
            }
            Ok(module_text(&owner.symbols.borrow(), &state.session.values, symbol, &params).into_owned())
        })?,
    )?;
    Ok(())
}

/// Adds the functions for Lua functions, tables and errors.
fn add_tables(lua: &Lua, host: &Table) -> mlua::Result<()> {
    host.set(
        "native",
        lua.create_function(|lua, function: mlua::Function| {
            native(lua, &function)?;
            Ok(function)
        })?,
    )?;
    host.set("freeze", freeze_function(lua)?)?;
    host.set(
        "told",
        lua.create_function(|lua, value: LuaValue| match value {
            LuaValue::Error(error) => {
                let error = super::translation::translate(&error);
                let place = error.place().map_or_else(String::new, |place| format!("{place}: "));
                Ok(LuaValue::String(lua.create_string(format!("{place}{}", error.message()))?))
            }
            other => Ok(other),
        })?,
    )?;
    host.set(
        "told_at",
        lua.create_function(|_, (cause, file, line): (LuaValue, String, usize)| {
            let error = match &cause {
                LuaValue::Error(error) => super::translation::translate(error),
                LuaValue::String(text) => {
                    let text = mlua::Error::RuntimeError(text.to_string_lossy());
                    super::translation::translate(&text)
                }
                other => return Ok(other.clone()),
            };
            let error = error.rather_at(Some(SourcePlace { file, line }));
            Ok(LuaValue::Error(Box::new(mlua::Error::external(error))))
        })?,
    )?;
    Ok(())
}

/// Adds the functions that rules and interpretations call while they run.
fn add_applications(lua: &Lua, host: &Table, current: &Rc<WorkState>) -> mlua::Result<()> {
    let state = Rc::clone(current);
    host.set(
        "check_growth",
        lua.create_function(move |_, modules: usize| {
            let limit = state.session.options.limits.modules;
            if modules > limit {
                return Err(mlua::Error::external(
                    Error::limit(
                        Limit::Modules,
                        format!("one application of a rule returned more than {limit} modules"),
                    )
                    .help("look for an endless loop, or raise the limit: --module-limit N"),
                ));
            }
            Ok(())
        })?,
    )?;
    let state = Rc::clone(current);
    host.set(
        "random",
        lua.create_function(move |_, (phase, application, drawn): (u8, usize, usize)| match phase {
            TOP => Ok(state.top.borrow_mut().uniform()),
            _ => state.draw(application, drawn).map_err(mlua::Error::external),
        })?,
    )?;
    let state = Rc::clone(current);
    host.set(
        "flush",
        lua.create_function(move |_, (entry, called): (usize, usize)| {
            match state.flusher.borrow_mut().as_mut() {
                Some(flusher) => flusher.flush(entry, called).map_err(mlua::Error::external),
                None => Ok(()),
            }
        })?,
    )?;
    let state = Rc::clone(current);
    host.set(
        "report",
        lua.create_function(move |_, (entry, name, value): (usize, LuaString, f64)| {
            // A loop of reports can fill the memory.
            state.session.stop.check().map_err(mlua::Error::external)?;
            let name = name.to_str().map_err(|_| {
                mlua::Error::external(
                    Error::argument("the name of a report is not text").help("write it in UTF-8"),
                )
            })?;
            match state.flusher.borrow_mut().as_mut() {
                Some(flusher) => flusher.report(entry, &name, value).map_err(mlua::Error::external),
                None => Ok(()),
            }
        })?,
    )?;
    let state = Rc::clone(current);
    host.set(
        "lost",
        lua.create_function(move |_, (entry, value): (usize, String)| {
            if let Some(flusher) = state.flusher.borrow_mut().as_mut() {
                flusher.lost(entry, &value);
            }
            Ok(())
        })?,
    )
}

/// Adds the functions for modules that interpretations return.
fn add_returned_modules(
    lua: &Lua,
    host: &Table,
    current: &Rc<WorkState>,
    library: &Rc<Library>,
) -> mlua::Result<()> {
    host.set("open", OPEN)?;
    host.set("close", CLOSE)?;
    let (state, owner) = (Rc::clone(current), Rc::clone(library));
    host.set(
        "add_successor_key",
        lua.create_function(move |_, (parent, symbol, ordinal): (usize, Symbol, usize)| {
            let name = owner.symbols.borrow().name_hash(symbol);
            state.add_successor_key(parent, name, ordinal).map_err(mlua::Error::external)
        })?,
    )?;
    let state = Rc::clone(current);
    host.set(
        "context",
        lua.create_function(move |_, (entry, rule, into): (usize, u16, Buffer)| {
            let flusher = state.flusher.borrow();
            let Some(params) = flusher.as_ref().and_then(|flusher| flusher.context(entry, rule)) else {
                return Ok(false);
            };
            write_column(into, &params).map_err(mlua::Error::external)?;
            Ok(true)
        })?,
    )?;
    let state = Rc::clone(current);
    host.set(
        "undrawn",
        lua.create_function(move |_, (entry, symbol): (usize, u16)| {
            if let Some(flusher) = state.flusher.borrow_mut().as_mut() {
                flusher.note_undrawn(entry, symbol);
            }
            Ok(())
        })?,
    )?;
    let (state, owner) = (Rc::clone(current), Rc::clone(library));
    host.set(
        "too_deep",
        lua.create_function(
            move |_, (entry, rule, symbol, depth, params): (usize, u16, u16, usize, Variadic<LuaValue>)| {
                let pack = |value: &LuaValue| Ok(state.session.values.pack(to_value(value, false)?));
                let params: Vec<f64> =
                    params.iter().map(pack).collect::<Result<_>>().map_err(mlua::Error::external)?;
                let module = module_brief(&owner.symbols.borrow(), &*state.session.values, symbol, &params);
                if let Some(flusher) = state.flusher.borrow_mut().as_mut() {
                    flusher.note_depth(entry, rule, &module, depth);
                }
                Ok(())
            },
        )?,
    )
}

/// Adds the functions that call methods of objects.
fn add_methods(lua: &Lua, host: &Table, current: &Rc<WorkState>, library: &Rc<Library>) -> mlua::Result<()> {
    let state = Rc::clone(current);
    host.set(
        "call",
        lua.create_function(move |lua, (slot, method, application, arguments): HostCall| {
            let arguments = values(lua, &arguments)?;
            let answer = state
                .call(slot, method, application, &arguments, || super::Machine::place(lua))
                .map_err(mlua::Error::external)?;
            to_lua(lua, &answer, false)
        })?,
    )?;
    add_object_methods(lua, host, current, library)
}

/// Adds the functions that read and store the fields and state of script-declared objects.
fn add_script_objects(
    lua: &Lua,
    host: &Table,
    current: &Rc<WorkState>,
    library: &Rc<Library>,
) -> mlua::Result<()> {
    let owner = Rc::clone(library);
    host.set(
        "type_name",
        lua.create_function(move |_, constructor: LuaValue| {
            let LuaValue::Function(constructor) = constructor else { return Ok(None) };
            Ok(owner.kind_of(&constructor).map(|kind| kind.name.to_string()))
        })?,
    )?;
    let owner = Rc::clone(library);
    host.set(
        "claim",
        lua.create_function(move |lua, (kind, name, owners): (String, String, Vec<String>)| {
            claim(&owner, lua, &kind, &name, owners).map_err(mlua::Error::external)
        })?,
    )?;
    let state = Rc::clone(current);
    host.set("chain_of", lua.create_function(move |_, application: usize| Ok(state.chain_of(application)))?)?;
    let state = Rc::clone(current);
    host.set("flushed_chain", lua.create_function(move |_, ()| Ok(state.chain_of(0)))?)?;
    let state = Rc::clone(current);
    host.set(
        "fields",
        lua.create_function(move |lua, (chain, slot): (usize, Option<usize>)| {
            let fields = state.script_object(chain, slot, |object| Ok(Arc::clone(object.fields())));
            to_lua(lua, &Value::Table(fields.map_err(mlua::Error::external)?), true)
        })?,
    )?;
    let state = Rc::clone(current);
    host.set(
        "state",
        lua.create_function(move |lua, (chain, slot): (usize, Option<usize>)| {
            let kept = state.script_object(chain, slot, |object| Ok(Arc::clone(object.state())));
            let kept = kept.map_err(mlua::Error::external)?;
            to_table(lua, &kept)
        })?,
    )?;
    let state = Rc::clone(current);
    host.set(
        "keep_state",
        lua.create_function(move |_, (chain, slot, kept): (usize, Option<usize>, Table)| {
            let mut entries = Vec::new();
            for pair in kept.pairs::<String, LuaValue>() {
                let (name, value) = pair?;
                let value = to_value(&value, false).map_err(|error| {
                    mlua::Error::external(
                        Error::argument(format!("{name} of the state has an unsupported value: {}", error.message()))
                            .help("a state variable is a number, a boolean, a string, a table of these, or an object"),
                    )
                })?;
                entries.push((burgeon_kit::TableKey::Name(name.into()), value));
            }
            entries.sort_by(|a, b| a.0.cmp(&b.0));
            let kept = Arc::new(burgeon_kit::Table { class: None, entries });
            state.keep_state(chain, slot, kept).map_err(mlua::Error::external)
        })?,
    )?;
    host.set(
        "drawing_type",
        lua.create_function(|_, value: LuaValue| {
            let LuaValue::UserData(data) = &value else { return Ok(None) };
            let Ok(handle) = data.borrow::<ObjectHandle>() else { return Ok(None) };
            Ok(handle.0.kind().has_capability::<dyn Draw>().then(|| handle.0.kind().name.to_string()))
        })?,
    )?;
    host.set("is_object", lua.create_function(|_, value: LuaValue| Ok(to_value(&value, false).is_ok()))?)?;
    let (state, owner) = (Rc::clone(current), Rc::clone(library));
    host.set(
        "unknown_member",
        lua.create_function(move |_, (kind, name): (String, LuaValue)| -> mlua::Result<()> {
            let name = name.to_string().unwrap_or_default();
            Err(mlua::Error::external(state.unknown_member(&kind, &name, &owner.registry.borrow())))
        })?,
    )?;
    host.set(
        "parts",
        lua.create_function(|lua, handle: mlua::UserDataRef<ObjectHandle>| {
            let Some(object) = as_ref::<ScriptObject>(&*handle.0) else {
                return Err(mlua::Error::external(Error::argument("this object belongs to another type")));
            };
            let state = to_table(lua, object.state())?;
            for (name, held) in object.held_directly() {
                state.raw_set(&**name, lua.create_userdata(ObjectHandle(Arc::from(held.boxed())))?)?;
            }
            let fields = to_lua(lua, &Value::Table(Arc::clone(object.fields())), true)?;
            Ok((state, fields, handle.0.kind().name.to_string()))
        })?,
    )
}

/// Converts a stored table to a Lua table whose nested tables are frozen.
fn to_table(lua: &Lua, kept: &burgeon_kit::Table) -> mlua::Result<Table> {
    let table = lua.create_table()?;
    for (key, value) in &kept.entries {
        if let burgeon_kit::TableKey::Name(name) = key {
            table.raw_set(&**name, to_lua(lua, value, true)?)?;
        }
    }
    Ok(table)
}
