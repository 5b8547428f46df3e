//! One derivation step: hands out pieces of the chain and puts the results together in their order.

use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Arc, Condvar, Mutex};

use super::batch::{Batch, ChainPiece, Scratch};
use super::functions::LuaFunctions;
use super::output::Output;
use super::plan::DerivationPlan;
use super::threads::{LeadingMachine, ThreadJob};
use crate::machine::{Machine, SystemFunctions};
use crate::results::Use;
use burgeon_base::error::{Error, Limit, Result};
use burgeon_base::locks::LockRecovery;
use burgeon_base::memory::make_exact_room;
use burgeon_kit::rules::{Chain, Links, Mark};

/// Pieces of a chain from which rewriting it takes longer than starting a helper.
const MANY: usize = 16;

/// The work of one step, shared by the threads.
pub(crate) struct RewritingStep {
    pub plan: Arc<DerivationPlan>,
    pub chain: Arc<Chain>,
    pub links: Links,
    pub step: usize,
    pieces: Vec<ChainPiece>,
    next: AtomicUsize,
    /// The first piece that failed; later ones are not begun.
    failed: AtomicUsize,
    results: Mutex<Vec<Option<Result<Output>>>>,
    /// Emptied outputs, whose memory is used again: fresh pages cost more than the rewriting itself.
    spare: Mutex<Vec<Output>>,
    ready: Condvar,
}

impl RewritingStep {
    /// Takes a piece and rewrites it; `false` when none is left.
    pub(crate) fn work(&self, machine: &Machine, declared: &SystemFunctions, scratch: &mut Scratch) -> bool {
        let index = self.next.fetch_add(1, Ordering::Relaxed);
        if index >= self.pieces.len() || index > self.failed.load(Ordering::Relaxed) {
            return false;
        }
        let batch = Batch {
            functions: &LuaFunctions { machine, declared },
            plan: &self.plan,
            values: &machine.session.values,
            chain: &self.chain,
            links: &self.links,
            step: self.step,
        };
        let spare = self.spare.lock().recover().pop().unwrap_or_default();
        let result =
            machine.session.stop.check().and_then(|()| batch.rewrite(self.pieces[index], scratch, spare));
        if result.is_err() {
            self.failed.fetch_min(index, Ordering::Relaxed);
        }
        self.results.lock().recover()[index] = Some(result);
        self.ready.notify_all();
        true
    }

    /// Gives up the pieces that nobody has begun.
    pub(crate) fn abandon(&self) {
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

/// What a step gave.
pub(crate) struct StepOutcome {
    pub chain: Chain,
    pub ran: bool,
    pub changed: bool,
    /// For each symbol of the chain before, the rule that ran and how many symbols came of it; only where it is traced.
    pub applied: Vec<(u16, u32)>,
}

/// What all pieces together gave, besides their chain.
struct StepTotals {
    ran: bool,
    changed: bool,
    applied: Vec<(u16, u32)>,
}

/// Makes steps; keeps the memory of the last chain for the next.
pub(crate) struct Stepper {
    plan: Arc<DerivationPlan>,
    spare: Chain,
    links: Links,
    scratch: Scratch,
    outputs: Vec<Output>,
    /// What each rule has done in all steps.
    uses: Vec<Use>,
}

impl Stepper {
    pub(crate) fn new(plan: Arc<DerivationPlan>) -> Self {
        Self {
            uses: vec![Use::default(); plan.grammar.rules().len()],
            plan,
            spare: Chain::default(),
            links: Links::default(),
            scratch: Scratch::default(),
            outputs: Vec::new(),
        }
    }

    /// Makes step number `step` on `chain`.
    pub(crate) fn step(
        &mut self,
        LeadingMachine { machine, threads }: LeadingMachine<'_>,
        declared: &SystemFunctions,
        chain: &Arc<Chain>,
        step: usize,
    ) -> Result<StepOutcome> {
        self.links.build(chain, &self.plan.grammar);
        let pieces = pieces(chain, self.plan.batch);
        let count = pieces.len();
        machine.enter(self.plan.system)?;
        machine.refresh();
        machine.current.objects.replace(self.plan.objects.clone());
        let rewriting = Arc::new(RewritingStep {
            plan: Arc::clone(&self.plan),
            chain: Arc::clone(chain),
            links: std::mem::take(&mut self.links),
            step,
            pieces,
            next: AtomicUsize::new(0),
            failed: AtomicUsize::new(usize::MAX),
            spare: Mutex::new(std::mem::take(&mut self.outputs)),
            results: Mutex::new(std::iter::repeat_with(|| None).take(count).collect()),
            ready: Condvar::new(),
        });
        threads.hand_out(machine, count, MANY, || ThreadJob::Rewrite(Arc::downgrade(&rewriting)))?;
        let result = self.merge(machine, declared, &rewriting);
        if result.is_err() {
            rewriting.abandon();
        }
        let rewriting = threads.reclaim(rewriting);
        let StepTotals { ran, changed, applied } = result?;
        self.links = rewriting.links;
        self.outputs = rewriting.spare.into_inner().recover();
        Ok(StepOutcome { chain: std::mem::take(&mut self.spare), ran, changed, applied })
    }

    /// Takes back a chain that nobody needs any more, for its memory.
    pub(crate) fn reuse(&mut self, chain: Arc<Chain>) {
        if let Ok(chain) = Arc::try_unwrap(chain)
            && chain.symbols.capacity() > self.spare.symbols.capacity()
        {
            self.spare = chain;
        }
    }

    /// Works on pieces and puts the results together as they come, in order.
    fn merge(
        &mut self,
        machine: &Machine,
        declared: &SystemFunctions,
        rewriting: &RewritingStep,
    ) -> Result<StepTotals> {
        let limit = machine.session.options.limits.modules;
        let made = &mut self.spare;
        made.clear();
        let mut growth = vec![0usize; self.plan.grammar.rules().len()];
        let mut applied = Vec::new();
        let (mut ran, mut changed) = (false, false);
        let mut chain = 0;
        for index in 0..rewriting.pieces.len() {
            let mut output = loop {
                if let Some(output) = rewriting.take(index) {
                    break output?;
                }
                if !rewriting.work(machine, declared, &mut self.scratch) {
                    break rewriting.wait(index)?;
                }
            };
            let base = made.end(chain);
            let read = [rewriting.pieces[index].end, rewriting.chain.symbols.len()];
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
                chain +=
                    output.chain.symbols.iter().filter(|symbol| **symbol == burgeon_kit::rules::END).count();
            }
            ran |= output.ran;
            changed |= output.changed;
            for (rule, done) in &output.uses {
                growth[usize::from(*rule)] += done.made;
                self.uses[usize::from(*rule)] += *done;
            }
            applied.append(&mut output.applied);
            output.clear();
            rewriting.spare.lock().recover().push(output);
            if made.symbols.len() > limit {
                return Err(self.runaway(&growth, limit, rewriting.step));
            }
        }
        Ok(StepTotals { ran, changed, applied })
    }

    /// What each rule has done so far.
    pub(crate) fn uses(&self) -> &[Use] {
        &self.uses
    }

    fn runaway(&self, growth: &[usize], limit: usize, step: usize) -> Error {
        let error = Error::limit(Limit::Modules, format!("the chain grew past {limit} modules in step {step}"))
            .help("end the growth with a guard or a counter, derive fewer steps, or raise the limit: --module-limit N");
        match growth.iter().enumerate().max_by_key(|(index, count)| (**count, usize::MAX - index)) {
            Some((rule, _)) => {
                let rule = &self.plan.grammar.rules()[rule];
                error.at(rule.place.clone()).rule(format!("{} (which grew most)", rule.pattern.text))
            }
            None => error,
        }
    }
}

/// Adds `items`, what one more piece has made, at the end of `array`, once so many symbols of so many have been read.
///
/// With the first piece, and where there is no room, it makes room for what all pieces make if the rest makes as much as
/// what has been read; but no more than four times what there is, for it may not.
fn append<T: Copy>(array: &mut Vec<T>, items: &[T], [read, all]: [usize; 2]) {
    let length = array.len() + items.len();
    if array.is_empty() || length > array.capacity() {
        let expected = length.saturating_mul(all) / read.max(1);
        let expected = expected.min(4 * array.capacity().max(length)).max(length);
        make_exact_room(array, expected + expected / 16 - array.len());
    }
    array.extend_from_slice(items);
}

/// Joins the chain's marks to pieces of at least `size` symbols.
fn pieces(chain: &Chain, size: usize) -> Vec<ChainPiece> {
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
