//! Conversion of values between Lua and Rust.

use std::sync::Arc;

use mlua::{Lua, LuaString, Value as LuaValue};

use super::system::{SourceHandle, SystemHandle, feature_of};
use super::table_classes::{made_of_class, metatable_of};
use super::types::{DerivedHandle, ObjectHandle};
use burgeon_base::error::{Error, Limit, Result};
use burgeon_base::{MemoryOwner, Stop};
use burgeon_kit::{BufferBytes, System, Table, TableKey, Value};

/// Metatable field with the name of a table class. Tables of a class keep their operators as parameters.
const CLASS: &str = "__class";
const DEEPEST: usize = 64;
/// Length (bytes) from which a string is copied only if the run has enough memory.
const LONG: usize = 64 << 10;
/// Number of copied table entries between two checks for cancellation.
const STRETCH: usize = 4096;

/// Conversion mode.
#[derive(Clone, Copy, PartialEq, Eq)]
enum CopyMode {
    /// Without changes.
    Plain,
    /// Makes tables read-only.
    Freeze,
    /// Allows systems and sources.
    Field,
    /// Copies buffers too, for methods that read them immediately.
    Argument,
}

/// Converts a Lua value to Rust. If `freeze` is set, tables are made read-only.
pub(crate) fn to_value(value: &LuaValue, freeze: bool) -> Result<Value> {
    convert(value, if freeze { CopyMode::Freeze } else { CopyMode::Plain }, 0)
}

/// Converts the argument of a constructor to Rust. It can contain systems, and sources as
/// [`Features`](burgeon_kit::Features).
pub(crate) fn to_field(value: &LuaValue) -> Result<Value> {
    convert(value, CopyMode::Field, 0)
}

/// Converts the argument of a method to Rust. It can contain buffers as [`BufferBytes`].
pub(crate) fn to_argument(value: &LuaValue) -> Result<Value> {
    convert(value, CopyMode::Argument, 0)
}

fn convert(value: &LuaValue, manner: CopyMode, depth: usize) -> Result<Value> {
    Ok(match value {
        LuaValue::Nil => Value::Nil,
        LuaValue::Boolean(value) => Value::Boolean(*value),
        #[allow(clippy::cast_precision_loss, reason = "Luau's own numbers are f64")]
        LuaValue::Integer(value) => Value::Number(*value as f64),
        LuaValue::Number(value) => Value::Number(*value),
        LuaValue::String(text) => Value::Text(owned(text)?),
        LuaValue::Table(table) => {
            if depth > DEEPEST {
                return Err(Error::limit(
                    Limit::Size,
                    format!("a table is nested more than {DEEPEST} deep, or contains itself"),
                ));
            }
            let metatable = table.metatable();
            if let Some((geometry, mut entries)) = metatable.as_ref().and_then(|it| feature_of(table, it)) {
                entries.push((TableKey::Name("geometry".into()), Value::Object(geometry)));
                entries.sort_by(|a, b| a.0.cmp(&b.0));
                return Ok(Value::Table(Arc::new(Table { class: None, entries })));
            }
            let mut entries = Vec::new();
            for pair in table.pairs::<LuaValue, LuaValue>() {
                let (key, value) = pair.map_err(|error| Error::internal(error.to_string()))?;
                let key = match key {
                    LuaValue::Integer(index) => TableKey::Index(index),
                    #[allow(clippy::cast_possible_truncation, reason = "whole numbers that fit are kept")]
                    LuaValue::Number(number) if number.fract() == 0.0 && number.abs() < 9e15 => {
                        TableKey::Index(number as i64)
                    }
                    LuaValue::String(name) => TableKey::Name(owned(&name)?),
                    other => {
                        return Err(Error::argument(format!("a table has a {} as a key", type_of(&other)))
                            .help("use names or integers as keys"));
                    }
                };
                entries.push((key, convert(&value, manner, depth + 1)?));
                if entries.len().is_multiple_of(STRETCH) {
                    Stop::check_current()?;
                }
            }
            entries.sort_by(|a, b| a.0.cmp(&b.0));
            let class = match metatable {
                Some(metatable)
                    if metatable.raw_get::<Option<String>>("__type").ok().flatten().as_deref()
                        == Some("module") =>
                {
                    return Err(no_module());
                }
                Some(metatable) => match metatable.raw_get::<Option<String>>(CLASS) {
                    Ok(Some(class)) => Some(class.into()),
                    _ => return Err(Error::argument("a table with a metatable cannot be passed on")),
                },
                None => None,
            };
            if manner == CopyMode::Freeze {
                table.set_readonly(true);
            }
            Value::Table(Arc::new(Table { class, entries }))
        }
        LuaValue::UserData(data) => {
            if let Ok(handle) = data.borrow::<ObjectHandle>() {
                Value::Object(Arc::clone(&handle.0))
            } else if let Ok(handle) = data.borrow::<DerivedHandle>() {
                Value::Object(handle.model()?)
            } else if let (Ok(source), false) = (data.borrow::<SourceHandle>(), manner == CopyMode::Freeze) {
                source.value()?
            } else if let (Ok(system), CopyMode::Field) = (data.borrow::<SystemHandle>(), manner) {
                Value::Object(Arc::new(System { index: system.give() }))
            } else if data.is::<SystemHandle>() {
                return Err(Error::argument("a system cannot be passed on")
                    .help("derive it, and pass the derived system: local model = s:derive()"));
            } else {
                return Err(Error::argument("this object cannot be passed on")
                    .help("pass numbers, booleans, strings, tables of these, or objects"));
            }
        }
        LuaValue::Vector(_) => return Err(no_module()),
        LuaValue::Buffer(buffer) if manner == CopyMode::Argument => {
            MemoryOwner::ensure_room(2 * buffer.len())?;
            Value::Object(Arc::new(BufferBytes(buffer.to_vec().into())))
        }
        other => {
            let help = match other {
                LuaValue::Function(_) => {
                    "call it with parentheses: f(x); values are numbers, booleans, strings, tables of these, and objects"
                }
                _ => "pass numbers, booleans, strings, tables of these, or objects",
            };
            return Err(Error::argument(format!("a {} cannot be passed on", type_of(other))).help(help));
        }
    })
}

fn owned(text: &LuaString) -> Result<Arc<str>> {
    let bytes = text.as_bytes();
    if bytes.len() > LONG {
        MemoryOwner::ensure_room(2 * bytes.len())?;
    }
    Ok(String::from_utf8_lossy(&bytes).into())
}

fn no_module() -> Error {
    Error::argument("a module cannot be passed on")
        .help("pass its parameters, and create the module where the chain needs it")
}

/// Converts a value to Lua. Tables are frozen if `freeze` is set.
pub(crate) fn to_lua(lua: &Lua, value: &Value, freeze: bool) -> mlua::Result<LuaValue> {
    Ok(match value {
        Value::Nil => LuaValue::Nil,
        Value::Boolean(value) => LuaValue::Boolean(*value),
        Value::Number(value) => LuaValue::Number(*value),
        Value::Text(text) => LuaValue::String(lua.create_string(text.as_bytes())?),
        Value::Object(object) => {
            let any: &dyn std::any::Any = &**object;
            match any.downcast_ref::<BufferBytes>() {
                Some(bytes) => LuaValue::Buffer(lua.create_buffer(&bytes.0)?),
                None => LuaValue::UserData(lua.create_userdata(ObjectHandle(Arc::clone(object)))?),
            }
        }
        Value::Table(table) => {
            let made = match made_of_class(lua, table, freeze)? {
                Some(made) => made,
                None => {
                    let made = lua.create_table_with_capacity(0, table.entries.len())?;
                    for (key, value) in &table.entries {
                        let value = to_lua(lua, value, freeze)?;
                        match key {
                            TableKey::Index(index) => made.raw_set(*index, value)?,
                            TableKey::Name(name) => made.raw_set(&**name, value)?,
                        }
                    }
                    if let Some(class) = &table.class {
                        made.set_metatable(metatable_of(lua, class))?;
                    }
                    made
                }
            };
            if freeze {
                made.set_readonly(true);
            }
            LuaValue::Table(made)
        }
    })
}

/// Returns the name of the type of a value, as scripts know it: all numbers have one type.
pub(super) fn type_of(value: &LuaValue) -> &'static str {
    if value.is_integer() { "number" } else { value.type_name() }
}
