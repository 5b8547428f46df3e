//! Progress on stderr, only where a person sees it.

use std::io::IsTerminal;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::thread::JoinHandle;
use std::time::{Duration, Instant};

use burgeon::script::Session;
use indicatif::{ProgressBar, ProgressStyle};

/// How long a run may be silent.
const PATIENCE: Duration = Duration::from_millis(400);

/// Shows how far a run has come until it is dropped.
pub(crate) struct ProgressDisplay {
    over: Arc<AtomicBool>,
    thread: Option<JoinHandle<()>>,
}

impl ProgressDisplay {
    /// Watches `session`; silent unless stderr is a terminal and `wanted`.
    pub(crate) fn show(session: &Arc<Session>, wanted: bool) -> Self {
        let session = Arc::clone(session);
        let begin = Instant::now();
        Self::saying(move || session.progress.message(begin.elapsed()), wanted)
    }

    /// Shows `message` again and again; silent unless stderr is a terminal and `wanted`.
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
            // A wide message is cut where the terminal ends; another would leave its lines behind.
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
            // What it shows does not matter any more.
            let _ = thread.join();
        }
    }
}
