//! Recovery of poisoned locks.

use std::sync::{LockResult, PoisonError};

/// Result of a lock request, to be used even if a thread panicked while it held the lock.
///
/// No code in Burgeon leaves data half changed if it panics while it holds a lock, or the next holder resets the data.
/// A poisoned lock can therefore be used like any other, and the panic is reported where it occurred.
///
/// ```
/// use burgeon_base::locks::LockRecovery;
/// use std::sync::Mutex;
///
/// let count = Mutex::new(1);
/// std::thread::scope(|threads| {
///     let holder = threads.spawn(|| {
///         *count.lock().recover() += 1;
///         let _held = count.lock();
///         panic!("with the lock");
///     });
///     assert!(holder.join().is_err());
/// });
/// assert!(count.is_poisoned());
/// assert_eq!(*count.lock().recover(), 2);
/// ```
pub trait LockRecovery {
    /// Guard of the lock.
    type Guard;

    /// Returns the guard, even if the lock is poisoned.
    fn recover(self) -> Self::Guard;
}

impl<Guard> LockRecovery for LockResult<Guard> {
    type Guard = Guard;

    fn recover(self) -> Guard {
        self.unwrap_or_else(PoisonError::into_inner)
    }
}
