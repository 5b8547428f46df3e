//! Work on a thread of its own, for libraries that cannot be interrupted.

use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::Arc;
use std::sync::atomic::{AtomicU8, AtomicUsize, Ordering};
use std::sync::mpsc::{RecvTimeoutError, sync_channel};
use std::time::Duration;

use burgeon_base::error::Result;
use burgeon_base::work::{WorkLimits, named_thread};

/// Time between two checks for cancellation.
const PAUSE: Duration = Duration::from_millis(10);
/// Number of abandoned threads that may run before other work waits for them.
const MOST_ABANDONED: usize = 2;

/// Number of threads whose work nobody waits for.
static ABANDONED_THREADS: AtomicUsize = AtomicUsize::new(0);

/// States of the work.
const RUNNING: u8 = 0;
const DONE: u8 = 1;
const ABANDONED: u8 = 2;

/// Runs `work` on a thread of its own; `None` if it panics.
///
/// If the work of this thread is cancelled, it fails at once, and the other thread ends by itself. Its result is dropped.
pub(crate) fn run_abandonable<T: Send + 'static>(
    work: impl FnOnce() -> T + Send + 'static,
) -> Result<Option<T>> {
    let limits = WorkLimits::current();
    while ABANDONED_THREADS.load(Ordering::Acquire) >= MOST_ABANDONED {
        limits.check()?;
        std::thread::sleep(PAUSE);
    }
    let (sender, receiver) = sync_channel(1);
    let state = Arc::new(AtomicU8::new(RUNNING));
    let shared = Arc::clone(&state);
    let run = move || {
        // The receiver may be gone.
        let _ = sender.send(catch_unwind(AssertUnwindSafe(work)).ok());
        if shared.swap(DONE, Ordering::AcqRel) == ABANDONED {
            ABANDONED_THREADS.fetch_sub(1, Ordering::AcqRel);
        }
    };
    if named_thread("solids").spawn(run).is_err() {
        return Ok(None);
    }
    loop {
        match receiver.recv_timeout(PAUSE) {
            Ok(result) => return Ok(result),
            Err(RecvTimeoutError::Disconnected) => return Ok(None),
            Err(RecvTimeoutError::Timeout) => {
                if let Err(error) = limits.check() {
                    ABANDONED_THREADS.fetch_add(1, Ordering::AcqRel);
                    if state.swap(ABANDONED, Ordering::AcqRel) == DONE {
                        ABANDONED_THREADS.fetch_sub(1, Ordering::AcqRel);
                    }
                    return Err(error);
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use std::time::Instant;

    use burgeon_base::error::Error;
    use burgeon_base::{Budget, WorkWithin};

    use super::*;

    #[test]
    fn cancelled_work_is_abandoned_at_once_and_other_work_goes_on() {
        assert_eq!(run_abandonable(|| 4).expect("a result"), Some(4));
        assert_eq!(
            run_abandonable(|| -> u8 { std::panic::resume_unwind(Box::new(())) }).expect("a result"),
            None
        );
        let budget = Budget::new(1, || Err(Error::cancellation("enough")));
        let begin = Instant::now();
        for _ in 0..2 {
            let work = WorkWithin::begin(&budget);
            let slow = || std::thread::sleep(Duration::from_millis(800));
            assert!(run_abandonable(slow).is_err());
            drop(work);
        }
        assert!(begin.elapsed() < Duration::from_millis(600), "{:?}", begin.elapsed());
        // Further work waits for one of the abandoned threads.
        assert_eq!(run_abandonable(|| 5).expect("a result"), Some(5));
        assert!(begin.elapsed() > Duration::from_millis(700), "{:?}", begin.elapsed());
    }
}
