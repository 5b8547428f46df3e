//! Pauses between attempts to perform steps in series.

/// Maximum number of steps before the next attempt.
const LONGEST: usize = 256;

/// Number of steps before the next attempt to perform steps in series, after attempts in which most of the chain changed.
#[derive(Debug, Clone, Copy)]
pub(crate) struct SeriesPause {
    /// Number of steps until the next attempt.
    left: usize,
    /// Number of steps of the next pause.
    next: usize,
}

impl Default for SeriesPause {
    fn default() -> Self {
        Self { left: 0, next: 1 }
    }
}

impl SeriesPause {
    /// Returns a pause that never ends.
    pub(crate) fn endless() -> Self {
        Self { left: usize::MAX, next: LONGEST }
    }

    /// Returns true if the pause is over; otherwise counts a step of it.
    pub(crate) fn pass(&mut self) -> bool {
        let is_over = self.left == 0;
        if self.left != usize::MAX {
            self.left = self.left.saturating_sub(1);
        }
        is_over
    }

    /// Returns the pause after a series of `steps` steps that ended because most of the chain changed. Short series make the
    /// pauses longer.
    pub(crate) fn after_series(self, steps: usize) -> Self {
        match steps < LONGEST {
            true => Self { left: self.next, next: LONGEST.min(2 * self.next) },
            false => Self::default(),
        }
    }
}
