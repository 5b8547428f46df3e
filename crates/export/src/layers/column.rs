//! Types of columns, determined from their values.

use burgeon_spatial::{Attribute, RecordTable};
use serde::{Deserialize, Serialize};

/// Type of the values in a column.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum ColumnKind {
    /// All values are `true` or `false`.
    Boolean,
    /// All values are integers.
    Integer,
    /// All values are numbers.
    Number,
    /// Some values are texts, or the types differ; other values are written as text.
    Text,
}

/// Name and type of a column.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct TableColumn {
    /// Name.
    pub name: String,
    /// Type of all values.
    pub kind: ColumnKind,
}

impl ColumnKind {
    /// Returns the type of a value; `None` for a number that is not finite, which is written as no value.
    pub fn of(value: &Attribute) -> Option<Self> {
        match value {
            Attribute::Boolean(_) => Some(Self::Boolean),
            Attribute::Number(number) if !number.is_finite() => None,
            Attribute::Number(number) if number.fract() == 0.0 && number.abs() <= LARGEST => {
                Some(Self::Integer)
            }
            Attribute::Number(_) => Some(Self::Number),
            Attribute::Text(_) | Attribute::Nested(_) => Some(Self::Text),
        }
    }

    /// Returns the type of a column that has values of two types; `None` for a part without values.
    pub fn join(a: Option<Self>, b: Option<Self>) -> Option<Self> {
        match (a, b) {
            (None, kind) | (kind, None) => kind,
            (Some(a), Some(b)) if a == b => Some(a),
            (Some(Self::Integer | Self::Number), Some(Self::Integer | Self::Number)) => Some(Self::Number),
            _ => Some(Self::Text),
        }
    }
}

/// Largest integer (2^53) up to which a script's numbers represent all integers.
const LARGEST: f64 = 9_007_199_254_740_992.0;

/// Returns the type of each column in `table`; a column without values is text.
///
/// ```
/// use burgeon_export::layers::{ColumnKind, column_kinds};
/// use burgeon_spatial::{Attribute, Record, RecordTable};
///
/// let record = |values: [f64; 2]| {
///     let values = values.into_iter().map(Attribute::Number).enumerate().collect();
///     Record { values, ..Record::default() }
/// };
/// let columns = vec!["floors".into(), "height".into(), "use".into()];
/// let records = vec![record([2.0, 6.0]), record([3.0, 8.5])];
/// let table = RecordTable { name: "houses".into(), columns, records };
/// assert_eq!(column_kinds(&table), [ColumnKind::Integer, ColumnKind::Number, ColumnKind::Text]);
/// ```
pub fn column_kinds(table: &RecordTable) -> Vec<ColumnKind> {
    let mut kinds: Vec<Option<ColumnKind>> = vec![None; table.columns.len()];
    for record in &table.records {
        for (column, value) in &record.values {
            let Some(known) = kinds.get_mut(*column) else { continue };
            *known = ColumnKind::join(*known, ColumnKind::of(value));
        }
    }
    kinds.into_iter().map(|kind| kind.unwrap_or(ColumnKind::Text)).collect()
}
