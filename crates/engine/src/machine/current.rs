//! The work that a machine is at, for the functions that Rust gives to Lua.

use std::cell::{Cell, RefCell};
use std::sync::Arc;

use crate::declare::Session;
use crate::machine::types::Objects;
use crate::questions::ChainView;
use burgeon_base::error::{Error, Result, SourcePlace};
use burgeon_base::random::Stream;
use burgeon_base::warning::{Warning, take_deferred};
use burgeon_kit::declare::{downcast_mut, downcast_ref};
use burgeon_kit::{Call, Kind, Object, Registry, ScriptObject, Table, Value};
use burgeon_rewriting::{ModuleKey, ReturnShape, Successors, Symbol};

/// Applies recorded method calls to objects while a batch is interpreted.
pub(crate) trait Flusher: std::any::Any {
    /// Applies all calls recorded so far: those of the entries before `entry` and the first `called` of it.
    fn flush(&mut self, entry: usize, called: usize) -> Result<()>;

    /// The chain that is being interpreted.
    fn chain(&self) -> usize;

    /// Takes what the object of the chain has warned of.
    fn warn(&mut self, said: Vec<Warning>);

    /// Notes that the interpretation rule of `entry` has returned a `value`, in words, or modules where there is none.
    fn lost(&mut self, entry: usize, value: Option<&str>);
}

/// What is being rewritten or interpreted.
pub(crate) struct WorkState {
    pub session: Arc<Session>,
    /// The system that the machine works for.
    pub system: Cell<Option<usize>>,
    /// The objects of the system at work.
    pub objects: RefCell<Option<Arc<Objects>>>,
    /// The chain of each application in the batch.
    pub chains: RefCell<Vec<u32>>,
    /// The random key of each application in the batch.
    pub keys: RefCell<Vec<ModuleKey>>,
    /// The place in the chain of each application in the batch, where it is noted what they ask of data.
    pub places: RefCell<Vec<u32>>,
    /// How many numbers of its stream an application's weighted choice has used already.
    pub used: Cell<usize>,
    /// The most random numbers that one application has drawn lately.
    pub drawn: Cell<usize>,
    /// The type of `this`, whose methods Lua knows by their numbers.
    pub kind: RefCell<Option<Arc<Kind>>>,
    /// The shapes of prepared returns, by number.
    pub shapes: RefCell<Arc<Vec<ReturnShape>>>,
    /// Applies recorded calls while interpreting.
    pub flusher: RefCell<Option<Box<dyn Flusher>>>,
    /// The stream of the top level of the script.
    pub top: RefCell<Stream>,
    /// The chains of the systems that are derived, as the top level of the script sees them.
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
            keys: RefCell::default(),
            places: RefCell::default(),
            used: Cell::new(0),
            drawn: Cell::new(0),
            kind: RefCell::default(),
            shapes: RefCell::default(),
            flusher: RefCell::default(),
            top: RefCell::new(top),
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

    /// Draws number `index` of an application's stream.
    pub(crate) fn draw(&self, application: usize, index: usize) -> Result<f64> {
        let keys = self.keys.borrow();
        let key = keys.get(application).ok_or_else(|| Error::scope("random is not available here"))?;
        let mut stream = key.stream();
        for _ in 0..self.used.get() + index {
            stream.uniform();
        }
        self.drawn.set(self.drawn.get().max(index + 1));
        Ok(stream.uniform())
    }

    /// The chain that is interpreted, or that of an application in the batch.
    pub(crate) fn chain_of(&self, application: usize) -> usize {
        match self.flusher.borrow().as_ref() {
            Some(flusher) => flusher.chain(),
            None => self.chains.borrow().get(application).copied().unwrap_or(0) as usize,
        }
    }

    /// Asks the object of `chain`, whose type the script declared, or the one that it holds at `slot`.
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

    /// Keeps the state that a pass has left with the object of `chain`, or with the one that it holds at `slot`.
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

    /// The error for a name that objects of the type `kind` do not have.
    pub(crate) fn unknown_member(&self, kind: &str, name: &str, registry: &Registry) -> Error {
        let of = self.kind.borrow().as_ref().filter(|known| known.name == kind).cloned();
        match of.or_else(|| registry.get(kind).cloned()) {
            Some(kind) => kind.unknown_method(name),
            None => Error::argument(format!("{kind} has no method or field called {name}")),
        }
    }

    /// Calls a method of `this`, or of the object that it holds at `slot`, at once, while rewriting or interpreting, in the
    /// line at `place`.
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
        let missing = || Error::internal("there is no such method");
        let kind = match slot {
            None => self.kind.borrow().clone().ok_or_else(missing)?,
            Some(slot) => objects.read(chain, |object| {
                Ok(Arc::clone(downcast_ref::<ScriptObject>(object)?.held(slot)?.kind()))
            })?,
        };
        match &kind.methods.get(method).ok_or_else(missing)?.call {
            Call::Read(read) => {
                take_deferred();
                let answer = objects.read(chain, |object| match slot {
                    None => read(object, arguments),
                    Some(slot) => read(downcast_ref::<ScriptObject>(object)?.held(slot)?, arguments),
                });
                let deferred = take_deferred();
                if !deferred.is_empty() {
                    let place = place();
                    for warning in deferred {
                        self.session.warn(warning.at(place.clone()));
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
                    flusher.warn(said.into_iter().map(|warning| warning.at(place.clone())).collect());
                }
                done.or_else(|error| objects.failed().forgive(chain, error.of_data()).map(|()| Value::Nil))
            }
        }
    }
}

fn outside() -> Error {
    Error::scope("this is only known within rules")
}
