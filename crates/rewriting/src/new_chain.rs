//! The chain that a step writes, while it is incomplete: matching of contexts in it.

use std::ops::Range;

use smallvec::SmallVec;

use crate::chain::{CLOSE, Chain, END, OPEN, Symbol};
use crate::context::{CompiledPatterns, ContextElement};
use crate::grammar::{Grammar, NewContexts};
use crate::ignored::IgnoredSet;
use crate::links::{Links, NONE, narrow};
use crate::successors::{ModuleOrder, Successors};
use crate::text::ShowParameters;

/// Symbol of the new chain.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct NewPlace {
    /// Index of the symbol of the old chain that was rewritten.
    pub old: u32,
    /// Number of symbols of its successor before this one.
    pub offset: u32,
}

/// Context modules in the new chain that a pattern matched, in the order in which the pattern names them.
pub(crate) type NewBindings = SmallVec<[NewPlace; 8]>;

/// Successor that has been written: its symbols and its parameters in the columns of the chain.
#[derive(Debug, Clone, Copy)]
struct WrittenSuccessor {
    begin: u32,
    end: u32,
    first_param: u32,
    last_param: u32,
}

impl WrittenSuccessor {
    /// Module that is unchanged or not yet rewritten.
    const NONE: Self = Self { begin: NONE, end: NONE, first_param: 0, last_param: 0 };

    #[inline]
    fn symbols(self) -> Range<usize> {
        self.begin as usize..self.end as usize
    }

    #[inline]
    fn params(self) -> Range<usize> {
        self.first_param as usize..self.last_param as usize
    }
}

/// Result of a search that begins at each symbol of the old chain.
#[derive(Debug, Clone, Copy)]
enum ChainSearch {
    Unknown,
    Found(Option<NewPlace>),
}

/// Results of the searches for the rules that ignore the same symbols.
#[derive(Debug, Default)]
struct ChainSearches {
    /// Last module, on the path to the axiom, of what has replaced the symbol or one before it.
    lasts: Vec<ChainSearch>,
    /// First symbol of what has replaced the symbol or one after it.
    firsts: Vec<ChainSearch>,
}

/// Successors of a piece that have been written so far. The other symbols are as in the old chain.
#[derive(Debug, Default)]
pub(crate) struct NewChain {
    /// Index of the first symbol of the piece in the old chain.
    begin: usize,
    /// Index among the active modules by symbol of the piece.
    active: Vec<u32>,
    /// Successors by active module.
    successors: Vec<WrittenSuccessor>,
    symbols: Vec<Symbol>,
    params: Vec<f64>,
    constants: Vec<f64>,
    /// ChainSearches by set of ignored symbols.
    searches: Vec<ChainSearches>,
}

impl NewChain {
    /// Clears the chain for a piece of the old chain: its symbols `piece`, of which the active modules are at the indices
    /// `active`, ascending.
    pub(crate) fn start(
        &mut self,
        piece: Range<usize>,
        active: impl ExactSizeIterator<Item = usize>,
        links: &Links,
    ) {
        self.begin = piece.start;
        self.active.clear();
        self.active.resize(piece.len(), NONE);
        self.successors.clear();
        self.successors.resize(active.len(), WrittenSuccessor::NONE);
        for (index, module) in active.enumerate() {
            self.active[module - piece.start] = narrow(index);
        }
        self.symbols.clear();
        self.params.clear();
        self.constants.clone_from(&links.constants);
        self.searches.clear();
    }

    /// Updates the values of patterns, because new modules can have texts that no module had before.
    pub(crate) fn find_constants(&mut self, grammar: &Grammar, values: &dyn ShowParameters) {
        if CompiledPatterns::has_absent(&self.constants) {
            self.constants.clear();
            self.constants.extend(grammar.patterns().stored_constants(values));
        }
    }

    /// Adds the successors of all applications of a rule, and removes them from its `group`.
    pub(crate) fn take_group(&mut self, group: &mut Successors, arranged: &mut ModuleOrder, arities: &[u8]) {
        group.rewind();
        let members = std::mem::take(&mut group.members);
        for member in &members {
            let (begin, first_param) = (self.symbols.len(), self.params.len());
            if !group.read_next(arities, arranged, &mut self.symbols, &mut self.params) {
                continue;
            }
            self.successors[*member as usize] = WrittenSuccessor {
                begin: narrow(begin),
                end: narrow(self.symbols.len()),
                first_param: narrow(first_param),
                last_param: narrow(self.params.len()),
            };
        }
        group.members = members;
        group.members.clear();
    }

    /// Returns true if modules of the piece have been rewritten in rounds, or in calls for modules that depend on one another.
    pub(crate) fn is_used(&self) -> bool {
        !self.successors.is_empty()
    }

    /// Returns the symbols and parameters that have replaced active module `index`; `None` if it is unchanged.
    #[inline]
    pub(crate) fn written(&self, index: usize) -> Option<(&[Symbol], &[f64])> {
        let successor = self.successors[index];
        (successor.begin != NONE)
            .then(|| (&self.symbols[successor.symbols()], &self.params[successor.params()]))
    }

    /// Removes the successors of the active modules with these indices, which are then as before the step.
    pub(crate) fn forget(&mut self, indices: &[u32]) {
        for index in indices {
            self.successors[*index as usize] = WrittenSuccessor::NONE;
        }
    }

    /// Returns the symbols that have replaced the symbol at `old` of `chain`.
    #[inline]
    pub(crate) fn symbols_of<'a>(&'a self, old: u32, chain: &'a Chain) -> &'a [Symbol] {
        match self.successor(old) {
            Some(successor) => &self.symbols[successor.symbols()],
            None => std::slice::from_ref(&chain.symbols[old as usize]),
        }
    }

    /// Returns the symbol of the module at `place` and its parameters. `chain` is the old chain.
    pub(crate) fn module<'a>(
        &'a self,
        place: NewPlace,
        chain: &'a Chain,
        links: &Links,
        arities: &[u8],
    ) -> (Symbol, &'a [f64]) {
        let symbols = self.symbols_of(place.old, chain);
        let symbol = symbols[place.offset as usize];
        let params = match self.successor(place.old) {
            None => &chain.params[links.param[place.old as usize] as usize..],
            Some(successor) => {
                let before = symbols[..place.offset as usize].iter();
                let skipped: usize = before.map(|symbol| usize::from(arities[usize::from(*symbol)])).sum();
                &self.params[successor.first_param as usize + skipped..]
            }
        };
        (symbol, &params[..usize::from(arities[usize::from(symbol)])])
    }

    #[inline]
    fn successor(&self, old: u32) -> Option<WrittenSuccessor> {
        let active = self.active[old as usize - self.begin];
        self.successors.get(active as usize).copied().filter(|successor| successor.begin != NONE)
    }
}

/// Matcher of the contexts of one rule in the new chain.
pub(crate) struct NewMatcher<'a> {
    pub new: &'a mut NewChain,
    pub chain: &'a Chain,
    pub links: &'a Links,
    pub grammar: &'a Grammar,
    pub rule: u16,
}

impl NewMatcher<'_> {
    /// Returns true if the contexts match around the module at `index` of the old chain.
    pub(crate) fn matches(&mut self, index: u32) -> bool {
        let left = self.grammar.new_left_of(self.rule);
        let right = self.grammar.new_right_of(self.rule);
        (left.is_empty() || self.matches_left(left, index, None))
            && (right.is_empty() || {
                let first = self.first(index + 1);
                self.matches_right(right, first, None)
            })
    }

    /// Fills `bindings` for a rule that matches at the module at `index`.
    pub(crate) fn bind(&mut self, index: u32, bindings: &mut NewBindings) {
        bindings.clear();
        let (left, right) = (self.grammar.new_left_of(self.rule), self.grammar.new_right_of(self.rule));
        if !left.is_empty() {
            self.matches_left(left, index, Some(bindings));
            bindings.reverse();
        }
        if !right.is_empty() {
            let first = self.first(index + 1);
            self.matches_right(right, first, Some(bindings));
        }
    }

    /// Returns the parameters of the module at `place`.
    pub(crate) fn params(&self, place: NewPlace) -> &[f64] {
        self.new.module(place, self.chain, self.links, self.grammar.arities()).1
    }

    fn ignored(&self) -> &IgnoredSet {
        &self.grammar.ignored_sets()[self.grammar.ignored_set(self.rule)]
    }

    /// Returns the symbols that have replaced the symbol at `old`.
    fn symbols(&self, old: u32) -> &[Symbol] {
        self.new.symbols_of(old, self.chain)
    }

    fn symbol(&self, place: NewPlace) -> Symbol {
        self.symbols(place.old).get(place.offset as usize).copied().unwrap_or(END)
    }

    /// Returns true if the module at `place` matches an element that is a module.
    fn passes(&self, element: ContextElement, place: NewPlace) -> bool {
        let symbol = self.symbol(place);
        match element {
            ContextElement::Module(wanted) => wanted == symbol,
            ContextElement::Test(number) => {
                let test = self.grammar.patterns().test(number);
                test.admits(symbol) && test.holds(self.params(place), &self.new.constants)
            }
            ContextElement::Branch(_) | ContextElement::End => false,
        }
    }

    /// Returns true if `contexts`, the nearest first, match the path before the module at `index`.
    fn matches_left(
        &mut self,
        contexts: &[ContextElement],
        index: u32,
        mut bindings: Option<&mut NewBindings>,
    ) -> bool {
        let mut nearest = self.last(self.links.whole(self.chain, self.grammar).left[index as usize]);
        for element in contexts {
            let place = match (element, nearest) {
                (ContextElement::End, _) => return nearest.is_none(),
                (_, None) => return false,
                (_, Some(place)) => place,
            };
            if !self.passes(*element, place) {
                return false;
            }
            if let Some(bindings) = &mut bindings {
                bindings.push(place);
            }
            nearest = self.before(place);
        }
        true
    }

    /// Returns the last module on the path from what has replaced the module at `old`, towards the axiom.
    fn last(&mut self, old: u32) -> Option<NewPlace> {
        let mut here = old;
        let found = loop {
            if here == NONE {
                break None;
            }
            let place = here as usize - self.new.begin;
            if let ChainSearch::Found(found) = self.searches().lasts[place] {
                break found;
            }
            let length = self.symbols(here).len();
            if let Some(found) = self.last_before(here, length) {
                break Some(found);
            }
            here = self.links.whole(self.chain, self.grammar).left[here as usize];
        };
        let end = here;
        here = old;
        while here != end {
            let place = here as usize - self.new.begin;
            self.searches().lasts[place] = ChainSearch::Found(found);
            here = self.links.whole(self.chain, self.grammar).left[here as usize];
        }
        if end != NONE {
            let place = end as usize - self.new.begin;
            self.searches().lasts[place] = ChainSearch::Found(found);
        }
        found
    }

    /// Returns the nearest module before `place` on the path to the axiom.
    fn before(&mut self, place: NewPlace) -> Option<NewPlace> {
        let found = self.last_before(place.old, place.offset as usize);
        found.or_else(|| self.last(self.links.whole(self.chain, self.grammar).left[place.old as usize]))
    }

    /// Returns the last module on the path among the first `length` symbols that have replaced the symbol at `old`.
    fn last_before(&self, old: u32, length: usize) -> Option<NewPlace> {
        let ignored = self.ignored();
        let mut depth = 0_usize;
        for (offset, symbol) in self.symbols(old)[..length].iter().enumerate().rev() {
            match *symbol {
                CLOSE => depth += 1,
                OPEN => depth = depth.saturating_sub(1),
                symbol if depth == 0 && symbol > END && !ignored.contains(symbol) => {
                    return Some(NewPlace { old, offset: narrow(offset) });
                }
                _ => {}
            }
        }
        None
    }

    /// Returns true if `contexts` match the new chain from the symbol at `here` on.
    fn matches_right(
        &mut self,
        contexts: &[ContextElement],
        mut here: Option<NewPlace>,
        mut bindings: Option<&mut NewBindings>,
    ) -> bool {
        for element in contexts {
            loop {
                let symbol = here.map_or(END, |place| self.symbol(place));
                let (Some(place), true) = (here, symbol != CLOSE && symbol != END) else {
                    return *element == ContextElement::End;
                };
                match element {
                    ContextElement::Branch(number) if symbol == OPEN => {
                        let grammar = self.grammar;
                        let inner = grammar.patterns().branch(*number);
                        let first = self.after(place);
                        let is_found = self.matches_right(inner, first, None);
                        if is_found && let Some(bindings) = &mut bindings {
                            self.matches_right(inner, first, Some(bindings));
                        }
                        here = self.after_branch(place);
                        if is_found {
                            break;
                        }
                    }
                    _ if symbol == OPEN => here = self.after_branch(place),
                    element => {
                        if !self.passes(*element, place) {
                            return false;
                        }
                        if let Some(bindings) = &mut bindings {
                            bindings.push(place);
                        }
                        here = self.after(place);
                        break;
                    }
                }
            }
        }
        true
    }

    /// Returns the first symbol, except for ignored modules, of what has replaced the symbols from `old` on.
    fn first(&mut self, old: u32) -> Option<NewPlace> {
        let end = self.new.begin + self.new.active.len();
        let mut here = old as usize;
        let found = loop {
            if here >= end {
                break None;
            }
            let place = here - self.new.begin;
            if let ChainSearch::Found(found) = self.searches().firsts[place] {
                break found;
            }
            if let Some(found) = self.first_from(narrow(here), 0) {
                break Some(found);
            }
            here += 1;
        };
        let (begin, last) = (old as usize - self.new.begin, here.min(end - 1) - self.new.begin);
        if begin <= last {
            self.searches().firsts[begin..=last].fill(ChainSearch::Found(found));
        }
        found
    }

    /// Returns the first symbol after the one at `place`, except for ignored modules.
    fn after(&mut self, place: NewPlace) -> Option<NewPlace> {
        self.first_from(place.old, place.offset as usize + 1).or_else(|| self.first(place.old + 1))
    }

    /// Returns the first symbol after the branch that begins at `place`, except for ignored modules.
    fn after_branch(&mut self, place: NewPlace) -> Option<NewPlace> {
        if self.new.successor(place.old).is_none() {
            return self.first(self.links.whole(self.chain, self.grammar).right[place.old as usize] + 1);
        }
        let mut depth = 0_usize;
        let symbols = self.symbols(place.old);
        let closing = symbols[place.offset as usize..].iter().position(|symbol| {
            match *symbol {
                OPEN => depth += 1,
                CLOSE => depth -= 1,
                _ => {}
            }
            depth == 0
        });
        let offset = closing.map_or(symbols.len(), |closing| place.offset as usize + closing);
        self.after(NewPlace { old: place.old, offset: narrow(offset) })
    }

    /// Returns the first symbol, except for ignored modules, from `offset` on among those that have replaced the symbol at
    /// `old`.
    fn first_from(&self, old: u32, offset: usize) -> Option<NewPlace> {
        let ignored = self.ignored();
        let rest = self.symbols(old).get(offset..)?;
        let found = rest.iter().position(|symbol| *symbol <= END || !ignored.contains(*symbol))?;
        Some(NewPlace { old, offset: narrow(offset + found) })
    }

    /// Returns the results of earlier searches. Memory is allocated at the first call.
    fn searches(&mut self) -> &mut ChainSearches {
        let set = self.grammar.ignored_set(self.rule);
        let count = self.new.active.len();
        let all = &mut self.new.searches;
        if all.len() <= set {
            all.resize_with(set + 1, ChainSearches::default);
        }
        let searches = &mut all[set];
        let column = match self.grammar.new_contexts() {
            NewContexts::Right => &mut searches.firsts,
            _ => &mut searches.lasts,
        };
        if column.is_empty() {
            column.resize(count, ChainSearch::Unknown);
        }
        searches
    }
}
