//! Features of modules in chains that queries fill with rows of data.
//!
//! A chain that an axiom or a rule fills with `query(...)` has modules of many features. For exports with
//! feature attributes, each symbol is traced from its row to the final chain, and its drawing is assigned to
//! that feature. These records are kept only if [`RunReports::records`](crate::script::RunReports::records)
//! is set.

use burgeon_kit::{Makers, QueryRows, Value};
use burgeon_scene::{Origin, Scene};
use burgeon_spatial::{Record, RecordTable};
use rustc_hash::FxHashMap;

use super::records::{Columns, attribute, drop_indices};

/// Features that the symbols of a chain came from.
#[derive(Default)]
pub(crate) struct RowFeatures {
    columns: Columns,
    records: Vec<Record>,
    /// Feature numbers, by module name and feature id.
    known: FxHashMap<(String, String), u32>,
    /// Feature number of each symbol of the current chain, from 1; 0 for none.
    owners: Vec<u32>,
    /// Makers of the drawing of each object.
    makers: Vec<Option<Makers>>,
}

impl RowFeatures {
    /// Starts with a chain of `symbols` symbols without features.
    pub(crate) fn new(symbols: usize) -> Self {
        Self { owners: vec![0; symbols], ..Self::default() }
    }

    /// Returns true if no row has been put into the chain.
    pub(crate) fn is_empty(&self) -> bool {
        self.records.is_empty()
    }

    /// Returns the feature number of a symbol, from 1; 0 for none.
    pub(crate) fn owner(&self, symbol: usize) -> u32 {
        self.owners.get(symbol).copied().unwrap_or(0)
    }

    /// Returns the feature numbers of `rows`, from which a query makes modules named `module`. Rows with the
    /// same id belong to one feature.
    pub(crate) fn of_rows(&mut self, rows: &QueryRows, module: &str) -> Vec<u32> {
        let id_column = rows.id();
        let each = rows.iter().map(|row| {
            let number = u32::try_from(self.records.len() + 1).unwrap_or(u32::MAX);
            let id = match id_column {
                Some(column) => match &row[column] {
                    Value::Text(text) => text.to_string(),
                    other => other.to_string(),
                },
                None => format!("{module} {number}"),
            };
            let of = *self.known.entry((module.to_owned(), id.clone())).or_insert(number);
            if of == number {
                let named = rows.names.iter().zip(row).enumerate();
                let named = named.filter(|(column, _)| Some(*column) != id_column);
                let mut values: Vec<_> = named
                    .filter_map(|(_, (name, value))| {
                        let value = attribute(value)?;
                        Some((self.columns.number(name), value))
                    })
                    .collect();
                values.sort_by_key(|(column, _)| *column);
                self.records.push(Record { id, geometry: None, values });
            }
            of
        });
        each.collect()
    }

    /// Advances to the next chain: for each current symbol, `applied` has the rule and the number of its
    /// successors.
    pub(crate) fn step(&mut self, applied: &[(u16, u32)]) {
        if self.is_empty() {
            let count = applied.iter().map(|(_, count)| *count as usize).sum();
            self.owners = vec![0; count];
            return;
        }
        let before = std::mem::take(&mut self.owners);
        for (owner, (_, count)) in before.into_iter().zip(applied) {
            self.owners.extend(std::iter::repeat_n(owner, *count as usize));
        }
    }

    /// Sets the feature numbers of the symbols of the next chain.
    pub(crate) fn replace(&mut self, owners: Vec<u32>) {
        self.owners = owners;
    }

    /// Sets the makers of the drawing of each object.
    pub(crate) fn set_makers(&mut self, makers: Vec<Option<Makers>>) {
        self.makers = makers;
    }

    /// Drops the makers of the objects at the indices `chains`, which are ascending.
    pub(crate) fn drop_chains(&mut self, chains: &[usize]) {
        drop_indices(&mut self.makers, chains);
    }

    /// Returns the features as a table.
    pub(crate) fn table(&self, number: usize) -> RecordTable {
        RecordTable {
            name: format!("system {number}"),
            columns: self.columns.0.clone(),
            records: self.records.clone(),
        }
    }

    /// Assigns the instances that object `chain` has added to `scene` after the first `known` instances to
    /// the features of the modules that drew them.
    pub(crate) fn divide(&self, scene: &mut Scene, known: usize, chain: usize) {
        let Some(Some(makers)) = self.makers.get(chain) else { return };
        let placements: Vec<usize> = makers.all_placements().collect();
        for number in known..scene.instances.len() {
            let instance = &mut scene.instances[number];
            match instance.placement {
                Some(placement) => {
                    let owner = placements.get(placement).map_or(0, |maker| self.owner(*maker));
                    self.sign(&mut instance.origin, &mut instance.feature, owner);
                }
                None => {
                    let runs = makers.all_runs();
                    let stretches: Vec<_> =
                        runs.map(|(part, range, maker)| (part, range, self.owner(maker))).collect();
                    scene.divide(number, stretches, |instance, owner| {
                        self.sign(&mut instance.origin, &mut instance.feature, owner);
                    });
                }
            }
        }
    }

    fn sign(&self, origin: &mut Option<Origin>, feature: &mut Option<String>, owner: u32) {
        let record = (owner as usize).checked_sub(1);
        if let Some(origin) = origin {
            origin.record = record;
        }
        if let Some(record) = record.and_then(|record| self.records.get(record)) {
            *feature = Some(record.id.clone());
        }
    }
}
