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
    ///
    /// ```
    /// use burgeon_kit::Attribute;
    /// use burgeon_spatial::{Record, RecordTable};
    ///
    /// let values = vec![(0, Attribute::Text("oak".into())), (1, Attribute::Number(12.0))];
    /// let records = vec![Record { values, ..Record::default() }];
    /// let trees = RecordTable { columns: vec!["kind".into(), "height".into()], records, ..RecordTable::default() };
    /// let heights = trees.with_columns(&["height".into()]);
    /// assert_eq!(heights.columns, ["height"]);
    /// assert_eq!(heights.records[0].value(0), Some(&Attribute::Number(12.0)));
    /// ```
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
