//! What comes of a piece of a chain: its successors, and what each rule has done.

use std::ops::AddAssign;
use std::time::Duration;

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

/// How much a rule has done.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct Use {
    /// How many times it was applied.
    pub applied: usize,
    /// How many modules and brackets it made.
    pub made: usize,
    /// The time that it took, of all threads together.
    pub time: Duration,
}

impl AddAssign for Use {
    fn add_assign(&mut self, other: Self) {
        self.applied += other.applied;
        self.made += other.made;
        self.time += other.time;
    }
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
