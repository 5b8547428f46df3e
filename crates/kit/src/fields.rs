//! Tables of named fields that are passed as one value.

use std::marker::PhantomData;
use std::sync::Arc;

use super::{Expectation, Field, Parameter, Table, Value};
use burgeon_base::Result;

/// Declaration that the attribute `fields` generates for a struct that is read from a script's table.
pub trait Fields: Sized {
    /// Returns the fields that the table can have.
    fn list() -> Vec<Field>;

    /// Reads a script's table. Fails for unknown names and wrong types.
    fn read(table: &Table) -> Result<Self>;
}

/// Table of the fields of `T`. The method that takes it also reads it, so that error messages can name the purpose of
/// the table.
#[derive(Debug, Clone)]
pub struct TableOf<T>(Arc<Table>, PhantomData<fn() -> T>);

impl<T: Fields> TableOf<T> {
    /// Reads the table. Fails for unknown names and wrong types.
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
