//! Parameters of modules that are not numbers, with each value stored once.

use std::hash::{BuildHasher as _, Hash, Hasher};
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Arc, RwLock};

use rustc_hash::{FxBuildHasher, FxHashMap};

use crate::{Object, Value};
use burgeon_base::locks::LockRecovery;
use burgeon_base::memory::make_room;
use burgeon_rewriting::{ColumnValue, ShowParameters};

/// Strings, tables and objects in the modules of one derivation, each stored once.
///
/// ```
/// use burgeon_kit::{Value, Values};
///
/// let values = Values::default();
/// assert_eq!(values.pack(Value::Number(2.5)), 2.5);
/// let oak = values.pack(Value::Text("oak".into()));
/// assert_eq!(values.unpack(oak), Value::Text("oak".into()));
/// // The same string is stored once.
/// values.pack(Value::Text("oak".into()));
/// assert_eq!(values.len(), 1);
/// ```
#[derive(Default)]
pub struct Values {
    slots: RwLock<Slots>,
    survivors: AtomicUsize,
    epoch: AtomicUsize,
}

#[derive(Default)]
struct Slots {
    list: Vec<Option<Value>>,
    handles: FxHashMap<HashedValue, u32>,
    free: Vec<u32>,
}

impl Slots {
    /// Puts a value into a free slot, and returns its handle.
    fn store(&mut self, value: Value) -> u32 {
        if let Some(handle) = self.free.pop() {
            self.list[handle as usize] = Some(value);
            return handle;
        }
        make_room(&mut self.list, 1);
        self.list.push(Some(value));
        u32::try_from(self.list.len() - 1).unwrap_or(u32::MAX)
    }
}

/// A value with its hash, so that growing the map does not recompute hashes.
#[derive(PartialEq, Eq)]
struct HashedValue {
    hash: u64,
    value: Value,
}

impl HashedValue {
    fn new(value: Value) -> Self {
        Self { hash: FxBuildHasher.hash_one(&value), value }
    }
}

impl Hash for HashedValue {
    fn hash<H: Hasher>(&self, state: &mut H) {
        state.write_u64(self.hash);
    }
}

impl Values {
    /// Stores `value`, and returns the number for a column.
    pub fn pack(&self, value: Value) -> f64 {
        let boxed = match value {
            Value::Nil => ColumnValue::Nil,
            Value::Boolean(value) => ColumnValue::Boolean(value),
            Value::Number(value) => ColumnValue::Number(value),
            other => ColumnValue::Handle(self.handle(other)),
        };
        boxed.pack()
    }

    /// Stores new objects, and returns a handle for each. Equal objects that are stored already are not looked for, since parts of
    /// an operation are seldom equal.
    pub fn store_objects(&self, objects: impl IntoIterator<Item = Arc<dyn Object>>) -> Vec<u32> {
        let mut slots = self.slots.write().recover();
        objects.into_iter().map(|object| slots.store(Value::Object(object))).collect()
    }

    /// Returns the value that a column's number represents.
    pub fn unpack(&self, stored: f64) -> Value {
        match ColumnValue::unpack(stored) {
            ColumnValue::Number(value) => Value::Number(value),
            ColumnValue::Nil => Value::Nil,
            ColumnValue::Boolean(value) => Value::Boolean(value),
            ColumnValue::Handle(handle) => self.get(handle).unwrap_or(Value::Nil),
        }
    }

    /// Returns the objects that numbers of a column represent; `None` if one represents another value.
    pub fn objects(&self, column: impl IntoIterator<Item = f64>) -> Option<Vec<Arc<dyn Object>>> {
        let slots = self.read();
        let object = |stored| match ColumnValue::unpack(stored) {
            ColumnValue::Handle(handle) => match slots.list.get(handle as usize)?.as_ref()? {
                Value::Object(object) => Some(Arc::clone(object)),
                _ => None,
            },
            _ => None,
        };
        column.into_iter().map(object).collect()
    }

    /// Returns the value with this handle, unless it was dropped.
    pub fn get(&self, handle: u32) -> Option<Value> {
        self.read().list.get(handle as usize).cloned().flatten()
    }

    /// Returns the number of stored values.
    pub fn len(&self) -> usize {
        let slots = self.read();
        slots.list.len() - slots.free.len()
    }

    /// Returns true if no value is stored.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Returns the handles of the values that numbers of a column represent.
    pub fn handles(column: &[f64]) -> impl Iterator<Item = u32> + Clone {
        column.iter().filter(|stored| stored.is_nan()).filter_map(|stored| {
            match ColumnValue::unpack(*stored) {
                ColumnValue::Handle(handle) => Some(handle),
                _ => None,
            }
        })
    }

    /// Drops all values that neither `column` nor the handles `kept` contain, if many values were added since the last time.
    ///
    /// A dropped handle can be reused for another value. Caches of handles must be emptied when [`Values::epoch`] has
    /// changed.
    pub fn retain_if_many(&self, column: &[f64], kept: &[u32]) {
        if self.has_many_new(false) {
            self.retain(column, kept);
        }
    }

    /// Drops unused values like [`Values::retain_if_many`], but even after a few additions, for runs with little memory
    /// left.
    pub fn retain_if_new(&self, column: &[f64], kept: &[u32]) {
        if self.has_many_new(true) {
            self.retain(column, kept);
        }
    }

    /// Returns true if [`Values::retain_if_many`] would drop unused values; or [`Values::retain_if_new`], if there is
    /// little memory left.
    pub fn has_many_new(&self, lacks_memory: bool) -> bool {
        let survivors = self.survivors.load(Ordering::Relaxed);
        self.len() > if lacks_memory { survivors + 16 } else { 2 * survivors + 10_000 }
    }

    /// Returns the number of times that values were dropped.
    pub fn epoch(&self) -> usize {
        self.epoch.load(Ordering::Acquire)
    }

    fn retain(&self, column: &[f64], kept: &[u32]) {
        self.epoch.fetch_add(1, Ordering::AcqRel);
        let mut slots = self.slots.write().recover();
        let Slots { list, handles, free } = &mut *slots;
        let mut used = vec![false; list.len()];
        for handle in Self::handles(column).chain(kept.iter().copied()) {
            if let Some(used) = used.get_mut(handle as usize) {
                *used = true;
            }
        }
        handles.retain(|_, handle| used[*handle as usize]);
        for ((handle, slot), used) in (0u32..).zip(list).zip(used) {
            if !used && slot.take().is_some() {
                free.push(handle);
            }
        }
        drop(slots);
        self.survivors.store(self.len(), Ordering::Relaxed);
    }

    fn handle(&self, value: Value) -> u32 {
        let value = HashedValue::new(value);
        if let Some(handle) = self.read().handles.get(&value) {
            return *handle;
        }
        let mut slots = self.slots.write().recover();
        if let Some(handle) = slots.handles.get(&value) {
            return *handle;
        }
        let handle = slots.store(value.value.clone());
        slots.handles.insert(value, handle);
        handle
    }

    fn read(&self) -> std::sync::RwLockReadGuard<'_, Slots> {
        self.slots.read().recover()
    }
}

impl ShowParameters for Values {
    fn show(&self, stored: f64) -> String {
        self.unpack(stored).to_string()
    }

    fn find_text(&self, text: &str) -> Option<f64> {
        let handle = *self.read().handles.get(&HashedValue::new(Value::Text(text.into())))?;
        Some(ColumnValue::Handle(handle).pack())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Table, TableKey};

    #[test]
    fn every_kind_of_value_survives_a_column() {
        let values = Values::default();
        let table = Table { class: None, entries: vec![(TableKey::Index(1), Value::Number(2.0))] };
        for value in [
            Value::Nil,
            Value::Boolean(true),
            Value::Boolean(false),
            Value::Number(-0.0),
            Value::Number(f64::INFINITY),
            Value::Text("café".into()),
            Value::Table(Arc::new(table)),
        ] {
            assert!(values.unpack(values.pack(value.clone())) == value, "{value}");
        }
        let nan = values.unpack(values.pack(Value::Number(f64::NAN)));
        assert!(matches!(nan, Value::Number(number) if number.is_nan()));
    }

    #[test]
    fn equal_values_are_kept_once_and_unused_ones_are_dropped() {
        let values = Values::default();
        let a = values.pack(Value::Text("a".into()));
        assert_eq!(a.to_bits(), values.pack(Value::Text("a".into())).to_bits());
        assert_eq!(values.find_text("a").map(f64::to_bits), Some(a.to_bits()));
        assert_eq!((values.find_text("b"), values.len()), (None, 1));
        values.pack(Value::Text("b".into()));
        assert_eq!(values.len(), 2);
        values.retain(&[1.0, a], &[]);
        assert_eq!(values.len(), 1);
        assert!(values.unpack(a) == Value::Text("a".into()));
        let kept: Vec<u32> = Values::handles(&[a, 2.0]).collect();
        values.pack(Value::Text("c".into()));
        values.retain(&[], &kept);
        assert_eq!((values.len(), values.find_text("c")), (1, None));
        values.retain(&[], &[]);
        assert_eq!((values.len(), values.find_text("a")), (0, None));
    }
}
