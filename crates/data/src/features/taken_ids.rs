//! Ids already used in a layer, so that each feature gets a unique id.

use std::hash::BuildHasher;

use hashbrown::HashTable;
use rustc_hash::{FxBuildHasher, FxHashMap};

use super::feature::Feature;
use super::id::FeatureId;

/// Ids in use.
#[derive(Debug)]
pub(crate) struct TakenIds {
    /// First free number, as long as all ids are increasing numbers; `features` is then empty.
    free: Option<u64>,
    /// Indices of features, by id.
    features: HashTable<u32>,
    /// Last number appended to a repeated id.
    last: FxHashMap<String, usize>,
}

fn hash(id: &str) -> u64 {
    FxBuildHasher.hash_one(id)
}

/// Returns the number in `id`, if it is in canonical decimal notation.
fn increasing_number(id: &str) -> Option<u64> {
    let plain = id.bytes().all(|byte| byte.is_ascii_digit()) && (id.len() == 1 || !id.starts_with('0'));
    if plain { id.parse().ok() } else { None }
}

impl TakenIds {
    /// Creates an empty set.
    pub(crate) fn new() -> Self {
        Self { free: Some(0), features: HashTable::new(), last: FxHashMap::default() }
    }

    /// Returns the id for the next of `features`: `id` if it is free, otherwise `id` with a number appended.
    pub(crate) fn fresh(&mut self, id: &str, features: &[Feature]) -> FeatureId {
        let number = self.free.and_then(|free| increasing_number(id).filter(|number| *number >= free));
        if let Some(after) = number.and_then(|number| number.checked_add(1)) {
            self.free = Some(after);
            return FeatureId::from(id);
        }
        self.look_up(features);
        let last = self.last.get(id).copied();
        let id = match last.is_some() || self.is_taken(id, features) {
            false => FeatureId::from(id),
            true => {
                let mut count = last.unwrap_or(1);
                let unique = loop {
                    count += 1;
                    let unique = format!("{id}.{count}");
                    if !self.is_taken(&unique, features) {
                        break unique;
                    }
                };
                self.last.insert(id.to_owned(), count);
                FeatureId::from(unique.as_str())
            }
        };
        self.insert(&id, features.len(), features);
        id
    }

    /// Switches to looking up ids in the table.
    fn look_up(&mut self, features: &[Feature]) {
        if self.free.take().is_some() {
            self.features = HashTable::with_capacity(features.len() + 1);
            features
                .iter()
                .enumerate()
                .for_each(|(place, feature)| self.insert(&feature.id, place, features));
        }
    }

    /// Inserts `id` for the feature at `place`.
    fn insert(&mut self, id: &str, place: usize, features: &[Feature]) {
        let own = hash(id);
        let of = |number: &u32| {
            // The new feature is not yet in the list.
            features.get(*number as usize).map_or(own, |feature| hash(&feature.id))
        };
        self.features.insert_unique(own, u32::try_from(place).unwrap_or(u32::MAX), of);
    }

    /// Counts a part with this id that is not selected, so other parts get the same ids as if it were.
    pub(crate) fn skip(&mut self, id: &str, features: &[Feature]) {
        self.look_up(features);
        let first = usize::from(self.is_taken(id, features));
        *self.last.entry(id.to_owned()).or_insert(first) += 1;
    }

    fn is_taken(&self, id: &str, features: &[Feature]) -> bool {
        let same = |number: &u32| features.get(*number as usize).is_some_and(|feature| feature.id == *id);
        self.features.find(hash(id), same).is_some()
    }
}

#[cfg(test)]
mod tests {
    use crate::{FeatureTable, Geometry, SourceOptions};
    use burgeon_spatial::Crs;

    #[test]
    fn parts_and_repeated_ids_are_numbered_on() {
        let mut table = FeatureTable::new("a", "a", Crs::epsg(4326), &SourceOptions::default());
        let point = Geometry::point([0.0; 3]);
        table.push("12", vec![point.clone(), point.clone(), point.clone()], Vec::new()).unwrap();
        table.push("12.2", vec![point.clone()], Vec::new()).unwrap();
        table.push("12", vec![point], Vec::new()).unwrap();
        let ids: Vec<&str> = table.features.iter().map(|feature| feature.id.as_str()).collect();
        assert_eq!(ids, ["12", "12.2", "12.3", "12.2.2", "12.4"]);
    }

    #[test]
    fn ids_that_count_up_are_told_apart_from_those_that_come_later() {
        let mut table = FeatureTable::new("a", "a", Crs::epsg(4326), &SourceOptions::default());
        let wanted =
            ["0", "7", "8", "18446744073709551615", "18446744073709551615", "9", "007", "8", "7.2", "7"];
        for id in wanted {
            table.push(id, vec![Geometry::point([0.0; 3])], Vec::new()).unwrap();
        }
        let ids: Vec<&str> = table.features.iter().map(|feature| feature.id.as_str()).collect();
        let same = ["18446744073709551615", "18446744073709551615.2"];
        assert_eq!(ids, ["0", "7", "8", same[0], same[1], "9", "007", "8.2", "7.2", "7.3"]);
    }

    #[test]
    fn many_equal_ids_take_no_longer_than_others() {
        let mut table = FeatureTable::new("a", "a", Crs::epsg(4326), &SourceOptions::default());
        for number in 0..200_000 {
            let id = if number % 3 == 0 { format!("a.{number}") } else { "a".to_owned() };
            table.push(&id, vec![Geometry::point([0.0; 3])], Vec::new()).unwrap();
        }
        let ids: std::collections::HashSet<_> = table.features.iter().map(|feature| &*feature.id).collect();
        assert_eq!(ids.len(), 200_000);
    }
}
