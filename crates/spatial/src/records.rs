//! Records of objects: ids, geometries and attributes, as tables.

use crate::Geometry;
use burgeon_kit::Attribute;

/// Records with the same attributes.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct RecordTable {
    /// Name, unique among the tables of a file.
    pub name: String,
    /// Attribute names, without duplicates.
    pub columns: Vec<String>,
    /// Records.
    pub records: Vec<Record>,
}

/// Record of one object.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Record {
    /// Id, unique within its table.
    pub id: String,
    /// Geometry in metres of a frame, if any.
    pub geometry: Option<Geometry>,
    /// Column indices and values, in the order of the columns.
    pub values: Vec<(usize, Attribute)>,
}

impl RecordTable {
    /// Returns a copy with only the columns whose names are in `names`.
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
    /// Returns the value in the column with the index `column`; `None` for numbers that are not finite.
    pub fn value(&self, column: usize) -> Option<&Attribute> {
        let (_, value) = self.values.iter().find(|(known, _)| *known == column)?;
        match value {
            Attribute::Number(number) if !number.is_finite() => None,
            value => Some(value),
        }
    }
}
