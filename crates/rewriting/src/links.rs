//! Neighbours along the tree, found once per step, so that matching a context costs O(1) per context module.

use std::sync::OnceLock;
use std::sync::atomic::{AtomicU32, Ordering};

use super::chain::{CLOSE, Chain, END, OPEN};
use super::grammar::Grammar;
use super::text::{PlainNumbers, ShowParameters};

/// Index that means no neighbour.
pub(super) const NONE: u32 = u32::MAX;

/// Neighbours of every symbol of a chain, in columns. Only the columns that the grammar's contexts need are filled.
#[derive(Debug, Default)]
pub struct Links {
    /// Nearest module towards the axiom that is not ignored. A closed branch is not on that path.
    pub(crate) left: Vec<u32>,
    /// For [`OPEN`] its closing bracket; for a module the next module on its own branch that is not ignored; for
    /// [`CLOSE`] the first such module after the branch.
    pub(crate) right: Vec<u32>,
    /// First branch at or after the symbol on the symbol's own branch, with only ignored modules before it.
    pub(crate) branch: Vec<u32>,
    /// Index of each symbol's first parameter.
    pub param: Vec<u32>,
    /// Values of the grammar's patterns as the chain contains them.
    pub(crate) constants: Vec<f64>,
    /// Cached search results for each branch that the grammar names.
    known: Vec<OnceLock<BranchSearches>>,
    stack: Vec<u32>,
}

/// Search results of a step for one named branch, by the opening bracket at which a search passed. All threads add
/// results; the result for a bracket is always the same.
#[derive(Debug)]
pub struct BranchSearches(Vec<AtomicU32>);

/// Index that means no cached result; an opening bracket never has so large an index.
const UNKNOWN: u32 = NONE - 1;

impl BranchSearches {
    pub fn get(&self, open: u32) -> Option<u32> {
        let found = self.0[open as usize].load(Ordering::Relaxed);
        (found != UNKNOWN).then_some(found)
    }

    pub fn note(&self, open: u32, found: u32) {
        self.0[open as usize].store(found, Ordering::Relaxed);
    }
}

impl Links {
    /// Finds the neighbours in `chain`, all of whose parameters are numbers, with one pass in each direction.
    pub fn build(&mut self, chain: &Chain, grammar: &Grammar) {
        self.build_with(chain, grammar, &PlainNumbers);
    }

    /// Finds the neighbours in `chain`, whose parameters `values` represents.
    pub fn build_with(&mut self, chain: &Chain, grammar: &Grammar, values: &dyn ShowParameters) {
        self.left.clear();
        self.right.clear();
        self.branch.clear();
        self.param.clear();
        self.known.clear();
        self.constants.clear();
        self.constants.extend(grammar.patterns().stored_constants(values));
        if grammar.has_contexts() {
            self.find_params(chain, grammar);
        }
        if grammar.has_left_contexts() {
            self.find_left(chain, grammar);
        }
        if grammar.has_right_contexts() {
            self.find_right(chain, grammar);
        }
        let named = grammar.patterns().branch_count();
        if named > 0 {
            self.find_branches(chain, grammar);
            self.known.resize_with(named, OnceLock::new);
        }
    }

    /// Returns the search results of the named branch with this number. Memory is allocated at the first call.
    pub fn branch_searches(&self, number: u32) -> &BranchSearches {
        self.known[number as usize]
            .get_or_init(|| BranchSearches((0..self.right.len()).map(|_| AtomicU32::new(UNKNOWN)).collect()))
    }

    fn find_params(&mut self, chain: &Chain, grammar: &Grammar) {
        let arities = grammar.arities();
        let mut param = 0u32;
        self.param.extend(chain.symbols.iter().map(|symbol| {
            let begin = param;
            param += u32::from(arities[usize::from(*symbol)]);
            begin
        }));
    }

    fn find_left(&mut self, chain: &Chain, grammar: &Grammar) {
        self.stack.clear();
        let mut nearest = NONE;
        self.left.reserve(chain.symbols.len());
        for (index, symbol) in (0u32..).zip(&chain.symbols) {
            self.left.push(nearest);
            match *symbol {
                OPEN => self.stack.push(nearest),
                CLOSE => nearest = self.stack.pop().unwrap_or(NONE),
                END => nearest = NONE,
                symbol if grammar.is_skipped(symbol) => {}
                _ => nearest = index,
            }
        }
    }

    fn find_right(&mut self, chain: &Chain, grammar: &Grammar) {
        self.stack.clear();
        self.right.resize(chain.symbols.len(), NONE);
        let mut nearest = NONE;
        for (index, symbol) in chain.symbols.iter().enumerate().rev() {
            let here = narrow(index);
            match *symbol {
                CLOSE => {
                    self.right[index] = nearest;
                    self.stack.push(here);
                    nearest = NONE;
                }
                OPEN => {
                    let closing = self.stack.pop().unwrap_or(NONE);
                    self.right[index] = closing;
                    nearest = self.right.get(closing as usize).copied().unwrap_or(NONE);
                }
                END => nearest = NONE,
                symbol => {
                    self.right[index] = nearest;
                    if !grammar.is_skipped(symbol) {
                        nearest = here;
                    }
                }
            }
        }
    }

    fn find_branches(&mut self, chain: &Chain, grammar: &Grammar) {
        self.branch.resize(chain.symbols.len(), NONE);
        let mut next = NONE;
        for (index, symbol) in chain.symbols.iter().enumerate().rev() {
            next = match *symbol {
                OPEN => narrow(index),
                symbol if symbol > END && grammar.is_skipped(symbol) => next,
                _ => NONE,
            };
            self.branch[index] = next;
        }
    }
}

/// Converts an index to 32 bits; the limit on modules keeps chains below 2^32 symbols.
fn narrow(index: usize) -> u32 {
    u32::try_from(index).unwrap_or(NONE)
}
