//! Values of the variables of a system.

use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};

use burgeon_kit::Value;

/// Values of the variables of a system.
#[derive(Clone)]
pub(crate) struct VariableValues {
    /// Index of the variables among those of the script.
    pub(crate) table: usize,
    pub(crate) names: Arc<[Arc<str>]>,
    pub(crate) values: Vec<Value>,
    /// Number that is different for all states of all variables.
    version: u64,
}

impl VariableValues {
    /// Creates the variables number `table` of the script with their first values.
    pub(crate) fn new(table: usize, names: &[Arc<str>], values: &[Value]) -> Self {
        Self { table, names: names.into(), values: values.to_vec(), version: new_version() }
    }

    /// Sets the variable at `index`.
    pub(crate) fn set(&mut self, index: usize, value: Value) {
        self.values[index] = value;
        self.version = new_version();
    }

    /// Returns the same variables with the values of `other`, where these are the same variables.
    pub(crate) fn continued(mut self, other: Option<&Self>) -> Self {
        if let Some(other) = other.filter(|other| other.table == self.table) {
            self.values.clone_from(&other.values);
        }
        self
    }

    /// Returns true if the values have not changed since `earlier` was copied.
    pub(crate) fn is_same(&self, earlier: &Self) -> bool {
        self.version == earlier.version
    }
}

fn new_version() -> u64 {
    static NEXT: AtomicU64 = AtomicU64::new(0);
    NEXT.fetch_add(1, Ordering::Relaxed)
}
