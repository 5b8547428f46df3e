//! Work of several threads whose results are taken in order.

use burgeon_base::error::{Error, Result};
use burgeon_base::locks::LockRecovery;
use burgeon_base::stop::Stop;
use std::collections::BTreeMap;
use std::sync::mpsc::{Sender, channel};
use std::sync::{Condvar, Mutex};

/// Number of results for each thread that may wait for an earlier one.
const AHEAD: usize = 2;

/// Numbers that are being worked on.
#[derive(Default)]
struct WorkQueue {
    state: Mutex<QueueState>,
    changed: Condvar,
}

#[derive(Default)]
struct QueueState {
    /// Next number to work on.
    next: usize,
    /// Number of results that were taken.
    taken: usize,
    over: bool,
}

impl WorkQueue {
    /// Returns the next number below `count`, once it is less than `ahead` of the results that were taken. `None` if the
    /// work is over.
    fn take(&self, count: usize, ahead: usize) -> Option<usize> {
        let mut state = self.state.lock().recover();
        loop {
            if state.over || state.next >= count {
                return None;
            }
            if state.next < state.taken + ahead {
                state.next += 1;
                return Some(state.next - 1);
            }
            state = self.changed.wait(state).unwrap_or_else(std::sync::PoisonError::into_inner);
        }
    }

    fn change(&self, change: impl FnOnce(&mut QueueState)) {
        change(&mut self.state.lock().recover());
        self.changed.notify_all();
    }
}

/// Ends the work of all threads if its own thread panics, so that none of them waits for ever.
struct PanicGuard<'a>(&'a WorkQueue);

impl Drop for PanicGuard<'_> {
    fn drop(&mut self) {
        if std::thread::panicking() {
            self.0.change(|state| state.over = true);
        }
    }
}

/// Calls `work` for all numbers below `count` on `threads` threads, and `take` with the results in order. The number of
/// results that wait is limited.
///
/// The first error in order ends the work and is returned; `stop`, which is requested then, ends the work that is running.
pub(super) fn in_order<T: Send>(
    count: usize,
    threads: usize,
    stop: &Stop,
    work: impl Fn(usize) -> Result<T> + Sync,
    mut take: impl FnMut(usize, T) -> Result<()>,
) -> Result<()> {
    let queue = WorkQueue::default();
    let worker = |outbox: Sender<(usize, Result<T>)>| {
        let _guard = PanicGuard(&queue);
        while let Some(number) = queue.take(count, AHEAD * threads) {
            if outbox.send((number, work(number))).is_err() {
                break;
            }
        }
    };
    std::thread::scope(|scope| {
        let (outbox, inbox) = channel();
        for outbox in std::iter::repeat_n(outbox, threads.min(count)) {
            let worker = &worker;
            scope.spawn(move || worker(outbox));
        }
        let mut early = BTreeMap::new();
        let mut expected = 0;
        let mut done = Ok(());
        for (number, result) in inbox {
            early.insert(number, result);
            while let Some(result) = early.remove(&expected) {
                done = result.and_then(|result| take(expected, result));
                if done.is_err() {
                    break;
                }
                expected += 1;
                queue.change(|state| state.taken = expected);
            }
            if done.is_err() {
                break;
            }
        }
        if done.is_err() {
            stop.stop(Error::cancellation("another frame failed"));
        }
        queue.change(|state| state.over = true);
        done
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::sync::atomic::{AtomicUsize, Ordering};
    use std::time::Duration;

    #[test]
    fn results_are_taken_in_order_and_few_wait() {
        for threads in [1, 3] {
            let (running, most) = (AtomicUsize::new(0), AtomicUsize::new(0));
            let mut taken = Vec::new();
            let work = |number: usize| {
                most.fetch_max(running.fetch_add(1, Ordering::SeqCst) + 1, Ordering::SeqCst);
                std::thread::sleep(Duration::from_millis(if number == 4 { 60 } else { 1 }));
                Ok(number)
            };
            let take = |expected, number| {
                assert_eq!(expected, number);
                running.fetch_sub(1, Ordering::SeqCst);
                taken.push(number);
                Ok(())
            };
            in_order(40, threads, &Stop::new(), work, take).unwrap();
            assert_eq!(taken, (0..40).collect::<Vec<_>>());
            assert!(most.load(Ordering::SeqCst) <= AHEAD * threads, "{most:?} of {threads}");
        }
    }

    #[test]
    fn the_first_error_in_order_ends_the_work() {
        let worked = AtomicUsize::new(0);
        let stop = Stop::new();
        let work = |number: usize| {
            worked.fetch_add(1, Ordering::SeqCst);
            // A later number fails earlier.
            std::thread::sleep(Duration::from_millis(if number == 6 { 30 } else { 1 }));
            if number >= 6 { Err(Error::other(format!("{number} failed"))) } else { Ok(number) }
        };
        let mut taken = 0;
        let error = in_order(1000, 2, &stop, work, |_, _| {
            taken += 1;
            Ok(())
        });
        assert_eq!(error.unwrap_err().message(), "6 failed");
        assert!(taken == 6 && worked.load(Ordering::SeqCst) < 20 && stop.is_stopped());
        let error = in_order(9, 2, &Stop::new(), Ok, |number, _| {
            if number == 3 { Err(Error::other("the disk is full")) } else { Ok(()) }
        });
        assert_eq!(error.unwrap_err().message(), "the disk is full");
    }
}
