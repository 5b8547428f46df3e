//! Result of a query.

use std::sync::Arc;

use crate::contract::Value;

/// Result of a query: ordered rows, each with one value per column.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct QueryRows {
    /// Column names.
    pub names: Vec<Arc<str>>,
    /// Values, row by row; [`Value::Nil`] for NULL.
    pub values: Vec<Value>,
}

impl QueryRows {
    /// Returns the number of rows.
    pub fn len(&self) -> usize {
        self.values.len() / self.names.len().max(1)
    }

    /// Returns true if there are no rows.
    pub fn is_empty(&self) -> bool {
        self.values.is_empty()
    }

    /// Returns an iterator over the rows.
    pub fn iter(&self) -> impl Iterator<Item = &[Value]> {
        self.values.chunks_exact(self.names.len().max(1))
    }

    /// Returns the index of the id column, if there is one.
    pub fn id(&self) -> Option<usize> {
        const IDS: [&str; 3] = ["fid", "id", "ogc_fid"];
        IDS.iter().find_map(|id| self.names.iter().position(|name| name.eq_ignore_ascii_case(id)))
    }

    /// Returns for each column whether it contains geometries.
    pub fn geometries(&self) -> Vec<bool> {
        let of = |column: usize| self.iter().map(move |row| &row[column]);
        let is_of_geometries = |column| {
            of(column)
                .find(|value| !matches!(value, Value::Nil))
                .is_some_and(|value| matches!(value, Value::Object(_)))
        };
        (0..self.names.len()).map(is_of_geometries).collect()
    }
}
