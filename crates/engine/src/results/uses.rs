//! How much a rule has done.

use std::ops::AddAssign;
use std::time::Duration;

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
