//! What comes of a piece of a chain: its successors, and what each rule has done.

use crate::results::Use;
use burgeon_kit::rules::Chain;

/// What a piece becomes.
#[derive(Default)]
pub(crate) struct Output {
    pub chain: Chain,
    /// Whether any rule ran.
    pub ran: bool,
    /// Whether any rule that ran replaced or erased its module.
    pub changed: bool,
    /// What each rule that ran has done.
    pub uses: Vec<(u16, Use)>,
    /// For each symbol of the piece, the rule that ran and how many symbols came of it; only where it is traced.
    pub applied: Vec<(u16, u32)>,
}

impl Output {
    /// Empties it but keeps its memory.
    pub(crate) fn clear(&mut self) {
        self.chain.clear();
        self.uses.clear();
        self.applied.clear();
        (self.ran, self.changed) = (false, false);
    }
}
