//! Native code for Lua functions, with the feature `jit` on processors that Luau supports. Otherwise
//! functions stay bytecode, with the same results.

use mlua::{Function, Lua};

#[cfg(feature = "jit")]
use std::sync::LazyLock;

/// Set if Luau makes native code for this processor. The value is cached, because the test takes tens of
/// microseconds in a virtual machine.
#[cfg(feature = "jit")]
static SUPPORTED: LazyLock<bool> = LazyLock::new(|| {
    #[allow(unsafe_code, reason = "mlua does not tell")]
    // SAFETY: the function takes no arguments and only reads the processor's features.
    unsafe {
        mlua::ffi::luau_codegen_supported() != 0
    }
});

/// Sets whether functions are compiled to native code as soon as they are loaded.
pub(super) fn set_native(lua: &Lua, on: bool) {
    #[cfg(feature = "jit")]
    lua.enable_jit(on);
    #[cfg(not(feature = "jit"))]
    let _ = (lua, on);
}

/// Calls `load` so that the loaded functions stay bytecode until [`native`] compiles them.
pub(super) fn as_bytecode<T>(lua: &Lua, load: impl FnOnce() -> T) -> T {
    set_native(lua, false);
    let loaded = load();
    set_native(lua, true);
    loaded
}

/// Compiles a Lua function, and the functions inside it, to native code, unless this has been done.
#[cfg(feature = "jit")]
pub(crate) fn native(lua: &Lua, function: &Function) -> mlua::Result<()> {
    #[allow(unsafe_code, reason = "mlua makes native code of whole files only")]
    // SAFETY: luau_codegen_compile takes the index of a Lua function and leaves the stack unchanged. mlua has
    // set up code generation for this state, as it does wherever it makes native code itself.
    unsafe {
        lua.exec_raw::<()>(function, |state| {
            if *SUPPORTED {
                mlua::ffi::luau_codegen_compile(state, -1);
            }
            mlua::ffi::lua_settop(state, 0);
        })
    }
}

/// Leaves a Lua function unchanged.
#[cfg(not(feature = "jit"))]
#[allow(clippy::unnecessary_wraps, reason = "with native code it may fail")]
pub(crate) fn native(_: &Lua, _: &Function) -> mlua::Result<()> {
    Ok(())
}
