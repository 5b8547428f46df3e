//! Rules that one call can apply to modules of which each depends on others of the same step.

use crate::chain::{CLOSE, END, OPEN, Symbol};
use crate::ignored::IgnoredSet;
use crate::pattern::{Context, Item, Pattern, SymbolSet};
use crate::symbols::FIRST_SYMBOL;

/// Rules of a grammar whose contexts in the new chain are single modules, so that one call can apply them to modules of which
/// each depends on the module before it.
///
/// The contexts must not require values, and must skip the same symbols. The rules of the same modules must have no weights.
#[derive(Debug, Clone)]
pub struct DependentRules {
    is_backward: bool,
    ignored_set: usize,
    ignored: IgnoredSet,
    contexts: Vec<Option<NewContext>>,
}

/// Context of a rule in the new chain that is one module.
#[derive(Debug, Clone)]
pub struct NewContext {
    /// Entry by symbol: true for the symbols that match.
    pub admitted: Box<[bool]>,
    /// Index of the first argument of the rule that the module provides.
    pub first_argument: usize,
    /// Number of arguments that the module provides: its first parameters.
    pub bound: usize,
}

impl DependentRules {
    /// Creates the rules whose contexts skip the set of `ignored` symbols with the number `ignored_set`. `contexts` has an entry
    /// for each rule of the grammar.
    pub(crate) fn new(
        is_backward: bool,
        (ignored_set, ignored): (usize, IgnoredSet),
        contexts: Vec<Option<NewContext>>,
    ) -> Self {
        Self { is_backward, ignored_set, ignored, contexts }
    }

    /// Returns true if contexts follow their modules (`A >> B`), so that modules are rewritten from right to left.
    pub fn is_backward(&self) -> bool {
        self.is_backward
    }

    /// Returns the number of the set of symbols that the contexts skip.
    pub fn ignored_set(&self) -> usize {
        self.ignored_set
    }

    /// Returns true if the contexts skip `symbol`.
    #[inline]
    pub fn is_ignored(&self, symbol: Symbol) -> bool {
        self.ignored.contains(symbol)
    }

    /// Returns the context of rule number `rule` in the new chain, if it has one that is a single module.
    #[inline]
    pub fn context(&self, rule: u16) -> Option<&NewContext> {
        self.contexts[usize::from(rule)].as_ref()
    }

    /// Returns the index in `symbols` of the module that is a context of the modules around them: the last one outside of
    /// branches that is not skipped, or the first one if modules are rewritten from right to left.
    pub(crate) fn nearest(&self, symbols: &[Symbol]) -> Option<usize> {
        let is_found = |symbol: &Symbol| *symbol > END && !self.is_ignored(*symbol);
        if let [symbol] = symbols {
            return is_found(symbol).then_some(0);
        }
        let mut depth = 0_i32;
        let mut outside = |index: &usize| {
            let symbol = symbols[*index];
            match symbol {
                OPEN => depth += 1,
                CLOSE => depth -= 1,
                _ => {}
            }
            depth == 0 && is_found(&symbol)
        };
        match self.is_backward {
            true => (0..symbols.len()).find(|index| outside(index)),
            false => (0..symbols.len()).rev().find(|index| outside(index)),
        }
    }
}

impl NewContext {
    /// Returns the context of `pattern` in the new chain, in a grammar of `symbols` symbols; `None` if it is not one module
    /// without required values.
    pub(crate) fn of(pattern: &Pattern, symbols: usize) -> Option<Self> {
        if pattern.new_from_beginning {
            return None;
        }
        let (item, is_first): (&Item, bool) = match (&*pattern.new_left, &*pattern.new_right) {
            ([item], []) => (item, true),
            ([], [Context::Module(item)]) => (item, false),
            _ => return None,
        };
        let admits = |symbol: usize| match &item.symbols {
            SymbolSet::One(one) => usize::from(*one) == symbol,
            SymbolSet::OneOf(several) => several.iter().any(|one| usize::from(*one) == symbol),
            SymbolSet::Any => symbol >= usize::from(FIRST_SYMBOL),
        };
        let first_argument = if is_first { 0 } else { pattern.formals.len().checked_sub(item.bound)? };
        item.values.is_empty().then(|| Self {
            admitted: (0..symbols).map(admits).collect(),
            first_argument,
            bound: item.bound,
        })
    }
}
