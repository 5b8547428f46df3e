//! Native code for Lua functions, with the feature `jit` on processors that Luau supports. Otherwise
//! functions stay bytecode, with the same results.

use std::cell::{Cell, RefCell};
#[cfg(feature = "jit")]
use std::sync::LazyLock;
use std::time::{Duration, Instant};

use mlua::{Function, Lua};

/// Time for which a machine that waits runs bytecode. Compiling takes about 5 ms, and most of the time of a tile is spent outside Lua.
const WAIT: Duration = Duration::from_millis(50);

/// Functions that become native code as soon as the machine has worked for [`WAIT`], so that a short run compiles none.
#[derive(Default)]
struct WaitingFunctions {
    /// Time at which the machine began to work on a derivation.
    begin: Cell<Option<Instant>>,
    functions: RefCell<Vec<Function>>,
}

/// Makes the machine wait with native code until it has worked for a while.
pub(super) fn wait_with_native(lua: &Lua) {
    set_native(lua, false);
    lua.set_app_data(WaitingFunctions::default());
}

/// Compiles the functions that wait, if the machine has worked for long enough. To be called before each batch.
pub(super) fn end_wait_if_due(lua: &Lua) {
    let is_due = lua.app_data_ref::<WaitingFunctions>().is_some_and(|waiting| match waiting.begin.get() {
        Some(begin) => begin.elapsed() > WAIT,
        None => {
            waiting.begin.set(Some(Instant::now()));
            false
        }
    });
    if !is_due {
        return;
    }
    let functions = lua.remove_app_data::<WaitingFunctions>().unwrap_or_default().functions.into_inner();
    set_native(lua, true);
    for function in functions {
        // A function without native code has the same results.
        let _ = native(lua, &function);
    }
}

/// Keeps a function for later if the machine waits, and returns true if it does.
pub(super) fn is_kept_for_later(lua: &Lua, function: &Function) -> bool {
    let waiting = lua.app_data_ref::<WaitingFunctions>();
    waiting.map(|waiting| waiting.functions.borrow_mut().push(function.clone())).is_some()
}

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
    set_native(lua, lua.app_data_ref::<WaitingFunctions>().is_none());
    loaded
}

/// Compiles a Lua function, and the functions inside it, to native code, unless this has been done. A machine that waits does so later.
#[cfg(feature = "jit")]
pub(crate) fn native(lua: &Lua, function: &Function) -> mlua::Result<()> {
    if is_kept_for_later(lua, function) {
        return Ok(());
    }
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_machine_that_waits_compiles_its_functions_after_some_work() {
        let lua = Lua::new();
        wait_with_native(&lua);
        let function: Function = lua.load("return function(a) return a + 1 end").eval().unwrap();
        native(&lua, &function).unwrap();
        let waiting = || lua.app_data_ref::<WaitingFunctions>().map(|known| known.functions.borrow().len());
        // Without native code for this processor, no function has to wait.
        let kept = usize::from(cfg!(feature = "jit"));
        assert_eq!(waiting(), Some(kept));
        end_wait_if_due(&lua);
        assert_eq!(waiting(), Some(kept));
        std::thread::sleep(WAIT * 2);
        end_wait_if_due(&lua);
        assert_eq!(waiting(), None);
        assert_eq!(function.call::<i64>(4).unwrap(), 5);
    }
}
