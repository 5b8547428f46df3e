//! Chains that are left out because their data is wrong.

use std::sync::OnceLock;
use std::sync::atomic::{AtomicBool, Ordering};

use burgeon_base::error::{Error, Result};

/// Failures of the chains of a system. Nothing more is done with a chain that has failed.
#[derive(Debug, Default)]
pub struct FailedChains {
    failures: Vec<OnceLock<Error>>,
    any_failed: AtomicBool,
    forgiving: bool,
}

impl FailedChains {
    /// Creates the failures of `chains` chains. If `forgiving`, wrong data leaves a chain out and does not end the run.
    pub fn new(chains: usize, forgiving: bool) -> Self {
        let failures = (0..chains).map(|_| OnceLock::new()).collect();
        Self { failures, any_failed: AtomicBool::new(false), forgiving }
    }

    /// Reports whether any chain has failed.
    #[inline]
    pub fn any(&self) -> bool {
        self.any_failed.load(Ordering::Relaxed)
    }

    /// Reports whether a chain has failed.
    #[inline]
    pub fn contains(&self, chain: usize) -> bool {
        self.failures.get(chain).is_some_and(|failure| failure.get().is_some())
    }

    /// Returns the numbers of the chains that have failed, in order.
    pub fn list(&self) -> Vec<usize> {
        match self.any() {
            true => (0..self.failures.len()).filter(|chain| self.contains(*chain)).collect(),
            false => Vec::new(),
        }
    }

    /// Leaves a chain out if its data is the cause of `error`; returns every other error.
    pub fn forgive(&self, chain: usize, error: Error) -> Result<()> {
        match self.failures.get(chain) {
            Some(failure) if self.forgiving && error.is_of_data() => {
                // The first one counts.
                let _ = failure.set(error);
                self.any_failed.store(true, Ordering::Relaxed);
                Ok(())
            }
            _ => Err(error),
        }
    }

    /// Returns the failure of a chain, if it has failed.
    pub fn failure(&self, chain: usize) -> Option<&Error> {
        self.failures.get(chain)?.get()
    }
}
