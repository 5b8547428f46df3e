//! L-systems as printed in books: strings of letters such as `F[+F]F`, read as modules, and as Lua.

use std::borrow::Cow;

use burgeon_base::error::{Error, Result, SourcePlace, shorten};
use burgeon_rewriting::{NameScope, Signature, Symbols};

/// Turtle symbols of *The Algorithmic Beauty of Plants* and cpfg, with the modules of the standard library.
const TURTLE: [(&str, &str); 24] = [
    ("@O", "Sphere"),
    ("@v", "Level"),
    ("f", "G"),
    ("+", "Left"),
    ("-", "Right"),
    ("\u{2212}", "Right"),
    ("\u{2013}", "Right"),
    ("&", "Down"),
    ("^", "Up"),
    ("\u{2227}", "Up"),
    ("\\", "RollLeft"),
    ("/", "RollRight"),
    ("|", "TurnAround"),
    ("$", "Level"),
    ("!", "Width"),
    ("#", "Width"),
    ("{", "BeginPolygon"),
    (".", "Point"),
    ("}", "EndPolygon"),
    (";", "Paint"),
    (",", "Paint"),
    ("~", "Place"),
    ("%", "Cut"),
    ("_", "SimpleElasticity"),
];

/// Symbols that errors list.
const LISTED: &str = "F G f + - & ^ \\ / | $ ! # { } . ; , ~ % _ @O @v [ ]";

/// Texts that stand for a successor without modules.
const ERASING: [&str; 3] = ["", "*", "\u{3b5}"];

/// Maximum number of values that a `return` lists; Luau has 255 registers.
const MOST_VALUES: usize = 100;

/// Maximum length (bytes) of a string in an error.
const SHOWN: usize = 200;

/// A piece of a string.
#[derive(Debug, Clone, PartialEq, Eq)]
enum StringItem<'a> {
    Open,
    Close,
    /// A line break, which the Lua text keeps, so that lines stay the same.
    Break,
    /// A part of a pattern that is no module: `<`, `>`, `*`, alternatives, and the ends `^` and `$`.
    Separator(&'a str),
    /// A module by its text, its name, and the text between its brackets.
    Module {
        text: &'a str,
        name: Cow<'a, str>,
        arguments: Option<&'a str>,
    },
    /// A character that is no module, with the text between its brackets.
    Unknown {
        text: &'a str,
        arguments: Option<&'a str>,
    },
}

/// Returns true if a successor is the body of a Lua function: if it contains the word `return`.
pub(super) fn is_lua(text: &str) -> bool {
    mentions(text, "return")
}

/// Returns true if `text` contains `name` as a whole word.
pub(super) fn mentions(text: &str, name: &str) -> bool {
    let is_word = |c: char| c.is_ascii_alphanumeric() || c == '_';
    text.match_indices(name)
        .any(|(at, _)| !text[..at].ends_with(is_word) && !text[at + name.len()..].starts_with(is_word))
}

/// Returns the body of a Lua function that returns the modules of a string. `formals` are the names of its parameters, or
/// `None` for an axiom. The string begins at `place`, if that is known.
pub(super) fn lua_body(
    text: &str,
    symbols: &Symbols,
    scope: &NameScope,
    formals: Option<&[String]>,
    place: Option<SourcePlace>,
) -> Result<String> {
    if ERASING.contains(&text.trim()) {
        return Ok("return nil".to_owned());
    }
    let items = StringReader::new(text, symbols, scope).items()?;
    let mut place = place;
    let (mut depth, mut values) = (0usize, 0usize);
    let mut lua = String::new();
    for item in &items {
        if let Some(error) = mistake(item, &items, symbols, scope, formals) {
            return Err(error.at(place));
        }
        values += usize::from(depth == 0);
        match item {
            StringItem::Break => {
                place = place.map(|place| SourcePlace { line: place.line + 1, ..place });
                lua.push('\n');
            }
            StringItem::Open => {
                depth += 1;
                lua.push_str("{ ");
            }
            StringItem::Close => {
                depth = depth.checked_sub(1).ok_or_else(|| {
                    Error::syntax(format!("read as {}: a ] closes no branch", split_text(&items)))
                        .help("remove it, or open the branch with [")
                        .at_place(place.as_ref())
                })?;
                lua.push_str("}, ");
            }
            StringItem::Module { name, arguments, .. } => {
                lua.push_str(&format!("{name}({}), ", arguments.unwrap_or_default()));
            }
            StringItem::Unknown { .. } | StringItem::Separator(_) => {}
        }
    }
    if depth > 0 {
        let error = Error::syntax(format!("read as {}: a branch is not closed", split_text(&items)));
        return Err(error.help("close it with ]"));
    }
    let list = lua.trim_end_matches([',', ' ', '\n']);
    Ok(match values > MOST_VALUES {
        true => format!("return table.unpack({{ {list} }})"),
        false => format!("return {list}"),
    })
}

/// Returns the error for an item of a string that is no module, or whose arguments are missing.
fn mistake(
    item: &StringItem,
    items: &[StringItem],
    symbols: &Symbols,
    scope: &NameScope,
    formals: Option<&[String]>,
) -> Option<Error> {
    match item {
        StringItem::Module { name, .. }
            if formals.is_some_and(|formals| formals.iter().any(|formal| formal == name)) =>
        {
            let error = Error::argument(format!("read as {}: {name} is also a parameter", split_text(items)));
            Some(error.help("give the parameter of the pattern another name"))
        }
        StringItem::Module { text, name, arguments: None } => {
            let signature = symbols.signature(symbols.find_in(name, scope).ok()?);
            (signature.required > 0).then(|| {
                let example = format!("{text}({})", signature.parameters[..signature.required].join(", "));
                Error::argument(format!(
                    "read as {}: {text} has no arguments, but it was declared as {}",
                    split_text(items),
                    signature.usage()
                ))
                .help(format!("write its arguments in brackets, such as {example}"))
            })
        }
        StringItem::Unknown { text, .. } | StringItem::Separator(text) => {
            let other = formals.map_or("", |_| ", or write the successor as a body of Lua with return");
            Some(unknown_item(text, &split_text(items), other))
        }
        _ => None,
    }
}

/// Returns a pattern in which turtle symbols, digits and joined letters are the names of modules.
pub(super) fn pattern_names(text: &str, symbols: &Symbols, scope: &NameScope) -> Result<String> {
    let items = StringReader::new(text, symbols, scope).pattern_items()?;
    let mut names = String::new();
    for item in &items {
        match item {
            StringItem::Break => {}
            StringItem::Open => names.push_str("[ "),
            StringItem::Close => names.push_str("] "),
            StringItem::Separator(text) => names.push_str(&format!("{text} ")),
            StringItem::Module { name, arguments: None, .. } => names.push_str(&format!("{name} ")),
            StringItem::Module { name, arguments: Some(arguments), .. } => {
                names.push_str(&format!("{name}({arguments}) "));
            }
            StringItem::Unknown { text, .. } => return Err(unknown_item(text, &split_text(&items), "")),
        }
    }
    names.truncate(names.trim_end().len());
    Ok(names)
}

/// Returns the names of the modules in a string such as `+-F`.
pub(super) fn string_names(text: &str, symbols: &Symbols, scope: &NameScope) -> Result<Vec<String>> {
    let items = StringReader::new(text, symbols, scope).items()?;
    let split = split_text(&items);
    let names = items.into_iter().map(|item| match item {
        StringItem::Module { name, arguments: None, .. } => Ok(name.into_owned()),
        StringItem::Unknown { text, .. } => Err(unknown_item(text, &split, "")),
        _ => Err(Error::argument(format!("read as {split}: only modules without brackets can be listed"))
            .help("write their names or symbols, such as \"+-F\"")),
    });
    names.collect()
}

/// Returns true if a text contains symbols that are no names, and so can only be a string of modules.
pub(super) fn has_symbols(text: &str) -> bool {
    // A name can contain an underscore, and that of a module of a package a hyphen and a full stop.
    let can_be_name = |symbol: &str| ["f", ".", "_"].contains(&symbol) || symbol == "-" && text.contains('.');
    TURTLE.iter().any(|(symbol, _)| text.contains(symbol) && !can_be_name(symbol))
}

/// Returns true if a pattern contains symbols that are no names, outside of parameters.
pub(super) fn has_pattern_symbols(text: &str) -> bool {
    let mut rest = text;
    let mut outside = String::new();
    while let Some((before, after)) = rest.split_once('(') {
        outside.push_str(before);
        rest = end_of_expression(after, |letter| letter == ')').map_or("", |end| &after[end + 1..]);
    }
    outside.push_str(rest);
    has_symbols(&outside.replace(['^', '$', '|'], ""))
}

/// Returns the signatures of the letters and digits in patterns and strings that are no modules, in the order in which
/// they occur. The parameters have the names of the first pattern that names all of them. Those that a string omits are
/// optional.
pub(crate) fn undeclared_letters(
    patterns: &[String],
    strings: &[String],
    symbols: &Symbols,
    scope: &NameScope,
) -> Result<Vec<Signature>> {
    struct Letter {
        name: String,
        least: Option<usize>,
        formals: Vec<String>,
        most: usize,
    }
    let mut letters: Vec<Letter> = Vec::new();
    let texts = patterns.iter().map(|text| (text, true)).chain(strings.iter().map(|text| (text, false)));
    for (text, is_pattern) in texts {
        if !is_pattern && (is_lua(text) || ERASING.contains(&text.trim())) {
            continue;
        }
        let reader = StringReader::new(text, symbols, scope);
        for item in if is_pattern { reader.pattern_items()? } else { reader.items()? } {
            let StringItem::Unknown { text, arguments } = item else { continue };
            let Some(name) = letter_name(text) else { continue };
            let arguments = arguments.map(split_arguments).unwrap_or_default();
            let index = letters.iter().position(|letter| letter.name == name).unwrap_or(letters.len());
            if index == letters.len() {
                let name = name.into_owned();
                letters.push(Letter { name, least: None, formals: Vec::new(), most: 0 });
            }
            let letter = &mut letters[index];
            letter.most = letter.most.max(arguments.len());
            if !is_pattern {
                letter.least = Some(letter.least.map_or(arguments.len(), |least| least.min(arguments.len())));
                continue;
            }
            let formals: Vec<String> = arguments.iter().map(|formal| formal.trim().to_owned()).collect();
            let names_more = are_names(&formals) && !are_names(&letter.formals);
            if formals.len() > letter.formals.len() || formals.len() == letter.formals.len() && names_more {
                letter.formals = formals;
            }
        }
    }
    let signature = |letter: Letter| {
        let least = letter.least.unwrap_or(letter.most);
        let named = letter.formals.len() == letter.most && are_names(&letter.formals);
        let parameters: Vec<String> = (0..letter.most)
            .map(|index| {
                let name = if named { letter.formals[index].clone() } else { format!("a{}", index + 1) };
                if index < least { name } else { format!("{name}?") }
            })
            .collect();
        Signature::new(&letter.name, &parameters)
    };
    letters.into_iter().map(signature).collect()
}

/// Returns true if all parameters of a pattern can be the names of parameters: none is `_` or a value.
fn are_names(formals: &[String]) -> bool {
    let is_name = |name: &String| {
        name.starts_with(|c: char| c.is_ascii_alphabetic() || c == '_')
            && !["_", "true", "false", "nil"].contains(&name.as_str())
    };
    formals.iter().all(is_name)
}

/// Returns the name of the module that a letter or a digit stands for.
fn letter_name(text: &str) -> Option<Cow<'_, str>> {
    let letter = text.chars().next().filter(|_| text.len() == 1)?;
    match letter {
        'A'..='Z' | 'a'..='z' => Some(Cow::Borrowed(text)),
        // A name cannot begin with a digit.
        '0'..='9' => Some(Cow::Owned(format!("_{text}"))),
        _ => None,
    }
}

/// Splits arguments at the commas outside of brackets and strings.
fn split_arguments(text: &str) -> Vec<&str> {
    if text.trim().is_empty() {
        return Vec::new();
    }
    let mut parts = Vec::new();
    let mut rest = text;
    loop {
        let end = end_of_expression(rest, |c| c == ',').unwrap_or(rest.len());
        parts.push(&rest[..end]);
        match rest.get(end + 1..) {
            Some(next) if end < rest.len() => rest = next,
            _ => return parts,
        }
    }
}

/// Returns the position of the first character outside of brackets and strings of Lua that `is_end` accepts.
fn end_of_expression(text: &str, is_end: impl Fn(char) -> bool) -> Option<usize> {
    let mut depth = 0usize;
    let mut quote: Option<char> = None;
    let mut letters = text.char_indices();
    while let Some((at, letter)) = letters.next() {
        match (quote, letter) {
            (Some(_), '\\') => {
                letters.next();
            }
            (Some(mark), letter) => quote = (letter != mark).then_some(mark),
            (None, letter) if depth == 0 && is_end(letter) => return Some(at),
            (None, '"' | '\'' | '`') => quote = Some(letter),
            (None, '(' | '{' | '[') => depth += 1,
            (None, ')' | '}' | ']') => depth = depth.saturating_sub(1),
            (None, _) => {}
        }
    }
    None
}

/// Formats a string as it was split.
fn split_text(items: &[StringItem]) -> String {
    let texts = items.iter().filter_map(|item| match item {
        StringItem::Open => Some(Cow::Borrowed("[")),
        StringItem::Close => Some(Cow::Borrowed("]")),
        StringItem::Break => None,
        StringItem::Separator(text) => Some(Cow::Borrowed(*text)),
        StringItem::Module { text, arguments, .. } | StringItem::Unknown { text, arguments } => {
            let called = arguments.map(|arguments| Cow::Owned(format!("{text}({arguments})")));
            Some(called.unwrap_or(Cow::Borrowed(*text)))
        }
    });
    shorten(&texts.collect::<Vec<_>>().join(" "), SHOWN).into_owned()
}

/// Returns the error for a character of a string that is no module, with another remedy for letters.
fn unknown_item(text: &str, split: &str, other: &str) -> Error {
    let error = Error::script(format!("read as {split}: {text} is no module"));
    match letter_name(text) {
        Some(name) => error.help(format!("declare it: local {name} = module(\"{name}\"){other}")),
        None => {
            error.help(format!("the symbols of the turtle are {LISTED}; declare modules with letters{other}"))
        }
    }
}

/// Reader of a string.
struct StringReader<'a> {
    text: &'a str,
    at: usize,
    symbols: &'a Symbols,
    scope: &'a NameScope,
    /// Set if the string is a pattern.
    is_pattern: bool,
    /// Set after `>`.
    is_right: bool,
    /// Set within `(A|B)`.
    in_alternatives: bool,
}

impl<'a> StringReader<'a> {
    fn new(text: &'a str, symbols: &'a Symbols, scope: &'a NameScope) -> Self {
        let (is_pattern, is_right, in_alternatives) = (false, false, false);
        Self { text, at: 0, symbols, scope, is_pattern, is_right, in_alternatives }
    }

    fn pattern_items(self) -> Result<Vec<StringItem<'a>>> {
        Self { is_pattern: true, ..self }.items()
    }

    /// Returns true if `letter`, after which the reader stands, is no module at this place of the pattern.
    fn is_separator(&self, letter: char, is_first: bool) -> bool {
        let rest = self.text[self.at..].trim_start();
        match letter {
            '*' | '(' => true,
            '|' | ')' => self.in_alternatives,
            '^' => is_first && rest.contains('<'),
            '$' => self.is_right && (rest.is_empty() || rest.starts_with(']')),
            _ => false,
        }
    }

    fn items(mut self) -> Result<Vec<StringItem<'a>>> {
        let names = self.names();
        let mut items = Vec::new();
        while let Some(letter) = self.text[self.at..].chars().next() {
            let begin = self.at;
            self.at += letter.len_utf8();
            match letter {
                '[' => items.push(StringItem::Open),
                ']' => items.push(StringItem::Close),
                '\n' => items.push(StringItem::Break),
                '<' | '>' => {
                    self.is_right = letter == '>';
                    // << and >> are separators of patterns, too.
                    self.at += usize::from(self.is_pattern && self.text[self.at..].starts_with(letter));
                    items.push(StringItem::Separator(&self.text[begin..self.at]));
                }
                letter if self.is_pattern && self.is_separator(letter, items.is_empty()) => {
                    self.in_alternatives = letter == '(' || self.in_alternatives && letter != ')';
                    if letter == ')' {
                        self.arguments("alternatives")?;
                    }
                    items.push(StringItem::Separator(&self.text[begin..self.at]));
                }
                letter if letter.is_whitespace() => {}
                _ => {
                    self.at = begin;
                    let item = self.module(&names)?;
                    items.push(item);
                }
            }
        }
        Ok(items)
    }

    /// Returns the names of the modules that strings can use, the longest first.
    fn names(&self) -> Vec<&'a str> {
        let known = self.symbols.names().filter(|name| self.text.contains(name));
        let mut names: Vec<&str> = known.filter(|name| self.is_module(name)).collect();
        names.sort_by_key(|name| std::cmp::Reverse(name.len()));
        names
    }

    fn is_module(&self, name: &str) -> bool {
        self.symbols.find_in(name, self.scope).is_ok()
    }

    fn module(&mut self, names: &[&'a str]) -> Result<StringItem<'a>> {
        let rest = &self.text[self.at..];
        let text_of = |name: &str| &rest[..name.len()];
        let declared = names
            .iter()
            .find(|name| rest.starts_with(**name))
            .map(|name| (text_of(name), Cow::Borrowed(*name)));
        let (text, name) = match declared {
            Some((text, name)) => (text, Some(name)),
            None => {
                let symbol =
                    TURTLE.iter().find(|(symbol, name)| rest.starts_with(symbol) && self.is_module(name));
                let first = rest.chars().next().map_or(0, char::len_utf8);
                match symbol {
                    Some((symbol, name)) => (text_of(symbol), Some(Cow::Borrowed(*name))),
                    None => {
                        let text = &rest[..first];
                        (text, letter_name(text).filter(|name| self.is_module(name)))
                    }
                }
            }
        };
        self.at += text.len();
        let arguments = self.arguments(text)?;
        Ok(match name {
            Some(name) => StringItem::Module { text, name, arguments },
            None => StringItem::Unknown { text, arguments },
        })
    }

    /// Reads the arguments of the module `text`, if a bracket follows it.
    fn arguments(&mut self, text: &str) -> Result<Option<&'a str>> {
        let Some(rest) = self.text[self.at..].strip_prefix('(') else { return Ok(None) };
        let Some(end) = end_of_expression(rest, |letter| letter == ')') else {
            let from = shorten(&self.text[self.at..], 40).into_owned();
            return Err(Error::syntax(format!("the arguments of {text} in \"{text}{from}\" are not closed"))
                .help("close them with )"));
        };
        self.at += end + 2;
        Ok(Some(&rest[..end]))
    }
}
