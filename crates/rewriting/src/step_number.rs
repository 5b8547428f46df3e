//! Number of the step that is running.

use std::sync::atomic::{AtomicBool, Ordering};

/// Number of the step that is running, from 1. It records whether a function of a rule has read it: if so, a later step
/// can change the chain even if this step does not.
#[derive(Debug)]
pub struct StepNumber {
    number: usize,
    read: AtomicBool,
}

impl StepNumber {
    /// Creates the number of a step, not read yet.
    pub(crate) fn new(number: usize) -> Self {
        Self { number, read: AtomicBool::new(false) }
    }

    /// Returns the number for a function of a rule, and records that it was read.
    #[inline]
    pub fn read(&self) -> usize {
        self.note_read();
        self.number
    }

    /// Returns the number without a record, for errors and for functions that may not read it.
    #[inline]
    pub fn number(&self) -> usize {
        self.number
    }

    /// Records that a function of a rule has read the number.
    #[inline]
    pub fn note_read(&self) {
        self.read.store(true, Ordering::Relaxed);
    }

    /// Returns true if a function of a rule has read the number.
    pub fn is_read(&self) -> bool {
        self.read.load(Ordering::Relaxed)
    }
}
