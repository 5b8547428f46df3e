//! Time limit and cancellation of scripts, without cost while a script runs.

use std::ffi::c_int;
use std::sync::{Arc, Condvar, Mutex};
use std::thread::JoinHandle;
use std::time::{Duration, Instant};

use mlua::{Lua, ffi};

use crate::declare::Session;
use burgeon_base::MemoryAccount;
use burgeon_base::error::{Error, Limit};
use burgeon_base::locks::LockRecovery;
use burgeon_base::text::grouped;

/// Time between two checks for cancellation.
const PERIOD: Duration = Duration::from_millis(20);
/// Time between two checks while more than half of the memory limit is used.
const SHORT_PERIOD: Duration = Duration::from_millis(1);

/// Thread that stops all virtual machines of a run at its time limit or on cancellation.
///
/// Luau polls for an interrupt callback at loops and calls in any case, so an unset callback costs nothing.
/// Once set, the callback raises an error at every poll, so that `pcall` cannot suppress it.
pub struct Watchdog {
    shared: Arc<WatchdogLock>,
    thread: Option<JoinHandle<()>>,
}

#[derive(Default)]
struct WatchdogLock {
    inner: Mutex<WatchdogState>,
    wake: Condvar,
}

#[derive(Default)]
struct WatchdogState {
    states: Vec<StatePointer>,
    stopped: bool,
    over: bool,
}

#[derive(Clone, Copy, PartialEq)]
struct StatePointer(*mut ffi::lua_State);

#[allow(unsafe_code, reason = "the watchdog sets a callback of machines that run in other threads")]
// SAFETY: the pointer is used only to set the interrupt callback, while the machine is registered and
// therefore alive.
unsafe impl Send for StatePointer {}

/// Registration of a machine with the watchdog; must be dropped before the machine's state.
pub(crate) struct Registration {
    shared: Arc<WatchdogLock>,
    state: StatePointer,
}

impl Registration {
    /// Runs a short action in the machine even if its run has been stopped.
    pub(crate) fn despite_stop<T>(&self, act: impl FnOnce() -> T) -> T {
        let inner = self.shared.inner.lock().recover();
        if inner.stopped {
            set_interrupt(self.state, None);
        }
        let done = act();
        if inner.stopped {
            interrupt(self.state);
        }
        done
    }
}

impl Watchdog {
    /// Starts watching `session`.
    pub fn new(session: &Arc<Session>) -> Self {
        let shared = Arc::new(WatchdogLock::default());
        let (theirs, watched) = (Arc::clone(&shared), Arc::clone(session));
        let deadline = Instant::now() + session.options.limits.time;
        let watch = move || {
            let stop = &watched.stop;
            let mut inner = theirs.inner.lock().recover();
            while !inner.over && !stop.is_stopped() {
                if Instant::now() >= deadline {
                    stop.stop(overdue(&watched));
                    break;
                }
                let is_half_full = stop.memory().is_some_and(MemoryAccount::is_half_full);
                let period = if is_half_full { SHORT_PERIOD } else { PERIOD };
                inner = theirs.wake.wait_timeout(inner, period).recover().0;
            }
            if !inner.over {
                inner.stopped = true;
                inner.states.iter().for_each(|state| interrupt(*state));
            }
        };
        Self { shared, thread: Some(std::thread::spawn(watch)) }
    }

    pub(crate) fn register(&self, lua: &Lua) -> Registration {
        let mut state = std::ptr::null_mut();
        #[allow(unsafe_code, reason = "mlua gives the state only to raw functions")]
        // SAFETY: the function neither reads nor changes the stack.
        let taken: mlua::Result<()> = unsafe { lua.exec_raw((), |raw| state = raw) };
        let state = StatePointer(if taken.is_ok() { state } else { std::ptr::null_mut() });
        let mut inner = self.shared.inner.lock().recover();
        inner.states.push(state);
        if inner.stopped {
            interrupt(state);
        }
        drop(inner);
        Registration { shared: Arc::clone(&self.shared), state }
    }
}

/// Returns the error for a run that reached its time limit.
fn overdue(session: &Session) -> Error {
    let error = Error::limit(
        Limit::Time,
        format!("the run exceeded the time limit of {} s", session.options.limits.time.as_secs_f64()),
    );
    match session.progress.counts() {
        (0, ..) => error.help("look for an endless loop, or raise the limit: --time-limit SECONDS"),
        (step, _, modules) => error.help(format!(
            "step {} is complete, with {} modules: derive fewer steps, look for an endless loop, or raise the limit: --time-limit SECONDS",
            grouped(step),
            grouped(modules)
        )),
    }
}

impl Drop for Watchdog {
    fn drop(&mut self) {
        self.shared.inner.lock().recover().over = true;
        self.shared.wake.notify_all();
        if let Some(thread) = self.thread.take() {
            // A watchdog that panicked cannot stop anything.
            let _ = thread.join();
        }
    }
}

impl Drop for Registration {
    fn drop(&mut self) {
        let mut inner = self.shared.inner.lock().recover();
        if let Some(index) = inner.states.iter().position(|state| *state == self.state) {
            inner.states.swap_remove(index);
        }
    }
}

fn interrupt(state: StatePointer) {
    set_interrupt(state, Some(raise));
}

fn set_interrupt(
    state: StatePointer,
    callback: Option<unsafe extern "C-unwind" fn(*mut ffi::lua_State, c_int)>,
) {
    if state.0.is_null() {
        return;
    }
    #[allow(unsafe_code, reason = "Luau offers no other way to stop a running script from outside")]
    // SAFETY: the machine is registered, so its state is alive. Luau reads the pointer at safe points and
    // documents that it may be set from another thread.
    unsafe {
        (*ffi::lua_callbacks(state.0)).interrupt = callback;
    }
}

#[allow(unsafe_code, reason = "called by Luau")]
unsafe extern "C-unwind" fn raise(state: *mut ffi::lua_State, collecting: c_int) {
    // Luau also calls this during garbage collection, with a number from 0; then no error may be raised.
    if collecting < 0 {
        // SAFETY: `state` is the running state from Luau. The frame owns nothing that must be dropped, and
        // luaL_where pushes one string; at most three are on the stack.
        unsafe {
            ffi::lua_checkstack(state, 4);
            // The innermost function can be a C function, which has no line.
            for level in 0..3 {
                ffi::luaL_where(state, level);
                if ffi::lua_objlen(state, -1) > 0 || level == 2 {
                    break;
                }
                ffi::lua_pop(state, 1);
            }
            ffi::lua_pushstring(state, c"stopped".as_ptr());
            ffi::lua_concat(state, 2);
            ffi::lua_error(state)
        }
    }
}
