//! Patterns such as `A B < S(x) > C [D] E`, and their parser.

use super::chain::{DEEPEST, Symbol};
use super::symbols::{NameScope, Symbols, count_text};
use burgeon_base::error::{Error, Result};

/// Maximum number of characters of a pattern that an error shows before its position, and after it.
const AROUND: usize = 100;

/// A predecessor with its contexts.
#[derive(Debug, Clone, PartialEq)]
pub struct Pattern {
    /// Left context, as written: the last module is the nearest.
    pub left: Vec<Item>,
    /// Module to be rewritten.
    pub predecessor: Item,
    /// Right context, as written.
    pub right: Vec<Context>,
    /// Names of all formal parameters, in the order in which they are written.
    pub formals: Vec<String>,
    /// Text of the pattern, with single spaces.
    pub text: String,
}

/// A module of a pattern.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Item {
    /// Symbol of the module.
    pub symbol: Symbol,
    /// Number of parameters that are bound to names: all, or none if the module is written without parameters.
    pub bound: usize,
}

/// An element of a right context.
#[derive(Debug, Clone, PartialEq)]
pub enum Context {
    /// A module on the main path.
    Module(Item),
    /// A branch that begins with these elements.
    Branch(Vec<Context>),
}

impl Pattern {
    /// Parses a pattern; its symbols must be declared in `symbols`.
    ///
    /// ```
    /// use burgeon_rewriting::{Context, Pattern, Signature, Symbols};
    ///
    /// let mut symbols = Symbols::default();
    /// let apex = symbols.declare(Signature::new("Apex", &["length".into()])?)?;
    /// let leaf = symbols.declare(Signature::new("Leaf", &[])?)?;
    /// let pattern = Pattern::parse("Apex(l)<Apex(m)>[Leaf] Apex", &symbols)?;
    /// assert_eq!((pattern.predecessor.symbol, pattern.left[0].symbol), (apex, apex));
    /// assert_eq!(pattern.formals, ["l", "m"]);
    /// assert!(matches!(&pattern.right[0], Context::Branch(inner) if inner.len() == 1));
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
        PatternReader { text, at: 0, depth: 0, symbols, scope, formals: Vec::new() }.pattern()
    }

    /// Returns the names of the arguments of a rule's functions, without `this`, each with its index. These are the
    /// formal parameters, and the declared parameters of the predecessor whose names no formal parameter has.
    ///
    /// ```
    /// use burgeon_rewriting::{Pattern, Signature, Symbols};
    ///
    /// let mut symbols = Symbols::default();
    /// symbols.declare(Signature::new("Stem", &["length".into(), "age".into()])?)?;
    /// let pattern = Pattern::parse("Stem(l, a) > Stem(next, old)", &symbols)?;
    /// let names: Vec<_> = pattern.arguments(&symbols).into_iter().map(|(_, name)| name).collect();
    /// assert_eq!(names, ["l", "a", "next", "old", "length", "age"]);
    /// # Ok::<(), burgeon_base::Error>(())
    /// ```
    pub fn arguments<'a>(&'a self, symbols: &'a Symbols) -> Vec<(usize, &'a str)> {
        let formals = self.formals.iter().map(String::as_str);
        let own: usize = self.left.iter().map(|item| item.bound).sum();
        let declared =
            symbols.signature(self.predecessor.symbol).parameters.iter().take(self.predecessor.bound);
        let declared = (own..).zip(declared.map(String::as_str));
        let mut arguments: Vec<(usize, &str)> = formals.enumerate().collect();
        for (place, name) in declared {
            if !self.formals.iter().any(|formal| formal == name) {
                arguments.push((place, name));
            }
        }
        arguments
    }

    /// Returns the context modules in the order in which [`Bindings`](super::matching::Bindings) lists them.
    pub fn context_items(&self) -> Vec<Item> {
        fn flatten(contexts: &[Context], items: &mut Vec<Item>) {
            for context in contexts {
                match context {
                    Context::Module(item) => items.push(*item),
                    Context::Branch(inner) => flatten(inner, items),
                }
            }
        }
        let mut items = self.left.clone();
        flatten(&self.right, &mut items);
        items
    }
}

struct PatternReader<'a> {
    text: &'a str,
    at: usize,
    /// Number of branches that are open at the current position.
    depth: usize,
    symbols: &'a Symbols,
    scope: &'a NameScope,
    formals: Vec<String>,
}

impl PatternReader<'_> {
    fn pattern(mut self) -> Result<Pattern> {
        let mut groups: Vec<Vec<Context>> = vec![Vec::new()];
        let mut separators: Vec<char> = Vec::new();
        loop {
            match self.peek() {
                None => break,
                Some(separator @ ('<' | '>')) => {
                    if separators.contains(&separator) || (separator == '<' && !separators.is_empty()) {
                        return Err(
                            self.error_here("a pattern is: left context < predecessor > right context")
                        );
                    }
                    self.at += 1;
                    separators.push(separator);
                    groups.push(Vec::new());
                }
                Some(_) => {
                    let context = self.context()?;
                    if let Some(group) = groups.last_mut() {
                        group.push(context);
                    }
                }
            }
        }
        let mut groups = groups.into_iter();
        let mut take = || groups.next().unwrap_or_default();
        let left = if separators.contains(&'<') { take() } else { Vec::new() };
        let middle = take();
        let right = if separators.contains(&'>') { take() } else { Vec::new() };
        for (separator, group) in [('<', &left), ('>', &right)] {
            if separators.contains(&separator) && group.is_empty() {
                return Err(self.error(
                    &format!("the context next to {separator} is empty"),
                    "add a module, or remove the separator",
                ));
            }
        }
        let predecessor = match middle.as_slice() {
            [Context::Module(item)] => *item,
            [] => return Err(self.error("missing predecessor", "add the module to be rewritten")),
            _ => {
                return Err(self.error(
                    "more than one predecessor",
                    "a rule rewrites one module; put the others into a context: A < B > C",
                ));
            }
        };
        let left = left
            .into_iter()
            .map(|context| match context {
                Context::Module(item) => Ok(item),
                Context::Branch(_) => Err(self.error(
                    "a left context cannot have branches",
                    "it is the path towards the axiom; write only the modules on it",
                )),
            })
            .collect::<Result<_>>()?;
        let text = self.text.split_whitespace().collect::<Vec<_>>().join(" ");
        Ok(Pattern { left, predecessor, right, formals: self.formals, text })
    }

    fn context(&mut self) -> Result<Context> {
        if self.peek() != Some('[') {
            return self.item().map(Context::Module);
        }
        let begin = self.at;
        if self.depth == DEEPEST {
            return Err(self.error_here(&format!("branches are nested at most {DEEPEST} deep")));
        }
        self.depth += 1;
        self.at += 1;
        let mut inner = Vec::new();
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
                Some(_) => inner.push(self.context()?),
            }
        }
        self.depth -= 1;
        if inner.is_empty() {
            self.at = begin;
            return Err(self.error_here("a branch in a context must contain at least one module"));
        }
        Ok(Context::Branch(inner))
    }

    fn item(&mut self) -> Result<Item> {
        let begin = self.at;
        let name = self.module_name()?;
        let symbol = self.symbols.find_in(&name, self.scope).map_err(|error| {
            let text = format!("{} in the pattern \"{}\"", error.message(), self.text.trim());
            error.saying(text)
        })?;
        if self.peek() != Some('(') {
            return Ok(Item { symbol, bound: 0 });
        }
        self.at += 1;
        let mut bound = 0;
        while self.peek() != Some(')') {
            if bound > 0 {
                if self.peek() != Some(',') {
                    return Err(self.error_here("expected a comma or a closing bracket"));
                }
                self.at += 1;
            }
            let before = self.at;
            let formal = self.name("a parameter's name")?;
            if formal != "_" && self.formals.contains(&formal) {
                self.at = before;
                self.peek();
                return Err(self.error_here(&format!("duplicate parameter name {formal}")));
            }
            self.formals.push(formal);
            bound += 1;
        }
        self.at += 1;
        let signature = self.symbols.signature(symbol);
        if bound != signature.arity() {
            self.at = begin;
            return Err(self.error(
                &format!("{} has {}, not {bound}", signature.name, count_text(signature.arity())),
                &format!(
                    "it was declared as {}; write all parameters{} or no brackets",
                    signature.usage(),
                    if signature.required < signature.arity() { ", also the optional ones," } else { "" }
                ),
            ));
        }
        Ok(Item { symbol, bound })
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
            let package = package.to_owned();
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
            Some(c) => format!("unexpected '{c}'"),
            None => "unexpected end".to_owned(),
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
