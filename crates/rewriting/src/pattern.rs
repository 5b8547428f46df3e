//! Patterns such as `A B < S(x) T(0) > C [D] $`.

use std::sync::Arc;

use super::chain::Symbol;
use super::column_value::ColumnValue;
use super::symbols::Symbols;

/// A predecessor with its contexts.
#[derive(Debug, Clone, PartialEq)]
pub struct Pattern {
    /// Left context in the chain that the step writes, as written: the last module is the nearest.
    pub new_left: Vec<Item>,
    /// Set if nothing may precede the new left context on the path to the axiom.
    pub new_from_beginning: bool,
    /// Left context, as written: the last module is the nearest.
    pub left: Vec<Item>,
    /// Set if nothing may precede the left context on the path to the axiom.
    pub from_beginning: bool,
    /// Symbol of the first module to be rewritten.
    pub symbol: Symbol,
    /// Modules to be rewritten, at least one. They stand next to one another in the chain.
    pub predecessors: Vec<Item>,
    /// Right context, as written.
    pub right: Vec<Context>,
    /// Right context in the chain that the step writes, as written.
    pub new_right: Vec<Context>,
    /// Names of all formal parameters, in the order in which they are written.
    pub formals: Vec<String>,
    /// Text of the pattern, with single spaces.
    pub text: String,
}

/// A module of a pattern.
#[derive(Debug, Clone, PartialEq)]
pub struct Item {
    /// Symbols that match.
    pub symbols: SymbolSet,
    /// Number of parameters that are bound to names; 0 if the module is written without parameters.
    pub bound: usize,
    /// Parameters that must have a value, by their index, ascending. They are not bound to names.
    pub values: Vec<(usize, PatternValue)>,
}

/// Symbols that a module of a pattern matches.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
pub enum SymbolSet {
    /// One symbol.
    One(Symbol),
    /// One of several symbols.
    OneOf(Vec<Symbol>),
    /// Any module.
    Any,
}

/// Value of a parameter in a pattern.
#[derive(Debug, Clone, PartialEq)]
pub enum PatternValue {
    /// A value that columns contain: a number, `true`, `false` or `nil`.
    Stored(ColumnValue),
    /// A text.
    Text(Arc<str>),
}

/// An element of a right context.
#[derive(Debug, Clone, PartialEq)]
pub enum Context {
    /// A module on the main path.
    Module(Item),
    /// A branch that begins with these elements.
    Branch(Vec<Context>),
    /// The end of the branch or chain, `$`: no module follows on the main path.
    End,
}

impl SymbolSet {
    /// Returns the symbols that match; `None` if all do.
    pub fn listed(&self) -> Option<&[Symbol]> {
        match self {
            Self::One(symbol) => Some(std::slice::from_ref(symbol)),
            Self::OneOf(symbols) => Some(symbols),
            Self::Any => None,
        }
    }

    /// Returns true if the set lists `symbol`. A set of all symbols lists none.
    pub fn names(&self, symbol: Symbol) -> bool {
        self.listed().is_some_and(|symbols| symbols.contains(&symbol))
    }
}

impl Item {
    /// Creates an item without parameters.
    pub fn new(symbols: SymbolSet) -> Self {
        Self { symbols, bound: 0, values: Vec::new() }
    }

    /// Returns the symbol if the item matches every module with it, and no other.
    pub fn plain(&self) -> Option<Symbol> {
        match self.symbols {
            SymbolSet::One(symbol) if self.values.is_empty() => Some(symbol),
            _ => None,
        }
    }

    /// Returns the indices of the parameters that are bound to names.
    pub fn bound_places(&self) -> impl Iterator<Item = usize> {
        let has_value = |place: &usize| self.values.iter().any(|(valued, _)| valued == place);
        (0..if self.bound == 0 { 0 } else { self.bound + self.values.len() })
            .filter(move |place| !has_value(place))
    }

    /// Appends the arguments that a module with the parameters from `begin` of `params` provides.
    #[inline]
    pub fn push_arguments(&self, params: &[f64], begin: usize, arguments: &mut Vec<f64>) {
        if self.values.is_empty() {
            arguments.extend_from_slice(&params[begin..begin + self.bound]);
        } else {
            self.push_some(&params[begin..], arguments);
        }
    }

    #[inline(never)]
    fn push_some(&self, params: &[f64], arguments: &mut Vec<f64>) {
        arguments.extend(self.bound_places().map(|place| params[place]));
    }
}

impl Pattern {
    /// Returns the pattern with `text` as its text, in which white space outside of quotes becomes single spaces.
    #[must_use]
    pub fn with_text(self, text: &str) -> Self {
        Self { text: single_spaced(text), ..self }
    }

    /// Returns true if the pattern rewrites several modules at once.
    pub fn has_run(&self) -> bool {
        self.predecessors.len() > 1
    }

    /// Returns true if the pattern has a left context, or `^`.
    pub fn has_left(&self) -> bool {
        !self.left.is_empty() || self.from_beginning
    }

    /// Returns true if the pattern has a right context, or `$`.
    pub fn has_right(&self) -> bool {
        !self.right.is_empty()
    }

    /// Returns true if the pattern has a left context in the chain that the step writes: `A << B`.
    pub fn has_new_left(&self) -> bool {
        !self.new_left.is_empty() || self.new_from_beginning
    }

    /// Returns true if the pattern has a right context in the chain that the step writes: `A >> B`.
    pub fn has_new_right(&self) -> bool {
        !self.new_right.is_empty()
    }

    /// Returns the number of parameters of the rewritten modules that are bound to names.
    pub fn own_bound(&self) -> usize {
        self.predecessors.iter().map(|item| item.bound).sum()
    }

    /// Returns the number of parameters of the left contexts that are bound to names.
    pub fn left_bound(&self) -> usize {
        self.new_left.iter().chain(&self.left).map(|item| item.bound).sum()
    }

    /// Returns the names of the arguments of a rule's functions, without `this`, each with its index. These are the
    /// formal parameters, and the declared parameters of the rewritten modules whose names no formal parameter has.
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
        let mut arguments: Vec<(usize, &str)> = formals.enumerate().collect();
        let mut first = self.left_bound();
        for item in &self.predecessors {
            let SymbolSet::One(symbol) = item.symbols else {
                first += item.bound;
                continue;
            };
            let declared = &symbols.signature(symbol).parameters;
            for (index, name) in (first..).zip(item.bound_places().filter_map(|place| declared.get(place))) {
                if !arguments.iter().any(|(_, known)| known == name) {
                    arguments.push((index, name));
                }
            }
            first += item.bound;
        }
        arguments
    }

    /// Returns the context modules in the order in which the pattern names them.
    pub fn context_items(&self) -> Vec<Item> {
        fn flatten(contexts: &[Context], items: &mut Vec<Item>) {
            for context in contexts {
                match context {
                    Context::Module(item) => items.push(item.clone()),
                    Context::Branch(inner) => flatten(inner, items),
                    Context::End => {}
                }
            }
        }
        let mut items: Vec<Item> = self.new_left.iter().chain(&self.left).cloned().collect();
        flatten(&self.right, &mut items);
        flatten(&self.new_right, &mut items);
        items
    }
}

/// Returns `text` with single spaces, except for quoted texts in it.
pub(super) fn single_spaced(text: &str) -> String {
    let mut spaced = String::new();
    let mut quote: Option<char> = None;
    let mut letters = text.trim().chars();
    while let Some(letter) = letters.next() {
        match quote {
            None if letter.is_whitespace() => {
                if !spaced.ends_with(' ') {
                    spaced.push(' ');
                }
                continue;
            }
            None => quote = Some(letter).filter(|letter| matches!(letter, '"' | '\'')),
            Some(mark) if letter == mark => quote = None,
            Some(_) if letter == '\\' => {
                spaced.push(letter);
                spaced.extend(letters.next());
                continue;
            }
            Some(_) => {}
        }
        spaced.push(letter);
    }
    spaced
}
