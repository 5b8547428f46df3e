//! Applies recorded method calls to the objects, brackets and ends of chains in between.

use std::sync::Arc;
use std::time::{Duration, Instant};

use mlua::Buffer;

use super::Interpreting;
use crate::error::{Error, Result};
use crate::objects::{Call, Method, Object, Value};
use crate::rules::{CLOSE, END, Mark, OPEN, Values, module_text};
use crate::script::{Flusher, Machine, Objects, read_column};

/// Where a piece of the chain has been applied up to.
pub(crate) struct Applier {
    pass: Arc<Interpreting>,
    objects: Arc<Objects>,
    methods: &'static [Method],
    values: Arc<Values>,
    triangle_limit: usize,
    buffers: [Buffer; 3],
    /// The next symbol to be applied.
    position: usize,
    /// Where its parameters begin.
    param: usize,
    /// Its chain.
    chain: usize,
    /// Whether the chain's object has begun its pass.
    begun: bool,
    /// The triangles of the chain's object that have been counted.
    counted: usize,
    entries: Vec<(usize, usize)>,
    /// The first entry that is not wholly applied.
    next: usize,
    calls: Vec<u16>,
    numbers: Vec<f64>,
    ends: Vec<u32>,
    /// The time that the calls of each entry took, if that is measured.
    times: Vec<Duration>,
    /// How many recorded calls of the entry `next` have been applied already.
    applied: usize,
    /// The entry and the number of the call that failed.
    failed: Option<(usize, usize)>,
}

impl Applier {
    pub(crate) fn new(pass: Arc<Interpreting>, machine: &Machine, begin: Mark) -> Result<Self> {
        let missing = || Error::new("the system has no object");
        let objects = pass.plan.objects.clone().ok_or_else(missing)?;
        let methods = objects.read(begin.chain, |object| Ok(object.kind().methods))?;
        let (calls, numbers, counts) =
            machine.prelude().recorded().map_err(|error| machine.translate(error))?;
        Ok(Self {
            values: Arc::clone(&machine.session.values),
            triangle_limit: machine.session.options.limits.triangles,
            pass,
            objects,
            methods,
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
        })
    }

    /// Begins a batch of entries, each the place of a module and of its parameters; `buffers` are the columns
    /// of calls, of their arguments, and of the number of calls up to each entry.
    pub(crate) fn begin_entries(&mut self, entries: &[(usize, usize)], buffers: [Buffer; 3]) {
        self.buffers = buffers;
        self.entries.clear();
        self.entries.extend_from_slice(entries);
        self.next = 0;
        self.times.clear();
        (self.applied, self.failed) = (0, None);
    }

    /// The entry of the batch whose call failed, and the number of that call.
    pub(crate) fn failed(&self) -> Option<(usize, usize)> {
        self.failed
    }

    /// The times of the entries that have been applied.
    pub(crate) fn take_times(&mut self) -> Vec<Duration> {
        std::mem::take(&mut self.times)
    }

    /// Applies the rest of a batch and all symbols before `until`.
    pub(crate) fn finish_entries(&mut self, called: usize, until: usize) -> Result<()> {
        if self.entries.is_empty() {
            return self.walk(until);
        }
        self.flush(self.entries.len(), called)?;
        self.walk(until)?;
        self.count()
    }

    /// Applies everything before the symbol `until` that no rule interprets: brackets, ends and the modules of
    /// the standard library.
    fn walk(&mut self, until: usize) -> Result<()> {
        let pass = Arc::clone(&self.pass);
        let objects = Arc::clone(&self.objects);
        let arities = pass.plan.grammar.arities();
        let methods = &pass.plan.interpretations.methods;
        while self.position < until {
            let mut ended = false;
            let failed = objects.has_failed(self.chain);
            // One lock for all symbols of a chain.
            let walked = objects.write(self.chain, |object| {
                if !self.begun {
                    object.begin();
                    self.begun = true;
                }
                while self.position < until && !ended {
                    let symbol = pass.chain.symbols[self.position];
                    let params = self.param..self.param + usize::from(arities[usize::from(symbol)]);
                    if pass.plan.traced {
                        follow(object, self.position);
                    }
                    match symbol {
                        END if failed => ended = true,
                        _ if failed => {}
                        OPEN => object.push(),
                        CLOSE => object.pop()?,
                        END => {
                            object.end()?;
                            ended = true;
                        }
                        symbol => {
                            let method = methods[usize::from(symbol)];
                            if method != u16::MAX {
                                self.call(object, method, &pass.chain.params[params.clone()])?;
                            }
                        }
                    }
                    self.position += 1;
                    self.param = params.end;
                }
                Ok(())
            });
            if let Err(error) = walked {
                objects.forgive(self.chain, self.blame_at(error, self.position, self.param))?;
                continue;
            }
            if ended {
                self.count()?;
                self.chain += 1;
                self.begun = false;
                self.counted = 0;
            }
        }
        Ok(())
    }

    /// The number of arguments that these recorded calls have together.
    fn arguments_of(&self, calls: std::ops::Range<usize>) -> usize {
        let calls = self.calls.get(calls).unwrap_or_default();
        calls.iter().map(|call| self.methods[usize::from(*call)].arguments.len()).sum()
    }

    fn count(&mut self) -> Result<()> {
        if !self.begun {
            return Ok(());
        }
        let triangles = self.objects.read(self.chain, |object| Ok(object.triangles()))?;
        self.pass.count_triangles(self.triangle_limit, triangles.saturating_sub(self.counted))?;
        self.counted = triangles;
        Ok(())
    }

    fn call(&self, object: &mut dyn Object, method: u16, numbers: &[f64]) -> Result<()> {
        match self.methods.get(usize::from(method)).map(|method| &method.call) {
            Some(Call::Write { numbers: Some(call), .. }) => call(object, numbers),
            Some(Call::Write { values: call, .. }) => {
                let mut values: Vec<Value> =
                    numbers.iter().map(|number| self.values.unpack(*number)).collect();
                while matches!(values.last(), Some(Value::Nil)) {
                    values.pop();
                }
                call(object, &values).map(|_| ())
            }
            _ => Err(Error::new("this method cannot be recorded")),
        }
    }

    fn blame(&self, error: Error, entry: usize) -> Error {
        match self.entries.get(entry) {
            Some((module, param)) => self.blame_at(error, *module, *param),
            None => error,
        }
    }

    /// An error with the module where it happened, and how that is interpreted.
    fn blame_at(&self, error: Error, module: usize, param: usize) -> Error {
        let plan = &self.pass.plan;
        let symbol = self.pass.chain.symbols[module];
        if symbol <= END {
            return error;
        }
        let arity = usize::from(plan.grammar.arities()[usize::from(symbol)]);
        let params = &self.pass.chain.params[param..param + arity];
        let text = module_text(plan.grammar.symbols(), &self.values, symbol, params);
        let interpretations = &plan.interpretations;
        match interpretations.list.get(usize::from(interpretations.by_symbol[usize::from(symbol)])) {
            Some((_, name, place)) => error.at(place.clone()).rule(format!("{name} (interpretation)")),
            None => error,
        }
        .module(text, self.pass.step)
    }
}

/// Notes that the symbol at place `position` of the chain draws what follows.
fn follow(object: &mut dyn Object, position: usize) {
    if let Some(drawing) = object.drawing() {
        drawing.trace(u32::try_from(position).unwrap_or(u32::MAX));
    }
}

impl Flusher for Applier {
    fn flush(&mut self, entry: usize, called: usize) -> Result<()> {
        let [calls, numbers, counts] = self.buffers.clone();
        read_column(calls, called, &mut self.calls)?;
        let arguments: usize =
            self.calls.iter().map(|call| self.methods[usize::from(*call)].arguments.len()).sum();
        read_column(numbers, arguments, &mut self.numbers)?;
        read_column(counts, entry.min(self.entries.len()), &mut self.ends)?;
        let (mut call_at, mut number_at) = (0, 0);
        let traced = self.pass.plan.traced;
        for index in self.next..=entry {
            let Some((module, _)) = self.entries.get(index).copied() else { break };
            self.walk(module)?;
            let begin = self.pass.plan.profiled.then(Instant::now);
            let end = if index < entry { self.ends[index] as usize } else { called };
            let earlier = if index == self.next { self.applied } else { 0 };
            let first = call_at;
            // A method that runs at once follows, so the pass must have begun even without calls.
            let objects = Arc::clone(&self.objects);
            if objects.has_failed(self.chain) {
                number_at += self.arguments_of(call_at..end);
                call_at = call_at.max(end);
            } else if call_at < end || index == entry {
                let applied = objects.write(self.chain, |object| {
                    if !self.begun {
                        object.begin();
                        self.begun = true;
                    }
                    if traced {
                        follow(object, module);
                    }
                    while call_at < end {
                        let method = self.calls[call_at];
                        let count = self.methods[usize::from(method)].arguments.len();
                        self.call(object, method, &self.numbers[number_at..number_at + count])?;
                        call_at += 1;
                        number_at += count;
                    }
                    Ok(())
                });
                if let Err(error) = applied {
                    let error = self.blame(error, index);
                    if let Err(error) = objects.forgive(self.chain, error) {
                        self.failed = Some((index, earlier + call_at - first));
                        return Err(error);
                    }
                    number_at += self.arguments_of(call_at..end);
                    call_at = end;
                }
            }
            self.applied = earlier + call_at - first;
            if let Some(begin) = begin {
                self.times.resize(index + 1, Duration::ZERO);
                self.times[index] += begin.elapsed();
            }
        }
        self.next = entry;
        Ok(())
    }

    fn chain(&self) -> usize {
        self.chain
    }

    fn applier(&mut self) -> Option<&mut Applier> {
        Some(self)
    }
}
