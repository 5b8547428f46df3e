//! A table of records.

use crate::Attribute;
use burgeon_spatial::Geometry;

/// Records with the same attributes.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct RecordTable {
    /// What it is called; tables of one file may not have the same name.
    pub name: String,
    /// The names of attributes, which may not repeat.
    pub columns: Vec<String>,
    /// The records.
    pub records: Vec<Record>,
}

/// What is known of one thing.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Record {
    /// Tells it from all others of its table.
    pub id: String,
    /// Where it is, in metres of a frame, if it is anywhere.
    pub geometry: Option<Geometry>,
    /// The number of the column, and the value; in the order of the columns.
    pub values: Vec<(usize, Attribute)>,
}

impl RecordTable {
    /// A copy with those columns alone whose names are among `names`.
    #[must_use]
    pub fn with_columns(&self, names: &[String]) -> Self {
        let is_kept = |name: &&String| names.contains(name);
        let columns: Vec<String> = self.columns.iter().filter(is_kept).cloned().collect();
        let numbers: Vec<Option<usize>> =
            self.columns.iter().map(|name| columns.iter().position(|kept| kept == name)).collect();
        let kept =
            |(column, value): &(usize, Attribute)| Some((numbers.get(*column).copied()??, value.clone()));
        let records = self.records.iter().map(|Record { id, geometry, values }| Record {
            id: id.clone(),
            geometry: geometry.clone(),
            values: values.iter().filter_map(kept).collect(),
        });
        Self { name: self.name.clone(), columns, records: records.collect() }
    }
}

impl Record {
    /// Its value in column number `column`; numbers that are not finite are none.
    pub fn value(&self, column: usize) -> Option<&Attribute> {
        let (_, value) = self.values.iter().find(|(known, _)| *known == column)?;
        match value {
            Attribute::Number(number) if !number.is_finite() => None,
            value => Some(value),
        }
    }
}
