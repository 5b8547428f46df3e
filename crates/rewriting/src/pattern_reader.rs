//! Parser of patterns.

use super::chain::{DEEPEST, Symbol};
use super::column_value::ColumnValue;
use super::pattern::{Context, Item, Pattern, PatternValue, SymbolSet, single_spaced};
use super::symbols::{NameScope, Symbols, count_text};
use burgeon_base::error::{Error, Result};
use std::borrow::Cow;

/// Maximum number of characters of a pattern that an error shows before its position, and after it.
const AROUND: usize = 100;

/// Separators of a pattern, in their order. The predecessor stands between the second and the third.
const SEPARATORS: [&str; 4] = ["<<", "<", ">", ">>"];

/// Help for separators in another order.
const ORDER: &str = "a pattern is: left context < predecessor > right context; contexts in the new chain stand outside \
    of these: new left << left < predecessor > right >> new right";

/// Help for `^` at another position than the beginning.
const BEGINNING: &str = "^ is the beginning of the chain; write it first in a left context: ^ < A";
/// Help for `$` at another position than the end.
const ENDING: &str = "$ is the end of a branch or of the chain; write it last in a right context: A > B $";

impl Pattern {
    /// Parses a pattern; its symbols must be declared in `symbols`.
    ///
    /// ```
    /// use burgeon_rewriting::{Context, Pattern, Signature, Symbols};
    ///
    /// let mut symbols = Symbols::default();
    /// let apex = symbols.declare(Signature::new("Apex", &["length".into()])?)?;
    /// let leaf = symbols.declare(Signature::new("Leaf", &[])?)?;
    /// let pattern = Pattern::parse("Apex(l)<Apex(m)>[Leaf] Apex(0) $", &symbols)?;
    /// assert_eq!((pattern.symbol, pattern.left[0].plain()), (apex, Some(apex)));
    /// assert_eq!(pattern.formals, ["l", "m"]);
    /// assert!(matches!(&pattern.right[0], Context::Branch(inner) if inner.len() == 1));
    /// assert_eq!(pattern.right[2], Context::End);
    ///
    /// let error = Pattern::parse("Apex(l, m)", &symbols).expect_err("it has one parameter");
    /// assert!(error.message().contains("Apex"));
    /// # Ok::<(), burgeon_base::error::Error>(())
    /// ```
    pub fn parse(text: &str, symbols: &Symbols) -> Result<Self> {
        Self::parse_in(text, symbols, &NameScope::default())
    }

    /// Parses a pattern whose names are resolved in `scope`; see [`Symbols::find_in`].
    pub fn parse_in(text: &str, symbols: &Symbols, scope: &NameScope) -> Result<Self> {
        PatternReader::new(text, symbols, scope).pattern()
    }
}

/// Reader of one pattern.
struct PatternReader<'a> {
    text: &'a str,
    at: usize,
    /// Number of branches that are open at the current position.
    depth: usize,
    symbols: &'a Symbols,
    scope: &'a NameScope,
    formals: Vec<String>,
}

/// PatternElement of a part of a pattern, before the kind of the part is known.
enum PatternElement {
    Context(Context),
    /// `^`
    Beginning,
}

/// Elements between two separators, each with its position.
type PatternSection = Vec<(usize, PatternElement)>;

impl<'a> PatternReader<'a> {
    fn new(text: &'a str, symbols: &'a Symbols, scope: &'a NameScope) -> Self {
        Self { text, at: 0, depth: 0, symbols, scope, formals: Vec::new() }
    }

    fn pattern(mut self) -> Result<Pattern> {
        let mut parts: Vec<PatternSection> = vec![Vec::new()];
        let mut separators: Vec<&str> = Vec::new();
        loop {
            match self.peek() {
                None => break,
                Some('<' | '>') => {
                    let rest = &self.text[self.at..];
                    // Two characters come first, because one is their beginning.
                    let place =
                        SEPARATORS.iter().position(|known| known.len() == 2 && rest.starts_with(known));
                    let place = place.or_else(|| SEPARATORS.iter().position(|known| rest.starts_with(known)));
                    let separator = SEPARATORS[place.unwrap_or_default()];
                    let order = |known: &&str| SEPARATORS.iter().position(|other| other == known);
                    if separators.last().and_then(order).is_some_and(|last| Some(last) >= place) {
                        return Err(self.error_here(ORDER));
                    }
                    self.at += separator.len();
                    separators.push(separator);
                    parts.push(Vec::new());
                }
                Some(_) => {
                    let begin = self.at;
                    let element = self.element()?;
                    if let Some(part) = parts.last_mut() {
                        part.push((begin, element));
                    }
                }
            }
        }
        let is_left = |separator: &&&str| separator.starts_with('<');
        let middle_place = separators.iter().filter(is_left).count();
        for (place, separator) in separators.iter().enumerate() {
            let context = if place < middle_place { place } else { place + 1 };
            if parts[context].is_empty() {
                return Err(self.error(
                    &format!("the context next to {separator} is empty"),
                    "add a module, or remove the separator",
                ));
            }
        }
        let middle = std::mem::take(&mut parts[middle_place]);
        let mut section = |separator: &str| {
            let place = separators.iter().position(|known| *known == separator)?;
            Some(std::mem::take(&mut parts[if place < middle_place { place } else { place + 1 }]))
        };
        let [new_left, left, right, new_right] =
            SEPARATORS.map(|separator| section(separator).unwrap_or_default());
        let (symbol, predecessors) = self.predecessors(middle)?;
        let (new_from_beginning, new_left) = self.left_context(new_left)?;
        let (from_beginning, left) = self.left_context(left)?;
        let right = self.right_context(right)?;
        let new_right = self.right_context(new_right)?;
        let text = single_spaced(self.text);
        let formals = self.formals;
        Ok(Pattern {
            new_left,
            new_from_beginning,
            left,
            from_beginning,
            symbol,
            predecessors,
            right,
            new_right,
            formals,
            text,
        })
    }

    /// Returns the predecessor's modules and the symbol of the first.
    fn predecessors(&mut self, part: PatternSection) -> Result<(Symbol, Vec<Item>)> {
        let mut items = Vec::new();
        for (begin, element) in part {
            let help = match element {
                PatternElement::Context(Context::Module(item)) => {
                    items.push(item);
                    continue;
                }
                PatternElement::Context(Context::Branch(_)) => {
                    return Err(self.error(
                        "a predecessor cannot have branches",
                        "its modules stand next to one another; put branches into the right context: A > [B]",
                    ));
                }
                PatternElement::Context(Context::End) => ENDING,
                PatternElement::Beginning => BEGINNING,
            };
            self.at = begin;
            return Err(self.error_here(help));
        }
        match items.first().map(|item| &item.symbols) {
            Some(SymbolSet::One(symbol)) => Ok((*symbol, items)),
            Some(_) => Err(self.error(
                "the first module of a predecessor needs one symbol",
                "write one rule for each symbol; * and (A|B) can only follow it, or stand in contexts",
            )),
            None => Err(self.error("missing predecessor", "add the module to be rewritten")),
        }
    }

    /// Returns whether the left context begins with the chain, and its modules.
    fn left_context(&mut self, part: PatternSection) -> Result<(bool, Vec<Item>)> {
        let mut items = Vec::new();
        let mut from_beginning = false;
        for (number, (begin, element)) in part.into_iter().enumerate() {
            let help = match element {
                PatternElement::Context(Context::Module(item)) => {
                    items.push(item);
                    continue;
                }
                PatternElement::Context(Context::Branch(_)) => {
                    return Err(self.error(
                        "a left context cannot have branches",
                        "it is the path towards the axiom; write only the modules on it",
                    ));
                }
                PatternElement::Beginning if number == 0 => {
                    from_beginning = true;
                    continue;
                }
                PatternElement::Beginning => BEGINNING,
                PatternElement::Context(Context::End) => ENDING,
            };
            self.at = begin;
            return Err(self.error_here(help));
        }
        Ok((from_beginning, items))
    }

    fn right_context(&mut self, part: PatternSection) -> Result<Vec<Context>> {
        let count = part.len();
        let mut contexts = Vec::new();
        for (number, (begin, element)) in part.into_iter().enumerate() {
            let help = match element {
                PatternElement::Beginning => BEGINNING,
                PatternElement::Context(Context::End) if number + 1 < count => ENDING,
                PatternElement::Context(context) => {
                    contexts.push(context);
                    continue;
                }
            };
            self.at = begin;
            return Err(self.error_here(help));
        }
        Ok(contexts)
    }

    fn element(&mut self) -> Result<PatternElement> {
        let context = match self.peek() {
            Some('^') => {
                self.at += 1;
                return Ok(PatternElement::Beginning);
            }
            Some('$') => {
                self.at += 1;
                Context::End
            }
            Some('[') => self.branch()?,
            Some('*') => {
                self.at += 1;
                if self.text[self.at..].starts_with('(') {
                    return Err(self.error_here(
                        "* matches modules with any number of parameters, so it names none of them",
                    ));
                }
                Context::Module(Item::new(SymbolSet::Any))
            }
            _ => Context::Module(self.item()?),
        };
        Ok(PatternElement::Context(context))
    }

    fn branch(&mut self) -> Result<Context> {
        let begin = self.at;
        if self.depth == DEEPEST {
            return Err(self.error_here(&format!("branches are nested at most {DEEPEST} deep")));
        }
        self.depth += 1;
        self.at += 1;
        let mut inner: PatternSection = Vec::new();
        loop {
            match self.peek() {
                Some(']') => {
                    self.at += 1;
                    break;
                }
                None => {
                    self.at = begin;
                    return Err(self.error_here("this branch is not closed"));
                }
                Some(_) => {
                    let at = self.at;
                    let element = self.element()?;
                    inner.push((at, element));
                }
            }
        }
        self.depth -= 1;
        if inner.is_empty() {
            self.at = begin;
            return Err(self.error_here("a branch in a context must contain at least one module"));
        }
        let end = self.at;
        let inner = self.right_context(inner)?;
        self.at = end;
        Ok(Context::Branch(inner))
    }

    /// Parses a module, or alternatives such as `(A|B)`, with parameters.
    fn item(&mut self) -> Result<Item> {
        let begin = self.at;
        let mut symbols = Vec::new();
        if self.peek() == Some('(') {
            self.at += 1;
            loop {
                symbols.push(self.symbol()?);
                match self.peek() {
                    Some('|') => self.at += 1,
                    Some(')') => break,
                    _ => return Err(self.error_here("expected | or ), as in (A|B)")),
                }
            }
            self.at += 1;
        } else {
            symbols.push(self.symbol()?);
        }
        let parameters = self.has_parameters();
        let (bound, values) = if parameters { self.parameters()? } else { (0, Vec::new()) };
        let count = bound + values.len();
        let other =
            symbols.iter().map(|symbol| self.symbols.signature(*symbol)).find(|it| it.arity() != count);
        if let Some(signature) = other.filter(|_| parameters) {
            self.at = begin;
            return Err(self.error(
                &format!("{} has {}, not {count}", signature.name, count_text(signature.arity())),
                &format!(
                    "it was declared as {}; write all parameters{} or no brackets",
                    signature.usage(),
                    if signature.required < signature.arity() { ", also the optional ones," } else { "" }
                ),
            ));
        }
        let symbols = match *symbols.as_slice() {
            [symbol] => SymbolSet::One(symbol),
            _ => SymbolSet::OneOf(symbols),
        };
        Ok(Item { symbols, bound, values })
    }

    fn symbol(&mut self) -> Result<Symbol> {
        let name = self.module_name()?;
        self.symbols.find_in(&name, self.scope).map_err(|error| {
            let text = format!("{} in the pattern \"{}\"", error.message(), self.text.trim());
            error.saying(text)
        })
    }

    /// Returns true if parameters follow. After a space, a bracket with `|` begins alternatives instead.
    fn has_parameters(&mut self) -> bool {
        let is_near = self.text[self.at..].starts_with('(');
        let is_open = self.peek() == Some('(');
        let inner = self.text[self.at..].split(')').next().unwrap_or_default();
        is_near || is_open && (!inner.contains('|') || inner.contains(['"', '\'']))
    }

    /// Parses the parameters of a module: the number of names, and the values with their indices.
    fn parameters(&mut self) -> Result<(usize, Vec<(usize, PatternValue)>)> {
        self.at += 1;
        let (mut count, mut values) = (0, Vec::new());
        while self.peek() != Some(')') {
            if count > 0 {
                if self.peek() != Some(',') {
                    return Err(self.error_here("expected a comma or a closing bracket"));
                }
                self.at += 1;
            }
            if let Some(value) = self.value()? {
                values.push((count, value));
            }
            count += 1;
        }
        self.at += 1;
        Ok((count - values.len(), values))
    }

    /// Parses a parameter: returns its value, or `None` for a name, which becomes a formal parameter.
    fn value(&mut self) -> Result<Option<PatternValue>> {
        let stored = |value| Ok(Some(PatternValue::Stored(value)));
        match self.peek() {
            Some(quote @ ('"' | '\'')) => return self.quoted(quote).map(Some),
            Some('-' | '.' | '0'..='9') => return stored(ColumnValue::Number(self.number()?)),
            _ => {}
        }
        let before = self.at;
        let formal = self.name("a parameter's name or a value")?;
        match formal.as_str() {
            "true" => return stored(ColumnValue::Boolean(true)),
            "false" => return stored(ColumnValue::Boolean(false)),
            "nil" => return stored(ColumnValue::Nil),
            _ => {}
        }
        if formal != "_" && self.formals.contains(&formal) {
            self.at = before;
            self.peek();
            return Err(self.error_here(&format!("duplicate parameter name {formal}")));
        }
        self.formals.push(formal);
        Ok(None)
    }

    fn number(&mut self) -> Result<f64> {
        let rest = &self.text[self.at..];
        let mut end = usize::from(rest.starts_with('-'));
        for (at, letter) in rest.char_indices().skip(end) {
            let after_exponent = rest[..at].ends_with(['e', 'E']);
            if !(letter.is_ascii_alphanumeric() || letter == '.' || after_exponent && "+-".contains(letter)) {
                break;
            }
            end = at + letter.len_utf8();
        }
        let is_decimal =
            rest[..end].trim_start_matches('-').starts_with(|c: char| c == '.' || c.is_ascii_digit());
        let number = rest[..end].parse::<f64>().ok().filter(|number| is_decimal && number.is_finite());
        let number = number.ok_or_else(|| self.error_here("expected a number such as 2, -1.5 or 1e-3"))?;
        self.at += end;
        Ok(number)
    }

    fn quoted(&mut self, quote: char) -> Result<PatternValue> {
        let begin = self.at;
        let mut text = String::new();
        let mut letters = self.text[begin + 1..].char_indices();
        while let Some((at, letter)) = letters.next() {
            match letter {
                letter if letter == quote => {
                    self.at = begin + 1 + at + 1;
                    return Ok(PatternValue::Text(text.into()));
                }
                '\\' => match letters.next() {
                    Some((_, escaped @ ('\\' | '"' | '\''))) => text.push(escaped),
                    _ => {
                        self.at = begin + 1 + at;
                        return Err(self.error_here("a backslash stands before a quote or a backslash"));
                    }
                },
                letter => text.push(letter),
            }
        }
        self.at = begin;
        Err(self.error_here("this text is not closed"))
    }

    /// Parses the name of a module, optionally with a package: `castle.Stone`.
    fn module_name(&mut self) -> Result<String> {
        self.peek();
        let rest = &self.text[self.at..];
        let is_of_package = |c: char| c.is_ascii_lowercase() || c.is_ascii_digit() || "_-".contains(c);
        if let Some((package, _)) = rest.split_once('.')
            && package.starts_with(|c: char| c.is_ascii_lowercase())
            && package.chars().all(is_of_package)
        {
            self.at += package.len() + 1;
            if self.text[self.at..].starts_with(char::is_whitespace) {
                return Err(self.error_here("expected the name of a module of the package"));
            }
            return Ok(format!("{package}.{}", self.name("a module's name")?));
        }
        self.name("a module's name")
    }

    fn name(&mut self, what: &str) -> Result<String> {
        let rest = {
            self.peek();
            &self.text[self.at..]
        };
        let length = rest.find(|c: char| !(c.is_ascii_alphanumeric() || c == '_')).unwrap_or(rest.len());
        if length == 0 || rest.starts_with(|c: char| c.is_ascii_digit()) {
            return Err(self.error_here(&format!("expected {what}")));
        }
        self.at += length;
        Ok(rest[..length].to_owned())
    }

    /// Skips spaces, and returns the character at the new position.
    fn peek(&mut self) -> Option<char> {
        let rest = &self.text[self.at..];
        self.at += rest.len() - rest.trim_start().len();
        self.text[self.at..].chars().next()
    }

    /// Returns an error that shows the current position.
    fn error_here(&self, help: &str) -> Error {
        let found = match self.text[self.at..].chars().next() {
            Some(c) => format!("unexpected '{c}'").into(),
            None => Cow::Borrowed("unexpected end"),
        };
        let before = self.text[..self.at].chars().count();
        let shown = |c: char| if c.is_whitespace() { ' ' } else { c };
        let mut line: String =
            self.text.chars().skip(before.saturating_sub(AROUND)).take(2 * AROUND).map(shown).collect();
        let mut column = before.min(AROUND);
        if before > AROUND {
            line.insert_str(0, "...");
            column += 3;
        }
        if self.text.chars().count() > before.saturating_sub(AROUND) + 2 * AROUND {
            line.push_str("...");
        }
        let help = match self.text[self.at..].starts_with(':') {
            true => {
                "give conditions as an option: system:rule(\"F(n)\", { when = function(this, n) return n > 1 end }, ...)"
            }
            false => help,
        };
        Error::syntax(format!(
            "malformed pattern: {found} at character {}\n    {line}\n    {}^",
            before + 1,
            " ".repeat(column)
        ))
        .help(help)
    }

    fn error(&self, message: &str, help: &str) -> Error {
        Error::syntax(format!("malformed pattern \"{}\": {message}", self.text.trim())).help(help)
    }
}
