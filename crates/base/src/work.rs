//! Limits of the current work of a thread, for long work that does not receive them as arguments.

use std::cell::RefCell;
use std::sync::Arc;

use crate::budget::Budget;
use crate::error::Result;
use crate::stop::Stop;

thread_local! {
    /// Budgets of all current work of this thread, the most recent last.
    static BUDGETS: RefCell<Vec<Arc<Budget>>> = const { RefCell::new(Vec::new()) };
}

/// Returns the builder of a thread with a name that begins with `burgeon`, as debuggers show it.
pub fn named_thread(purpose: &str) -> std::thread::Builder {
    std::thread::Builder::new().name(format!("burgeon {purpose}"))
}

/// Stop of the run and budget of the query that a thread works on.
#[derive(Debug, Default)]
pub struct WorkLimits {
    stop: Option<Arc<Stop>>,
    budget: Option<Arc<Budget>>,
}

impl WorkLimits {
    /// Returns the limits of this thread's work. Long work passes them to its other threads.
    pub fn current() -> Self {
        Self { stop: Stop::current(), budget: BUDGETS.with_borrow(|all| all.last().map(Arc::clone)) }
    }

    /// Fails if the work must end.
    pub fn check(&self) -> Result<()> {
        self.stop.as_ref().map_or(Ok(()), |stop| stop.check())?;
        self.budget.as_ref().map_or(Ok(()), |budget| budget.check())
    }
}

/// Guard for the work of a thread within a budget.
///
/// ```
/// use burgeon_base::{Budget, Error, WorkLimits, WorkWithin};
///
/// let budget = Budget::new(1_000_000, || Err(Error::cancellation("enough")));
/// let work = WorkWithin::begin(&budget);
/// assert!(WorkLimits::current().check().is_err());
/// drop(work);
/// assert!(WorkLimits::current().check().is_ok());
/// ```
#[derive(Debug)]
pub struct WorkWithin(());

impl WorkWithin {
    /// Begins work within a budget. Guards must be dropped in reverse order.
    pub fn begin(budget: &Arc<Budget>) -> Self {
        BUDGETS.with_borrow_mut(|all| all.push(Arc::clone(budget)));
        Self(())
    }
}

impl Drop for WorkWithin {
    fn drop(&mut self) {
        // While the thread exits, the list may be gone already.
        let _ = BUDGETS.try_with(|all| all.borrow_mut().pop());
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::error::Error;

    #[test]
    fn work_ends_with_the_budget_that_it_began_in_or_the_stop_of_its_run() {
        assert!(WorkLimits::current().check().is_ok());
        let budget = Budget::new(1, || Err(Error::cancellation("over")));
        let work = WorkWithin::begin(&budget);
        assert!(WorkLimits::current().check().is_err());
        let inner = WorkWithin::begin(&Arc::default());
        assert!(WorkLimits::current().check().is_ok());
        drop((inner, work));
        let stop = Arc::new(Stop::default());
        let _work = stop.at_work();
        assert!(WorkLimits::current().check().is_ok());
        stop.stop(Error::cancellation("enough"));
        assert!(WorkLimits::current().check().is_err());
    }
}
