//! The limits of the work that a thread is at: long work that is not handed them asks here.

use std::cell::RefCell;
use std::sync::Arc;

use crate::budget::Budget;
use crate::error::Result;
use crate::stop::Stop;

thread_local! {
    /// The budgets of all work that this thread is at, the last one last.
    static BUDGETS: RefCell<Vec<Arc<Budget>>> = const { RefCell::new(Vec::new()) };
}

/// The stop of the run and the budget of the query that a thread works on.
#[derive(Debug, Default)]
pub struct WorkLimits {
    stop: Option<Arc<Stop>>,
    budget: Option<Arc<Budget>>,
}

impl WorkLimits {
    /// Returns the limits of this thread's work; long work takes them to its other threads.
    pub fn current() -> Self {
        Self { stop: Stop::current(), budget: BUDGETS.with_borrow(|all| all.last().map(Arc::clone)) }
    }

    /// Fails if the work is to end.
    pub fn check(&self) -> Result<()> {
        self.stop.as_ref().map_or(Ok(()), |stop| stop.check())?;
        self.budget.as_ref().map_or(Ok(()), |budget| budget.check())
    }
}

/// Work of a thread within a budget, until it is dropped.
#[derive(Debug)]
pub struct WorkWithin(());

impl WorkWithin {
    /// Begins work within a budget. What begins later ends before.
    pub fn begin(budget: &Arc<Budget>) -> Self {
        BUDGETS.with_borrow_mut(|all| all.push(Arc::clone(budget)));
        Self(())
    }
}

impl Drop for WorkWithin {
    fn drop(&mut self) {
        // While a thread ends, there may be nothing to leave.
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
        let budget = Budget::new(1, || Err(Error::stopped("over")));
        let work = WorkWithin::begin(&budget);
        assert!(WorkLimits::current().check().is_err());
        let inner = WorkWithin::begin(&Arc::default());
        assert!(WorkLimits::current().check().is_ok());
        drop((inner, work));
        let stop = Arc::new(Stop::default());
        let _work = stop.at_work();
        assert!(WorkLimits::current().check().is_ok());
        stop.stop(Error::stopped("enough"));
        assert!(WorkLimits::current().check().is_err());
    }
}
