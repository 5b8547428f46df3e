//! Neighbours along the tree, found once per step, so that matching a context costs O(1) per context module.

use std::sync::OnceLock;
use std::sync::atomic::{AtomicU32, Ordering};

use super::chain::{CLOSE, Chain, END, OPEN, Symbol};
use super::grammar::{Grammar, NewContexts};
use super::ignored::IgnoredSet;
use super::regions::{Region, RegionPath};
use super::text::{PlainNumbers, ShowParameters};

/// Index that means no neighbour.
pub(super) const NONE: u32 = u32::MAX;

/// Neighbours of every symbol of a chain. Only the columns that the grammar's contexts need are filled.
#[derive(Debug, Default)]
pub struct Links {
    /// Index of each symbol's first parameter.
    pub param: Vec<u32>,
    /// Region of each symbol; empty if no module opens a region.
    pub(crate) regions: Vec<Region>,
    /// Values of the grammar's patterns as the chain contains them.
    pub(crate) constants: Vec<f64>,
    /// Neighbours for each set of ignored symbols of the grammar.
    trees: Vec<TreeLinks>,
    /// Neighbours without ignored symbols and rings, if rules have contexts in the new chain.
    whole: OnceLock<TreeLinks>,
    stack: Vec<u32>,
}

/// Neighbours of every symbol of a chain in the tree without the symbols of a set, in columns.
#[derive(Debug, Default)]
pub(crate) struct TreeLinks {
    /// Nearest module towards the axiom that is not ignored. A closed branch is not on that path.
    pub left: Vec<u32>,
    /// For [`OPEN`] its closing bracket; for a module the next module on its own branch that is not ignored; for
    /// [`CLOSE`] the first such module after the branch; for the [`END`] of a ring the first module of the ring.
    pub right: Vec<u32>,
    /// First branch at or after the symbol on the symbol's own branch, with only ignored modules before it.
    pub branch: Vec<u32>,
    /// Cached search results for each branch that the grammar names.
    known: Vec<OnceLock<BranchSearches>>,
}

/// Search results of a step for one named branch, by the opening bracket at which a search passed. All threads add
/// results; the result for a bracket is always the same.
#[derive(Debug)]
pub(crate) struct BranchSearches(Vec<AtomicU32>);

/// Index that means no cached result; an opening bracket never has so large an index.
const UNKNOWN: u32 = NONE - 1;

impl BranchSearches {
    pub(crate) fn get(&self, open: u32) -> Option<u32> {
        let found = self.0[open as usize].load(Ordering::Relaxed);
        (found != UNKNOWN).then_some(found)
    }

    pub(crate) fn note(&self, open: u32, found: u32) {
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
        self.param.clear();
        self.constants.clear();
        self.constants.extend(grammar.patterns().stored_constants(values));
        if grammar.has_contexts() {
            self.find_params(chain, grammar);
        }
        self.trees.resize_with(grammar.ignored_sets().len(), TreeLinks::default);
        for (tree, ignored) in self.trees.iter_mut().zip(grammar.ignored_sets()) {
            tree.build(chain, grammar, ignored, &mut self.stack);
            if grammar.is_ring() {
                tree.join_ends(chain, ignored);
            }
        }
        let whole = self.whole.take();
        // If one call rewrites modules that depend on one another, these links are rarely needed.
        if grammar.new_contexts() != NewContexts::None && grammar.dependent_rules().is_none() {
            let mut whole = whole.unwrap_or_default();
            whole.build_whole(chain, grammar, &mut self.stack);
            self.whole = OnceLock::from(whole);
        }
    }

    /// Finds the regions of the symbols of `chain` from the one at `begin` on, before which the regions are `path`.
    pub(crate) fn find_regions(
        &mut self,
        chain: &Chain,
        begin: usize,
        mut path: RegionPath,
        grammar: &Grammar,
    ) {
        self.regions.clear();
        if !grammar.region_openers().is_empty() {
            self.regions.resize(begin, 0);
            path.pass(&chain.symbols[begin..], grammar.region_openers(), &mut self.regions);
        }
    }

    /// Returns the neighbours in `chain` without ignored symbols and rings.
    #[inline]
    pub(crate) fn whole(&self, chain: &Chain, grammar: &Grammar) -> &TreeLinks {
        self.whole.get_or_init(|| {
            let mut whole = TreeLinks::default();
            whole.build_whole(chain, grammar, &mut Vec::new());
            whole
        })
    }

    /// Returns the neighbours for the set of ignored symbols with this number.
    #[inline]
    pub(crate) fn tree(&self, set: usize) -> &TreeLinks {
        &self.trees[set]
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
}

impl TreeLinks {
    /// Finds the neighbours in `chain` with one pass in each direction.
    fn build(&mut self, chain: &Chain, grammar: &Grammar, ignored: &IgnoredSet, stack: &mut Vec<u32>) {
        self.left.clear();
        self.right.clear();
        self.branch.clear();
        self.known.clear();
        stack.clear();
        if ignored.needs_left {
            self.find_left(chain, ignored, stack);
        }
        stack.clear();
        if ignored.needs_right {
            self.find_right(chain, ignored, stack);
            let named = grammar.patterns().branch_count();
            if named > 0 {
                self.find_branches(chain, ignored);
                self.known.resize_with(named, OnceLock::new);
            }
        }
    }

    /// Finds the neighbours in `chain` without ignored symbols.
    fn build_whole(&mut self, chain: &Chain, grammar: &Grammar, stack: &mut Vec<u32>) {
        self.build(chain, grammar, &IgnoredSet::none(grammar.arities().len()), stack);
    }

    /// Returns the search results of the named branch with this number. Memory is allocated at the first call.
    pub(crate) fn branch_searches(&self, number: u32) -> &BranchSearches {
        self.known[number as usize]
            .get_or_init(|| BranchSearches((0..self.right.len()).map(|_| AtomicU32::new(UNKNOWN)).collect()))
    }

    fn find_left(&mut self, chain: &Chain, ignored: &IgnoredSet, stack: &mut Vec<u32>) {
        let mut nearest = NONE;
        self.left.reserve(chain.symbols.len());
        for (index, symbol) in (0u32..).zip(&chain.symbols) {
            self.left.push(nearest);
            match *symbol {
                OPEN => stack.push(nearest),
                CLOSE => nearest = stack.pop().unwrap_or(NONE),
                END => nearest = NONE,
                symbol if ignored.contains(symbol) => {}
                _ => nearest = index,
            }
        }
    }

    fn find_right(&mut self, chain: &Chain, ignored: &IgnoredSet, stack: &mut Vec<u32>) {
        self.right.resize(chain.symbols.len(), NONE);
        let mut nearest = NONE;
        for (index, symbol) in chain.symbols.iter().enumerate().rev() {
            let here = narrow(index);
            match *symbol {
                CLOSE => {
                    self.right[index] = nearest;
                    stack.push(here);
                    nearest = NONE;
                }
                OPEN => {
                    let closing = stack.pop().unwrap_or(NONE);
                    self.right[index] = closing;
                    nearest = self.right.get(closing as usize).copied().unwrap_or(NONE);
                }
                END => nearest = NONE,
                symbol => {
                    self.right[index] = nearest;
                    if !ignored.contains(symbol) {
                        nearest = here;
                    }
                }
            }
        }
    }

    fn find_branches(&mut self, chain: &Chain, ignored: &IgnoredSet) {
        self.branch.resize(chain.symbols.len(), NONE);
        let mut next = NONE;
        for (index, symbol) in chain.symbols.iter().enumerate().rev() {
            next = match *symbol {
                OPEN => narrow(index),
                symbol if symbol > END && ignored.contains(symbol) => next,
                _ => NONE,
            };
            self.branch[index] = next;
        }
    }

    /// Makes the first and the last module of each chain neighbours.
    fn join_ends(&mut self, chain: &Chain, ignored: &IgnoredSet) {
        let mut begin = 0;
        while begin < chain.symbols.len() {
            let length = chain.symbols[begin..].iter().position(|symbol| *symbol == END);
            let end = length.map_or(chain.symbols.len() - 1, |length| begin + length);
            let symbols = &chain.symbols[begin..=end];
            if ignored.needs_left {
                join_left(&mut self.left[begin..=end], symbols);
            }
            if ignored.needs_right {
                join_right(&mut self.right[begin..=end], symbols, ignored, begin);
            }
            if !self.branch.is_empty() {
                join_branches(&mut self.branch[begin..=end], symbols, ignored);
            }
            begin = end + 1;
        }
    }
}

/// Links the beginning of a chain, which has no module before it, to its last module.
fn join_left(left: &mut [u32], symbols: &[Symbol]) {
    // The link of the end is the last module of the main axis.
    let Some(last) = left.last().copied() else { return };
    for (nearest, symbol) in left.iter_mut().zip(symbols) {
        if *nearest == NONE && *symbol != END {
            *nearest = last;
        }
    }
}

/// Links the end of the main axis of the chain that begins at `begin` to its first module.
fn join_right(right: &mut [u32], symbols: &[Symbol], ignored: &IgnoredSet, begin: usize) {
    let mut depth = 0_usize;
    let first = symbols.iter().position(|symbol| {
        match *symbol {
            OPEN => depth += 1,
            CLOSE => depth = depth.saturating_sub(1),
            END => return false,
            symbol => return depth == 0 && !ignored.contains(symbol),
        }
        false
    });
    let Some(first) = first.map(|first| narrow(begin + first)) else { return };
    let mut depth = 0_usize;
    for (nearest, symbol) in right.iter_mut().zip(symbols).rev() {
        match *symbol {
            CLOSE => {
                if depth == 0 && *nearest == NONE {
                    *nearest = first;
                }
                depth += 1;
            }
            OPEN => depth = depth.saturating_sub(1),
            END => *nearest = first,
            _ if depth > 0 => {}
            symbol => {
                if *nearest == NONE {
                    *nearest = first;
                }
                if !ignored.contains(symbol) {
                    return;
                }
            }
        }
    }
}

/// Links the end of the main axis to the first branch at the beginning of the chain.
fn join_branches(branch: &mut [u32], symbols: &[Symbol], ignored: &IgnoredSet) {
    let first = branch.first().copied().unwrap_or(NONE);
    for (next, symbol) in branch.iter_mut().zip(symbols).rev() {
        match *symbol {
            END => *next = first,
            symbol if symbol > END && ignored.contains(symbol) => *next = first,
            _ => return,
        }
    }
}

/// Converts an index to 32 bits; the limit on modules keeps chains below 2^32 symbols.
pub(super) fn narrow(index: usize) -> u32 {
    u32::try_from(index).unwrap_or(NONE)
}
