//! Freezes the tables that rules can reach from outside, while the rules run.

use std::borrow::Cow;
use std::ffi::c_int;

use mlua::{Function, Lua, Table, Value, ffi};
use rustc_hash::FxHashSet;

use super::types::DerivedHandle;
use burgeon_base::error::{Error, Result, SourcePlace};

/// Returns a function that makes a table read-only and returns it. `table.freeze` takes twice as long, because it searches the
/// metatable for a lock.
pub(super) fn freeze_function(lua: &Lua) -> mlua::Result<Function> {
    #[allow(unsafe_code, reason = "a function of mlua takes longer than table.freeze")]
    // SAFETY: `make_read_only` follows Luau's protocol for C functions.
    unsafe {
        lua.create_c_function(make_read_only)
    }
}

#[allow(unsafe_code, reason = "called by Luau")]
unsafe extern "C-unwind" fn make_read_only(state: *mut ffi::lua_State) -> c_int {
    // SAFETY: the first argument is read only if it is a table. Returning fewer values than are on the stack is allowed.
    unsafe {
        ffi::lua_settop(state, 1);
        if ffi::lua_type(state, 1) == ffi::LUA_TTABLE {
            ffi::lua_setreadonly(state, 1, 1);
        }
    }
    1
}

/// Function that rules run, with its name and location.
pub(crate) struct ReachableFunction<'a> {
    function: Function,
    name: Cow<'a, str>,
    place: Option<&'a SourcePlace>,
}

impl<'a> ReachableFunction<'a> {
    /// Creates a function that belongs to a rule called `name`.
    pub(crate) fn of_rule(
        function: &Function,
        name: impl Into<Cow<'a, str>>,
        place: Option<&'a SourcePlace>,
    ) -> Self {
        Self { function: function.clone(), name: name.into(), place }
    }
}

/// Frozen tables; they become writable again when this is dropped.
pub(crate) struct TableFreeze(Vec<Table>);

impl Drop for TableFreeze {
    fn drop(&mut self) {
        for table in &self.0 {
            table.set_readonly(false);
        }
    }
}

/// Freezes every table that `functions` can reach through captured variables.
///
/// Fails for values that keep state and cannot be frozen: coroutines, buffers, and C functions outside
/// `stateless`, such as iterators.
pub(crate) fn freeze<'a>(
    lua: &Lua,
    stateless: &FxHashSet<usize>,
    functions: impl IntoIterator<Item = ReachableFunction<'a>>,
) -> Result<TableFreeze> {
    let unexpected = |error: mlua::Error| Error::internal(error.to_string());
    let mut frozen = TableFreeze(Vec::new());
    let mut seen = FxHashSet::default();
    for ReachableFunction { function, name, place } in functions {
        let refuse = |what: &str| {
            Err(Error::scope(format!("the rule uses {what}, which keeps state from one module to the next"))
                .help("create it inside the rule, or keep the state in a parameter of a module")
                .at_place(place)
                .rule(&name))
        };
        let mut queue = vec![Value::Function(function)];
        while let Some(value) = queue.pop() {
            match value {
                Value::Function(function) => {
                    let address = function.to_pointer() as usize;
                    if function.info().what == "C" {
                        if !stateless.contains(&address) {
                            return refuse("an iterator or a coroutine");
                        }
                    } else if seen.insert(address) {
                        queue.extend(captured(lua, &function).map_err(unexpected)?);
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
                        let (key, value) = pair.map_err(unexpected)?;
                        queue.extend([key, value]);
                    }
                    if !table.is_readonly() {
                        table.set_readonly(true);
                        frozen.0.push(table);
                    }
                }
                Value::UserData(data) => {
                    if let Ok(derived) = data.borrow::<DerivedHandle>() {
                        derived.0.note_captured();
                    }
                }
                Value::Thread(_) => return refuse("a coroutine"),
                Value::Buffer(_) => return refuse("a buffer"),
                _ => {}
            }
        }
    }
    Ok(frozen)
}

/// Returns true if `functions` can reach a table for which `is_wanted` holds through captured variables.
pub(crate) fn reaches(
    lua: &Lua,
    functions: Vec<Function>,
    is_wanted: impl Fn(&Table) -> bool,
) -> mlua::Result<bool> {
    let mut seen = FxHashSet::default();
    let mut queue: Vec<Value> = functions.into_iter().map(Value::Function).collect();
    while let Some(value) = queue.pop() {
        match value {
            Value::Function(function)
                if function.info().what != "C" && seen.insert(function.to_pointer() as usize) =>
            {
                queue.extend(captured(lua, &function)?);
            }
            Value::Table(table) if seen.insert(table.to_pointer() as usize) => {
                if is_wanted(&table) {
                    return Ok(true);
                }
                queue.extend(table.metatable().map(Value::Table));
                for pair in table.pairs::<Value, Value>() {
                    let (key, value) = pair?;
                    queue.extend([key, value]);
                }
            }
            _ => {}
        }
    }
    Ok(false)
}

/// Returns the values that a Lua function captures; empty for the machine's own functions.
pub(crate) fn captured(lua: &Lua, function: &Function) -> mlua::Result<Vec<Value>> {
    if function.info().source.as_deref() == Some("=burgeon") {
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
            value => values.push(value),
        }
    }
    Ok(values)
}
