//! Budgets for reading untrusted data: time until cancellation, and memory that is requested before it is allocated.

use std::any::{Any, TypeId};
use std::collections::BTreeMap;
use std::fmt;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::{Arc, Mutex};
use std::time::{Duration, Instant};

use crate::error::{Error, Limit, Result};
use crate::locks::LockRecovery;

/// Number of small work items between two time checks.
const PIECES: usize = 1024;

/// Function that fails if the work must end.
type BudgetCheck = dyn Fn() -> Result<()> + Send + Sync;

/// Budget for all files that are read for one run.
///
/// Readers call [`check`](Self::check) regularly, and [`take`](Self::take) before allocations whose size the content of
/// a file determines. The count is an estimate, accurate to a factor of two.
pub struct Budget {
    check: Option<Box<BudgetCheck>>,
    /// Memory limit (bytes), and the part of it that is in use.
    most: usize,
    taken: AtomicUsize,
    /// Set if a request exceeded the limit.
    spent: AtomicBool,
    pieces: AtomicUsize,
    /// Values that readers share, by type.
    shared: Mutex<BTreeMap<TypeId, Arc<dyn Any + Send + Sync>>>,
    /// Memory (bytes) that shared values use.
    reserved: AtomicUsize,
}

impl Default for Budget {
    /// Creates an unlimited budget.
    fn default() -> Self {
        Self {
            check: None,
            most: usize::MAX,
            taken: AtomicUsize::new(0),
            spent: AtomicBool::new(false),
            pieces: AtomicUsize::new(0),
            shared: Mutex::default(),
            reserved: AtomicUsize::new(0),
        }
    }
}

impl fmt::Debug for Budget {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "Budget({} of {} bytes)", self.taken.load(Ordering::Relaxed), self.most)
    }
}

impl Budget {
    /// Creates a budget of `memory` (bytes) that ends when `check` fails.
    pub fn new(memory: usize, check: impl Fn() -> Result<()> + Send + Sync + 'static) -> Arc<Self> {
        Arc::new(Self { check: Some(Box::new(check)), most: memory, ..Self::default() })
    }

    /// Creates a budget of `memory` (bytes) that ends after `time` from now.
    pub fn within(time: Duration, memory: usize) -> Arc<Self> {
        let begin = Instant::now();
        Self::new(memory, move || {
            if begin.elapsed() < time {
                return Ok(());
            }
            Err(Error::limit(
                Limit::Time,
                format!("reading exceeded the time limit of {} s", time.as_secs_f64()),
            )
            .help("read a part of the data, or raise the limit: --time-limit SECONDS"))
        })
    }

    /// Returns the memory limit (bytes).
    pub fn memory(&self) -> usize {
        self.most
    }

    /// Fails if the work must end, because `check` of [`Budget::new`] fails or a request has exceeded the memory limit.
    pub fn check(&self) -> Result<()> {
        if self.spent.load(Ordering::Relaxed) {
            return Err(self.too_much());
        }
        self.check.as_ref().map_or(Ok(()), |check| check())
    }

    /// Counts a small work item, and calls [`check`](Self::check) once for many items.
    #[inline]
    pub fn tick(&self) -> Result<()> {
        if self.pieces.fetch_add(1, Ordering::Relaxed).is_multiple_of(PIECES) { self.check() } else { Ok(()) }
    }

    /// Takes memory (bytes) from the budget until [`give`](Self::give). Fails if too little is left.
    pub fn take(&self, bytes: usize) -> Result<()> {
        let taken = self.taken.fetch_add(bytes, Ordering::Relaxed);
        let reserved = self.reserved.load(Ordering::Relaxed);
        if taken
            .checked_add(bytes)
            .and_then(|taken| taken.checked_add(reserved))
            .is_some_and(|taken| taken <= self.most)
        {
            return Ok(());
        }
        self.give(bytes);
        self.spent.store(true, Ordering::Relaxed);
        Err(self.too_much())
    }

    fn too_much(&self) -> Error {
        Error::limit(
            Limit::Memory,
            format!("reading exceeded the memory limit of {} MB", self.most / 1_000_000),
        )
        .help("read a part of the data, or raise the limit: --memory-limit MEGABYTES")
    }

    /// Returns taken memory (bytes) to the budget.
    pub fn give(&self, bytes: usize) {
        self.taken.fetch_sub(bytes, Ordering::Relaxed);
    }

    /// Takes memory (bytes) until the result is dropped. Fails if too little is left.
    ///
    /// ```
    /// use burgeon_base::Budget;
    ///
    /// let budget = Budget::new(1000, || Ok(()));
    /// let buffer = budget.hold(600)?;
    /// assert_eq!(budget.used_bytes(), 600);
    /// assert!(budget.hold(600).is_err());
    /// drop(buffer);
    /// assert_eq!(budget.used_bytes(), 0);
    /// # Ok::<(), burgeon_base::Error>(())
    /// ```
    pub fn hold(&self, bytes: usize) -> Result<MemoryReservation<'_>> {
        self.take(bytes)?;
        Ok(MemoryReservation { budget: self, bytes })
    }

    /// Takes memory (bytes) for the lifetime of the budget, regardless of the memory that readers return. Fails if too
    /// little is left.
    pub fn reserve(&self, bytes: usize) -> Result<()> {
        drop(self.hold(bytes)?);
        self.reserved.fetch_add(bytes, Ordering::Relaxed);
        Ok(())
    }

    /// Returns the value of type `T` that all readers of this budget share. The first call creates it.
    pub fn share<T: Any + Send + Sync + Default>(&self) -> Arc<T> {
        let mut shared = self.shared.lock().recover();
        let known = shared.entry(TypeId::of::<T>()).or_insert_with(|| Arc::new(T::default()));
        // The key is the type, so the downcast succeeds.
        Arc::clone(known).downcast().unwrap_or_default()
    }

    /// Returns the memory in use (bytes).
    pub fn used_bytes(&self) -> usize {
        self.taken.load(Ordering::Relaxed)
    }

    /// Reduces the memory taken by one reader to `bytes`. `before` is the result of [`used_bytes`](Self::used_bytes)
    /// before the reader began; no other reader may run in between.
    pub fn settle(&self, before: usize, bytes: usize) {
        self.taken.store(before.saturating_add(bytes), Ordering::Relaxed);
        self.spent.store(false, Ordering::Relaxed);
    }
}

/// Reserved memory, which is returned to the budget on drop.
#[derive(Debug)]
pub struct MemoryReservation<'a> {
    budget: &'a Budget,
    bytes: usize,
}

impl Drop for MemoryReservation<'_> {
    fn drop(&mut self) {
        self.budget.give(self.bytes);
    }
}

/// Memory of a result that grows, which is returned to its budget on drop. The default charges no budget.
#[derive(Debug, Default)]
pub struct BudgetCharge(Option<(Arc<Budget>, usize)>);

impl BudgetCharge {
    /// Creates a charge of 0 bytes.
    pub fn new(budget: &Arc<Budget>) -> Self {
        Self(Some((Arc::clone(budget), 0)))
    }

    /// Takes `bytes` more. Fails if the memory or time limit is exceeded.
    pub fn take(&mut self, bytes: usize) -> Result<()> {
        let Some((budget, taken)) = &mut self.0 else { return Ok(()) };
        budget.tick()?;
        budget.take(bytes)?;
        *taken += bytes;
        Ok(())
    }
}

impl Drop for BudgetCharge {
    fn drop(&mut self) {
        if let Some((budget, taken)) = &self.0 {
            budget.give(*taken);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn memory_is_refused_before_it_is_taken_and_may_be_given_back() {
        let budget = Budget::within(Duration::from_secs(60), 1_000_000);
        budget.take(600_000).unwrap();
        assert!(budget.take(usize::MAX).is_err() && budget.take(500_000).is_err());
        drop(budget.hold(400_000).unwrap());
        assert_eq!(budget.used_bytes(), 600_000);
        insta::assert_snapshot!(budget.take(500_000).unwrap_err(), @r"
        reading exceeded the memory limit of 1 MB
          help: read a part of the data, or raise the limit: --memory-limit MEGABYTES
        ");
    }

    #[test]
    fn what_is_shared_is_made_once_and_its_memory_stays_taken() {
        let budget = Budget::within(Duration::from_secs(60), 1_000_000);
        budget.share::<AtomicUsize>().store(7, Ordering::Relaxed);
        assert_eq!(budget.share::<AtomicUsize>().load(Ordering::Relaxed), 7);
        budget.reserve(600_000).unwrap();
        budget.settle(0, 0);
        assert!(budget.take(500_000).is_err());
        budget.settle(0, 0);
        budget.take(400_000).unwrap();
    }

    #[test]
    fn time_that_is_over_is_told() {
        let budget = Budget::within(Duration::ZERO, 1);
        insta::assert_snapshot!(budget.tick().unwrap_err(), @r"
        reading exceeded the time limit of 0 s
          help: read a part of the data, or raise the limit: --time-limit SECONDS
        ");
    }
}
