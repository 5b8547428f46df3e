//! Helper threads: each runs the same script in its own machine and waits at `derive` for work.

use std::cell::RefCell;
use std::collections::hash_map::Entry;
use std::rc::Rc;
use std::sync::mpsc::{Receiver, Sender, channel};
use std::sync::{Arc, Weak};
use std::thread::JoinHandle;
use std::time::{Duration, Instant};

use rustc_hash::FxHashMap;

use super::functions::LuaRules;
use super::interpret::InterpretationPass;
use super::lead::{Ending, lead};
use super::plan::DerivationPlan;
use crate::declare::Session;
use crate::machine::{DerivationRequest, Driver, Machine, SystemFunctions, Watchdog};
use crate::results::{DerivedSystem, Trace};
use burgeon_base::error::{Error, Result};
use burgeon_base::named_thread;
use burgeon_kit::Prefetch;
use burgeon_rewriting::{Scratch, StepWork};

/// Work for all threads. The references are weak, so a helper that starts late does not keep finished work
/// alive.
#[derive(Clone)]
pub(crate) enum ThreadJob {
    Rewrite { work: Weak<StepWork>, plan: Weak<DerivationPlan> },
    Interpret(Weak<InterpretationPass>),
    Prefetch(Weak<dyn Prefetch>),
}

enum Message {
    Work(ThreadJob),
    Derived(Result<Arc<DerivedSystem>>),
}

struct Helper {
    outbox: Sender<Message>,
    thread: JoinHandle<()>,
}

/// Approximate time to start a helper.
const STARTING: Duration = Duration::from_millis(20);

/// Machine whose result counts, and its helper threads.
#[derive(Clone, Copy)]
pub(crate) struct LeadingMachine<'a> {
    pub machine: &'a Machine,
    pub threads: &'a ThreadPool,
}

/// Threads of a run from the view of one machine, which leads or follows.
pub(crate) struct ThreadPool {
    /// Results of the derivations so far, in order.
    done: RefCell<Vec<Result<Arc<DerivedSystem>>>>,
    role: RefCell<ThreadRole>,
    /// Requested lineage, once it is complete.
    trace: RefCell<Option<Trace>>,
}

enum ThreadRole {
    /// Leading machine. `since` is the first time at which there was work for helpers.
    Lead {
        helpers: Vec<Helper>,
        watchdog: Arc<Watchdog>,
        since: Option<Instant>,
    },
    Follow {
        inbox: Rc<Receiver<Message>>,
        recorded: Vec<Result<Arc<DerivedSystem>>>,
    },
}

impl ThreadPool {
    /// Creates the threads of the leading machine.
    pub(crate) fn leading(watchdog: &Arc<Watchdog>) -> Self {
        Self::new(ThreadRole::Lead { helpers: Vec::new(), watchdog: Arc::clone(watchdog), since: None })
    }

    fn new(role: ThreadRole) -> Self {
        Self { done: RefCell::default(), role: RefCell::new(role), trace: RefCell::default() }
    }

    /// Takes the lineage that the options request, if it is complete.
    pub(crate) fn take_trace(&self) -> Option<Trace> {
        self.trace.borrow_mut().take()
    }

    /// Works for the leader until system `index` is derived, and returns the result. `None` in the leading
    /// machine.
    fn follow(&self, machine: &Machine, index: usize) -> Result<Option<Arc<DerivedSystem>>> {
        let (inbox, known) = match &*self.role.borrow() {
            ThreadRole::Lead { .. } => return Ok(None),
            ThreadRole::Follow { inbox, recorded } => {
                (Rc::clone(inbox), recorded.get(self.done.borrow().len()).cloned())
            }
        };
        // The axiom's function can change variables and draw random numbers; the following code depends on
        // both in every machine.
        machine.library.systems.borrow()[index].replay_axiom(machine)?;
        let derived = match known {
            Some(derived) => derived,
            None => serve(machine, &inbox, index)?,
        };
        machine.library.systems.borrow()[index].catch_up(machine);
        self.note_derived(machine, &derived);
        derived.map(Some)
    }

    /// Records the result of a system, and publishes its chains to queries at the top level of the script.
    fn note_derived(&self, machine: &Machine, derived: &Result<Arc<DerivedSystem>>) {
        if let Ok(derived) = derived {
            let mut view = machine.current.chains_derived.borrow_mut();
            let (chain, left_out) = derived.queried_chains();
            *view = view.with_derived(derived.system, &derived.symbols, chain, left_out);
        }
        self.done.borrow_mut().push(derived.clone());
    }

    /// Sends the result of a system from the leading machine to the helpers.
    fn finished(&self, machine: &Machine, derived: &Result<Arc<DerivedSystem>>) {
        if let ThreadRole::Lead { helpers, .. } = &*self.role.borrow() {
            for helper in helpers {
                // A helper that has ended does not need the result.
                let _ = helper.outbox.send(Message::Derived(derived.clone()));
            }
        }
        self.note_derived(machine, derived);
    }

    /// Offers a job of `pieces` pieces to helpers, at most one per piece.
    ///
    /// Helpers are started for `many` pieces, or after there has been work for helpers for longer than a
    /// start takes.
    pub(crate) fn hand_out(
        &self,
        machine: &Machine,
        pieces: usize,
        many: usize,
        job: impl Fn() -> ThreadJob,
    ) -> Result<()> {
        let useful = machine.session.options.worker_threads().min(pieces).saturating_sub(1);
        let mut role = self.role.borrow_mut();
        let ThreadRole::Lead { helpers, watchdog, since } = &mut *role else { return Ok(()) };
        if useful == 0 {
            return Ok(());
        }
        let pays = machine.session.options.threads.is_some()
            || pieces >= many
            || since.get_or_insert_with(Instant::now).elapsed() > STARTING;
        while pays && helpers.len() < useful {
            helpers.push(Helper::start(&machine.session, watchdog, self.done.borrow().clone())?);
        }
        for helper in helpers.iter().take(useful) {
            // If a helper has ended, the other threads do its share.
            let _ = helper.outbox.send(Message::Work(job()));
        }
        Ok(())
    }

    /// Waits until every helper has released a job.
    pub(crate) fn reclaim<T>(&self, mut job: Arc<T>) -> T {
        loop {
            match Arc::try_unwrap(job) {
                Ok(job) => return job,
                Err(shared) => {
                    std::thread::yield_now();
                    job = shared;
                }
            }
        }
    }
}

impl Driver for ThreadPool {
    fn derive(
        &self,
        machine: &Machine,
        index: usize,
        request: DerivationRequest<'_>,
    ) -> Result<Arc<DerivedSystem>> {
        let problems: Vec<Error> = machine.library.problems.borrow_mut().drain(..).collect();
        if !problems.is_empty() {
            return Err(Error::several(problems));
        }
        machine.library.link_subsystems(index)?;
        if let Some(derived) = self.follow(machine, index)? {
            return Ok(derived);
        }
        let derived = lead(machine, self, index, request).and_then(|ended| match ended {
            Ending::Derived(derived) => Ok(Arc::from(derived)),
            Ending::Traced(trace) => {
                self.trace.replace(Some(*trace));
                // The rest of the script does not matter.
                Err(Error::cancellation("the traced system is derived"))
            }
        });
        let derived = derived.map_err(|error: Error| {
            // The error must not depend on the machine that found it.
            error.rather_called_at(machine.library.systems.borrow()[index].caller.clone())
        });
        machine.current.objects.replace(None);
        machine.current.environments.replace(None);
        machine.load_variables(None)?;
        self.finished(machine, &derived);
        derived
    }

    fn derived(&self) -> Vec<Result<Arc<DerivedSystem>>> {
        self.done.borrow().clone()
    }

    fn count(&self) -> usize {
        self.done.borrow().len()
    }

    fn leads(&self) -> bool {
        matches!(&*self.role.borrow(), ThreadRole::Lead { .. })
    }

    fn prefetch(&self, machine: &Machine, prefetch: &Arc<dyn Prefetch>) -> Result<()> {
        self.hand_out(machine, 2, 2, || ThreadJob::Prefetch(Arc::downgrade(prefetch)))
    }
}

impl Drop for ThreadPool {
    fn drop(&mut self) {
        if let ThreadRole::Lead { helpers, .. } = self.role.get_mut() {
            for Helper { outbox, thread } in helpers.drain(..) {
                drop(outbox);
                // The result does not depend on a helper that panicked.
                let _ = thread.join();
            }
        }
    }
}

impl Helper {
    fn start(
        session: &Arc<Session>,
        watchdog: &Arc<Watchdog>,
        recorded: Vec<Result<Arc<DerivedSystem>>>,
    ) -> Result<Self> {
        let (outbox, inbox) = channel();
        let (session, watchdog) = (Arc::clone(session), Arc::clone(watchdog));
        let follow = move || {
            let threads = ThreadPool::new(ThreadRole::Follow { inbox: Rc::new(inbox), recorded });
            if let Ok(machine) = Machine::new(&session, &watchdog, Rc::new(threads)) {
                machine.silence();
                // An error here also occurs in the leading machine, which reports it.
                let _ = machine.run();
            }
        };
        let thread = named_thread("helper").spawn(follow).map_err(|error| {
            Error::system(format!("cannot start a thread: {error}")).help("try --threads 1")
        })?;
        Ok(Self { outbox, thread })
    }
}

/// Works on jobs for system `index` until the leader has derived it.
fn serve(machine: &Machine, inbox: &Receiver<Message>, index: usize) -> Result<Result<Arc<DerivedSystem>>> {
    // Declarations since the last derivation also apply.
    machine.current.system.set(None);
    let mut known: FxHashMap<usize, SystemFunctions> = FxHashMap::default();
    let mut scratch = Scratch::default();
    loop {
        let job = match inbox.recv() {
            Ok(Message::Work(job)) => job,
            Ok(Message::Derived(derived)) => {
                machine.load_variables(None)?;
                return Ok(derived);
            }
            Err(_) => return Err(Error::cancellation("the run has ended")),
        };
        // The leader waits for the job, so all other parts of a job are dropped before the job itself.
        match job {
            ThreadJob::Rewrite { work, plan } => {
                // The leader waits for the work, so `work` must be dropped last.
                let Some(work) = work.upgrade() else { continue };
                let Some(plan) = plan.upgrade() else { continue };
                let declared = prepared(machine, &mut known, plan.system)?;
                machine.enter(plan.system)?;
                plan.show_objects(machine);
                machine.current.located.replace(plan.places());
                machine.current.skips_passes.set(plan.skips_passes);
                machine.load_variables(plan.variables().as_deref())?;
                machine.refresh();
                let rules = LuaRules { machine, declared, bounded: plan.bounded };
                while work.work(&rules, &machine.session.stop, &mut scratch) {}
                machine.current.objects.replace(None);
                machine.current.located.replace(None);
                machine.current.environments.replace(None);
            }
            ThreadJob::Prefetch(prefetch) => {
                if let Some(prefetch) = prefetch.upgrade() {
                    prefetch.work();
                }
            }
            ThreadJob::Interpret(interpreting) => {
                let Some(interpreting) = interpreting.upgrade() else { continue };
                prepared(machine, &mut known, index)?;
                machine.enter(index)?;
                interpreting.plan.show_objects(machine);
                machine.load_variables(interpreting.plan.variables().as_deref())?;
                machine.refresh();
                while interpreting.work(machine) {}
                machine.current.objects.replace(None);
            }
        }
    }
}

/// Returns a system prepared for derivation in this machine. Its tables stay frozen while it is in `known`.
fn prepared<'a>(
    machine: &Machine,
    known: &'a mut FxHashMap<usize, SystemFunctions>,
    system: usize,
) -> Result<&'a SystemFunctions> {
    Ok(match known.entry(system) {
        Entry::Occupied(entry) => entry.into_mut(),
        Entry::Vacant(entry) => entry.insert(machine.library.systems.borrow()[system].prepare(machine)?),
    })
}
