//! Cancellation of work.

use std::cell::RefCell;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex};

use crate::account::{MemoryAccount, MemoryOwner, switch};
use crate::error::{Error, Result};
use crate::locks::LockRecovery;
use crate::work_progress::WorkProgress;

thread_local! {
    /// Stops of all runs that this thread works on, the most recent last.
    static AT_WORK: RefCell<Vec<Arc<Stop>>> = const { RefCell::new(Vec::new()) };
}

/// Cancellation of all work on a run or on its results, with the reason.
///
/// ```
/// use burgeon_base::{Error, Stop};
/// use std::sync::Arc;
///
/// let run = Arc::new(Stop::new());
/// let part = Stop::under(Some(Arc::clone(&run)));
/// assert!(part.check().is_ok());
/// run.stop(Error::cancellation("the window was closed"));
/// assert_eq!(part.check().map_err(|error| error.into_message()), Err("the window was closed".into()));
/// ```
#[derive(Debug, Default)]
pub struct Stop {
    parent: Option<Arc<Stop>>,
    /// Memory account of the run, which is cancelled when it exceeds its limit.
    memory: Option<MemoryAccount>,
    stopped: AtomicBool,
    reason: Mutex<Option<Error>>,
    progress: WorkProgress,
}

impl Stop {
    /// Creates a stop that has not been requested.
    pub const fn new() -> Self {
        Self {
            parent: None,
            memory: None,
            stopped: AtomicBool::new(false),
            reason: Mutex::new(None),
            progress: WorkProgress::new(),
        }
    }

    /// Creates a stop that is also requested whenever `parent` is.
    pub fn under(parent: Option<Arc<Self>>) -> Self {
        Self { parent, ..Self::default() }
    }

    /// Also cancels the run when it uses more than `limit` (bytes) of memory.
    #[must_use]
    pub fn with_memory_limit(self, limit: usize) -> Self {
        Self { memory: Some(MemoryAccount::new(limit)), ..self }
    }

    /// Returns the progress of long work on the results of the run, such as a render.
    pub fn progress(&self) -> &WorkProgress {
        &self.progress
    }

    /// Returns the memory account of the run, if it has a limit.
    pub fn memory(&self) -> Option<&MemoryAccount> {
        self.memory.as_ref()
    }

    /// Returns the stop of the run that this thread works on. For long work that receives no stop, which passes it to
    /// its other threads.
    pub fn current() -> Option<Arc<Self>> {
        AT_WORK.with_borrow(|all| all.last().map(Arc::clone))
    }

    /// Fails if the run that this thread works on is cancelled. For loops that receive no stop.
    ///
    /// ```
    /// use burgeon_base::{Error, Stop};
    /// use std::sync::Arc;
    ///
    /// let stop = Arc::new(Stop::new());
    /// stop.stop(Error::cancellation("the run was cancelled"));
    /// let work = stop.at_work();
    /// assert!(Stop::check_current().is_err());
    /// drop(work);
    /// assert!(Stop::check_current().is_ok());
    /// ```
    pub fn check_current() -> Result<()> {
        AT_WORK.with_borrow(|all| all.last().map_or(Ok(()), |stop| stop.check()))
    }

    /// Registers that this thread works on the run of this stop, until the result is dropped.
    pub fn at_work(self: &Arc<Self>) -> StopAtWork {
        AT_WORK.with_borrow_mut(|all| {
            all.push(Arc::clone(self));
            switch(owner(all));
        });
        StopAtWork { stop: Arc::clone(self) }
    }

    /// Cancels the work; the first reason is kept.
    pub fn stop(&self, reason: Error) {
        self.reason.lock().recover().get_or_insert(reason);
        self.stopped.store(true, Ordering::Release);
    }

    /// Returns true if the work is cancelled.
    #[inline]
    pub fn is_stopped(&self) -> bool {
        self.stopped.load(Ordering::Acquire)
            || self.memory.as_ref().is_some_and(MemoryAccount::is_exceeded)
            || self.parent.as_ref().is_some_and(|parent| parent.is_stopped())
    }

    /// Fails with the reason if the work is cancelled.
    pub fn check(&self) -> Result<()> {
        if !self.is_stopped() {
            return Ok(());
        }
        if !self.stopped.load(Ordering::Acquire) {
            if let Some(memory) = self.memory.as_ref().filter(|memory| memory.is_exceeded()) {
                return Err(memory.error());
            }
            if let Some(parent) = &self.parent {
                return parent.check();
            }
        }
        let reason = self.reason.lock().recover().clone();
        Err(reason.unwrap_or_else(|| Error::cancellation("stopped")))
    }
}

/// Guard for the work of a thread on a run.
#[derive(Debug)]
pub struct StopAtWork {
    stop: Arc<Stop>,
}

/// Returns the memory owner to charge for a thread that works on all these runs, the most recent last.
fn owner(at_work: &[Arc<Stop>]) -> MemoryOwner {
    at_work
        .iter()
        .rev()
        .find_map(|stop| stop.memory.as_ref())
        .map_or(MemoryOwner::NOBODY, MemoryAccount::owner)
}

impl Drop for StopAtWork {
    fn drop(&mut self) {
        // A thread may begin the next run before it leaves the previous one. While the thread exits, the list may be
        // gone already.
        let _ = AT_WORK.try_with(|all| {
            let mut all = all.borrow_mut();
            if let Some(index) = all.iter().rposition(|known| Arc::ptr_eq(known, &self.stop)) {
                all.remove(index);
                switch(owner(&all));
            }
        });
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_stop_under_another_stops_with_its_reason() {
        let parent = Arc::new(Stop::default());
        let (child, other) = (Stop::under(Some(Arc::clone(&parent))), Stop::under(Some(Arc::clone(&parent))));
        other.stop(Error::cancellation("mine"));
        assert!(!child.is_stopped() && !parent.is_stopped());
        parent.stop(Error::cancellation("all"));
        assert_eq!(child.check().unwrap_err().message(), "all");
        assert_eq!(other.check().unwrap_err().message(), "mine");
    }

    #[test]
    fn a_thread_works_on_the_run_that_it_began_last() {
        let (first, second) = (Arc::new(Stop::default()), Arc::new(Stop::default()));
        let is_current = |stop: &Arc<Stop>| Stop::current().is_some_and(|known| Arc::ptr_eq(&known, stop));
        let work = first.at_work();
        let next = second.at_work();
        assert!(is_current(&second));
        drop(work);
        assert!(is_current(&second));
        drop(next);
        assert!(Stop::current().is_none());
    }
}
