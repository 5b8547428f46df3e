//! `burgeon run --watch`: writes the outputs again when the script changes.

use std::path::PathBuf;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{Sender, channel};
use std::sync::{Arc, Mutex};
use std::time::{Duration, Instant, SystemTime};

use burgeon::locks::LockRecovery;
use burgeon::script::Session;
use burgeon::watch::{Watch, unsettled};
use burgeon::{Error, Result};

use super::super::report;
use super::super::shared::on_interrupt;
use super::RunCommand;

/// Maximum time for which failures are withheld because files are changing.
const DOUBT: Duration = Duration::from_secs(2);

/// State that the watcher and the interrupt handler share with the current run.
#[derive(Clone, Default)]
struct WatchState {
    session: Arc<Mutex<Option<Arc<Session>>>>,
    /// Set if files have changed since the run read them.
    stale: Arc<AtomicBool>,
    over: Arc<AtomicBool>,
}

impl WatchState {
    /// Cancels the current run, and wakes the loop that waits for the next one.
    fn stop(&self, wake: &Sender<()>) {
        self.stale.store(true, Ordering::Release);
        if let Some(session) = &*self.session.lock().recover() {
            session.stop.stop(Error::cancellation("there is something newer"));
        }
        // An error means that the loop has ended.
        let _ = wake.send(());
    }

    fn is_stale(&self) -> bool {
        self.stale.load(Ordering::Acquire)
    }
}

/// Runs, writes and reports the result, and repeats that after every change until interrupted.
///
/// A failed run reports its error and keeps the files of earlier runs.
pub(super) fn again_and_again(command: &RunCommand) -> Result<()> {
    let now = WatchState::default();
    let (wake, changes) = channel();
    let (seen, waker) = (now.clone(), wake.clone());
    let mut files: Vec<(PathBuf, bool)> = Vec::new();
    let watch = Watch::new(
        command.script.files(),
        move |_| seen.stop(&waker),
        |why| report::eprint(&format!("{why}\n")),
    )?;
    let interrupted = now.clone();
    on_interrupt(move || {
        interrupted.over.store(true, Ordering::Release);
        interrupted.stop(&wake);
    })?;
    let mut doubts: Option<Instant> = None;
    loop {
        now.stale.store(now.over.load(Ordering::Acquire), Ordering::Release);
        let (begin, since) = (Instant::now(), SystemTime::now());
        let (made, mut sought) = match command.session() {
            Ok(session) => {
                *now.session.lock().recover() = Some(Arc::clone(&session));
                if now.is_stale() {
                    session.stop.stop(Error::cancellation("there is something newer"));
                }
                let made = command.make(&session, begin, &|| now.is_stale());
                now.session.lock().recover().take();
                (made, session.sought())
            }
            Err(error) => (Err(error), Vec::new()),
        };
        // These files are watched from the start.
        sought.extend(command.script.files().into_iter().map(|path| (path, true)));
        let stale = now.is_stale();
        // A cancelled run has not reached all of its files.
        if stale {
            files.extend(sought);
        } else {
            files = sought;
        }
        watch.follow(files.clone(), since);
        if let Err(error) = made
            && !stale
        {
            // The run may have read a file that was only half written.
            let young = unsettled(files.iter().map(|(path, _)| path.as_path()));
            let patient = doubts.get_or_insert_with(Instant::now).elapsed() < DOUBT;
            let newer = patient && {
                let soon = changes.recv_timeout(young.unwrap_or_default()).is_ok();
                soon || {
                    watch.catch_up();
                    changes.try_recv().is_ok()
                }
            };
            if newer {
                if now.over.load(Ordering::Acquire) {
                    return Ok(());
                }
                while changes.try_recv().is_ok() {}
                continue;
            }
            report::error(&error, command.json());
        }
        doubts = None;
        if !now.is_stale() {
            burgeon::script::make_ready();
        }
        if changes.recv().is_err() || now.over.load(Ordering::Acquire) {
            return Ok(());
        }
        while changes.try_recv().is_ok() {}
    }
}
