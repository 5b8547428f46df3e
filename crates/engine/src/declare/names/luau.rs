//! The names of Luau itself that scripts keep, and those that they do not.

use super::{Name, NameKind};

/// Names that would make a script's meaning depend on more than itself, or would slow it down.
pub(crate) const LOCKED: [&str; 14] = [
    "getfenv",
    "setfenv",
    "loadstring",
    "load",
    "newproxy",
    "collectgarbage",
    "os",
    "debug",
    "vector",
    "_G",
    "gcinfo",
    "io",
    "dofile",
    "loadfile",
];

const fn name(name: &'static str, luau: &'static str, doc: &'static str) -> Name {
    Name::new(name, NameKind::Luau, luau, doc)
}

/// All of them.
pub(super) static NAMES: &[&Name] = &[
    &name("_VERSION", "string", "The name of the language."),
    &name("assert", "(value: any, message: string?) -> any", "Raises an error unless the value is true.")
        .pure(),
    &name("bit32", "{ ... }", "Luau's library of operations on the bits of whole numbers.").pure(),
    &name("buffer", "{ ... }", "Luau's library of blocks of bytes."),
    &name("coroutine", "{ ... }", "Luau's library of coroutines."),
    &name("error", "(message: any, level: number?) -> never", "Raises an error.").pure(),
    &name("getmetatable", "(value: any) -> any", "The metatable of a value."),
    &name("ipairs", "(list: { any }) -> any", "Goes through a list in order.").pure(),
    &name(
        "math",
        "{ ... }",
        "Luau's library of mathematics, without its random numbers; those are random and noise.",
    )
    .pure(),
    &name("next", "(table: any, key: any?) -> (any, any)", "The entry of a table after this key.").pure(),
    &name(
        "pairs",
        "(table: any) -> any",
        "Goes through a table: first its list, then its names in the order they were made.",
    )
    .pure(),
    &name(
        "pcall",
        "(call: (...any) -> ...any, ...any) -> (boolean, ...any)",
        "Calls a function, and tells whether it raised no error.",
    ),
    &name("print", "(...any) -> ()", "Writes values to standard error.").pure(),
    &name(
        "rawequal",
        "(a: any, b: any) -> boolean",
        "Whether two values are the same, whatever their metatables say.",
    )
    .pure(),
    &name("rawget", "(table: any, key: any) -> any", "The entry of a table, whatever its metatable says."),
    &name(
        "rawlen",
        "(value: any) -> number",
        "The length of a list or a string, whatever its metatable says.",
    )
    .pure(),
    &name(
        "rawset",
        "(table: any, key: any, value: any) -> any",
        "Sets the entry of a table, whatever its metatable says.",
    ),
    &name(
        "select",
        "(from: number | \"#\", ...any) -> ...any",
        "The values from this one on, or how many there are.",
    )
    .pure(),
    &name("setmetatable", "(table: any, metatable: any) -> any", "Gives a table a metatable."),
    &name("string", "{ ... }", "Luau's library of strings.").pure(),
    &name("table", "{ ... }", "Luau's library of lists and tables."),
    &name("tonumber", "(value: any, base: number?) -> number?", "The number that a text stands for.").pure(),
    &name("tostring", "(value: any) -> string", "A value as text.").pure(),
    &name("type", "(value: any) -> string", "What a value is: \"number\", \"string\", \"table\" and so on.")
        .pure(),
    &name("typeof", "(value: any) -> string", "What a value is, with the names of types of objects.").pure(),
    &name("unpack", "(list: { any }, from: number?, to: number?) -> ...any", "The values of a list.").pure(),
    &name("utf8", "{ ... }", "Luau's library of texts in UTF-8.").pure(),
    &name(
        "xpcall",
        "(call: (...any) -> ...any, handler: (any) -> any, ...any) -> (boolean, ...any)",
        "Calls a function, and gives what it raises to another.",
    ),
];
