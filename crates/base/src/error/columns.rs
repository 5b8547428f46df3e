//! Columns of a line that a message names.

use std::ops::Range;

/// Keywords of scripts, which messages use as words.
const KEYWORDS: [&str; 24] = [
    "a", "an", "and", "at", "by", "do", "else", "end", "for", "function", "if", "in", "is", "it", "local",
    "nil", "no", "not", "of", "or", "return", "the", "then", "to",
];

/// Signs of the operations that Luau's messages name.
const OPERATIONS: [(&str, &[&str]); 11] = [
    ("(add)", &["+"]),
    ("(sub)", &["-"]),
    ("(mul)", &["*"]),
    ("(div)", &["/"]),
    ("(idiv)", &["//"]),
    ("(mod)", &["%"]),
    ("(pow)", &["^"]),
    ("(unm)", &["-"]),
    ("attempt to concatenate", &[".."]),
    ("attempt to compare", &["<=", ">=", "<", ">"]),
    ("attempt to get length", &["#"]),
];

/// Returns the columns (characters, from 0) of the part of `line` that `message` names, if it is the only such part.
///
/// A message marks a letter of a text, or names a part in quotes, as a method or function, or by the operation that failed.
pub(super) fn find_columns(line: &str, message: &str) -> Option<Range<usize>> {
    if let Some(letter) = marked_letter(line, message) {
        return Some(letter..letter + 1);
    }
    let code = code_of(line);
    let found = quoted_parts(message)
        .find_map(|name| only(line, name).or_else(|| only(&code, name)))
        .or_else(|| {
            names(message).find_map(|name| only(&code, name).filter(|found| is_telling(&code, found)))
        })
        .or_else(|| operation(&code, message))
        .or_else(|| message.starts_with("attempt to call").then(|| only_call(&code)).flatten());
    let found = found?;
    // Blanked strings have the length of the line in bytes, but not its letters.
    let count = |end: usize| Some(line.get(..end)?.chars().count());
    Some(count(found.start)?..count(found.end)?)
}

/// Returns the column of the letter below which a message has a caret: its last two lines are a text, which may be cut, and
/// the caret. `None` if the text is not in `line` exactly once.
fn marked_letter(line: &str, message: &str) -> Option<usize> {
    const CUT: &str = "...";
    let mut lines = message.lines().rev();
    let (carets, text) = (lines.next()?, lines.next()?);
    let letter = carets.strip_suffix('^').filter(|spaces| spaces.chars().all(|space| space == ' '))?.len();
    let indent = text.chars().take_while(|letter| *letter == ' ').count().min(4);
    let text = text.get(indent..)?;
    let (begun, cut) = match text.strip_prefix(CUT) {
        Some(rest) => (rest, CUT.len()),
        None => (text, 0),
    };
    let begun = begun.strip_suffix(CUT).unwrap_or(begun);
    let mut places = line.match_indices(begun).map(|(at, _)| at);
    let (Some(at), None) = (places.next().filter(|_| !begun.is_empty()), places.next()) else { return None };
    Some(line[..at].chars().count() + letter.checked_sub(indent + cut)?)
}

/// Returns the texts of a message between quotes.
fn quoted_parts(message: &str) -> impl Iterator<Item = &str> {
    ['`', '\'', '"'].into_iter().flat_map(move |quote| {
        let parts = message.split(quote).skip(1).step_by(2);
        parts.filter(|part| !part.trim().is_empty() && part.len() <= 80)
    })
}

/// Returns the names of a message: the last part of `turtle:forward`, and words.
fn names(message: &str) -> impl Iterator<Item = &str> {
    let words = message.split(|letter: char| !letter.is_alphanumeric() && !matches!(letter, '_' | ':' | '.'));
    let words = words.map(|word| word.trim_matches([':', '.']));
    words
        .map(|word| word.rsplit([':', '.']).next().unwrap_or(word))
        .filter(|word| word.starts_with(|letter: char| letter.is_alphabetic() || letter == '_'))
        .filter(|word| !KEYWORDS.contains(word))
}

/// Returns the place of `name` in `line`, if it stands there once. A word counts as a whole only.
fn only(line: &str, name: &str) -> Option<Range<usize>> {
    let is_part = |letter: char| letter.is_alphanumeric() || letter == '_';
    let is_whole = |at: &usize| {
        let (before, after) = (&line[..*at], &line[*at + name.len()..]);
        let joined = |inner: Option<char>, outer: Option<char>| {
            inner.is_some_and(is_part) && outer.is_some_and(is_part)
        };
        !joined(name.chars().next(), before.chars().next_back())
            && !joined(name.chars().next_back(), after.chars().next())
    };
    let mut places = line.match_indices(name).map(|(at, _)| at).filter(is_whole);
    match (places.next(), places.next()) {
        (Some(at), None) => Some(at..at + name.len()),
        _ => None,
    }
}

/// Returns true if the word at `found` is a called or assigned name or a field, and not a word that happens to be in the
/// message too.
fn is_telling(code: &str, found: &Range<usize>) -> bool {
    let (before, after) = (code[..found.start].trim_end(), code[found.end..].trim_start());
    after.starts_with(['(', '{', '"', '\'', '['])
        || after.starts_with('=') && !after.starts_with("==")
        || before.ends_with([':', '.'])
}

/// Returns the place of the operation that failed, if the line has one of its kind.
fn operation(code: &str, message: &str) -> Option<Range<usize>> {
    let (_, signs) = OPERATIONS.iter().find(|(name, _)| message.contains(name))?;
    let mut places = Vec::new();
    for (at, _) in code.char_indices() {
        let Some(sign) = signs.iter().find(|sign| code[at..].starts_with(*sign)) else { continue };
        // A longer sign such as // or -> is another operation.
        let around = [code[..at].chars().next_back(), code[at + sign.len()..].chars().next()];
        let is_longer = around.iter().flatten().any(|letter| match *sign {
            "/" => *letter == '/',
            "-" => *letter == '>',
            "<" | ">" => matches!(letter, '=' | '<' | '>' | '-'),
            ".." => *letter == '.',
            _ => false,
        });
        if !is_longer {
            places.push(at..at + sign.len());
        }
    }
    match &places[..] {
        [place] => Some(place.clone()),
        _ => None,
    }
}

/// Returns the name of the only call of a line.
fn only_call(code: &str) -> Option<Range<usize>> {
    let is_part = |letter: char| letter.is_alphanumeric() || letter == '_';
    let calls = code.match_indices('(').filter_map(|(at, _)| {
        let name = code[..at].trim_end();
        let length: usize =
            name.chars().rev().take_while(|letter| is_part(*letter)).map(char::len_utf8).sum();
        let begin = name.len() - length;
        (length > 0 && !KEYWORDS.contains(&&name[begin..])).then_some(begin..name.len())
    });
    let mut calls =
        calls.filter(|call| !matches!(&code[call.clone()], "elseif" | "while" | "until" | "function"));
    match (calls.next(), calls.next()) {
        (Some(call), None) => Some(call),
        _ => None,
    }
}

/// Returns a line whose strings and comment are replaced by spaces of the same length in bytes.
fn code_of(line: &str) -> String {
    let mut code = String::with_capacity(line.len());
    let mut quote: Option<char> = None;
    let mut is_escaped = false;
    for (at, letter) in line.char_indices() {
        if quote.is_none() && line[at..].starts_with("--") {
            code.extend(std::iter::repeat_n(' ', line.len() - at));
            break;
        }
        match quote {
            Some(open) => {
                let ends = letter == open && !is_escaped;
                is_escaped = letter == '\\' && !is_escaped;
                match ends {
                    true => {
                        quote = None;
                        code.push(letter);
                    }
                    false => code.extend(std::iter::repeat_n(' ', letter.len_utf8())),
                }
            }
            None => {
                // A text between backticks contains code, so it is kept.
                quote = Some(letter).filter(|letter| matches!(letter, '"' | '\''));
                code.push(letter);
            }
        }
    }
    code
}

#[cfg(test)]
mod tests {
    use super::*;

    fn found<'a>(line: &'a str, message: &str) -> Option<&'a str> {
        let columns = find_columns(line, message)?;
        let at = |column: usize| line.char_indices().nth(column).map_or(line.len(), |(at, _)| at);
        Some(&line[at(columns.start)..at(columns.end)])
    }

    #[test]
    fn the_part_that_a_message_names_is_found() {
        for (line, message, part) in [
            ("print(t.size.width)", "attempt to index nil with 'width'", "width"),
            ("local é = turtle({ wdth = 3 })", "unknown field `wdth` in turtle", "wdth"),
            ("this:forward(1, 2):turn(3)", "turtle:forward takes 1 argument, not 2", "forward"),
            ("local x = a + b * c -- +", "attempt to perform arithmetic (add) on nil and number", "+"),
            ("if x < 3 then", "attempt to compare nil < number", "<"),
            ("local x = grow(1)", "attempt to call a nil value", "grow"),
            ("this:roof({ kind = \"hipp\" })", "footprint:roof: kind: \"hipp\" is not a roof", "hipp"),
            ("return Leaf(1), B()", "Leaf has no parameters, not 1", "Leaf"),
            ("turtle({ width = \"a\" })", "turtle: width must be a number, not \"a\"", "a"),
        ] {
            assert_eq!(found(line, message), Some(part), "{line}: {message}");
        }
    }

    #[test]
    fn the_letter_above_the_caret_of_a_message_is_found() {
        let line = "s:rule(\"é(é(x)\", \"F\")";
        let message = "malformed pattern: unexpected '(' at character 3\n    é(é(x)\n      ^";
        assert_eq!(find_columns(line, message), Some(10..11));
        let cut = "malformed pattern: unexpected '(' at character 30\n    ...(é(x...\n        ^";
        assert_eq!(find_columns(line, cut), Some(10..11));
        assert_eq!(find_columns("f(\"F\", \"F\")", "malformed: unexpected end\n    F\n     ^"), None);
    }

    #[test]
    fn an_ambiguous_part_is_not_found() {
        for (line, message) in [
            ("local x = a + b + c", "attempt to perform arithmetic (add) on nil and number"),
            ("a.width = b.width", "attempt to index nil with 'width'"),
            ("local x = f(g(1))", "attempt to call a nil value"),
            ("local x = size + list", "the size is too large for a list"),
            ("", "unknown name x"),
            ("f('é')", "the sign \" '\" is wrong"),
        ] {
            assert_eq!(found(line, message), None, "{line}: {message}");
        }
    }

    #[test]
    fn strings_and_comments_keep_their_lengths() {
        for line in ["a('é\\'(' .. b) -- c", "x = \"unclosed", "`{a}` + 'b'"] {
            assert_eq!(code_of(line).len(), line.len());
        }
        assert_eq!(code_of("f('(') -- g(").trim_end(), "f(' ')");
    }
}
