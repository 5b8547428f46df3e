//! The bytecode of Lua's texts.

use mlua::chunk::Compiler;

/// How every text is compiled that a virtual machine runs.
pub(crate) fn compiler() -> Compiler {
    Compiler::new().set_optimization_level(2).set_type_info_level(1).set_debug_level(1)
}

/// The bytecode of `text`; none where Luau refuses it, which tells why when it is asked to run it.
pub(crate) fn compile(text: &str) -> Option<Vec<u8>> {
    compiler().compile(text).ok()
}
