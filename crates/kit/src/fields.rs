//! Tables of named fields that are given as one value.

use std::marker::PhantomData;
use std::sync::Arc;

use super::{Expectation, Field, Parameter, Table, Value};
use burgeon_base::Result;

/// What the attribute `fields` declares: a struct that is read from a script's table.
pub trait Fields: Sized {
    /// What the table may have.
    fn list() -> Vec<Field>;

    /// Reads a script's table. Fails for unknown names and wrong types.
    fn read(table: &Table) -> Result<Self>;
}

/// A table of the fields of `T` that a method takes and reads itself, so that messages name what the table is for.
#[derive(Debug, Clone)]
pub struct TableOf<T>(Arc<Table>, PhantomData<fn() -> T>);

impl<T: Fields> TableOf<T> {
    /// What the table says.
    pub fn read(&self) -> Result<T> {
        T::read(&self.0)
    }
}

impl<T> Default for TableOf<T> {
    fn default() -> Self {
        Self::from(Arc::default())
    }
}

impl<T> From<Arc<Table>> for TableOf<T> {
    fn from(table: Arc<Table>) -> Self {
        Self(table, PhantomData)
    }
}

impl<T: Fields> Parameter for TableOf<T> {
    fn luau() -> String {
        Arc::<Table>::luau()
    }

    fn fields() -> Vec<Field> {
        T::list()
    }

    fn from_value(value: Value) -> Result<Self, Expectation> {
        Arc::<Table>::from_value(value).map(Self::from)
    }

    fn into_value(self) -> Value {
        self.0.into_value()
    }
}
