//! The results of a query.

use std::cmp::Ordering;
use std::fmt;
use std::sync::Arc;

use burgeon_base::budget::Budget;
use burgeon_base::error::{Error, Result};
use burgeon_spatial::Geometry;

/// A value of a row, or of a parameter.
#[derive(Debug, Clone, PartialEq)]
pub enum Cell {
    /// Null.
    Null,
    /// Boolean.
    Boolean(bool),
    /// Number.
    Number(f64),
    /// String.
    Text(Arc<str>),
    /// Geometry, in the run's metres.
    Geometry(Arc<Geometry>),
    /// List of values, none of which is a list.
    List(Arc<[Cell]>),
}

impl Cell {
    /// Returns the type name: `null`, `boolean`, `number`, `text`, `geometry` or `list`.
    pub fn kind(&self) -> &'static str {
        match self {
            Self::Null => "null",
            Self::Boolean(_) => "boolean",
            Self::Number(_) => "number",
            Self::Text(_) => "text",
            Self::Geometry(_) => "geometry",
            Self::List(_) => "list",
        }
    }

    /// Returns the approximate memory (bytes).
    pub fn weight(&self) -> usize {
        match self {
            Self::Null | Self::Boolean(_) | Self::Number(_) => 24,
            Self::Text(text) => 40 + text.len(),
            Self::Geometry(geometry) => 120 + 24 * geometry.points().count(),
            Self::List(cells) => 40 + cells.iter().map(Self::weight).sum::<usize>(),
        }
    }

    /// Compares any two values: null, booleans, numbers, strings, geometries and lists, in this order; values of the
    /// same type by their content.
    pub fn order(&self, other: &Self) -> Ordering {
        let rank = |cell: &Self| match cell {
            Self::Null => 0,
            Self::Boolean(_) => 1,
            Self::Number(_) => 2,
            Self::Text(_) => 3,
            Self::Geometry(_) => 4,
            Self::List(_) => 5,
        };
        match (self, other) {
            (Self::Boolean(a), Self::Boolean(b)) => a.cmp(b),
            (Self::Number(a), Self::Number(b)) => (a + 0.0).total_cmp(&(b + 0.0)),
            (Self::Text(a), Self::Text(b)) => a.cmp(b),
            (Self::Geometry(a), Self::Geometry(b)) => {
                let mut points = a.points().zip(b.points());
                let first = points.find_map(|(a, b)| {
                    let each = a.to_array().into_iter().zip(b.to_array());
                    each.map(|(a, b)| a.total_cmp(&b)).find(|order| order.is_ne())
                });
                first.unwrap_or_else(|| {
                    a.points().count().cmp(&b.points().count()).then_with(|| a.kind().cmp(&b.kind()))
                })
            }
            (Self::List(a), Self::List(b)) => {
                let first = a.iter().zip(&**b).map(|(a, b)| a.order(b)).find(|order| order.is_ne());
                first.unwrap_or_else(|| a.len().cmp(&b.len()))
            }
            _ => rank(self).cmp(&rank(other)),
        }
    }
}

impl fmt::Display for Cell {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Null => f.write_str("null"),
            Self::Boolean(value) => value.fmt(f),
            Self::Number(value) => value.fmt(f),
            Self::Text(text) => write!(f, "{text:?}"),
            Self::Geometry(geometry) => f.write_str(&geometry.to_wkt()),
            Self::List(cells) => {
                let cells: Vec<String> = cells.iter().map(Self::to_string).collect();
                write!(f, "{{{}}}", cells.join(", "))
            }
        }
    }
}

/// Names of the columns that identify rows if a query does not specify their order.
const IDS: [&str; 3] = ["fid", "id", "ogc_fid"];

/// The rows of a query's result.
#[derive(Debug, Default)]
pub struct QueryAnswer {
    /// Names of the columns, in order.
    pub names: Arc<[String]>,
    /// Rows, in order, each with a cell for every name.
    pub rows: Vec<Vec<Cell>>,
    /// Memory (bytes) charged to a budget until the result is dropped.
    taken: Option<(Arc<Budget>, usize)>,
}

impl QueryAnswer {
    /// Creates a result without rows, which charges its rows to a budget.
    pub(crate) fn new(names: Arc<[String]>, budget: &Arc<Budget>) -> Self {
        Self { names, rows: Vec::new(), taken: Some((Arc::clone(budget), 0)) }
    }

    /// Adds a row. Fails if the memory or time limit is exceeded.
    pub(crate) fn push(&mut self, row: Vec<Cell>) -> Result<()> {
        if self.rows.len() >= MOST_ROWS {
            return Err(Error::limit(
                burgeon_base::error::Limit::Size,
                format!("a question has more than {MOST_ROWS} rows"),
            )
            .help("ask for fewer: WHERE ..., or LIMIT 1000"));
        }
        if let Some((budget, taken)) = &mut self.taken {
            let weight = 24 + row.iter().map(Cell::weight).sum::<usize>();
            budget.tick()?;
            budget.take(weight)?;
            *taken += weight;
        }
        self.rows.push(row);
        Ok(())
    }

    /// Returns the index of the column that identifies rows, if there is one.
    pub fn id(&self) -> Option<usize> {
        IDS.iter().find_map(|id| self.names.iter().position(|name| name.eq_ignore_ascii_case(id)))
    }

    /// Sorts the rows by their id, and then by all columns.
    pub(crate) fn sort(&mut self) {
        let id = self.id();
        self.rows.sort_by(|a, b| {
            let first = id.map_or(Ordering::Equal, |id| a[id].order(&b[id]));
            first.then_with(|| {
                a.iter()
                    .zip(b)
                    .map(|(a, b)| a.order(b))
                    .find(|order| order.is_ne())
                    .unwrap_or(Ordering::Equal)
            })
        });
    }
}

/// Maximum number of rows of a result.
const MOST_ROWS: usize = 10_000_000;

impl Drop for QueryAnswer {
    fn drop(&mut self) {
        if let Some((budget, taken)) = &self.taken {
            budget.give(*taken);
        }
    }
}

impl fmt::Display for QueryAnswer {
    /// Writes a line of names, and one line for each row.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.names.join(" | "))?;
        for row in &self.rows {
            let cells: Vec<String> = row.iter().map(Cell::to_string).collect();
            write!(f, "\n{}", cells.join(" | "))?;
        }
        Ok(())
    }
}

/// Converts a number without a fraction to an integer, so that it can be used as a row count and in integer division.
pub(crate) fn integer(number: f64) -> Option<i64> {
    #[allow(clippy::cast_possible_truncation, reason = "the range is checked")]
    (number.fract() == 0.0 && number.abs() <= 9_007_199_254_740_992.0).then_some(number as i64)
}
