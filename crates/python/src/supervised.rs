//! Work on a thread of its own, while the calling thread answers signals and calls functions of Python.

use std::sync::Arc;
use std::sync::mpsc::{Receiver, RecvTimeoutError, Sender, channel};
use std::time::{Duration, Instant};

use burgeon::{Error, Result, Stop};
use pyo3::prelude::*;

use crate::errors::exception;

/// Time between two checks for signals such as Ctrl-C.
const PULSE: Duration = Duration::from_millis(50);

/// Stack of the thread that works (bytes), as large as that of a program's first thread.
const STACK: usize = 8 << 20;

/// Message of the thread that works.
pub(crate) enum WorkMessage<T> {
    /// A text that a script has printed.
    Printed(String),
    /// Result of the work.
    Done(Result<T>),
}

/// Calls `work` on another thread without the interpreter's lock, and waits for its result.
///
/// Meanwhile passes printed texts to `print`, and calls `pulse` with the time since the beginning. An exception of one of
/// them, or of a signal handler, cancels the work by `stop` and is raised when the work has ended.
pub(crate) fn supervise<T: Send + 'static>(
    py: Python<'_>,
    stop: &Stop,
    (sender, receiver): (Sender<WorkMessage<T>>, Receiver<WorkMessage<T>>),
    print: impl Fn(&str) -> PyResult<()>,
    pulse: impl Fn(Duration) -> PyResult<()>,
    work: impl FnOnce() -> Result<T> + Send + 'static,
) -> PyResult<T> {
    let thread = std::thread::Builder::new().name("burgeon".to_owned()).stack_size(STACK);
    let spawned = thread.spawn(move || {
        // The receiver waits for the result, whatever happens.
        let _ = sender.send(WorkMessage::Done(unwound(work)));
    });
    if let Err(error) = spawned {
        return Err(exception(py, &Error::system(format!("cannot start a thread: {error}"))));
    }
    let (begin, mut last) = (Instant::now(), Instant::now());
    let mut raised: Option<PyErr> = None;
    let check = |raised: &mut Option<PyErr>, call: &dyn Fn() -> PyResult<()>| {
        if raised.is_none()
            && let Err(error) = call()
        {
            stop.stop(Error::cancellation("cancelled"));
            *raised = Some(error);
        }
    };
    // A receiver cannot be shared between threads, but this thread alone uses it.
    let receiver = std::sync::Mutex::new(receiver);
    let result = loop {
        let message = py.detach(|| match receiver.lock() {
            Ok(receiver) => receiver.recv_timeout(PULSE),
            Err(_) => Err(RecvTimeoutError::Disconnected),
        });
        match message {
            Ok(WorkMessage::Printed(text)) => check(&mut raised, &|| print(&text)),
            Ok(WorkMessage::Done(result)) => break result,
            Err(RecvTimeoutError::Timeout) => {}
            Err(RecvTimeoutError::Disconnected) => break Err(panic_error()),
        }
        if last.elapsed() >= PULSE {
            last = Instant::now();
            check(&mut raised, &|| py.check_signals());
            check(&mut raised, &|| pulse(begin.elapsed()));
        }
    };
    match raised {
        Some(error) => Err(error),
        None => result.map_err(|error| exception(py, &error)),
    }
}

/// Calls `work`, and returns an error if it panics: no panic may reach Python.
fn unwound<T>(work: impl FnOnce() -> Result<T>) -> Result<T> {
    std::panic::catch_unwind(std::panic::AssertUnwindSafe(work)).unwrap_or_else(|_| Err(panic_error()))
}

fn panic_error() -> Error {
    Error::internal("the work panicked").help("report it with the script")
}

/// Calls `work` as [`supervise`] does, without printed texts.
pub(crate) fn supervise_quietly<T: Send + 'static>(
    py: Python<'_>,
    stop: &Arc<Stop>,
    work: impl FnOnce() -> Result<T> + Send + 'static,
) -> PyResult<T> {
    supervise(py, stop, channel(), |_| Ok(()), |_| Ok(()), work)
}
