//! Step that is running, as functions of rules see it.

use std::sync::atomic::{AtomicBool, Ordering};

/// Number of the step that is running, from 1. It records whether a function of a rule has read it: if so, a later step
/// can change the chain even if this step does not. It also records whether a function has requested that this step is the
/// last.
#[derive(Debug)]
pub struct StepNumber {
    number: usize,
    read: AtomicBool,
    last: AtomicBool,
}

impl StepNumber {
    /// Creates the number of a step, not read yet.
    pub(crate) fn new(number: usize) -> Self {
        Self { number, read: AtomicBool::new(false), last: AtomicBool::new(false) }
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

    /// Records that a function of a rule has requested that this step is the last.
    #[inline]
    pub fn request_end(&self) {
        self.last.store(true, Ordering::Relaxed);
    }

    /// Returns true if a function of a rule has requested that this step is the last.
    pub fn is_last(&self) -> bool {
        self.last.load(Ordering::Relaxed)
    }

    /// Returns true if a function of a rule has read the number.
    pub fn is_read(&self) -> bool {
        self.read.load(Ordering::Relaxed)
    }
}
