//! Search in the text of a script for functions that inspect tables, and for calls with string arguments.

/// Functions with which a script can inspect a table's entries.
const INSPECTORS: [&str; 6] = ["pairs", "next", "rawget", "getmetatable", "clone", "foreach"];

/// Functions through which rules can observe each step, or the chain before it.
const OBSERVERS: [&str; 2] = ["print", "query"];

/// Returns true if a script could distinguish a table that is created lazily from an existing table.
pub fn inspects_tables(text: &str) -> bool {
    contains_word(text, &INSPECTORS)
}

/// Returns true if functions of a script may print in a step, or ask for the chain before it.
pub fn observes_steps(text: &str) -> bool {
    contains_word(text, &OBSERVERS)
}

/// Returns true if functions of a script may ask for the chain before a step.
pub fn asks_for_chains(text: &str) -> bool {
    contains_word(text, &["query"])
}

fn contains_word(text: &str, words: &[&str]) -> bool {
    let apart = |letter: Option<char>| letter.is_none_or(|it| !it.is_alphanumeric() && it != '_');
    words.iter().any(|name| {
        text.match_indices(name).any(|(at, _)| {
            apart(text[..at].chars().next_back()) && apart(text[at + name.len()..].chars().next())
        })
    })
}

/// Returns the first arguments of the calls of `function` in `text` that are string literals, with escape sequences
/// unchanged. Ignores comments and other strings.
///
/// ```
/// use burgeon_language::analysis::calls_with_text;
///
/// let script = "local a = require('walls') -- require('old')\nlocal b = require \"roofs\"\n";
/// assert_eq!(calls_with_text(script, "require").collect::<Vec<_>>(), ["walls", "roofs"]);
/// ```
pub fn calls_with_text<'a>(text: &'a str, function: &'a str) -> impl Iterator<Item = &'a str> + use<'a> {
    let mut tokens = Tokens { rest: text };
    let mut called = 0;
    std::iter::from_fn(move || {
        loop {
            let token = tokens.next()?;
            called = match (called, token) {
                (0..=2, ScriptToken::Word(word)) if word == function => 1,
                (1, ScriptToken::Other('(')) => 2,
                (1 | 2, ScriptToken::Text(text)) => {
                    called = 0;
                    return Some(text);
                }
                _ => 0,
            };
        }
    })
}

/// A token of a script, as far as needed to find calls.
enum ScriptToken<'a> {
    Word(&'a str),
    Text(&'a str),
    Other(char),
}

struct Tokens<'a> {
    rest: &'a str,
}

impl<'a> Tokens<'a> {
    fn next(&mut self) -> Option<ScriptToken<'a>> {
        loop {
            self.rest = self.rest.trim_start();
            let Some(comment) = self.rest.strip_prefix("--") else { break };
            self.rest = match long_bracket(comment) {
                Some((_, after)) => after,
                None => comment.find('\n').map_or("", |end| &comment[end..]),
            };
        }
        if let Some((inner, after)) = long_bracket(self.rest) {
            self.rest = after;
            return Some(ScriptToken::Text(inner));
        }
        let first = self.rest.chars().next()?;
        let is_word = |c: char| c.is_alphanumeric() || c == '_';
        if is_word(first) {
            let end = self.rest.find(|c| !is_word(c)).unwrap_or(self.rest.len());
            let (word, after) = self.rest.split_at(end);
            self.rest = after;
            return Some(ScriptToken::Word(word));
        }
        self.rest = &self.rest[first.len_utf8()..];
        if !matches!(first, '"' | '\'' | '`') {
            return Some(ScriptToken::Other(first));
        }
        let mut escaped = false;
        let end = self.rest.find(|c| {
            let is_end = c == first && !escaped;
            escaped = c == '\\' && !escaped;
            is_end
        });
        let (inner, after) = self.rest.split_at(end.unwrap_or(self.rest.len()));
        self.rest = after.get(1..).unwrap_or("");
        Some(if first == '`' { ScriptToken::Other(first) } else { ScriptToken::Text(inner) })
    }
}

/// Returns the text between `[[` and `]]` at the start of `text`, and the text after it.
fn long_bracket(text: &str) -> Option<(&str, &str)> {
    let level = text.strip_prefix('[')?.find(|c| c != '=')?;
    let inner = text.get(level + 1..)?.strip_prefix('[')?;
    let end = format!("]{}]", "=".repeat(level));
    Some(inner.split_once(&end).unwrap_or((inner, "")))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn calls_are_found_and_comments_and_texts_are_not() {
        let script = "-- param(\"a\")\nlocal b = param( \"b\", {}) --[[ param(\"c\") ]] local d = param 'd'\n\
                      local t = \"param('e')\" local u = [==[ param(\"f\") ]==] local g = param(name)\n\
                      local h = params(\"h\") local i = `param(\"i\")` local k = param([[k]]) param";
        assert_eq!(calls_with_text(script, "param").collect::<Vec<_>>(), ["b", "d", "k"]);
        assert_eq!(calls_with_text("param(\"\\\"x", "param").count(), 1);
    }

    #[test]
    fn only_whole_names_of_functions_count() {
        assert!(
            inspects_tables("for k in pairs(t) do")
                && inspects_tables("table.clone(x)")
                && inspects_tables("next")
        );
        assert!(
            !inspects_tables("for k in ipairs(t) do")
                && !inspects_tables("next_door = 1")
                && !inspects_tables("f.geometry")
        );
    }
}
