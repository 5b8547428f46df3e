//! Rust functions for named random streams, and for the number of the step.

use std::rc::Rc;

use mlua::{AnyUserData, Buffer, Lua, MultiValue, Table, Value as LuaValue};

use super::current::WorkState;
use burgeon_base::random::Stream;
use burgeon_rewriting::{KeyPart, ModuleKey};

/// Number of random numbers in the buffer of a stream, behind its key.
const NUMBERS: usize = 8;

/// Maximum number of keys, including the name.
const MOST_KEYS: usize = 32;

/// Maximum length of a text as a key (bytes).
const LONGEST: usize = 1000;

/// Random numbers behind those in the buffer.
struct Rest(Stream);

impl mlua::UserData for Rest {}

/// Adds the functions for named streams and for the number of the step.
pub(super) fn add_streams(lua: &Lua, host: &Table, current: &Rc<WorkState>) -> mlua::Result<()> {
    let state = Rc::clone(current);
    host.set(
        "stream",
        lua.create_function(move |_, (numbers, application, keys): (Buffer, Option<usize>, MultiValue)| {
            let key = state.key(application).map_err(mlua::Error::external)?;
            let key = match stream_key(key, &keys) {
                Ok(key) => key,
                Err(unusable) => return Ok(Some(unusable)),
            };
            numbers.write_bytes(0, &key.0.to_le_bytes());
            write_numbers(&numbers, &mut key.stream());
            Ok(None)
        })?,
    )?;
    host.set(
        "more_numbers",
        lua.create_function(|lua, (rest, numbers): (Option<AnyUserData>, Buffer)| {
            let rest = match rest {
                Some(rest) => rest,
                None => {
                    let key = ModuleKey(u64::from_le_bytes(numbers.read_bytes(0)));
                    let mut stream = key.stream();
                    for _ in 0..NUMBERS {
                        stream.uniform();
                    }
                    lua.create_userdata(Rest(stream))?
                }
            };
            write_numbers(&numbers, &mut rest.borrow_mut::<Rest>()?.0);
            Ok(rest)
        })?,
    )?;
    let state = Rc::clone(current);
    host.set("step", lua.create_function(move |_, ()| state.read_step().map_err(mlua::Error::external))?)?;
    let state = Rc::clone(current);
    let time = move |_: &Lua, application: usize| state.time_of(application).map_err(mlua::Error::external);
    host.set("time", lua.create_function(time)?)?;
    Ok(())
}

/// Returns the key of a named stream of `key`, or the index of the first part that cannot be a key, from 1.
fn stream_key(key: ModuleKey, parts: &MultiValue) -> Result<ModuleKey, usize> {
    let first = parts.front().and_then(LuaValue::as_string);
    if first.is_none_or(|name| name.as_bytes().is_empty()) {
        return Err(1);
    }
    (1..).zip(parts).try_fold(key, |key, (index, part)| {
        let part = match part {
            _ if index > MOST_KEYS => None,
            #[allow(clippy::cast_precision_loss, reason = "Luau's integers are exact in an f64")]
            LuaValue::Integer(number) => Some(key.substream(KeyPart::Number(*number as f64))),
            LuaValue::Number(number) if number.is_finite() => Some(key.substream(KeyPart::Number(*number))),
            LuaValue::Boolean(value) => Some(key.substream(KeyPart::Boolean(*value))),
            LuaValue::String(text) if text.as_bytes().len() <= LONGEST => {
                Some(key.substream(KeyPart::Text(&text.as_bytes())))
            }
            _ => None,
        };
        part.ok_or(index)
    })
}

/// Writes the next numbers of a stream into its buffer.
fn write_numbers(buffer: &Buffer, stream: &mut Stream) {
    for place in 1..=NUMBERS {
        buffer.write_bytes(place * 8, &stream.uniform().to_le_bytes());
    }
}
