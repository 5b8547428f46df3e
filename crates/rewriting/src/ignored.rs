//! Symbols that contexts skip.

use super::chain::{END, Symbol};

/// Set of symbols that the contexts of some rules skip.
#[derive(Debug, Clone)]
pub(crate) struct IgnoredSet {
    contains: Box<[bool]>,
    /// Set if a candidate with this set has a left context.
    pub needs_left: bool,
    /// Set if a candidate with this set has a right context.
    pub needs_right: bool,
}

impl IgnoredSet {
    /// Creates the set of those of `symbols` that are modules, in a grammar with `count` symbols.
    pub(crate) fn new(symbols: &[Symbol], count: usize) -> Self {
        let mut contains = vec![false; count];
        for symbol in symbols.iter().filter(|symbol| **symbol > END) {
            contains[usize::from(*symbol)] = true;
        }
        Self { contains: contains.into(), needs_left: false, needs_right: false }
    }

    /// Creates a set without symbols, for left and right contexts.
    pub(crate) fn none(count: usize) -> Self {
        Self { needs_left: true, needs_right: true, ..Self::new(&[], count) }
    }

    /// Creates the set of the symbols that all of `sets` contain, in a grammar with `count` symbols.
    pub(crate) fn of_all<'a>(sets: impl Iterator<Item = &'a Self> + Clone, count: usize) -> Self {
        let contains = (0..count).map(|symbol| sets.clone().all(|set| set.contains[symbol]));
        Self { contains: contains.collect(), needs_left: false, needs_right: false }
    }

    /// Creates the set of the symbols that any of `sets` contains, in a grammar with `count` symbols.
    pub(crate) fn of_any<'a>(sets: impl Iterator<Item = &'a Self> + Clone, count: usize) -> Self {
        let contains = (0..count).map(|symbol| sets.clone().any(|set| set.contains[symbol]));
        Self { contains: contains.collect(), needs_left: false, needs_right: false }
    }

    /// Returns true if contexts skip `symbol`.
    #[inline]
    pub(crate) fn contains(&self, symbol: Symbol) -> bool {
        self.contains[usize::from(symbol)]
    }

    /// Returns true if both sets contain the same symbols.
    pub(crate) fn has_same_symbols(&self, other: &Self) -> bool {
        self.contains == other.contains
    }
}
