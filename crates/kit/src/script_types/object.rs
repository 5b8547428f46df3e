//! An object whose type a script declares: its base object, its fields and its state between passes.

use std::sync::Arc;

use crate::declare::{as_mut, as_ref};
use crate::{Draw, Drawing, Kind, LevelOfDetail, Object, Report, ScriptType, Table, Value, Warn};
use burgeon_base::error::{Error, Result};
use burgeon_base::warning::Warning;
use burgeon_macros::methods;

/// An object of a type that a script declares.
///
/// During a pass, its state is in the virtual machine that interprets its chain. This struct contains the state after
/// the last pass.
pub struct ScriptObject {
    kind: Arc<Kind>,
    of: Arc<ScriptType>,
    base: Option<Box<dyn Object>>,
    fields: Arc<Table>,
    state: Arc<Table>,
    held: Vec<Box<dyn Object>>,
    /// Drawing of the object, if it has no base object that draws.
    drawing: Drawing,
    detail: u8,
    notes: Vec<Warning>,
}

/// Maximum number of report entries that one object keeps per pass.
const MOST_NOTES: usize = 1000;

#[methods("object")]
impl ScriptObject {
    /// Adds a report entry about a result that differs from the request, such as "a short arm instead of a long one".
    pub fn note(&mut self, what: String, why: Option<String>) {
        // An endless loop must not fill the memory, and more entries of one object are not useful.
        if self.notes.len() < MOST_NOTES {
            self.notes.push(Warning::simplification(what).with_cause(why.unwrap_or_default()));
        }
    }

    /// Returns the level of detail to draw in: 0 footprints, 1 blocks, 2 roofs, 3 everything.
    pub fn detail(&self) -> u32 {
        u32::from(self.detail)
    }
}

impl ScriptObject {
    /// Creates an object with these `fields`, and `base` as its base object, before its first pass.
    pub(crate) fn new(
        kind: Arc<Kind>,
        of: Arc<ScriptType>,
        base: Option<Box<dyn Object>>,
        fields: Arc<Table>,
    ) -> Self {
        let held = of.held.iter().map(|(_, object)| object.boxed()).collect();
        let state = Arc::clone(&of.state);
        Self {
            kind,
            of,
            base,
            fields,
            state,
            held,
            drawing: Drawing::default(),
            detail: 3,
            notes: Vec::new(),
        }
    }

    /// Returns the values of the fields that the object's own type declares.
    pub fn fields(&self) -> &Arc<Table> {
        &self.fields
    }

    /// Returns the state after the last pass.
    pub fn state(&self) -> &Arc<Table> {
        &self.state
    }

    /// Stores the state at the end of a pass.
    pub fn set_state(&mut self, state: Arc<Table>) {
        self.state = state;
    }

    /// Returns the field or state variable called `name`.
    pub fn member(&self, name: &str) -> Option<Value> {
        let held = || {
            let index = self.of.held.iter().position(|(known, _)| **known == *name)?;
            Some(Value::Object(Arc::from(self.held[index].boxed())))
        };
        self.fields.get(name).or_else(|| self.state.get(name)).cloned().or_else(held)
    }

    /// Returns the child object at `slot` for reading. Slots number the child objects recursively: the children of a
    /// child object follow it.
    pub fn held(&self, slot: usize) -> Result<&dyn Object> {
        let (index, inner) = self.of.held_at(slot).ok_or_else(none_held)?;
        let object = self.held.get(index).map(|object| &**object).ok_or_else(none_held)?;
        match inner {
            None => Ok(object),
            Some(inner) => as_ref::<Self>(object).ok_or_else(none_held)?.held(inner),
        }
    }

    /// Returns the direct child objects with their names, in the order of declaration.
    pub fn held_directly(&self) -> impl Iterator<Item = (&Arc<str>, &dyn Object)> {
        self.of.held.iter().map(|(name, _)| name).zip(self.held.iter().map(|object| &**object))
    }

    /// Calls `act` with the child object at `slot`, which meanwhile draws into this object's drawing.
    pub fn with_held<T>(&mut self, slot: usize, act: impl FnOnce(&mut dyn Object) -> Result<T>) -> Result<T> {
        let (index, inner) = self.of.held_at(slot).ok_or_else(none_held)?;
        self.with_direct(index, |object| match inner {
            None => act(object),
            Some(inner) => as_mut::<Self>(object).ok_or_else(none_held)?.with_held(inner, act),
        })
    }

    /// Returns the drawing that the object and its child objects share.
    fn shared(&mut self) -> &mut Drawing {
        let Self { base, drawing, .. } = self;
        base.as_deref_mut().and_then(|base| base.drawing_mut()).unwrap_or(drawing)
    }

    fn with_direct<T>(&mut self, index: usize, act: impl FnOnce(&mut dyn Object) -> Result<T>) -> Result<T> {
        let Self { base, held, drawing, .. } = self;
        let shared = base.as_deref_mut().and_then(|base| base.drawing_mut()).unwrap_or(drawing);
        let object = &mut **held.get_mut(index).ok_or_else(none_held)?;
        swap(object, shared);
        let done = act(object);
        swap(object, shared);
        done
    }

    fn each_held(&mut self, mut act: impl FnMut(&mut dyn Object) -> Result<()>) -> Result<()> {
        (0..self.held.len()).try_for_each(|index| self.with_direct(index, &mut act))
    }
}

fn swap(object: &mut dyn Object, shared: &mut Drawing) {
    if let Some(own) = object.drawing_mut() {
        std::mem::swap(own, shared);
    }
}

fn none_held() -> Error {
    Error::internal("unknown child object")
}

impl Object for ScriptObject {
    fn kind(&self) -> &Arc<Kind> {
        &self.kind
    }

    fn boxed(&self) -> Box<dyn Object> {
        Box::new(Self {
            kind: Arc::clone(&self.kind),
            of: Arc::clone(&self.of),
            base: self.base.as_ref().map(|base| base.boxed()),
            fields: Arc::clone(&self.fields),
            state: Arc::clone(&self.state),
            held: self.held.iter().map(|object| object.boxed()).collect(),
            drawing: self.drawing.clone(),
            detail: self.detail,
            notes: self.notes.clone(),
        })
    }

    fn begin(&mut self) {
        self.notes.clear();
        self.drawing.clear();
        if let Some(base) = &mut self.base {
            base.begin();
        }
        // Child objects draw into the shared drawing, so their `begin` must not clear it again.
        let before = self.shared().keep(true);
        // The closure never fails.
        let _: Result<()> = self.each_held(|object| {
            object.begin();
            Ok(())
        });
        self.shared().keep(before);
    }

    fn push(&mut self) {
        if let Some(base) = &mut self.base {
            base.push();
        }
        let _: Result<()> = self.each_held(|object| {
            object.push();
            Ok(())
        });
    }

    fn pop(&mut self) -> Result<()> {
        self.each_held(|object| object.pop())?;
        self.base.as_mut().map_or(Ok(()), |base| base.pop())
    }

    fn end(&mut self) -> Result<()> {
        self.each_held(|object| object.end())?;
        if let Some(base) = &mut self.base {
            base.end()?;
            self.notes.extend_from_slice(base.notes());
        }
        for object in &self.held {
            self.notes.extend_from_slice(object.notes());
        }
        Ok(())
    }

    fn seed(&mut self, seed: u64) {
        if let Some(base) = &mut self.base {
            base.seed(seed);
        }
        self.held.iter_mut().for_each(|object| object.seed(seed));
    }

    fn base(&self) -> Option<&dyn Object> {
        self.base.as_deref()
    }

    fn base_mut(&mut self) -> Option<&mut dyn Object> {
        self.base.as_deref_mut()
    }
}

impl Draw for ScriptObject {
    fn drawing(&self) -> &Drawing {
        &self.drawing
    }

    fn drawing_mut(&mut self) -> &mut Drawing {
        &mut self.drawing
    }
}

impl Warn for ScriptObject {
    fn take_warnings(&mut self) -> Vec<Warning> {
        let base = self.base.as_mut().map(|base| base.take_warnings());
        let held = self.held.iter_mut().flat_map(|object| object.take_warnings());
        base.into_iter().flatten().chain(held).collect()
    }
}

impl LevelOfDetail for ScriptObject {
    fn set_detail(&mut self, detail: u8) {
        self.detail = detail;
        if let Some(base) = &mut self.base {
            base.set_detail(detail);
        }
        self.held.iter_mut().for_each(|object| object.set_detail(detail));
    }
}

impl Report for ScriptObject {
    fn notes(&self) -> &[Warning] {
        &self.notes
    }
}
