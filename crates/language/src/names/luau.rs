//! Names of Luau, both available to scripts and removed.

use super::name::{Effect, Name, NameKind};

/// Removed names, because they would make a script's result depend on its environment, or slow it down.
pub const LOCKED: [&str; 14] = [
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

/// Short names for the effects in the tables below.
const P: Effect = Effect::Pure;
const C: Effect = Effect::ChangesFirst;
const O: Effect = Effect::Other;

/// A function: name, Luau type, description, and effect of a call.
type Row = (&'static str, &'static str, &'static str, Effect);

/// Global functions and values outside of the libraries below.
const FUNCTIONS: [Row; 23] = [
    ("_VERSION", "string", "The name of the language.", O),
    ("assert", "(value: any, message: string?) -> any", "Raises an error unless the value is true.", P),
    ("error", "(message: any, level: number?) -> never", "Raises an error.", P),
    ("getmetatable", "(value: any) -> any", "Returns the metatable of a value.", O),
    ("ipairs", "(list: { any }) -> any", "Iterates over a list in order.", P),
    ("next", "(table: any, key: any?) -> (any, any)", "Returns the entry of a table after this key.", P),
    (
        "pairs",
        "(table: any) -> any",
        "Iterates over a table: first its list, then its names in the order of their creation.",
        P,
    ),
    (
        "pcall",
        "(call: (...any) -> ...any, ...any) -> (boolean, ...any)",
        "Calls a function, and returns true if it raised no error.",
        O,
    ),
    ("print", "(...any) -> ()", "Writes values to standard error.", P),
    ("rawequal", "(a: any, b: any) -> boolean", "Compares two values without metatables.", P),
    ("rawget", "(table: any, key: any) -> any", "Returns the entry of a table without its metatable.", O),
    (
        "rawlen",
        "(value: any) -> number",
        "Returns the length of a list or a string without its metatable.",
        P,
    ),
    (
        "rawset",
        "(table: any, key: any, value: any) -> any",
        "Sets the entry of a table without its metatable.",
        O,
    ),
    (
        "select",
        "(from: number | \"#\", ...any) -> ...any",
        "Returns the arguments from this one on, or their number.",
        P,
    ),
    ("setmetatable", "(table: any, metatable: any) -> any", "Sets the metatable of a table.", O),
    ("tonumber", "(value: any, base: number?) -> number?", "Converts a string to a number.", P),
    ("tostring", "(value: any) -> string", "Converts a value to a string.", P),
    (
        "type",
        "(value: any) -> string",
        "Returns the type of a value: \"number\", \"string\", \"table\" and so on.",
        P,
    ),
    (
        "typeof",
        "(value: any) -> string",
        "Returns the type of a value, including the names of object types.",
        P,
    ),
    ("unpack", "(list: { any }, from: number?, to: number?) -> ...any", "Returns the values of a list.", P),
    (
        "xpcall",
        "(call: (...any) -> ...any, handler: (any) -> any, ...any) -> (boolean, ...any)",
        "Calls a function, and passes a raised error to a handler.",
        O,
    ),
    ("buffer", "{ ... }", "Luau's byte buffer library.", O),
    ("coroutine", "{ ... }", "Luau's coroutine library.", O),
];

/// String library.
const STRING: [Row; 17] = [
    (
        "byte",
        "(text: string, from: number?, to: number?) -> ...number",
        "Returns the bytes of a string as numbers.",
        P,
    ),
    ("char", "(...number) -> string", "Returns the string of these bytes.", P),
    (
        "find",
        "(text: string, pattern: string, from: number?, plain: boolean?) -> (number?, number?, ...string)",
        "Returns the position of the first match of a pattern, and its captures.",
        P,
    ),
    ("format", "(form: string, ...any) -> string", "Formats values, with %d, %.2f or %s in the format.", P),
    (
        "gmatch",
        "(text: string, pattern: string) -> (() -> ...string)",
        "Iterates over all matches of a pattern.",
        P,
    ),
    (
        "gsub",
        "(text: string, pattern: string, by: any, most: number?) -> (string, number)",
        "Replaces the matches of a pattern, and returns the string and the number of replacements.",
        O,
    ),
    ("len", "(text: string) -> number", "Returns the number of bytes.", P),
    ("lower", "(text: string) -> string", "Converts a string to lowercase.", P),
    (
        "match",
        "(text: string, pattern: string, from: number?) -> ...string?",
        "Returns the captures of the first match of a pattern.",
        P,
    ),
    ("pack", "(form: string, ...any) -> string", "Packs values as bytes.", P),
    ("packsize", "(form: string) -> number", "Returns the number of bytes of a packing format.", P),
    ("rep", "(text: string, count: number) -> string", "Repeats a string.", P),
    ("reverse", "(text: string) -> string", "Reverses a string.", P),
    ("split", "(text: string, separator: string?) -> { string }", "Splits a string at separators.", P),
    ("sub", "(text: string, from: number, to: number?) -> string", "Returns a part of a string.", P),
    ("unpack", "(form: string, text: string, from: number?) -> ...any", "Unpacks values from bytes.", P),
    ("upper", "(text: string) -> string", "Converts a string to uppercase.", P),
];

/// Table library.
const TABLE: [Row; 17] = [
    ("clear", "(list: any) -> ()", "Removes all entries of a table.", C),
    ("clone", "(list: any) -> any", "Returns a copy of a table with the same entries.", O),
    (
        "concat",
        "(list: { any }, separator: string?, from: number?, to: number?) -> string",
        "Joins the strings of a list.",
        P,
    ),
    ("create", "(count: number, value: any?) -> { any }", "Creates a list that repeats one value.", P),
    (
        "find",
        "(list: { any }, value: any, from: number?) -> number?",
        "Returns the index of a value in a list.",
        P,
    ),
    (
        "foreach",
        "(list: any, call: (key: any, value: any) -> any) -> any",
        "Calls a function with each entry.",
        O,
    ),
    (
        "foreachi",
        "(list: { any }, call: (index: number, value: any) -> any) -> any",
        "Calls a function with each item of a list.",
        O,
    ),
    ("freeze", "(list: any) -> any", "Makes a table read-only.", C),
    ("getn", "(list: { any }) -> number", "Returns the length of a list.", O),
    (
        "insert",
        "(list: { any }, place: any, value: any?) -> ()",
        "Inserts a value at the end of a list, or at an index.",
        C,
    ),
    ("isfrozen", "(list: any) -> boolean", "Returns true if a table is read-only.", P),
    ("maxn", "(list: any) -> number", "Returns the greatest numeric key.", P),
    (
        "move",
        "(list: { any }, from: number, to: number, at: number, target: { any }?) -> { any }",
        "Copies items of a list to another index or list.",
        C,
    ),
    ("pack", "(...any) -> any", "Returns the values as a list, with their number as n.", P),
    (
        "remove",
        "(list: { any }, place: number?) -> any",
        "Removes and returns the last item of a list, or the item at an index.",
        C,
    ),
    ("sort", "(list: { any }, before: ((a: any, b: any) -> boolean)?) -> ()", "Sorts a list.", O),
    ("unpack", "(list: { any }, from: number?, to: number?) -> ...any", "Returns the values of a list.", P),
];

/// Mathematics library.
const MATH: [Row; 36] = [
    ("abs", "(x: number) -> number", "Returns the absolute value.", P),
    ("acos", "(x: number) -> number", "Returns the angle (radians) with this cosine.", P),
    ("asin", "(x: number) -> number", "Returns the angle (radians) with this sine.", P),
    ("atan", "(x: number) -> number", "Returns the angle (radians) with this tangent.", P),
    ("atan2", "(y: number, x: number) -> number", "Returns the angle (radians) of a direction.", P),
    ("ceil", "(x: number) -> number", "Rounds up to an integer.", P),
    ("clamp", "(x: number, low: number, high: number) -> number", "Limits a number to a range.", P),
    ("cos", "(x: number) -> number", "Returns the cosine of an angle (radians).", P),
    ("cosh", "(x: number) -> number", "Returns the hyperbolic cosine.", P),
    ("deg", "(x: number) -> number", "Converts an angle from radians to degrees.", P),
    ("exp", "(x: number) -> number", "Returns the exponential function.", P),
    ("floor", "(x: number) -> number", "Rounds down to an integer.", P),
    (
        "fmod",
        "(x: number, y: number) -> number",
        "Returns the remainder of a division, with the sign of the dividend.",
        P,
    ),
    ("frexp", "(x: number) -> (number, number)", "Splits a number into a fraction and a power of two.", P),
    ("huge", "number", "Infinity.", P),
    ("isfinite", "(x: number) -> boolean", "Returns true if the number is finite.", P),
    ("isinf", "(x: number) -> boolean", "Returns true if the number is infinite.", P),
    ("isnan", "(x: number) -> boolean", "Returns true if the value is not a number (NaN).", P),
    ("ldexp", "(x: number, power: number) -> number", "Multiplies a number by a power of two.", P),
    (
        "lerp",
        "(a: number, b: number, t: number) -> number",
        "Interpolates linearly from a to b as t goes from 0 to 1.",
        P,
    ),
    ("log", "(x: number, base: number?) -> number", "Returns the logarithm.", P),
    ("log10", "(x: number) -> number", "Returns the logarithm to base 10.", P),
    (
        "map",
        "(x: number, from: number, to: number, low: number, high: number) -> number",
        "Maps a number from one range to another.",
        P,
    ),
    ("max", "(x: number, ...number) -> number", "Returns the maximum of some numbers.", P),
    ("min", "(x: number, ...number) -> number", "Returns the minimum of some numbers.", P),
    ("modf", "(x: number) -> (number, number)", "Returns the integer part and the fraction of a number.", P),
    ("pi", "number", "Half the circumference of a circle with radius 1.", P),
    ("pow", "(x: number, y: number) -> number", "Raises a number to a power.", P),
    ("rad", "(x: number) -> number", "Converts an angle from degrees to radians.", P),
    ("round", "(x: number) -> number", "Rounds to the nearest integer.", P),
    ("sign", "(x: number) -> number", "Returns 1, 0 or -1, the sign of a number.", P),
    ("sin", "(x: number) -> number", "Returns the sine of an angle (radians).", P),
    ("sinh", "(x: number) -> number", "Returns the hyperbolic sine.", P),
    ("sqrt", "(x: number) -> number", "Returns the square root.", P),
    ("tan", "(x: number) -> number", "Returns the tangent of an angle (radians).", P),
    ("tanh", "(x: number) -> number", "Returns the hyperbolic tangent.", P),
];

/// Library of bit operations.
const BIT32: [Row; 15] = [
    (
        "arshift",
        "(x: number, by: number) -> number",
        "Shifts the bits to the right, and repeats the first bit.",
        P,
    ),
    ("band", "(...number) -> number", "Returns the bitwise and.", P),
    ("bnot", "(x: number) -> number", "Returns the bitwise complement.", P),
    ("bor", "(...number) -> number", "Returns the bitwise or.", P),
    ("btest", "(...number) -> boolean", "Returns true if the bitwise and is not 0.", P),
    ("bxor", "(...number) -> number", "Returns the bitwise exclusive or.", P),
    ("byteswap", "(x: number) -> number", "Reverses the order of the four bytes.", P),
    ("countlz", "(x: number) -> number", "Returns the number of leading zeros.", P),
    ("countrz", "(x: number) -> number", "Returns the number of trailing zeros.", P),
    (
        "extract",
        "(x: number, at: number, width: number?) -> number",
        "Returns a range of bits as a number.",
        P,
    ),
    ("lrotate", "(x: number, by: number) -> number", "Rotates the bits to the left.", P),
    ("lshift", "(x: number, by: number) -> number", "Shifts the bits to the left.", P),
    (
        "replace",
        "(x: number, value: number, at: number, width: number?) -> number",
        "Replaces a range of bits.",
        P,
    ),
    ("rrotate", "(x: number, by: number) -> number", "Rotates the bits to the right.", P),
    ("rshift", "(x: number, by: number) -> number", "Shifts the bits to the right.", P),
];

/// Library for text in UTF-8.
const UTF8: [Row; 6] = [
    ("char", "(...number) -> string", "Returns the string of these code points.", O),
    ("charpattern", "string", "A pattern that matches one character.", O),
    (
        "codepoint",
        "(text: string, from: number?, to: number?) -> ...number",
        "Returns the code points of a string.",
        O,
    ),
    ("codes", "(text: string) -> any", "Iterates over the characters of a string.", O),
    (
        "len",
        "(text: string, from: number?, to: number?) -> (number?, number?)",
        "Returns the number of characters.",
        O,
    ),
    (
        "offset",
        "(text: string, count: number, from: number?) -> number?",
        "Returns the byte position of a character.",
        O,
    ),
];

/// Returns all names of Luau that scripts can use.
pub(super) fn names() -> Vec<Name> {
    let mut names: Vec<Name> = FUNCTIONS.into_iter().map(|row| declare(NameKind::Luau, row)).collect();
    for (name, doc, rows) in [
        ("string", "Luau's string library.", &STRING[..]),
        ("table", "Luau's table library.", &TABLE[..]),
        (
            "math",
            "Luau's mathematics library, without random numbers; use random and noise instead.",
            &MATH[..],
        ),
        ("bit32", "Luau's library of bit operations on integers.", &BIT32[..]),
        ("utf8", "Luau's library for UTF-8 strings.", &UTF8[..]),
    ] {
        let functions: Vec<Name> = rows.iter().map(|row| declare(NameKind::Function, *row)).collect();
        names.push(Name::new(name, NameKind::Luau, doc).functions(functions));
    }
    names
}

fn declare(sort: NameKind, (name, luau, doc, effect): Row) -> Name {
    let name = Name { effect, ..Name::new(name, sort, doc) };
    if luau.starts_with('(') { name.read(luau) } else { name.luau(luau) }
}
