//! Compilation of Lua sources to bytecode.

use mlua::chunk::Compiler;

/// Functions that the prelude redefines: Luau's `math.lerp` gives different bits in native code and in bytecode, and its
/// `rawset` changes vectors. Without this list the compiler would still inline its own versions.
const DIFFERENT: [&str; 2] = ["math.lerp", "rawset"];

/// Returns the compiler for all sources that a virtual machine runs.
pub(crate) fn compiler() -> Compiler {
    let compiler = Compiler::new().set_optimization_level(2).set_type_info_level(1).set_debug_level(1);
    compiler.set_disabled_builtins(DIFFERENT)
}

/// Returns the bytecode of `text`; `None` if it has a syntax error, which Luau reports when it runs the text.
pub(crate) fn compile(text: &str) -> Option<Vec<u8>> {
    compiler().compile(text).ok()
}
