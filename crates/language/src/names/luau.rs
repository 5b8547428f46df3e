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
    ("getmetatable", "(value: any) -> any", "The metatable of a value.", O),
    ("ipairs", "(list: { any }) -> any", "Goes through a list in order.", P),
    ("next", "(table: any, key: any?) -> (any, any)", "The entry of a table after this key.", P),
    (
        "pairs",
        "(table: any) -> any",
        "Goes through a table: first its list, then its names in the order they were made.",
        P,
    ),
    (
        "pcall",
        "(call: (...any) -> ...any, ...any) -> (boolean, ...any)",
        "Calls a function, and tells whether it raised no error.",
        O,
    ),
    ("print", "(...any) -> ()", "Writes values to standard error.", P),
    (
        "rawequal",
        "(a: any, b: any) -> boolean",
        "Whether two values are the same, whatever their metatables say.",
        P,
    ),
    ("rawget", "(table: any, key: any) -> any", "The entry of a table, whatever its metatable says.", O),
    ("rawlen", "(value: any) -> number", "The length of a list or a string, whatever its metatable says.", P),
    (
        "rawset",
        "(table: any, key: any, value: any) -> any",
        "Sets the entry of a table, whatever its metatable says.",
        O,
    ),
    (
        "select",
        "(from: number | \"#\", ...any) -> ...any",
        "The values from this one on, or how many there are.",
        P,
    ),
    ("setmetatable", "(table: any, metatable: any) -> any", "Gives a table a metatable.", O),
    ("tonumber", "(value: any, base: number?) -> number?", "The number that a text stands for.", P),
    ("tostring", "(value: any) -> string", "A value as text.", P),
    ("type", "(value: any) -> string", "What a value is: \"number\", \"string\", \"table\" and so on.", P),
    ("typeof", "(value: any) -> string", "What a value is, with the names of types of objects.", P),
    ("unpack", "(list: { any }, from: number?, to: number?) -> ...any", "The values of a list.", P),
    (
        "xpcall",
        "(call: (...any) -> ...any, handler: (any) -> any, ...any) -> (boolean, ...any)",
        "Calls a function, and gives what it raises to another.",
        O,
    ),
    ("buffer", "{ ... }", "Luau's library of blocks of bytes.", O),
    ("coroutine", "{ ... }", "Luau's library of coroutines.", O),
];

/// String library.
const STRING: [Row; 17] = [
    ("byte", "(text: string, from: number?, to: number?) -> ...number", "The numbers of its bytes.", P),
    ("char", "(...number) -> string", "The text of these bytes.", P),
    (
        "find",
        "(text: string, pattern: string, from: number?, plain: boolean?) -> (number?, number?, ...string)",
        "Where a pattern occurs first, and what it captures.",
        P,
    ),
    ("format", "(form: string, ...any) -> string", "A text with values set in, as %d, %.2f or %s.", P),
    (
        "gmatch",
        "(text: string, pattern: string) -> (() -> ...string)",
        "Goes through all places where a pattern occurs.",
        P,
    ),
    (
        "gsub",
        "(text: string, pattern: string, by: any, most: number?) -> (string, number)",
        "The text with another in place of a pattern, and how often.",
        O,
    ),
    ("len", "(text: string) -> number", "How many bytes it has.", P),
    ("lower", "(text: string) -> string", "The text in small letters.", P),
    (
        "match",
        "(text: string, pattern: string, from: number?) -> ...string?",
        "What a pattern captures where it occurs first.",
        P,
    ),
    ("pack", "(form: string, ...any) -> string", "Values as bytes.", P),
    ("packsize", "(form: string) -> number", "How many bytes a form takes.", P),
    ("rep", "(text: string, count: number) -> string", "The text so many times.", P),
    ("reverse", "(text: string) -> string", "The text from its end to its beginning.", P),
    (
        "split",
        "(text: string, separator: string?) -> { string }",
        "The parts of a text between separators.",
        P,
    ),
    ("sub", "(text: string, from: number, to: number?) -> string", "A part of a text.", P),
    (
        "unpack",
        "(form: string, text: string, from: number?) -> ...any",
        "The values that bytes stand for.",
        P,
    ),
    ("upper", "(text: string) -> string", "The text in capital letters.", P),
];

/// Table library.
const TABLE: [Row; 17] = [
    ("clear", "(list: any) -> ()", "Takes everything out of a table.", C),
    ("clone", "(list: any) -> any", "Another table with the same entries.", O),
    (
        "concat",
        "(list: { any }, separator: string?, from: number?, to: number?) -> string",
        "The texts of a list as one.",
        P,
    ),
    ("create", "(count: number, value: any?) -> { any }", "A list of one value, so many times.", P),
    ("find", "(list: { any }, value: any, from: number?) -> number?", "The place of a value in a list.", P),
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
    ("freeze", "(list: any) -> any", "Lets a table never change again.", C),
    ("getn", "(list: { any }) -> number", "How long a list is.", O),
    (
        "insert",
        "(list: { any }, place: any, value: any?) -> ()",
        "Adds a value at the end of a list, or at a place.",
        C,
    ),
    ("isfrozen", "(list: any) -> boolean", "Whether a table can never change.", P),
    ("maxn", "(list: any) -> number", "The greatest number among its keys.", P),
    (
        "move",
        "(list: { any }, from: number, to: number, at: number, target: { any }?) -> { any }",
        "Copies items of a list to another place.",
        C,
    ),
    ("pack", "(...any) -> any", "The values as a list, with their number as n.", P),
    (
        "remove",
        "(list: { any }, place: number?) -> any",
        "Takes the last item out of a list, or the one at a place.",
        C,
    ),
    ("sort", "(list: { any }, before: ((a: any, b: any) -> boolean)?) -> ()", "Sorts a list.", O),
    ("unpack", "(list: { any }, from: number?, to: number?) -> ...any", "The values of a list.", P),
];

/// Mathematics library.
const MATH: [Row; 36] = [
    ("abs", "(x: number) -> number", "The number without its sign.", P),
    ("acos", "(x: number) -> number", "The angle (radians) with this cosine.", P),
    ("asin", "(x: number) -> number", "The angle (radians) with this sine.", P),
    ("atan", "(x: number) -> number", "The angle (radians) with this tangent.", P),
    ("atan2", "(y: number, x: number) -> number", "The angle (radians) of a direction.", P),
    ("ceil", "(x: number) -> number", "The next whole number upwards.", P),
    ("clamp", "(x: number, low: number, high: number) -> number", "The number, kept between two others.", P),
    ("cos", "(x: number) -> number", "The cosine of an angle (radians).", P),
    ("cosh", "(x: number) -> number", "The hyperbolic cosine.", P),
    ("deg", "(x: number) -> number", "An angle in degrees, of one in radians.", P),
    ("exp", "(x: number) -> number", "The exponential function.", P),
    ("floor", "(x: number) -> number", "The next whole number downwards.", P),
    ("fmod", "(x: number, y: number) -> number", "What a division leaves, with the sign of the first.", P),
    ("frexp", "(x: number) -> (number, number)", "The number as a fraction and a power of two.", P),
    ("huge", "number", "A number greater than all others.", P),
    ("isfinite", "(x: number) -> boolean", "Whether it is a number, and not an endless one.", P),
    ("isinf", "(x: number) -> boolean", "Whether it is endless.", P),
    ("isnan", "(x: number) -> boolean", "Whether it is no number.", P),
    ("ldexp", "(x: number, power: number) -> number", "The number times a power of two.", P),
    ("lerp", "(a: number, b: number, t: number) -> number", "From a to b as t goes from 0 to 1.", P),
    ("log", "(x: number, base: number?) -> number", "The logarithm.", P),
    ("log10", "(x: number) -> number", "The logarithm to base 10.", P),
    (
        "map",
        "(x: number, from: number, to: number, low: number, high: number) -> number",
        "A number from one range in another.",
        P,
    ),
    ("max", "(x: number, ...number) -> number", "The greatest of some numbers.", P),
    ("min", "(x: number, ...number) -> number", "The least of some numbers.", P),
    ("modf", "(x: number) -> (number, number)", "The whole part of a number, and the rest.", P),
    ("pi", "number", "Half the circumference of a circle with radius 1.", P),
    ("pow", "(x: number, y: number) -> number", "A number to the power of another.", P),
    ("rad", "(x: number) -> number", "An angle in radians, of one in degrees.", P),
    ("round", "(x: number) -> number", "The nearest whole number.", P),
    ("sign", "(x: number) -> number", "1, 0 or -1, by the sign of a number.", P),
    ("sin", "(x: number) -> number", "The sine of an angle (radians).", P),
    ("sinh", "(x: number) -> number", "The hyperbolic sine.", P),
    ("sqrt", "(x: number) -> number", "The square root.", P),
    ("tan", "(x: number) -> number", "The tangent of an angle (radians).", P),
    ("tanh", "(x: number) -> number", "The hyperbolic tangent.", P),
];

/// Library of bit operations.
const BIT32: [Row; 15] = [
    (
        "arshift",
        "(x: number, by: number) -> number",
        "The bits moved to the right; the first one is repeated.",
        P,
    ),
    ("band", "(...number) -> number", "The bits that all have.", P),
    ("bnot", "(x: number) -> number", "The bits that it has not.", P),
    ("bor", "(...number) -> number", "The bits that any has.", P),
    ("btest", "(...number) -> boolean", "Whether there is a bit that all have.", P),
    ("bxor", "(...number) -> number", "The bits that an odd number of them has.", P),
    ("byteswap", "(x: number) -> number", "The four bytes in the other order.", P),
    ("countlz", "(x: number) -> number", "How many zeros come before its first bit.", P),
    ("countrz", "(x: number) -> number", "How many zeros come behind its last bit.", P),
    ("extract", "(x: number, at: number, width: number?) -> number", "Some of its bits as a number.", P),
    (
        "lrotate",
        "(x: number, by: number) -> number",
        "The bits moved to the left, and in again from the right.",
        P,
    ),
    ("lshift", "(x: number, by: number) -> number", "The bits moved to the left.", P),
    (
        "replace",
        "(x: number, value: number, at: number, width: number?) -> number",
        "The number with others of its bits.",
        P,
    ),
    (
        "rrotate",
        "(x: number, by: number) -> number",
        "The bits moved to the right, and in again from the left.",
        P,
    ),
    ("rshift", "(x: number, by: number) -> number", "The bits moved to the right.", P),
];

/// Library for text in UTF-8.
const UTF8: [Row; 6] = [
    ("char", "(...number) -> string", "The text of these letters, by their numbers.", O),
    ("charpattern", "string", "A pattern that one letter matches.", O),
    (
        "codepoint",
        "(text: string, from: number?, to: number?) -> ...number",
        "The numbers of its letters.",
        O,
    ),
    ("codes", "(text: string) -> any", "Goes through the letters of a text.", O),
    (
        "len",
        "(text: string, from: number?, to: number?) -> (number?, number?)",
        "How many letters it has.",
        O,
    ),
    (
        "offset",
        "(text: string, count: number, from: number?) -> number?",
        "Where a letter begins, as a number of bytes.",
        O,
    ),
];

/// Returns all names of Luau that scripts can use.
pub(super) fn names() -> Vec<Name> {
    let mut names: Vec<Name> = FUNCTIONS.into_iter().map(|row| declare(NameKind::Luau, row)).collect();
    for (name, doc, rows) in [
        ("string", "Luau's library of strings.", &STRING[..]),
        ("table", "Luau's library of lists and tables.", &TABLE[..]),
        (
            "math",
            "Luau's library of mathematics, without its random numbers; those are random and noise.",
            &MATH[..],
        ),
        ("bit32", "Luau's library of operations on the bits of whole numbers.", &BIT32[..]),
        ("utf8", "Luau's library of texts in UTF-8.", &UTF8[..]),
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
