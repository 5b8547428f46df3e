//! Rows of a query.

use std::fmt;
use std::sync::Arc;

use crate::contract::Value;
use burgeon_base::BudgetCharge;

/// Ordered rows, each with one value per column: the result of a query, or a table for queries.
///
/// The values are those of scripts, or of another type `V`, such as that of a database.
///
/// ```
/// use burgeon_kit::{QueryRows, Value};
///
/// let rows = QueryRows::new(["id".into(), "height".into()], [7.0, 12.5, 8.0, 9.0].map(Value::Number));
/// assert_eq!((rows.len(), rows.id(), rows.row(1)), (2, Some(0), &[8.0, 9.0].map(Value::Number)[..]));
/// ```
#[derive(Debug)]
pub struct QueryRows<V = Value> {
    /// Column names.
    pub names: Arc<[Arc<str>]>,
    /// Values, row by row; [`Value::Nil`] for NULL.
    pub values: Vec<V>,
    /// Memory of the values, if a budget limits it.
    pub charge: BudgetCharge,
}

impl<V> Default for QueryRows<V> {
    /// Returns no rows, without columns.
    fn default() -> Self {
        Self::new([], [])
    }
}

impl<V> QueryRows<V> {
    /// Creates rows with `values`, row by row, which no budget limits.
    pub fn new(names: impl Into<Arc<[Arc<str>]>>, values: impl Into<Vec<V>>) -> Self {
        Self { names: names.into(), values: values.into(), charge: BudgetCharge::default() }
    }

    /// Returns the number of rows.
    pub fn len(&self) -> usize {
        self.values.len() / self.width()
    }

    /// Returns true if there are no rows.
    pub fn is_empty(&self) -> bool {
        self.values.is_empty()
    }

    /// Returns the number of values of a row: 1 if there are no columns.
    pub fn width(&self) -> usize {
        self.names.len().max(1)
    }

    /// Returns an iterator over the rows.
    pub fn iter(&self) -> impl Iterator<Item = &[V]> {
        self.values.chunks_exact(self.width())
    }

    /// Returns a row, counted from 0; empty if there is no such row.
    pub fn row(&self, index: usize) -> &[V] {
        let width = self.width();
        self.values.get(index * width..(index + 1) * width).unwrap_or_default()
    }

    /// Returns the index of the id column, if there is one.
    pub fn id(&self) -> Option<usize> {
        const IDS: [&str; 3] = ["fid", "id", "ogc_fid"];
        IDS.iter().find_map(|id| self.names.iter().position(|name| name.eq_ignore_ascii_case(id)))
    }

    /// Converts each value.
    pub fn map<W>(self, convert: impl FnMut(V) -> W) -> QueryRows<W> {
        QueryRows::new(self.names, self.values.into_iter().map(convert).collect::<Vec<W>>())
    }
}

impl QueryRows {
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

impl<V: fmt::Display> fmt::Display for QueryRows<V> {
    /// Writes a line of names, and one line for each row.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.names.join(" | "))?;
        for row in self.iter() {
            let cells: Vec<String> = row.iter().map(V::to_string).collect();
            write!(f, "\n{}", cells.join(" | "))?;
        }
        Ok(())
    }
}
