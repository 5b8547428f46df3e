//! Applies recorded method calls to the objects, and the brackets and chain ends between them.

use std::sync::Arc;
use std::time::{Duration, Instant};

use mlua::Buffer;

use super::InterpretationPass;
use super::memory::{PassMark, PassMemory};
use super::notices::ObjectNotice;
use crate::declare::FileLimit;
use crate::machine::{CLOSE_CALL, Interpretations, Machine, OPEN_CALL, Objects, read_column};
use crate::results::ReportSums;
use burgeon_base::Stop;
use burgeon_base::error::{Error, ErrorKind, Limit, Result};
use burgeon_base::warning::Warning;
use burgeon_kit::{Call, Capability, Kind, Locate, Object, ObjectPlace, Rewind, Value, Values, Warn};
use burgeon_rewriting::{CLOSE, END, Mark, OPEN, module_brief};

/// Progress of applying one piece of the chains.
pub(crate) struct Applier {
    pub(super) pass: Arc<InterpretationPass>,
    objects: Arc<Objects>,
    kind: Arc<Kind>,
    warn: Option<Capability<dyn Warn>>,
    values: Arc<Values>,
    stop: Arc<Stop>,
    triangle_limit: usize,
    file_limit: Option<Arc<FileLimit>>,
    buffers: [Buffer; 3],
    /// Index of the next symbol to apply.
    pub(super) position: usize,
    /// Index of that symbol's first parameter.
    param: usize,
    /// Index of that symbol's chain.
    pub(super) chain: usize,
    /// Set once the chain's object has begun its pass.
    begun: bool,
    /// Number of triangles of the chain's object that have been counted.
    counted: usize,
    pub(super) entries: Vec<(usize, usize)>,
    /// First entry that is not completely applied.
    next: usize,
    calls: Vec<u16>,
    numbers: Vec<f64>,
    ends: Vec<u32>,
    /// Time of the calls of each entry, if it is measured.
    times: Vec<Duration>,
    /// Number of recorded calls of the entry `next` that have been applied.
    applied: usize,
    /// Entry and call number of the call that failed.
    failed: Option<(usize, usize)>,
    /// Next call among those that have been read, and its first argument.
    call_at: usize,
    number_at: usize,
    /// Last entry whose calls were applied before the entry was complete, and the number of these calls.
    pub(super) flushed: (usize, usize),
    /// Warnings of the objects during the batch.
    pub(super) notices: Vec<ObjectNotice>,
    /// Set while a call of the script waits for the recorded calls before it. A run that then reaches its
    /// time limit reports the line of that call.
    pub(super) waits: bool,
    locate: Option<Capability<dyn Locate>>,
    /// Places of the object at modules whose rules read them.
    places: Vec<(u32, ObjectPlace)>,
    /// Sums of the numbers that rules have reported.
    pub(super) reports: ReportSums,
}

/// Number of symbols between two checks for cancellation.
const STRETCH: usize = 64;

/// Reason why applying stopped.
#[derive(PartialEq)]
enum ApplyEnd {
    /// The end of a chain was applied.
    End,
    /// The requested position was reached.
    Last,
}

impl Applier {
    pub(crate) fn new(pass: Arc<InterpretationPass>, machine: &Machine, begin: Mark) -> Result<Self> {
        let missing = || Error::script("the system has no object");
        let objects = pass.plan.objects.clone().ok_or_else(missing)?;
        let kind = objects.read(begin.chain, |object| Ok(Arc::clone(object.kind())))?;
        let (calls, numbers, counts) =
            machine.prelude().recorded().map_err(|error| machine.translate(error))?;
        Ok(Self {
            values: Arc::clone(&machine.session.values),
            stop: Arc::clone(&machine.session.stop),
            triangle_limit: machine.session.options.limits.triangles,
            file_limit: machine.session.options.limits.file.clone(),
            pass,
            objects,
            warn: kind.capability::<dyn Warn>(),
            buffers: [calls, numbers, counts],
            position: begin.module,
            param: begin.param,
            chain: begin.chain,
            begun: false,
            counted: 0,
            entries: Vec::new(),
            next: 0,
            calls: Vec::new(),
            numbers: Vec::new(),
            ends: Vec::new(),
            times: Vec::new(),
            applied: 0,
            failed: None,
            call_at: 0,
            number_at: 0,
            flushed: (0, 0),
            notices: Vec::new(),
            waits: false,
            locate: kind.capability::<dyn Locate>(),
            kind,
            places: Vec::new(),
            reports: ReportSums::default(),
        })
    }

    /// Returns the object to its state at `mark`, the position at which the piece begins.
    pub(super) fn continue_from(&mut self, mark: &PassMark) -> Result<()> {
        let returned = self.objects.write(self.chain, |object| {
            Ok(object.capability_mut::<dyn Rewind>().is_some_and(|it| it.rewind(&*mark.object)))
        })?;
        (self.begun, self.counted) = (true, mark.triangles);
        if returned { Ok(()) } else { Err(Error::internal("the object does not return to a mark")) }
    }

    /// Adds the present state of the object to `memory`, if the position `at` needs a mark.
    pub(super) fn mark(&mut self, at: Mark, memory: &mut PassMemory) -> Result<()> {
        let triangles = self.counted;
        let interval = self.pass.marked_symbols();
        self.objects.write(self.chain, |object| {
            if let Some(object) = object.capability_mut::<dyn Rewind>()
                && memory.needs_mark(at, interval, object.mark_size())
            {
                memory.marks.push(PassMark { at, object: object.mark(), triangles });
            }
            Ok(())
        })
    }

    /// Begins a batch of entries, each with the index of a module and of its first parameter. `buffers` are
    /// the columns of calls, of their arguments, and of the number of calls up to each entry.
    pub(crate) fn begin_entries(&mut self, entries: &[(usize, usize)], buffers: [Buffer; 3]) {
        self.buffers = buffers;
        self.entries.clear();
        self.entries.extend_from_slice(entries);
        self.next = 0;
        self.times.clear();
        (self.applied, self.failed, self.flushed) = (0, None, (0, 0));
    }

    /// Returns the entry of the batch whose call failed, and the number of that call.
    pub(crate) fn failed(&self) -> Option<(usize, usize)> {
        self.failed
    }

    /// Takes the times of the applied entries.
    pub(crate) fn take_times(&mut self) -> Vec<Duration> {
        std::mem::take(&mut self.times)
    }

    /// Takes the warnings of the objects since the last call.
    pub(crate) fn take_notices(&mut self) -> Vec<ObjectNotice> {
        std::mem::take(&mut self.notices)
    }

    /// Takes the warnings of `object` after the current module. `call` is the recorded call that caused them,
    /// if any.
    #[inline]
    fn listen(&mut self, object: &mut dyn Object, call: Option<(usize, usize)>) {
        if let Some(warn) = self.warn
            && let Some(object) = warn.of_mut(object)
        {
            let said = object.take_warnings();
            if !said.is_empty() {
                self.note(said, call);
            }
        }
    }

    #[cold]
    pub(super) fn note(&mut self, said: Vec<Warning>, call: Option<(usize, usize)>) {
        let module = (self.position, self.param);
        self.notices.extend(said.into_iter().map(|warning| ObjectNotice { warning, module, call }));
    }

    /// Skips the current chain if `error` is a fault of its data; otherwise returns the error.
    pub(crate) fn forgive(&mut self, error: Error) -> Result<()> {
        self.objects.failed().forgive(self.chain, error)
    }

    /// Applies the rest of a batch with `called` calls since the last read, and all symbols before `until`.
    pub(crate) fn finish_entries(&mut self, called: usize, until: usize) -> Result<()> {
        let last = self.entries.len();
        self.read(last, called)?;
        self.apply(last, until)?;
        self.count()
    }

    /// Reads the `called` calls recorded since the last read, for the entries up to `entry`.
    pub(super) fn read(&mut self, entry: usize, called: usize) -> Result<()> {
        let [calls, numbers, counts] = self.buffers.clone();
        read_column(calls, called, &mut self.calls)?;
        read_column(numbers, self.arguments_of(0..called), &mut self.numbers)?;
        read_column(counts, entry.min(self.entries.len()), &mut self.ends)?;
        (self.call_at, self.number_at) = (0, 0);
        Ok(())
    }

    /// Applies the calls of the entries up to `last`, and all symbols before `until` without an
    /// interpretation rule: brackets, ends and the modules of the standard library.
    pub(super) fn apply(&mut self, last: usize, until: usize) -> Result<()> {
        let objects = Arc::clone(&self.objects);
        while self.position < until || self.next < self.entries.len().min(last + 1) {
            let failed = objects.failed().contains(self.chain);
            // One lock covers everything that is done to an object.
            match objects.write(self.chain, |object| self.apply_to(object, failed, last, until)) {
                Ok(ApplyEnd::Last) => break,
                Ok(ApplyEnd::End) => {
                    self.count()?;
                    self.chain += 1;
                    self.begun = false;
                    self.counted = 0;
                }
                Err(error) => {
                    let error = self.blame(error, self.position, self.param).of_data();
                    objects.failed().forgive(self.chain, error)?;
                    self.failed = None;
                }
            }
        }
        Ok(())
    }

    /// Applies as [`Applier::apply`] does, but stops at the end of the chain. Changes nothing in an object
    /// that has `failed`.
    fn apply_to(
        &mut self,
        object: &mut dyn Object,
        failed: bool,
        last: usize,
        until: usize,
    ) -> Result<ApplyEnd> {
        let pass = Arc::clone(&self.pass);
        if !self.begun {
            object.begin();
            self.begun = true;
        }
        while self.next <= last
            && let Some((module, _)) = self.entries.get(self.next).copied()
        {
            if self.symbols(&pass, object, failed, module)? == ApplyEnd::End {
                return Ok(ApplyEnd::End);
            }
            self.locate(&pass, object, self.position);
            self.stop.check()?;
            let begin = pass.plan.profiled.then(Instant::now);
            let applied = self.calls(&pass, object, failed);
            if let Some(begin) = begin {
                self.times.resize(self.next + 1, Duration::ZERO);
                self.times[self.next] += begin.elapsed();
            }
            applied?;
            if self.next == last {
                return Ok(ApplyEnd::Last);
            }
            self.next += 1;
            self.applied = 0;
        }
        self.symbols(&pass, object, failed, until)
    }

    /// Applies the symbols before `until`, but stops at the end of the chain.
    #[inline]
    fn symbols(
        &mut self,
        pass: &InterpretationPass,
        object: &mut dyn Object,
        failed: bool,
        until: usize,
    ) -> Result<ApplyEnd> {
        let arities = pass.plan.steps.grammar.arities();
        let methods = &pass.plan.interpretations.methods;
        while self.position < until {
            let symbol = pass.chain.symbols[self.position];
            let end = self.param + usize::from(arities[usize::from(symbol)]);
            if pass.plan.steps.traced {
                follow(object, self.position);
            }
            if self.position.is_multiple_of(STRETCH) {
                self.stop.check()?;
            }
            self.locate(pass, object, self.position);
            match symbol {
                _ if failed => {}
                OPEN => object.push(),
                CLOSE => {
                    object.pop()?;
                    self.listen(object, None);
                }
                END => {
                    object.end()?;
                    self.listen(object, None);
                }
                symbol => {
                    let place = pass.plan.interpretations.place_of(pass.region(self.position), symbol);
                    let method = methods[place];
                    let params = self.param..end;
                    if method == Interpretations::RESCALE {
                        pass.rescale(object, self.position, &pass.chain.params[params], &self.values)?;
                    } else if method != u16::MAX {
                        self.call(object, method, &pass.chain.params[params])?;
                        self.listen(object, None);
                    }
                }
            }
            self.position += 1;
            self.param = end;
            if symbol == END {
                return Ok(ApplyEnd::End);
            }
        }
        Ok(ApplyEnd::Last)
    }

    /// Notes the place of the object at a module whose rules read it.
    #[inline]
    fn locate(&mut self, pass: &InterpretationPass, object: &dyn Object, module: usize) {
        let located = &pass.plan.located;
        if located.is_empty() || !located.get(usize::from(pass.chain.symbols[module])).is_some_and(|it| *it) {
            return;
        }
        let module = u32::try_from(module).unwrap_or(u32::MAX);
        if let Some(object) = self.locate.and_then(|locate| locate.of(object))
            && self.places.last().is_none_or(|(last, _)| *last != module)
        {
            self.places.push((module, object.place()));
        }
    }

    /// Takes the noted places.
    pub(crate) fn take_places(&mut self) -> Vec<(u32, ObjectPlace)> {
        std::mem::take(&mut self.places)
    }

    /// Takes the sums of the reported numbers.
    pub(super) fn take_reports(&mut self) -> ReportSums {
        std::mem::take(&mut self.reports)
    }

    /// Applies the calls of the entry `next` that have been read.
    #[inline]
    fn calls(&mut self, pass: &InterpretationPass, object: &mut dyn Object, failed: bool) -> Result<()> {
        let end = self.ends.get(self.next).map_or(self.calls.len(), |end| *end as usize);
        if failed {
            self.number_at += self.arguments_of(self.call_at..end);
            self.applied += end - self.call_at;
            self.call_at = end;
            return Ok(());
        }
        if pass.plan.steps.traced {
            follow(object, self.position);
        }
        while self.call_at < end {
            let method = self.calls[self.call_at];
            let count = self.argument_count(method);
            let numbers = self.number_at..self.number_at + count;
            let called = match method {
                OPEN_CALL => {
                    object.push();
                    Ok(())
                }
                CLOSE_CALL => object.pop(),
                method => self.call(object, method, &self.numbers[numbers]),
            };
            if let Err(error) = called {
                self.failed = Some((self.next, self.applied));
                return Err(error);
            }
            self.listen(object, Some((self.next, self.applied)));
            self.call_at += 1;
            self.number_at += count;
            self.applied += 1;
        }
        Ok(())
    }

    /// Returns the total number of arguments of these recorded calls.
    fn arguments_of(&self, calls: std::ops::Range<usize>) -> usize {
        let calls = self.calls.get(calls).unwrap_or_default();
        calls.iter().map(|call| self.argument_count(*call)).sum()
    }

    /// Returns the number of arguments of a recorded call; brackets have none.
    #[inline]
    fn argument_count(&self, call: u16) -> usize {
        self.kind.methods.get(usize::from(call)).map_or(0, |method| method.arguments.len())
    }

    pub(super) fn count(&mut self) -> Result<()> {
        if !self.begun {
            return Ok(());
        }
        let triangles = self.objects.read(self.chain, |object| Ok(object.triangles()))?;
        let (limits, more) =
            ((self.triangle_limit, self.file_limit.as_deref()), triangles.saturating_sub(self.counted));
        self.pass.count_triangles(limits, more)?;
        self.counted = triangles;
        Ok(())
    }

    #[inline]
    fn call(&self, object: &mut dyn Object, method: u16, numbers: &[f64]) -> Result<()> {
        match self.kind.methods.get(usize::from(method)).map(|method| &method.call) {
            Some(Call::Write { numbers: Some(call), .. }) => call(object, numbers),
            call => self.call_with_values(object, call, numbers),
        }
    }

    #[inline(never)]
    fn call_with_values(&self, object: &mut dyn Object, call: Option<&Call>, numbers: &[f64]) -> Result<()> {
        match call {
            Some(Call::Write { values: call, .. }) => {
                let mut values: Vec<Value> =
                    numbers.iter().map(|number| self.values.unpack(*number)).collect();
                while matches!(values.last(), Some(Value::Nil)) {
                    values.pop();
                }
                call(object, &values).map(|_| ())
            }
            Some(Call::Read(_) | Call::Script { .. }) | None => {
                Err(Error::internal("this method cannot be recorded"))
            }
        }
    }

    /// Adds the module and its interpretation rule to an error.
    fn blame(&self, error: Error, module: usize, param: usize) -> Error {
        let plan = &self.pass.plan;
        let symbol = self.pass.chain.symbols[module];
        if symbol <= END {
            return error;
        }
        let arity = usize::from(plan.steps.grammar.arities()[usize::from(symbol)]);
        let params = &self.pass.chain.params[param..param + arity];
        let text = module_brief(plan.steps.grammar.symbols(), &self.values, symbol, params);
        match self.pass.interpretation_at(module) {
            Some(known) if self.waits && matches!(error.kind(), ErrorKind::Limit(Limit::Time)) => {
                error.rule(format!("{} (interpretation)", known.name))
            }
            Some(known) => {
                error.at_place(known.place.as_ref()).rule(format!("{} (interpretation)", known.name))
            }
            None => error,
        }
        .module(text, self.pass.step)
    }
}

/// Records that the symbol at `position` makes the following drawing.
fn follow(object: &mut dyn Object, position: usize) {
    if let Some(drawing) = object.drawing_mut() {
        drawing.trace(u32::try_from(position).unwrap_or(u32::MAX));
    }
}
