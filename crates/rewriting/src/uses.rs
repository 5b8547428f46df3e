//! Work of a rule.

use std::ops::AddAssign;
use std::time::Duration;

/// Work of a rule.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct Use {
    /// Number of applications.
    pub applied: usize,
    /// Number of modules and brackets that the rule produced.
    pub made: usize,
    /// Total time of all threads.
    pub time: Duration,
}

impl AddAssign for Use {
    fn add_assign(&mut self, other: Self) {
        self.applied += other.applied;
        self.made += other.made;
        self.time += other.time;
    }
}
