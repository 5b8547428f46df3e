//! Result of a piece of a chain: its part of the next chain, and the work of each rule.

use crate::chain::Chain;
use crate::uses::Use;

/// Part of the next chain that replaces a piece.
#[derive(Debug, Default)]
pub(crate) struct Output {
    pub chain: Chain,
    /// Set if any rule ran.
    pub ran: bool,
    /// Set if any rule that ran replaced or erased its module.
    pub changed: bool,
    /// Work of each rule that ran.
    pub uses: Vec<(u16, Use)>,
    /// For each symbol of the piece, the rule that ran and the number of its successors; empty if the plan is not
    /// traced.
    pub applied: Vec<(u16, u32)>,
}

impl Output {
    /// Clears the output but keeps its memory.
    pub(crate) fn clear(&mut self) {
        self.chain.clear();
        self.uses.clear();
        self.applied.clear();
        (self.ran, self.changed) = (false, false);
    }
}
