//! Interpretation pass over the chains of a system.

use std::collections::BTreeSet;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::{Mutex, OnceLock};
use std::time::{Duration, Instant};

use super::Applier;
use super::memory::PassMemory;
use super::notices::Notices;
use crate::declare::FileLimit;
use crate::derive::plan::DerivationPlan;
use crate::derive::threads::{LeadingMachine, ThreadJob};
use crate::machine::{Flusher, Machine, ModulePlaces, write_column};
use crate::results::{ReportSums, Use};
use burgeon_base::error::{Error, Limit, Result};
use burgeon_base::locks::LockRecovery;
use burgeon_base::warning::Warning;
use burgeon_kit::ObjectPlace;
use burgeon_rewriting::{Chain, END, Links, Mark, Region, Symbol};
use mlua::Table;

/// Maximum number of entries per call into Lua.
const ENTRIES: usize = 4096;

/// Maximum number of symbols per call into Lua, and between two marks, in a pass that the next pass can continue.
const MARKED_SYMBOLS: usize = 256;

/// Number of pieces if there are many chains. Chains can differ much in cost, so small pieces keep a thread
/// from waiting for the last piece of another thread.
const DEALT: usize = 64;

/// Position from which the next entries are gathered.
struct NextEntry {
    at: Mark,
    /// Set if a chain begins at this position.
    is_begin: bool,
}

/// Entries that one call into Lua interprets.
#[derive(Default)]
struct EntryBatch {
    /// For each entry, the index of a module and of its first parameter.
    entries: Vec<(usize, usize)>,
    /// Rule of each entry.
    ids: Vec<u16>,
    /// Arguments of all entries, in order.
    arguments: Vec<f64>,
}

impl EntryBatch {
    fn clear(&mut self) {
        self.entries.clear();
        self.ids.clear();
        self.arguments.clear();
    }

    #[inline]
    fn push(&mut self, entry: (usize, usize), id: u16, arguments: &[f64]) {
        self.entries.push(entry);
        self.ids.push(id);
        self.arguments.extend_from_slice(arguments);
    }
}

/// Interpretation pass over all chains, shared by the threads.
pub(crate) struct InterpretationPass {
    pub plan: Arc<DerivationPlan>,
    pub chain: Arc<Chain>,
    /// Position of the first symbol of `chain` in the chain of the system.
    first: Mark,
    pub step: usize,
    /// Number that `step()` returns.
    number: usize,
    /// Time of each chain, if the rules have propensities.
    times: Vec<f64>,
    /// Set if an interpretation rule has read that number.
    reads_step: AtomicBool,
    /// Set if an interpretation rule has requested that the step is the last.
    is_last: AtomicBool,
    /// Start of each piece of whole chains, and the end of the last piece.
    pieces: Vec<Mark>,
    next: AtomicUsize,
    triangles: AtomicUsize,
    failure: Mutex<Option<(usize, Error)>>,
    pub(super) uses: Mutex<Vec<Use>>,
    pub(super) notices: Notices,
    /// Neighbours in the chain, if an interpretation rule has contexts.
    pub(super) links: Links,
    /// Region of each symbol; empty if no module opens a region.
    pub(super) regions: Vec<Region>,
    undrawn: Mutex<BTreeSet<Symbol>>,
    places: Mutex<Vec<(u32, ObjectPlace)>>,
    /// Sums of the reported numbers.
    reports: Mutex<ReportSums>,
    /// Start of each chain, found when a rule reports a number.
    starts: OnceLock<Vec<Mark>>,
    /// Memory of the last pass, if this pass continues it and can be continued.
    memory: Option<Mutex<PassMemory>>,
}

/// Result of an interpretation pass.
#[derive(Default)]
pub(crate) struct PassOutcome {
    /// Set if an interpretation rule has read the number of the step.
    pub reads_step: bool,
    /// Set if an interpretation rule has requested that the step is the last.
    pub is_last: bool,
    /// Symbols of modules that interpretation rules returned and nothing draws.
    pub undrawn: BTreeSet<Symbol>,
}

impl InterpretationPass {
    /// Interprets `chain` after `step` steps, where `step()` returns `number`, and `time()` one of `times`. Adds the work of
    /// each rule to `uses`, and the warnings of the objects to `said`. With the `memory` of the last pass, only what follows the first change of
    /// the chain is interpreted.
    pub(crate) fn pass(
        LeadingMachine { machine, threads }: LeadingMachine<'_>,
        plan: &Arc<DerivationPlan>,
        chain: &Arc<Chain>,
        (step, number, times): (usize, usize, &[f64]),
        uses: &mut [Use],
        said: &mut Vec<Warning>,
        mut memory: Option<&mut PassMemory>,
    ) -> Result<PassOutcome> {
        let mut last = memory.as_deref_mut().map(std::mem::take);
        if let Some(last) = &mut last {
            last.begin(chain);
        }
        let begin = last.as_ref().map_or_else(Mark::default, PassMemory::end);
        let starts = chain.starts(plan.steps.grammar.arities());
        let many = plan.steps.chains >= 4 * DEALT;
        let size = if many { plan.steps.batch.min(chain.symbols.len() / DEALT) } else { plan.steps.batch };
        let mut pieces = vec![begin];
        for start in &starts[1..] {
            let begin = pieces.last().copied().unwrap_or_default();
            if start.module - begin.module >= size || start.module == chain.symbols.len() {
                pieces.push(*start);
            }
        }
        let count = pieces.len() - 1;
        let mut links = Links::default();
        if let Some(grammar) = &plan.interpretations.grammar {
            links.build_with(chain, grammar, &*machine.session.values);
        }
        Self::enter(machine, plan)?;
        if let Some(environments) = &plan.environments {
            environments.begin_pass();
        }
        let regions = plan.steps.grammar.region_openers().regions(chain);
        let chain = (Arc::clone(chain), Mark::default(), regions);
        let interpreting = Self::new(plan, chain, pieces, (step, number, times), links, last);
        // Chains that assign the same variables, or change the same environments, are interpreted one after the other.
        if !plan.assigns_variables && plan.environments.is_none() {
            threads.hand_out(machine, count, 2, || ThreadJob::Interpret(Arc::downgrade(&interpreting)))?;
        }
        while interpreting.work(machine) {}
        threads.reclaim(interpreting).complete(uses, said, memory)
    }

    /// Prepares the leading machine for calls of interpretation rules.
    pub(super) fn enter(machine: &Machine, plan: &DerivationPlan) -> Result<()> {
        machine.enter(plan.system)?;
        machine.refresh();
        plan.show_objects(machine);
        Ok(())
    }

    /// Creates a pass over the `pieces` of a chain, or of a part of the chain that begins at a position, with the regions of its
    /// symbols.
    pub(super) fn new(
        plan: &Arc<DerivationPlan>,
        (chain, first, regions): (Arc<Chain>, Mark, Vec<Region>),
        pieces: Vec<Mark>,
        (step, number, times): (usize, usize, &[f64]),
        links: Links,
        memory: Option<PassMemory>,
    ) -> Arc<Self> {
        let mark = memory.as_ref().and_then(|memory| memory.marks.last());
        Arc::new(Self {
            plan: Arc::clone(plan),
            regions,
            chain,
            first,
            step,
            number,
            times: times.to_vec(),
            reads_step: AtomicBool::new(false),
            is_last: AtomicBool::new(false),
            pieces,
            next: AtomicUsize::new(0),
            triangles: AtomicUsize::new(mark.map_or(0, |mark| mark.triangles)),
            failure: Mutex::new(None),
            uses: Mutex::new(vec![Use::default(); plan.interpretations.list.len()]),
            notices: Notices::default(),
            links,
            undrawn: Mutex::default(),
            places: Mutex::default(),
            reports: Mutex::default(),
            starts: OnceLock::new(),
            memory: memory.map(Mutex::new),
        })
    }

    /// Returns the result of the pass. Adds the work of each rule to `uses`, and the warnings of the objects to `said`. Leaves
    /// in `memory` that from which the next pass can continue.
    pub(super) fn complete(
        self,
        uses: &mut [Use],
        said: &mut Vec<Warning>,
        memory: Option<&mut PassMemory>,
    ) -> Result<PassOutcome> {
        let plan = &self.plan;
        let counted = self.uses.into_inner().recover();
        uses.iter_mut().zip(counted).for_each(|(sum, more)| *sum += more);
        let of_symbol = |symbol: Symbol| self.chain.symbols.iter().filter(|other| **other == symbol).count();
        let notices: Vec<Warning> = self.notices.into_list(of_symbol).collect();
        let undrawn = self.undrawn.into_inner().recover();
        let reports = self.reports.into_inner().recover();
        let mut places = self.places.into_inner().recover();
        if let Some((memory, mut last)) = memory.zip(self.memory.map(|last| last.into_inner().recover())) {
            last.places.append(&mut places);
            places.clone_from(&last.places);
            let has_failed = plan.objects.as_ref().is_some_and(|objects| objects.failed().any());
            // Their warnings, reports and numbers of steps belong to a whole pass.
            if notices.is_empty()
                && reports.is_empty()
                && undrawn.is_empty()
                && !has_failed
                && !self.reads_step.load(Ordering::Relaxed)
            {
                *memory = last;
            }
        }
        said.extend(notices);
        match self.failure.into_inner().recover() {
            Some((_, error)) => Err(error),
            None => {
                if let Some(environments) = &plan.environments {
                    environments.end_pass()?;
                }
                *plan.reports.lock().recover() = reports;
                plan.set_places((!plan.located.is_empty()).then(|| ModulePlaces::new(places)));
                Ok(PassOutcome {
                    reads_step: self.reads_step.into_inner(),
                    is_last: self.is_last.into_inner(),
                    undrawn,
                })
            }
        }
    }

    /// Takes a piece and interprets it. Returns `false` if no piece is left.
    pub(crate) fn work(self: &Arc<Self>, machine: &Machine) -> bool {
        let index = self.next.fetch_add(1, Ordering::Relaxed);
        if index + 1 >= self.pieces.len() {
            return false;
        }
        let failed =
            |failure: &Option<(usize, Error)>| failure.as_ref().is_some_and(|(first, _)| *first < index);
        if failed(&self.failure.lock().recover()) {
            return true;
        }
        if let Err(error) = self.piece(machine, self.pieces[index], self.pieces[index + 1]) {
            let mut failure = self.failure.lock().recover();
            if !failed(&failure) {
                *failure = Some((index, error));
            }
        }
        true
    }

    fn piece(self: &Arc<Self>, machine: &Machine, begin: Mark, end: Mark) -> Result<()> {
        machine.refresh();
        let mut applier = Applier::new(Arc::clone(self), machine, begin)?;
        if let Some(memory) = &self.memory
            && let Some(mark) = memory.lock().recover().marks.last()
        {
            applier.continue_from(mark)?;
        }
        machine.current.flusher.replace(Some(Box::new(applier)));
        machine.current.begin_step(self.number, self.plan.bounded);
        machine.current.set_times(&self.times);
        let result = self.run(machine, begin, end);
        self.reads_step.fetch_or(machine.current.has_read_step(), Ordering::Relaxed);
        self.is_last.fetch_or(machine.current.take_end(), Ordering::Relaxed);
        let flusher = machine.current.flusher.replace(None);
        if let Some(applier) =
            flusher.and_then(|flusher| (flusher as Box<dyn std::any::Any>).downcast::<Applier>().ok())
        {
            let first = u32::try_from(self.first.module).unwrap_or(u32::MAX);
            let mut applier = *applier;
            self.reports.lock().recover().extend(applier.take_reports());
            let places = applier.take_places().into_iter();
            let places = places.map(|(module, place)| (module.saturating_add(first), place));
            self.places.lock().recover().extend(places);
        }
        result
    }

    fn run(&self, machine: &Machine, begin: Mark, end: Mark) -> Result<()> {
        let interpretations = &self.plan.interpretations;
        let is_begin = begin == Mark::default() && self.first == Mark::default() || self.memory.is_none();
        let mut next = NextEntry { at: begin, is_begin };
        let mut batch = EntryBatch::default();
        while next.at.module < end.module {
            self.gather(&mut next, end.module, &mut batch);
            let EntryBatch { entries, ids, arguments } = &batch;
            let module = next.at.module;
            machine.session.stop.check()?;
            let begin = Instant::now();
            let (mut applying, mut from, mut argument) = (Vec::new(), 0, 0);
            // If a chain is skipped, interpretation continues after that chain.
            while let Some(done) = self.interpret(
                machine,
                &entries[from..],
                &ids[from..],
                &arguments[argument..],
                module,
                &mut applying,
            )? {
                let bound = |id: &u16| interpretations.list[usize::from(*id)].bound;
                argument += ids[from..from + done].iter().map(bound).sum::<usize>();
                from += done;
                if self.plan.profiled {
                    applying.resize(from, Duration::ZERO);
                }
            }
            self.count_uses(ids, begin.elapsed(), applying);
            if let Some(memory) = &self.memory
                && next.at.module < end.module
            {
                let Mark { module, param, chain } = next.at;
                let at = Mark { module: self.first.module + module, param: self.first.param + param, chain };
                with_applier(machine, &mut |applier| applier.mark(at, &mut memory.lock().recover()))?;
            }
        }
        Ok(())
    }

    /// Gathers the next entries before the symbol `end`.
    #[inline(never)]
    fn gather(&self, next: &mut NextEntry, end: usize, batch: &mut EntryBatch) {
        let interpretations = &self.plan.interpretations;
        let (by_symbol, arities) = (interpretations.by_symbol.as_slice(), self.plan.steps.grammar.arities());
        let (symbols, params) = (&self.chain.symbols[..end], self.chain.params.as_slice());
        let NextEntry { at: Mark { mut module, mut param, mut chain }, mut is_begin } = *next;
        batch.clear();
        let most = if self.memory.is_some() { end.min(module + self.marked_symbols()) } else { end };
        while module < most && batch.entries.len() < ENTRIES {
            let symbol = symbols[module];
            let id = by_symbol[interpretations.place_of(self.region(module), symbol)];
            if is_begin && interpretations.begin != u16::MAX {
                batch.push((module, param), interpretations.begin, &[numbered(chain)]);
            }
            is_begin = symbol == END;
            if is_begin {
                if id != u16::MAX {
                    batch.push((module, param), id, &[numbered(chain)]);
                }
                chain += 1;
            } else if id != u16::MAX {
                let bound = interpretations.list[usize::from(id)].bound;
                batch.push((module, param), id, &params[param..param + bound]);
            }
            param += usize::from(arities[usize::from(symbol)]);
            module += 1;
        }
        *next = NextEntry { at: Mark { module, param, chain }, is_begin };
    }

    /// Runs the interpretation rules of `entries`, and applies everything before the symbol `until`. Adds the
    /// time of the calls of each entry to `times`, if it is measured.
    ///
    /// If the data of a chain is at fault, the function stops and returns the number of entries up to the end
    /// of that chain.
    fn interpret(
        &self,
        machine: &Machine,
        entries: &[(usize, usize)],
        ids: &[u16],
        arguments: &[f64],
        until: usize,
        times: &mut Vec<Duration>,
    ) -> Result<Option<usize>> {
        let lua = |error: mlua::Error| machine.translate(error);
        let prelude = machine.prelude();
        write_column(prelude.entries(ids.len() * 2).map_err(lua)?, ids)?;
        write_column(prelude.input(arguments.len() * 8).map_err(lua)?, arguments)?;
        prelude.counts(ids.len() * 4).map_err(lua)?;
        if self.plan.steps.grammar.draws_random() {
            let mut keys = machine.current.keys.borrow_mut();
            keys.clear();
            keys.extend(entries.iter().zip(ids).map(|((module, _), id)| self.key(*module, *id)));
            machine.current.used.set(0);
        }
        let (calls, numbers, counts) = prelude.recorded().map_err(lua)?;
        let buffers = [calls, numbers, counts];
        with_applier(machine, &mut |applier| {
            applier.begin_entries(entries, buffers.clone());
            Ok(())
        })?;
        let called: usize = match machine.call::<(usize, usize, Option<Table>)>(&prelude.interpret, ids.len())
        {
            Ok((called, _, more)) => {
                if let Some(more) = more {
                    self.count_more(&more).map_err(lua)?;
                }
                called
            }
            Err(error) => {
                let (at, _, called, running) = machine.failed_at().unwrap_or((usize::MAX, 0.0, 0, -1));
                // If ending the batch fails too, the machine is dropped with the run.
                let _ = prelude.finish.call::<()>(());
                let error = self.blame(
                    machine,
                    machine.translate(error),
                    u16::try_from(running).ok().or(ids.get(at).copied()),
                    entries.get(at).copied(),
                );
                let Some((module, _)) = entries.get(at).copied().filter(|_| error.is_of_data()) else {
                    return Err(self.find_line(machine, error));
                };
                let mut notices = Vec::new();
                let forgiven = with_applier(machine, &mut |applier| {
                    applier.flush(at, called)?;
                    applier.forgive(error.clone())?;
                    times.append(&mut applier.take_times());
                    notices = applier.take_notices();
                    Ok(())
                });
                if let Err(error) = forgiven {
                    return Err(self.find_line(machine, error));
                }
                self.note_all(machine, &notices);
                let rest = self.chain.symbols[module..].iter().position(|symbol| *symbol == END);
                let end = module + rest.unwrap_or(0);
                let done = entries.partition_point(|(module, _)| *module <= end);
                return Ok(Some(done));
            }
        };
        let mut notices = Vec::new();
        let applied = with_applier(machine, &mut |applier| {
            applier.finish_entries(called, until)?;
            times.append(&mut applier.take_times());
            notices = applier.take_notices();
            Ok(())
        });
        if let Err(error) = applied {
            return Err(self.find_line(machine, error));
        }
        self.note_all(machine, &notices);
        Ok(None)
    }

    /// Returns the number of symbols per call into Lua, and between two marks.
    pub(super) fn marked_symbols(&self) -> usize {
        self.plan.steps.batch.min(MARKED_SYMBOLS)
    }

    /// Returns the index of the chain of a module, given the index of the module.
    pub(super) fn chain_of(&self, module: usize) -> usize {
        let starts = self.starts.get_or_init(|| self.chain.starts(self.plan.steps.grammar.arities()));
        self.first.chain + starts.partition_point(|start| start.module <= module).saturating_sub(1)
    }

    /// Records that nothing draws the modules with this symbol.
    pub(super) fn note_undrawn(&self, symbol: Symbol) {
        self.undrawn.lock().recover().insert(symbol);
    }

    /// Adds `more` triangles to the total, and fails if the total exceeds the limit of a system or of the run's file.
    pub(super) fn count_triangles(
        &self,
        (machine_limit, file): (usize, Option<&FileLimit>),
        more: usize,
    ) -> Result<()> {
        let total = self.triangles.fetch_add(more, Ordering::Relaxed) + more;
        if let Some(file) = file.filter(|file| total > file.triangles) {
            return Err(Error::limit(Limit::Format, file.message.clone()).help(file.help.clone()));
        }
        if total > machine_limit {
            return Err(Error::limit(
                Limit::Triangles,
                format!("the system draws more than {machine_limit} triangles"),
            )
            .help("draw with fewer sides, derive fewer steps, or raise the limit: --triangle-limit N"));
        }
        Ok(())
    }
}

/// Calls `act` with the applier of the piece that the machine interprets.
fn with_applier(machine: &Machine, act: &mut dyn FnMut(&mut Applier) -> Result<()>) -> Result<()> {
    let mut flusher = machine.current.flusher.borrow_mut();
    match flusher.as_deref_mut().and_then(applier) {
        Some(applier) => act(applier),
        None => Err(Error::internal("no interpretation is running")),
    }
}

/// Converts the index of a chain to the number that rules receive.
#[allow(clippy::cast_precision_loss, reason = "there are fewer than 2^53 chains")]
fn numbered(chain: usize) -> f64 {
    chain as f64
}

/// Returns the flusher of the machine as the applier of a piece.
pub(super) fn applier(flusher: &mut dyn Flusher) -> Option<&mut Applier> {
    let any: &mut dyn std::any::Any = flusher;
    any.downcast_mut()
}
