//! Texts that scripts print and warnings that they give.

use mlua::{Function, Lua, MultiValue, Value as LuaValue};

use super::Machine;
use super::convert::to_value;
use super::library::Library;
use super::shown_values::shown_value;
use crate::declare::Print;
use burgeon_base::error::{Error, Result};
use burgeon_base::warning::{Warning, WarningKind};

/// Returns the warning that a script gives with `warn`.
pub(super) fn script_warning(text: &LuaValue, help: &LuaValue) -> Result<Warning> {
    let usage = "write warn(\"the town has no streets\", \"try another seed\")";
    let string = |value: &LuaValue, name: &str| match value {
        LuaValue::String(text) => Ok(any_bytes(&text.as_bytes())),
        other => {
            let found = to_value(other, false).map_or("something else", |value| value.describe());
            let message = format!("warn: {name} must be a string, not {found}");
            Err(Error::argument(message).help(usage))
        }
    };
    let warning = Warning::new(WarningKind::Script, string(text, "text")?);
    if help.is_nil() { Ok(warning) } else { Ok(warning.help(string(help, "help")?)) }
}

/// Passes the values that a script prints to `hook`, unless the machine is silent.
pub(super) fn print(lua: &Lua, library: &Library, values: &MultiValue, hook: &Print) -> mlua::Result<()> {
    if lua.app_data_ref::<SilentMark>().is_some() && is_at_top_level(lua) {
        return Ok(());
    }
    // A check derives nothing, so values after a derivation are not those of a run.
    if library.machine().is_ok_and(|machine| machine.has_skipped_derivation()) {
        return Ok(());
    }
    let texts = values.iter().map(|value| shown_value(lua, library, value));
    let texts: Vec<String> = texts.collect::<mlua::Result<_>>()?;
    hook.take(&texts.join("\t"), || Machine::place(lua));
    Ok(())
}

/// Returns bytes as text; invalid UTF-8 is escaped, such as `\xff`.
pub(super) fn any_bytes(bytes: &[u8]) -> String {
    let mut text = String::with_capacity(bytes.len());
    for chunk in bytes.utf8_chunks() {
        text.push_str(chunk.valid());
        chunk.invalid().iter().for_each(|byte| text.push_str(&format!("\\x{byte:02x}")));
    }
    text
}

/// Marks a machine that runs the same script as another machine, so its top level must not print.
pub(crate) struct SilentMark;

/// Function that returns the current phase.
pub(crate) struct PhaseFunction(pub Function);

/// Returns true if the top level of the script runs, and no rule, guard, interpretation or hook.
pub(crate) fn is_at_top_level(lua: &Lua) -> bool {
    lua.app_data_ref::<PhaseFunction>().is_none_or(|phase| phase.0.call::<u8>(()).unwrap_or(0) == 0)
}
