//! Errors of Lua as errors of scripts: place, text, remedy and kind.

use burgeon_base::error::{Error, ErrorKind, Limit, SourcePlace};
use burgeon_language::slips::remedy_of_value;

/// Name of the machine's own Lua code in tracebacks.
pub(super) const OWN: &str = "burgeon";

/// Message of Luau if memory is exhausted.
pub(super) const OUT_OF_MEMORY_IN_LUA: &str = "not enough memory";

/// Maximum length (bytes) of a shown error message; scripts can raise strings of any length.
const LONGEST_MESSAGE: usize = 10_000;

/// Returns the error of a script for an error of Lua.
pub(super) fn translate(error: &mlua::Error) -> Error {
    match error {
        mlua::Error::CallbackError { traceback, cause } => {
            let mut places = places(traceback);
            translate(cause).at(places.next()).called_at(places.last())
        }
        mlua::Error::ExternalError(inner) => match inner.downcast_ref::<Error>() {
            Some(error) => error.clone(),
            None => Error::script(inner.to_string()),
        },
        mlua::Error::WithContext { cause, .. } => translate(cause),
        mlua::Error::MemoryError(_) => Error::limit(Limit::Memory, OUT_OF_MEMORY_IN_LUA),
        mlua::Error::SyntaxError { message, .. } => parse(message).in_kind(ErrorKind::Syntax),
        mlua::Error::RuntimeError(message) => parse(message),
        mlua::Error::BadArgument { to, pos, name, cause } if is_object(*pos, name.as_deref(), cause) => {
            let method = to.as_deref().and_then(|to| to.rsplit(['.', ':']).next()).unwrap_or("method");
            Error::argument(format!("{method} needs its object"))
                .help(format!("call it with a colon: s:{method}(...)"))
        }
        mlua::Error::BadArgument { pos, cause, .. } => match &**cause {
            mlua::Error::FromLuaConversionError { from, to, .. } => {
                let wanted = script_type(to);
                Error::argument(format!("argument {pos} must be {wanted}, not {from}"))
                    .help(format!("pass {wanted}"))
            }
            cause => translate(cause),
        },
        mlua::Error::FromLuaConversionError { from, to, .. } => {
            let wanted = script_type(to);
            Error::argument(format!("a value must be {wanted}, not {from}")).help(format!("pass {wanted}"))
        }
        other => parse(&other.to_string()),
    }
}

/// Returns true if an argument is the object of a method, which is missing if the method is called with a dot.
fn is_object(number: usize, name: Option<&str>, cause: &mlua::Error) -> bool {
    name == Some("self")
        || (number == 1
            && matches!(cause, mlua::Error::FromLuaConversionError { to, .. }
                if to.contains("Handle") || *to == "userdata"))
}

/// Returns the name of a type in scripts, given its name in Rust.
fn script_type(rust: &str) -> &'static str {
    let name = rust.rsplit("::").next().unwrap_or(rust).trim_start_matches('&');
    match name {
        "String" | "LuaString" | "str" | "BString" | "BorrowedStr" | "string" => "a string",
        "f64" | "f32" | "i64" | "i32" | "i8" | "u8" | "u16" | "u32" | "u64" | "usize" | "number"
        | "integer" => "a number",
        "bool" | "boolean" => "true or false",
        "LuaFunction" | "Function" | "function" => "a function",
        "LuaTable" | "Table" | "table" => "a table",
        _ => "a value of another type",
    }
}

/// Splits `file:line: message`, a remedy after character 1, a kind after character 3, and a traceback.
/// Character 2 at the end of the remedy marks a possible fault of the data.
fn parse(text: &str) -> Error {
    let (text, traceback) = text.split_once("\nstack traceback:").unwrap_or((text, ""));
    let text = text.trim_end();
    let (text, kind) = match text.split_once('\u{3}') {
        Some((text, "argument")) => (text, ErrorKind::Argument),
        Some((text, "limit.size")) => (text, ErrorKind::Limit(Limit::Size)),
        Some((text, "scope")) => (text, ErrorKind::Scope),
        _ => (text, ErrorKind::Script),
    };
    let (text, help) = match text.split_once('\u{1}') {
        Some((text, help)) => (text, Some(help)),
        None => (text, None),
    };
    let (place, message) = match split_place(text) {
        Some((place, message)) => (place, message),
        None => (None, text),
    };
    let message = match (0..=LONGEST_MESSAGE).rev().find(|end| message.is_char_boundary(*end)) {
        Some(end) if message.len() > LONGEST_MESSAGE => &message[..end],
        _ => message,
    };
    // Modules that a rule makes are vectors for Luau, and scripts have no others.
    let named = message.starts_with("attempt to").then(|| message.replace("vector", "module"));
    let message = named.as_deref().unwrap_or(message);
    if place.is_none() && is_no_text(message) {
        return Error::script("the script raised an error that is not a string")
            .at(places(traceback).next())
            .called_at(places(traceback).last())
            .help("write error(\"what is wrong\")");
    }
    // An error of a Luau library function has no location of its own.
    let error = Error::of(kind, message).at(place).at(places(traceback).next());
    let error = error.called_at(places(traceback).last());
    match help {
        Some(help) => {
            let error = if help.ends_with('\u{2}') { error.of_data() } else { error };
            match help.trim_end_matches('\u{2}') {
                "" => error,
                help => error.help(help),
            }
        }
        None if message.contains("modify a readonly table") => error.in_kind(ErrorKind::Scope).help(
            "the library is read-only, and while rules run, so are tables from outside the rule; create a new table, or use table.clone",
        ),
        None if message.contains("stack overflow") => error.help("look for an endless recursion"),
        None => {
            let error = if is_of_values(message) { error.of_data() } else { error };
            match remedy_of_value(message) {
                Some(help) => error.help(help),
                None => error,
            }
        }
    }
}

/// Returns true if `message` is Lua's text for a value that is neither a string nor a number.
fn is_no_text(message: &str) -> bool {
    let is_address = |kind: &str| {
        let rest = message.strip_prefix(kind).and_then(|rest| rest.strip_prefix(": "));
        rest.is_some_and(|rest| rest.starts_with("0x") || rest == "(nil)")
    };
    ["nil", "true", "false"].contains(&message)
        || ["table", "function", "userdata", "thread", "buffer", "vector"].into_iter().any(is_address)
}

/// Returns true if a Luau message is about a value of the wrong type, which faulty feature data can cause.
fn is_of_values(message: &str) -> bool {
    const BEGINNINGS: [&str; 9] = [
        "attempt to perform arithmetic",
        "attempt to compare",
        "attempt to concatenate",
        "attempt to get length of",
        "attempt to index",
        "attempt to iterate over",
        "invalid argument #",
        "missing argument #",
        "invalid 'for'",
    ];
    BEGINNINGS.iter().any(|beginning| message.starts_with(beginning))
}

/// Splits `file:line: message`. The location is `None` for the machine's own code.
fn split_place(text: &str) -> Option<(Option<SourcePlace>, &str)> {
    let mut from = 0;
    while let Some(found) = text[from..].find(':') {
        let colon = from + found;
        let digits = text[colon + 1..].find(|c: char| !c.is_ascii_digit())?;
        let behind = colon + 1 + digits;
        if digits > 0 && text[behind..].starts_with(':') && !text[..colon].contains('\n') {
            let line = text[colon + 1..behind].parse().ok()?;
            let file = &text[..colon];
            let own = file == OWN || file.is_empty() || file.starts_with("__mlua");
            let place = (!own).then(|| SourcePlace::new(file, line));
            return Some((place, text[behind + 1..].trim_start()));
        }
        from = colon + 1;
    }
    None
}

/// Returns the script lines in a traceback, the innermost first. A line reads `file:line: in function <...>`.
fn places(traceback: &str) -> impl Iterator<Item = SourcePlace> {
    traceback.lines().filter_map(|line| split_place(line.trim())?.0)
}
