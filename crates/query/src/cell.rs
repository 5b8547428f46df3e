//! What a question gives.

use std::cmp::Ordering;
use std::fmt;
use std::sync::Arc;

use burgeon_base::budget::Budget;
use burgeon_base::error::{Error, Result};
use burgeon_spatial::Geometry;

/// One value of a row, or of a parameter.
#[derive(Debug, Clone, PartialEq)]
pub enum Cell {
    /// None.
    Null,
    /// True or false.
    Boolean(bool),
    /// A number.
    Number(f64),
    /// Text.
    Text(Arc<str>),
    /// A geometry, in the run's metres.
    Geometry(Arc<Geometry>),
    /// A list of values, of which none is a list.
    List(Arc<[Cell]>),
}

impl Cell {
    /// `null`, `boolean`, `number`, `text`, `geometry` or `list`.
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

    /// About how much memory (bytes) it takes.
    pub fn weight(&self) -> usize {
        match self {
            Self::Null | Self::Boolean(_) | Self::Number(_) => 24,
            Self::Text(text) => 40 + text.len(),
            Self::Geometry(geometry) => 120 + 24 * geometry.points().count(),
            Self::List(cells) => 40 + cells.iter().map(Self::weight).sum::<usize>(),
        }
    }

    /// An order of all values: what is none, booleans, numbers, texts and geometries; numbers and texts by themselves.
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

/// The names that rows are told apart by where a question says nothing of their order.
const IDS: [&str; 3] = ["fid", "id", "ogc_fid"];

/// The rows that a question gives.
#[derive(Debug, Default)]
pub struct QueryAnswer {
    /// The names of columns, in order.
    pub names: Arc<[String]>,
    /// The rows, in order; each has a cell for every name.
    pub rows: Vec<Vec<Cell>>,
    /// What it takes of a budget until it is dropped.
    taken: Option<(Arc<Budget>, usize)>,
}

impl QueryAnswer {
    /// An answer without rows, which are counted against a budget.
    pub(crate) fn new(names: Arc<[String]>, budget: &Arc<Budget>) -> Self {
        Self { names, rows: Vec::new(), taken: Some((Arc::clone(budget), 0)) }
    }

    /// Adds a row. Fails if there is no memory for it, or no time.
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

    /// The column that tells rows apart, if there is one.
    pub fn id(&self) -> Option<usize> {
        IDS.iter().find_map(|id| self.names.iter().position(|name| name.eq_ignore_ascii_case(id)))
    }

    /// Orders the rows by their id, and then by all columns.
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

/// The most rows of an answer.
const MOST_ROWS: usize = 10_000_000;

impl Drop for QueryAnswer {
    fn drop(&mut self) {
        if let Some((budget, taken)) = &self.taken {
            budget.give(*taken);
        }
    }
}

impl fmt::Display for QueryAnswer {
    /// A line of names, and one for each row.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.names.join(" | "))?;
        for row in &self.rows {
            let cells: Vec<String> = row.iter().map(Cell::to_string).collect();
            write!(f, "\n{}", cells.join(" | "))?;
        }
        Ok(())
    }
}
