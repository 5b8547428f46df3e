//! Neighbours along the tree, found once a step so that a context costs O(1) for each of its modules.

use super::chain::{CLOSE, Chain, END, OPEN};
use super::grammar::Grammar;

/// No neighbour.
pub(crate) const NONE: u32 = u32::MAX;

/// The neighbours of every symbol of a chain, as columns. Only those that the grammar's contexts need are filled.
#[derive(Debug, Default)]
pub struct Links {
    /// The nearest module towards the axiom that is not ignored. A closed branch is not on that path.
    pub(crate) left: Vec<u32>,
    /// For [`OPEN`] its closing bracket; for a module the next one on its own branch that is not ignored.
    pub(crate) right: Vec<u32>,
    /// Where each symbol's parameters begin.
    pub(crate) param: Vec<u32>,
    stack: Vec<u32>,
}

impl Links {
    /// Finds the neighbours in `chain`, one pass to each side.
    pub fn build(&mut self, chain: &Chain, grammar: &Grammar) {
        self.left.clear();
        self.right.clear();
        self.param.clear();
        if grammar.has_contexts() {
            self.find_params(chain, grammar);
        }
        if grammar.has_left_contexts() {
            self.find_left(chain, grammar);
        }
        if grammar.has_right_contexts() {
            self.find_right(chain, grammar);
        }
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
            let here = u32::try_from(index).unwrap_or(NONE);
            match *symbol {
                CLOSE => {
                    self.stack.push(nearest);
                    self.stack.push(here);
                    nearest = NONE;
                }
                OPEN => {
                    self.right[index] = self.stack.pop().unwrap_or(NONE);
                    nearest = self.stack.pop().unwrap_or(NONE);
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
}
