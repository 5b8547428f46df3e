//! Native code of Lua functions: made where the program has the feature `jit` and the processor is one that Luau knows.
//! Otherwise functions stay bytecode, and do the same.

use mlua::{Function, Lua};

#[cfg(feature = "jit")]
use std::sync::LazyLock;

/// Whether Luau makes native code for this processor. Asking takes tens of microseconds where the computer is virtual.
#[cfg(feature = "jit")]
static SUPPORTED: LazyLock<bool> = LazyLock::new(|| {
    #[allow(unsafe_code, reason = "mlua does not tell")]
    // SAFETY: the function takes nothing and only looks at what the processor says of itself.
    unsafe {
        mlua::ffi::luau_codegen_supported() != 0
    }
});

/// Whether what is loaded from now on becomes native code at once.
pub(super) fn set_native(lua: &Lua, on: bool) {
    #[cfg(feature = "jit")]
    lua.enable_jit(on);
    #[cfg(not(feature = "jit"))]
    let _ = (lua, on);
}

/// What `load` gives of `lua`, which stays bytecode until it is made [`native`].
pub(super) fn as_bytecode<T>(lua: &Lua, load: impl FnOnce() -> T) -> T {
    set_native(lua, false);
    let loaded = load();
    set_native(lua, true);
    loaded
}

/// Makes native code of a Lua function and of those within it, unless it has been made.
#[cfg(feature = "jit")]
pub(crate) fn native(lua: &Lua, function: &Function) -> mlua::Result<()> {
    #[allow(unsafe_code, reason = "mlua makes native code of whole files only")]
    // SAFETY: luau_codegen_compile takes the index of a Lua function and leaves the stack as it was; mlua has set up
    // code generation for this state, which it has done wherever it made native code itself.
    unsafe {
        lua.exec_raw::<()>(function, |state| {
            if *SUPPORTED {
                mlua::ffi::luau_codegen_compile(state, -1);
            }
            mlua::ffi::lua_settop(state, 0);
        })
    }
}

/// Leaves a Lua function as it is.
#[cfg(not(feature = "jit"))]
#[allow(clippy::unnecessary_wraps, reason = "with native code it may fail")]
pub(crate) fn native(_: &Lua, _: &Function) -> mlua::Result<()> {
    Ok(())
}
