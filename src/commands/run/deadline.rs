//! Time limit of the work that follows a run: rendering, and writing the other files.

use std::sync::Arc;
use std::sync::mpsc::{RecvTimeoutError, Sender, channel};
use std::time::Duration;

use burgeon::error::Limit;
use burgeon::script::Session;
use burgeon::{Error, Stop};

/// Cancels the work of a session that is not dropped within its time limit.
pub(super) struct WritingDeadline(#[allow(dead_code, reason = "dropping it ends the thread")] Sender<()>);

impl WritingDeadline {
    /// Begins to count the time of `session`.
    pub(super) fn new(session: &Session) -> Self {
        Self::within(session.options.limits.time, Arc::clone(&session.stop))
    }

    fn within(limit: Duration, stop: Arc<Stop>) -> Self {
        let (sender, receiver) = channel();
        std::thread::spawn(move || {
            if receiver.recv_timeout(limit) == Err(RecvTimeoutError::Timeout) {
                let message =
                    format!("writing the files exceeded the time limit of {} s", limit.as_secs_f64());
                stop.stop(Error::limit(Limit::Time, message).help(
                    "for a picture, lower --size or --quality; otherwise draw less, or raise the limit: --time-limit SECONDS",
                ));
            }
        });
        Self(sender)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn work_is_cancelled_at_its_time_limit_and_not_before() {
        let stop = Arc::new(Stop::new());
        let ended = WritingDeadline::within(Duration::from_millis(30), Arc::clone(&stop));
        drop(ended);
        std::thread::sleep(Duration::from_millis(60));
        assert!(stop.check().is_ok());
        let _late = WritingDeadline::within(Duration::from_millis(10), Arc::clone(&stop));
        std::thread::sleep(Duration::from_millis(200));
        let error = stop.check().unwrap_err();
        assert!(error.message().contains("the time limit of 0.01 s"), "{error}");
    }
}
