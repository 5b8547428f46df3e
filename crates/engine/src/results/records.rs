//! Attributes of the features that chains came from, for export.

use std::sync::Arc;

use burgeon_kit::{Attribute, FeatureSource, Table, TableKey, Value};
use burgeon_spatial::{Record, RecordTable};

/// Features of the chains of a system, one per chain.
#[derive(Default, Clone)]
pub(crate) enum SourceFeatures {
    /// No features, or the run does not request them.
    #[default]
    None,
    /// Layer, and the row numbers of its features.
    Layer(Arc<dyn FeatureSource>, Vec<usize>),
    /// Features from a list of the script.
    List(Vec<Value>),
}

impl SourceFeatures {
    /// Adds the feature of the next chain: row `index` of a layer, or a value of the script.
    pub(crate) fn push(
        &mut self,
        layer: Option<&Arc<dyn FeatureSource>>,
        index: usize,
        value: Option<Value>,
    ) {
        match (&mut *self, layer, value) {
            (Self::Layer(_, rows), Some(_), _) => rows.push(index),
            (Self::List(list), None, Some(value)) => list.push(value),
            (Self::None, Some(layer), _) => *self = Self::Layer(Arc::clone(layer), vec![index]),
            (Self::None, None, Some(value)) => *self = Self::List(vec![value]),
            _ => {}
        }
    }

    /// Returns only the feature of chain `index`.
    pub(crate) fn only(self, index: usize) -> Self {
        match self {
            Self::None => Self::None,
            Self::Layer(layer, rows) => Self::Layer(layer, rows.into_iter().skip(index).take(1).collect()),
            Self::List(list) => Self::List(list.into_iter().skip(index).take(1).collect()),
        }
    }

    /// Drops the features of the chains at the indices `chains`, which are ascending.
    pub(crate) fn drop_chains(&mut self, chains: &[usize]) {
        match self {
            Self::None => {}
            Self::Layer(_, rows) => drop_indices(rows, chains),
            Self::List(list) => drop_indices(list, chains),
        }
    }

    /// Returns the attributes as a table with the feature `ids` of the chains; `None` without features.
    pub(crate) fn table(&self, ids: &[Option<String>], number: usize) -> Option<RecordTable> {
        let id = |chain: usize| ids.get(chain).cloned().flatten().unwrap_or_default();
        match self {
            Self::None => None,
            Self::Layer(layer, rows) => {
                let record = |(chain, row): (usize, &usize)| Record {
                    id: id(chain),
                    geometry: None,
                    values: layer.attributes(*row).to_vec(),
                };
                let records = rows.iter().enumerate().map(record).collect();
                Some(RecordTable {
                    name: layer.name().to_owned(),
                    columns: layer.attribute_names().to_vec(),
                    records,
                })
            }
            Self::List(list) => {
                let mut columns = Columns::default();
                let records = list.iter().enumerate().map(|(chain, value)| {
                    let Value::Table(table) = value else {
                        return Record { id: id(chain), ..Record::default() };
                    };
                    Record { id: id(chain), geometry: None, values: columns.values(table) }
                });
                let records = records.collect();
                Some(RecordTable { name: format!("system {number}"), columns: columns.0, records })
            }
        }
    }
}

/// Removes the items at `indices`, which are ascending.
pub(crate) fn drop_indices<T>(items: &mut Vec<T>, indices: &[usize]) {
    let mut index = 0;
    items.retain(|_| {
        index += 1;
        indices.binary_search(&(index - 1)).is_err()
    });
}

/// Attribute names, in the order of their first occurrence.
#[derive(Default)]
pub(super) struct Columns(pub(super) Vec<String>);

impl Columns {
    pub(super) fn number(&mut self, name: &str) -> usize {
        self.0.iter().position(|known| known == name).unwrap_or_else(|| {
            self.0.push(name.to_owned());
            self.0.len() - 1
        })
    }

    /// Returns the values of a feature's table, without id, geometry and values that files cannot store.
    pub(super) fn values(&mut self, table: &Table) -> Vec<(usize, Attribute)> {
        let values = table.entries.iter().filter_map(|(key, value)| match key {
            TableKey::Name(name) if !["id", "geometry"].contains(&&**name) => {
                Some((self.number(name), attribute(value)?))
            }
            _ => None,
        });
        values.collect()
    }
}

/// Converts a value to an attribute; `None` for nil and objects.
pub(super) fn attribute(value: &Value) -> Option<Attribute> {
    match value {
        Value::Nil | Value::Object(_) => None,
        Value::Boolean(value) => Some(Attribute::Boolean(*value)),
        Value::Number(number) => Some(Attribute::Number(*number)),
        Value::Text(text) => Some(Attribute::Text(Arc::clone(text))),
        Value::Table(_) => Some(Attribute::Nested(Arc::new(json(value)))),
    }
}

/// Converts a value to JSON; a table with the keys 1 to n becomes an array.
fn json(value: &Value) -> serde_json::Value {
    match value {
        Value::Nil | Value::Object(_) => serde_json::Value::Null,
        Value::Boolean(value) => (*value).into(),
        Value::Number(number) => (*number).into(),
        Value::Text(text) => (&**text).into(),
        Value::Table(table) => {
            let list = table.list();
            if list.len() == table.entries.len() {
                return list.into_iter().map(json).collect();
            }
            let name = |key: &TableKey| match key {
                TableKey::Index(index) => index.to_string(),
                TableKey::Name(name) => name.to_string(),
            };
            table.entries.iter().map(|(key, value)| (name(key), json(value))).collect()
        }
    }
}
