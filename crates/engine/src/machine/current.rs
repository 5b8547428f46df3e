//! Current work of a machine, for the Rust functions that Lua calls.

use std::cell::{Cell, RefCell};
use std::sync::Arc;

use super::environments::Environments;
use super::hooks::HookView;
use super::module_places::ModulePlaces;
use crate::declare::Session;
use crate::machine::types::Objects;
use crate::queries::ChainView;
use crate::results::VariableValues;
use burgeon_base::error::{Error, Result, SourcePlace};
use burgeon_base::random::Stream;
use burgeon_base::warning::{Warning, take_deferred};
use burgeon_kit::declare::{downcast_mut, downcast_ref};
use burgeon_kit::{Call, Kind, Object, ObjectPlace, Registry, ScriptObject, Table, Value};
use burgeon_rewriting::{ModuleKey, ReturnShape, Successors, Symbol};

/// Applies recorded method calls to objects during the interpretation of a batch.
pub(crate) trait Flusher: std::any::Any {
    /// Applies all recorded calls: the calls of the entries before `entry`, and the first `called` calls of
    /// `entry`.
    fn flush(&mut self, entry: usize, called: usize) -> Result<()>;

    /// Returns the index of the chain that is being interpreted.
    fn chain(&self) -> usize;

    /// Adds warnings of the chain's object.
    fn warn(&mut self, said: Vec<Warning>);

    /// Records that the interpretation rule of `entry` has returned a `value`, given as text.
    fn lost(&mut self, entry: usize, value: &str);

    /// Returns the parameters of the context modules of interpretation rule `rule` around the module of `entry`; `None` if
    /// the contexts do not match.
    fn context(&self, entry: usize, rule: u16) -> Option<Vec<f64>>;

    /// Adds a number that the interpretation rule of `entry` reports to the sum of `name` in its chain.
    fn report(&mut self, entry: usize, name: &str, value: f64) -> Result<()>;

    /// Records that the interpretation rule of `entry` has returned a module that nothing draws.
    fn note_undrawn(&mut self, entry: usize, symbol: Symbol);

    /// Records that `entry` has returned a `module`, given as text, to which `rule` does not apply any more.
    fn note_depth(&mut self, entry: usize, rule: u16, module: &str, max_depth: usize);
}

/// Step for which rules or interpretation rules run.
#[derive(Clone, Copy)]
struct RunningStep {
    number: usize,
    /// Set if the number of steps is given, which `step()` requires.
    bounded: bool,
    /// Set if a function has read the number.
    read: bool,
}

/// Random stream of a module after some of its numbers.
struct PartialStream {
    key: ModuleKey,
    /// Number of numbers that were drawn.
    position: usize,
    stream: Stream,
}

/// State of the current rewriting or interpretation.
pub(crate) struct WorkState {
    pub session: Arc<Session>,
    /// System that the machine works for.
    pub system: Cell<Option<usize>>,
    /// Objects of that system.
    pub objects: RefCell<Option<Arc<Objects>>>,
    /// Chain of each application in the batch.
    pub chains: RefCell<Vec<u32>>,
    /// Time of each chain, if the rules of the system have propensities.
    times: RefCell<Vec<f64>>,
    /// Random key of each application in the batch.
    pub keys: RefCell<Vec<ModuleKey>>,
    /// Index in the chain of each application in the batch, if queries are recorded or places are known.
    pub places: RefCell<Vec<u32>>,
    /// Places of the object at modules of the chain, if the last pass has noted them.
    pub located: RefCell<Option<Arc<ModulePlaces>>>,
    /// Set if rules read places, but the script asks for the last pass only.
    pub skips_passes: Cell<bool>,
    /// Number of random numbers that the weighted choice has already used.
    pub used: Cell<usize>,
    /// Maximum number of random numbers that one recent application has drawn.
    pub drawn: Cell<usize>,
    /// Stream of the number that was drawn last, so that the next one does not start from the first.
    latest: RefCell<Option<PartialStream>>,
    /// Step for which rules run, if any have run.
    step: Cell<Option<RunningStep>>,
    /// Set if a function has requested that the step that is running is the last.
    ends: Cell<bool>,
    /// Derivation of the hook that runs.
    pub hook: RefCell<Option<HookView>>,
    /// Variables that functions of the script read.
    pub variables: RefCell<Option<VariableValues>>,
    /// Environments of the derivation.
    pub environments: RefCell<Option<Arc<Environments>>>,
    /// Type of `this`; Lua refers to its methods by number.
    pub kind: RefCell<Option<Arc<Kind>>>,
    /// Shapes of prepared results, by number.
    pub shapes: RefCell<Arc<Vec<ReturnShape>>>,
    /// Applier of recorded calls during interpretation.
    pub flusher: RefCell<Option<Box<dyn Flusher>>>,
    /// Random stream of the top level of the script.
    pub top: RefCell<Stream>,
    /// Number of parameters that have become values of Lua since the caches of parameters were cleared.
    pub unpacked: Cell<usize>,
    /// Chains of the derived systems, for queries at the top level of the script.
    pub chains_derived: RefCell<ChainView>,
}

impl WorkState {
    pub(crate) fn new(session: Arc<Session>) -> Self {
        let top = ModuleKey::seed(session.options.seed).stream();
        Self {
            session,
            system: Cell::new(None),
            objects: RefCell::default(),
            chains: RefCell::default(),
            times: RefCell::default(),
            keys: RefCell::default(),
            places: RefCell::default(),
            located: RefCell::default(),
            skips_passes: Cell::new(false),
            used: Cell::new(0),
            drawn: Cell::new(0),
            latest: RefCell::default(),
            step: Cell::new(None),
            ends: Cell::new(false),
            hook: RefCell::default(),
            variables: RefCell::default(),
            environments: RefCell::default(),
            kind: RefCell::default(),
            shapes: RefCell::default(),
            flusher: RefCell::default(),
            top: RefCell::new(top),
            unpacked: Cell::new(0),
            chains_derived: RefCell::default(),
        }
    }

    pub(crate) fn add_shape(&self, number: usize, symbols: Vec<Symbol>, arities: &[u8]) {
        let Some(number) = number.checked_sub(Successors::SHAPE as usize) else { return };
        let params = symbols.iter().map(|symbol| usize::from(arities[usize::from(*symbol)])).sum();
        let mut shapes = self.shapes.borrow_mut();
        let shapes = Arc::make_mut(&mut shapes);
        if shapes.len() <= number {
            shapes.resize_with(number + 1, ReturnShape::default);
        }
        shapes[number] = ReturnShape { symbols, params };
    }

    /// Draws number `index` of an application's random stream.
    pub(crate) fn draw(&self, application: usize, index: usize) -> Result<f64> {
        let key = self.key(Some(application))?;
        let position = self.used.get() + index;
        self.drawn.set(self.drawn.get().max(index + 1));
        let mut latest = self.latest.borrow_mut();
        let latest = match &mut *latest {
            Some(latest) if latest.key == key && latest.position <= position => latest,
            other => other.insert(PartialStream { key, position: 0, stream: key.stream() }),
        };
        for _ in latest.position..position {
            latest.stream.uniform();
        }
        latest.position = position + 1;
        Ok(latest.stream.uniform())
    }

    /// Adds the key of a module that the interpretation rule with key `parent` has returned, from the hash of its name and
    /// its ordinal among the modules with this name. Returns its index.
    pub(crate) fn add_successor_key(&self, parent: usize, name: u64, ordinal: usize) -> Result<usize> {
        let key = self.key(Some(parent))?.successor(name, ordinal);
        let mut keys = self.keys.borrow_mut();
        keys.push(key);
        Ok(keys.len() - 1)
    }

    /// Returns the key of an application's random stream, or that of the top level for `None`.
    pub(crate) fn key(&self, application: Option<usize>) -> Result<ModuleKey> {
        let Some(application) = application else { return Ok(ModuleKey::seed(self.session.options.seed)) };
        let key = self.keys.borrow().get(application).copied();
        key.ok_or_else(|| Error::scope("random numbers are not available here"))
    }

    /// Sets the number of the step for the next calls. `bounded` is set if the number of steps is given.
    pub(crate) fn begin_step(&self, number: usize, bounded: bool) {
        self.step.set(Some(RunningStep { number, bounded, read: false }));
    }

    /// Returns the number of the step for a function of the script. Fails if the derivation runs until nothing changes,
    /// because a function that reads the number can always change something.
    pub(crate) fn read_step(&self) -> Result<usize> {
        let step = self.step.get().ok_or_else(|| Error::scope("no step is running"))?;
        if !step.bounded {
            return Err(Error::scope(
                "step() needs a number of steps, but this derivation runs until nothing changes",
            )
            .help("pass a number to derive: system:derive(20), or set --steps 20"));
        }
        self.step.set(Some(RunningStep { read: true, ..step }));
        Ok(step.number)
    }

    /// Returns true if a function has read the number of the step since [`WorkState::begin_step`].
    pub(crate) fn has_read_step(&self) -> bool {
        self.step.get().is_some_and(|step| step.read)
    }

    /// Sets the time of each chain for the next calls; empty if the rules of the system have no propensities.
    pub(crate) fn set_times(&self, times: &[f64]) {
        let mut known = self.times.borrow_mut();
        known.clear();
        known.extend_from_slice(times);
    }

    /// Returns the time of the chain of an application. Fails if it has none.
    pub(crate) fn time_of(&self, application: usize) -> Result<f64> {
        self.times.borrow().get(self.chain_of(application)).copied().ok_or_else(|| {
            Error::scope("time() needs rules with propensities, because only their derivations have a time")
                .help("give the rules propensities, { propensity = 0.5 }, or use step()")
        })
    }

    /// Requests that the step that is running is the last.
    pub(crate) fn request_end(&self) {
        self.ends.set(true);
    }

    /// Returns true if a function has requested since the last call that the step that is running is the last.
    pub(crate) fn take_end(&self) -> bool {
        self.ends.take()
    }

    /// Returns the chain being interpreted, or the chain of an application in the batch.
    pub(crate) fn chain_of(&self, application: usize) -> usize {
        match self.flusher.borrow().as_ref() {
            Some(flusher) => flusher.chain(),
            None => self.chains.borrow().get(application).copied().unwrap_or(0) as usize,
        }
    }

    /// Calls `ask` with the object of `chain`, whose type the script declared, or with its child object at
    /// `slot`.
    pub(crate) fn script_object<T>(
        &self,
        chain: usize,
        slot: Option<usize>,
        ask: impl FnOnce(&ScriptObject) -> Result<T>,
    ) -> Result<T> {
        let objects = self.objects.borrow();
        let objects = objects.as_ref().ok_or_else(outside)?;
        objects.read(chain, |object| {
            let object = downcast_ref::<ScriptObject>(object)?;
            match slot {
                None => ask(object),
                Some(slot) => ask(downcast_ref(object.held(slot)?)?),
            }
        })
    }

    /// Stores the state after a pass in the object of `chain`, or in its child object at `slot`.
    pub(crate) fn keep_state(&self, chain: usize, slot: Option<usize>, state: Arc<Table>) -> Result<()> {
        let objects = self.objects.borrow();
        let objects = objects.as_ref().ok_or_else(outside)?;
        let keep = |object: &mut dyn Object, state| {
            downcast_mut::<ScriptObject>(object)?.set_state(state);
            Ok(())
        };
        objects.write(chain, |object| match slot {
            None => keep(object, state),
            Some(slot) => downcast_mut::<ScriptObject>(object)?.with_held(slot, |object| keep(object, state)),
        })
    }

    /// Returns the error for a name that objects of the type `kind` do not have.
    pub(crate) fn unknown_member(&self, kind: &str, name: &str, registry: &Registry) -> Error {
        let current = self.kind.borrow();
        match current.as_ref().filter(|known| known.name == kind).or_else(|| registry.get(kind)) {
            Some(kind) => kind.unknown_method(name),
            None => Error::argument(format!("unknown method or field `{name}` of {kind}")),
        }
    }

    /// Returns the answer of a read method at the module of an application, if it depends on the place and that is known.
    /// Fails if no pass has noted the places because only the last chain is interpreted.
    fn answer_at(&self, application: usize, method: &str) -> Result<Option<Value>> {
        if self.flusher.borrow().is_some() {
            return Ok(None);
        }
        if self.skips_passes.get() && ObjectPlace::METHODS.contains(&method) {
            let message =
                format!("{method} is unknown in a rule, because only the last chain is interpreted");
            return Err(
                Error::scope(message).help("omit interpret = \"last\", so that every chain is interpreted")
            );
        }
        let located = self.located.borrow();
        let module = self.places.borrow().get(application).copied();
        let place = located.as_ref().zip(module).and_then(|(located, module)| located.get(module));
        Ok(place.and_then(|place| place.answer(method)))
    }

    /// Returns the index in the chain of an application, if queries of rules are recorded.
    pub(crate) fn noted_place(&self, application: usize) -> Option<usize> {
        self.session.options.reports.trace.filter(|traced| traced.chain.is_some())?;
        self.places.borrow().get(application).map(|place| *place as usize)
    }

    /// Calls a method of `this`, or of its child object at `slot`, immediately. `place` is the line of the
    /// call.
    pub(crate) fn call(
        &self,
        slot: Option<usize>,
        method: usize,
        application: usize,
        arguments: &[Value],
        place: impl FnOnce() -> Option<SourcePlace>,
    ) -> Result<Value> {
        self.session.stop.check()?;
        let chain = self.chain_of(application);
        let objects = self.objects.borrow();
        let objects = objects.as_ref().ok_or_else(outside)?;
        let missing = || Error::internal("unknown method");
        let kind = match slot {
            None => self.kind.borrow().clone().ok_or_else(missing)?,
            Some(slot) => objects.read(chain, |object| {
                Ok(Arc::clone(downcast_ref::<ScriptObject>(object)?.held(slot)?.kind()))
            })?,
        };
        match &kind.methods.get(method).ok_or_else(missing)?.call {
            Call::Read(read) => {
                if slot.is_none()
                    && let Some(answer) = self.answer_at(application, &kind.methods[method].name)?
                {
                    return Ok(answer);
                }
                take_deferred();
                let answer = objects.read(chain, |object| match slot {
                    None => read(object, arguments),
                    Some(slot) => read(downcast_ref::<ScriptObject>(object)?.held(slot)?, arguments),
                });
                let deferred = take_deferred();
                if !deferred.is_empty() {
                    let place = place();
                    for warning in deferred {
                        self.session.warn(warning.at_place(place.as_ref()));
                    }
                }
                answer.map_err(Error::of_data)
            }
            Call::Script { .. } => Err(Error::internal("the script itself runs this method")),
            Call::Write { .. } if objects.failed().contains(chain) => Ok(Value::Nil),
            Call::Write { values, .. } => {
                let mut said = Vec::new();
                let done = objects.write(chain, |object| {
                    let done = match slot {
                        None => values(object, arguments),
                        Some(slot) => downcast_mut::<ScriptObject>(object)?
                            .with_held(slot, |held| values(held, arguments)),
                    };
                    said = object.take_warnings();
                    done
                });
                if !said.is_empty()
                    && let Some(flusher) = self.flusher.borrow_mut().as_mut()
                {
                    let place = place();
                    flusher.warn(said.into_iter().map(|warning| warning.at_place(place.as_ref())).collect());
                }
                done.or_else(|error| objects.failed().forgive(chain, error.of_data()).map(|()| Value::Nil))
            }
        }
    }
}

fn outside() -> Error {
    Error::scope("this is only known within rules")
}
