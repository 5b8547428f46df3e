//! Chains that are skipped because their data is wrong.

use std::sync::OnceLock;
use std::sync::atomic::{AtomicBool, Ordering};

use burgeon_base::error::{Error, Result};

/// Failures of the chains of a system. A failed chain is not processed further.
///
/// ```
/// use burgeon_base::Error;
/// use burgeon_rewriting::FailedChains;
///
/// let failed = FailedChains::new(3, true);
/// failed.forgive(1, Error::geometry("the outline has no area").of_data())?;
/// assert_eq!((failed.list(), failed.contains(0)), (vec![1], false));
/// assert!(failed.forgive(2, Error::script("a rule is wrong")).is_err());
/// # Ok::<(), Error>(())
/// ```
#[derive(Debug, Default)]
pub struct FailedChains {
    failures: Vec<OnceLock<Error>>,
    any_failed: AtomicBool,
    forgiving: bool,
}

impl FailedChains {
    /// Creates the failures of `chains` chains. If `forgiving`, a chain with wrong data is skipped and the run
    /// continues.
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

    /// Skips a chain if its data is the cause of `error`; returns every other error.
    pub fn forgive(&self, chain: usize, error: Error) -> Result<()> {
        match self.failures.get(chain) {
            Some(failure) if self.forgiving && error.is_of_data() => {
                // Only the first failure is kept.
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
