//! Protected calls of script functions, which record the line where memory ran out. Such an error has no
//! location, and the stack is gone once the call has failed.

use std::cell::RefCell;
use std::ffi::{CStr, c_int};

use mlua::{Lua, ffi};

use super::Machine;
use super::translation::OUT_OF_MEMORY_IN_LUA;
use burgeon_base::error::SourcePlace;

/// Minimum remaining memory (bytes) that is assumed when deciding on a collection: smaller heap growth is not
/// worth one.
const SCARCE: usize = 2 << 20;

thread_local! {
    /// Location where memory ran out last.
    static EXHAUSTED: RefCell<Option<SourcePlace>> = const { RefCell::new(None) };
}

/// Takes the location where memory ran out, if there is a new one.
pub(super) fn exhausted() -> Option<SourcePlace> {
    EXHAUSTED.take()
}

impl Machine {
    /// Calls a function that runs code of the script.
    pub(crate) fn call<R: mlua::FromLuaMulti>(
        &self,
        function: &mlua::Function,
        arguments: impl mlua::IntoLuaMulti,
    ) -> mlua::Result<R> {
        self.limit_memory();
        self.protected.call((function, arguments))
    }

    /// Limits the memory of the machine to its used memory plus the remaining memory of the run.
    fn limit_memory(&self) {
        let Some(memory) = self.session.stop.memory() else { return };
        let mut remaining = memory.remaining();
        // Luau collects garbage when the heap has doubled, which is too late for a heap with most of the
        // memory.
        let is_scarce = remaining < self.session.options.limits.memory / 4;
        if is_scarce && self.lua().used_memory() > self.collected.get() + remaining.max(SCARCE) / 2 {
            // The following call meets the same error.
            let _ = self.lua().gc_collect();
            self.collected.set(self.lua().used_memory());
            remaining = memory.remaining();
        }
        let limit = self.lua().used_memory().saturating_add(remaining);
        // Setting a limit fails only for machines without mlua's allocator.
        let _ = self.lua().set_memory_limit(limit.min(self.session.options.limits.memory).max(1));
    }
}

/// Returns the function for protected calls: it takes a function and its arguments.
pub(super) fn function(lua: &Lua) -> mlua::Result<mlua::Function> {
    #[allow(unsafe_code, reason = "mlua keeps its handler of errors to itself")]
    // SAFETY: `call` follows Luau's protocol for C functions.
    let function = unsafe { lua.create_c_function(call)? };
    // Nested calls reserve stack space for the handler now: once memory has run out, none can be allocated.
    // An error of this text needs no stack trace, which takes a tenth of the time in which a short script runs.
    let mut nested: Vec<mlua::Value> = vec![mlua::Value::Function(function.clone()); DEPTH];
    nested.push(lua.globals().raw_get("error")?);
    nested.push(mlua::Value::String(lua.create_string(OUT_OF_MEMORY_IN_LUA)?));
    function.call::<mlua::MultiValue>(mlua::Variadic::from(nested)).ok();
    Ok(function)
}

/// Depth of nested calls for which a machine reserves stack space.
const DEPTH: usize = 12;

#[allow(unsafe_code, reason = "called by Luau")]
unsafe extern "C-unwind" fn call(state: *mut ffi::lua_State) -> c_int {
    // SAFETY: the function and its arguments are on the stack, and the handler is inserted below them. A C
    // function has room for at least 20 more values.
    unsafe {
        let arguments = ffi::lua_gettop(state) - 1;
        ffi::lua_pushcfunction(state, note);
        ffi::lua_insert(state, 1);
        if ffi::lua_pcall(state, arguments, ffi::LUA_MULTRET, 1) != ffi::LUA_OK {
            ffi::lua_error(state);
        }
        ffi::lua_gettop(state) - 1
    }
}

/// Records the location where memory ran out. To any other error it adds the stack trace, as mlua does.
#[allow(unsafe_code, reason = "called by Luau")]
unsafe extern "C-unwind" fn note(state: *mut ffi::lua_State) -> c_int {
    // SAFETY: the error is the only argument. Strings that Luau points to end with 0 and live as long as the
    // frame.
    unsafe {
        match ffi::lua_type(state, 1) {
            ffi::LUA_TSTRING => {
                let text = CStr::from_ptr(ffi::lua_tolstring(state, 1, std::ptr::null_mut()));
                // C functions put their own location before the message.
                if text.to_bytes().ends_with(OUT_OF_MEMORY_IN_LUA.as_bytes()) {
                    EXHAUSTED.set(place(state));
                    return 1;
                }
            }
            // An error from Rust has its location, unless memory ran out.
            ffi::LUA_TUSERDATA => {
                EXHAUSTED.set(place(state));
                return 1;
            }
            _ => {}
        }
        if ffi::lua_checkstack(state, 20) != 0 {
            let text = ffi::luaL_tolstring(state, 1, std::ptr::null_mut());
            ffi::luaL_traceback(state, state, text, 0);
        }
        1
    }
}

/// Returns the innermost line of the script that is being run, without allocating Lua memory.
#[allow(unsafe_code, reason = "Luau's functions take raw states")]
unsafe fn place(state: *mut ffi::lua_State) -> Option<SourcePlace> {
    // SAFETY: lua_getinfo fills the fields for "s" and "l" if it finds a function at the level.
    unsafe {
        let mut debug: ffi::lua_Debug = std::mem::zeroed();
        for level in 0..100 {
            if ffi::lua_getinfo(state, level, c"sl".as_ptr(), &raw mut debug) == 0 {
                return None;
            }
            let source = CStr::from_ptr(debug.source).to_string_lossy();
            if let (Some(file), Ok(line)) = (source.strip_prefix('@'), usize::try_from(debug.currentline)) {
                return Some(SourcePlace::new(file, line));
            }
        }
        None
    }
}
