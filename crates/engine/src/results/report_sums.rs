//! Sums of the numbers that interpretations report, by chain and by name.

use std::collections::BTreeMap;

use super::derived_system::DerivedSystem;
use burgeon_base::error::{Error, Limit, Result};
use burgeon_kit::Attribute;
use burgeon_spatial::{Record, RecordTable};

/// Maximum number of names that a system reports.
const MOST_NAMES: usize = 10_000;

/// Sum of a name in a chain.
#[derive(Debug, Clone, Copy, PartialEq)]
struct ReportSum {
    /// Index of the name among those of the chain, in the order of their first reports.
    order: usize,
    sum: f64,
    /// Number of reports.
    count: usize,
}

/// Total of a reported name.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct ReportTotal {
    /// Sum of all chains.
    pub sum: f64,
    /// Number of reports.
    pub count: usize,
    /// Number of chains with reports.
    pub chains: usize,
}

/// Sums by chain and by name.
#[derive(Debug, Clone, Default, PartialEq)]
pub(crate) struct ReportSums(BTreeMap<usize, BTreeMap<Box<str>, ReportSum>>);

impl ReportSums {
    /// Adds a number to the sum of `name` in a chain.
    pub(crate) fn add(&mut self, chain: usize, name: &str, value: f64) {
        let sums = self.0.entry(chain).or_default();
        match sums.get_mut(name) {
            Some(known) => {
                known.sum += value;
                known.count += 1;
            }
            None => {
                let order = sums.len();
                sums.insert(name.into(), ReportSum { order, sum: value, count: 1 });
            }
        }
    }

    /// Adds the sums of chains that this has not.
    pub(crate) fn extend(&mut self, other: Self) {
        self.0.extend(other.0);
    }

    pub(crate) fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    /// Removes the sums of skipped chains.
    pub(crate) fn skip_chains(&mut self, chains: &[usize]) {
        chains.iter().for_each(|chain| drop(self.0.remove(chain)));
    }

    /// Returns the names in the order of their first reports, and the sums of each chain by the index of the name. Fails if
    /// there are too many names.
    pub(crate) fn table(&self) -> Result<ReportTable> {
        let mut places: BTreeMap<&str, usize> = BTreeMap::new();
        let mut table = ReportTable::default();
        for (chain, sums) in &self.0 {
            let mut sums: Vec<(&str, ReportSum)> = sums.iter().map(|(name, sum)| (&**name, *sum)).collect();
            sums.sort_by_key(|(_, sum)| sum.order);
            let mut row = Vec::with_capacity(sums.len());
            for (name, ReportSum { sum, count, .. }) in sums {
                let place = *places.entry(name).or_insert_with(|| {
                    table.names.push(name.to_owned());
                    table.names.len() - 1
                });
                row.push((place, sum, count));
            }
            if table.names.len() > MOST_NAMES {
                let text = format!("the interpretations of a system report more than {MOST_NAMES} names");
                return Err(Error::limit(Limit::Size, text)
                    .help("report few names, and give each feature its own chain: it has sums of its own"));
            }
            table.rows.push((*chain, row));
        }
        Ok(table)
    }
}

/// Index of a name, its sum in a chain, and the number of its reports there.
type ReportCell = (usize, f64, usize);

/// Sums as a table.
#[derive(Debug, Clone, Default, PartialEq)]
pub(crate) struct ReportTable {
    names: Vec<String>,
    /// Chains, with the sums of some names and the numbers of their reports.
    rows: Vec<(usize, Vec<ReportCell>)>,
}

impl ReportTable {
    /// Removes the rows of some chains, whose indices are ascending; later chains move to their places.
    pub(crate) fn drop_chains(&mut self, chains: &[usize]) {
        self.rows.retain(|(chain, _)| chains.binary_search(chain).is_err());
        for (chain, _) in &mut self.rows {
            *chain -= chains.partition_point(|dropped| *dropped < *chain);
        }
    }
}

impl DerivedSystem {
    /// Returns the sums that the interpretations of the last pass have reported: a record for each chain with reports, whose id
    /// is that of its feature. The columns are in the order of the first reports.
    pub fn reports(&self) -> RecordTable {
        let records = self.reported.rows.iter().map(|(chain, sums)| Record {
            id: self.features.get(*chain).cloned().flatten().unwrap_or_default(),
            geometry: None,
            values: sums.iter().map(|(place, sum, _)| (*place, Attribute::Number(*sum))).collect(),
        });
        let records = records.collect();
        let name = format!("system {}", self.system + 1);
        RecordTable { name, columns: self.reported.names.clone(), records }
    }

    /// Returns the totals over all chains of the names that [`DerivedSystem::reports`] has as columns, in their order.
    pub fn report_totals(&self) -> Vec<(&str, ReportTotal)> {
        let mut totals: Vec<(&str, ReportTotal)> =
            self.reported.names.iter().map(|name| (name.as_str(), ReportTotal::default())).collect();
        for (place, sum, count) in self.reported.rows.iter().flat_map(|(_, row)| row) {
            let (_, total) = &mut totals[*place];
            total.sum += sum;
            total.count += count;
            total.chains += 1;
        }
        totals
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_summed_by_chain_and_dropped_chains_leave_no_gap() {
        let mut sums = ReportSums::default();
        for (chain, name, value) in
            [(0, "a", 1.0), (2, "c", 4.0), (2, "c", 0.5), (1, "b", 8.0), (2, "a", 1.0)]
        {
            sums.add(chain, name, value);
        }
        let mut table = sums.table().unwrap();
        assert_eq!(table.names, ["a", "b", "c"]);
        assert_eq!(table.rows[2], (2, vec![(2, 4.5, 2), (0, 1.0, 1)]));
        table.drop_chains(&[1]);
        assert_eq!(table.rows, [(0, vec![(0, 1.0, 1)]), (1, vec![(2, 4.5, 2), (0, 1.0, 1)])]);
        sums.skip_chains(&[1]);
        let table = sums.table().unwrap();
        assert_eq!((table.names, table.rows[1].0), (vec!["a".to_owned(), "c".to_owned()], 2));
    }

    #[test]
    fn the_number_of_names_is_limited() {
        let mut sums = ReportSums::default();
        (0..=MOST_NAMES).for_each(|number| sums.add(number / 100, &number.to_string(), 1.0));
        assert!(sums.table().unwrap_err().to_string().contains("more than 10000 names"));
    }
}
