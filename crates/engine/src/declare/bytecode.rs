//! The bytecode of Lua's texts.

use mlua::chunk::Compiler;

/// Functions that the prelude defines, since Luau's own give other bits in native code than in bytecode. The compiler would
/// call its own all the same.
const DIFFERENT: [&str; 1] = ["math.lerp"];

/// How every text is compiled that a virtual machine runs.
pub(crate) fn compiler() -> Compiler {
    let compiler = Compiler::new().set_optimization_level(2).set_type_info_level(1).set_debug_level(1);
    compiler.set_disabled_builtins(DIFFERENT)
}

/// The bytecode of `text`; none where Luau refuses it, which tells why when it is asked to run it.
pub(crate) fn compile(text: &str) -> Option<Vec<u8>> {
    compiler().compile(text).ok()
}
