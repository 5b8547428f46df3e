//! Progress on stderr, if it is a terminal.

use std::io::IsTerminal;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::thread::JoinHandle;
use std::time::{Duration, Instant};

use burgeon::script::Session;
use indicatif::{ProgressBar, ProgressStyle};

/// Time before progress is shown.
const PATIENCE: Duration = Duration::from_millis(400);

/// Display of a run's progress. It ends when it is dropped.
pub(crate) struct ProgressDisplay {
    over: Arc<AtomicBool>,
    thread: Option<JoinHandle<()>>,
}

impl ProgressDisplay {
    /// Shows the progress of `session` and of the renders of its model, unless stderr is not a terminal or `wanted` is false.
    pub(crate) fn show(session: &Arc<Session>, wanted: bool) -> Self {
        let session = Arc::clone(session);
        let begin = Instant::now();
        let message = move || {
            let work = session.stop.progress().message();
            work.unwrap_or_else(|| session.progress.message(begin.elapsed()))
        };
        Self::saying(message, wanted)
    }

    /// Shows `message` repeatedly, unless stderr is not a terminal or `wanted` is false.
    pub(crate) fn saying(message: impl Fn() -> String + Send + 'static, wanted: bool) -> Self {
        let over = Arc::new(AtomicBool::new(false));
        if !wanted || !std::io::stderr().is_terminal() {
            return Self { over, thread: None };
        }
        let done = Arc::clone(&over);
        let thread = std::thread::spawn(move || {
            let begin = Instant::now();
            while begin.elapsed() < PATIENCE {
                std::thread::sleep(Duration::from_millis(20));
                if done.load(Ordering::Relaxed) {
                    return;
                }
            }
            // A wide message is cut at the edge of the terminal; a wrapped one would leave lines behind.
            let style = ProgressStyle::with_template("{spinner} {wide_msg}");
            let bar = ProgressBar::new_spinner()
                .with_style(style.unwrap_or_else(|_| ProgressStyle::default_spinner()));
            while !done.load(Ordering::Relaxed) {
                bar.set_message(message());
                bar.tick();
                std::thread::sleep(Duration::from_millis(80));
            }
            bar.finish_and_clear();
        });
        Self { over, thread: Some(thread) }
    }
}

impl Drop for ProgressDisplay {
    fn drop(&mut self) {
        self.over.store(true, Ordering::Relaxed);
        if let Some(thread) = self.thread.take() {
            // The result of the thread is not needed.
            let _ = thread.join();
        }
    }
}
