//! What a column holds, as its values tell.

use super::RecordTable;
use crate::Attribute;

/// What the values of a column are.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ColumnKind {
    /// All are `true` or `false`.
    Boolean,
    /// All are whole numbers.
    Integer,
    /// All are numbers.
    Number,
    /// Some are texts, or they are of several kinds; what is no text is written as one.
    Text,
}

/// The largest whole number below which all are numbers of a script.
const LARGEST: f64 = 9_007_199_254_740_992.0;

/// What each column of `table` holds; one without values holds texts.
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

impl Attribute {
    /// The value as text; lists and tables as JSON.
    pub fn text(&self) -> String {
        match self {
            Self::Boolean(value) => value.to_string(),
            Self::Number(value) => value.to_string(),
            Self::Text(text) => text.to_string(),
            Self::Nested(value) => value.to_string(),
        }
    }
}
