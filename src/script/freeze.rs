//! Freezes what rules can reach from outside themselves, for as long as they run.

use mlua::{Function, Lua, Table, Value, ffi};
use rustc_hash::FxHashSet;

/// Tables that were writable before; they are so again when this is dropped.
pub(crate) struct Frozen(Vec<Table>);

impl Drop for Frozen {
    fn drop(&mut self) {
        for table in &self.0 {
            table.set_readonly(false);
        }
    }
}

/// Freezes every table that `functions` can reach through their captured variables.
pub(crate) fn freeze<'a>(
    lua: &Lua,
    functions: impl IntoIterator<Item = &'a Function>,
) -> mlua::Result<Frozen> {
    let mut frozen = Frozen(Vec::new());
    let mut seen = FxHashSet::default();
    let mut queue: Vec<Value> =
        functions.into_iter().map(|function| Value::Function(function.clone())).collect();
    while let Some(value) = queue.pop() {
        match value {
            Value::Function(function) => {
                if seen.insert(function.to_pointer() as usize) {
                    queue.extend(captured(lua, &function)?);
                }
            }
            Value::Table(table) => {
                if !seen.insert(table.to_pointer() as usize) {
                    continue;
                }
                if let Some(metatable) = table.metatable() {
                    queue.push(Value::Table(metatable));
                }
                for pair in table.pairs::<Value, Value>() {
                    let (key, value) = pair?;
                    queue.extend(
                        [key, value]
                            .into_iter()
                            .filter(|value| matches!(value, Value::Table(_) | Value::Function(_))),
                    );
                }
                if !table.is_readonly() {
                    table.set_readonly(true);
                    frozen.0.push(table);
                }
            }
            _ => {}
        }
    }
    Ok(frozen)
}

/// The tables and functions that a Lua function captures; none for a function of Rust.
fn captured(lua: &Lua, function: &Function) -> mlua::Result<Vec<Value>> {
    let info = function.info();
    if info.what == "C" || info.source.as_deref() == Some("=burgeon") {
        return Ok(Vec::new());
    }
    let mut values = Vec::new();
    for index in 1..=255 {
        #[allow(unsafe_code, reason = "mlua does not show captured variables")]
        // SAFETY: the function is the one argument on the stack; lua_getupvalue pushes at most one value, which
        // becomes the result, and the stack has room for it.
        let value: Value = unsafe {
            lua.exec_raw(function.clone(), |state| {
                if ffi::lua_getupvalue(state, 1, index).is_null() {
                    ffi::lua_pushlightuserdata(state, std::ptr::null_mut());
                }
                ffi::lua_remove(state, 1);
            })?
        };
        match value {
            Value::LightUserData(data) if data.0.is_null() => break,
            Value::Table(_) | Value::Function(_) => values.push(value),
            _ => {}
        }
    }
    Ok(values)
}
