//! Segments together with the modules around them that contexts can reach.

use std::ops::Range;

use crate::batch::ChainPiece;
use crate::chain::{CLOSE, Chain, END, Mark, OPEN, Symbol};
use crate::grammar::{Grammar, NewContexts};
use crate::segments::{ChainSegment, SegmentedChain};

impl Grammar {
    /// Returns true if a few modules on the path before and after a module decide which rule applies to it: if rules
    /// rewrite single modules, their contexts name no branches, and chains are not rings.
    pub(crate) fn has_near_contexts(&self) -> bool {
        !self.has_runs()
            && !self.is_ring()
            && self.new_contexts() == NewContexts::None
            && self.patterns().branch_count() == 0
    }

    /// Returns true if the contexts of all rules skip `symbol`.
    #[inline]
    pub(crate) fn is_skipped_by_all(&self, symbol: Symbol) -> bool {
        self.skipped_by_all.contains(symbol)
    }

    /// Returns true if the contexts of a rule skip `symbol`.
    #[inline]
    pub(crate) fn is_skipped_by_any(&self, symbol: Symbol) -> bool {
        self.skipped_by_any.contains(symbol)
    }
}

/// ChainSegment of a chain with the modules that the contexts of its modules can match. Modules that no context can
/// match are left out, so the window is short, but neighbours along the tree are the same as in the whole chain.
#[derive(Debug, Default)]
pub(crate) struct ContextWindow {
    pub chain: Chain,
    /// Symbols before the segment, the last first, each with its first parameter in `params`.
    before: Vec<(u16, Range<usize>)>,
    params: Vec<f64>,
}

impl ContextWindow {
    /// Fills the window for the segment at `index`, before which `chains` chains end. Returns the place of the segment in
    /// the window, and the indices of the segments that were searched.
    pub(crate) fn fill(
        &mut self,
        chain: &SegmentedChain,
        index: usize,
        chains: usize,
        grammar: &Grammar,
    ) -> (ChainPiece, Range<usize>) {
        self.chain.clear();
        let first = match grammar.has_left_contexts() {
            true => self.add_path(&chain.segments[..index], chain.segments[index].brackets.closed, grammar),
            false => index,
        };
        let segment = &chain.segments[index];
        let begin = Mark { chain: chains, ..self.chain.end(0) };
        self.chain.symbols.extend_from_slice(&segment.chain.symbols);
        self.chain.params.extend_from_slice(&segment.chain.params);
        if !segment.chain.keys.is_empty() {
            self.chain.keys.extend_from_slice(&segment.chain.keys);
        }
        let piece = ChainPiece { begin, end: self.chain.symbols.len() };
        let last = match grammar.has_right_contexts() {
            true => {
                index + self.add_following(&chain.segments[index + 1..], segment.brackets.opened, grammar)
            }
            false => index,
        };
        (piece, first..last + 1)
    }

    /// Adds the modules on the path from the end of `segments` to the axiom: in each of the `levels` branches that end
    /// after it, and outside of them, as many as a left context has. Returns the index of the first segment that was
    /// searched.
    fn add_path(&mut self, segments: &[ChainSegment], levels: usize, grammar: &Grammar) -> usize {
        let wanted = grammar.longest_left();
        let arities = grammar.arities();
        self.before.clear();
        self.params.clear();
        // Number of branches that have been entered from their ends, of levels that have been left, and of modules that
        // have been found in the present level.
        let (mut depth, mut left, mut found) = (0, 0, 0);
        let mut first = segments.len();
        'search: for (index, segment) in segments.iter().enumerate().rev() {
            first = index;
            let brackets = segment.brackets;
            let reached = if found < wanted { brackets.opened < depth } else { brackets.opened <= depth };
            if reached && brackets.ends == 0 {
                depth = depth - brackets.opened + brackets.closed;
                continue;
            }
            let mut param = segment.chain.params.len();
            for symbol in segment.chain.symbols.iter().rev() {
                let params = param - usize::from(arities[usize::from(*symbol)])..param;
                param = params.start;
                match *symbol {
                    END => break 'search,
                    CLOSE => depth += 1,
                    OPEN if depth > 0 => depth -= 1,
                    OPEN if left < levels => {
                        self.before.push((OPEN, 0..0));
                        left += 1;
                        found = 0;
                    }
                    // Beyond the levels of the segment, the path is the same without brackets.
                    OPEN => {}
                    symbol if depth == 0 && found < wanted && !grammar.is_skipped_by_all(symbol) => {
                        let begin = self.params.len();
                        self.params.extend_from_slice(&segment.chain.params[params]);
                        self.before.push((symbol, begin..self.params.len()));
                        // Rules that skip other modules see as many of these.
                        found += usize::from(!grammar.is_skipped_by_any(symbol));
                    }
                    _ => {}
                }
                if found == wanted && left == levels {
                    break 'search;
                }
            }
        }
        for (symbol, params) in self.before.drain(..).rev() {
            self.chain.symbols.push(symbol);
            self.chain.params.extend_from_slice(&self.params[params]);
        }
        if grammar.draws_random() {
            self.chain.keys.resize(self.chain.symbols.len(), Default::default());
        }
        first
    }

    /// Adds the modules that follow on the main path: in each of the `levels` branches that begin before `segments`, and
    /// outside of them, as many as a right context has. Returns the number of segments that were searched.
    fn add_following(&mut self, segments: &[ChainSegment], levels: usize, grammar: &Grammar) -> usize {
        let wanted = grammar.longest_right();
        let arities = grammar.arities();
        let (mut depth, mut left, mut found) = (0, 0, 0);
        for (index, segment) in segments.iter().enumerate() {
            let brackets = segment.brackets;
            let reached = if found < wanted { brackets.closed < depth } else { brackets.closed <= depth };
            if reached && brackets.ends == 0 {
                depth = depth - brackets.closed + brackets.opened;
                continue;
            }
            let mut param = 0;
            for symbol in &segment.chain.symbols {
                let params = param..param + usize::from(arities[usize::from(*symbol)]);
                param = params.end;
                match *symbol {
                    OPEN => depth += 1,
                    CLOSE if depth > 0 => depth -= 1,
                    END => {
                        self.chain.symbols.push(END);
                        return index + 1;
                    }
                    CLOSE => {
                        self.chain.symbols.push(CLOSE);
                        if left == levels {
                            return index + 1;
                        }
                        left += 1;
                        found = 0;
                    }
                    symbol if depth == 0 && found < wanted && !grammar.is_skipped_by_all(symbol) => {
                        self.chain.symbols.push(symbol);
                        self.chain.params.extend_from_slice(&segment.chain.params[params]);
                        // Rules that skip other modules see as many of these.
                        found += usize::from(!grammar.is_skipped_by_any(symbol));
                    }
                    _ => {}
                }
                if found == wanted && left == levels {
                    return index + 1;
                }
            }
        }
        segments.len()
    }
}
