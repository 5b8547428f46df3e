//! The patterns of a grammar in the form that matching uses, with numbered branches and tests.

use std::sync::Arc;

use rustc_hash::FxHashMap;

use super::chain::Symbol;
use super::column_value::ColumnValue;
use super::pattern::{Context, Item, Pattern, PatternValue, SymbolSet};
use super::symbols::FIRST_SYMBOL;
use super::text::ShowParameters;

/// An element of a context or of a predecessor.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum ContextElement {
    /// A module with this symbol.
    Module(Symbol),
    /// A module that passes the test with this number in the grammar.
    Test(u32),
    /// A branch that begins like the named branch with this number in the grammar.
    Branch(u32),
    /// No further module: the end of a branch or chain, or the beginning of the chain.
    End,
}

/// Condition on a module that is not only its symbol.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
pub(super) struct ModuleTest {
    symbols: SymbolSet,
    /// Index of a parameter, and number of the constant that it must equal.
    values: Box<[(usize, u32)]>,
}

impl ModuleTest {
    /// Returns true if a module with this symbol can pass.
    #[inline]
    pub(super) fn admits(&self, symbol: Symbol) -> bool {
        match &self.symbols {
            SymbolSet::One(one) => *one == symbol,
            SymbolSet::OneOf(several) => several.contains(&symbol),
            SymbolSet::Any => symbol >= FIRST_SYMBOL,
        }
    }

    /// Returns true if the parameters `params`, which begin with those of a module, have the required values.
    /// `constants` are those of the grammar in the current chain.
    #[inline]
    pub(super) fn holds(&self, params: &[f64], constants: &[f64]) -> bool {
        self.values.iter().all(|(place, constant)| {
            let (value, constant) = (params[*place], constants[*constant as usize]);
            // Values that are not numbers are stored as different NaN.
            #[allow(clippy::float_cmp, reason = "a pattern names an exact value")]
            let is_same = value == constant;
            is_same || value.to_bits() == constant.to_bits()
        })
    }
}

/// Value that no column contains, so that a text that no module has matches none.
const ABSENT: ColumnValue = ColumnValue::Handle(u32::MAX);

/// A value of a pattern.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
enum Constant {
    /// Bits of a value as columns store it.
    Stored(u64),
    Text(Arc<str>),
}

/// Patterns of a grammar: rules by number, and the branches, tests and values that they name, each stored once.
#[derive(Debug, Clone, Default)]
pub(super) struct CompiledPatterns {
    /// Left context of each rule, the nearest module first.
    pub lefts: Vec<Box<[ContextElement]>>,
    /// Modules that each rule rewrites.
    pub predecessors: Vec<Box<[ContextElement]>>,
    /// Right context of each rule.
    pub rights: Vec<Box<[ContextElement]>>,
    /// Left context of each rule in the new chain, the nearest module first.
    pub new_lefts: Vec<Box<[ContextElement]>>,
    /// Right context of each rule in the new chain.
    pub new_rights: Vec<Box<[ContextElement]>>,
    branches: Vec<Box<[ContextElement]>>,
    branch_numbers: FxHashMap<Box<[ContextElement]>, u32>,
    tests: Vec<ModuleTest>,
    test_numbers: FxHashMap<ModuleTest, u32>,
    constants: Vec<Constant>,
    constant_numbers: FxHashMap<Constant, u32>,
}

/// Returns the number of `item` in `list`, to which it is added if it is new.
fn number<T: Clone + Eq + std::hash::Hash>(
    list: &mut Vec<T>,
    numbers: &mut FxHashMap<T, u32>,
    item: T,
) -> u32 {
    let next = u32::try_from(list.len()).unwrap_or(u32::MAX);
    *numbers.entry(item).or_insert_with_key(|item| {
        list.push(item.clone());
        next
    })
}

impl CompiledPatterns {
    /// Adds the pattern of the next rule.
    pub(super) fn add(&mut self, pattern: &Pattern) {
        let new_left = self.left(&pattern.new_left, pattern.new_from_beginning);
        self.new_lefts.push(new_left);
        let left = self.left(&pattern.left, pattern.from_beginning);
        self.lefts.push(left);
        let predecessors = pattern.predecessors.iter().map(|item| self.module(item)).collect();
        self.predecessors.push(predecessors);
        let right = self.right(&pattern.right);
        self.rights.push(right);
        let new_right = self.right(&pattern.new_right);
        self.new_rights.push(new_right);
    }

    fn left(&mut self, items: &[Item], from_beginning: bool) -> Box<[ContextElement]> {
        let end = from_beginning.then_some(ContextElement::End);
        items.iter().rev().map(|item| self.module(item)).chain(end).collect()
    }

    fn module(&mut self, item: &Item) -> ContextElement {
        if let Some(symbol) = item.plain() {
            return ContextElement::Module(symbol);
        }
        let values = item.values.iter().map(|(place, value)| {
            let constant = match value {
                // 0 and -0 are the same number.
                PatternValue::Stored(ColumnValue::Number(number)) => {
                    Constant::Stored((number + 0.0).to_bits())
                }
                PatternValue::Stored(value) => Constant::Stored(value.pack().to_bits()),
                PatternValue::Text(text) => Constant::Text(Arc::clone(text)),
            };
            (*place, number(&mut self.constants, &mut self.constant_numbers, constant))
        });
        let test = ModuleTest { values: values.collect(), symbols: item.symbols.clone() };
        ContextElement::Test(number(&mut self.tests, &mut self.test_numbers, test))
    }

    fn right(&mut self, contexts: &[Context]) -> Box<[ContextElement]> {
        let ahead = contexts.iter().map(|context| match context {
            Context::Module(item) => self.module(item),
            Context::Branch(inner) => {
                let inner = self.right(inner);
                ContextElement::Branch(number(&mut self.branches, &mut self.branch_numbers, inner))
            }
            Context::End => ContextElement::End,
        });
        ahead.collect()
    }

    /// Returns the context elements of the branch with a number.
    #[inline]
    pub(super) fn branch(&self, number: u32) -> &[ContextElement] {
        &self.branches[number as usize]
    }

    /// Returns the number of branches.
    pub(super) fn branch_count(&self) -> usize {
        self.branches.len()
    }

    /// Returns the test with a number.
    #[inline]
    pub(super) fn test(&self, number: u32) -> &ModuleTest {
        &self.tests[number as usize]
    }

    /// Returns true if a pattern names a text that no module has, in the order of `constants`.
    pub(super) fn has_absent(constants: &[f64]) -> bool {
        constants.iter().any(|constant| constant.to_bits() == ABSENT.pack().to_bits())
    }

    /// Returns the values of patterns as the columns of the current chain contain them.
    pub(super) fn stored_constants<'a>(
        &'a self,
        values: &'a dyn ShowParameters,
    ) -> impl Iterator<Item = f64> + 'a {
        let absent = ABSENT.pack();
        self.constants.iter().map(move |constant| match constant {
            Constant::Stored(bits) => f64::from_bits(*bits),
            Constant::Text(text) => values.find_text(text).unwrap_or(absent),
        })
    }
}
