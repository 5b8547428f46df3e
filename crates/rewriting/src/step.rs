//! A derivation step: distributes pieces of the chain and merges the results in order.

use std::cell::RefCell;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Arc, Condvar, Mutex};

use crate::batch::{Batch, ChainPiece, Scratch};
use crate::chain::{Chain, END, Mark};
use crate::event_chain::EventState;
use crate::grammar::NewContexts;
use crate::links::Links;
use crate::new_contexts::pieces_at_ends;
use crate::output::Output;
use crate::plan::StepPlan;
use crate::regions::RegionPath;
use crate::rules::Rules;
use crate::runs::pieces_at_brackets;
use crate::series_pause::SeriesPause;
use crate::step_number::StepNumber;
use crate::uses::Use;
use burgeon_base::Stop;
use burgeon_base::error::{Error, ErrorKind, Limit, Result};
use burgeon_base::locks::LockRecovery;
use burgeon_base::memory::make_exact_room;

/// Work of one step, shared by threads.
#[derive(Debug)]
pub struct StepWork {
    plan: Arc<StepPlan>,
    chain: Arc<Chain>,
    links: Links,
    step: StepNumber,
    pieces: Vec<ChainPiece>,
    next: AtomicUsize,
    /// First piece that failed; later pieces are not started.
    failed: AtomicUsize,
    results: Mutex<Vec<Option<Result<Output>>>>,
    /// Cleared outputs for reuse: allocating fresh pages costs more time than rewriting.
    spare: Mutex<Vec<Output>>,
    ready: Condvar,
}

impl StepWork {
    /// Rewrites the next piece with the functions of this thread; returns `false` if no piece is left.
    pub fn work(&self, rules: &dyn Rules, stop: &Stop, scratch: &mut Scratch) -> bool {
        let index = self.next.fetch_add(1, Ordering::Relaxed);
        if index >= self.pieces.len() || index > self.failed.load(Ordering::Relaxed) {
            return false;
        }
        let batch = Batch {
            rules,
            plan: &self.plan,
            chain: &self.chain,
            links: &self.links,
            step: &self.step,
            times: &[],
            stop,
            first: 0,
            new_chain: RefCell::default(),
        };
        let spare = self.spare.lock().recover().pop().unwrap_or_default();
        let result = stop.check().and_then(|()| batch.rewrite(self.pieces[index], scratch, spare));
        if result.is_err() {
            self.failed.fetch_min(index, Ordering::Relaxed);
        }
        self.results.lock().recover()[index] = Some(result);
        self.ready.notify_all();
        true
    }

    /// Abandons the pieces that no thread has started.
    fn abandon(&self) {
        self.failed.store(0, Ordering::Relaxed);
        self.next.store(self.pieces.len(), Ordering::Relaxed);
    }

    fn take(&self, index: usize) -> Option<Result<Output>> {
        self.results.lock().recover()[index].take()
    }

    fn wait(&self, index: usize) -> Result<Output> {
        let mut results = self.results.lock().recover();
        loop {
            match results[index].take() {
                Some(result) => return result,
                None => results = self.ready.wait(results).recover(),
            }
        }
    }
}

/// Threads that process pieces of a step.
pub trait Helpers {
    /// Offers a step of `pieces` pieces to other threads, which call [`StepWork::work`] until it returns `false`. They
    /// keep the step only while they work.
    fn offer(&self, step: &Arc<StepWork>, pieces: usize) -> Result<()>;
}

/// Helpers without threads: the calling thread does all the work.
#[derive(Debug, Clone, Copy, Default)]
pub struct NoHelpers;

impl Helpers for NoHelpers {
    fn offer(&self, _: &Arc<StepWork>, _: usize) -> Result<()> {
        Ok(())
    }
}

/// Result of a step.
#[derive(Debug)]
pub struct StepOutcome {
    /// Next chain.
    pub chain: Chain,
    /// Set if any rule ran.
    pub ran: bool,
    /// Set if any rule that ran replaced or erased its module.
    pub changed: bool,
    /// Set if a function of a rule has read the number of the step.
    pub reads_step: bool,
    /// Set if a function of a rule has requested that this step is the last.
    pub is_last: bool,
    /// For each symbol of the previous chain, the rule that ran or [`NO_RULE`](crate::NO_RULE), and the number of its
    /// successors; empty if the plan is not traced.
    pub applied: Vec<(u16, u32)>,
}

/// Merged results of all pieces except for the chain.
struct StepTotals {
    ran: bool,
    changed: bool,
    applied: Vec<(u16, u32)>,
}

/// Executor of steps, which reuses the memory of the last chain for the next.
#[derive(Debug)]
pub struct Stepper {
    pub(crate) plan: Arc<StepPlan>,
    spare: Chain,
    pub(crate) links: Links,
    pub(crate) scratch: Scratch,
    pub(crate) outputs: Vec<Output>,
    /// Work of each rule in all steps.
    pub(crate) uses: Vec<Use>,
    /// Number of applications of rules in the last step, if there was one.
    pub(crate) applied_last: Option<usize>,
    pub(crate) pause: SeriesPause,
    pub(crate) events: EventState,
}

impl Stepper {
    /// Creates a stepper for the rules of `plan`.
    pub fn new(plan: &Arc<StepPlan>) -> Self {
        Self {
            uses: vec![Use::default(); plan.grammar.rules().len()],
            plan: Arc::clone(plan),
            spare: Chain::default(),
            links: Links::default(),
            scratch: Scratch::default(),
            outputs: Vec::new(),
            applied_last: None,
            pause: SeriesPause::default(),
            events: EventState::default(),
        }
    }

    /// Sets the plan of the following steps, which must have the same rules. Other rules can be candidates.
    pub fn set_plan(&mut self, plan: &Arc<StepPlan>) {
        self.plan = Arc::clone(plan);
        self.applied_last = None;
        self.events.forget_chains();
    }

    /// Adds the work of the rules in the steps of an earlier derivation that this one continues.
    pub fn continue_from(&mut self, uses: &[Use]) {
        for (own, earlier) in self.uses.iter_mut().zip(uses) {
            *own += *earlier;
        }
    }

    /// Performs step number `step` on `chain`, which must be marked (see [`Chain::mark`]).
    ///
    /// Fails if a function of a rule fails, if the chain exceeds the limit of the plan, or if `stop` is requested.
    pub fn step(
        &mut self,
        rules: &dyn Rules,
        helpers: &dyn Helpers,
        stop: &Stop,
        chain: &Arc<Chain>,
        step: usize,
    ) -> Result<StepOutcome> {
        let grammar = &self.plan.grammar;
        self.links.build_with(chain, grammar, rules.parameters());
        self.links.find_regions(chain, 0, RegionPath::default(), grammar);
        let (batch, arities) = (self.plan.batch, grammar.arities());
        let pieces = match grammar.has_runs() {
            true => pieces_at_brackets(chain, batch, arities),
            false if grammar.new_contexts() != NewContexts::None => pieces_at_ends(chain, batch, arities),
            false => pieces(chain, batch),
        };
        let count = pieces.len();
        let work = Arc::new(StepWork {
            plan: Arc::clone(&self.plan),
            chain: Arc::clone(chain),
            links: std::mem::take(&mut self.links),
            step: StepNumber::new(step),
            pieces,
            next: AtomicUsize::new(0),
            failed: AtomicUsize::new(usize::MAX),
            spare: Mutex::new(std::mem::take(&mut self.outputs)),
            results: Mutex::new(std::iter::repeat_with(|| None).take(count).collect()),
            ready: Condvar::new(),
        });
        helpers.offer(&work, count)?;
        let mut growth = vec![0; self.plan.grammar.rules().len()];
        let result = self.merge(rules, stop, &work, &mut growth);
        if result.is_err() {
            work.abandon();
        }
        let work = reclaim(work);
        let StepTotals { ran, changed, applied } =
            result.map_err(|error| self.blame_for_memory(error, &growth))?;
        let (reads_step, is_last) = (work.step.is_read(), work.step.is_last());
        self.links = work.links;
        self.outputs = work.spare.into_inner().recover();
        Ok(StepOutcome { chain: std::mem::take(&mut self.spare), ran, changed, reads_step, is_last, applied })
    }

    /// Takes back a chain that is no longer needed, to reuse its memory.
    pub fn reuse(&mut self, chain: Arc<Chain>) {
        if let Ok(chain) = Arc::try_unwrap(chain)
            && chain.symbols.capacity() > self.spare.symbols.capacity()
        {
            self.spare = chain;
        }
    }

    /// Works on pieces and merges their results in order. Adds the number of symbols that each rule makes to `growth`.
    fn merge(
        &mut self,
        rules: &dyn Rules,
        stop: &Stop,
        work: &StepWork,
        growth: &mut [usize],
    ) -> Result<StepTotals> {
        let made = &mut self.spare;
        made.clear();
        let mut applied = Vec::new();
        let (mut ran, mut changed) = (false, false);
        let (mut chain, mut applications) = (0, 0);
        for index in 0..work.pieces.len() {
            let mut output = loop {
                if let Some(output) = work.take(index) {
                    break output?;
                }
                if !work.work(rules, stop, &mut self.scratch) {
                    break work.wait(index)?;
                }
            };
            let base = made.end(chain);
            let read = [work.pieces[index].end, work.chain.symbols.len()];
            append(&mut made.symbols, &output.chain.symbols, read);
            append(&mut made.params, &output.chain.params, read);
            append(&mut made.keys, &output.chain.keys, read);
            let rebased = output.chain.marks.iter().map(|mark| Mark {
                module: base.module + mark.module,
                param: base.param + mark.param,
                chain: base.chain + mark.chain,
            });
            made.marks.extend(rebased);
            if self.plan.chains > 1 {
                chain += output.chain.symbols.iter().filter(|symbol| **symbol == END).count();
            }
            ran |= output.ran;
            changed |= output.changed;
            for (rule, done) in &output.uses {
                growth[usize::from(*rule)] += done.made;
                applications += done.applied;
                self.uses[usize::from(*rule)] += *done;
            }
            applied.append(&mut output.applied);
            output.clear();
            work.spare.lock().recover().push(output);
            if made.symbols.len() > self.plan.limit {
                return Err(self.limit_error(growth, work.step.number()));
            }
        }
        self.applied_last = Some(applications);
        Ok(StepTotals { ran, changed, applied })
    }

    /// Returns the work of each rule in all steps so far.
    pub fn uses(&self) -> &[Use] {
        &self.uses
    }

    /// Returns the error for a chain that exceeds the limit, with the rule that has produced the most symbols.
    pub(crate) fn limit_error(&self, growth: &[usize], step: usize) -> Error {
        let limit = self.plan.limit;
        let error = Error::limit(Limit::Modules, format!("the chain exceeded {limit} modules in step {step}"))
            .help("end the growth with a guard or a counter, derive fewer steps, or raise the limit: --module-limit N");
        self.name_growth(error, growth)
    }

    /// Adds the rule that has produced the most symbols to the error of a run that exceeds its memory limit. `growth` has the
    /// number of symbols of each rule in the present step; it may be empty.
    pub fn blame_for_memory(&self, error: Error, growth: &[usize]) -> Error {
        match error.kind() {
            ErrorKind::Limit(Limit::Memory) => self.name_growth(error, growth),
            _ => error,
        }
    }

    /// Adds the rule that has produced the most symbols in the step, or in all steps if none has yet, unless the error names a
    /// rule.
    fn name_growth(&self, error: Error, growth: &[usize]) -> Error {
        let rules = self.plan.grammar.rules();
        let total = |index: usize| self.uses.get(index).map_or(0, |uses| uses.made);
        let most = (0..rules.len())
            .map(|index| (growth.get(index).copied().unwrap_or(0), total(index), usize::MAX - index))
            .max()
            .filter(|(now, total, _)| now + total > 0);
        match most.and_then(|(.., index)| rules.get(usize::MAX - index)) {
            Some(rule) => {
                error.at_place(rule.place.as_ref()).rule(format!("{} (which grew most)", rule.pattern.text))
            }
            None => error,
        }
    }
}

/// Waits until every other thread has dropped the work.
fn reclaim(mut work: Arc<StepWork>) -> StepWork {
    loop {
        match Arc::try_unwrap(work) {
            Ok(work) => return work,
            Err(shared) => {
                std::thread::yield_now();
                work = shared;
            }
        }
    }
}

/// Appends `items`, the result of the next piece, to `array` after `read` of `all` symbols.
///
/// If the array is empty or full, reserves memory for all pieces by extrapolating the growth so far, but at most four
/// times the present size.
fn append<T: Copy>(array: &mut Vec<T>, items: &[T], [read, all]: [usize; 2]) {
    let length = array.len() + items.len();
    if array.is_empty() || length > array.capacity() {
        let expected = length.saturating_mul(all) / read.max(1);
        let expected = expected.min(4 * array.capacity().max(length)).max(length);
        if array.is_empty() && expected > array.capacity() {
            // Growth would copy what earlier steps left.
            *array = Vec::new();
        }
        make_exact_room(array, expected + expected / 16 - array.len());
    }
    array.extend_from_slice(items);
}

/// Merges the chain's marks into pieces of at least `size` symbols.
pub(crate) fn pieces(chain: &Chain, size: usize) -> Vec<ChainPiece> {
    let mut pieces: Vec<ChainPiece> = Vec::new();
    for mark in &chain.marks {
        match pieces.last_mut() {
            Some(piece) if mark.module - piece.begin.module < size => {}
            Some(piece) => {
                piece.end = mark.module;
                pieces.push(ChainPiece { begin: *mark, end: mark.module });
            }
            None => pieces.push(ChainPiece { begin: *mark, end: mark.module }),
        }
    }
    if let Some(piece) = pieces.last_mut() {
        piece.end = chain.symbols.len();
    }
    pieces
}
