//! The end of work that nobody waits for any more.

use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex};

use crate::error::{Error, Result};
use crate::locks::LockRecovery;

/// Tells everything that works on a run, or on what comes of it, to stop, and why.
#[derive(Debug, Default)]
pub struct Stop {
    parent: Option<Arc<Stop>>,
    stopped: AtomicBool,
    reason: Mutex<Option<Error>>,
}

impl Stop {
    /// One that nobody has asked for.
    pub const fn new() -> Self {
        Self { parent: None, stopped: AtomicBool::new(false), reason: Mutex::new(None) }
    }

    /// Stops whenever `parent` does, too.
    pub fn under(parent: Option<Arc<Self>>) -> Self {
        Self { parent, ..Self::default() }
    }

    /// Asks for a stop; the first reason is kept.
    pub fn stop(&self, reason: Error) {
        self.reason.lock().recover().get_or_insert(reason);
        self.stopped.store(true, Ordering::Release);
    }

    /// Whether a stop was asked for.
    #[inline]
    pub fn is_stopped(&self) -> bool {
        self.stopped.load(Ordering::Acquire) || self.parent.as_ref().is_some_and(|parent| parent.is_stopped())
    }

    /// The reason as an error, if a stop was asked for.
    pub fn check(&self) -> Result<()> {
        if !self.is_stopped() {
            return Ok(());
        }
        if let Some(parent) = self.parent.as_ref().filter(|_| !self.stopped.load(Ordering::Acquire)) {
            return parent.check();
        }
        let reason = self.reason.lock().recover().clone();
        Err(reason.unwrap_or_else(|| Error::stopped("stopped")))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_stop_under_another_stops_with_its_reason() {
        let parent = Arc::new(Stop::default());
        let (child, other) = (Stop::under(Some(Arc::clone(&parent))), Stop::under(Some(Arc::clone(&parent))));
        other.stop(Error::stopped("mine"));
        assert!(!child.is_stopped() && !parent.is_stopped());
        parent.stop(Error::stopped("all"));
        assert_eq!(child.check().unwrap_err().message(), "all");
        assert_eq!(other.check().unwrap_err().message(), "mine");
    }
}
