//! Calls functions of a script so that it is known where memory ran out: an error of that kind has no place, and
//! nothing can be asked of the stack any more once the call has failed.

use std::cell::RefCell;
use std::ffi::{CStr, c_int};

use mlua::{Lua, ffi};

use super::Machine;
use super::virtual_machine::OUT_OF_MEMORY_IN_LUA;
use burgeon_base::error::SourcePlace;

/// A heap that has grown by half of this (bytes) or less is not worth a collection.
const SCARCE: usize = 2 << 20;

thread_local! {
    /// Where memory ran out last.
    static EXHAUSTED: RefCell<Option<SourcePlace>> = const { RefCell::new(None) };
}

/// Where memory ran out, if that has not been asked since.
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

    /// Limits the memory of the machine to what it uses and what the run has left.
    fn limit_memory(&self) {
        let Some(memory) = self.session.stop.memory() else { return };
        let mut remaining = memory.remaining();
        // Luau collects garbage when the heap has doubled, which is too late for one that takes most of the memory.
        let is_scarce = remaining < self.session.options.limits.memory / 4;
        if is_scarce && self.lua().used_memory() > self.collected.get() + remaining.max(SCARCE) / 2 {
            // What goes wrong is met by the call as well.
            let _ = self.lua().gc_collect();
            self.collected.set(self.lua().used_memory());
            remaining = memory.remaining();
        }
        let limit = self.lua().used_memory().saturating_add(remaining);
        // Only machines without an allocator of mlua's refuse a limit.
        let _ = self.lua().set_memory_limit(limit.min(self.session.options.limits.memory).max(1));
    }
}

/// The function through which others are called: it takes one and its arguments.
pub(super) fn function(lua: &Lua) -> mlua::Result<mlua::Function> {
    #[allow(unsafe_code, reason = "mlua keeps its handler of errors to itself")]
    // SAFETY: `call` follows Luau's protocol for functions of C.
    let function = unsafe { lua.create_c_function(call)? };
    // Room for the handler is made now, by calls within calls: once memory has run out there is none to be had.
    let mut nested: Vec<mlua::Value> = vec![mlua::Value::Function(function.clone()); DEPTH];
    nested.push(lua.globals().raw_get("type")?);
    function.call::<mlua::MultiValue>(mlua::Variadic::from(nested)).ok();
    Ok(function)
}

/// Calls within each other that a machine has room for from the beginning.
const DEPTH: usize = 12;

#[allow(unsafe_code, reason = "called by Luau")]
unsafe extern "C-unwind" fn call(state: *mut ffi::lua_State) -> c_int {
    // SAFETY: the function and its arguments are on the stack, and the handler goes below them; a function of C has
    // room for at least 20 more values.
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

/// Notes where memory ran out; to any other error it adds the stack, as mlua does, which it leaves behind.
#[allow(unsafe_code, reason = "called by Luau")]
unsafe extern "C-unwind" fn note(state: *mut ffi::lua_State) -> c_int {
    // SAFETY: the error is the one argument; texts that Luau points to end with 0 and live as long as the frame.
    unsafe {
        match ffi::lua_type(state, 1) {
            ffi::LUA_TSTRING => {
                let text = CStr::from_ptr(ffi::lua_tolstring(state, 1, std::ptr::null_mut()));
                // Functions of C put their own line before it.
                if text.to_bytes().ends_with(OUT_OF_MEMORY_IN_LUA.as_bytes()) {
                    EXHAUSTED.set(place(state));
                    return 1;
                }
            }
            // One that comes from Rust knows its place, unless memory ran out.
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

/// The innermost line of the script that is being run. Takes no memory of Lua's.
#[allow(unsafe_code, reason = "Luau's functions take raw states")]
unsafe fn place(state: *mut ffi::lua_State) -> Option<SourcePlace> {
    // SAFETY: lua_getinfo fills the fields that "s" and "l" stand for, wherever it finds a function at the level.
    unsafe {
        let mut debug: ffi::lua_Debug = std::mem::zeroed();
        for level in 0..100 {
            if ffi::lua_getinfo(state, level, c"sl".as_ptr(), &raw mut debug) == 0 {
                return None;
            }
            let source = CStr::from_ptr(debug.source).to_string_lossy();
            if let (Some(file), Ok(line)) = (source.strip_prefix('@'), usize::try_from(debug.currentline)) {
                return Some(SourcePlace { file: file.to_owned(), line });
            }
        }
        None
    }
}
