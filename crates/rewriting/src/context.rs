//! The right contexts of a grammar, with numbered branches.

use rustc_hash::FxHashMap;

use super::chain::Symbol;
use super::pattern::Context;

/// An element of a right context.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum ContextElement {
    /// A module on the main path.
    Module(Symbol),
    /// A branch that begins like the named branch with this number in the grammar.
    Branch(u32),
}

/// Branches that the contexts of a grammar name, each stored once.
#[derive(Debug, Clone, Default)]
pub struct Branches {
    list: Vec<Box<[ContextElement]>>,
    numbers: FxHashMap<Box<[ContextElement]>, u32>,
}

impl Branches {
    /// Returns the context elements of the branch with a number.
    #[inline]
    pub(super) fn get(&self, number: u32) -> &[ContextElement] {
        &self.list[number as usize]
    }

    /// Returns a right context with its branches replaced by their numbers.
    pub fn number(&mut self, contexts: &[Context]) -> Box<[ContextElement]> {
        let ahead = contexts.iter().map(|context| match context {
            Context::Module(item) => ContextElement::Module(item.symbol),
            Context::Branch(inner) => {
                let inner = self.number(inner);
                let next = u32::try_from(self.list.len()).unwrap_or(u32::MAX);
                let number = *self.numbers.entry(inner.clone()).or_insert(next);
                if number == next {
                    self.list.push(inner);
                }
                ContextElement::Branch(number)
            }
        });
        ahead.collect()
    }

    /// Returns the number of branches.
    pub fn len(&self) -> usize {
        self.list.len()
    }
}
