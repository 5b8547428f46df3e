//! State of a machine that is the same for every run, so that a thread can create it in advance.

use std::cell::RefCell;

use mlua::{Function, Lua, LuaOptions, StdLib};

use super::native::{native, set_native};
use super::prelude::Prelude;

thread_local! {
    static READY: RefCell<Option<BlankMachine>> = const { RefCell::new(None) };
}

/// Luau state without any data of a script.
pub(super) struct BlankMachine {
    pub(super) lua: Lua,
    /// Prelude, compiled but not yet called.
    pub(super) prelude: Function,
}

impl BlankMachine {
    /// Takes the state that [`make_ready`] prepared in this thread, or creates one.
    pub(super) fn take() -> mlua::Result<Self> {
        READY.take().map_or_else(Self::new, Ok)
    }

    fn new() -> mlua::Result<Self> {
        let libraries = StdLib::MATH
            | StdLib::STRING
            | StdLib::TABLE
            | StdLib::BIT
            | StdLib::UTF8
            | StdLib::BUFFER
            | StdLib::COROUTINE
            | StdLib::VECTOR
            | StdLib::OS
            | StdLib::DEBUG;
        let lua = Lua::new_with(libraries, LuaOptions::default())?;
        lua.set_compiler(crate::declare::bytecode::compiler());
        set_native(&lua, true);
        let prelude = Prelude::chunk(&lua)?;
        Ok(Self { lua, prelude })
    }
}

/// Prepares the next machine of this thread, for a thread that waits and must start a script without delay.
///
/// Compiles native code for everything that scripts may use, which takes longer than creating a machine for a
/// run.
pub fn make_ready() {
    if READY.with_borrow(Option::is_some) {
        return;
    }
    let begun = BlankMachine::new().and_then(|begun| {
        native(&begun.lua, &begun.prelude)?;
        Ok(begun)
    });
    // The run meets the same error again and reports it.
    READY.set(begun.ok());
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use super::*;
    use crate::declare::RunOptions;

    #[test]
    fn a_machine_that_waits_with_native_code_makes_what_others_do() {
        let script = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scripts/herb.lua");
        let made = |waits_with_native: bool| -> Vec<String> {
            let registry = burgeon_objects::registry();
            let run =
                crate::run::run(&script, RunOptions { registry, waits_with_native, ..RunOptions::default() })
                    .unwrap();
            run.systems.iter().map(|system| system.chain_text()).collect()
        };
        let expected = made(false);
        assert!(!expected.concat().is_empty());
        assert_eq!(made(true), expected);
    }

    #[test]
    fn a_machine_that_was_made_ready_makes_what_others_do_once() {
        let script = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scripts/herb.lua");
        let made = || -> Vec<String> {
            let run = crate::run::run(
                &script,
                RunOptions { registry: burgeon_objects::registry(), ..RunOptions::default() },
            )
            .unwrap();
            run.systems.iter().map(|system| system.chain_text()).collect()
        };
        let expected = made();
        make_ready();
        assert!(READY.with_borrow(Option::is_some));
        assert_eq!(made(), expected);
        assert!(READY.with_borrow(Option::is_none));
        assert_eq!(made(), expected);
    }
}
