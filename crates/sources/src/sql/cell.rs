//! Values of rows of SQL.

use std::cmp::Ordering;
use std::fmt;
use std::sync::Arc;

use burgeon_base::error::{Error, Result};
use burgeon_kit::QueryRows;
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

/// Maximum number of rows of a result.
const MOST_ROWS: usize = 10_000_000;

/// Adds a row to a result. Fails if it has too many rows, or if the memory or time limit is exceeded.
pub(crate) fn push_row(rows: &mut QueryRows<Cell>, row: Vec<Cell>) -> Result<()> {
    if rows.len() >= MOST_ROWS {
        return Err(Error::limit(
            burgeon_base::error::Limit::Size,
            format!("a question has more than {MOST_ROWS} rows"),
        )
        .help("ask for fewer: WHERE ..., or LIMIT 1000"));
    }
    rows.charge.take(24 + row.iter().map(Cell::weight).sum::<usize>())?;
    rows.values.extend(row);
    Ok(())
}

/// Sorts rows by their id, and then by all columns.
pub(crate) fn sort_rows(rows: &mut QueryRows<Cell>) {
    let id = rows.id();
    let compare = |a: &[Cell], b: &[Cell]| {
        let first = id.map_or(Ordering::Equal, |id| a[id].order(&b[id]));
        first.then_with(|| {
            let mut orders = a.iter().zip(b).map(|(a, b)| a.order(b));
            orders.find(|order| order.is_ne()).unwrap_or(Ordering::Equal)
        })
    };
    let mut order: Vec<usize> = (0..rows.len()).collect();
    order.sort_by(|a, b| compare(rows.row(*a), rows.row(*b)));
    let width = rows.width();
    let mut sorted = Vec::with_capacity(rows.values.len());
    for index in order {
        let row = &mut rows.values[index * width..][..width];
        sorted.extend(row.iter_mut().map(|cell| std::mem::replace(cell, Cell::Null)));
    }
    rows.values = sorted;
}

/// Converts a number without a fraction to an integer, so that it can be used as a row count and in integer division.
pub(crate) fn integer(number: f64) -> Option<i64> {
    #[allow(clippy::cast_possible_truncation, reason = "the range is checked")]
    (number.fract() == 0.0 && number.abs() <= 9_007_199_254_740_992.0).then_some(number as i64)
}
