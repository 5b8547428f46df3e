//! Locks of which a holder has panicked.

use std::sync::{LockResult, PoisonError};

/// What comes of asking for a lock, whether or not a thread has panicked that held it.
///
/// Nothing here is half changed when something panics while it holds a lock, or else it is begun anew by the next holder.
/// So a poisoned lock is as good as any other, and the panic is told where it happened.
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
    /// What the lock gives.
    type Guard;

    /// What the lock gives, poisoned or not.
    fn recover(self) -> Self::Guard;
}

impl<Guard> LockRecovery for LockResult<Guard> {
    type Guard = Guard;

    fn recover(self) -> Guard {
        self.unwrap_or_else(PoisonError::into_inner)
    }
}
