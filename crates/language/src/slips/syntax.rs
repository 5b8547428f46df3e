//! Remedies for syntax errors.

use std::ops::Range;

use burgeon_base::error::{Error, SourcePlace};

use super::blocks::find_unclosed;
use super::code::{code_lines, names_of};

/// Adds a remedy to a syntax error of Luau, if its line has a construct of another language.
///
/// ```
/// use burgeon_base::error::Error;
/// use burgeon_language::slips::explain_syntax;
///
/// let error = Error::syntax("Expected identifier when parsing expression, got '['").at_line("tree.lua", 1);
/// let error = explain_syntax(error, "local points = [1, 2, 3]");
/// assert_eq!(error.remedy(), Some("write lists and branches with braces: { 1, 2 }"));
/// ```
#[must_use]
pub fn explain_syntax(error: Error, text: &str) -> Error {
    let Some(line) = error.place().map(|place| place.line) else { return error };
    if error.remedy().is_some() {
        return error;
    }
    let lines = code_lines(text);
    let code = |line: usize| lines.get(line.wrapping_sub(1)).map_or("", String::as_str);
    let message = error.message().to_owned();
    let here = code(line);
    let before = code(line.wrapping_sub(1)).trim();
    let is_head = message.starts_with("Expected 'then'") || message.starts_with("Expected 'do'");
    let remedy = remedy_for_sign(here)
        .or_else(|| is_head.then(|| remedy_for_word(before, &message)).flatten())
        .or_else(|| remedy_for_word(here, &message))
        .map(str::to_owned)
        .or_else(|| remedy_for_message(&message, here, before).map(str::to_owned))
        .or_else(|| remedy_for_block(&message, &lines, line))
        .or_else(|| remedy_for_word(before, &message).map(str::to_owned))
        .or_else(|| remedy_for_bracket(&message))
        .or_else(|| remedy_for_token(&message));
    // The end of the script is that of its last line, where something is missing.
    let error = match (error.place(), lines.iter().rposition(|line| !line.trim().is_empty())) {
        (Some(place), Some(last))
            if here.trim().is_empty() && line > last + 1 && message.contains("got <eof>") =>
        {
            let (place, end) =
                (SourcePlace::new(&place.file, last + 1), lines[last].trim_end().chars().count());
            error.rather_at(Some(place)).in_columns(end.saturating_sub(1)..end)
        }
        _ => error,
    };
    let error = sign_columns(here).into_iter().fold(error, Error::in_columns);
    match remedy {
        Some(remedy) => error.help(remedy),
        None => error,
    }
}

/// Signs that Lua lacks, and the remedies. The first that occurs counts.
const SIGNS: [(&str, &str); 24] = [
    ("\u{201c}", "write straight quotes: \"text\""),
    ("\u{201d}", "write straight quotes: \"text\""),
    ("\u{201e}", "write straight quotes: \"text\""),
    ("\u{2018}", "write straight quotes: 'text'"),
    ("\u{2019}", "write straight quotes: 'text'"),
    ("\u{ab}", "write straight quotes: \"text\""),
    ("\u{2212}", "write the minus of the keyboard: -"),
    ("\u{2013}", "write the minus of the keyboard: -"),
    ("\u{d7}", "write * for products"),
    ("\u{b0}", "write angles as numbers (degrees): Turn(30)"),
    ("\u{a0}", "write plain spaces: the line has a space that does not break"),
    ("/*", "write comments with -- or --[[ and ]]"),
    ("**", "write powers with ^: x ^ 2"),
    ("!=", "write ~= for \"not equal\""),
    ("<>", "write ~= for \"not equal\""),
    ("===", "write == for \"equal\""),
    ("&&", "write and"),
    ("||", "write or"),
    ("++", "write n += 1"),
    (":=", "write local x = 1"),
    ("=>", "write functions as function(x) return x end"),
    ("<<", "write bit32.lshift(a, b)"),
    (">>", "write bit32.rshift(a, b)"),
    ("<const>", "write local x = 5: variables have no attributes"),
];

/// Returns the columns (characters, from 0) of a sign that Lua lacks.
fn sign_columns(code: &str) -> Option<Range<usize>> {
    let (sign, _) = SIGNS.iter().find(|(sign, _)| code.contains(sign))?;
    let begin = code[..code.find(sign)?].chars().count();
    Some(begin..begin + sign.chars().count())
}

/// Returns the general remedy for a token in the wrong place.
fn remedy_for_token(message: &str) -> Option<String> {
    let (_, got) = message.split_once(", got ")?;
    Some(match got {
        "<eof>" => "the script ends too early: complete its last statement".to_owned(),
        got => format!("complete the code before {got}, or remove {got}"),
    })
}

/// Returns the remedy for signs that Lua lacks.
fn remedy_for_sign(code: &str) -> Option<&'static str> {
    let start = code.trim_start();
    if start.starts_with('#') {
        return Some("write comments with --");
    }
    if start.starts_with('$') {
        return Some("write names with letters, digits and _; a setting is a field of an object or a param");
    }
    if let Some((_, remedy)) = SIGNS.iter().find(|(sign, _)| code.contains(sign)) {
        return Some(remedy);
    }
    if code.contains("<close>") {
        return Some("write local x = 5: variables have no attributes");
    }
    if code.contains("//") {
        return Some("write comments with --; the sign // divides and rounds down");
    }
    let list = code.match_indices('[').any(|(at, _)| {
        let before = code[..at].trim_end();
        before.is_empty() || before.ends_with(['=', '(', ',', '{', '[']) || before.ends_with("return")
    });
    let is_key = code.contains("] =") || code.contains("]=");
    if list && !is_key {
        return Some("write lists and branches with braces: { 1, 2 }");
    }
    if code.contains('!') {
        return Some("write not");
    }
    if code.contains(" ? ") && code.contains(" : ") {
        return Some("write a choice as if a then b else c");
    }
    None
}

/// Returns the remedy for keywords of other languages.
fn remedy_for_word(code: &str, message: &str) -> Option<&'static str> {
    let names = names_of(code);
    let has = |word: &str| names.iter().any(|(_, name)| *name == word);
    let first = names.first().map_or("", |(_, name)| *name);
    let second = names.get(1).map_or("", |(_, name)| *name);
    let is_loop = matches!(first, "for" | "while");
    let is_open = !has("then") && !has("do");
    let has_colon = code.trim_end().ends_with(':') || is_open && code.contains(": ");
    let remedy = match first {
        "import" | "from" | "using" | "include" | "use" => {
            "load a file of the folder with local name = require(\"name\"); libraries such as math need no line"
        }
        "def" | "fn" | "func" | "proc" | "sub" => "write local function name(x) ... end",
        "class" | "struct" => {
            "write a type of objects with object(\"name\", { extends = turtle }), or a table"
        }
        "let" | "var" | "const" | "auto" | "int" | "float" | "double" => "write local x = 1",
        "try" | "except" | "catch" => "check values before they are used: scripts end at the first error",
        "switch" | "match" | "case" => "write if a == 1 then ... elseif a == 2 then ... end",
        "module" if code.contains('{') => "write local Name = module(\"Name\", \"x\")",
        "pass" => "leave it out: a block may be empty",
        _ if has("elif") || has("elsif") => "write elseif",
        _ if has("lambda") => "write function(x) return x end",
        _ if is_loop && has("range") => "write for i = 1, 5 do ... end",
        "for" if code.contains('(') && code.contains(';') => "write for i = 1, 5 do ... end",
        "foreach" => "write for _, value in list do ... end",
        "else" if second == "if" && message.contains("end") => "write elseif, or one end more",
        "if" | "elseif" | "else" if has_colon => "write if a then ... end, without a colon",
        "for" | "while" if has_colon => {
            "write for i = 1, 5 do ... end or while a do ... end, without a colon"
        }
        _ => return None,
    };
    Some(remedy)
}

/// Returns the remedy for a message that names the fault itself.
fn remedy_for_message(message: &str, here: &str, before: &str) -> Option<&'static str> {
    let got = message.rsplit_once(", got ").map_or("", |(_, got)| got);
    let is = |sign: &str| got.starts_with(&format!("'{sign}'"));
    if message.starts_with("Expected 'then'") || message.starts_with("Expected 'do'") {
        return Some(match is("=") {
            true => "write == to compare: if n == 0 then",
            false if is("{") => "write if a then ... end, or for i = 1, 5 do ... end: blocks have no braces",
            false if message.contains("then") => "write then after the condition: if n > 1 then",
            false => "write do after the head of the loop: for i = 1, 5 do",
        });
    }
    if message.starts_with("Expected function call arguments")
        || message.contains("when parsing function call")
    {
        return Some("call methods with parentheses: system:derive()");
    }
    if message.starts_with("Expected ')'") && is("=") {
        return Some("give named values in a table: lsystem({ object = turtle() })");
    }
    if message.contains("(to close 'function'") && is("{")
        || here.contains(") {") && here.contains("function")
    {
        return Some("write function(x) ... end: bodies have no braces");
    }
    if message.starts_with("Expected ',' after table") {
        return Some("write a comma between two fields: { a = 1, b = 2 }");
    }
    let is_end_due = message.starts_with("Expected 'end'") || message.starts_with("Expected <eof>");
    if is_end_due && here.trim_start().starts_with("return") {
        return Some("write a comma between two values: return F(1), F(2)");
    }
    if message.contains("Expected 'end'") && before.starts_with("return") {
        return Some("put return last in its block: what follows it would never run");
    }
    if message.starts_with("Expected identifier") && ["+", "-", "/", "&", "^", "|", "*"].into_iter().any(is) {
        return Some(
            "write modules by their names: Turn(30), or the whole successor as a string: system:rule(\"F\", \"F[+F]F\")",
        );
    }
    if message.starts_with("Incomplete statement") {
        return Some("assign the value, local x = 1, or call a function: print(x)");
    }
    if message.starts_with("Malformed string") {
        return Some("close the string in its line, or write it with [[ and ]] or as several joined by ..");
    }
    None
}

/// Returns the remedy for a block without `end`.
fn remedy_for_block(message: &str, lines: &[String], line: usize) -> Option<String> {
    let is_missing = message.starts_with("Expected 'end'") || message.starts_with("Expected 'until'");
    // An `end` that closed an inner block is followed by the rest of the outer call.
    let here = lines.get(line.wrapping_sub(1)).map_or("", |code| code.trim_start());
    let is_early = message.starts_with("Expected identifier") && here.starts_with("end");
    if !is_missing && !is_early {
        return None;
    }
    let opener = find_unclosed(lines.get(..line).unwrap_or(lines))?;
    let keyword = opener.keyword;
    Some(match keyword.as_str() {
        "repeat" => format!("write until for the repeat in line {}", opener.line),
        _ => format!("write end for the {keyword} in line {}", opener.line),
    })
}

/// Returns the remedy for a bracket that stays open, which the message names.
fn remedy_for_bracket(message: &str) -> Option<String> {
    let sign = message.strip_prefix("Expected '")?.split('\'').next()?;
    let place = message.split_once("(to close '")?.1;
    let (opening, place) = place.split_once("' at ")?;
    let place = place.split(')').next()?;
    matches!(sign, ")" | "}" | "]")
        .then(|| format!("write {sign} for the {opening} at {place}, or a comma between two values"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_error_on_a_line_of_plain_lua_has_no_remedy_for_another_language() {
        for (message, text, remedy) in [
            (
                "Expected identifier when parsing expression, got ','",
                "local x = f(,)",
                Some("complete the code before ',', or remove ','"),
            ),
            ("Ambiguous syntax", "local t = { [1] = 2, [\"a\"] = 3 }", None),
            (
                "Expected identifier, got '1'",
                "local 1 = 2",
                Some("complete the code before '1', or remove '1'"),
            ),
        ] {
            let error = explain_syntax(Error::syntax(message).at_line("s.lua", 1), text);
            assert_eq!(error.remedy(), remedy, "{text}");
        }
    }

    #[test]
    fn a_text_or_a_comment_is_no_slip() {
        let error = Error::syntax("Expected identifier, got '1'").at_line("s.lua", 1);
        let error = explain_syntax(error, "local 1 = \"a != b ** [c]\" -- && def");
        assert_eq!(error.remedy(), Some("complete the code before '1', or remove '1'"));
    }
}
