//! Types of columns, determined from their values.

use burgeon_spatial::{Attribute, RecordTable};

/// Type of the values in a column.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
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
            let kind = match value {
                Attribute::Boolean(_) => ColumnKind::Boolean,
                Attribute::Number(number) if !number.is_finite() => continue,
                Attribute::Number(number) if number.fract() == 0.0 && number.abs() <= LARGEST => {
                    ColumnKind::Integer
                }
                Attribute::Number(_) => ColumnKind::Number,
                Attribute::Text(_) | Attribute::Nested(_) => ColumnKind::Text,
            };
            *known = Some(match (*known, kind) {
                (None, kind) => kind,
                (Some(known), kind) if known == kind => kind,
                (
                    Some(ColumnKind::Integer | ColumnKind::Number),
                    ColumnKind::Integer | ColumnKind::Number,
                ) => ColumnKind::Number,
                _ => ColumnKind::Text,
            });
        }
    }
    kinds.into_iter().map(|kind| kind.unwrap_or(ColumnKind::Text)).collect()
}
